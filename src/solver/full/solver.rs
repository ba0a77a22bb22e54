//! Solution of contacts: initial guesses for Newton's method, and the attempts until one converges. The attempts
//! start from a given solution, then from cold starts with several film thicknesses, then by continuation from an
//! easier contact.

use super::cut::cell;
use super::far_field;
use super::heat;
use super::newton_space::NewtonSpace;
use super::problem::{Problem, SolveError, expect_kind};
use super::report::{Report, Termination};
use super::rough;
use super::solution::{Solution, scalars_of};
use super::system::{SolveOptions, System};
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::discrete::rough::RoughNodes;
use crate::solver::discrete::space::{Grid, LineSpace, PlaneSpace};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{FilmFormula, OperatingPoint, expected_film};
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use std::sync::Arc;

/// Initial guess of a full solve.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// Hertzian pressure, and a film thickness from a formula.
    Cold,
    /// Any solution of the same kind of contact, also at another operating point or on another grid. A solution of
    /// the other kind leads to a cold start. A contact with an inlet film thickness always starts cold.
    From(&'a Solution),
}

impl<'a> Start<'a> {
    /// Returns the solution from which a problem starts, or `None` for a cold start. The discrete equations of a
    /// starved inlet have several solutions, which differ in the meniscus. The iteration converges to the one next to
    /// its initial guess, so a starved contact starts cold.
    pub(super) fn former(self, problem: &Problem) -> Option<&'a Solution> {
        match self {
            Self::From(former) if former.problem.point.kind == problem.point.kind && problem.supply.is_none() => {
                Some(former)
            }
            _ => None,
        }
    }
}

/// Pressure rises, in units of the estimated one, that locate the initial meniscus of a starved inlet; one per start.
const MENISCI: [f64; 3] = [1.0, 0.7, 0.85];

/// Maximum number of Newton steps of one such start. Starts that need more steps cycle.
const STARVED_NEWTON: usize = 40;

