//! What is known of a reduced solution, and what was measured of it.

use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::reduced::ReducedSolution;

/// Features of a contact without sliding: ln M, L, ln α, ln e_f^I, and the logarithm of the last modes' share.
pub(super) const FEATURES: usize = 5;
/// Those of one in a model that knows sliding: ln(|SRR| + 0.01) and NPR as well.
pub(super) const SLIDING_FEATURES: usize = FEATURES + 2;
/// The two features among them that are no place but a sign of the error.
pub(super) const SIGNS: std::ops::Range<usize> = 3..5;
/// Modes at the end of the basis whose share is a sign of what it lacks.
const LAST_MODES: usize = 3;
/// Sliding below this is told apart no further: relative errors of a traction that is next to nothing are larger than
/// those of others.
const SLOW: f64 = 0.01;

/// One measured case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// What was known of the reduced solution.
    pub features: Features,
    /// Measured relative errors.
    pub errors: Measured,
}

/// Measured relative errors of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Of H_c.
    pub h_c: f64,
    /// Of H_min.
    pub h_min: f64,
    /// Of the state, e_z.
    pub state: f64,
    /// Of the traction coefficient; not where nothing slides, the traction has no meaning, or the model has no rule for
    /// it.
    pub traction: Option<f64>,
}

impl Measured {
    /// H_c, H_min, state and, of evidence about sliding, traction.
    pub(super) fn values(&self, sliding: bool) -> impl Iterator<Item = f64> {
        let traction = sliding.then_some(self.traction.unwrap_or(f64::NAN));
        [self.h_c, self.h_min, self.state].into_iter().chain(traction)
    }
}

/// What is cheap to know of a reduced solution: ln M, L, ln α, ln e_f^I, the last modes' share, and of a model that
/// knows sliding ln(|SRR| + 0.01) and NPR.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features {
    pub(super) values: [f64; SLIDING_FEATURES],
    pub(super) count: usize,
}

impl Features {
    /// The features of a reduced solution; `sliding` where its model knows sliding.
    pub fn of(solution: &ReducedSolution, sliding: bool) -> Self {
        Self::new(&solution.point, solution.residual_estimate, &solution.coefficients, sliding)
    }

    pub(in crate::solver::reduced) fn new(
        point: &OperatingPoint,
        residual: f64,
        coefficients: &[f64],
        sliding: bool,
    ) -> Self {
        let Moes { m, l } = point.moes();
        let norm = |c: &[f64]| c.iter().map(|v| v * v).sum::<f64>().sqrt();
        let last = norm(&coefficients[coefficients.len().saturating_sub(LAST_MODES)..]) / norm(coefficients);
        let srr = (point.sliding.slide_to_roll_ratio.abs() + SLOW).ln();
        let npr = point.sliding.newtonian_plateau_ratio.unwrap_or(1.0);
        let (residual, last) = (residual.max(1e-300).ln(), last.max(1e-300).ln());
        Self {
            values: [m.ln(), l, point.alpha_per_pa.ln(), residual, last, srr, npr],
            count: if sliding { SLIDING_FEATURES } else { FEATURES },
        }
    }

    pub(super) fn used(&self) -> &[f64] {
        &self.values[..self.count]
    }

    pub(super) fn finite(&self) -> bool {
        self.used().iter().all(|v| v.is_finite())
    }
}
