//! Time integration of a reduced transient model. Newton's method solves the sampled equations of each step, from a start
//! extrapolated from the two previous steps. A model may have a whole basis and local ones; a step uses the basis nearest
//! to its state.

use super::model::{TrajectoryModel, TrajectoryStart};
use super::nearest::Nearest;
use super::part::Part;
use crate::solver::discrete::elasticity::{PointScratch, Scratch};
use crate::solver::discrete::grid::{ContactGrid, add_gap, dot};
use crate::solver::full::transient::{
    Conditions, Effort, Frame, History, Input, Marching, Moment, Signal, State, Step, Transient,
};
use crate::solver::full::{Mesh, Scalars, Termination};
use crate::solver::observer::Observer;
use crate::solver::parameters::distance;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::operators::{Case, Iterate, Start, Stop, cut_off};
use crate::solver::reduced::{ReducedError, Window, dense};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Stopping tolerance of a step for ‖Δp̃‖/‖p̃‖, with the pressure coefficients p̃.
const TOLERANCE: f64 = 1e-6;
/// Maximum number of Newton steps of a time step, and of the steady start.
const MOST_NEWTON: [usize; 2] = [15, 60];
/// Successive attempts to solve a step: whether the cavitation boundary is active, and the factor on the model's penalty.
/// If the boundary fails, the penalty is used, then a smaller one.
const ATTEMPTS: [(bool, f64); 3] = [(true, 1.0), (false, 1.0), (false, 0.1)];
/// Minimum number of steps in a basis. Both previous states are then of this basis, so that no state is projected
/// twice.
const LEAST_STAY: usize = 2;
/// Index of the whole basis, the one of all training states.
const WHOLE: usize = 0;

/// Observer of all iterates of all steps; receives the number of their basis.
pub(crate) type StepObserver<'a> = Box<dyn FnMut(usize, &Iterate<'_>) + 'a>;

/// Time integrator of a reduced model.
pub struct ReducedMarch<'a> {
    model: Arc<TrajectoryModel>,
    grid: ContactGrid,
    /// Whole basis, then the local ones.
    parts: Vec<Part>,
    nearest: Nearest,
    /// Index of the basis of the current states, and number of steps taken in it.
    number: usize,
    stayed: usize,
    /// Previous states.
    history: History,
    /// Pressure coefficients and rigid-body separation H₀ of the current state, and initial guess of the coefficients.
    coefficients: Vec<f64>,
    start: Vec<f64>,
    h_0: f64,
    /// 1 + H₀(T) − H₀(0), if H₀ and not the load is prescribed.
    separation: Option<Signal>,
    /// H₀(0).
    h_0_of_start: f64,
    /// True if the present solve keeps H₀ and computes the load.
    prescribed: bool,
    /// Conditions of the two previous states, the most recent first; `None` before the steady start.
    at: Option<[Conditions; 2]>,
    /// Cavitation boundaries of these states, and the initial guess of a step; empty with a penalty.
    fronts: [Vec<usize>; 2],
    front: Vec<usize>,
    /// Nodes beyond the cavitation boundary, with the pressures of the modes there, which count as zero.
    cut: Vec<(usize, f64)>,
    /// P and H at all nodes, used only for remeshing and for a change of the basis.
    fields: [Vec<f64>; 2],
    fft: Scratch,
    /// Scalars of the current state.
    scalars: Scalars,
    observer: Option<StepObserver<'a>>,
}

/// Previous states, and the index of their basis.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct StepState {
    pub history: History,
    fronts: [Vec<usize>; 2],
    number: usize,
    stayed: usize,
}

impl StepState {
    /// Copies another state without allocating, if the capacity suffices.
    pub fn copy_from(&mut self, other: &Self) {
        self.history.copy_from(&other.history);
        self.fronts.iter_mut().zip(&other.fronts).for_each(|(own, other)| own.clone_from(other));
        (self.number, self.stayed) = (other.number, other.stayed);
    }
}

impl<'a> ReducedMarch<'a> {
    /// Prepares the model for a march along `transient`.
    ///
    /// # Errors
    /// [`ReducedError`] if the kinds of contact or the cavitation models differ.
    pub fn new(model: &Arc<TrajectoryModel>, transient: &Transient) -> Result<Self, ReducedError> {
        let (own, given) = (model.window.grid.kind(), transient.point.kind);
        if own != given {
            return Err(ReducedError::OtherContact { model: own, given });
        }
        let (own, given) = (model.domain.reference.lubricant.cavitation, transient.lubricant.cavitation);
        if own != given {
            return Err(ReducedError::OtherCavitation { model: own, given });
        }
        Ok(Self { separation: transient.separation.clone(), ..Self::on(model) })
    }

