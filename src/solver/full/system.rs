//! Discrete system of one problem on a space, and Newton's method for it: equations, Jacobian products and stopping.
//!
//! The unknowns are the pressure P and the rigid-body separation H₀; the deformation is eliminated. The Jacobian A +
//! B K is never assembled: A and B are stencils, and the elastic kernel K is applied. The step control and the
//! preconditioner are provided by the space, see [`NewtonSpace`].

use super::active_set::ActiveSet;
use super::far_field;
use super::film_fraction;
use super::gmres::{Gmres, LinearOutcome};
use super::newton_space::{NewtonSpace, Preconditioner, ScaledRows, Taken};
use super::problem::Problem;
use super::report::{Report, Termination};
use super::thinning::Thinning;
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::heat::WarmFilm;
use crate::solver::discrete::nodes::{Nodes, Order};
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::discrete::reynolds::{CENTER, Row};
use crate::solver::discrete::rough::RoughNodes;
use crate::solver::discrete::space::Grid;
use crate::solver::observer::{NewtonStep, Observer};
use crate::solver::physics::lubricant::Cavitation;

/// Settings of a full solve, including those of the space's step control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveOptions<C> {
    /// Limit of the step size below which Newton's method stops: ‖Δz‖/‖z‖ with z = (P, H₀) for a line contact,
    /// max|ΔP| for a point contact. For the latter |ΔH₀| must also fall below a tenth of it.
    pub tolerance: f64,
    /// Maximum number of Newton steps per attempt.
    pub max_newton: usize,
    /// Maximum number of Krylov iterations per Newton step.
    pub max_krylov: usize,
    /// Penalty factor γ̄ of (2.36).
    pub penalty: f64,
    /// Method for the film integrals of a shear-thinning lubricant.
    pub film: FilmTreatment,
    /// Settings of the step control and of the accuracy of the linear solves.
    pub control: C,
}

/// Discrete system of one problem, with its state and all work space.
pub struct System<S: NewtonSpace> {
    /// Grid and equations.
    pub space: S,
    /// P, node array.
    pub pressure: Vec<f64>,
    /// Film thickness H, node array.
    pub film: Vec<f64>,
    /// H₀.
    pub h_0: f64,
    /// True if H₀ is prescribed. The load is then a result.
    pub prescribed: bool,
    gap: Vec<f64>,
    pub(super) deformation: Vec<f64>,
    pub(super) nodes: Nodes,
    /// Contribution of shear thinning to the Jacobian; created at its first use.
    pub(super) thinning: Option<Thinning>,
    pub(super) treatment: FilmTreatment,
    /// Temperatures of a thermal film.
    pub(super) warm: Option<WarmFilm>,
    /// Nodes of rough surfaces.
    pub(super) rough: Option<RoughNodes>,
    /// Equations of the unknowns at the last evaluation.
    pub rows: Vec<Row>,
    /// Cavitated set; empty for cavitation by the penalty.
    pub active: ActiveSet,
    /// Initial film fraction θ, node array; empty if unknown.
    pub fraction: Vec<f64>,
    /// Widths along X of the unknowns' cells, one per abscissa that has unknowns.
    widths: Vec<f64>,
    /// Residual norm of the equations of film fractions, a part of the total norm.
    pub(super) of_fractions: f64,
    scaling: Vec<f64>,
    pub(super) step: Vec<f64>,
    pub(super) step_deformation: Vec<f64>,
    preconditioner: Preconditioner<S::Matrix>,
    krylov: Gmres,
    pub(super) scratch: <S::Grid as Grid>::Scratch,
    rhs: Vec<f64>,
    /// Newton step (ΔP, ΔH₀).
    pub(super) update: Vec<f64>,
}

/// Limit of the residual norm of a solution, in units of the film thickness H if that is above 1. Residual norms of
/// solutions are at most 1e-10 for line contacts and 1e-4 for point contacts; those of other states are 1e3 and more.
/// Films many times thicker than a²/R have larger ones, by rounding.
const AT_REST: f64 = 1.0;

