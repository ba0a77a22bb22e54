//! Which moments of a training trajectory become operating points.

use super::linearisation::Linearisation;
use super::space::{ReducedSpace, input_vector};
use super::weights::square_distance;
use crate::solver::full::Problem;
use crate::solver::full::transient::{BackwardDifference, Input};
use faer::linalg::solvers::Solve;
use faer::{Col, ColRef};
use serde::{Deserialize, Serialize};

/// A rule by which operating points are chosen, in the order of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Selection {
    /// (2.85): a state farther from all points than `tolerance` times the nearest one's norm becomes one.
    Distance {
        /// β.
        tolerance: f64,
    },
    /// (4.30) as its text has it: a state becomes a point when the step towards it, taken with the linearised system of the nearest point,
    /// misses it by more than `tolerance` times its norm.
    Step {
        /// β.
        tolerance: f64,
    },
}

impl Selection {
    /// The word that stands for it in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Distance { .. } => "distance",
            Self::Step { .. } => "step",
        }
    }

    /// β.
    pub fn tolerance(self) -> f64 {
        let (Self::Distance { tolerance } | Self::Step { tolerance }) = self;
        tolerance
    }
}

/// A moment of a training trajectory in the reduced space.
#[derive(Clone, Debug, PartialEq)]
pub struct TrainedMoment {
    /// T.
    pub time: f64,
    /// The inputs.
    pub input: Input,
    /// ỹ = (p̃, H₀).
    pub state: Vec<f64>,
}

/// Indices of the moments a rule chooses from one trajectory; the first moment is always one of them.
pub fn select(rule: Selection, space: &ReducedSpace, problem: &Problem, moments: &[TrainedMoment]) -> Vec<usize> {
    match rule {
        Selection::Distance { tolerance } => by_distance(moments, tolerance),
        Selection::Step { tolerance } => by_step(space, problem, moments, tolerance),
    }
}

fn norm(state: &[f64]) -> f64 {
    state.iter().map(|y| y * y).sum::<f64>().sqrt()
}

/// The chosen moment nearest to a state, and its distance.
fn nearest(moments: &[TrainedMoment], chosen: &[usize], state: &[f64]) -> Option<(usize, f64)> {
    let distances = chosen.iter().enumerate().map(|(k, &i)| (k, square_distance(state, &moments[i].state)));
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, square)| (k, square.sqrt()))
}

fn by_distance(moments: &[TrainedMoment], tolerance: f64) -> Vec<usize> {
    let mut chosen = Vec::new();
    for (i, moment) in moments.iter().enumerate() {
        let covered = nearest(moments, &chosen, &moment.state)
            .is_some_and(|(k, distance)| distance < tolerance * norm(&moments[chosen[k]].state));
        if !covered {
            chosen.push(i);
        }
    }
    chosen
}

fn by_step(space: &ReducedSpace, problem: &Problem, moments: &[TrainedMoment], tolerance: f64) -> Vec<usize> {
    let mut chosen: Vec<usize> = Vec::new();
    let mut systems: Vec<Linearisation> = Vec::new();
    for (i, moment) in moments.iter().enumerate() {
        let covered = nearest(moments, &chosen, &moment.state).is_some_and(|(k, _)| {
            let point = &moments[chosen[k]];
            step_error(&systems[k], point, moments, i) < tolerance * norm(&moment.state)
        });
        if !covered {
            chosen.push(i);
            systems.push(Linearisation::at(space, problem, &moment.state, moment.input));
        }
    }
    chosen
}

/// How far the step from the trajectory's own former moments to moment `i` ends from it, when one linearised system makes it.
fn step_error(system: &Linearisation, point: &TrainedMoment, moments: &[TrainedMoment], i: usize) -> f64 {
    let (now, former) = (&moments[i], &moments[i.saturating_sub(1)]);
    let before = &moments[i.saturating_sub(2)];
    let length = now.time - former.time;
    let length_before = if i >= 2 { former.time - before.time } else { length };
    let quotient = BackwardDifference::second_order(length, length_before);
    // In the linearised system the quotient acts on the deviations from the point: its weights add up to zero.
    let deviation = |moment: &TrainedMoment| {
        let state = Col::from_fn(moment.state.len(), |j| moment.state[j] - point.state[j]);
        let (here, there) = (input_vector(moment.input), input_vector(point.input));
        (state, Col::from_fn(here.len(), |j| here[j] - there[j]))
    };
    let (exact, input) = deviation(now);
    let mut rhs = ColRef::from_slice(&system.flux) + &system.flux_input * &input;
    rhs -= &system.storage_input * &input * faer::Scale(quotient.now);
    for (weight, moment) in quotient.former.into_iter().zip([former, before]) {
        let (state, input) = deviation(moment);
        rhs -= (&system.storage_state * &state + &system.storage_input * &input) * faer::Scale(weight);
    }
    let matrix = &system.storage_state * faer::Scale(quotient.now) - &system.flux_state;
    let reached = matrix.partial_piv_lu().solve(&rhs);
    (&reached - &exact).norm_l2()
}
