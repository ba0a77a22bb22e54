//! The march through time: which steps are taken, which are discarded, and what is kept.

use super::difference::BackwardDifference;
use super::frame::{Conditions, Frame, Scales};
use super::pace::{Pace, Rule, TimeStep};
use super::signal::{InputError, Inputs};
use super::step_error::controlled;
use super::trajectory::{Effort, Ended, Moment, State, Trajectory};
use super::unsupported::Unsupported;
use crate::solver::discrete::grid::LineGrid;
use crate::solver::full::{Mesh, Problem, SolveError, Termination};
use crate::solver::limits::Number;
use crate::solver::observer::{Observer, Progress};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Lubricant, WholeLubricant};
use serde::{Deserialize, Serialize};

/// A contact to be taken through time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transient {
    /// The reference contact.
    pub point: OperatingPoint,
    /// Its lubricant.
    #[serde(with = "WholeLubricant")]
    pub lubricant: Lubricant,
    /// What varies.
    pub inputs: Inputs,
    /// How the domain follows.
    pub frame: Frame,
    /// The last T.
    pub duration: f64,
    /// Lengths of the steps.
    pub time_step: TimeStep,
    /// Which fields are kept.
    pub keep: Keep,
}

/// Which fields a trajectory keeps; scalars are always kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Keep {
    /// None.
    #[default]
    Scalars,
    /// Those of the start and of every n-th step after it; n is at least 1.
    Every(usize),
}

/// Why a march cannot begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TransientError {
    /// The contact or its grid is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The inputs are refused.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The duration or a step is no positive number, or there would be too many steps: a sentence.
    #[error("{0}")]
    Time(String),
    /// Transient runs do not cover such contacts.
    #[error(transparent)]
    Unsupported(#[from] Unsupported),
}

/// Watches a march.
pub trait TransientObserver: Observer {
    /// Called after the start and after every step taken.
    fn moment(&self, _moment: &Moment) {}

    /// Asked after each moment: whether its fields are wanted too.
    fn wants_state(&self) -> bool {
        false
    }

    /// The fields of the moment reported last, where they were wanted.
    fn state(&self, _state: &State) {}
}

impl TransientObserver for () {}

/// Tells how far a march is, in thousandths of its duration, as a stage of a longer work.
pub struct MarchProgress<'a> {
    /// Who is told, and may stop it.
    pub observer: &'a dyn Observer,
    /// What the march is part of, for people.
    pub stage: String,
    /// Its duration.
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

/// One step: what the rows of any model need to know of it.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// The equations at its end.
    pub now: Conditions,
    /// Scales at its beginning and one step before.
    pub former: [Scales; 2],
    /// Its difference quotient.
    pub quotient: BackwardDifference,
    /// Its length over that of the former step.
    pub ratio: f64,
    /// ȧ/a of the moving nodes by the same quotient as everything else, so that nodes in motion alone change no field;
    /// 0 in the other frames.
    pub growth: f64,
}

/// A model of the contact that can be taken through time. It holds its present state, two former ones, and the one
/// under trial.
pub trait Marching {
    /// The grid its fields live on.
    fn grid(&self) -> &LineGrid;

    /// Finds the stationary state at the start, where the contact has rested for ever.
    ///
    /// # Errors
    /// With the reason why the iteration stopped.
    fn rest(&mut self, at: &Conditions, observer: &dyn Observer) -> Result<Effort, Termination>;

    /// Solves for the end of a step, from the extrapolation of the former states.
    ///
    /// # Errors
    /// With the reason why the iteration stopped; the former states are as before.
    fn step(&mut self, step: &Step, observer: &dyn Observer) -> Result<Effort, Termination>;

    /// ‖P − extrapolation‖/‖P‖ of the step under trial.
    fn deviation(&self) -> f64;

    /// Makes the step under trial, which led to `at`, a former one.
    fn accept(&mut self, at: &Conditions);

    /// Scalars of the state found last.
    fn moment(&self, at: &Conditions, step: f64, effort: Effort) -> Moment;

    /// Fields of the state found last.
    fn state(&self, at: &Conditions) -> State;
}

/// Most steps of one march.
const MOST_STEPS: f64 = 2e6;
/// Shares of H_c that steps can be controlled by: rounding and Newton's tolerance are felt below.
const FINEST_CONTROL: f64 = 1e-5;
const COARSEST_CONTROL: f64 = 0.3;

