//! Cells of (ln M, ln L), with the Moes parameters M and L, around the anchors of local models.

use super::spec::WindowSpec;
use crate::solver::physics::contact::Moes;
use crate::solver::reduced::{ReducedModel, from_anchor};
use std::sync::Arc;

/// Contacts nearest to one of several anchors.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    anchors: Arc<[Moes]>,
    own: usize,
}

impl Cell {
    /// Returns the cell of anchor `own`; `None` if one of the anchors is missing.
    pub fn of(anchors: impl IntoIterator<Item = Option<Moes>>, own: usize) -> Option<Self> {
        let anchors: Option<Arc<[Moes]>> = anchors.into_iter().collect();
        anchors.filter(|anchors| own < anchors.len()).map(|anchors| Self { anchors, own })
    }

    /// Returns the cell of a local model.
    pub fn of_model(model: &ReducedModel, own: usize) -> Option<Self> {
        Self::of(model.windows.iter().map(|window| window.anchor), own)
    }

    /// Returns true if a contact is nearest to the own anchor, or at most `beyond` farther than the nearest one.
    pub fn holds(&self, moes: Moes, beyond: f64) -> bool {
        let nearest = self.anchors.iter().map(|anchor| from_anchor(moes, *anchor)).fold(f64::INFINITY, f64::min);
        from_anchor(moes, self.anchors[self.own]) <= nearest + beyond
    }
}

/// Returns M and L of a specification's anchor.
pub(super) fn anchor(window: &WindowSpec) -> Option<Moes> {
    window.anchor.map(|(m, l)| Moes { m, l })
}
