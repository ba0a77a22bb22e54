//! Selection of the local basis whose centre is nearest to the present state. The distances are computed from the
//! reduced coefficients only.

use super::model::TrajectoryModel;
use crate::solver::discrete::grid::dot;
use crate::solver::reduced::{PressureModes, dense};
use faer::Mat;

/// Ratio of the distances to a new centre and to the current centre below which the basis is changed. A ratio below 1
/// avoids oscillation between two bases. The training therefore includes in each basis also states that are somewhat
/// nearer to another centre.
pub(crate) const HYSTERESIS: f64 = 0.9;

/// Centres of all local bases in the coordinates of each basis.
pub(super) struct Nearest {
    /// Centres in the modes of the whole basis, then in those of each local basis: centres × modes.
    in_basis: Vec<Mat<f64>>,
    /// Squared norms of the centres.
    squares: Vec<f64>,
    /// Work space: scalar products of the state and the centres.
    products: Vec<f64>,
}

impl Nearest {
    /// Computes the centres of a model in each basis.
    pub fn new(model: &TrajectoryModel) -> Self {
        let (centres, modes) = (model.locals.len(), model.window.pressure.count());
        let whole = Mat::from_fn(centres, modes, |k, mode| model.locals[k].centre[mode]);
        let factors = |modes: &PressureModes| modes.combined().map(|combined| combined.factors.clone());
        let local = model.locals.iter().filter_map(|local| factors(&local.window.pressure));
        let in_local = local.map(|factors| dense::product(whole.as_ref(), factors.as_ref()));
        Self {
            in_basis: std::iter::once(whole.clone()).chain(in_local).collect(),
            squares: model.locals.iter().map(|local| dot(&local.centre, &local.centre)).collect(),
            products: vec![0.0; centres],
        }
    }

    /// Returns the number of the basis for a state: 0 for the whole basis, k + 1 for local basis k. The state is given
    /// by its coefficients in the modes of the current basis `number`. Another local basis is selected only if its
    /// centre is clearly nearer, see [`HYSTERESIS`]. From the whole basis, the nearest one is selected.
    pub fn serving(&mut self, number: usize, coefficients: &[f64]) -> usize {
        let Some(centres) = self.in_basis.get(number).filter(|centres| centres.nrows() > 0) else { return number };
        dense::times(centres.as_ref(), coefficients, &mut self.products);
        let own = dot(coefficients, coefficients);
        let square = |k: usize| (own - 2.0 * self.products[k] + self.squares[k]).max(0.0);
        let nearest = (0..self.squares.len()).min_by(|a, b| square(*a).total_cmp(&square(*b))).unwrap_or(0);
        match number.checked_sub(1) {
            Some(current) if square(nearest) >= HYSTERESIS * HYSTERESIS * square(current) => number,
            _ => nearest + 1,
        }
    }
}
