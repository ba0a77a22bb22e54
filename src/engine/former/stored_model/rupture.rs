//! How the films of a model rupture, on its way to or from a file.

use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{ReducedModel, Snapshot};
use serde::{Deserialize, Serialize};

/// How films rupture that no penalty holds.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredRupture {
    pub cavitation: Cavitation,
    /// Of older files of every window and each of its snapshots the first ruptured column of each line along X; empty under a
    /// penalty, and where snapshots keep them.
    pub fronts: Vec<Vec<Vec<usize>>>,
}

/// Gives the windows of a model their law of rupture; `None` where it does not fit them.
pub(super) fn rupture(model: &mut ReducedModel, StoredRupture { cavitation, fronts }: StoredRupture) -> Option<()> {
    if cavitation == Cavitation::Penalty {
        return fronts.is_empty().then_some(());
    }
    let ruptures = cavitation == Cavitation::Complementarity && !model.domain.heats();
    if !(ruptures && (fronts.is_empty() || fronts.len() == model.windows.len())) {
        return None;
    }
    for (window, fronts) in model.windows.iter_mut().zip(fronts) {
        if fronts.len() != window.snapshots.len() {
            return None;
        }
        window.snapshots.iter_mut().zip(fronts).for_each(|(snapshot, fronts)| snapshot.fronts = fronts);
    }
    model.domain.lubricant.cavitation = cavitation;
    for window in &mut model.windows {
        window.cavitation = cavitation;
        let (lines, columns) = (window.grid.lines(), window.grid.nodes().0);
        let sound = |s: &Snapshot| s.fronts.len() == lines && s.fronts.iter().all(|front| *front <= columns);
        if !window.snapshots.iter().all(sound) {
            return None;
        }
    }
    Some(())
}
