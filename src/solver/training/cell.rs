//! Cells of (ln M, ln L) around the anchors of windows.

use super::spec::WindowSpec;
use crate::solver::physics::contact::Moes;
use crate::solver::reduced::{ReducedModel, from_anchor};
use std::sync::Arc;

/// The contacts around one of several anchors.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    anchors: Arc<[Moes]>,
    own: usize,
}

impl Cell {
    /// That of a window; none where windows have no anchors.
    pub fn of(anchors: impl IntoIterator<Item = Option<Moes>>, own: usize) -> Option<Self> {
        let anchors: Option<Arc<[Moes]>> = anchors.into_iter().collect();
        anchors.filter(|anchors| own < anchors.len()).map(|anchors| Self { anchors, own })
    }

    /// That of a window of a model.
    pub fn of_model(model: &ReducedModel, own: usize) -> Option<Self> {
        Self::of(model.windows.iter().map(|window| window.anchor), own)
    }

    /// Whether a contact is nearer to the own anchor than to the others, or farther by no more than so much.
    pub fn holds(&self, moes: Moes, beyond: f64) -> bool {
        let nearest = self.anchors.iter().map(|anchor| from_anchor(moes, *anchor)).fold(f64::INFINITY, f64::min);
        from_anchor(moes, self.anchors[self.own]) <= nearest + beyond
    }
}

/// M and L of a window's anchor.
pub(super) fn anchor(window: &WindowSpec) -> Option<Moes> {
    window.anchor.map(|(m, l)| Moes { m, l })
}
