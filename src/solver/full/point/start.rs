//! Solving point contacts: where Newton starts.

use super::{PointOptions, PointSystem};
use crate::solver::discrete::grid::{PointGrid, PointGridSpec};
use crate::solver::full::attempts::{self, Attempts, Beginning, lifted};
use crate::solver::full::solution::{Mesh, Problem, Report, Solution, SolveError, point_scalars_of};
use crate::solver::full::start::Start;
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, hamrock_dowson_central};
use crate::solver::physics::lubricant::Lubricant;
use std::sync::Arc;

/// Solves point contacts on one grid; keeps the grid and the work space between solves.
pub struct PointSolver {
    system: PointSystem,
    /// Settings of every solve.
    pub options: PointOptions,
}

impl PointSolver {
    /// A solver on the grid of a specification.
    ///
    /// # Errors
    /// When the specification is refused.
    pub fn new(spec: PointGridSpec) -> Result<Self, SolveError> {
        Ok(Self::on(spec.build()?))
    }

    /// A solver on a grid that exists already.
    pub fn on(grid: Arc<PointGrid>) -> Self {
        Self { system: PointSystem::new(grid), options: PointOptions::default() }
    }

    /// The grid.
    pub fn grid(&self) -> &Arc<PointGrid> {
        &self.system.grid
    }

    /// Solves one contact. A failed start is followed by others and at last by continuation from an easier contact; the solution's report
    /// says how it ended. A solution that has not converged holds the last state and must not be shown as a result.
    ///
    /// # Errors
    /// When the operating point or the lubricant is refused, or it is a line contact.
    pub fn solve(
        &mut self,
        point: &OperatingPoint,
        lubricant: Lubricant,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        self.solve_problem(Problem::of_kind(ContactKind::Point, point, lubricant)?, start, observer)
    }

    /// The same for a problem that exists already, under sliding for instance.
    ///
    /// # Errors
    /// When it is a line contact.
    pub fn solve_problem(
        &mut self,
        problem: Problem,
        start: Start<'_>,
        observer: &dyn Observer,
    ) -> Result<Solution, SolveError> {
        if problem.point.kind != ContactKind::Point {
            return Err(SolveError::OtherContact { wanted: ContactKind::Point, given: problem.point.kind });
        }
        let former = match start {
            Start::From(former @ Solution { mesh: Mesh::Point(_), .. }) => Some(former),
            _ => None,
        };
        Ok(attempts::solve(self, problem, former, observer))
    }
}

impl Attempts for PointSolver {
    // In units of Hamrock and Dowson's formula.
    const COLD_FILMS: [f64; 3] = [1.2, 0.8, 2.0];
    const EASY_M: (f64, f64) = (60.0, 200.0);
    const EASY_L: (f64, f64) = (3.0, 8.0);

    fn attempt(&mut self, problem: &Problem, beginning: Beginning<'_>, observer: &dyn Observer, report: &mut Report) {
        report.attempts += 1;
        match beginning {
            Beginning::Cold(film) => cold_state(&mut self.system, problem, film),
            Beginning::Warm(former) => warm_state(&mut self.system, problem, former),
        }
        self.system.newton(problem, &self.options, observer, report);
    }

    fn solution(&mut self, problem: Problem, report: Report) -> Solution {
        let PointSystem { grid, pressure, film, h_0, .. } = &self.system;
        Solution {
            problem,
            mesh: Mesh::Point(grid.spec),
            x: grid.x.clone(),
            y: grid.y.clone(),
            scalars: point_scalars_of(grid, &problem, pressure, film, *h_0),
            pressure: pressure.clone(),
            film: film.clone(),
            report,
        }
    }
}

/// Hertzian pressure and H(0, 0) = `film` × Hamrock and Dowson's.
fn cold_state(system: &mut PointSystem, problem: &Problem, film: f64) {
    let grid = Arc::clone(&system.grid);
    let hertz: Vec<f64> = (0..grid.len()).map(|node| (1.0 - 2.0 * grid.parabola(node)).max(0.0).sqrt()).collect();
    system.set_pressure(problem, &hertz);
    system.set_central_film(film * formula_film(problem));
}

/// Hamrock and Dowson's central film in the solver's scaling: H = (h/R) (R/a)².
fn formula_film(problem: &Problem) -> f64 {
    hamrock_dowson_central(&problem.point) * problem.point.radius_m / problem.point.film_scale_m()
}

/// A former solution on this grid: pressure interpolated, central film scaled by the formula.
fn warm_state(system: &mut PointSystem, problem: &Problem, former: &Solution) {
    let same_grid = former.mesh == Mesh::Point(system.grid.spec);
    if same_grid {
        system.set_pressure(problem, &former.pressure);
    } else {
        let pressure = interpolate(former, &system.grid);
        system.set_pressure(problem, &pressure);
    }
    let ratio = formula_film(problem) / formula_film(&former.problem);
    if same_grid && former.problem == *problem {
        system.set_h_0(former.scalars.h_0);
    } else {
        system.set_central_film(former.scalars.h_c * ratio);
    }
    if let Some(h_0) = lifted(&system.film, system.h_0, 0.2 * former.scalars.h_min * ratio) {
        system.set_h_0(h_0);
    }
}

/// Pressure of another grid's solution at this grid's nodes, bilinearly, zero outside.
fn interpolate(former: &Solution, grid: &PointGrid) -> Vec<f64> {
    let ny = former.y.len();
    let place = |nodes: &[f64], at: f64| {
        let k = nodes.partition_point(|&node| node < at).max(1);
        let (low, high) = (*nodes.get(k - 1)?, *nodes.get(k)?);
        (at >= low).then(|| (k, (at - low) / (high - low)))
    };
    let across: Vec<Option<(usize, f64)>> = grid.y.iter().map(|&y| place(&former.y, y)).collect();
    let mut out = Vec::with_capacity(grid.len());
    for &x in &grid.x {
        let along = place(&former.x, x);
        out.extend(across.iter().map(|&across| {
            let (Some((i, s)), Some((j, t))) = (along, across) else { return 0.0 };
            let p = |i: usize, j: usize| former.pressure[i * ny + j];
            (1.0 - s) * ((1.0 - t) * p(i - 1, j - 1) + t * p(i - 1, j)) + s * ((1.0 - t) * p(i, j - 1) + t * p(i, j))
        }));
    }
    out
}
