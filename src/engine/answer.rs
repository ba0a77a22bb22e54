//! Solves a request by the full solver or a reduced model and returns the answer: results, trust and warnings. The
//! window, the commands, studies, bindings and campaigns all use [`answer`], so that they report the same.

use super::{Answer, ContactResult, EngineError, ReducedFacts, Request};
use crate::host::clock::Stopwatch;
use crate::scene::Effort;
use crate::solver::full::heat::Temperatures;
use crate::solver::full::point::resolution_warning;
use crate::solver::full::{ContactSolver, Problem, Start};
use crate::solver::observer::Observer;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{Online, ReducedError, ReducedModel, ReducedSolution, Trust, Window};
use crate::solver::warning::Warning;

/// Solver for a request. Its work space belongs to the caller.
pub enum Solver<'a> {
    /// Full system on the solver's grid, from an initial guess.
    Full(&'a mut ContactSolver, Start<'a>),
    /// Reduced model with its operators and stored solutions.
    Reduced(&'a mut Online),
}

/// Solves a request. Also returns an answer if the solve does not converge, or if the observer cancels a full solve.
///
/// # Errors
/// If the request is refused, or the observer cancels a reduced solve.
pub fn answer(request: &Request, solver: Solver<'_>, observer: &dyn Observer) -> Result<Answer, EngineError> {
    let problem = Problem::new(&request.point, request.lubricant)?;
    let answer = match solver {
        Solver::Full(solver, start) => in_full(request, solver, start, observer)?,
        Solver::Reduced(online) => by_model(request, &problem, online, observer)?,
    };
    Ok(with_warnings(&problem, answer))
}

/// Returns the answer for a solution that a reduced model has computed already. Its wall time is 0.
///
/// # Errors
/// If the request is refused, or if the solution is of another model.
pub(super) fn answer_of(request: &Request, online: &Online, solved: ReducedSolution) -> Result<Answer, EngineError> {
    let problem = Problem::new(&request.point, request.lubricant)?;
    Ok(with_warnings(&problem, reconstructed(request, &problem, online, (Ok(solved), 0.0))?))
}

/// Adds the warnings that are the same for both solvers: on grid, domain, temperatures, pressure and traction.
fn with_warnings(problem: &Problem, mut answer: Answer) -> Answer {
    let ContactResult { warnings, traction, scalars, reduced, mixed, .. } = &mut answer.result;
    if let Some(solution) = answer.solution.as_ref().filter(|_| scalars.is_some()) {
        warnings.extend(solution.grid_warning());
        warnings.extend(resolution_warning(solution));
        warnings.extend(mixed.and_then(|mixed| mixed.warning()));
        warnings.extend(solution.warning_of_ends());
        let peclet = problem.heat.as_ref().map(|heat| heat.smallest_peclet(&problem.point));
        warnings.extend(peclet.and_then(Warning::of_peclet));
        warnings.extend(solution.heat.as_deref().and_then(Temperatures::too_hot));
        let heat = solution.heat.as_deref().filter(|_| reduced.is_none());
        warnings.extend(heat.and_then(Temperatures::heat_lost));
    }
    let (hertz_pressure, modulus) = (answer.request.point.hertz().pressure_pa, answer.request.point.modulus_pa);
    warnings.extend(Warning::of_hertz_pressure(hertz_pressure));
    warnings.extend(Warning::of_strain(hertz_pressure, modulus));
    let traction = mixed.map_or(*traction, |mixed| Some(mixed.fluid_traction));
    let doubt = traction.zip(*scalars).and_then(|(traction, scalars)| problem.doubts_traction(traction, &scalars));
    warnings.extend(doubt.map(Warning::from));
    answer
}

