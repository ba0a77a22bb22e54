//! Time integration of a trajectory-piecewise-linear model. A step adds up the weighted linearised systems of the
//! operating points near its state and solves one small linear system. Its cost does not depend on the number of nodes
//! of the grid, and it allocates nothing.

use super::model::{TpwlError, TpwlModel, check_frame};
use super::record::{TpwlRecord, TpwlStep};
use super::search::Search;
use super::space::{INPUTS, input_vector};
use super::superposition::Superposition;
use super::weights::{Weight, Weighting, square_distance};
use crate::solver::full::transient::{
    Conditions, Effort, Marching, Moment, State, Step, Trajectory, Transient, TransientObserver, extrapolated, march,
};
use crate::solver::full::{Mesh, Scalars, Termination};
use crate::solver::observer::Observer;
use crate::solver::reduced::contact_rows::ContactRows;
use crate::solver::reduced::dense::SmallSystem;

/// Time integrator of a model for one contact.
pub struct TpwlMarch<'a> {
    model: &'a TpwlModel,
    /// Reference load \[N/m\].
    load: f64,
    /// Two previous states, the most recent first.
    former: [Past; 2],
    /// State at the end of the current step.
    trial: Past,
    /// State at which the weights are computed: the previous states, extrapolated to the end of the step.
    start: Vec<f64>,
    search: Search,
    superposition: Superposition,
    system: SmallSystem,
    /// Entry of the record for the current step.
    step: TpwlStep,
    /// Data from which the scalars of a state are computed.
    contact: ContactRows,
    /// Scalars of the last state.
    scalars: Scalars,
    /// All steps so far.
    record: TpwlRecord,
}

/// Reduced state y and its mass flow g(y), (4.16).
#[derive(Clone, Debug)]
struct Past {
    /// y: pressure coefficients and H₀.
    state: Vec<f64>,
    /// g(y).
    storage: Vec<f64>,
}

/// Stopping tolerance of the iteration for the steady start, for ‖Δy‖/‖y‖.
const REST_TOLERANCE: f64 = 1e-9;
/// Number of iterations for the steady start after which all changes are halved. The weights could oscillate otherwise.
const REST_PLAIN: usize = 15;
/// Maximum number of iterations for the steady start.
const REST_ITERATIONS: usize = 60;
/// Largest accepted change in the last iteration for the steady start.
const REST_ACCEPTED: f64 = 1e-3;
/// Number of equal intervals of the duration at whose ends the speed is checked.
const SPEED_CHECKS: usize = 2000;

/// Simulates a contact in time with a model.
///
/// # Errors
/// [`TpwlError`] if the contact, the inputs or the times are refused, or if the model was not trained for them.
pub fn solve(
    model: &TpwlModel,
    transient: &Transient,
    weighting: Weighting,
    observer: &dyn TransientObserver,
) -> Result<(Trajectory, TpwlRecord), TpwlError> {
    let mut marching = TpwlMarch::new(model, transient, weighting)?;
    let trajectory = march(&mut marching, transient, observer)?;
    Ok((trajectory, marching.record))
}

impl<'a> TpwlMarch<'a> {
    /// Prepares the model for one contact.
    ///
    /// # Errors
    /// [`TpwlError`] if the contact, the inputs or the times are refused, or if the model was not trained for them.
    pub fn new(model: &'a TpwlModel, transient: &Transient, weighting: Weighting) -> Result<Self, TpwlError> {
        let problem = transient.problem()?;
        check_frame(transient.frame)?;
        let watched = (0..=SPEED_CHECKS).map(|k| transient.duration * k as f64 / SPEED_CHECKS as f64);
        if let Some(time) = watched.into_iter().find(|&time| transient.inputs.speed.at(time) <= 0.0) {
            return Err(TpwlError::reversal(transient.inputs.speed.at(time), time));
        }
        let search = Search::new(model, weighting, model.shares(&problem)?);
        let (len, most) = (model.space.len(), search.most_weights());
        let past = || Past { state: vec![0.0; len], storage: vec![0.0; len] };
        let step = transient.time_step.longest(transient.duration);
        let steps = (transient.duration / step).ceil() as usize + 2;
        Ok(Self {
            model,
            load: problem.point.load,
            former: [past(), past()],
            trial: past(),
            start: vec![0.0; len],
            superposition: Superposition::new(weighting, len, most),
            system: SmallSystem::new(len),
            step: TpwlStep::default(),
            contact: model.space.grid.contact_rows(model.space.pressure.as_ref(), model.space.deformation.as_ref()),
            scalars: Scalars::default(),
            record: TpwlRecord::with_room(steps, most.min(8), len),
            search,
        })
    }

    /// Returns the operating points used in each step so far.
    pub fn record(&self) -> &TpwlRecord {
        &self.record
    }

    /// Computes weights and superposition at `start`.
    fn superpose(&mut self, time: f64) {
        self.search.weights(self.model, &self.start, &mut self.superposition.weights);
        self.assemble(time);
    }

    /// Computes the superposition for the current weights, and the entry of the record.
    fn assemble(&mut self, time: f64) {
        self.superposition.assemble(self.model, self.load);
        let weights = self.superposition.weights.iter();
        self.step = TpwlStep {
            time,
            distance: square_distance(&self.start, &self.superposition.state).sqrt(),
            spacing: weights.map(|w| w.weight * self.model.points[w.point].spacing).sum(),
        };
    }

