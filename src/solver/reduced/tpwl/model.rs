//! Trajectory-piecewise-linear model: operating points of training trajectories with their linearised systems.

use super::linearisation::{Linearisation, PENALTY_SLOPE, SystemFunctions};
use super::selection::{Selection, Selector, TrainedMoment, with_points};
use super::space::{INPUTS, ReducedSpace, input_vector, same_but_load};
use super::weights::square_distance;
use crate::solver::full::transient::{Frame, State, Trajectory, TransientError};
use crate::solver::full::{Mesh, Problem, SolveError};
use crate::solver::limits::Number;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::PodBasis;
use crate::solver::reduced::row_sizes::row_weights;
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Settings for training a model from trajectories.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TpwlTraining {
    /// Number of pressure modes.
    pub modes: usize,
    /// Rule that selects moments as operating points.
    pub selection: Selection,
}

/// Error in building or using a model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TpwlError {
    /// The contact, the inputs or the times are refused.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// There is no training trajectory.
    #[error("a trajectory-piecewise-linear model needs at least one training trajectory")]
    NoTraining,
    /// The trajectories do not match each other or are not suitable, the settings are invalid, or the model was not
    /// trained for the contact. Contains a sentence.
    #[error("{0}")]
    Refused(String),
}

impl TpwlError {
    /// Refuses a speed that changes its sign.
    pub(super) fn reversal(speed: f64, time: f64) -> Self {
        Self::Refused(format!(
            "the speed falls to {speed:.4} times its reference at T = {time:.4}; a trajectory-piecewise-linear model \
             needs one that stays above zero"
        ))
    }

    /// Refuses contacts that differ in more than their load.
    fn other(what: &str) -> Self {
        Self::Refused(format!("the {what} differs from the first training trajectory's; only the load may"))
    }

    /// Refuses an invalid setting.
    fn setting(quantity: &str, value: f64, accepted: &str) -> Self {
        let value = Number(value);
        Self::Refused(format!("the {quantity} of the model is {value}, but must be {accepted}"))
    }
}

/// Operating point: a moment of a training trajectory with its linearised system, which is never changed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TrainedPoint {
    /// Index of its parameter set.
    pub set: usize,
    /// Index of its training trajectory.
    pub trajectory: usize,
    /// Moment of the trajectory.
    pub moment: TrainedMoment,
    /// Input vector.
    pub input: [f64; INPUTS],
    /// Distance to the nearest other operating point of its trajectory.
    pub spacing: f64,
    /// Linearised system.
    pub system: Linearisation,
    /// B ỹ + C u and E ỹ + F u at the point itself.
    pub intercepts: SystemFunctions,
    /// ∂g/∂w and ∂f/∂w per N/m of the reference load \[m/N\].
    pub load_slope: SystemFunctions,
}

/// Training data for one reference contact.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ParameterSet {
    /// Reference contact.
    pub problem: Problem,
    /// Indices of its trajectories.
    pub trajectories: Vec<usize>,
    /// Indices of its operating points.
    pub points: Vec<usize>,
}

/// Trajectory-piecewise-linear model, (4.27), in the fixed frame.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct TpwlModel {
    /// Basis and grid.
    pub space: ReducedSpace,
    /// Singular values of the training pressures.
    pub singular_values: Vec<f64>,
    /// One per reference load, the smallest first.
    pub sets: Vec<ParameterSet>,
    /// All operating points, in the order of sets, trajectories and time.
    pub points: Vec<TrainedPoint>,
    /// Trajectories in the reduced space: all moments with stored fields.
    pub trajectories: Vec<Vec<TrainedMoment>>,
    /// Settings of the training.
    pub training: TpwlTraining,
}

/// Maximum number of snapshots for the basis, from all trajectories together. More would not add information.
const MOST_SNAPSHOTS: usize = 600;
/// Message for mass-conserving cavitation, which is not linearised.
const FILLED: &str = "a trajectory-piecewise-linear model does not support mass-conserving cavitation: its training \
                      must use the penalty or complementarity";
/// Relative change of the reference load in the difference quotient of the load slopes.
const LOAD_DIFFERENCE: f64 = 1e-3;

