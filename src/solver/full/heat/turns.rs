//! Stages of a thermal solve: from a previous thermal solution if there is one, then from the isothermal solution.

use super::coupled::{Coupled, Pace};
use crate::solver::full::newton_space::NewtonSpace;
use crate::solver::full::problem::{Problem, SolveError};
use crate::solver::full::report::Report;
use crate::solver::full::solution::Solution;
use crate::solver::full::solver::{Solver, Start, warm_state};
use crate::solver::observer::Observer;
use crate::solver::physics::lubricant::{Cavitation, ScaledHeat};
use std::sync::Arc;

/// Accuracy of the initial isothermal solution.
const ISOTHERMAL: f64 = 1e-3;

/// Solves a thermal contact, first from a previous thermal solution. If that does not converge, from the isothermal
/// solution.
pub(in crate::solver::full) fn solve<S: NewtonSpace>(
    solver: &mut Solver<S>,
    problem: Problem,
    start: Start<'_>,
    observer: &dyn Observer,
) -> Result<Solution, SolveError> {
    let Some(heat) = problem.heat else { return solver.solve_problem(problem, start, observer) };
    let mut spent = Report::empty();
    if let Some(former) = start.former(&problem).filter(|former| former.heat.is_some()) {
        let solution = from(solver, problem, &heat, (former, Pace::QUICK), spent, observer)?;
        if solution.report.ended() {
            return Ok(solution);
        }
        spent = solution.report;
    }
    // The cavitation boundary converges much faster by complementarity. The pressures of the penalty follow from its
    // multipliers.
    let fast = by_complementarity(&problem);
    let options = solver.options;
    solver.options.tolerance = ISOTHERMAL;
    let cold = solver.solve_problem(fast.isothermal(), start, observer);
    solver.options = options;
    let cold = cold?;
    spent.add(&cold.report);
    if !cold.converged() {
        return Ok(Solution { problem, report: spent, ..cold });
    }
    let solution = from(solver, problem, &heat, (&cold, Pace::QUICK), spent, observer)?;
    if solution.report.ended() {
        return Ok(solution);
    }
    from(solver, problem, &heat, (&cold, Pace::SLOW), solution.report, observer)
}

/// Returns the same problem with complementarity instead of the penalty.
fn by_complementarity(problem: &Problem) -> Problem {
    let mut fast = *problem;
    if fast.lubricant.cavitation == Cavitation::Penalty {
        fast.lubricant.cavitation = Cavitation::Complementarity;
    }
    fast
}

/// Solves a contact from a thermal or isothermal solution. Adds the effort to `report`.
fn from<S: NewtonSpace>(
    solver: &mut Solver<S>,
    problem: Problem,
    heat: &ScaledHeat,
    (former, pace): (&Solution, Pace),
    mut report: Report,
    observer: &dyn Observer,
) -> Result<Solution, SolveError> {
    let mut system = solver.system_for(&problem)?;
    warm_state(&mut system, &problem, former, None);
    if problem.lubricant.cavitation == Cavitation::Penalty && former.multiplier.len() == system.pressure.len() {
        // Pressure at which the penalty equals the multiplier.
        for (p, multiplier) in system.pressure.iter_mut().zip(&former.multiplier) {
            *p -= multiplier / solver.options.penalty;
        }
        let h_0 = system.h_0;
        system.deform();
        system.set_h_0(h_0);
    }
    report.attempts += 1;
    let mut coupled = Coupled::new(&system, former.heat.as_deref());
    coupled.turn(&mut system, &problem, (&solver.options, pace), observer, &mut report);
    coupled.look(&system, &problem);
    let temperatures = coupled.temperatures(&system, &problem, heat);
    system.warm = None;
    solver.system = Some(system);
    Ok(Solution { heat: Some(Arc::new(temperatures)), ..solver.solution(problem, report)? })
}
