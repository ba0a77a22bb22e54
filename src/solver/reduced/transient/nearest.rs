//! Selection of the local basis nearest to a state.

use super::model::TrajectoryModel;
use crate::solver::discrete::grid::dot;
use crate::solver::reduced::{PressureModes, dense};
use faer::Mat;

/// A basis replaces the current one if its centre is nearer than this share of the distance to the current centre.
/// This avoids oscillation between two bases. The training extends each basis to states as far from its centre.
pub(crate) const HYSTERESIS: f64 = 0.9;

/// Centres of all local bases in the coordinates of each basis.
pub(super) struct Nearest {
    /// For the whole basis, then for each local one: the centres in its modes, centres × modes.
    seen: Vec<Mat<f64>>,
    /// Squared norms of the centres.
    squares: Vec<f64>,
    products: Vec<f64>,
}

impl Nearest {
    /// Computes the centres for a model.
    pub fn new(model: &TrajectoryModel) -> Self {
        let (centres, modes) = (model.locals.len(), model.window.pressure.count());
        let whole = Mat::from_fn(centres, modes, |k, mode| model.locals[k].centre[mode]);
        let factors = |modes: &PressureModes| modes.combined().map(|combined| combined.factors.clone());
        let local = model.locals.iter().filter_map(|local| factors(&local.window.pressure));
        let seen = local.map(|factors| dense::product(whole.as_ref(), factors.as_ref()));
        Self {
            seen: std::iter::once(whole.clone()).chain(seen).collect(),
            squares: model.locals.iter().map(|local| dot(&local.centre, &local.centre)).collect(),
            products: vec![0.0; centres],
        }
    }

    /// Returns the number of the basis for a state, which is given in the modes of basis `number`. Another basis is
    /// selected only if it is clearly nearer.
    pub fn serving(&mut self, number: usize, coefficients: &[f64]) -> usize {
        let Some(seen) = self.seen.get(number).filter(|seen| seen.nrows() > 0) else { return number };
        dense::times(seen.as_ref(), coefficients, &mut self.products);
        let own = dot(coefficients, coefficients);
        let square = |k: usize| (own - 2.0 * self.products[k] + self.squares[k]).max(0.0);
        let nearest = (0..self.squares.len()).min_by(|a, b| square(*a).total_cmp(&square(*b))).unwrap_or(0);
        match number.checked_sub(1) {
            Some(present) if square(nearest) >= HYSTERESIS * HYSTERESIS * square(present) => number,
            _ => nearest + 1,
        }
    }
}