/// Evaluates the nodes of a smooth film, Newtonian, shear-thinning or thermal, at pressure P and film thickness H.
pub(super) fn evaluate_film<S: NewtonSpace>(
    space: &S,
    (nodes, thinning, warm): (&mut Nodes, &mut Option<Thinning>, &mut Option<WarmFilm>),
    problem: &Problem,
    (pressure, film): (&[f64], &[f64]),
    treatment: FilmTreatment,
) {
    let laws = problem.laws();
    let order = if S::PARALLEL { Order::Parallel } else { Order::Alone };
    let warm = warm.as_mut().zip(problem.warm_laws());
    let thins = laws.shear.is_some() || warm.is_some();
    let thinning = thins.then(|| thinning.get_or_insert_with(|| Thinning::new(space)));
    let gradient = thinning.as_ref().map(|thinning| &thinning.gradient);
    let at = |k: usize| match (gradient, S::AXES) {
        (None, _) => [0.0; 2],
        (Some(gradient), 1) => [gradient.along().at(pressure, k), 0.0],
        (Some(gradient), _) => gradient.at_node(pressure, k),
    };
    match warm {
        Some((warm, laws)) => nodes.evaluate_warm(&laws, (pressure, film), at, warm, order),
        None => nodes.evaluate(laws, (pressure, film), at, treatment, order),
    }
}

impl<S: NewtonSpace> System<S> {
    /// Creates a system on a space, with all work space. The state is zero until it is set.
    pub fn new(space: S) -> Self {
        let (n, u) = (space.grid().weights().len(), space.grid().unknowns());
        let mut gap = vec![0.0; n];
        space.write_gap(&mut gap);
        let (grid, (x, y)) = (space.grid(), space.grid().abscissae());
        let own = |k: usize| grid.node(k) / y.len();
        let columns = (0..u).step_by(grid.column_unknowns()).map(own);
        let widths = columns.map(|own| 0.5 * (x[own + 1] - x[own - 1])).collect();
        Self {
            space,
            pressure: vec![0.0; n],
            film: vec![0.0; n],
            h_0: 0.0,
            prescribed: false,
            gap,
            deformation: vec![0.0; n],
            nodes: Nodes::new(n, false),
            thinning: None,
            treatment: FilmTreatment::default(),
            warm: None,
            rough: None,
            rows: vec![Row::default(); u],
            active: ActiveSet::default(),
            fraction: Vec::new(),
            widths,
            of_fractions: 0.0,
            scaling: vec![1.0; u],
            step: vec![0.0; n],
            step_deformation: vec![0.0; n],
            preconditioner: Preconditioner::default(),
            krylov: Gmres::default(),
            scratch: Default::default(),
            rhs: vec![0.0; u + 1],
            update: vec![0.0; u + 1],
        }
    }

    /// Sets the pressure (node array), scaled to carry the load exactly, and recomputes the deformation.
    pub fn set_pressure(&mut self, problem: &Problem, pressure: &[f64]) {
        let weights = self.space.grid().weights();
        for ((p, &given), &weight) in self.pressure.iter_mut().zip(pressure).zip(weights) {
            *p = if weight > 0.0 { given } else { 0.0 };
        }
        let factor = problem.load / dot(weights, &self.pressure);
        if factor.is_finite() && factor > 0.0 && !self.prescribed {
            self.pressure.iter_mut().for_each(|p| *p *= factor);
        }
        self.deform();
    }

    /// Returns the load of the pressure, including that beyond the ends of the domain.
    pub(super) fn carried_load(&self) -> f64 {
        let grid = self.space.grid();
        let beyond = if grid.continues() { far_field::load(grid, &self.pressure) } else { 0.0 };
        dot(grid.weights(), &self.pressure) + beyond
    }

    /// Recomputes the deformation from the current pressure.
    pub(super) fn deform(&mut self) {
        self.space.grid().deform(&self.pressure, &mut self.deformation, &mut self.scratch);
    }

