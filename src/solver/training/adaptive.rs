//! Automatic algorithm of section 3.1.3 (Fig. 3.2), and a greedy algorithm.
//!
//! Both start with solutions computed at the points of (3.16).
//!
//! - [`Plan::Adaptive`] searches the whole range for bad approximations by (3.17). At the first one it looks for a
//!   worse one nearby, adds its full solution, and retrains. Then it searches the neighbourhood by (3.18) before it
//!   continues globally. Enough good approximations in a row end the current tolerance.
//! - [`Plan::WorstOfPool`] judges a whole pool per round and adds the worst points.
//!
//! A failed reduced solve counts as worst.
//!
//! Judging a point by the correction costs three full Newton steps, compared with 15 for a cold full solution. If few
//! good approximations in a row suffice, the largest error is left to chance; the scenes require 300. The greedy
//! algorithm judges twice as many points for the same errors, but retrains less often.
//!
//! Points are drawn in order and judged in parallel, so that the result depends on the seed but not on the number of
//! threads.

use super::build::WindowTraining;
use super::error::TrainingError;
use super::indicator::Judges;
use super::plan::{Drawn, global_point, local_point};
use super::search::BadPoint;
use super::spec::Plan;
use super::state::{Part, TrainingState, WindowState};
use crate::solver::observer::Progress;
use crate::solver::parameters::separation;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{Sampling, Window};
use fastrand::Rng;

/// Number of points that a search judges at a time.
const BATCH: usize = 16;

/// Searches local model `k` to the end and returns its last state; `None` if it needs more modes than permitted. A
/// cubature takes longer than a round of the search. In this case the model with all rows is judged, and the
/// equations are sampled once at the end.
pub(super) fn search(
    work: &mut WindowTraining<'_>,
    state: &mut TrainingState,
    k: usize,
    row_seed: u64,
) -> Result<Option<Window>, TrainingError> {
    loop {
        work.solve_pending(state, Part::Window(k))?;
        let own = &mut state.windows[k];
        let Some(mut window) = work.assemble(&own.solved)? else { return Ok(None) };
        let all_rows = work.spec.sampling == Sampling::Cubature;
        if !all_rows {
            window = work.sample(window, &mut Rng::with_seed(row_seed))?;
        }
        if !own.search.finished {
            let chosen = match &work.spec.plan {
                plan @ Plan::Adaptive { .. } => find_bad(work, plan, &window, own)?.into_iter().collect(),
                plan => worst_of_pool(work, plan, &window, own)?,
            };
            own.decide(chosen);
        }
        if own.search.finished {
            if all_rows {
                window = work.sample(window, &mut Rng::with_seed(row_seed))?;
            }
            return Ok(Some(window));
        }
    }
}

fn judge(judges: &mut Judges<'_>, drawn: &[Drawn], own: &WindowState) -> Result<Vec<f64>, TrainingError> {
    let points: Vec<OperatingPoint> = drawn.iter().map(|(_, point)| *point).collect();
    let mut errors = judges.judge(&points)?;
    for (error, point) in errors.iter_mut().zip(&points) {
        // A point with a known solution cannot be added again.
        if own.solved.iter().any(|s| s.point == *point) {
            *error = 0.0;
        }
    }
    Ok(errors)
}

