//! The online phase in time: Newton on the sampled rows from the extrapolation of the two former steps.

use super::model::TrajectoryModel;
use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid, ReferenceGrid, dot};
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::full::transient::{Conditions, Effort, Frame, History, Marching, Moment, State, Step};
use crate::solver::full::{Scalars, Termination};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::reduced::contact_rows::ContactRows;
use crate::solver::reduced::operators::{Case, Iterate, Operators, RowObserver, Stop};
use crate::solver::reduced::{ReducedError, distance};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Par};
use std::sync::Arc;

/// Stop of a step on ‖Δp̃‖/‖p̃‖.
const TOLERANCE: f64 = 1e-6;
/// Newton steps of a time step, and of the stationary start.
const MOST_NEWTON: [usize; 2] = [15, 60];
/// The penalty factor a failed step is tried with again, over the model's own.
const SOFTER: f64 = 0.1;

/// Sees every iterate of every step.
pub(crate) type StepObserver<'a> = Box<dyn FnMut(&Iterate<'_>) + 'a>;

/// A reduced model, ready to march.
pub struct ReducedMarch<'a> {
    model: &'a TrajectoryModel,
    grid: LineGrid,
    operators: Operators,
    /// Stencils of the sampled rows and their coefficients, for a flow from the inlet and from the outlet.
    sides: Vec<[Side; 2]>,
    /// X of the sampled rows' own nodes.
    x: Vec<f64>,
    /// K V_p at X = 0.
    lift: Vec<f64>,
    history: History,
    coefficients: Vec<f64>,
    start: Vec<f64>,
    h_0: f64,
    /// P and H at all nodes, which only remeshing asks for.
    fields: [Vec<f64>; 2],
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
    /// The model on its grid.
    ///
    /// # Errors
    /// When the model is of point contacts.
    pub fn new(model: &'a TrajectoryModel) -> Result<Self, ReducedError> {
        let reference = line_grid(model)?;
        let grid = reference.scaled(1.0);
        let window = &model.window;
        let modes = window.pressure.modes.ncols();
        let (unknowns, last) = (grid.unknowns(), grid.len() - 1);
        let further: Vec<usize> = window.sampled_rows.iter().map(|row| (row + 4).min(last)).collect();
        let operators = Operators::with_support(window, modes, None, false, &further);
        let mut support: Vec<usize> = window.sampled_rows.iter().flat_map(|&row| row..=(row + 4).min(last)).collect();
        support.sort_unstable();
        support.dedup();
        let place = |node: usize| support.partition_point(|&s| s < node);
        let side = |row: usize, velocity: f64| {
            let upstream = Upstream::of(velocity, row, unknowns);
            Side { stencil: upstream.stencil(row).map(place), geometry: upstream.geometry(&grid.x, row) }
        };
        let sides: Vec<[Side; 2]> = window.sampled_rows.iter().map(|&row| [side(row, 1.0), side(row, -1.0)]).collect();
        let (first, weights) = grid.interpolation(0.0);
        let at_zero = |k: usize| weights.iter().enumerate().map(|(m, w)| w * window.flexed[(first + m, k)]).sum();
        Ok(Self {
            model,
            operators,
            x: window.sampled_rows.iter().map(|row| grid.x[row + FIRST_UNKNOWN]).collect(),
            lift: (0..modes).map(at_zero).collect(),
            sides,
            history: History::default(),
            coefficients: vec![0.0; modes],
            start: vec![0.0; modes],
            h_0: 0.0,
            fields: [vec![0.0; grid.len()], vec![0.0; grid.len()]],
            contact: ContactRows::new(&grid, window.pressure.modes.as_ref(), window.flexed.as_ref()),
            scalars: Scalars::default(),
            grid,
            observer: None,
        })
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
        for softness in [1.0, SOFTER] {
            let case = Case {
                problem: &at.problem,
                scale: 1.0,
                curvature: at.curvature,
                penalty: softness * self.model.window.penalty,
                lift: &self.lift,
            };
            let stop = Stop { tolerance: TOLERANCE, max_newton };
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
        if let Frame::Remeshed(interpolation) = self.model.frame {
            let [pressure, film] = &mut self.fields;
            set_fields(self.model, &self.grid, at, (&self.coefficients, self.h_0), [pressure, film]);
            let fluid = &at.problem.fluid;
            let flow = pressure.iter().zip(&*film).map(|(&p, &h)| fluid.at(p).density * h);
            self.history.remember_between(interpolation, &self.grid.x, flow);
        }
        self.scalars = self.contact.scalars(at, &self.coefficients, self.h_0);
    }
}

/// P and H of (p̃, H₀) at all nodes.
fn set_fields(
    model: &TrajectoryModel,
    grid: &LineGrid,
    at: &Conditions,
    (coefficients, h_0): (&[f64], f64),
    [pressure, film]: [&mut [f64]; 2],
) {
    for (out, basis) in [(pressure, &model.window.pressure.modes), (&mut *film, &model.window.flexed)] {
        let (out, coefficients) = (ColMut::from_slice_mut(out), ColRef::from_slice(coefficients));
        matmul(out.as_mat_mut(), Accum::Replace, basis, coefficients.as_mat(), 1.0, Par::Seq);
    }
    for (film, x) in film.iter_mut().zip(&grid.x) {
        *film += h_0 + 0.5 * at.curvature * x * x;
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
        let far = |point: &OperatingPoint| distance(moes, point.moes());
        let nearest = self.model.starts.iter().min_by(|a, b| far(&a.point).total_cmp(&far(&b.point)));
        let Some(nearest) = nearest else { return Err(Termination::Diverged) };
        self.start.clone_from(&nearest.coefficients);
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
        let [mut pressure, mut film] = [vec![0.0; self.grid.len()], vec![0.0; self.grid.len()]];
        set_fields(self.model, &self.grid, at, (&self.coefficients, self.h_0), [&mut pressure, &mut film]);
        let (multiplier, fraction) = (Vec::new(), Vec::new());
        State { time: at.time, scales: at.scales, pressure, film, multiplier, fraction, h_0: self.h_0 }
    }
}
