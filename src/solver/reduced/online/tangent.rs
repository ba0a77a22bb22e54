//! Reduced solutions of contacts close to a solved one, for derivatives by differences. All have its cavitation
//! boundary. They are converged solutions, or follow to first order from the linearised sampled equations.

use super::attempt::{Found, Watch, attempt, case_of};
use super::{Online, ReducedError, ReducedOptions};
use crate::solver::full::Problem;
use crate::solver::reduced::ReducedSolution;
use crate::solver::reduced::operators::{Start, Stop};
use crate::solver::reduced::start::Guess;
use std::sync::Arc;

/// Stopping tolerance of [`Online::solve_beside`].
const TOLERANCE: f64 = 1e-9;

/// Returns the number of modes in use. Modes that an iteration omitted have the coefficient zero.
fn modes_of(solved: &ReducedSolution) -> usize {
    solved.coefficients.iter().rposition(|value| *value != 0.0).map_or(1, |last| last + 1)
}

impl Online {
    /// Solves a contact close to that of `solved`, with the cavitation boundary and the modes of `solved`. `None` if
    /// the iteration fails, or if other local models are blended into `solved`.
    ///
    /// # Errors
    /// [`ReducedError`] if the contact is refused or if the solution belongs to another model.
    pub fn solve_beside(
        &mut self,
        solved: &ReducedSolution,
        problem: &Problem,
    ) -> Result<Option<ReducedSolution>, ReducedError> {
        if !solved.beside.is_empty() {
            return Ok(None);
        }
        self.prepare_window(solved.window);
        let model = Arc::clone(&self.model);
        let own = model.domain.as_solved(problem)?;
        let (Some(window), Some(operators)) =
            (model.windows.get(solved.window), self.windows.get_mut(solved.window).and_then(|cell| cell.get_mut()))
        else {
            return Err(ReducedError::Empty);
        };
        let mut coefficients = solved.coefficients.clone();
        coefficients.truncate(modes_of(solved));
        let theta = solved.heat.as_ref().map(|heat| heat.theta.clone()).unwrap_or_default();
        let guess = Guess { coefficients, h_c: solved.h_c, fronts: solved.fronts.clone(), theta };
        let options = ReducedOptions { tolerance: TOLERANCE, ..self.options };
        let watch = &mut Watch { holds_front: true, ..Watch::of(&()) };
        let found = attempt(window, operators, &own, &guess, usize::MAX, &options, watch).ok();
        Ok(found.map(|found| self.solution_beside(problem, solved, found)))
    }

    /// Returns an iteration in the local model of `solved` as the solution of a contact close to that of `solved`.
    fn solution_beside(&self, problem: &Problem, solved: &ReducedSolution, found: Found) -> ReducedSolution {
        let by_neighbour = solved.by_neighbour;
        let own = self.solution_of(problem, solved.window, found);
        ReducedSolution { error: own.error.filter(|_| !by_neighbour), by_neighbour, ..own }
    }

    /// Returns the solutions of the two contacts `ends` to first order. The contacts lie on both sides of that of
    /// `solved`, at equal small distances. The solutions follow from the sampled equations, linearised with the
    /// cavitation boundary of `solved`.
    ///
    /// `None` for thermal models, for residual minimisation, if the contacts have ellipses of different shape, if other
    /// local models are blended in at the ends than in `solved`, or if an iteration fails.
    ///
    /// # Errors
    /// [`ReducedError`] if a contact is refused or if the solution belongs to another model.
    pub fn beside(
        &mut self,
        solved: &ReducedSolution,
        ends: &[Problem; 2],
    ) -> Result<Option<[ReducedSolution; 2]>, ReducedError> {
        let Some([mut before, mut after]) = self.beside_in_window(solved, solved.own_h_0(), ends)? else {
            return Ok(None);
        };
        let shares = ends.each_ref().map(|end| self.model.blended(end.moes));
        if shares.iter().any(|shares| shares.len() != solved.beside.len()) {
            return Ok(None);
        }
        let [of_before, of_after] = shares;
        for (((_, other), first), last) in solved.beside.iter().zip(of_before).zip(of_after) {
            let same = first.1 == other.window && last.1 == other.window;
            let others = if same { self.beside_in_window(other, other.h_0, ends)? } else { None };
            let Some([other_before, other_after]) = others else { return Ok(None) };
            before.beside.push((first.0, other_before));
            after.beside.push((last.0, other_after));
        }
        before.blend();
        after.blend();
        Ok(Some([before, after]))
    }

    /// Does the same as [`Self::beside`] for the local model of `solved`, whose rigid-body separation is `h_0`.
    fn beside_in_window(
        &mut self,
        solved: &ReducedSolution,
        h_0: f64,
        ends: &[Problem; 2],
    ) -> Result<Option<[ReducedSolution; 2]>, ReducedError> {
        let at = Problem::new(&solved.point, solved.lubricant)?;
        let same_shape = |end: &Problem| end.point.ellipse() == at.point.ellipse();
        if at.heat.is_some() || !ends.iter().all(same_shape) {
            return Ok(None);
        }
        self.prepare_window(solved.window);
        let model = Arc::clone(&self.model);
        let as_solved = |problem: &Problem| model.domain.as_solved(problem);
        let equations = (as_solved(&at)?, [as_solved(&ends[0])?, as_solved(&ends[1])?]);
        let (Some(window), Some(operators)) =
            (model.windows.get(solved.window), self.windows.get_mut(solved.window).and_then(|cell| cell.get_mut()))
        else {
            return Err(ReducedError::Empty);
        };
        if solved.coefficients.len() != operators.modes() {
            return Err(ReducedError::Empty);
        }
        let case = |problem| case_of(window, problem, &self.options, Stop::default());
        let (middle, cases) = (case(&equations.0), equations.1.each_ref().map(case));
        let modes = modes_of(solved);
        let start = Start { window, modes, fronts: Some(&solved.fronts), held: true, theta: &[] };
        let mut state: Vec<f64> = solved.coefficients.iter().copied().chain([h_0]).collect();
        let Some(direction) = operators.tangent([&middle, &cases[0], &cases[1]], &start, &mut state) else {
            return Ok(None);
        };
        let found = [-1.0, 1.0].map(|sign| {
            let case = &cases[usize::from(sign > 0.0)];
            let mut coefficients: Vec<f64> = state.iter().zip(&direction).map(|(own, by)| own + sign * by).collect();
            let residual = operators.residual(case, &coefficients);
            let h_0 = coefficients.pop().unwrap_or(f64::NAN);
            operators.aim(window, case.scale);
            let h_c = h_0 + (operators.lifted(&coefficients) - 0.5 * case.scale.ln());
            let readings = operators.read(case, &coefficients, h_0);
            let (traction, fronts) = (readings.traction, readings.fronts.clone());
            Found { coefficients, h_0, h_c, iterations: solved.iterations, residual, traction, fronts, heat: None }
        });
        let [before, after] = found;
        let moved = |found: Found, problem: &Problem| self.solution_beside(problem, solved, found);
        Ok(Some([moved(before, &ends[0]), moved(after, &ends[1])]))
    }
}