    /// Prepares the model for any march.
    pub(super) fn on(model: &Arc<TrajectoryModel>) -> Self {
        let grid = model.window.grid.clone();
        let parts: Vec<Part> = (WHOLE..=model.locals.len()).map(|number| Part::new(model.numbered(number))).collect();
        let modes = model.window.pressure.count();
        let rows = parts.iter().map(|part| part.x.len()).max().unwrap_or(0);
        Self {
            nearest: Nearest::new(model),
            number: WHOLE,
            stayed: 0,
            history: History::with_room(modes, rows),
            coefficients: vec![0.0; modes],
            start: vec![0.0; modes],
            h_0: 0.0,
            separation: None,
            h_0_of_start: 0.0,
            prescribed: false,
            at: None,
            fronts: [Vec::new(), Vec::new()],
            front: Vec::new(),
            cut: Vec::with_capacity(rows),
            fields: [vec![0.0; grid.len()], vec![0.0; grid.len()]],
            fft: Scratch::default(),
            scalars: Scalars::default(),
            parts,
            grid,
            observer: None,
            model: Arc::clone(model),
        }
    }

    /// Copies the current state to `kept` without allocating, if the capacity suffices.
    pub(super) fn keep(&self, kept: &mut StepState) {
        kept.history.copy_from(&self.history);
        kept.fronts.iter_mut().zip(&self.fronts).for_each(|(kept, own)| kept.clone_from(own));
        (kept.number, kept.stayed) = (self.number, self.stayed);
    }

    /// Restores states stored by [`Self::keep`], with the conditions `at`, the most recent first.
    pub(super) fn restore(&mut self, kept: &StepState, at: [Conditions; 2]) {
        self.history.copy_from(&kept.history);
        self.fronts.iter_mut().zip(&kept.fronts).for_each(|(own, kept)| own.clone_from(kept));
        (self.number, self.stayed, self.at) = (kept.number, kept.stayed, Some(at));
        self.make_room();
        let (coefficients, h_0) = self.history.nearer();
        self.coefficients.copy_from_slice(coefficients);
        self.h_0 = h_0;
    }

    /// Returns true if the sizes of stored states fit this model.
    pub(super) fn knows(&self, kept: &StepState) -> bool {
        let Some(part) = self.parts.get(kept.number) else { return false };
        let between = if matches!(self.model.frame, Frame::Remeshed(_)) { self.grid.len() } else { 0 };
        let lines = if self.model.window.cavitation == Cavitation::Penalty { 0 } else { self.grid.lines() };
        let mut fronts = kept.fronts.iter();
        kept.history.is_of(part.operators.modes(), part.x.len(), between)
            && fronts.all(|own| own.len() == lines && own.iter().all(|front| *front <= self.grid.len()))
    }

    /// Returns the rigid-body separation H₀ of the current state.
    pub(super) fn h_0(&self) -> f64 {
        self.h_0
    }

    /// Passes every iterate to an observer, for training.
    pub(crate) fn observe(&mut self, observer: StepObserver<'a>) {
        self.observer = Some(observer);
    }

    /// Resizes the coefficients to the number of modes of the current basis.
    fn make_room(&mut self) {
        let modes = self.parts[self.number].operators.modes();
        self.coefficients.resize(modes, 0.0);
        self.start.resize(modes, 0.0);
    }

    /// Converts the previous states to another basis: pressures to its modes, mass flow ρ̄H to its rows.
    fn change_to(&mut self, number: usize) {
        let (Some(at), true) = (self.at, number != self.number) else { return };
        let mut fields = std::mem::take(&mut self.fields);
        let mut fft = std::mem::take(&mut self.fft);
        let window = self.model.numbered(number);
        for (which, at) in at.iter().enumerate() {
            let (coefficients, h_0) = self.history.former(which);
            self.spread(at, (coefficients, h_0, &self.fronts[which]), &mut fields, &mut fft);
            let [pressure, film] = &mut fields;
            let fluid = &at.problem.fluid;
            let rows = self.parts[number].nodes.iter();
            let flow = rows.map(|&node| fluid.at(pressure[node]).density * film[node]);
            self.start.resize(window.pressure.count(), 0.0);
            self.history.give_flow(which, flow);
            pressure.iter_mut().zip(window.grid.weights()).for_each(|(p, w)| *p *= w);
            dense::times(window.pressure.basis().modes.transpose(), pressure, &mut self.start);
            self.history.give_state(which, &self.start);
        }
        (self.fields, self.fft) = (fields, fft);
        (self.number, self.stayed) = (number, 0);
        self.make_room();
    }

