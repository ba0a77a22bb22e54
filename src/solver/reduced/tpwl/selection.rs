//! Selection of the moments of a training trajectory that become operating points.

use super::linearisation::{Fields, Linearisation, SystemFunctions};
use super::space::{ReducedSpace, input_vector};
use super::weights::square_distance;
use crate::solver::full::Problem;
use crate::solver::full::transient::{BackwardDifference, Input};
use faer::linalg::solvers::Solve;
use faer::{Col, ColRef};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Rule that selects operating points in the order of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Selection {
    /// (2.85): a state is selected if its distance from all points exceeds `tolerance` times the norm of the nearest
    /// one.
    Distance {
        /// Tolerance β.
        tolerance: f64,
    },
    /// (4.30) as described in its text: a state is selected if the step towards it with the linearised system of the
    /// nearest point has an error of more than `tolerance` times its norm.
    Step {
        /// Tolerance β.
        tolerance: f64,
    },
}

impl Selection {
    /// Returns the name used in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Distance { .. } => "distance",
            Self::Step { .. } => "step",
        }
    }

    /// Returns the same rule with another β.
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        match self {
            Self::Distance { .. } => Self::Distance { tolerance },
            Self::Step { .. } => Self::Step { tolerance },
        }
    }

    /// Returns β.
    pub fn tolerance(self) -> f64 {
        let (Self::Distance { tolerance } | Self::Step { tolerance }) = self;
        tolerance
    }
}

/// Moment of a training trajectory in the reduced space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TrainedMoment {
    /// Dimensionless time T.
    pub time: f64,
    /// Inputs.
    pub input: Input,
    /// Reduced state ỹ = (p̃, H₀): pressure coefficients and rigid-body separation.
    pub state: Vec<f64>,
    /// P of the full system at all nodes, at which it is linearised.
    pub pressure: Arc<[f64]>,
}

/// Selects operating points of one trajectory, for several rules or tolerances one after the other.
pub struct Selector<'a> {
    space: &'a ReducedSpace,
    problem: &'a Problem,
    moments: &'a [TrainedMoment],
    /// Linearised systems of the moments requested so far. They are expensive and independent of the tolerance.
    systems: Vec<Option<Linearisation>>,
}

impl<'a> Selector<'a> {
    /// Creates a selector without linearised systems.
    pub fn new(space: &'a ReducedSpace, problem: &'a Problem, moments: &'a [TrainedMoment]) -> Self {
        Self { space, problem, moments, systems: (0..moments.len()).map(|_| None).collect() }
    }

    /// Returns the indices of the moments that a rule selects; the first moment is always included.
    pub fn choose(&mut self, rule: Selection) -> Vec<usize> {
        let moments = self.moments;
        let mut chosen: Vec<usize> = Vec::new();
        for (i, moment) in moments.iter().enumerate() {
            let covered = nearest(moments, &chosen, &moment.state).is_some_and(|(point, distance)| match rule {
                Selection::Distance { tolerance } => distance < tolerance * norm(&moments[point].state),
                Selection::Step { tolerance } => {
                    step_error(self.system(point), &moments[point], moments, i) < tolerance * norm(&moment.state)
                }
            });
            if !covered {
                chosen.push(i);
            }
        }
        chosen
    }

    /// Returns the linearised system of a moment.
    fn system(&mut self, moment: usize) -> &Linearisation {
        let linearised = || self.moments[moment].linearised(self.space, self.problem);
        self.systems[moment].get_or_insert_with(linearised)
    }

    /// Removes and returns the linearised system of a moment.
    pub fn take_system(&mut self, moment: usize) -> Linearisation {
        self.systems[moment].take().unwrap_or_else(|| self.moments[moment].linearised(self.space, self.problem))
    }
}

impl TrainedMoment {
    /// Returns the system functions, for a reference load that may differ from the moment's own.
    pub fn functions(&self, space: &ReducedSpace, problem: &Problem) -> SystemFunctions {
        SystemFunctions::at(space, problem, self.fields(&self.film(space)), space.penalty)
    }

