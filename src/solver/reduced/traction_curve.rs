//! Traction and film along a curve: contacts that differ in one quantity, each solved from its neighbours.

use super::online::{Online, ReducedError};
use super::reduced_solution::ReducedSolution;
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;

/// One contact of a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePoint {
    /// What varies, here.
    pub value: f64,
    /// Its solution, with H_c and traction among its scalars; why there is none where the contact is refused or Newton
    /// did not converge.
    pub solution: Result<ReducedSolution, ReducedError>,
}

/// Solves the contacts of a curve in the order of the values, as they are asked for: whoever draws one may stop in
/// between. What the solver solved before has no influence.
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