    /// Recomputes the gap after a change of the space.
    pub(super) fn renew_gap(&mut self) {
        self.space.write_gap(&mut self.gap);
    }

    /// Sets H₀ and recomputes the film thickness.
    pub fn set_h_0(&mut self, h_0: f64) {
        self.h_0 = h_0;
        for ((h, gap), d) in self.film.iter_mut().zip(&self.gap).zip(&self.deformation) {
            *h = h_0 + gap + d;
        }
    }

    /// Sets H₀ so that the film thickness at X = 0 (and Y = 0) is `film`.
    pub fn set_central_film(&mut self, film: f64) {
        self.set_h_0(0.0);
        let at_zero = self.space.grid().central(&self.film);
        self.set_h_0(film - at_zero);
    }

    /// Evaluates all equations and their derivatives at the current state. Returns the residual norm.
    pub fn evaluate(&mut self, problem: &Problem, penalty: f64) -> f64 {
        if self.space.grid().continues() {
            far_field::write_ends(self.space.grid(), problem, &self.film, &mut self.pressure);
        }
        if problem.rough.is_some() {
            self.evaluate_rough(problem);
            return self.evaluate_rows(problem, penalty);
        }
        let Self { space, nodes, pressure, film, thinning, warm, .. } = self;
        evaluate_film(space, (nodes, thinning, warm), problem, (pressure, film), self.treatment);
        if self.active.fills() {
            self.active.fill(self.space.grid(), &mut self.nodes);
        }
        self.evaluate_rows(problem, penalty)
    }

    /// Evaluates all equations from the nodes of the last evaluation. Returns the residual norm.
    fn evaluate_rows(&mut self, problem: &Problem, penalty: f64) -> f64 {
        let Self { space, nodes, rows, active, thinning, pressure, .. } = self;
        let rough = self.rough.as_ref().zip(problem.rough.as_ref());
        let nodes = &*nodes;
        let penalty = if active.holds() { 0.0 } else { penalty * far_field::stiffening(space.grid()) };
        let fills = active.fills();
        space.each_row(rows, |k, _, row| {
            let (stencil, geometry) = space.row(k);
            *row = match rough {
                None => nodes.row(&geometry, penalty, stencil),
                Some((nodes, rough)) => nodes.row(rough, &geometry, stencil),
            };
            if fills {
                active.by_fraction(row, &geometry, nodes, stencil);
            }
        });
        let mut thinning = thinning.as_mut().filter(|_| nodes.thins());
        if let Some(thinning) = &mut thinning {
            thinning.differentiate(space, nodes);
        }
        if active.holds() && !fills {
            active.hold(rows, thinning);
            if let Some((nodes, _)) = rough {
                active.hold_on_asperities(rows, space.grid(), pressure, nodes);
            }
        }
        let (grid, weights) = (space.grid(), space.grid().weights());
        let square = |(k, row): (usize, &Row)| weights[grid.node(k)] * row.value * row.value;
        let all = rows.iter().enumerate().map(square).sum::<f64>().sqrt();
        self.of_fractions = 0.0;
        if fills {
            let ruptured = rows.iter().enumerate().filter(|(k, _)| active.ruptured[*k]);
            self.of_fractions = ruptured.map(square).sum::<f64>().sqrt();
        }
        all
    }