/// Solves a request by the full solver.
fn in_full(
    request: &Request,
    solver: &mut ContactSolver,
    start: Start<'_>,
    observer: &dyn Observer,
) -> Result<Answer, EngineError> {
    let clock = Stopwatch::start();
    let solution = solver.solve(&request.point, request.lubricant, start, observer)?;
    let wall_s = clock.seconds();
    let solution = solver.judged(solution);
    let report = &solution.report;
    let (nx, ny) = (solution.x.len(), solution.y.len());
    let nodes = (nx - solution.mesh.spec.first_column(), ny);
    // All pressures inside the domain, and the separation.
    let dofs = if request.point.kind.is_line() { nx - 2 } else { (nx - 2) * (ny - 1) + 1 };
    let (newton_iterations, linear_iterations) = (report.newton_iterations, Some(report.linear_iterations));
    let effort = Effort { nodes, dofs, newton_iterations, linear_iterations, wall_s };
    let mut result = ContactResult::new(request, Some(&solution), None, effort);
    if !solution.converged() {
        result.warnings.push(Warning::NotConverged {
            ending: report.describe(),
            newton_iterations,
            attempts: report.attempts,
            residual_norm: report.residual_norm,
        });
    }
    result.warnings.extend(report.cautious_front.then_some(Warning::CavitationBoundaryOscillated));
    Ok(Answer { request: request.clone(), result, solution: Some(solution) })
}

/// Solves a request by a reduced model.
fn by_model(
    request: &Request,
    problem: &Problem,
    online: &mut Online,
    observer: &dyn Observer,
) -> Result<Answer, EngineError> {
    // Operators are part of the model, so the wall time does not contain their preparation.
    online.prepare(&problem.point);
    let clock = Stopwatch::start();
    let solved = online.solve_watched(&problem.point, request.lubricant, observer);
    let wall_s = clock.seconds();
    reconstructed(request, problem, online, (solved, wall_s))
}

/// Returns the answer for a finished reduced solve with its wall time \[s\]. Reconstructs the fields of the solution.
/// If the solve did not converge, the answer contains a warning.
fn reconstructed(
    request: &Request,
    problem: &Problem,
    online: &Online,
    (solved, wall_s): (Result<ReducedSolution, ReducedError>, f64),
) -> Result<Answer, EngineError> {
    let model = &online.model;
    let (mut warnings, trained_with) = (Vec::new(), model.domain.lubricant.cavitation);
    let trust = solved.as_ref().map_or_else(|_| model.trust(problem), |solved| solved.trust.clone());
    let trained = trust == Trust::Trained;
    warnings.extend(outside(trust));
    // Complementarity is the limit of the penalty for a large penalty factor, and of the mass-conserving model for a
    // flooded inlet. A model trained with it also covers these two.
    let asked = request.lubricant.cavitation;
    if trained_with == Cavitation::Penalty && asked != trained_with && problem.supply.is_none() {
        warnings.push(Warning::CavitationOfTraining { asked: asked.name().to_owned() });
    }
    let (index, window) = window_of(model, &problem.point)?;
    let mut facts = ReducedFacts { size: window.size(), window: index, trained, residual_estimate: None, error: None };
    let mut effort = Effort {
        nodes: window.grid.nodes(),
        dofs: facts.size.pressure + 1,
        newton_iterations: 0,
        linear_iterations: None,
        wall_s,
    };
    let (mut solution, mut traction) = (None, None);
    match solved {
        Ok(solved) => {
            (facts.window, facts.size.pressure) = (solved.window, solved.coefficients.len());
            (facts.residual_estimate, facts.error) = (Some(solved.residual_estimate), solved.error);
            (effort.dofs, effort.newton_iterations) = (facts.size.pressure + 1, solved.iterations);
            warnings.extend(solved.by_neighbour.then_some(Warning::NeighbouringModel));
            traction = solved.traction;
            // The fields are valid for this problem: sliding does not change the film of a Newtonian lubricant.
            solution = Some(online.reconstruct(&solved)?.of_problem(*problem));
        }
        Err(ReducedError::Cancelled) => return Err(EngineError::Cancelled),
        Err(error) => {
            effort.newton_iterations = error.without_solution().ok_or_else(|| error.clone())?;
            warnings.push(Warning::NoReducedSolution { reason: error.to_string() });
        }
    }
    let mut result = ContactResult::new(request, solution.as_ref(), Some((facts, trained_with, traction)), effort);
    if let (Some(facts), Some(mixed), Some(rough)) = (&mut result.reduced, &result.mixed, problem.lubricant.roughness) {
        facts.error = facts.error.map(|error| error.with_boundary_friction(mixed, rough.boundary_friction));
    }
    Ok(Answer { request: request.clone(), result: ContactResult { warnings, ..result }, solution })
}