    /// Changes to the basis nearest to the extrapolated state.
    fn change_to_nearest(&mut self, ratio: f64) {
        if self.stayed < LEAST_STAY || self.model.locals.is_empty() {
            return;
        }
        self.history.extrapolate(ratio, &mut self.start);
        let serving = self.nearest.serving(self.number, &self.start);
        self.change_to(serving);
    }

    /// Runs Newton's method for the end of a step, in the current basis.
    fn solve(&mut self, step: &Step) -> Result<Effort, Termination> {
        let part = &mut self.parts[self.number];
        self.history.carry(self.model.frame, step, self.grid.abscissae().0, &part.x);
        part.set_rows(step, &self.history);
        self.h_0 = self.history.extrapolate(step.ratio, &mut self.start);
        if let Some(separation) = &self.separation {
            self.h_0 = self.h_0_of_start + separation.at(step.now.time) - 1.0;
        }
        self.front.clone_from(&self.fronts[0]);
        self.newton(&step.now, MOST_NEWTON[0])
    }

    /// Runs Newton's method from the current state. After a failure it is repeated from `start`, without the
    /// cavitation boundary and then with a smaller penalty.
    fn newton(&mut self, at: &Conditions, max_newton: usize) -> Result<Effort, Termination> {
        let (h_0, number) = (self.h_0, self.number);
        let window = self.model.numbered(number);
        let Part { operators, .. } = &mut self.parts[number];
        let mut effort = Effort::default();
        let attempts = if self.front.is_empty() { &ATTEMPTS[1..] } else { &ATTEMPTS[..] };
        for (held, softness) in attempts {
            let case = Case { prescribed: self.prescribed, ..case(at, softness * window.penalty, max_newton) };
            let fronts = held.then_some(self.front.as_slice());
            operators.begin(&case, &Start { window, modes: usize::MAX, fronts, held: false, theta: &[] });
            self.coefficients.copy_from_slice(&self.start);
            self.h_0 = h_0;
            let state = (self.coefficients.as_mut_slice(), &mut self.h_0);
            let outcome = match &mut self.observer {
                Some(observer) => {
                    operators.aim(window, 1.0);
                    let mut shown = |iterate: &Iterate<'_>| observer(number, iterate);
                    operators.newton(&case, state, Some(&mut shown))
                }
                None => operators.newton(&case, state, None),
            };
            effort.newton_iterations += outcome.iterations;
            if outcome.converged {
                return Ok(effort);
            }
        }
        Err(Termination::Diverged)
    }

    /// Stores the current state as the most recent previous one.
    fn remember(&mut self, at: &Conditions) {
        let operators = &mut self.parts[self.number].operators;
        self.history.remember(&self.coefficients, self.h_0, operators.flow());
        let readings = operators.read(&case(at, 0.0, 0), &self.coefficients, self.h_0);
        self.at = Some([*at, self.at.map_or(*at, |[nearer, _]| nearer)]);
        self.stayed += 1;
        self.fronts.swap(0, 1);
        self.fronts[0].clear();
        self.fronts[0].extend_from_slice(&readings.fronts);
        self.cut.clear();
        self.cut.extend_from_slice(&readings.cut);
        if let Frame::Remeshed(interpolation) = self.model.frame {
            let mut fields = std::mem::take(&mut self.fields);
            let mut fft = std::mem::take(&mut self.fft);
            self.set_fields(at, &mut fields, &mut fft);
            (self.fields, self.fft) = (fields, fft);
            let [pressure, film] = &self.fields;
            let fluid = &at.problem.fluid;
            let flow = pressure.iter().zip(film).map(|(&p, &h)| fluid.at(p).density * h);
            self.history.remember_between(interpolation, self.grid.abscissae().0, flow);
        }
        let (cut, grid) = (&self.cut, &self.grid);
        let bend = |node| -cut.iter().map(|&(other, value)| grid.kernel_entry(node, other) * value).sum::<f64>();
        self.scalars = self.parts[self.number].contact.scalars(at, &self.coefficients, self.h_0, bend);
    }

