//! Transient run: one method in one frame.

use crate::app::tabs::transient::method;
use crate::app::tabs::transient::projection::FieldErrors;
use crate::engine::median;
use crate::scene::study::transient::{Kind, March, MarchedBy, Model, Row};
use crate::solver::full::GridCost;
use crate::solver::full::transient::{Frame, State, Trajectory};
use crate::solver::reduced::tpwl::{TpwlModel, TpwlRecord};
use crate::solver::reduced::transient::TrajectoryModel;
use crate::solver::warning::Warning;
use std::sync::Arc;

/// Tolerance for the comparison of times, so that rounding errors do not select the previous step.
const ROUNDING: f64 = 1e-12;

/// One method in one frame, as far as it has been computed.
pub struct Run {
    /// Method that solves its steps.
    pub by: MarchedBy,
    /// Computed trajectory. Its `ended` is valid once the run has ended.
    pub trajectory: Trajectory,
    /// Computing time of each time step \[s\].
    pub seconds: Vec<f64>,
    /// True if it has ended.
    pub ended: bool,
    /// Size of its reduced model.
    pub model: Option<ModelSize>,
    /// Maximum relative difference of H_c from [`super::runs::TransientRuns::reference_of`] it, once it has ended.
    pub difference: Option<f64>,
    /// Operating points used by each step of a linearised model; set when it has ended.
    pub record: Option<TpwlRecord>,
    /// Warnings that belong to the run; set when it has ended.
    pub warnings: Vec<Warning>,
    /// Time and value of the largest discretisation error of a full run among sampled time steps; set when it has
    /// ended.
    pub grid_cost: Option<(f64, GridCost)>,
    /// Its linearised model, if it has one.
    pub linearised: Option<Arc<TpwlModel>>,
    /// Its reduced model, if it has one.
    pub reduced: Option<Arc<TrajectoryModel>>,
    /// Pressure errors of the run and of the projection on its basis; set when the run and its reference have ended.
    pub field_errors: Option<FieldErrors>,
    /// True if its model was trained for a previous set-up.
    pub replayed: bool,
}

/// Size of a reduced model and time of its training.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelSize {
    /// Pressure modes.
    pub modes: usize,
    /// Number of sampled equations or operating points.
    pub chosen: usize,
    /// Name of what `chosen` counts.
    pub what: &'static str,
    /// Time of its training \[s\], including its full trajectories.
    pub training_s: f64,
}

impl From<&Model> for ModelSize {
    fn from(made: &Model) -> Self {
        let what = if matches!(made.kind, Kind::Reduced(_)) { "rows" } else { "operating points" };
        Self { modes: made.modes(), chosen: made.chosen(), what, training_s: made.wall_s }
    }
}

impl Run {
    /// Returns its name.
    pub fn name(&self) -> String {
        method::run_name(self.by, self.frame())
    }

    /// Creates an empty run of a method, with its model if it has one.
    pub fn begun(by: MarchedBy, trajectory: Trajectory, model: Option<&Model>) -> Self {
        let linearised = model.and_then(|model| match &model.kind {
            Kind::Linearised { model, .. } => Some(Arc::clone(model)),
            Kind::Reduced(_) => None,
        });
        let reduced = model.and_then(|model| match &model.kind {
            Kind::Reduced(model) => Some(Arc::clone(model)),
            Kind::Linearised { .. } => None,
        });
        Self {
            by,
            trajectory,
            seconds: Vec::new(),
            ended: false,
            model: model.map(ModelSize::from),
            difference: None,
            record: None,
            warnings: Vec::new(),
            grid_cost: None,
            linearised,
            reduced,
            field_errors: None,
            replayed: false,
        }
    }

    /// Receives a time step or its fields.
    pub fn take(&mut self, row: Row) {
        match row {
            Row::Moment { moment, seconds, .. } => {
                self.trajectory.moments.push(moment);
                self.seconds.push(seconds);
            }
            Row::State { state, .. } => self.trajectory.states.push(Arc::unwrap_or_clone(state)),
            _ => {}
        }
    }

    /// Completes the run.
    pub fn end(&mut self, march: &March) {
        self.ended = true;
        self.trajectory.ended = march.trajectory.ended.clone();
        self.trajectory.rejected_steps = march.trajectory.rejected_steps;
        self.trajectory.step_error = march.trajectory.step_error;
        self.record.clone_from(&march.record);
        self.warnings = march.warnings();
        self.grid_cost = march.grid_cost;
    }

    /// Returns the index of the recorded step that led to T, or of the last one before.
    pub fn step_at(&self, time: f64) -> Option<usize> {
        let steps = self.record.as_ref()?.steps();
        let next = steps.partition_point(|step| step.time <= time * (1.0 + ROUNDING));
        next.checked_sub(1).or((!steps.is_empty()).then_some(0))
    }

    /// Returns its frame.
    pub fn frame(&self) -> Frame {
        self.trajectory.transient.frame
    }

    /// Returns the last computed T. 0 if not even the initial state was found.
    pub fn reached(&self) -> f64 {
        self.trajectory.reached()
    }

    /// Returns the last stored fields at or before T, otherwise the first ones. `None` if the run has not reached
    /// T.
    pub fn state_at(&self, time: f64) -> Option<&State> {
        if self.reached() * (1.0 + ROUNDING) < time {
            return None;
        }
        let next = self.trajectory.states.partition_point(|state| state.time <= time * (1.0 + ROUNDING));
        self.trajectory.states.get(next.saturating_sub(1))
    }

    /// Returns X, P and H of stored fields along the axis Y = 0 in the scales of the reference contact, without the first
    /// node, which lies outside the inlet of a line contact.
    pub fn profile<'a>(&'a self, state: &'a State) -> impl Iterator<Item = (f64, f64, f64)> + 'a {
        let scales = state.scales;
        // Nodes of a point contact run from the outer edge to the axis first.
        let column = (state.pressure.len() / self.trajectory.x.len().max(1)).max(1);
        let on_axis = move |field: &'a [f64]| field.iter().skip(column - 1).step_by(column);
        let fields = self.trajectory.x.iter().zip(on_axis(&state.pressure)).zip(on_axis(&state.film)).skip(1);
        fields.map(move |((x, p), h)| (x * scales.half_width, p * scales.pressure, h * scales.film))
    }

    /// Returns its trajectory without fields, for comparisons.
    pub fn without_fields(&self) -> Trajectory {
        Trajectory { x: Vec::new(), states: Vec::new(), ..self.trajectory.clone() }
    }

    /// Returns the median time per step \[s\] without the initial state. `None` before the first step.
    pub fn seconds_per_step(&self) -> Option<f64> {
        Some(median(self.seconds.get(1..)?)).filter(|seconds| seconds.is_finite())
    }
}
