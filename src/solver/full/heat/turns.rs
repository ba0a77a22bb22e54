//! The way of a solve with heat: from the contact without it, or from a former one with heat.

use super::coupled::{Coupled, Pace};
use crate::solver::full::newton_space::NewtonSpace;
use crate::solver::full::problem::{Problem, SolveError};
use crate::solver::full::report::Report;
use crate::solver::full::solution::Solution;
use crate::solver::full::solver::{Solver, Start, warm_state};
use crate::solver::observer::Observer;
use crate::solver::physics::lubricant::{Cavitation, ScaledHeat};
use std::sync::Arc;

/// Accuracy of the isothermal solution that everything begins with.
const ISOTHERMAL: f64 = 1e-3;

/// Solves a contact with heat: from a former solution with heat, if that leads to none from the contact without heat.
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
    // The front of rupture comes to its place much faster by complementarity, whose pressures those of a penalty are
    // told by.
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

/// The same problem with a film that ruptures by complementarity, where a penalty would.
fn by_complementarity(problem: &Problem) -> Problem {
    let mut fast = *problem;
    if fast.lubricant.cavitation == Cavitation::Penalty {
        fast.lubricant.cavitation = Cavitation::Complementarity;
    }
    fast
}

/// Solves a contact from a solution with heat or without; `report` goes on.
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
        // The pressure at which a penalty is the multiplier.
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
    coupled.look(&system);
    let temperatures = coupled.temperatures(&system, &problem, heat);
    system.warm = None;
    solver.system = Some(system);
    Ok(Solution { heat: Some(Arc::new(temperatures)), ..solver.solution(problem, report)? })
}