impl TpwlModel {
    /// Trains a model from trajectories with stored fields. They may differ in their inputs and in their reference
    /// load.
    ///
    /// # Errors
    /// [`TpwlError`] if the trajectories do not match each other or have no fields, or if the settings are invalid.
    pub fn train(trajectories: &[&Trajectory], training: TpwlTraining) -> Result<Self, TpwlError> {
        let mut model = Self::reduce(trajectories, training)?;
        model.choose_points()?;
        Ok(model)
    }

    /// Trains a model with a given number of operating points, at least 1, instead of the selection's tolerance.
    ///
    /// # Errors
    /// As [`Self::train`].
    pub fn train_with_points(
        trajectories: &[&Trajectory],
        training: TpwlTraining,
        points: usize,
    ) -> Result<Self, TpwlError> {
        let mut model = Self::reduce(trajectories, training)?;
        model.training.selection = model.selection_of(training.selection, points);
        model.choose_points()?;
        Ok(model)
    }

    /// Returns the model of the same trajectories and space with other operating points.
    ///
    /// # Errors
    /// [`TpwlError`] if the tolerance is invalid.
    pub fn reselected(&self, selection: Selection) -> Result<Self, TpwlError> {
        let training = TpwlTraining { selection, ..self.training };
        check_settings(training)?;
        let without_points = |set: &ParameterSet| ParameterSet { points: Vec::new(), ..set.clone() };
        let mut model = Self {
            space: self.space.clone(),
            singular_values: self.singular_values.clone(),
            sets: self.sets.iter().map(without_points).collect(),
            points: Vec::new(),
            trajectories: self.trajectories.clone(),
            training,
        };
        model.choose_points()?;
        Ok(model)
    }

    /// Returns a rule with the tolerance that selects about the given number of operating points from all
    /// trajectories together.
    pub fn selection_of(&self, rule: Selection, points: usize) -> Selection {
        let mut selectors = Vec::with_capacity(self.trajectories.len());
        for set in &self.sets {
            let own = set.trajectories.iter().map(|&trajectory| &self.trajectories[trajectory]);
            selectors.extend(own.map(|moments| Selector::new(&self.space, &set.problem, moments)));
        }
        with_points(rule, points, &mut selectors)
    }

    /// Returns the indices of the moments that a rule selects from each trajectory.
    pub fn selected(&self, rule: Selection) -> Vec<Vec<usize>> {
        let mut chosen = vec![Vec::new(); self.trajectories.len()];
        for set in &self.sets {
            for &trajectory in &set.trajectories {
                let mut selector = Selector::new(&self.space, &set.problem, &self.trajectories[trajectory]);
                chosen[trajectory] = selector.choose(rule);
            }
        }
        chosen
    }

    /// Builds the space, the trajectories in it and their sets, without operating points.
    fn reduce(trajectories: &[&Trajectory], training: TpwlTraining) -> Result<Self, TpwlError> {
        let first = check(trajectories, training)?;
        let Mesh { spec, scale } = first.mesh;
        let grid = spec.line().map_err(refused)?.scaled(scale);
        let count: usize = trajectories.iter().map(|t| t.states.len()).sum();
        let stride = count.div_ceil(MOST_SNAPSHOTS);
        let snapshots: Vec<&[f64]> =
            trajectories.iter().flat_map(|t| &t.states).step_by(stride).map(|s| s.pressure.as_slice()).collect();
        let matrix = Mat::from_fn(grid.len(), snapshots.len(), |i, j| snapshots[j][i]);
        let basis = PodBasis::new(matrix.as_ref(), &grid.weights, 0.0).ok_or_else(|| {
            let sentence = "the basis cannot be built: a training trajectory holds numbers that are not finite";
            TpwlError::Refused(sentence.to_owned())
        })?;
        let row_weights = row_weights(&grid, trajectories, PENALTY_SLOPE);
        let space = ReducedSpace::of_line(grid, &basis, training.modes, &row_weights);
        Ok(Self::along(space, basis.singular_values, trajectories, training))
    }

    /// Trains a model in a given space from trajectories on its grid with stored fields.
    ///
    /// # Errors
    /// As [`Self::train`].
    pub fn train_in(
        space: ReducedSpace,
        singular_values: Vec<f64>,
        trajectories: &[&Trajectory],
        training: TpwlTraining,
        points: Option<usize>,
    ) -> Result<Self, TpwlError> {
        if check(trajectories, training)?.mesh != space.grid.mesh() {
            return Err(TpwlError::other("grid"));
        }
        let mut model = Self::along(space, singular_values, trajectories, training);
        if let Some(points) = points {
            model.training.selection = model.selection_of(training.selection, points);
        }
        model.choose_points()?;
        Ok(model)
    }

