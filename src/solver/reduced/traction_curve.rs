//! Traction and film thickness along a curve: contacts that differ in one quantity, each solved from its neighbours.

use super::online::{Online, ReducedError};
use super::reduced_solution::ReducedSolution;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;

/// One contact of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// Value of the varied quantity.
    pub value: f64,
    /// Solution, with H_c and traction; or the error if the contact is refused or Newton's method did not converge.
    pub solution: Result<ReducedSolution, ReducedError>,
}

/// Solves the contacts of a curve in the order of the values, lazily, so that a caller may stop early. Previous
/// solutions of the solver have no influence.
pub fn traction_curve<'a>(
    online: &'a mut Online,
    point: &'a OperatingPoint,
    lubricant: Lubricant,
    vary: Quantity,
    values: &'a [f64],
) -> impl Iterator<Item = CurvePoint> + 'a {
    online.forget();
    values.iter().map(move |&value| CurvePoint { value, solution: online.solve(&vary.at(point, value), lubricant) })
}
