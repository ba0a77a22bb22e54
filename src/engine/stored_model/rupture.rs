//! How the films of a model rupture, on its way to or from a file.

use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{ReducedModel, Window};
use serde::{Deserialize, Serialize};

/// How films rupture that no penalty holds.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredRupture {
    pub cavitation: Cavitation,
    /// Of every window and each of its snapshots the first ruptured column of each line along X; empty under a penalty.
    pub fronts: Vec<Vec<Vec<usize>>>,
}

impl StoredRupture {
    /// What only a model has whose films do not rupture by the penalty.
    pub fn of(model: &ReducedModel) -> Option<Self> {
        let cavitation = model.domain.lubricant.cavitation;
        let of_window = |window: &Window| window.snapshots.iter().map(|snapshot| snapshot.fronts.clone()).collect();
        let fronts = || model.windows.iter().map(of_window).collect();
        (cavitation != Cavitation::Penalty).then(|| Self { cavitation, fronts: fronts() })
    }
}

/// Gives the windows of a model their law of rupture; `None` where it does not fit them.
pub(super) fn rupture(model: &mut ReducedModel, StoredRupture { cavitation, fronts }: StoredRupture) -> Option<()> {
    if cavitation == Cavitation::Penalty {
        return fronts.is_empty().then_some(());
    }
    let ruptures = cavitation == Cavitation::Complementarity && !model.slides();
    if !(ruptures && fronts.len() == model.windows.len()) {
        return None;
    }
    model.domain.lubricant.cavitation = cavitation;
    for (window, fronts) in model.windows.iter_mut().zip(fronts) {
        if fronts.len() != window.snapshots.len() {
            return None;
        }
        window.cavitation = cavitation;
        let (lines, columns) = (window.grid.lines(), window.grid.nodes().0);
        for (snapshot, fronts) in window.snapshots.iter_mut().zip(fronts) {
            if fronts.len() != lines || fronts.iter().any(|front| *front > columns) {
                return None;
            }
            snapshot.fronts = fronts;
        }
    }
    Some(())
}
