//! Progress of a training as points of a chart.

use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::{Plan, TrainingState};
use serde::{Deserialize, Serialize};

/// Full solutions and bad approximations of all local models, in the order of the decisions.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Chart {
    /// Full solutions.
    pub solved: Vec<Dot>,
    /// Bad approximations that the search found.
    pub bad: Vec<Found>,
}

/// Full solution in the M–L plane.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Dot {
    /// log10 M and L.
    pub at: [f64; 2],
    /// True if the search selected it. False if it was planned from the start.
    pub searched: bool,
}

/// Bad approximation.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Found {
    /// log10 M and L.
    pub at: [f64; 2],
    /// Value of the indicator. `None` if the reduced solve failed.
    pub indicator: Option<f64>,
    /// Number of full solutions of all local models when it was found.
    pub solutions: usize,
}

impl Chart {
    /// Returns the chart of a training.
    pub fn of(state: &TrainingState) -> Self {
        let planned = match state.spec.plan {
            Plan::Adaptive { start, .. } | Plan::WorstOfPool { start, .. } => start,
            Plan::FarthestPoint { .. } | Plan::Grid { .. } => usize::MAX,
        };
        let mut chart = Self::default();
        for window in &state.windows {
            let before = chart.solved.len();
            chart.bad.extend(window.search.bad.iter().map(|bad| Found {
                at: place(&bad.point),
                indicator: Some(bad.indicator).filter(|value| value.is_finite()),
                solutions: before + bad.solutions,
            }));
            let dots = window.solved.iter().map(|s| Dot { at: place(&s.point), searched: s.place >= planned });
            chart.solved.extend(dots);
        }
        chart
    }
}

fn place(point: &OperatingPoint) -> [f64; 2] {
    let moes = point.moes();
    [moes.m.log10(), moes.l]
}
