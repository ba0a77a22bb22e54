//! Whether the parts of a window belong together: at its own snapshots it must give what they hold.

use super::attempt::attempt;
use super::operators_of;
use super::settings::ReducedOptions;
use crate::solver::full::Problem;
use crate::solver::reduced::kriging::Kriging;
use crate::solver::reduced::model::{ReducedModel, Snapshot};
use crate::solver::reduced::start::{self, Guess};
use std::cell::OnceCell;

/// How far H_c of a snapshot may lie from the one it was trained from, relative to it. Models differ there by less than
/// one in a hundred; a window with parts of another one does not come near.
const WITHIN: f64 = 0.1;

/// So many snapshots have to be given; single ones may lie where iterations from afar end nowhere.
const GIVEN: usize = 2;
/// So many are tried: at the ends of a window that serves a wide range the first ones may all lie there.
const TRIED: usize = 16;

impl ReducedModel {
    /// Solves the contacts of a window's snapshots from these, from both ends, until two are given; of a window around an
    /// anchor those that it serves: others may lie far outside.
    pub fn reproduces_snapshots(&self, window: usize) -> bool {
        let Some(served) = self.windows.get(window) else { return false };
        let own = |snapshot: &&Snapshot| served.anchor.is_none() || self.window_for(&snapshot.point) == window;
        let snapshots: Vec<&Snapshot> = served.snapshots.iter().filter(own).collect();
        let options = ReducedOptions::default();
        let mut operators = operators_of(self, served, &options);
        // Kriging takes as long as all the rest, and hardly any window needs it.
        let (kriging, heat) = (OnceCell::new(), self.domain.heat.is_some());
        let kriged =
            |problem: &Problem| kriging.get_or_init(|| Kriging::of(served, heat)).as_ref()?.start(&problem.point);
        let from_both_ends = (0..snapshots.len()).map(|k| match k % 2 {
            0 => snapshots[k / 2],
            _ => snapshots[snapshots.len() - 1 - k / 2],
        });
        let given = from_both_ends.take(TRIED).filter(|snapshot| {
            let Ok(problem) = Problem::new(&snapshot.point, self.domain.lubricant) else { return false };
            let mut gives = |guess: Guess| {
                attempt(served, &mut operators, &problem, &guess, usize::MAX, &options, &mut None)
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

#[cfg(test)]
mod tests {
    use crate::solver::reduced::Sampling;
    use crate::solver::training::small::oils;
    use crate::solver::training::train;

    #[test]
    fn a_window_is_proved_by_any_two_of_its_snapshots_but_not_by_those_of_another_film() {
        let mut model = train(&oils(Sampling::QDeim, 60), &()).unwrap();
        for window in 0..model.windows.len() {
            assert!(model.reproduces_snapshots(window));
            let snapshots = &model.windows[window].snapshots;
            let served: Vec<usize> =
                (0..snapshots.len()).filter(|k| model.window_for(&snapshots[*k].point) == window).collect();
            let mut spoil = |served: &[usize]| {
                for k in served {
                    model.windows[window].snapshots[*k].h_c *= 2.0;
                }
                model.reproduces_snapshots(window)
            };
            let count = served.len();
            assert!(count > 7);
            // The first and the last three are not given now; then none is.
            assert!(spoil(&[&served[..3], &served[count - 3..]].concat()), "window {window}");
            assert!(!spoil(&served[3..count - 3]), "window {window}");
        }
    }
}