/// Initial state of one attempt.
#[derive(Clone, Copy)]
pub(super) enum Beginning<'a> {
    /// Hertzian pressure.
    Cold(ColdStart),
    /// A solution of the same kind of contact.
    Warm(&'a Solution),
    /// A neighbouring solution on a continuation path, with the extrapolated central film thickness if there is one.
    Along(&'a Solution, Option<f64>),
}

/// Film of a cold start.
#[derive(Clone, Copy)]
pub(super) struct ColdStart {
    /// Central film thickness in units of the contact's film formula.
    pub film: f64,
    /// For a starved inlet, pressure rise to the meniscus in units of the estimated one.
    pub rise: f64,
    /// For rough surfaces, largest central asperity pressure P_a.
    pub asperity_pressure: f64,
}

impl ColdStart {
    /// Cold starts with the given film thicknesses.
    pub(super) fn all(films: [f64; 3]) -> [Self; 3] {
        std::array::from_fn(|k| Self { film: films[k], rise: 1.0, asperity_pressure: rough::COLD_PRESSURES[k] })
    }
}

/// Returns the maximum number of Newton steps of all starts of a solve together, without its continuation. The
/// argument is the number of unknowns of the grid. The result is 3,000, fewer on large grids, and at least 100.
pub fn most_newton(unknowns: usize) -> usize {
    (4_000_000 / unknowns.max(1)).clamp(100, 3000)
}

/// Solver of one kind of contact on one grid. Keeps the grid and the work space between solves.
pub struct Solver<S: NewtonSpace> {
    pub(super) reference: S::Reference,
    pub(super) system: Option<System<S>>,
    /// Settings of every solve.
    pub options: SolveOptions<S::Control>,
}

/// Solver of line contacts.
pub type FullSolver = Solver<LineSpace>;
/// Solver of point contacts.
pub type PointSolver = Solver<PlaneSpace>;

impl<S: NewtonSpace> Solver<S> {
    /// Creates a solver on the grid of a specification.
    ///
    /// # Errors
    /// If the specification is refused.
    pub fn new(spec: S::Spec) -> Result<Self, SolveError> {
        Ok(Self::on(S::build(spec)?))
    }

    /// Creates a solver on an existing grid.
    pub fn on(reference: S::Reference) -> Self {
        Self { reference, system: None, options: SolveOptions::default() }
    }

    /// Returns the grid.
    pub fn grid(&self) -> &S::Reference {
        &self.reference
    }

    /// Solves one contact. After a failed start it tries further ones and finally continuation from an easier
    /// contact. The solution's report contains the outcome. A solution that has not converged contains the last state
    /// and must not be shown as a result.
    ///
    /// # Errors
    /// If the operating point or the lubricant is refused, or if the contact is of the other kind.
    pub fn solve(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        expect_kind(S::KIND, point)?;
        self.solve_problem(Problem::new(point, lubricant)?, start, observer)
    }

    /// Solves an existing problem, for instance one with other sliding.
    ///
    /// # Errors
    /// If the problem is of the other kind.
    pub fn solve_problem(
        &mut self,
        problem: Problem,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        expect_kind(S::KIND, &problem.point)?;
        if problem.heat.is_some() {
            return heat::solve(self, problem, start, observer);
        }
        let former = start.former(&problem);
        let mut report = Report::empty();
        let all = ColdStart::all(S::COLD_FILMS);
        let cold = match problem.supply {
            None => all.map(Beginning::Cold),
            Some(_) => MENISCI.map(|rise| Beginning::Cold(ColdStart { rise, ..all[0] })),
        };
        // Far from the middle of the map, a second cold start fails like the first one. Farther out, every cold start
        // fails.
        let load = problem.load_as_a_circle();
        let cold_starts = match load {
            _ if problem.supply.is_some() || problem.rough.is_some() || load <= S::COLD_M.0 => cold.len(),
            _ if load <= S::COLD_M.1 => 1,
            _ => 0,
        };
        let most = most_newton(S::unknowns(&self.reference));
        for beginning in former.into_iter().map(Beginning::Warm).chain(cold.into_iter().take(cold_starts)) {
            if report.ended() {
                break;
            }
            self.attempt(&problem, beginning, most, observer, &mut report)?;
        }
        if !report.ended() || report.termination == Termination::Effort {
            self.walk(&problem, observer, &mut report)?;
        }
        let mut solution = self.solution(problem, report)?;
        let largest = problem.fluid.largest_pressure();
        if solution.converged() && solution.pressure.iter().any(|&p| p >= largest) {
            solution.report.termination = Termination::OccupiedVolume;
        }
        Ok(solution)
    }

    /// Takes a few Newton steps from fields on this grid, by which their error can be estimated.
    ///
    /// # Errors
    /// If the kernel of the contact's shape cannot be built.
    pub fn corrected(&mut self, fields: &Solution, options: &SolveOptions<S::Control>) -> Result<Solution, SolveError> {
        let mut system = self.system_for(&fields.problem)?;
        system.set_pressure(&fields.problem, &fields.pressure);
        system.set_central_film(fields.scalars.h_c);
        system.fraction.clone_from(&fields.fraction);
        let mut report = Report::empty();
        system.newton(&fields.problem, options, &(), &mut report);
        self.system = Some(system);
        self.solution(fields.problem, report)
    }

    /// Returns the system prepared for a cold start, for other iterations such as the dense baseline.
    ///
    /// # Errors
    /// If the operating point or the lubricant is refused.
    pub fn cold_system(
        &self,
        point: &OperatingPoint,
        lubricant: Lubricant,
    ) -> Result<(System<S>, Problem), SolveError> {
        expect_kind(S::KIND, point)?;
        let problem = Problem::new(point, lubricant)?;
        let mut system = System::new(S::on(&self.reference, S::form_of(&self.reference, &problem))?);
        cold_state(&mut system, &problem, ColdStart::all(S::COLD_FILMS)[0]);
        Ok((system, problem))
    }

    /// Returns the system on the grid in the form that a problem requires. The stored system is reused if it has that
    /// form; another form has other coefficients.
    ///
    /// # Errors
    /// If the kernel of that form cannot be built.
    pub(super) fn system_for(&mut self, problem: &Problem) -> Result<System<S>, SolveError> {
        let form = S::form_of(&self.reference, problem);
        match self.system.take() {
            Some(system) if system.space.form() == form => Ok(system),
            _ => Ok(System::new(S::on(&self.reference, form)?)),
        }
    }

    /// Runs Newton's method once and adds its effort to the report. `most` limits the iterations of all runs
    /// together.
    pub(super) fn attempt(
        &mut self,
        problem: &Problem,
        beginning: Beginning<'_>,
        most: usize,
        observer: &dyn Observer,
        report: &mut Report,
    ) -> Result<(), SolveError> {
        report.attempts += 1;
        let mut system = self.system_for(problem)?;
        match beginning {
            Beginning::Cold(start) => cold_state(&mut system, problem, start),
            Beginning::Warm(former) => warm_state(&mut system, problem, former, None),
            Beginning::Along(former, film) => warm_state(&mut system, problem, former, film),
        }
        let left = |report: &Report| most.saturating_sub(report.newton_iterations).min(self.options.max_newton);
        let by_complementarity = match problem.lubricant.cavitation {
            // Start near a flooded film, for which complementarity is more robust.
            Cavitation::MassConserving { .. } => !system.is_starved(),
            // For wide elliptical contacts, and for films much longer than the contact, the cavitation boundary of
            // the penalty reaches its position in about three times as many steps.
            Cavitation::Penalty => {
                let far = problem.point.is_elliptic() || system.space.grid().continues();
                far && matches!(beginning, Beginning::Cold(..))
            }
            Cavitation::Complementarity => false,
        };
        if by_complementarity {
            let lubricant = Lubricant { cavitation: Cavitation::Complementarity, ..problem.lubricant };
            let flooded = Problem { lubricant, supply: None, ..*problem };
            let options = SolveOptions { max_newton: left(report), ..self.options };
            system.newton(&flooded, &options, observer, report);
            if report.termination != Termination::Converged {
                self.system = Some(system);
                return Ok(());
            }
            if problem.lubricant.cavitation == Cavitation::Penalty {
                system.penalise_rupture(self.options.penalty);
            }
        }
        let left = if problem.supply.is_some() { left(report).min(STARVED_NEWTON) } else { left(report) };
        let options = SolveOptions { max_newton: left, ..self.options };
        system.newton(problem, &options, observer, report);
        if report.termination == Termination::IterationLimit && report.newton_iterations >= most {
            report.termination = Termination::Effort;
        }
        self.system = Some(system);
        Ok(())
    }

    /// Returns the current state as a solution.
    pub(super) fn solution(&mut self, problem: Problem, report: Report) -> Result<Solution, SolveError> {
        let system = self.system_for(&problem)?;
        let System { space, pressure, film, h_0, active, fraction, rough, .. } = self.system.insert(system);
        let (x, y) = space.grid().abscissae();
        Ok(Solution {
            problem,
            mesh: space.mesh(),
            x: x.to_vec(),
            y: y.to_vec(),
            pressure: pressure.clone(),
            film: film.clone(),
            multiplier: active.field(space.grid()),
            fraction: fraction.clone(),
            asperity_pressure: rough.as_ref().map_or_else(Vec::new, RoughNodes::asperity_pressure),
            scalars: scalars_of(space.grid(), &problem, pressure, film, *h_0),
            report,
            grid_cost: None,
            heat: None,
        })
    }
}

/// Returns the central film thickness of a formula in the solver's scaling, H = (h/R) (R/a)². The formulas are Moes'
/// for a line contact, Hamrock and Dowson's for a circular contact, and that of Nijenbanning, Venner and Moes for an
/// elliptical contact. Hamrock and Dowson's formula is far too thick for R_y < R_x.
pub(super) fn formula_film(problem: &Problem) -> f64 {
    let point = &problem.point;
    if point.kind.is_line() {
        return expected_film(point);
    }
    let all_regimes = FilmFormula::NijenbanningVennerMoes.predict(point).film_m;
    let piezoviscous = FilmFormula::HamrockDowsonCentral.predict(point).film_m;
    // Hamrock and Dowson's power law in α does not cover the isoviscous regimes.
    let film = if point.is_elliptic() || piezoviscous < 0.5 * all_regimes { all_regimes } else { piezoviscous };
    film / point.film_scale_m()
}

/// Sets the Hertzian pressure and the central film thickness of a cold start.
fn cold_state<S: NewtonSpace>(system: &mut System<S>, problem: &Problem, start: ColdStart) {
    let ColdStart { film, rise, asperity_pressure } = start;
    let (x, y) = system.space.grid().abscissae();
    let hertz = x.iter().flat_map(|x| y.iter().map(move |y| (1.0 - (x * x + y * y)).max(0.0).sqrt()));
    let film = film * formula_film(problem);
    let pressure: Vec<f64> = if system.space.grid().continues() {
        // Pressure of rigid bodies, because the Hertzian zone may lie between two nodes.
        let curvature = problem.point.ellipse().gap_curvature();
        let gap = |x: f64, y: f64| film + 0.5 * (x * x + curvature * y * y);
        let rigid = |x: f64, y: f64| far_field::pressure(problem, (x - 0.4 * film.sqrt(), y), gap(x, y));
        x.iter().flat_map(|x| y.iter().map(move |y| rigid(*x, *y))).collect()
    } else {
        hertz.collect()
    };
    system.set_pressure(problem, &pressure);
    let film = problem.supply.map_or(film, |supply| film.min(supply));
    system.set_central_film_above_asperities(problem, film, asperity_pressure);
    system.guess_meniscus(problem, rise);
}

/// Transfers a previous solution to this grid. The pressure is copied on the same reference grid, whatever the scale
/// of its registration, and interpolated on another one. The central film thickness is `film`, or that of the
/// previous solution scaled by the formula.
pub(super) fn warm_state<S: NewtonSpace>(
    system: &mut System<S>,
    problem: &Problem,
    former: &Solution,
    film: Option<f64>,
) {
    let same_grid = former.mesh.spec == system.space.mesh().spec;
    if same_grid {
        system.set_pressure(problem, &former.pressure);
    } else {
        let (x, y) = system.space.grid().abscissae();
        let pressure = interpolated(former, &former.pressure, x.iter().copied(), y);
        system.set_pressure(problem, &pressure);
    }
    let ratio = formula_film(problem) / formula_film(&former.problem);
    match film {
        Some(film) => system.set_central_film(film),
        None if same_grid && former.problem == *problem => system.set_h_0(former.scalars.h_0),
        None if problem.rough.is_some() => system.set_film_of_rough_start(problem, former, ratio),
        None => system.set_central_film(former.scalars.h_c * ratio),
    }
    if problem.rough.is_some() {
        return;
    }
    // The initial film thickness must be positive everywhere.
    let floor = 0.2 * former.scalars.h_min * ratio;
    let lowest = system.film.iter().copied().fold(f64::INFINITY, f64::min);
    if lowest < floor {
        system.set_h_0(system.h_0 + floor - lowest);
    }
    if same_grid && !former.fraction.is_empty() {
        system.fraction.clone_from(&former.fraction);
    } else {
        system.guess_meniscus(problem, 1.0);
    }
}

/// Interpolates a node array of a solution (bi)linearly to other abscissae and ordinates; zero outside.
pub(super) fn interpolated(former: &Solution, values: &[f64], x: impl Iterator<Item = f64>, y: &[f64]) -> Vec<f64> {
    let ny = former.y.len();
    let across: Vec<Option<(usize, f64)>> = y.iter().map(|&y| cell(&former.y, y)).collect();
    let mut out = Vec::new();
    for x in x {
        let along = cell(&former.x, x);
        out.extend(across.iter().map(|&across| {
            let Some((i, s)) = along else { return 0.0 };
            let p = |i: usize, j: usize| values[i * ny + j];
            match across {
                Some((j, t)) => {
                    let [west, east] = [i - 1, i].map(|i| (1.0 - t) * p(i, j - 1) + t * p(i, j));
                    (1.0 - s) * west + s * east
                }
                None if ny == 1 => (1.0 - s) * p(i - 1, 0) + s * p(i, 0),
                None => 0.0,
            }
        }));
    }
    out
}

/// Full solver of either kind of contact. Keeps the work space between solves.
pub enum ContactSolver {
    /// Solver of line contacts.
    Line(FullSolver),
    /// Solver of point contacts.
    Point(PointSolver),
}

impl ContactSolver {
    /// Creates a solver on an existing grid.
    pub fn on(grid: &ContactGrid) -> Self {
        match grid {
            ContactGrid::Line(grid) => Self::Line(Solver::on(Arc::clone(grid))),
            ContactGrid::Point(grid) => Self::Point(Solver::on(Arc::clone(grid))),
        }
    }

    /// Returns the specification of its grid.
    pub fn grid_spec(&self) -> GridSpec {
        match self {
            Self::Line(solver) => solver.grid().spec,
            Self::Point(solver) => GridSpec::Plane(solver.grid().spec),
        }
    }

    /// Solves one contact, as [`Solver::solve`] does.
    ///
    /// # Errors
    /// If the operating point or the lubricant is refused, or if the contact is of the other kind.
    pub fn solve(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        match self {
            Self::Line(solver) => solver.solve(point, lubricant, start, observer),
            Self::Point(solver) => solver.solve(point, lubricant, start, observer),
        }
    }

    /// Solves an existing problem.
    ///
    /// # Errors
    /// If the problem is of the other kind.
    pub fn solve_problem(
        &mut self,
        problem: Problem,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        match self {
            Self::Line(solver) => solver.solve_problem(problem, start, observer),
            Self::Point(solver) => solver.solve_problem(problem, start, observer),
        }
    }

    /// Adds the discretisation error of the central film thickness to a solution on this grid. Returns a solution
    /// that has not converged without it.
    pub fn judged(&mut self, solution: Solution) -> Solution {
        let grid_cost = solution.converged().then(|| match self {
            Self::Line(solver) => solver.grid_cost(&solution),
            Self::Point(solver) => solver.grid_cost(&solution),
        });
        Solution { grid_cost, ..solution }
    }

    /// Takes a few Newton steps from fields on this grid, by which their error can be estimated. For a line contact
    /// the steps are not damped: near a solution the penalty makes the residual jump, and damping by the residual
    /// would hide the error.
    ///
    /// # Errors
    /// If the kernel of the contact's shape cannot be built.
    pub fn corrected(&mut self, fields: &Solution, steps: usize) -> Result<Solution, SolveError> {
        match self {
            Self::Line(solver) => {
                let defaults = SolveOptions::default();
                let control = super::Backtracking { shortest_step: 1.0, ..defaults.control };
                solver.corrected(fields, &SolveOptions { max_newton: steps, control, ..defaults })
            }
            Self::Point(solver) => {
                solver.corrected(fields, &SolveOptions { max_newton: steps, ..SolveOptions::default() })
            }
        }
    }
}