    /// Computes P and H of the current state at all nodes.
    fn set_fields(&self, at: &Conditions, fields: &mut [Vec<f64>; 2], fft: &mut Scratch) {
        self.spread(at, (&self.coefficients, self.h_0, &self.fronts[0]), fields, fft);
    }

    /// Computes P and H at all nodes for a state of the current basis, its H₀ and its cavitation boundary.
    fn spread(
        &self,
        at: &Conditions,
        (coefficients, h_0, fronts): (&[f64], f64, &[usize]),
        [pressure, film]: &mut [Vec<f64>; 2],
        fft: &mut Scratch,
    ) {
        let window: &Window = self.model.numbered(self.number);
        window.pressure.field(coefficients, false, pressure);
        if fronts.is_empty() {
            dense::times(window.pressure.flexed().as_ref(), coefficients, film);
        } else {
            cut_off(&window.grid, fronts, pressure);
            match &self.grid {
                ContactGrid::Line(grid) => grid.flexibility.apply(pressure, film, fft),
                ContactGrid::Point(grid) => grid.deform(pressure, film, &mut PointScratch::default()),
            }
        }
        add_gap(film, self.grid.abscissae(), h_0, at.curvature);
    }
}

/// Returns the problem for Newton's method at the end of a step.
fn case(at: &Conditions, penalty: f64, max_newton: usize) -> Case<'_> {
    let stop = Stop::new(TOLERANCE, max_newton);
    Case { problem: &at.problem, scale: 1.0, curvature: at.curvature, penalty, prescribed: false, stop }
}

impl Marching for ReducedMarch<'_> {
    fn mesh(&self) -> Mesh {
        Mesh { spec: self.grid.spec(), scale: 1.0 }
    }

    fn abscissae(&self) -> &[f64] {
        self.grid.abscissae().0
    }

    fn rest(&mut self, at: &Conditions, _: &dyn Observer) -> Result<Effort, Termination> {
        let moes = at.problem.moes;
        let far = |start: &TrajectoryStart| {
            let (own, given) = (start.inputs.at(0.0), at.input);
            distance(moes, start.point.moes()) + (own.load - given.load).powi(2) + (own.speed - given.speed).powi(2)
        };
        let nearest = self.model.starts.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        let Some(nearest) = nearest else { return Err(Termination::Diverged) };
        (self.number, self.at) = (WHOLE, None);
        self.start.clone_from(&nearest.coefficients);
        self.front.clone_from(&nearest.fronts);
        self.h_0 = nearest.h_0;
        self.make_room();
        self.parts[WHOLE].rest(at);
        self.prescribed = false;
        let effort = self.newton(at, MOST_NEWTON[1])?;
        (self.h_0_of_start, self.prescribed) = (self.h_0, self.separation.is_some());
        self.remember(at);
        self.history.rest();
        self.fronts[1] = self.fronts[0].clone();
        self.stayed = LEAST_STAY;
        Ok(effort)
    }

    fn step(&mut self, step: &Step, observer: &dyn Observer) -> Result<Effort, Termination> {
        if observer.cancelled() {
            return Err(Termination::Cancelled);
        }
        self.change_to_nearest(step.ratio);
        match self.solve(step) {
            Err(_) if self.number != WHOLE => {
                self.change_to(WHOLE);
                self.solve(step)
            }
            outcome => outcome,
        }
    }

    fn deviation(&self) -> f64 {
        // The basis is orthonormal under the weights.
        let differences = self.coefficients.iter().zip(&self.start).map(|(c, s)| (c - s) * (c - s));
        (differences.sum::<f64>() / dot(&self.coefficients, &self.coefficients)).sqrt()
    }

    fn accept(&mut self, at: &Conditions) {
        self.remember(at);
    }

    fn moment(&self, at: &Conditions, step: f64, effort: Effort) -> Moment {
        let mut at = *at;
        if self.separation.is_some() {
            let reference = at.problem.load / at.input.load;
            let load = self.parts[self.number].operators.carried(&self.coefficients) / reference;
            at.input = Input { load, ..at.input };
        }
        Moment::of_scalars(&at, step, &self.scalars, effort)
    }

    fn state(&self, at: &Conditions) -> State {
        let mut fields = [vec![0.0; self.grid.len()], vec![0.0; self.grid.len()]];
        self.set_fields(at, &mut fields, &mut Scratch::default());
        let [pressure, film] = fields;
        let (multiplier, fraction) = (Vec::new(), Vec::new());
        State { time: at.time, scales: at.scales, pressure, film, multiplier, fraction, h_0: self.h_0 }
    }
}
