//! Where Newton starts for a point contact, and what is tried when it fails: other films, then continuation from an easier contact.

use super::{PointOptions, PointSystem};
use crate::solver::contact::{ContactKind, Moes, MoesRequest, OperatingPoint, hamrock_dowson_central, si_from_moes};
use crate::solver::full::solution::{Mesh, Problem, Report, Solution, SolveError, Termination, point_scalars_of};
use crate::solver::full::start::Start;
use crate::solver::grid::{PointGrid, PointGridSpec};
use crate::solver::lubricant::Lubricant;
use crate::solver::observer::Observer;
use std::sync::Arc;

/// Solves point contacts on one grid; keeps the grid and the work space between solves.
pub struct PointSolver {
    system: PointSystem,
    /// Settings of every solve.
    pub options: PointOptions,
}

/// Films tried by a cold start, in units of Hamrock and Dowson's formula.
const COLD_FILMS: [f64; 3] = [1.2, 0.8, 2.0];

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
        observer: &mut dyn Observer,
    ) -> Result<Solution, SolveError> {
        self.solve_problem(Problem::of_kind(ContactKind::Point, point, lubricant)?, start, observer)
    }

    /// The same for a problem that exists already: one that slides, for its traction.
    ///
    /// # Errors
    /// When it is a line contact, or its lubricant thins under shear or has a limiting stress.
    pub fn solve_problem(
        &mut self,
        problem: Problem,
        start: Start<'_>,
        observer: &mut dyn Observer,
    ) -> Result<Solution, SolveError> {
        if problem.point.kind != ContactKind::Point {
            return Err(SolveError::OtherContact { wanted: ContactKind::Point, given: problem.point.kind });
        }
        if problem.shear.is_some() || problem.lubricant.limiting_stress.is_some() {
            return Err(SolveError::ShearInPointContact);
        }
        let mut report = Report::empty();
        if let Start::From(former @ Solution { mesh: Mesh::Point(_), .. }) = start {
            warm_state(&mut self.system, &problem, former);
            self.attempt(&problem, observer, &mut report);
        }
        for film in COLD_FILMS {
            if report.ended() {
                break;
            }
            cold_state(&mut self.system, &problem, film);
            self.attempt(&problem, observer, &mut report);
        }
        if !report.ended() {
            self.continuation(&problem, observer, &mut report);
        }
        Ok(self.solution(problem, report))
    }

    fn attempt(&mut self, problem: &Problem, observer: &mut dyn Observer, report: &mut Report) {
        report.attempts += 1;
        self.system.newton(problem, &self.options, observer, report);
    }

    /// Walks from an easier contact to the wanted one in steps that shrink on failure.
    fn continuation(&mut self, problem: &Problem, observer: &mut dyn Observer, report: &mut Report) {
        let target = problem.moes;
        let easy = Moes { m: target.m.clamp(60.0, 200.0), l: target.l.clamp(3.0, 8.0) };
        let point_at = |t: f64| {
            let m = (easy.m.ln() * (1.0 - t) + target.m.ln() * t).exp();
            let l = easy.l * (1.0 - t) + target.l * t;
            let request = MoesRequest {
                radius_m: Some(problem.point.radius_m),
                modulus_pa: Some(problem.point.modulus_pa),
                viscosity_pa_s: Some(problem.point.viscosity_pa_s),
                alpha_per_pa: Some(problem.point.alpha_per_pa),
                ..MoesRequest::new(ContactKind::Point, m, l)
            };
            si_from_moes(&request).ok().and_then(|p| Problem::new(&p, problem.lubricant).ok())
        };
        let Some(first) = point_at(0.0) else { return };
        cold_state(&mut self.system, &first, COLD_FILMS[0]);
        self.attempt(&first, observer, report);
        if report.termination != Termination::Converged {
            return;
        }
        let (mut t, mut stride) = (0.0, 0.25f64);
        let mut last = self.solution(first, Report::empty());
        while t < 1.0 && stride > 1e-3 {
            let next = (t + stride).min(1.0);
            let wanted = if next >= 1.0 { Some(*problem) } else { point_at(next) };
            let Some(wanted) = wanted else { return };
            warm_state(&mut self.system, &wanted, &last);
            self.attempt(&wanted, observer, report);
            match report.termination {
                Termination::Cancelled => return,
                Termination::Converged => {
                    t = next;
                    last = self.solution(wanted, Report::empty());
                    stride *= 1.5;
                }
                _ => stride *= 0.4,
            }
        }
        if t < 1.0 && report.termination == Termination::Converged {
            report.termination = Termination::IterationLimit;
        }
    }

    fn solution(&self, problem: Problem, report: Report) -> Solution {
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
    // A film that touches anywhere would be no start: lift it.
    let lowest = system.film.iter().copied().fold(f64::INFINITY, f64::min);
    let floor = 0.2 * former.scalars.h_min * ratio;
    if lowest < floor {
        system.set_h_0(system.h_0 + floor - lowest);
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