    /// Creates the model with the trajectories in its space and their sets, without operating points.
    fn along(
        space: ReducedSpace,
        singular_values: Vec<f64>,
        trajectories: &[&Trajectory],
        training: TpwlTraining,
    ) -> Self {
        let moments: Vec<Vec<TrainedMoment>> = trajectories.iter().map(|t| moments(&space, t)).collect();
        let mut problems: Vec<Problem> = Vec::new();
        for trajectory in trajectories {
            if !problems.iter().any(|p| p.point == trajectory.problem.point) {
                problems.push(trajectory.problem);
            }
        }
        problems.sort_by(|a, b| a.point.load.total_cmp(&b.point.load));
        let set = |problem: Problem| {
            let own = |t: &usize| trajectories[*t].problem.point == problem.point;
            ParameterSet { problem, trajectories: (0..trajectories.len()).filter(own).collect(), points: Vec::new() }
        };
        Self {
            space,
            singular_values,
            sets: problems.into_iter().map(set).collect(),
            points: Vec::new(),
            trajectories: moments,
            training,
        }
    }

    /// Selects and linearises the operating points of all sets, which must have none yet.
    fn choose_points(&mut self) -> Result<(), TpwlError> {
        for number in 0..self.sets.len() {
            let set = &self.sets[number];
            let beside = |factor: f64| {
                let point = OperatingPoint { load: set.problem.point.load * factor, ..set.problem.point };
                Problem::new(&point, set.problem.lubricant).map_err(refused)
            };
            let beside = (beside(1.0 - LOAD_DIFFERENCE)?, beside(1.0 + LOAD_DIFFERENCE)?);
            let first = self.points.len();
            let chosen = set.trajectories.iter().flat_map(|&trajectory| self.points_of(number, trajectory, &beside));
            let chosen: Vec<TrainedPoint> = chosen.collect();
            self.points.extend(chosen);
            self.sets[number].points = (first..self.points.len()).collect();
        }
        Ok(())
    }

    /// Returns the operating points of one trajectory. `less` and `more` are the contact of its set with slightly
    /// smaller and larger load.
    fn points_of(&self, set: usize, trajectory: usize, (less, more): &(Problem, Problem)) -> Vec<TrainedPoint> {
        let problem = &self.sets[set].problem;
        let moments = &self.trajectories[trajectory];
        let mut selector = Selector::new(&self.space, problem, moments);
        let chosen = selector.choose(self.training.selection);
        let mut point = |i: usize| {
            let moment = moments[i].clone();
            let others = chosen.iter().filter(|&&other| other != i);
            let squares = others.map(|&other| square_distance(&moment.state, &moments[other].state));
            let system = selector.take_system(i);
            let (low, high) = (moment.functions(&self.space, less), moment.functions(&self.space, more));
            let slope = |low: Vec<f64>, high: Vec<f64>| {
                let change = 2.0 * LOAD_DIFFERENCE * problem.point.load;
                low.iter().zip(&high).map(|(l, h)| (h - l) / change).collect()
            };
            TrainedPoint {
                input: input_vector(moment.input),
                set,
                trajectory,
                spacing: squares.fold(f64::INFINITY, f64::min).sqrt(),
                intercepts: system.intercepts(&moment.state, moment.input),
                load_slope: SystemFunctions {
                    storage: slope(low.storage, high.storage),
                    flux: slope(low.flux, high.flux),
                },
                moment,
                system,
            }
        };
        chosen.iter().map(|&i| point(i)).collect()
    }

