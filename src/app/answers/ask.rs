//! What the picture is to show.

use crate::app::document::{Document, Key};
use crate::app::in_use::InUse;
use crate::app::model_source::Models;
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::reduced::ReducedOptions;

/// Seconds of rest after which a verification starts by itself.
pub const REST_S: f64 = 0.25;

/// What the picture is to show, and by what means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ask {
    /// The contact.
    pub key: Key,
    /// The grid of full solutions of a point contact.
    pub plane: Option<PointGridSpec>,
    /// The truncation of the reduced model.
    pub options: ReducedOptions,
}

impl Ask {
    /// Returns what a document asks for, of the models there are.
    pub fn of(document: &Document, models: &Models) -> Self {
        let in_use = InUse::of(document, models);
        Self {
            key: document.key(),
            plane: document.chosen_plane(),
            options: in_use.map_or_else(ReducedOptions::default, |model| model.options_at(&document.point)),
        }
    }

    /// Returns true if it differs from another ask in the contact at most.
    pub fn has_means_of(&self, other: &Self) -> bool {
        Self { key: self.key, ..*other } == *self
    }
}

/// Returns the grid of pictures that follow the hand: the quick one, unless the chosen one has as few nodes.
pub fn quick(chosen: PointGridSpec) -> PointGridSpec {
    let nodes = |spec: PointGridSpec| spec.nodes().map_or(usize::MAX, |(nx, ny)| nx * ny * ny);
    if nodes(chosen) <= nodes(PointGridSpec::QUICK) { chosen } else { PointGridSpec::QUICK }
}
