//! Consistency check of a local model: it must reproduce its own snapshots.

use super::attempt::{Watch, attempt};
use super::operators_of;
use super::settings::ReducedOptions;
use crate::solver::full::Problem;
use crate::solver::parameters::Metric;
use crate::solver::reduced::kriging::Kriging;
use crate::solver::reduced::model::{ReducedModel, Snapshot};
use crate::solver::reduced::start::{self, Guess};
use std::cell::OnceCell;

/// Largest accepted relative deviation of the central film thickness H_c from a snapshot; for rough surfaces relative to
/// σ/2 if H_c is smaller. Consistent models deviate by less than 1 %; parts of different local models by far more.
const WITHIN: f64 = 0.1;

/// Number of snapshots that must be reproduced. A single one may lie where iterations do not converge.
const GIVEN: usize = 2;
/// Number of snapshots that are tried.
const TRIED: usize = 4;

impl ReducedModel {
    /// Solves the contacts of a local model's first and last snapshots, starting from the snapshots. Returns true as
    /// soon as two are reproduced. For a local model around an anchor only contacts of its own cell are tried; others
    /// may be far outside.
    pub fn reproduces_snapshots(&self, window: usize) -> bool {
        let Some(served) = self.windows.get(window) else { return false };
        let own = |snapshot: &&Snapshot| served.anchor.is_none() || self.window_for(&snapshot.point) == window;
        let snapshots: Vec<&Snapshot> = served.snapshots.iter().filter(own).collect();
        let options = ReducedOptions::default();
        let mut operators = operators_of(self, served, &options);
        // Kriging takes as long as everything else and is rarely needed.
        let kriging = OnceCell::new();
        let kriged = |problem: &Problem| {
            kriging
                .get_or_init(|| Kriging::of(served, Metric::of_starts(&self.domain.space)))
                .as_ref()?
                .start(served, &problem.point)
        };
        let from_both_ends = (0..snapshots.len()).map(|k| match k % 2 {
            0 => snapshots[k / 2],
            _ => snapshots[snapshots.len() - 1 - k / 2],
        });
        let given = from_both_ends.take(TRIED).filter(|snapshot| {
            let Ok(problem) = Problem::new(&snapshot.point, self.domain.lubricant) else { return false };
            let mut gives = |guess: Guess| {
                attempt(served, &mut operators, &problem, &guess, usize::MAX, &options, &mut Watch::of(&()))
                    .is_ok_and(|found| problem.film_difference(found.h_c, snapshot.h_c).abs() <= WITHIN)
            };
            gives(start::carried(served, snapshot, &problem.point))
                || served.anchor.is_some()
                    && kriged(&problem).is_some_and(|guess| {
                        self.shares_of_modes().0.iter().any(|share| gives(guess.with_modes(*share)))
                    })
        });
        let wanted = GIVEN.min(snapshots.len());
        given.take(wanted).count() == wanted
    }
}
