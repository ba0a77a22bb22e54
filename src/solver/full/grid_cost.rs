//! What a grid costs the central film, and when that is worth a warning.

use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// What the grid costs H_c: relative errors to first order, positive where the true film is thicker. Far beyond a tenth
/// they are too small: the film by which they are judged is too thin itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GridCost {
    /// Since the inlet ends too early, or the sides too near.
    pub truncation: f64,
    /// Since the spacing is finite.
    pub resolution: f64,
}

/// An answer whose grid costs more than this share of H_c carries a warning.
pub(super) const TOLERATED: f64 = 0.03;

impl GridCost {
    /// The relative error of H_c by both.
    pub fn total(self) -> f64 {
        self.truncation.abs() + self.resolution.abs()
    }

    /// A warning if that is more than a few percent, or unknown.
    pub fn warning(self) -> Option<Warning> {
        let relative = self.total();
        if relative.is_nan() {
            return Some(Warning::DiscretisationErrorUnknown);
        }
        (relative > TOLERATED).then_some(Warning::DiscretisationError { relative, ends: None, spacing: None })
    }

    /// The same of a moment of a march in time.
    pub fn warning_in_time(self, time: f64) -> Option<Warning> {
        self.warning().map(|warning| Warning::DiscretisationErrorInTime { time, warning: Box::new(warning) })
    }
}

/// What the grids cost those of some solutions that they do not do for: how many these are, of how many, and the
/// worst of them with its contact.
pub fn grid_doubts(judged: impl IntoIterator<Item = (OperatingPoint, GridCost)>) -> Option<String> {
    let (mut all, mut doubtful) = (0, 0);
    let mut worst: Option<(OperatingPoint, GridCost)> = None;
    for (point, cost) in judged {
        all += 1;
        if cost.warning().is_some() {
            doubtful += 1;
            // What cannot be told is the worst.
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