    /// Solves the superposed system for `trial`. `now` and `former` are the weights of the difference quotient in time
    /// for the new state and the previous ones; all are 0 for the steady state.
    fn advance(&mut self, now: f64, former: [f64; 2], input: [f64; INPUTS]) -> Result<(), Termination> {
        let Self { superposition, system, trial, former: [near, far], .. } = self;
        let history = [(former[0], near.storage.as_slice()), (former[1], far.storage.as_slice())];
        let solved = superposition.solve((now, history), input, system, (&mut trial.state, &mut trial.storage));
        if solved { Ok(()) } else { Err(Termination::Diverged) }
    }

    /// Sets the initial guess of the steady state: for each training load in use, the operating point with the nearest
    /// inputs. Returns true if all these points have exactly the given inputs.
    fn guess(&mut self, input: [f64; INPUTS]) -> bool {
        self.start.fill(0.0);
        self.superposition.weights.clear();
        let mut met = true;
        for &(set, share) in self.search.shares() {
            let points = self.model.sets[set].points.iter().map(|&point| (point, &self.model.points[point]));
            let apart = |of: [f64; INPUTS]| square_distance(&of, &input);
            if let Some((number, point)) = points.min_by(|(_, a), (_, b)| apart(a.input).total_cmp(&apart(b.input))) {
                self.start.iter_mut().zip(&point.moment.state).for_each(|(y, own)| *y += share * own);
                self.superposition.weights.push(Weight { point: number, weight: share });
                met &= point.input == input;
            }
        }
        met
    }

    /// Records the state at the end of the step and its scalars.
    fn keep(&mut self, at: &Conditions) {
        self.record.push(self.step, &self.superposition.weights, &self.trial.state);
        let (coefficients, h_0) = self.trial.state.split_at(self.model.space.modes());
        self.scalars = self.contact.scalars(at, coefficients, h_0[0], |_| 0.0);
    }
}

/// Returns ‖a − b‖/‖a‖ over the first `modes` entries. This is the norm of the pressures, since their modes are
/// orthonormal.
fn relative_change(a: &[f64], b: &[f64], modes: usize) -> f64 {
    let square = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>();
    (square_distance(&a[..modes], &b[..modes]) / square(&a[..modes])).sqrt()
}

/// Effort of a step: one linear system.
const LINEAR: Effort = Effort { newton_iterations: 1, linear_iterations: 0 };

impl Marching for TpwlMarch<'_> {
    fn mesh(&self) -> Mesh {
        self.model.space.grid.mesh()
    }

    fn abscissae(&self) -> &[f64] {
        self.model.space.grid.abscissae().0
    }

    fn rest(&mut self, at: &Conditions, observer: &dyn Observer) -> Result<Effort, Termination> {
        let (input, modes) = (input_vector(at.input), self.model.space.modes());
        // If a training started with the same inputs, the steady state is one of its operating points. Otherwise
        // weights and state are iterated.
        let met = self.guess(input);
        self.assemble(at.time);
        self.advance(0.0, [0.0; 2], input)?;
        let mut change = if met { 0.0 } else { f64::INFINITY };
        let mut effort = LINEAR;
        while change > REST_TOLERANCE && effort.newton_iterations < REST_ITERATIONS {
            if observer.cancelled() {
                return Err(Termination::Cancelled);
            }
            self.superpose(at.time);
            self.advance(0.0, [0.0; 2], input)?;
            change = relative_change(&self.trial.state, &self.start, modes);
            let share = if effort.newton_iterations < REST_PLAIN { 1.0 } else { 0.5 };
            self.start.iter_mut().zip(&self.trial.state).for_each(|(y, new)| *y += share * (new - *y));
            effort.newton_iterations += 1;
        }
        if change > REST_ACCEPTED {
            return Err(Termination::IterationLimit);
        }
        self.former = [self.trial.clone(), self.trial.clone()];
        self.record.clear();
        self.keep(at);
        Ok(effort)
    }

    fn step(&mut self, step: &Step, _observer: &dyn Observer) -> Result<Effort, Termination> {
        let [near, far] = &self.former;
        for (start, (near, far)) in self.start.iter_mut().zip(near.state.iter().zip(&far.state)) {
            *start = extrapolated(step.ratio, *near, *far);
        }
        self.superpose(step.now.time);
        self.advance(step.quotient.now, step.quotient.former, input_vector(step.now.input))?;
        Ok(LINEAR)
    }

    fn deviation(&self) -> f64 {
        relative_change(&self.trial.state, &self.start, self.model.space.modes())
    }

    fn accept(&mut self, at: &Conditions) {
        self.keep(at);
        self.former.swap(0, 1);
        std::mem::swap(&mut self.former[0], &mut self.trial);
    }

    fn moment(&self, at: &Conditions, step: f64, effort: Effort) -> Moment {
        Moment::of_scalars(at, step, &self.scalars, effort)
    }

    fn state(&self, at: &Conditions) -> State {
        let length = self.model.space.grid.len();
        let (mut pressure, mut film) = (vec![0.0; length], vec![0.0; length]);
        let state = &self.former[0].state;
        self.model.space.fields(state, at.input, &mut pressure, &mut film);
        State {
            time: at.time,
            scales: at.scales,
            pressure,
            film,
            multiplier: Vec::new(),
            fraction: Vec::new(),
            h_0: state[self.model.space.modes()],
        }
    }
}
