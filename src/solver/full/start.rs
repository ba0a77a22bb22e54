//! Solving line contacts: where Newton starts.

use super::attempts::{self, Attempts, Beginning, lifted};
use super::line::{LineSystem, SolveOptions};
use super::solution::{Mesh, Problem, Report, Solution, SolveError, scalars_of};
use crate::solver::discrete::grid::{GridSpec, LineGrid, ReferenceGrid};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, moes_line_film};
use crate::solver::physics::lubricant::Lubricant;
use std::sync::Arc;

/// The start of a full solve.
#[derive(Clone, Copy, Debug)]
pub enum Start<'a> {
    /// Hertzian pressure and a film from a formula.
    Cold,
    /// Any solution of the same kind of contact, also at another operating point or on another grid; one of the other kind means cold.
    From(&'a Solution),
}

/// Solves line contacts on one reference grid; keeps the grid and the work space between solves.
pub struct FullSolver {
    reference: Arc<ReferenceGrid>,
    system: Option<LineSystem>,
    /// Settings of every solve.
    pub options: SolveOptions,
}

impl FullSolver {
    /// A solver on the grid of a specification.
    ///
    /// # Errors
    /// When the specification is refused.
    pub fn new(spec: GridSpec) -> Result<Self, SolveError> {
        Ok(Self::on(spec.build()?))
    }

    /// A solver on a reference grid that exists already.
    pub fn on(reference: Arc<ReferenceGrid>) -> Self {
        Self { reference, system: None, options: SolveOptions::default() }
    }

    /// The reference grid.
    pub fn reference(&self) -> &Arc<ReferenceGrid> {
        &self.reference
    }

    /// Solves one contact. A failed start is followed by others and at last by continuation from an easier contact; the solution's report
    /// says how it ended. A solution that has not converged holds the last state and must not be shown as a result.
    ///
    /// # Errors
    /// When the operating point or the lubricant is refused.
    pub fn solve(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        Ok(self.solve_problem(Problem::of_kind(ContactKind::Line, point, lubricant)?, start, observer))
    }

    /// The same for a problem that exists already, under sliding for instance.
    pub fn solve_problem(&mut self, problem: Problem, start: Start<'_>, observer: &dyn Observer) -> Solution {
        let former = match start {
            Start::From(former @ Solution { mesh: Mesh::Line { .. }, .. }) => Some(former),
            _ => None,
        };
        attempts::solve(self, problem, former, observer)
    }

    /// The system prepared at a cold start, for whoever iterates it in another way (the dense baseline).
    ///
    /// # Errors
    /// When the operating point or the lubricant is refused.
    pub fn cold_system(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
    ) -> Result<(LineSystem, Problem), SolveError> {
        let problem = Problem::of_kind(ContactKind::Line, point, lubricant)?;
        let mut system = LineSystem::new(self.reference.for_contact(problem.moes));
        cold_state(&mut system, &problem, Self::COLD_FILMS[0]);
        Ok((system, problem))
    }
}

impl Attempts for FullSolver {
    // In units of Moes' formula.
    const COLD_FILMS: [f64; 3] = [2.0, 1.2, 4.0];
    const EASY_M: (f64, f64) = (15.0, 60.0);
    const EASY_L: (f64, f64) = (2.0, 8.0);

    fn attempt(&mut self, problem: &Problem, beginning: Beginning<'_>, observer: &dyn Observer, report: &mut Report) {
        report.attempts += 1;
        let grid = self.reference.for_contact(problem.moes);
        // A grid with another scale has other coefficients; without registration the system is reused as it is.
        let mut system = match self.system.take() {
            Some(system) if system.grid.scale == grid.scale => system,
            _ => LineSystem::new(grid),
        };
        match beginning {
            Beginning::Cold(film) => cold_state(&mut system, problem, film),
            Beginning::Warm(former) => warm_state(&mut system, problem, former),
        }
        system.newton(problem, &self.options, observer, report);
        self.system = Some(system);
    }

    fn solution(&mut self, problem: Problem, report: Report) -> Solution {
        let grid = self.reference.for_contact(problem.moes);
        let system = match self.system.take() {
            Some(system) => system,
            None => LineSystem::new(grid),
        };
        let solution = Solution {
            problem,
            mesh: Mesh::Line { spec: self.reference.spec, scale: system.grid.scale },
            x: system.grid.x.clone(),
            y: vec![0.0],
            pressure: system.pressure.clone(),
            film: system.film.clone(),
            scalars: scalars_of(&system.grid, &problem, &system.pressure, &system.film, system.h_0),
            report,
        };
        self.system = Some(system);
        solution
    }
}

/// Hertzian pressure and H(0) = `film` × Moes' formula.
fn cold_state(system: &mut LineSystem, problem: &Problem, film: f64) {
    let hertz: Vec<f64> = system.grid.x.iter().map(|x| (1.0 - x * x).max(0.0).sqrt()).collect();
    system.set_pressure(problem, &hertz);
    system.set_central_film(film * moes_film(problem));
}

/// Moes' film in the solver's scaling: H = (h/R) (R/a)².
fn moes_film(problem: &Problem) -> f64 {
    let moes = problem.moes;
    // (h/R)(2U)^(−1/2) with a²/R² = 8 w/(π E′ R) = 8 M (2U)^(1/2)/π.
    moes_line_film(moes) * std::f64::consts::PI / (8.0 * moes.m)
}

/// A former solution on this grid: pressure interpolated over the registered coordinate, central film scaled by Moes' formula.
fn warm_state(system: &mut LineSystem, problem: &Problem, former: &Solution) {
    let grid = &system.grid;
    let same_grid = matches!(former.mesh, Mesh::Line { spec, .. } if spec == grid.reference.spec);
    let pressure =
        if former.x.len() == grid.len() && same_grid { former.pressure.clone() } else { interpolate(former, grid) };
    let ratio = moes_film(problem) / moes_film(&former.problem);
    let same = former.problem == *problem;
    system.set_pressure(problem, &pressure);
    if same && same_grid {
        system.set_h_0(former.scalars.h_0);
    } else {
        system.set_central_film(former.scalars.h_c * ratio);
    }
    if let Some(h_0) = lifted(&system.film, system.h_0, 0.2 * former.scalars.h_min * ratio) {
        system.set_h_0(h_0);
    }
}

/// Pressure of another grid's solution at this grid's nodes, linearly, zero outside.
fn interpolate(former: &Solution, grid: &LineGrid) -> Vec<f64> {
    grid.x.iter().map(|&x| pressure_at(former, x)).collect()
}

/// Pressure of a line contact's solution at X, linearly, zero outside.
pub(super) fn pressure_at(former: &Solution, x: f64) -> f64 {
    let (nodes, p) = (&former.x, &former.pressure);
    let k = nodes.partition_point(|&v| v < x);
    if k < 2 || k >= nodes.len() {
        return 0.0;
    }
    let t = (x - nodes[k - 1]) / (nodes[k] - nodes[k - 1]);
    (1.0 - t) * p[k - 1] + t * p[k]
}
