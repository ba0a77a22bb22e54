//! Full solver of line and point contacts. It runs Newton's method from several initial guesses until one converges:
//! from a given solution, from Hertzian pressures with several film thicknesses (cold starts), and at last by
//! continuation from an easier contact.

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
    /// A solution of the same kind of contact. It may have another operating point or another grid. A solution of the
    /// other kind is ignored, and so is every solution if the contact has an inlet film thickness.
    From(&'a Solution),
}

impl<'a> Start<'a> {
    /// Returns the solution from which a problem starts, or `None` for a cold start. A starved contact always starts
    /// cold: its discrete equations have several solutions with different menisci, and the iteration would converge to
    /// the one next to its initial guess.
    pub(super) fn former(self, problem: &Problem) -> Option<&'a Solution> {
        match self {
            Self::From(former) if former.problem.point.kind == problem.point.kind && problem.supply.is_none() => {
                Some(former)
            }
            _ => None,
        }
    }
}

/// Pressure rises between meniscus and contact, relative to the estimated one. They determine where the meniscus of a
/// starved inlet lies at the beginning of each cold start.
const MENISCI: [f64; 3] = [1.0, 0.7, 0.85];

/// Maximum number of Newton steps of one start of a starved contact. Starts that need more steps cycle and do not
/// converge.
const STARVED_NEWTON: usize = 40;