/// Runs the dissertation's search until a bad approximation is found, and returns the worst in its vicinity; `None`
/// if the search ends.
fn find_bad(
    work: &WindowTraining<'_>,
    plan: &Plan,
    window: &Window,
    own: &mut WindowState,
) -> Result<Option<OperatingPoint>, TrainingError> {
    let Plan::Adaptive { indicator, tolerances, successes, local_sigma, local_successes, vicinity, limit, .. } = plan
    else {
        return Ok(None);
    };
    let mut judges = Judges::new(*indicator, work.spec, window, work.observer);
    let coordinates = work.spec.range.coordinates();
    loop {
        let Some(&tolerance) = tolerances.get(own.search.rung).filter(|_| own.solved.len() < *limit) else {
            own.search.finished = true;
            return Ok(None);
        };
        let stage = format!("Search at tolerance {tolerance:e}, {} solutions", own.solved.len());
        work.observer.progress(Progress { stage, done: own.search.successes, total: *successes });
        let mut rng = Rng::with_seed(own.search.random);
        let drawn = work.within().drawn(BATCH, || match own.search.local {
            Some((centre, _)) => local_point(centre, *local_sigma, coordinates, &mut rng),
            None => global_point(coordinates, &mut rng),
        });
        let errors = judge(&mut judges, &drawn, own)?;
        let mut next = own.search.clone();
        next.judged += drawn.len();
        next.failed += errors.iter().filter(|e| e.is_infinite()).count();
        let bad = errors.iter().position(|e| *e > tolerance);
        if let Some(bad) = bad {
            let centre = drawn[bad].0;
            let mut around = vec![drawn[bad]];
            around.extend(
                work.within().drawn(*vicinity, || local_point(centre, 0.5 * local_sigma, coordinates, &mut rng)),
            );
            let errors = judge(&mut judges, &around, own)?;
            next.judged += around.len() - 1;
            // The first of equal errors, so that failures do not drift.
            let worst = (0..around.len()).rev().max_by(|&a, &b| errors[a].total_cmp(&errors[b])).unwrap_or(0);
            next.bad.push(BadPoint {
                point: around[worst].1,
                indicator: errors[worst],
                solutions: own.solved.len(),
                rung: next.rung,
            });
            next.successes = 0;
            next.local = (*local_successes > 0).then_some((around[worst].0, 0));
            next.random = rng.get_seed();
            own.search = next;
            return Ok(Some(around[worst].1));
        }
        next.random = rng.get_seed();
        match &mut next.local {
            Some((_, good)) if *good + drawn.len() < *local_successes => *good += drawn.len(),
            Some(_) => next.local = None,
            None => {
                next.successes += drawn.len().max(1);
                if next.successes >= *successes {
                    (next.rung, next.successes) = (next.rung + 1, 0);
                    next.rungs.push(own.solved.len());
                }
            }
        }
        own.search = next;
    }
}

/// Runs one round of the greedy algorithm: returns the worst points of a new pool that are not near each other.
fn worst_of_pool(
    work: &WindowTraining<'_>,
    plan: &Plan,
    window: &Window,
    own: &mut WindowState,
) -> Result<Vec<OperatingPoint>, TrainingError> {
    let Plan::WorstOfPool { indicator, pool, per_round, tolerance, limit, .. } = plan else { return Ok(Vec::new()) };
    let known = own.solved.len();
    if known >= *limit {
        own.search.finished = true;
        return Ok(Vec::new());
    }
    work.observer.progress(Progress { stage: format!("Worst of {pool}"), done: known, total: *limit });
    let mut rng = Rng::with_seed(own.search.random);
    let drawn = work.within().drawn(*pool, || global_point(work.spec.range.coordinates(), &mut rng));
    let errors = judge(&mut Judges::new(*indicator, work.spec, window, work.observer), &drawn, own)?;
    own.search.random = rng.get_seed();
    own.search.judged += drawn.len();
    own.search.failed += errors.iter().filter(|e| e.is_infinite()).count();
    let mut order: Vec<usize> = (0..drawn.len()).filter(|&i| errors[i] > *tolerance).collect();
    order.sort_by(|&a, &b| errors[b].total_cmp(&errors[a]));
    let mut chosen: Vec<OperatingPoint> = Vec::new();
    for (candidate, indicator) in order.into_iter().map(|i| (drawn[i].1, errors[i])) {
        if chosen.len() == (*per_round).min(limit - known) {
            break;
        }
        // A point nearer to another one of this round than to all known solutions may be good after retraining.
        let nearest = window.nearest(&candidate).map_or(f64::INFINITY, |(_, d)| d);
        if chosen.iter().all(|c| separation(c, &candidate) >= nearest) {
            chosen.push(candidate);
            own.search.bad.push(BadPoint { point: candidate, indicator, solutions: known, rung: own.search.rung });
        }
    }
    if chosen.is_empty() {
        own.search.rungs.push(known);
        own.search.finished = true;
    }
    Ok(chosen)
}
