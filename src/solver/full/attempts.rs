//! What is tried until a full solve converges, the same for every kind of contact: a former solution, cold starts with other films, then
//! continuation from an easier contact.

use super::solution::{Problem, Report, Solution, Termination};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{Moes, MoesRequest, si_from_moes};

/// What one attempt begins with.
#[derive(Clone, Copy)]
pub(super) enum Beginning<'a> {
    /// Hertzian pressure and a film, in units of the contact's film formula.
    Cold(f64),
    /// A solution of the same kind of contact.
    Warm(&'a Solution),
}

/// A solver that can be started in different ways.
pub(super) trait Attempts {
    /// Films tried by a cold start.
    const COLD_FILMS: [f64; 3];
    /// Range of M in which cold starts converge.
    const EASY_M: (f64, f64);
    /// Range of L in which they do.
    const EASY_L: (f64, f64);

    /// One run of Newton's method, which counts in the report.
    fn attempt(&mut self, problem: &Problem, beginning: Beginning<'_>, observer: &dyn Observer, report: &mut Report);

    /// The present state as a solution.
    fn solution(&mut self, problem: Problem, report: Report) -> Solution;
}

/// Tries until one attempt converges; the solution's report says how it ended.
pub(super) fn solve<S: Attempts>(
    solver: &mut S,
    problem: Problem,
    former: Option<&Solution>,
    observer: &dyn Observer,
) -> Solution {
    let mut report = Report::empty();
    let cold = S::COLD_FILMS.into_iter().map(Beginning::Cold);
    for beginning in former.into_iter().map(Beginning::Warm).chain(cold) {
        if report.ended() {
            break;
        }
        solver.attempt(&problem, beginning, observer, &mut report);
    }
    if !report.ended() {
        continuation(solver, &problem, observer, &mut report);
    }
    let mut solution = solver.solution(problem, report);
    let largest = problem.fluid.largest_pressure();
    if solution.converged() && solution.pressure.iter().any(|&p| p >= largest) {
        solution.report.termination = Termination::OccupiedVolume;
    }
    solution
}

/// Walks from an easier contact to the wanted one in steps that shrink on failure.
fn continuation<S: Attempts>(solver: &mut S, problem: &Problem, observer: &dyn Observer, report: &mut Report) {
    let target = problem.moes;
    let easy = Moes { m: target.m.clamp(S::EASY_M.0, S::EASY_M.1), l: target.l.clamp(S::EASY_L.0, S::EASY_L.1) };
    let point_at = |t: f64| {
        let m = (easy.m.ln() * (1.0 - t) + target.m.ln() * t).exp();
        let l = easy.l * (1.0 - t) + target.l * t;
        let request = MoesRequest {
            radius_m: Some(problem.point.radius_m),
            modulus_pa: Some(problem.point.modulus_pa),
            viscosity_pa_s: Some(problem.point.viscosity_pa_s),
            alpha_per_pa: Some(problem.point.alpha_per_pa),
            ..MoesRequest::new(problem.point.kind, m, l)
        };
        let point = si_from_moes(&request).ok()?;
        Problem::under_sliding(&point, problem.lubricant, problem.point.sliding).ok()
    };
    let Some(first) = point_at(0.0) else { return };
    solver.attempt(&first, Beginning::Cold(S::COLD_FILMS[0]), observer, report);
    if report.termination != Termination::Converged {
        return;
    }
    let (mut t, mut stride) = (0.0, 0.25f64);
    let mut last = solver.solution(first, Report::empty());
    while t < 1.0 && stride > 1e-3 {
        let next = (t + stride).min(1.0);
        let wanted = if next >= 1.0 { Some(*problem) } else { point_at(next) };
        let Some(wanted) = wanted else { return };
        solver.attempt(&wanted, Beginning::Warm(&last), observer, report);
        match report.termination {
            Termination::Cancelled => return,
            Termination::Converged => {
                t = next;
                last = solver.solution(wanted, Report::empty());
                stride *= 1.5;
            }
            _ => stride *= 0.4,
        }
    }
    if t < 1.0 && report.termination == Termination::Converged {
        report.termination = Termination::IterationLimit;
    }
}

/// H₀ that lifts a film to a floor; a film that touches anywhere would be no start. `None` where it does not need it.
pub(super) fn lifted(film: &[f64], h_0: f64, floor: f64) -> Option<f64> {
    let lowest = film.iter().copied().fold(f64::INFINITY, f64::min);
    (lowest < floor).then_some(h_0 + floor - lowest)
}