impl Transient {
    /// A contact with the lubricant laws of the default, in the fixed frame, with equal steps; no fields are kept.
    pub fn new(point: OperatingPoint, inputs: Inputs, duration: f64, step: f64) -> Self {
        let (lubricant, time_step) = (Lubricant::default(), TimeStep::Fixed(step));
        Self { point, lubricant, inputs, frame: Frame::Fixed, duration, time_step, keep: Keep::Scalars }
    }

    /// Refuses inputs and times without sense.
    ///
    /// # Errors
    /// With what is wrong.
    pub fn check(&self) -> Result<(), TransientError> {
        let refuse = |quantity: &str, value: f64, accepted: &str| {
            let value = Number(value);
            Err(TransientError::Time(format!("the {quantity} is {value}, but must be {accepted}")))
        };
        let positive = |quantity, value: f64| {
            let fine = value.is_finite() && value > 0.0;
            if fine { Ok(()) } else { refuse(quantity, value, "a finite number above zero") }
        };
        positive("duration", self.duration)?;
        match self.time_step {
            TimeStep::Fixed(_) => {}
            TimeStep::Adaptive { tolerance, .. } => positive("tolerance of the time step", tolerance)?,
            TimeStep::Controlled(tolerance) if (FINEST_CONTROL..=COARSEST_CONTROL).contains(&tolerance) => {}
            TimeStep::Controlled(tolerance) => {
                let accepted = format!("between {FINEST_CONTROL:e} and {COARSEST_CONTROL}");
                return refuse("tolerance of controlled time steps", tolerance, &accepted);
            }
        }
        let longest = self.time_step.longest(self.duration);
        positive("time step", longest)?;
        if longest > self.duration || self.duration / longest > MOST_STEPS {
            let accepted = format!("between {:e} and the duration {}", self.duration / MOST_STEPS, self.duration);
            return refuse("time step", longest, &accepted);
        }
        Ok(self.inputs.check(self.duration)?)
    }

    /// The reference problem.
    ///
    /// # Errors
    /// When the contact, the inputs, the times or the lubricant is refused.
    pub fn problem(&self) -> Result<Problem, TransientError> {
        self.check()?;
        Unsupported::check(self.point.kind, &self.lubricant)?;
        Ok(Problem::new(&self.point, self.lubricant)?)
    }
}

impl Step {
    /// The step to `now` after the states at `former` conditions. The first step of a march has no former one: its
    /// `step_before` is its own.
    pub fn new(frame: Frame, now: Conditions, former: [Scales; 2], step: f64, step_before: f64) -> Self {
        let quotient = BackwardDifference::second_order(step, step_before);
        let growth = match frame {
            Frame::ArbitraryLagrangianEulerian => {
                quotient.of([now.scales.half_width, former[0].half_width, former[1].half_width]) / now.scales.half_width
            }
            Frame::Fixed | Frame::Remeshed(_) => 0.0,
        };
        Self { now, former, quotient, ratio: step / step_before, growth }
    }

    /// Velocity of the flow relative to the node at X.
    #[inline]
    pub fn velocity(&self, x: f64) -> f64 {
        self.now.speed - self.growth * x
    }

    /// Weights of the former ρ̄H, the nearer one first: (R/a²) ∂/∂T of (a²/R) ρ̄H, which is ∂(ρ̄H)/∂T with the growth
    /// of the scale of H.
    pub fn history_weights(&self) -> [f64; 2] {
        std::array::from_fn(|i| self.quotient.former[i] * self.former[i].film / self.now.scales.film)
    }
}

/// Takes a model through time.
///
/// # Errors
/// When the contact, the inputs, the times or the lubricant is refused. A march that ends early is an answer: it says
/// when and why.
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

/// Takes a model through time with steps by a rule.
pub(super) fn march_once(
    model: &mut dyn Marching,
    transient: &Transient,
    rule: Rule,
    observer: &dyn TransientObserver,
) -> Result<Trajectory, TransientError> {
    let mut trajectory = Trajectory { rule, ..Trajectory::begun(transient, model.grid())? };
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
        // Adaptive steps may become shorter than the longest.
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
    /// The trajectory of a contact on a grid before its first moment.
    ///
    /// # Errors
    /// When the contact, the inputs, the times or the lubricant is refused.
    pub fn begun(transient: &Transient, grid: &LineGrid) -> Result<Self, TransientError> {
        Ok(Self {
            transient: transient.clone(),
            rule: transient.time_step.rule(transient.duration),
            problem: transient.problem()?,
            mesh: Mesh { spec: grid.reference.spec, scale: grid.scale },
            x: grid.x.clone(),
            moments: Vec::new(),
            states: Vec::new(),
            rejected_steps: 0,
            step_error: None,
            ended: Ended::Finished,
        })
    }

    /// Adds the state found last, and tells of it.
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
