//! Full and reduced solutions of many contacts on all cores. Every solve starts cold, so that results do not depend on
//! order or threads.

use super::error::RunError;
use crate::host::pool::map_with;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::{ContactSolver, Solution, Start};
use crate::solver::observer::{Observer, Progress};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, ReducedSolution};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The observer is notified once per this number of reduced solves.
const REPORT_EVERY: usize = 32;
/// Number of points for which one reduced solver is built. Building its operators costs as much as a few solves.
const CHUNK: usize = 128;

/// Counts the solves of a stage and reports them to the observer.
struct Count<'a> {
    stage: &'static str,
    done: AtomicUsize,
    total: usize,
    /// The observer is notified once per this number of solves.
    every: usize,
    observer: &'a dyn Observer,
}

impl Count<'_> {
    fn one_more(&self) -> Result<(), RunError> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        if (done - 1).is_multiple_of(self.every) {
            self.observer.progress(Progress { stage: self.stage.to_owned(), done, total: self.total });
        }
        if self.observer.cancelled() { Err(RunError::Cancelled) } else { Ok(()) }
    }
}

/// Computes full solutions from cold starts, so that they do not depend on any reduced solution. Each includes its
/// estimated discretisation error; `None` if the solve does not converge. `grid` returns the grid for a point.
pub(super) fn full_solutions(
    grid: impl Fn(&OperatingPoint) -> ContactGrid + Sync,
    points: &[OperatingPoint],
    lubricant: Lubricant,
    observer: &dyn Observer,
) -> Result<Vec<Option<Solution>>, RunError> {
    let contacts: Vec<_> = points.iter().map(|point| (*point, lubricant)).collect();
    full_solutions_told(grid, &contacts, observer, |_, _| {})
}

/// Computes full solutions of contacts with different lubricants, as [`full_solutions`]. `tell` is called with index
/// and solution of each as soon as it is solved, in any order and from any thread.
pub(super) fn full_solutions_told(
    grid: impl Fn(&OperatingPoint) -> ContactGrid + Sync,
    contacts: &[(OperatingPoint, Lubricant)],
    observer: &dyn Observer,
    tell: impl Fn(usize, Option<&Solution>) + Sync,
) -> Result<Vec<Option<Solution>>, RunError> {
    // A full solution may take seconds, so each one is reported.
    let (stage, total) = ("full solutions for comparison", contacts.len());
    let count = Count { stage, done: AtomicUsize::new(0), total, every: 1, observer };
    map_with(contacts, Vec::<ContactSolver>::new, |solvers, i, (point, lubricant)| {
        let grid = grid(point);
        let known = solvers.iter().position(|solver| solver.grid_spec() == grid.spec());
        let known = known.map(|place| solvers.swap_remove(place));
        let mut solver = known.unwrap_or_else(|| ContactSolver::on(&grid));
        let solution = solver.solve(point, *lubricant, Start::Cold, observer);
        let solution = solution.map(|solution| solver.judged(solution));
        solvers.push(solver);
        let solution = solution?;
        count.one_more()?;
        let solution = Some(solution).filter(Solution::converged);
        tell(i, solution.as_ref());
        Ok(solution)
    })
}

/// Computes reduced solutions, with fields for the point indices that `fields` selects; `None` if the iteration does
/// not converge.
pub(super) fn reduced_solutions(
    model: &Arc<ReducedModel>,
    options: ReducedOptions,
    points: &[OperatingPoint],
    lubricant: Lubricant,
    fields: impl Fn(usize) -> bool + Sync,
    observer: &dyn Observer,
) -> Result<Vec<Option<Reduced>>, RunError> {
    let (stage, total) = ("reduced solutions", points.len());
    let count = Count { stage, done: AtomicUsize::new(0), total, every: REPORT_EVERY, observer };
    let chunks: Vec<&[OperatingPoint]> = points.chunks(CHUNK).collect();
    let parts = map_with(
        &chunks,
        || (),
        |(), chunk, points| -> Result<Vec<_>, RunError> {
            let mut online = Online::new(Arc::clone(model), options);
            let solve = |(i, point): (usize, &OperatingPoint)| {
                count.one_more()?;
                online.forget();
                match online.solve(point, lubricant) {
                    Ok(solved) => {
                        let wanted = fields(chunk * CHUNK + i);
                        let fields = if wanted { Some(online.reconstruct(&solved)?) } else { None };
                        Ok(Some(Reduced { solved, fields }))
                    }
                    Err(error) if error.without_solution().is_some() => Ok(None),
                    Err(refused) => Err(refused.into()),
                }
            };
            points.iter().enumerate().map(solve).collect()
        },
    )?;
    Ok(parts.into_iter().flatten().collect())
}

/// Reduced solution, with fields if requested.
pub(super) struct Reduced {
    /// Reduced coefficients and error estimates.
    pub solved: ReducedSolution,
    /// Fields on the grid of the local model.
    pub fields: Option<Solution>,
}

/// Returns the relative errors of H_c, central film thickness, and of H_min, minimum film thickness, against full
/// solutions, for all contacts that have both solutions.
pub(super) fn film_errors(reduced: &[Option<Reduced>], full: &[Option<Solution>]) -> [Vec<f64>; 2] {
    let mut errors: [Vec<f64>; 2] = Default::default();
    for (reduced, full) in reduced.iter().zip(full) {
        if let (Some(fields), Some(full)) = (reduced.as_ref().and_then(|r| r.fields.as_ref()), full) {
            errors[0].push((fields.scalars.h_c / full.scalars.h_c - 1.0).abs());
            errors[1].push((fields.scalars.h_min / full.scalars.h_min - 1.0).abs());
        }
    }
    errors
}