/// Initial state of one attempt.
#[derive(Clone, Copy)]
pub(super) enum Beginning<'a> {
    /// Hertzian pressure with a film thickness from a formula.
    Cold(ColdStart),
    /// A solution of the same kind of contact.
    Warm(&'a Solution),
    /// Solution of a neighbouring contact on a continuation path, and the extrapolated central film thickness H_c if
    /// there is one.
    Along(&'a Solution, Option<f64>),
}

/// Parameters of a cold start.
#[derive(Clone, Copy)]
pub(super) struct ColdStart {
    /// Central film thickness relative to the contact's film formula.
    pub film: f64,
    /// For a starved inlet: pressure rise between meniscus and contact, relative to the estimated one.
    pub rise: f64,
    /// For rough surfaces: largest asperity pressure P_a in the centre. The film thickness is increased if necessary.
    pub asperity_pressure: f64,
}

impl ColdStart {
    /// Returns cold starts with these film thicknesses, relative to the contact's film formula.
    pub(super) fn all(films: [f64; 3]) -> [Self; 3] {
        std::array::from_fn(|k| Self { film: films[k], rise: 1.0, asperity_pressure: rough::COLD_PRESSURES[k] })
    }
}

/// Returns the maximum number of Newton steps of all starts of a solve together, for a grid with this number of
/// unknowns. The result lies between 100 (large grids) and 3000. The continuation has a separate limit.
pub fn most_newton(unknowns: usize) -> usize {
    (4_000_000 / unknowns.max(1)).clamp(100, 3000)
}

/// Solver of one kind of contact on one grid. Keeps the grid and the work space between solves.
pub struct Solver<S: NewtonSpace> {
    /// Data of the grid that do not depend on the contact.
    pub(super) reference: S::Reference,
    /// Discrete system of the last solve. `None` before the first one.
    pub(super) system: Option<System<S>>,
    /// Settings of every solve.
    pub options: SolveOptions<S::Control>,
}

/// Solver of line contacts.
pub type FullSolver = Solver<LineSpace>;
/// Solver of point contacts.
pub type PointSolver = Solver<PlaneSpace>;

impl<S: NewtonSpace> Solver<S> {
    /// Creates a solver and builds its grid.
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

    /// Solves one contact. If the first start fails, it tries further starts and finally continuation from an easier
    /// contact. The report of the solution says whether it converged. If not, the solution contains the last state and
    /// must not be shown as a result.
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

    /// Solves an existing problem, for instance one whose slide-to-roll ratio was changed.
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
        // Above the first limit of M, further cold starts fail if the first one does. Above the second one, all fail.
        let m = problem.load_as_a_circle();
        let cold_starts = match m {
            _ if problem.supply.is_some() || problem.rough.is_some() || m <= S::COLD_M.0 => cold.len(),
            _ if m <= S::COLD_M.1 => 1,
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

    /// Takes a few Newton steps, at most `options.max_newton`, from fields on this grid. The change of the fields is an
    /// estimate of their error.
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

    /// Returns a system in the state of the first cold start, and its problem. Used for other iterations, such as the
    /// dense baseline.
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

    /// Returns the system on the grid in the form that a problem requires. Takes the stored system out of `self` if it
    /// has that form, and creates a new one otherwise, because another form has other coefficients.
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

    /// Runs Newton's method from one initial state and adds its effort to the report. `most` is the maximum number of
    /// Newton steps in the whole report. Some problems are first solved with complementarity, then with their own
    /// cavitation model.
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
            // A fully flooded film is a good start, and complementarity is the more robust method for it.
            Cavitation::MassConserving { .. } => !system.is_starved(),
            // For elliptical contacts, and for films much longer than the contact, the penalty needs about three times
            // as many steps until the cavitation boundary reaches its position.
            Cavitation::Penalty => {
                let slow = problem.point.is_elliptic() || system.space.grid().continues();
                slow && matches!(beginning, Beginning::Cold(..))
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

    /// Returns the current state as a solution of a problem, with a report.
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

/// Returns the central film thickness by a formula, as H = (h/R) (R/a)². The formula is that of Moes for a line
/// contact, of Hamrock and Dowson for a circular contact, and of Nijenbanning, Venner and Moes for an elliptical
/// contact: there Hamrock and Dowson's film thickness is far too large for R_y < R_x.
pub(super) fn formula_film(problem: &Problem) -> f64 {
    let point = &problem.point;
    if point.kind.is_line() {
        return expected_film(point);
    }
    let all_regimes = FilmFormula::NijenbanningVennerMoes.predict(point).film_m;
    let piezoviscous = FilmFormula::HamrockDowsonCentral.predict(point).film_m;
    // Hamrock and Dowson's formula, a power law in α, does not cover the isoviscous regimes.
    let film = if point.is_elliptic() || piezoviscous < 0.5 * all_regimes { all_regimes } else { piezoviscous };
    film / point.film_scale_m()
}

/// Sets pressure, central film thickness and meniscus of a cold start.
fn cold_state<S: NewtonSpace>(system: &mut System<S>, problem: &Problem, start: ColdStart) {
    let ColdStart { film, rise, asperity_pressure } = start;
    let (x, y) = system.space.grid().abscissae();
    let hertz = x.iter().flat_map(|x| y.iter().map(move |y| (1.0 - (x * x + y * y)).max(0.0).sqrt()));
    let film = film * formula_film(problem);
    let pressure: Vec<f64> = if system.space.grid().continues() {
        // The pressure between rigid bodies, because the Hertzian zone may be narrower than the spacing of the nodes.
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

/// Sets the state of a start from a previous solution. On the same reference grid its pressure is copied, even if the
/// registration (the stretching of a line contact's grid) has another scale. On another grid it is interpolated. The
/// central film thickness is `film`; if that is `None`, it is that of the previous solution, scaled by the film
/// formula.
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

/// Interpolates the node array `values` of a solution (bi)linearly to the nodes with the abscissae `x` and the
/// ordinates `y`. Nodes outside the solution's grid get 0.
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

/// Full solver of line or of point contacts. Keeps the work space between solves.
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

    /// Returns the specification of the grid.
    pub fn grid_spec(&self) -> GridSpec {
        match self {
            Self::Line(solver) => solver.grid().spec,
            Self::Point(solver) => GridSpec::Plane(solver.grid().spec),
        }
    }

    /// Solves one contact, see [`Solver::solve`].
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

    /// Solves an existing problem, see [`Solver::solve_problem`].
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

    /// Adds the discretisation error of the central film thickness to a converged solution on this grid. For a solution
    /// that has not converged, the error is `None`.
    pub fn judged(&mut self, solution: Solution) -> Solution {
        let grid_cost = solution.converged().then(|| match self {
            Self::Line(solver) => solver.grid_cost(&solution),
            Self::Point(solver) => solver.grid_cost(&solution),
        });
        Solution { grid_cost, ..solution }
    }

    /// Takes up to `steps` Newton steps from fields on this grid. The change of the fields is an estimate of their
    /// error. For a line contact the steps are not damped: near a solution the residual with the penalty is
    /// discontinuous, and damping by this residual would hide the error.
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
