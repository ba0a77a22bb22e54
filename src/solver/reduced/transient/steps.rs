//! The online phase in time: Newton on the sampled rows from the extrapolation of the two former steps.

use super::model::{TrajectoryModel, TrajectoryStart};
use crate::solver::discrete::elasticity::Scratch;
use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid, ReferenceGrid, dot};
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::full::transient::{Conditions, Effort, Frame, History, Marching, Moment, State, Step, Transient};
use crate::solver::full::{Scalars, Termination};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::contact_rows::ContactRows;
use crate::solver::reduced::operators::{Case, Iterate, Operators, RowObserver, Stop, cut_off, passed_rows};
use crate::solver::reduced::{ReducedError, distance};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, Par};
use std::sync::Arc;

/// Stop of a step on ‖Δp̃‖/‖p̃‖.
const TOLERANCE: f64 = 1e-6;
/// Newton steps of a time step, and of the stationary start.
const MOST_NEWTON: [usize; 2] = [15, 60];
/// How a step is tried: whether a rupture boundary, where there is one, is in force, and the penalty factor over the
/// model's own. A boundary that finds no place gives way to the penalty, that to a softer one.
const ATTEMPTS: [(bool, f64); 3] = [(true, 1.0), (false, 1.0), (false, 0.1)];

/// Sees every iterate of every step.
pub(crate) type StepObserver<'a> = Box<dyn FnMut(&Iterate<'_>) + 'a>;

/// A reduced model, ready to march.
pub struct ReducedMarch<'a> {
    model: Arc<TrajectoryModel>,
    grid: LineGrid,
    operators: Operators,
    /// Stencils of the sampled rows, and of those that the rupture boundary may pass, and their coefficients, for a flow
    /// from the inlet and from the outlet.
    sides: Vec<[Side; 2]>,
    /// X of these rows' own nodes.
    x: Vec<f64>,
    /// K V_p at X = 0.
    lift: Vec<f64>,
    history: History,
    coefficients: Vec<f64>,
    start: Vec<f64>,
    h_0: f64,
    /// Where the film ruptures in the present state, and where a step begins; empty under a penalty.
    fronts: Vec<usize>,
    front: Vec<usize>,
    /// What of the modes' pressures the boundary takes away, by nodes.
    cut: Vec<(usize, f64)>,
    /// P and H at all nodes, which only remeshing asks for.
    fields: [Vec<f64>; 2],
    fft: Scratch,
    contact: ContactRows,
    /// Scalars of the present state.
    scalars: Scalars,
    observer: Option<StepObserver<'a>>,
}

/// How a row reads its neighbours.
#[derive(Clone, Copy, Default)]
struct Side {
    stencil: [usize; STENCIL],
    geometry: RowGeometry,
}

impl<'a> ReducedMarch<'a> {
    /// The model on its grid, to march along `transient`.
    ///
    /// # Errors
    /// When the model is of point contacts, or of films that rupture otherwise.
    pub fn new(model: &Arc<TrajectoryModel>, transient: &Transient) -> Result<Self, ReducedError> {
        let (own, given) = (model.window.cavitation, transient.lubricant.cavitation);
        if own != given {
            return Err(ReducedError::OtherRupture { model: own, given });
        }
        Self::on(model)
    }

    /// The model on its grid, whatever it is to march along.
    ///
    /// # Errors
    /// When the model is of point contacts.
    pub(super) fn on(model: &Arc<TrajectoryModel>) -> Result<Self, ReducedError> {
        let reference = line_grid(model)?;
        let grid = reference.scaled(1.0);
        let window = &model.window;
        let modes = window.pressure.count();
        let (unknowns, last) = (grid.unknowns(), grid.len() - 1);
        let rows: Vec<usize> = window.sampled_rows.iter().copied().chain(passed_rows(window)).collect();
        let further: Vec<usize> = rows.iter().map(|row| (row + 4).min(last)).collect();
        let mut operators = Operators::with_support(window, modes, None, false, &further);
        operators.stride();
        let place = |node: usize| operators.place(node);
        let side = |row: usize, velocity: f64| {
            let upstream = Upstream::of(velocity, row, unknowns);
            Side { stencil: upstream.stencil(row).map(place), geometry: upstream.geometry(&grid.x, row) }
        };
        let sides: Vec<[Side; 2]> = rows.iter().map(|&row| [side(row, 1.0), side(row, -1.0)]).collect();
        let (first, weights) = grid.interpolation(0.0);
        let at_zero =
            |k: usize| weights.iter().enumerate().map(|(m, w)| w * window.pressure.flexed()[(first + m, k)]).sum();
        Ok(Self {
            x: rows.iter().map(|row| grid.x[row + FIRST_UNKNOWN]).collect(),
            lift: (0..modes).map(at_zero).collect(),
            sides,
            operators,
            history: History::default(),
            coefficients: vec![0.0; modes],
            start: vec![0.0; modes],
            h_0: 0.0,
            fronts: Vec::new(),
            front: Vec::new(),
            cut: Vec::with_capacity(rows.len()),
            fields: [vec![0.0; grid.len()], vec![0.0; grid.len()]],
            fft: Scratch::default(),
            contact: ContactRows::new(&grid, window.pressure.basis().modes.as_ref(), window.pressure.flexed().as_ref()),
            scalars: Scalars::default(),
            grid,
            observer: None,
            model: Arc::clone(model),
        })
    }