/// Returns the warning for a contact outside the trained range; `None` inside.
pub(super) fn outside(trust: Trust) -> Option<Warning> {
    match trust {
        Trust::Trained => None,
        Trust::Outside(outside) => Some(Warning::OutsideTrainedRange { outside }),
    }
}

/// Returns the local model for a contact, with its index.
///
/// # Errors
/// If the model contains no local model.
pub(super) fn window_of<'a>(
    model: &'a ReducedModel,
    point: &OperatingPoint,
) -> Result<(usize, &'a Window), EngineError> {
    let none = || EngineError::Study(format!("the reduced model `{}` contains no local model", model.title));
    let index = model.window_for(point);
    model.windows.get(index).map(|window| (index, window)).ok_or_else(none)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::job::Event;
    use crate::engine::{Store, embedded};
    use crate::scene::{Grid, Method, ModelSource, StudyRow};
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::observer::Progress;
    use crate::solver::physics::engineering::Extent;
    use crate::solver::physics::lubricant::{Heat, Lubricant};
    use crate::solver::reduced::ReducedOptions;
    use serde::Serialize;
    use serde::de::DeserializeOwned;
    use std::sync::Arc;

    /// Serialises a value and reads it back.
    fn round_trip<T: Serialize + DeserializeOwned>(value: &T) -> T {
        let text = ron::to_string(value).unwrap();
        let read = ron::from_str(&text).unwrap_or_else(|refused| panic!("{refused}: {text}"));
        assert_eq!(ron::to_string(&read).unwrap(), text);
        read
    }

    #[test]
    fn requests_answers_and_events_are_values() {
        let spec = GridSpec::Uniform { dx: 0.02, domain: (-4.0, 2.0) };
        let store = Store::default();
        let grid = store.grid(spec).unwrap();
        let request = |lubricant: Lubricant, method: Method| {
            let (point, grid_model) = (OperatingPoint::TABLE_2_1, ModelSource::Embedded);
            Request { point, lubricant, grid: Grid::from(spec), grid_model, method, extent: Extent::default() }
        };
        let starved =
            Lubricant { cavitation: Cavitation::MassConserving { supply_film_m: Some(5e-8) }, ..Lubricant::default() };
        let in_full = |lubricant: Lubricant| {
            store.with_full_solver(&grid, |solver| {
                answer(&request(lubricant, Method::Full), Solver::Full(solver, Start::Cold), &()).unwrap()
            })
        };
        let mut online = store.online(&embedded("line").unwrap(), ReducedOptions::default());
        let by_model = answer(&request(starved, Method::EMBEDDED), Solver::Reduced(&mut online), &()).unwrap();
        let outside = |warning: &Warning| matches!(warning, Warning::OutsideTrainedRange { .. });
        assert!(by_model.result.untrained() && by_model.result.warnings.iter().any(outside));
        for answer in [in_full(Lubricant::default()), in_full(starved), by_model] {
            assert!(answer.result.converged);
            assert_eq!(round_trip(&answer), answer);
            round_trip(&Event::Message(StudyRow::Point(Arc::new(answer))));
        }
        // A thermal solution contains data for the next thermal march. They are recomputed instead of serialised.
        let warm = in_full(Lubricant { heat: Some(Heat::default()), ..Lubricant::default() });
        let read = round_trip(&warm);
        assert_eq!((&read.request, &read.result), (&warm.request, &warm.result));
        let progress = Event::<StudyRow>::Stage(Progress { stage: "solving".to_owned(), done: 1, total: 3 });
        round_trip(&progress);
        round_trip(&Event::<StudyRow>::Ended(Err("no solution".to_owned().into())));
    }
}
