//! State of a search for bad approximations.

use super::spec::{Indicator, Plan};
use crate::solver::parameters::Unit;
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// State of a search for bad approximations.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Search {
    /// True after the start.
    pub begun: bool,
    /// State of the random number generator.
    pub random: u64,
    /// Index of the current tolerance.
    pub rung: usize,
    /// Number of good approximations in a row of the global search.
    pub successes: usize,
    /// Centre of the local search (unit cube) and its number of good approximations in a row.
    pub local: Option<(Unit, usize)>,
    /// Number of points judged so far.
    pub judged: usize,
    /// Number of failed reduced solves so far.
    pub failed: usize,
    /// Number of full solutions when each tolerance was met.
    pub rungs: Vec<usize>,
    /// Bad approximations in the order in which they were found.
    pub bad: Vec<BadPoint>,
    /// True at the end.
    pub finished: bool,
}

/// Bad approximation that a search found and solved in full.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BadPoint {
    /// Operating point.
    pub point: OperatingPoint,
    /// Value of the indicator; infinite if the reduced solve failed.
    pub indicator: f64,
    /// Number of full solutions of its local model when it was found.
    pub solutions: usize,
    /// Index of the tolerance for which it was found.
    pub rung: usize,
}

impl Search {
    /// Starts the search, unless it has started.
    pub(super) fn begin(&mut self, seed: u64) {
        if !self.begun {
            (self.begun, self.random) = (true, seed);
        }
    }

    /// Returns a summary for the model's log; `None` for a plan without a search.
    pub(super) fn describe(&self, plan: &Plan) -> Option<String> {
        let (indicator, tolerances) = match plan {
            Plan::Adaptive { indicator, tolerances, .. } => (*indicator, tolerances.as_slice()),
            Plan::WorstOfPool { indicator, tolerance, .. } => (*indicator, std::slice::from_ref(tolerance)),
            _ => return None,
        };
        let judged_by = match indicator {
            Indicator::Residual => "the residual (3.15)",
            Indicator::Dissertation => "the residual (3.15) of the dissertation's scheme",
            Indicator::Correction => "three full Newton steps each",
        };
        let mut text = format!("{} points judged by {judged_by}, {} reduced solves failed", self.judged, self.failed);
        for (tolerance, solutions) in tolerances.iter().zip(&self.rungs) {
            text += &format!("; tolerance {tolerance:e} met with {solutions} solutions");
        }
        if let Some(missed) = tolerances.get(self.rungs.len()) {
            text += &format!("; tolerance {missed:e} was not met");
        }
        Some(text)
    }
}