    /// Writes the present state down, in the room there is.
    pub(super) fn keep(&self, history: &mut History, fronts: &mut Vec<usize>) {
        history.copy_from(&self.history);
        fronts.clone_from(&self.fronts);
    }

    /// Goes back to a state that [`Self::keep`] wrote down.
    pub(super) fn restore(&mut self, history: &History, fronts: &[usize]) {
        self.history.copy_from(history);
        let (coefficients, h_0) = self.history.nearer();
        self.coefficients.copy_from_slice(coefficients);
        self.h_0 = h_0;
        self.fronts.clear();
        self.fronts.extend_from_slice(fronts);
    }

    /// Whether such a state can be one of this model.
    pub(super) fn knows(&self, history: &History, fronts: &[usize]) -> bool {
        let between = if matches!(self.model.frame, Frame::Remeshed(_)) { self.grid.len() } else { 0 };
        let lines = if self.model.window.cavitation == Cavitation::Penalty { 0 } else { 1 };
        history.is_of(self.operators.modes, self.sides.len(), between)
            && fronts.len() == lines
            && fronts.iter().all(|front| *front <= self.grid.len())
    }

    /// H₀ of the present state.
    pub(super) fn h_0(&self) -> f64 {
        self.h_0
    }

    /// Shows every iterate to an observer, for a training.
    pub(crate) fn observe(&mut self, observer: StepObserver<'a>) {
        self.observer = Some(observer);
    }

    /// Gives the sampled rows their place in time.
    fn set_rows(&mut self, step: &Step) {
        self.history.carry(self.model.frame, step, &self.grid.x, &self.x);
        let weights = step.history_weights();
        for (r, (sides, x)) in self.sides.iter().zip(&self.x).enumerate() {
            let velocity = step.velocity(*x);
            let Side { stencil, geometry } = sides[usize::from(velocity < 0.0)];
            let geometry = geometry.in_time(velocity.abs(), step.quotient.now, self.history.at(weights, r));
            self.operators.set_row(r, stencil, geometry);
        }
    }

