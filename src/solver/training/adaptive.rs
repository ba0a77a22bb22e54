//! The automatic algorithm of section 3.1.3 (Fig. 3.2), and a greedy beside it.
//!
//! Both begin with solutions pre-computed by (3.16). [`Plan::Adaptive`] then looks for bad approximations over the whole range by
//! (3.17); at the first one it looks around for a worse one, adds its full solution, retrains, and searches its neighbourhood
//! by (3.18) before it goes on globally. Enough good approximations in a row end a rung of the ladder of tolerances.
//! [`Plan::WorstOfPool`] judges a whole pool per round and adds the worst. A failed reduced solve counts as worst.
//!
//! Measured (Table 3.1's box, graded grid of 632 nodes, loss 1e-7, 2,000 full comparisons, seeds 1 / 2 / 3; no failures anywhere):
//!
//! | plan | full solutions | H_c 95 % | H_c max | H_min max |
//! |---|---|---|---|---|
//! | **adaptive, start 60, correction 1e-2 → 3e-3 → 1e-3, 100 successes** | 81 / 77 / 88 | 7.1e-4 / 5.1e-4 / 4.2e-4 | 1.7e-3 / 3.4e-3 / 1.2e-3 | 9.7e-4 / 9.3e-4 / 2.8e-4 |
//! | the same, 60 successes | 70 / 77 / 78 | 1.8e-3 / 4.8e-4 / 5.8e-4 | 7.1e-3 / 3.0e-3 / 8.8e-3 | 2.2e-3 / 1.1e-3 / 2.3e-2 |
//! | adaptive, start 50, residual 1 → 0.3 → 0.15, 100 successes | 95 / 91 / 89 | 1.6e-4 / 6.0e-4 / 1.4e-4 | 2.1e-3 / 6.8e-3 / 5.7e-3 | 9.0e-4 / 1.1e-3 / 4.7e-4 |
//! | the same without local search and vicinity | 97 / 90 / 85 | 1.0e-4 / 2.1e-4 / 9.6e-4 | 3.8e-4 / 1.0e-3 / 2.5e-3 | 2.9e-4 / 2.3e-4 / 2.9e-4 |
//! | worst 3 of 300, start 60, correction 1e-3 | 79 (seed 1) | 5.8e-4 | 1.9e-3 | 8.0e-4 |
//! | worst 3 of 300, start 50, correction 1e-3 | 89 (seed 1) | 3.5e-4 | 1.1e-3 | 2.6e-4 |
//! | worst 3 of 300, start 60, residual 0.1 | 104 (seed 1) | 1.1e-4 | 3.1e-4 | 2.3e-5 |
//! | pre-computed only, 100 / 120 (seed 1) | 100 / 120 | 3.4e-4 / 1.3e-4 | 2.4e-3 / 3.7e-4 | 2.2e-4 / 1.2e-4 |
//!
//! The first row is what the scenes use. The greedy was run with one seed only, which ranks it neither above nor below: at about 80 solutions
//! it is within what the seeds of the first row differ by, and judges twice the points. 60 successes in a row are too few for the maximum.
//! With the residual, local search and vicinity did not pay in these three seeds. The correction's 950–1,350 judged points cost two full
//! Newton steps each, which the column of full solutions does not count; a cold full solution takes about 15. All rows share one set of
//! test points and were taken before linear algebra was put on one thread, which changes a model in its rounding, and results
//! near a tolerance with it.
//!
//! Points are drawn in order and judged in parallel, so that the result follows the seed whatever the number of threads.

use super::build::Shop;
use super::indicator::{Indicator, Judges};
use super::plan::{Drawn, admissible, global_point, local_point};
use super::state::{Part, TrainingState, WindowState};
use super::{Plan, Progress, TrainingError};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{Sampling, Window, separation};
use fastrand::Rng;
use serde::{Deserialize, Serialize};

