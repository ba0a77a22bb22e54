//! Discretisation error of the central film thickness, and the limit above which it causes a warning.

use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Discretisation errors of the central film thickness H_c, relative and to first order; positive if the exact film
/// is thicker. Errors far above 0.1 are underestimated, because they are computed from a film that is itself too
/// thin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GridCost {
    /// Domain-truncation error: the inlet ends too early, or the sides are too near.
    pub truncation: f64,
    /// Error due to the finite spacing.
    pub resolution: f64,
}

/// Relative discretisation error of H_c above which a result carries a warning.
pub(super) const TOLERATED: f64 = 0.03;

impl GridCost {
    /// Returns the sum of the absolute errors of H_c.
    pub fn total(self) -> f64 {
        self.truncation.abs() + self.resolution.abs()
    }

    /// Returns a warning if the total error exceeds the limit or is unknown.
    pub fn warning(self) -> Option<Warning> {
        let relative = self.total();
        if relative.is_nan() {
            return Some(Warning::DiscretisationErrorUnknown);
        }
        (relative > TOLERATED).then_some(Warning::DiscretisationError { relative, ends: None, spacing: None })
    }

    /// Returns the same warning for one time of a transient solution.
    pub fn warning_in_time(self, time: f64) -> Option<Warning> {
        self.warning().map(|warning| Warning::DiscretisationErrorInTime { time, warning: Box::new(warning) })
    }
}

/// Summarises the solutions whose grids are inadequate: their number, the number of all solutions, and the contact
/// with the largest error. `None` if all grids are adequate.
pub fn grid_doubts(judged: impl IntoIterator<Item = (OperatingPoint, GridCost)>) -> Option<String> {
    let (mut all, mut doubtful) = (0, 0);
    let mut worst: Option<(OperatingPoint, GridCost)> = None;
    for (point, cost) in judged {
        all += 1;
        if cost.warning().is_some() {
            doubtful += 1;
            // An unknown error counts as the largest.
            worst = Some(
                worst.filter(|(_, worst)| worst.total().total_cmp(&cost.total()).is_ge()).unwrap_or((point, cost)),
            );
        }
    }
    let (point, cost) = worst?;
    let Moes { m, l } = point.moes();
    let why = cost.warning()?;
    Some(format!("the grid does not do for {doubtful} of {all} solutions; the worst, at M = {m:.4}, L = {l:.4}: {why}"))
}
