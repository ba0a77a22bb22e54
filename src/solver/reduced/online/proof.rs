//! Whether the parts of a window belong together: at its own snapshots it must give what they hold.

use super::attempt::{Watch, attempt};
use super::operators_of;
use super::settings::ReducedOptions;
use crate::solver::full::Problem;
use crate::solver::parameters::Metric;
use crate::solver::reduced::kriging::Kriging;
use crate::solver::reduced::model::{ReducedModel, Snapshot};
use crate::solver::reduced::start::{self, Guess};
use std::cell::OnceCell;

/// How far H_c of a snapshot may lie from the one it was trained from, relative to it. Models differ there by less than
/// one in a hundred; a window with parts of another one does not come near.
const WITHIN: f64 = 0.1;

/// So many snapshots have to be given; a single one may lie where iterations from afar end nowhere.
const GIVEN: usize = 2;
/// So many are tried.
const TRIED: usize = 4;

impl ReducedModel {
    /// Solves the contacts of a window's first and last snapshots from these, until two are given; of a window around an
    /// anchor those that it serves: others may lie far outside.
    pub fn reproduces_snapshots(&self, window: usize) -> bool {
        let Some(served) = self.windows.get(window) else { return false };
        let own = |snapshot: &&Snapshot| served.anchor.is_none() || self.window_for(&snapshot.point) == window;
        let snapshots: Vec<&Snapshot> = served.snapshots.iter().filter(own).collect();
        let options = ReducedOptions::default();
        let mut operators = operators_of(self, served, &options);
        // Kriging takes as long as all the rest, and hardly any window needs it.
        let kriging = OnceCell::new();
        let kriged = |problem: &Problem| {
            kriging
                .get_or_init(|| Kriging::of(served, Metric::of_starts(&self.domain.space)))
                .as_ref()?
                .start(&problem.point)
        };
        let from_both_ends = (0..snapshots.len()).map(|k| match k % 2 {
            0 => snapshots[k / 2],
            _ => snapshots[snapshots.len() - 1 - k / 2],
        });
        let given = from_both_ends.take(TRIED).filter(|snapshot| {
            let Ok(problem) = Problem::new(&snapshot.point, self.domain.lubricant) else { return false };
            let mut gives = |guess: Guess| {
                attempt(served, &mut operators, &problem, &guess, usize::MAX, &options, &mut Watch::of(&()))
                    .is_ok_and(|found| (found.h_c - snapshot.h_c).abs() <= WITHIN * snapshot.h_c.abs())
            };
            gives(start::carried(snapshot, &problem.point))
                || served.anchor.is_some()
                    && kriged(&problem).is_some_and(|guess| {
                        self.shares_of_modes().0.iter().any(|share| gives(guess.with_modes(*share)))
                    })
        });
        let wanted = GIVEN.min(snapshots.len());
        given.take(wanted).count() == wanted
    }
}
