//! March in time: sequence of the steps, rejection of failed ones, and recording of the trajectory.

use super::difference::BackwardDifference;
use super::frame::{Conditions, Frame, Scales};
use super::pace::{Pace, Rule, TimeStep};
use super::signal::{InputError, Inputs, Signal};
use super::step_error::controlled;
use super::surface::{MovingSurface, Scheme, SurfaceError};
use super::trajectory::{Effort, Ended, Moment, State, Trajectory};
use super::unsupported::Unsupported;
use crate::solver::full::{Mesh, Problem, SolveError, Termination};
use crate::solver::observer::{Observer, Progress};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, WholeLubricant};
use serde::{Deserialize, Serialize};

/// Definition of a transient simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transient {
    /// Reference contact.
    pub point: OperatingPoint,
    /// Lubricant of the contact.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// Inputs that vary in time.
    pub inputs: Inputs,
    /// Prescribed rigid-body separation: H₀ of the start plus this signal minus 1, in units of a²/R. The load is then a
    /// result, reported in the inputs of each moment. If absent, the load is given.
    #[serde(default)]
    pub separation: Option<Signal>,
    /// Features that move through the contact.
    #[serde(default)]
    pub surfaces: Vec<MovingSurface>,
    /// Time scheme of the full system.
    #[serde(default)]
    pub scheme: Scheme,
    /// Motion of the domain.
    pub frame: Frame,
    /// Last dimensionless time T.
    pub duration: f64,
    /// Lengths of the steps.
    pub time_step: TimeStep,
    /// Fields to be kept.
    pub keep: Keep,
}

/// Fields that a trajectory keeps. Scalars are always kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Keep {
    /// No fields.
    #[default]
    Scalars,
    /// Fields of the start and of every n-th step after it; n is at least 1.
    Every(usize),
}

/// Error that prevents the start of a march.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TransientError {
    /// The contact or its grid is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The inputs are refused.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The duration or a step is not a positive number, or there are too many steps. Contains a sentence.
    #[error("{0}")]
    Time(String),
    /// A feature of the surfaces, or the time scheme, is refused.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// Transient simulations do not support this contact.
    #[error(transparent)]
    Unsupported(#[from] Unsupported),
}

/// Observer of a march.
pub trait TransientObserver: Observer {
    /// Called after the start and after every accepted step.
    fn moment(&self, _moment: &Moment) {}

    /// Returns true to receive the fields of this moment as well. Called after each moment.
    fn wants_state(&self) -> bool {
        false
    }

    /// Called with the fields of the last reported moment, if [`Self::wants_state`] returned true.
    fn state(&self, _state: &State) {}
}

impl TransientObserver for () {}

/// Reports the progress of a march, in thousandths of its duration, as a stage of a longer computation.
pub struct MarchProgress<'a> {
    /// Observer that receives the progress and may stop the march.
    pub observer: &'a dyn Observer,
    /// Name of the stage, for display.
    pub stage: String,
    /// Duration of the march.
    pub duration: f64,
}

impl Observer for MarchProgress<'_> {
    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }
}

impl TransientObserver for MarchProgress<'_> {
    fn moment(&self, moment: &Moment) {
        let done = (1000.0 * moment.time / self.duration) as usize;
        self.observer.progress(Progress { stage: self.stage.clone(), done, total: 1000 });
    }
}

/// Data of one step that the rows of any model use.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// Equations at the end of the step.
    pub now: Conditions,
    /// Scales at the beginning of the step and one step before.
    pub former: [Scales; 2],
    /// Difference quotient.
    pub quotient: BackwardDifference,
    /// Length of the step.
    pub length: f64,
    /// Length of the step relative to the previous one.
    pub ratio: f64,
    /// ȧ/a of the moving nodes, by the same quotient as all other time derivatives, so that moving nodes alone change
    /// no field. 0 in the other frames.
    pub growth: f64,
}

/// Model of a contact that a march can advance in time. It holds its current state, two previous ones, and the step
/// under trial.
pub trait Marching {
    /// Returns the grid of the model's fields.
    fn mesh(&self) -> Mesh;

