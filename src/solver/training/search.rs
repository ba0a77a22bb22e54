//! Where a search for bad approximations is, as a state keeps it.

use super::spec::{Indicator, Plan};
use crate::solver::parameters::Unit;
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// Where a search for bad approximations is.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Search {
    /// Whether it was begun.
    pub begun: bool,
    /// State of the random numbers.
    pub random: u64,
    /// Rung of the ladder of tolerances.
    pub rung: usize,
    /// Good approximations in a row, of the global search.
    pub successes: usize,
    /// Centre of the local search (unit cube) and its good approximations in a row.
    pub local: Option<(Unit, usize)>,
    /// Points judged so far.
    pub judged: usize,
    /// Reduced solves that failed so far.
    pub failed: usize,
    /// Full solutions when each rung was done.
    pub rungs: Vec<usize>,
    /// Bad approximations in the order in which they were found.
    pub bad: Vec<BadPoint>,
    /// Whether it is over.
    pub finished: bool,
}

/// A bad approximation that a search came upon and had solved in full.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BadPoint {
    /// Where.
    pub point: OperatingPoint,
    /// What the indicator said; infinite where the reduced solve failed.
    pub indicator: f64,
    /// Full solutions of its window when it was found.
    pub solutions: usize,
    /// Rung of the ladder of tolerances on which it was found.
    pub rung: usize,
}

impl Search {
    /// Begins, unless it has begun.
    pub(super) fn begin(&mut self, seed: u64) {
        if !self.begun {
            (self.begun, self.random) = (true, seed);
        }
    }

    /// What it did, for the model's log.
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