/// Points judged at a time by the searches.
const BATCH: usize = 16;

/// Where a search for bad approximations is.
#[derive(Clone, Debug, PartialEq, Default, Serialize, Deserialize)]
pub struct Search {
    /// Whether it was begun.
    pub begun: bool,
    /// State of the random numbers.
    pub random: u64,
    /// Rung of the ladder of tolerances.
    pub rung: usize,
    /// Good approximations in a row, of the global search.
    pub successes: usize,
    /// Centre of the local search (unit cube) and its good approximations in a row.
    pub local: Option<([f64; 4], usize)>,
    /// Points judged so far.
    pub judged: usize,
    /// Reduced solves that failed so far.
    pub failed: usize,
    /// Full solutions when each rung was done.
    pub rungs: Vec<usize>,
    /// Bad approximations in the order in which they were found.
    pub bad: Vec<BadPoint>,
    /// Whether it is over.
    pub finished: bool,
}

/// A bad approximation that a search came upon and had solved in full.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BadPoint {
    /// Where.
    pub point: OperatingPoint,
    /// What the indicator said; infinite where the reduced solve failed.
    pub indicator: f64,
    /// Full solutions of its window when it was found.
    pub solutions: usize,
    /// Rung of the ladder of tolerances on which it was found.
    pub rung: usize,
}

/// Refuses numbers that make no plan.
pub(super) fn check(start: usize, tolerances: &[f64], limit: usize) -> Result<(), TrainingError> {
    let refuse = |sentence| Err(TrainingError::Specification(sentence));
    if !(4..=5000).contains(&start) || !(start..=5000).contains(&limit) {
        return refuse(format!(
            "the plan starts with {start} snapshots and stops at {limit}; at least 4 and at most 5000 are accepted"
        ));
    }
    let positive = tolerances.iter().all(|t| t.is_finite() && *t > 0.0);
    if tolerances.is_empty() || !positive || tolerances.windows(2).any(|t| t[0] <= t[1]) {
        return refuse("the tolerances must be positive and descending, at least one".to_owned());
    }
    Ok(())
}

impl Search {
    /// Begins, unless it has begun.
    pub(super) fn begin(&mut self, seed: u64) {
        if !self.begun {
            (self.begun, self.random) = (true, seed);
        }
    }

    /// What it did, for the model's log.
    pub(super) fn describe(&self, plan: &Plan) -> Option<String> {
        let (indicator, tolerances) = match plan {
            Plan::Adaptive { indicator, tolerances, .. } => (*indicator, tolerances.as_slice()),
            Plan::WorstOfPool { indicator, tolerance, .. } => (*indicator, std::slice::from_ref(tolerance)),
            _ => return None,
        };
        let judged_by = match indicator {
            Indicator::Residual => "the residual (3.15)",
            Indicator::Dissertation => "the residual (3.15) of the dissertation's scheme",
            Indicator::Correction => "three full Newton steps each",
        };
        let mut text = format!("{} points judged by {judged_by}, {} reduced solves failed", self.judged, self.failed);
        for (tolerance, solutions) in tolerances.iter().zip(&self.rungs) {
            text += &format!("; tolerance {tolerance:e} met with {solutions} solutions");
        }
        if let Some(missed) = tolerances.get(self.rungs.len()) {
            text += &format!("; tolerance {missed:e} was not met");
        }
        Some(text)
    }
}

