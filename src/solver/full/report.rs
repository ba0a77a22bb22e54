//! Result of a solve: the reason why it ended, and its effort.

use crate::solver::limits::digits;
use crate::solver::physics::contact::Moes;
use serde::{Deserialize, Serialize};

/// Reason why a solve stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Termination {
    /// The step fell below the tolerance.
    Converged,
    /// The iteration limit was reached.
    IterationLimit,
    /// The total effort of a solve was spent, see [`most_newton`].
    ///
    /// [`most_newton`]: super::most_newton
    Effort,
    /// The iterates left the reasonable range.
    Diverged,
    /// The pressures left the range of the viscosity law.
    OccupiedVolume,
    /// The observer requested a stop.
    Cancelled,
}

impl Termination {
    /// Returns a message that continues "the solve …".
    pub fn describe(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::IterationLimit => {
                "stopped at the iteration limit; try a start from a converged neighbour, a finer grid or a longer inlet"
            }
            Self::Effort => {
                "was given up after its effort was spent; try a start from a converged neighbour, another grid or an easier contact"
            }
            Self::Diverged => "diverged; try a start from a converged neighbour, a smaller load or a finer grid",
            Self::OccupiedVolume => {
                "met pressures at which the lubricant's relative volume falls under its occupied volume, where Doolittle's law ends; use a smaller load or another lubricant"
            }
            Self::Cancelled => "was cancelled",
        }
    }
}

/// Account of how a solution was obtained.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Reason why the solve stopped.
    pub termination: Termination,
    /// Newton steps of all attempts together.
    pub newton_iterations: usize,
    /// Krylov iterations of all attempts together.
    pub linear_iterations: usize,
    /// Number of starts tried; 1 if the first one converged.
    pub attempts: usize,
    /// 2-norm of the residual before each Newton step. Equations are weighted by √w, with the quadrature weights w,
    /// so that the norm approximates the L2 norm over the domain.
    pub residuals: Vec<f64>,
    /// Size of each Newton step: ‖Δz‖/‖z‖ with z = (P, H₀) for a line contact, max|ΔP| for a point contact.
    pub steps: Vec<f64>,
    /// 2-norm of the residual of the solution.
    pub residual_norm: f64,
    /// True if the cavitation boundary cycled between two sets of nodes and was moved node by node from then on.
    #[serde(default)]
    pub cautious_front: bool,
    /// Last contact reached by a continuation that ended before the requested contact.
    #[serde(default)]
    pub reached: Option<Moes>,
}

impl Report {
    /// Creates the report of a solve without attempts.
    pub(crate) fn empty() -> Self {
        Self {
            termination: Termination::IterationLimit,
            newton_iterations: 0,
            linear_iterations: 0,
            attempts: 0,
            residuals: Vec::new(),
            steps: Vec::new(),
            residual_norm: f64::NAN,
            cautious_front: false,
            reached: None,
        }
    }

    /// Returns the outcome as the end of a sentence.
    pub fn describe(&self) -> String {
        let ending = self.termination.describe();
        match self.reached {
            Some(Moes { m, l }) if self.termination != Termination::Cancelled => format!(
                "walked from an easier contact as far as M {}, L {}, beyond which no film is resolved on this grid; it {ending}",
                digits(m),
                digits(l)
            ),
            _ => ending.to_owned(),
        }
    }

    /// Adds the effort of another solve and takes over its outcome.
    pub(super) fn add(&mut self, other: &Self) {
        self.termination = other.termination;
        self.newton_iterations += other.newton_iterations;
        self.linear_iterations += other.linear_iterations;
        self.attempts += other.attempts;
        self.residuals.extend_from_slice(&other.residuals);
        self.steps.extend_from_slice(&other.steps);
        self.residual_norm = other.residual_norm;
        self.cautious_front |= other.cautious_front;
        self.reached = other.reached;
    }

    /// True if no further start needs to be tried.
    pub(super) fn ended(&self) -> bool {
        use Termination::{Cancelled, Converged, Effort};
        self.attempts > 0 && matches!(self.termination, Converged | Cancelled | Effort)
    }
}