    /// Returns the sets between which a reference contact lies, with their shares v of (4.27); a single set if the
    /// contact is a trained one.
    ///
    /// # Errors
    /// [`TpwlError`] if the contact differs in more than its load, or if its load is outside the trained range.
    pub fn shares(&self, problem: &Problem) -> Result<Vec<(usize, f64)>, TpwlError> {
        let (Some(first), Some(last)) = (self.sets.first(), self.sets.last()) else {
            return Err(TpwlError::NoTraining);
        };
        if problem.lubricant != first.problem.lubricant {
            return Err(TpwlError::other("lubricant"));
        }
        if !same_but_load(&problem.point, &first.problem.point) {
            return Err(TpwlError::other("contact"));
        }
        let load_of = |set: &ParameterSet| set.problem.point.load;
        let load = problem.point.load;
        let above = self.sets.partition_point(|set| load_of(set) < load);
        match (above.checked_sub(1), self.sets.get(above)) {
            (_, Some(set)) if load_of(set) == load => Ok(vec![(above, 1.0)]),
            (Some(below), Some(set)) => {
                let low = load_of(&self.sets[below]);
                let share = (load - low) / (load_of(set) - low);
                Ok(vec![(below, 1.0 - share), (above, share)])
            }
            _ => {
                let [load, from, to] = [load, load_of(first), load_of(last)].map(Number);
                Err(TpwlError::Refused(format!("the load {load} N/m lies outside the trained {from}…{to} N/m")))
            }
        }
    }
}

/// Converts an error for a contact or grid. It occurs only for data from a file, since trained contacts were solved
/// before.
fn refused(error: impl Into<SolveError>) -> TpwlError {
    TpwlError::Transient(error.into().into())
}

/// Minimum number of moments with fields per trajectory: a selection by steps uses three at a time.
const LEAST_STATES: usize = 3;

/// Checks the settings.
fn check_settings(TpwlTraining { modes, selection }: TpwlTraining) -> Result<(), TpwlError> {
    if modes == 0 {
        return Err(TpwlError::setting("number of modes", 0.0, "at least 1"));
    }
    let tolerance = selection.tolerance();
    if tolerance.is_finite() && tolerance > 0.0 {
        return Ok(());
    }
    Err(TpwlError::setting("tolerance of the selection", tolerance, "a finite number above zero"))
}

/// Checks settings and trajectories, and returns the first trajectory.
fn check<'a>(trajectories: &[&'a Trajectory], training: TpwlTraining) -> Result<&'a Trajectory, TpwlError> {
    check_settings(training)?;
    let Some(&first) = trajectories.first() else { return Err(TpwlError::NoTraining) };
    for (k, trajectory) in trajectories.iter().enumerate() {
        check_frame(trajectory.transient.frame)?;
        if let Cavitation::MassConserving { .. } = trajectory.problem.lubricant.cavitation {
            return Err(TpwlError::Refused(FILLED.to_owned()));
        }
        if trajectory.states.len() < LEAST_STATES {
            return Err(TpwlError::Refused(format!(
                "training trajectory {} stores the fields at {} times, but at least {LEAST_STATES} are needed",
                k + 1,
                trajectory.states.len()
            )));
        }
        if let Some(moment) = trajectory.moments.iter().find(|moment| moment.input.speed <= 0.0) {
            return Err(TpwlError::reversal(moment.input.speed, moment.time));
        }
        let what = match (trajectory, first) {
            (a, b) if a.mesh != b.mesh => "grid",
            (a, b) if a.problem.lubricant != b.problem.lubricant => "lubricant",
            (a, b) if !same_but_load(&a.problem.point, &b.problem.point) => "contact",
            _ => continue,
        };
        return Err(TpwlError::other(what));
    }
    Ok(first)
}

/// Refuses a moving frame.
pub fn check_frame(frame: Frame) -> Result<(), TpwlError> {
    if frame == Frame::Fixed {
        return Ok(());
    }
    Err(TpwlError::Refused(format!(
        "trajectory-piecewise-linear models use the fixed frame, not the {} one: inputs would move the whole grid",
        frame.name()
    )))
}

/// Returns P as the penalty would give it: −λ/γ̄ where a multiplier λ balances the rows. A linearised system has no
/// active set, so its cavitated film is restrained by the penalty slope for every cavitation model of the training.
fn penalised(state: &State, penalty: f64) -> Arc<[f64]> {
    let multiplier = state.multiplier.iter().copied().chain(std::iter::repeat(0.0));
    state.pressure.iter().zip(multiplier).map(|(pressure, multiplier)| pressure - multiplier / penalty).collect()
}

/// Returns a trajectory in the reduced space.
fn moments(space: &ReducedSpace, trajectory: &Trajectory) -> Vec<TrainedMoment> {
    let moment = |state: &State| TrainedMoment {
        time: state.time,
        input: trajectory.transient.inputs.at(state.time),
        state: space.project(state),
        pressure: penalised(state, space.penalty),
    };
    trajectory.states.iter().map(moment).collect()
}