    /// Returns the abscissae X of the fields, in units of the frame's half-width.
    fn abscissae(&self) -> &[f64];

    /// Computes the steady state at the start, which is also its whole history.
    ///
    /// # Errors
    /// [`Termination`]: the reason why the iteration stopped.
    fn rest(&mut self, at: &Conditions, observer: &dyn Observer) -> Result<Effort, Termination>;

    /// Solves the end of a step, starting from the extrapolation of the previous states.
    ///
    /// # Errors
    /// [`Termination`]: the reason why the iteration stopped. The previous states are unchanged.
    fn step(&mut self, step: &Step, observer: &dyn Observer) -> Result<Effort, Termination>;

    /// Returns ‖P − extrapolation‖/‖P‖ of the step under trial, with the pressure P.
    fn deviation(&self) -> f64;

    /// Accepts the step under trial, which led to `at`, as a previous state.
    fn accept(&mut self, at: &Conditions);

    /// Returns the scalars of the last state.
    fn moment(&self, at: &Conditions, step: f64, effort: Effort) -> Moment;

    /// Returns the fields of the last state.
    fn state(&self, at: &Conditions) -> State;
}

/// Maximum number of steps of one march.
pub(super) const MOST_STEPS: f64 = 2e6;
impl Transient {
    /// Creates a march with the default lubricant, in the fixed frame and with equal steps; no fields are kept.
    pub fn new(point: OperatingPoint, inputs: Inputs, duration: f64, step: f64) -> Self {
        let (lubricant, time_step) = (Lubricant::default(), TimeStep::Fixed(step));
        Self {
            point,
            lubricant,
            inputs,
            separation: None,
            surfaces: Vec::new(),
            scheme: Scheme::Default,
            frame: Frame::Fixed,
            duration,
            time_step,
            keep: Keep::Scalars,
        }
    }
}

impl Step {
    /// Creates the step to `now` after the states with the `former` scales. The first step of a march has no previous
    /// one; its `step_before` is its own length.
    pub fn new(frame: Frame, now: Conditions, former: [Scales; 2], step: f64, step_before: f64) -> Self {
        let quotient = BackwardDifference::second_order(step, step_before);
        let growth = match frame {
            Frame::ArbitraryLagrangianEulerian => {
                quotient.of([now.scales.half_width, former[0].half_width, former[1].half_width]) / now.scales.half_width
            }
            Frame::Fixed | Frame::Remeshed(_) => 0.0,
        };
        Self { now, former, quotient, length: step, ratio: step / step_before, growth }
    }

    /// Returns the velocity of the flow relative to the node at X.
    #[inline]
    pub fn velocity(&self, x: f64) -> f64 {
        self.now.speed - self.growth * x
    }

    /// Returns the weights of the previous mass flow ρ̄H, the nearer one first: (R/a²) ∂/∂T of (a²/R) ρ̄H, which is
    /// ∂(ρ̄H)/∂T with the growth of the scale of H.
    pub fn history_weights(&self) -> [f64; 2] {
        std::array::from_fn(|i| self.quotient.former[i] * self.former[i].film / self.now.scales.film)
    }
}

/// Advances a model in time.
///
/// # Errors
/// [`TransientError`] if the contact, the inputs, the times or the lubricant are refused. A march that ends early is
/// not an error: its trajectory states when and why it ended.
pub fn march(
    model: &mut dyn Marching,
    transient: &Transient,
    observer: &dyn TransientObserver,
) -> Result<Trajectory, TransientError> {
    match transient.time_step {
        TimeStep::Controlled(tolerance) => controlled(model, transient, tolerance, observer),
        TimeStep::Fixed(_) | TimeStep::Adaptive { .. } => {
            march_once(model, transient, transient.time_step.rule(transient.duration), observer)
        }
    }
}