    fn linearised(&self, space: &ReducedSpace, problem: &Problem) -> Linearisation {
        Linearisation::at(space, problem, self.fields(&self.film(space)))
    }

    fn film(&self, space: &ReducedSpace) -> Vec<f64> {
        space.film(&self.pressure, self.state[space.modes()], self.input)
    }

    fn fields<'a>(&'a self, film: &'a [f64]) -> Fields<'a> {
        Fields { pressure: &self.pressure, film, input: self.input }
    }
}

/// Initial tolerance of the search for a number of points.
const COARSEST: f64 = 1.0;
/// Maximum number of tolerances that are tried.
const MOST_TRIED: usize = 48;
/// Ratio of two tolerances at which the search ends.
const NEAR: f64 = 1.0005;

/// Returns the rule with the tolerance that selects the given number of points from some trajectories together, or as
/// close to it as possible: the number can jump.
pub fn with_points(rule: Selection, points: usize, selectors: &mut [Selector<'_>]) -> Selection {
    let mut count = |tolerance: f64| -> usize {
        selectors.iter_mut().map(|selector| selector.choose(rule.with_tolerance(tolerance)).len()).sum()
    };
    let (mut coarse, mut fine) = (COARSEST, None);
    let mut best = (count(coarse).abs_diff(points), coarse);
    for _ in 0..MOST_TRIED {
        if best.0 == 0 || fine.is_some_and(|fine| coarse < NEAR * fine) {
            break;
        }
        // Halved until there are enough points, then bisected.
        let tolerance = fine.map_or(0.5 * coarse, |fine: f64| (fine * coarse).sqrt());
        let found = count(tolerance);
        if found.abs_diff(points) < best.0 {
            best = (found.abs_diff(points), tolerance);
        }
        if found > points {
            fine = Some(tolerance);
        } else {
            coarse = tolerance;
        }
    }
    rule.with_tolerance(best.1)
}

fn norm(state: &[f64]) -> f64 {
    state.iter().map(|y| y * y).sum::<f64>().sqrt()
}

/// Returns the selected moment nearest to a state, and its distance.
fn nearest(moments: &[TrainedMoment], chosen: &[usize], state: &[f64]) -> Option<(usize, f64)> {
    let distances = chosen.iter().map(|&i| (i, square_distance(state, &moments[i].state)));
    distances.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, square)| (i, square.sqrt()))
}

/// Returns the error of a step of one linearised system from the trajectory's previous moments to moment `i`.
fn step_error(system: &Linearisation, point: &TrainedMoment, moments: &[TrainedMoment], i: usize) -> f64 {
    let (now, former) = (&moments[i], &moments[i.saturating_sub(1)]);
    let before = &moments[i.saturating_sub(2)];
    let length = now.time - former.time;
    let length_before = if i >= 2 { former.time - before.time } else { length };
    let quotient = BackwardDifference::second_order(length, length_before);
    // In the linearised system the quotient acts on the deviations from the point, because its weights add up to zero.
    let deviation = |moment: &TrainedMoment| {
        let state = Col::from_fn(moment.state.len(), |j| moment.state[j] - point.state[j]);
        let (here, there) = (input_vector(moment.input), input_vector(point.input));
        (state, Col::from_fn(here.len(), |j| here[j] - there[j]))
    };
    let (exact, input) = deviation(now);
    let mut rhs = ColRef::from_slice(&system.flux.value) + &system.flux.by_input * &input;
    rhs -= &system.storage.by_input * &input * faer::Scale(quotient.now);
    for (weight, moment) in quotient.former.into_iter().zip([former, before]) {
        let (state, input) = deviation(moment);
        rhs -= (&system.storage.by_state * &state + &system.storage.by_input * &input) * faer::Scale(weight);
    }
    let matrix = &system.storage.by_state * faer::Scale(quotient.now) - &system.flux.by_state;
    let reached = matrix.partial_piv_lu().solve(&rhs);
    (&reached - &exact).norm_l2()
}