    /// Returns the stored mass of the last evaluation, node array: ρ̄H, and ρ̄ times the mean gap of rough surfaces.
    pub(super) fn stored(&self) -> impl Iterator<Item = f64> + '_ {
        let rough = self.rough.iter().flat_map(RoughNodes::stored);
        let smooth = self.rough.is_none().then(|| self.nodes.iter().map(|node| node.flow));
        rough.chain(smooth.into_iter().flatten())
    }

    /// Runs Newton's method from the current state.
    pub fn newton(
        &mut self,
        problem: &Problem,
        options: &SolveOptions<S::Control>,
        observer: &dyn Observer,
        report: &mut Report,
    ) {
        self.begin(problem, options);
        self.go_on(problem, options, &mut S::Memory::default(), observer, report);
        if report.termination == Termination::Converged && !self.is_at_rest(report.residual_norm) {
            report.termination = Termination::Diverged;
        }
    }

    /// Returns true if a residual norm is that of a solution. After a step that changed nothing, this must be checked
    /// for Eyring (shear-thinning) lubricants. Far from a solution some equations outweigh all others by thirty orders
    /// of magnitude. A step that solves these to a hundredth of the right-hand side is then zero, and the state remains
    /// wrong.
    pub(super) fn is_at_rest(&self, residual_norm: f64) -> bool {
        let film = self.film.iter().copied().fold(f64::INFINITY, f64::min);
        residual_norm < AT_REST * film.max(1.0)
    }

    /// Prepares Newton's method from the current state.
    pub(super) fn begin(&mut self, problem: &Problem, options: &SolveOptions<S::Control>) {
        self.treatment = options.film;
        self.nodes.forget();
        self.begin_rupture(problem);
    }

    /// Sets the pressures of a node array to zero in the cavitated region and wherever they are negative. No effect for
    /// rough surfaces, whose asperities carry a pressure there.
    pub(super) fn keep_ruptured(&self, pressure: &mut [f64]) {
        if self.rough.is_some() {
            return;
        }
        let grid = self.space.grid();
        for (k, &ruptured) in self.active.ruptured.iter().enumerate() {
            let p = &mut pressure[grid.node(k)];
            *p = if ruptured { 0.0 } else { p.max(0.0) };
        }
    }

    /// Continues Newton's method from the current state with the current cavitated set.
    pub(super) fn go_on(
        &mut self,
        problem: &Problem,
        options: &SolveOptions<S::Control>,
        memory: &mut S::Memory,
        observer: &dyn Observer,
        report: &mut Report,
    ) {
        let exact_load = S::CLIPS || self.active.holds();
        let mut residual = self.evaluate(problem, options.penalty);
        report.termination = Termination::IterationLimit;
        for _ in 0..options.max_newton {
            if observer.cancelled() {
                report.termination = Termination::Cancelled;
                break;
            }
            report.residuals.push(residual);
            let forcing = S::forcing(&options.control, memory, residual);
            let load = if exact_load && !self.prescribed { problem.load - self.carried_load() } else { 0.0 };
            let linear = self.solve_linear(options, forcing, load, observer);
            report.linear_iterations += linear.iterations;
            if observer.cancelled() {
                report.termination = Termination::Cancelled;
                break;
            }
            report.newton_iterations += 1;
            let before = residual;
            let Taken { size, shift, residual: after } = S::step(self, problem, options, memory, before);
            let (still, after) = self.renew_rupture(problem, options.penalty, after);
            residual = after;
            report.steps.push(size);
            observer.newton_step(&NewtonStep { iteration: report.newton_iterations, residual: before, step: size });
            observer.iterate(&self.pressure);
            if !(residual.is_finite() && size.is_finite() && shift.is_finite()) || residual > S::WORST_RESIDUAL {
                report.termination = Termination::Diverged;
                break;
            }
            let solved = linear.relative_residual < 0.5;
            if size < options.tolerance && shift.abs() < 0.1 * options.tolerance && solved && still {
                // The mean planes of rough surfaces may pass each other.
                let separated = problem.rough.is_some() || self.film.iter().all(|&h| h > 0.0);
                report.termination = if separated { Termination::Converged } else { Termination::Diverged };
                break;
            }
        }
        report.residual_norm = residual;
        report.cautious_front |= self.active.cautious;
        self.fraction = self.active.fraction_field(self.space.grid(), &self.film);
    }

    /// Estimates how far the inlet film thickness fills the inlet, see [`film_fraction::guess`].
    pub(super) fn guess_meniscus(&mut self, problem: &Problem, share: f64) {
        let alpha = problem.point.alpha_per_pa * problem.point.hertz().pressure_pa;
        // ∫ dp/η up to the Hertzian pressure: the limit of the reduced pressure.
        let reduced = if alpha > 0.0 { (1.0 - (-alpha).exp()) / alpha } else { 1.0 };
        let rise = share * reduced * problem.inverse_lambda;
        let (grid, fields) = (self.space.grid(), (self.pressure.as_slice(), self.film.as_slice()));
        self.fraction = problem.supply.map_or_else(Vec::new, |supply| film_fraction::guess(grid, fields, supply, rise));
    }

    /// Returns true if the inlet is computed or estimated to be partly filled.
    pub(super) fn is_starved(&self) -> bool {
        let (x, y) = self.space.grid().abscissae();
        let inlet = self.fraction.iter().take(x.partition_point(|x| *x < 0.0) * y.len());
        inlet.into_iter().any(|fraction| *fraction < 1.0)
    }

    /// Initialises the cavitated set from the pressures: nodes with negative pressure, and nodes without pressure in
    /// the outlet half. Negative pressures become zero.
    pub(super) fn begin_rupture(&mut self, problem: &Problem) {
        if problem.rough.is_some() {
            self.begin_rough_rupture(problem);
            return;
        }
        self.rough = None;
        let Self { space, pressure, active, fraction, rows, .. } = self;
        let grid = space.grid();
        let (x, y) = grid.abscissae();
        let outlet = |node: usize| pressure[node] < 0.0 || pressure[node] == 0.0 && x[node / y.len()] > 0.0;
        let nodes = (0..rows.len()).map(|k| grid.node(k));
        match problem.lubricant.cavitation {
            Cavitation::Penalty => {
                active.begin(std::iter::empty());
                return;
            }
            Cavitation::Complementarity => active.begin(nodes.map(outlet)),
            Cavitation::MassConserving { .. } => {
                let supply = problem.supply;
                active.begin_filled(
                    supply,
                    nodes.map(|node| {
                        let fraction = fraction.get(node).copied().unwrap_or(1.0);
                        let starved = pressure[node] == 0.0 && fraction < 1.0;
                        (starved || outlet(node)).then_some(fraction)
                    }),
                );
            }
        }
        self.rise_to_zero();
    }

    /// Sets the pressure of nodes that cavitate by complementarity to −λ/γ̄, where the penalty equals the multiplier
    /// λ.
    pub(super) fn penalise_rupture(&mut self, penalty: f64) {
        let multiplier = self.active.field(self.space.grid());
        let penalty = penalty * far_field::stiffening(self.space.grid());
        for (p, multiplier) in self.pressure.iter_mut().zip(multiplier) {
            *p -= multiplier / penalty;
        }
    }

    /// Raises negative pressures to zero. Returns `false` if there were none.
    fn rise_to_zero(&mut self) -> bool {
        let mut cut = false;
        for p in &mut self.pressure {
            if *p < 0.0 {
                *p = 0.0;
                cut = true;
            }
        }
        if cut {
            self.deform();
            self.set_h_0(self.h_0);
        }
        cut
    }

    /// Updates the cavitated set after a Newton step. Nodes with negative pressure join it; others leave it by
    /// [`ActiveSet::release`]. Returns whether the set is unchanged, and the new residual norm; `residual` is the
    /// previous one.
    fn renew_rupture(&mut self, problem: &Problem, penalty: f64, residual: f64) -> (bool, f64) {
        if !self.active.holds() {
            return (true, residual);
        }
        let mut residual = residual;
        self.active.remember();
        let rose = if problem.rough.is_some() { self.join_rough_rupture() } else { self.join_rupture() };
        let lines = self.space.grid().column_unknowns();
        if self.active.fills() {
            if self.active.release_filled(lines) || rose {
                residual = self.evaluate(problem, penalty);
            }
            return (self.active.is_still(), residual);
        }
        if rose {
            residual = self.evaluate(problem, penalty);
        }
        if self.active.release(&self.widths, lines) {
            residual = self.evaluate_rows(problem, penalty);
        }
        (self.active.is_still(), residual)
    }

    /// Adds nodes with negative pressure to the cavitated set and raises them to zero. Returns `false` if there were none.
    fn join_rupture(&mut self) -> bool {
        let Self { space, pressure, active, .. } = &mut *self;
        for (k, ruptured) in active.ruptured.iter_mut().enumerate() {
            *ruptured |= pressure[space.grid().node(k)] < 0.0;
        }
        self.rise_to_zero()
    }

    /// Expands `update` to the node array `step` without film fractions, and computes its deformation.
    pub(super) fn spread_update(&mut self) {
        let Self { space, update, step, step_deformation, scratch, active, .. } = self;
        space.spread(update, step);
        if active.fills() {
            active.without_fractions(step);
        }
        space.grid().deform(step, step_deformation, scratch);
    }

    /// Solves the linearised system for `update` = (ΔP, ΔH₀), where ΔP carries the load `load`. Returns the result of
    /// the linear solver.
    pub(super) fn solve_linear(
        &mut self,
        options: &SolveOptions<S::Control>,
        tolerance: f64,
        load: f64,
        observer: &dyn Observer,
    ) -> LinearOutcome {
        let Self { space, krylov, scratch, step, step_deformation, rows, scaling, preconditioner, rhs, rough, .. } =
            self;
        let (update, active) = (&mut self.update, &self.active);
        let (space, u, prescribed) = (&*space, rows.len(), self.prescribed);
        let diagonal = space.own_deformation();
        for (s, row) in scaling.iter_mut().zip(&*rows) {
            *s = 1.0 / (row.d_p[CENTER].abs() + row.d_h[CENTER].abs() * diagonal);
        }
        let (rows, scaling) = (rows.as_slice(), scaling.as_slice());
        let mut thinning = self.thinning.as_mut().filter(|_| self.nodes.thins());
        let Preconditioner { matrix, .. } = preconditioner;
        let go_on = || !observer.cancelled();
        let scaled = ScaledRows { rows, thinning: thinning.as_deref(), scaling, fractions: active.fractions() };
        let stopped = LinearOutcome { iterations: 0, relative_residual: f64::NAN };
        if !space.assemble(matrix, &options.control, &scaled, go_on) || !go_on() {
            return stopped;
        }
        preconditioner.border(space, &scaled, prescribed);
        if !go_on() {
            return stopped;
        }
        for ((r, row), s) in rhs.iter_mut().zip(rows).zip(scaling) {
            *r = -row.value * s;
        }
        let weights = space.grid().weights();
        rhs[u] = load;
        krylov.solve(
            rhs,
            update,
            (tolerance, options.max_krylov),
            |v, out| {
                space.spread(v, step);
                if active.fills() {
                    active.without_fractions(step);
                }
                space.grid().deform(step, step_deformation, scratch);
                let carried = dot(weights, step);
                match (&mut thinning, &*rough) {
                    (Some(thinning), None) => thinning.turn::<S>(step),
                    (Some(thinning), Some(rough)) => thinning.turn_rough::<S>(step, (step_deformation, v[u]), rough),
                    (None, _) => {}
                }
                if active.fills() {
                    active.with_fractions(space.grid(), v, step);
                }
                let (field, film, shift) = (&*step, &*step_deformation, v[u]);
                space.each_row(&mut out[..u], |k, stencil, out| {
                    let Row { d_p, d_h, .. } = &rows[k];
                    let mut sum = 0.0;
                    for ((a, b), &node) in d_p[..S::NODES].iter().zip(d_h).zip(&stencil) {
                        sum += a * field[node] + b * (film[node] + shift);
                    }
                    *out = sum * scaling[k];
                });
                if let Some(thinning) = &thinning {
                    thinning.add_product(space, scaling, &mut out[..u]);
                }
                out[u] = if prescribed { shift } else { carried };
            },
            |v| preconditioner.apply(v),
            |iterations| {
                observer.krylov_iteration(iterations);
                go_on()
            },
        )
    }
}