/// Searches window `k` to the end; returns its last model, or `None` once it needs more modes than it may have. A cubature takes longer
/// than a round of the search: there it is the model with all rows that is judged, and rows are sampled once at the end.
pub(super) fn search(
    shop: &mut Shop<'_>,
    state: &mut TrainingState,
    k: usize,
    row_seed: u64,
) -> Result<Option<Window>, TrainingError> {
    loop {
        shop.solve_pending(state, Part::Window(k))?;
        let own = &mut state.windows[k];
        let Some(mut window) = shop.assemble(&own.solved)? else { return Ok(None) };
        let all_rows = shop.spec.sampling == Sampling::Cubature;
        if !all_rows {
            window = shop.sample(window, &mut Rng::with_seed(row_seed))?;
        }
        if !own.search.finished {
            let chosen = match &shop.spec.plan {
                plan @ Plan::Adaptive { .. } => find_bad(shop, plan, &window, own)?.into_iter().collect(),
                plan => worst_of_pool(shop, plan, &window, own)?,
            };
            own.decide(chosen);
        }
        if own.search.finished {
            if all_rows {
                window = shop.sample(window, &mut Rng::with_seed(row_seed))?;
            }
            return Ok(Some(window));
        }
    }
}

/// Up to `count` points of the window's range, drawn by `draw`.
fn points(shop: &Shop<'_>, count: usize, draw: impl FnMut() -> [f64; 4]) -> Vec<Drawn> {
    admissible(&shop.spec.range, shop.spec.contact(), shop.reach, count, draw)
}

fn judge(judges: &mut Judges<'_>, drawn: &[Drawn], own: &WindowState) -> Result<Vec<f64>, TrainingError> {
    let points: Vec<OperatingPoint> = drawn.iter().map(|(_, point)| *point).collect();
    let mut errors = judges.judge(&points)?;
    for (error, point) in errors.iter_mut().zip(&points) {
        // A solution that is known already cannot be added again.
        if own.solved.iter().any(|s| s.point == *point) {
            *error = 0.0;
        }
    }
    Ok(errors)
}

/// The dissertation's search: goes on until a bad approximation is found, and returns the worst in its vicinity; or ends.
fn find_bad(
    shop: &Shop<'_>,
    plan: &Plan,
    window: &Window,
    own: &mut WindowState,
) -> Result<Option<OperatingPoint>, TrainingError> {
    let Plan::Adaptive { indicator, tolerances, successes, local_sigma, local_successes, vicinity, limit, .. } = plan
    else {
        return Ok(None);
    };
    let mut judges = Judges::new(*indicator, shop.spec, window, shop.observer);
    loop {
        let Some(&tolerance) = tolerances.get(own.search.rung).filter(|_| own.solved.len() < *limit) else {
            own.search.finished = true;
            return Ok(None);
        };
        let stage = format!("Search at tolerance {tolerance:e}, {} solutions", own.solved.len());
        shop.observer.progress(Progress { stage, done: own.search.successes, total: *successes });
        let mut rng = Rng::with_seed(own.search.random);
        let drawn = points(shop, BATCH, || match own.search.local {
            Some((centre, _)) => local_point(centre, *local_sigma, &mut rng),
            None => global_point(&mut rng),
        });
        let errors = judge(&mut judges, &drawn, own)?;
        let mut next = own.search.clone();
        next.judged += drawn.len();
        next.failed += errors.iter().filter(|e| e.is_infinite()).count();
        let bad = errors.iter().position(|e| *e > tolerance);
        if let Some(bad) = bad {
            let centre = drawn[bad].0;
            let mut around = vec![drawn[bad]];
            around.extend(points(shop, *vicinity, || local_point(centre, 0.5 * local_sigma, &mut rng)));
            let errors = judge(&mut judges, &around, own)?;
            next.judged += around.len() - 1;
            // The first of equals, so that failures do not wander.
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

/// One round of the greedy: the worst of a fresh pool that are not near each other.
fn worst_of_pool(
    shop: &Shop<'_>,
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
    shop.observer.progress(Progress { stage: format!("Worst of {pool}"), done: known, total: *limit });
    let mut rng = Rng::with_seed(own.search.random);
    let drawn = points(shop, *pool, || global_point(&mut rng));
    let errors = judge(&mut Judges::new(*indicator, shop.spec, window, shop.observer), &drawn, own)?;
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
        // One that is nearer to a point of this round than to any known solution may be good by then.
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