    /// Newton from the present state; the iteration that failed is repeated with a softer penalty from `start`.
    fn newton(&mut self, at: &Conditions, max_newton: usize) -> Result<Effort, Termination> {
        let h_0 = self.h_0;
        let mut effort = Effort::default();
        let attempts = if self.front.is_empty() { &ATTEMPTS[1..] } else { &ATTEMPTS[..] };
        for (held, softness) in attempts {
            let case = Case {
                problem: &at.problem,
                scale: 1.0,
                curvature: at.curvature,
                penalty: softness * self.model.window.penalty,
                lift: &self.lift,
            };
            let stop = Stop { tolerance: TOLERANCE, max_newton };
            self.operators.rupture_at(held.then_some(&self.front));
            if self.observer.is_some() {
                let window = &self.model.window;
                self.operators.lift(window, &window.grid.at_zero(1.0), 1.0);
            }
            self.coefficients.copy_from_slice(&self.start);
            self.h_0 = h_0;
            let observer = self.observer.as_mut().map(|observer| observer.as_mut() as RowObserver<'_>);
            let outcome = self.operators.newton(&case, &mut self.coefficients, &mut self.h_0, stop, observer);
            effort.newton_iterations += outcome.iterations;
            if outcome.converged {
                return Ok(effort);
            }
        }
        Err(Termination::Diverged)
    }

    /// Makes the present state the nearer of the former ones.
    fn remember(&mut self, at: &Conditions) {
        self.history.remember(&self.coefficients, self.h_0, self.operators.flow());
        self.fronts.clear();
        self.fronts.extend(self.operators.fronts());
        self.cut.clear();
        self.cut.extend(self.operators.cut(&self.coefficients));
        if let Frame::Remeshed(interpolation) = self.model.frame {
            let mut fields = std::mem::take(&mut self.fields);
            let mut fft = std::mem::take(&mut self.fft);
            self.set_fields(at, &mut fields, &mut fft);
            (self.fields, self.fft) = (fields, fft);
            let [pressure, film] = &self.fields;
            let fluid = &at.problem.fluid;
            let flow = pressure.iter().zip(film).map(|(&p, &h)| fluid.at(p).density * h);
            self.history.remember_between(interpolation, &self.grid.x, flow);
        }
        let (cut, flexibility) = (&self.cut, &self.grid.reference.flexibility);
        let bend = |node| -cut.iter().map(|&(other, value)| flexibility.entry(node, other) * value).sum::<f64>();
        self.scalars = self.contact.scalars(at, &self.coefficients, self.h_0, bend);
    }

    /// P and H of the present state at all nodes.
    fn set_fields(&self, at: &Conditions, [pressure, film]: &mut [Vec<f64>; 2], fft: &mut Scratch) {
        let window = &self.model.window;
        let product = |out: &mut [f64], basis: &Mat<f64>| {
            let (out, coefficients) = (ColMut::from_slice_mut(out), ColRef::from_slice(&self.coefficients));
            matmul(out.as_mat_mut(), Accum::Replace, basis, coefficients.as_mat(), 1.0, Par::Seq);
        };
        product(pressure, &window.pressure.basis().modes);
        if self.fronts.is_empty() {
            product(film, window.pressure.flexed());
        } else {
            cut_off(&window.grid, &self.fronts, pressure);
            self.grid.deform(pressure, film, fft);
        }
        for (film, x) in film.iter_mut().zip(&self.grid.x) {
            *film += self.h_0 + 0.5 * at.curvature * x * x;
        }
    }
}

fn line_grid(model: &TrajectoryModel) -> Result<Arc<ReferenceGrid>, ReducedError> {
    let other = ReducedError::OtherContact { model: ContactKind::Point, given: ContactKind::Line };
    model.window.grid.line().cloned().ok_or(other)
}

impl Marching for ReducedMarch<'_> {
    fn grid(&self) -> &LineGrid {
        &self.grid
    }

    fn rest(&mut self, at: &Conditions, _: &dyn Observer) -> Result<Effort, Termination> {
        let moes = at.problem.moes;
        let far = |start: &TrajectoryStart| {
            let load = start.inputs.at(0.0).load - at.input.load;
            distance(moes, start.point.moes()) + load * load
        };
        let nearest = self.model.starts.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
        let Some(nearest) = nearest else { return Err(Termination::Diverged) };
        self.start.clone_from(&nearest.coefficients);
        self.front.clone_from(&nearest.fronts);
        self.h_0 = nearest.h_0;
        for (r, sides) in self.sides.iter().enumerate() {
            self.operators.set_row(r, sides[0].stencil, sides[0].geometry.in_time(at.speed, 0.0, 0.0));
        }
        let effort = self.newton(at, MOST_NEWTON[1])?;
        self.remember(at);
        self.history.rest();
        Ok(effort)
    }

    fn step(&mut self, step: &Step, observer: &dyn Observer) -> Result<Effort, Termination> {
        if observer.cancelled() {
            return Err(Termination::Cancelled);
        }
        self.set_rows(step);
        self.h_0 = self.history.extrapolate(step.ratio, &mut self.start);
        self.front.clone_from(&self.fronts);
        self.newton(&step.now, MOST_NEWTON[0])
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
        Moment::of_scalars(at, step, &self.scalars, effort)
    }

    fn state(&self, at: &Conditions) -> State {
        let mut fields = [vec![0.0; self.grid.len()], vec![0.0; self.grid.len()]];
        self.set_fields(at, &mut fields, &mut Scratch::default());
        let [pressure, film] = fields;
        let (multiplier, fraction) = (Vec::new(), Vec::new());
        State { time: at.time, scales: at.scales, pressure, film, multiplier, fraction, h_0: self.h_0 }
    }
}