/// Advances a model in time with steps by one rule.
pub(super) fn march_once(
    model: &mut dyn Marching,
    transient: &Transient,
    rule: Rule,
    observer: &dyn TransientObserver,
) -> Result<Trajectory, TransientError> {
    let mut trajectory = Trajectory { rule, ..Trajectory::begun(transient, model.mesh(), model.abscissae())? };
    let problem = trajectory.problem;
    trajectory.ended = match walk(model, &problem, observer, &mut trajectory) {
        Ok(()) => Ended::Finished,
        Err(ended) => ended,
    };
    Ok(trajectory)
}

fn walk(
    model: &mut dyn Marching,
    problem: &Problem,
    observer: &dyn TransientObserver,
    trajectory: &mut Trajectory,
) -> Result<(), Ended> {
    let Transient { inputs, frame, duration, .. } = trajectory.transient.clone();
    let conditions = |time: f64| {
        let refused = |reason: SolveError| Ended::ContactRefused { time, reason: reason.to_string() };
        frame.conditions(problem, time, inputs.at(time)).map_err(refused)
    };
    let mut at = conditions(0.0)?;
    let effort = model.rest(&at, observer).map_err(|termination| match termination {
        Termination::Cancelled => Ended::Cancelled { time: 0.0 },
        _ => Ended::StepRefused { time: 0.0, step: 0.0, termination },
    })?;
    trajectory.record(model, &at, 0.0, effort, observer);
    let mut former = at.scales;
    let mut pace = Pace::new(trajectory.rule, duration);
    let mut recorded = at.time;
    let mut effort = Effort::default();
    while at.time < duration {
        if observer.cancelled() {
            return Err(Ended::Cancelled { time: at.time });
        }
        // Adaptive steps may become shorter than the longest step.
        if trajectory.moments.len() as f64 > MOST_STEPS + 1.0 {
            let (time, step, termination) = (at.time, pace.length, Termination::Effort);
            return Err(Ended::StepRefused { time, step, termination });
        }
        let now = conditions(pace.aim(at.time))?;
        let step = Step::new(frame, now, [at.scales, former], pace.length, pace.before);
        match model.step(&step, observer) {
            Ok(own) => {
                effort = effort.and(own);
                if !pace.accepts(|| model.deviation()) {
                    trajectory.rejected_steps += 1;
                    continue;
                }
                model.accept(&now);
                (former, at) = (at.scales, now);
                if pace.records(at.time) {
                    trajectory.record(model, &at, at.time - recorded, effort, observer);
                    (recorded, effort) = (at.time, Effort::default());
                }
            }
            Err(Termination::Cancelled) => return Err(Ended::Cancelled { time: at.time }),
            Err(termination) => {
                let refused = Ended::StepRefused { time: now.time, step: pace.length, termination };
                if !pace.shorten() {
                    return Err(refused);
                }
                trajectory.rejected_steps += 1;
            }
        }
    }
    Ok(())
}

impl Trajectory {
    /// Creates the trajectory of a contact before its first moment, with the grid and the abscissae of its fields.
    ///
    /// # Errors
    /// [`TransientError`] if the contact, the inputs, the times or the lubricant are refused.
    pub fn begun(transient: &Transient, mesh: Mesh, x: &[f64]) -> Result<Self, TransientError> {
        Ok(Self {
            transient: transient.clone(),
            rule: transient.time_step.rule(transient.duration),
            problem: transient.problem()?,
            mesh,
            x: x.to_vec(),
            moments: Vec::new(),
            states: Vec::new(),
            rejected_steps: 0,
            step_error: None,
            ended: Ended::Finished,
        })
    }

    /// Adds the last state to the trajectory and reports it to the observer.
    fn record(
        &mut self,
        model: &dyn Marching,
        at: &Conditions,
        step: f64,
        effort: Effort,
        observer: &dyn TransientObserver,
    ) {
        if let Keep::Every(n) = self.transient.keep
            && self.moments.len().is_multiple_of(n.max(1))
        {
            self.states.push(model.state(at));
        }
        let moment = model.moment(at, step, effort);
        self.moments.push(moment);
        observer.moment(&moment);
        if observer.wants_state() {
            observer.state(&model.state(at));
        }
    }
}
