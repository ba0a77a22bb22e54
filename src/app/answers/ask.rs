//! Request for the picture: the contact, the grid and the truncation.

use crate::app::document::{Document, Key};
use crate::app::in_use::InUse;
use crate::app::model_source::Models;
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::reduced::ReducedOptions;
use serde::{Deserialize, Serialize};

/// Seconds without a change of the document after which a verification starts automatically.
pub const REST_S: f64 = 0.25;

/// Contact that the picture shall show, and the means to compute it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ask {
    /// Contact.
    pub key: Key,
    /// Grid of full solutions of a point contact. `None` for a line contact.
    pub plane: Option<PointGridSpec>,
    /// Truncation of the reduced model.
    pub options: ReducedOptions,
}

impl Ask {
    /// Returns the request of a document, given the loaded models.
    pub fn of(document: &Document, models: &Models) -> Self {
        let in_use = InUse::of(document, models);
        Self {
            key: document.key(),
            plane: document.chosen_plane(),
            options: in_use.map_or_else(ReducedOptions::default, |model| model.options_at(&document.point)),
        }
    }

    /// Returns true if the two requests are equal apart from the contact.
    pub fn has_means_of(&self, other: &Self) -> bool {
        Self { key: self.key, ..*other } == *self
    }
}

/// Returns the grid of pictures that are drawn while a slider moves: the quick grid, unless the chosen grid has no
/// more nodes.
pub fn quick(chosen: PointGridSpec) -> PointGridSpec {
    let nodes = |spec: PointGridSpec| spec.nodes().map_or(usize::MAX, |(nx, ny)| nx * ny * ny);
    if nodes(chosen) <= nodes(PointGridSpec::QUICK) { chosen } else { PointGridSpec::QUICK }
}
