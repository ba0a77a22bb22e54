//! What a path is asked for.

use std::sync::Arc;

/// What a path is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// Open a scene.
    Open,
    /// Save the scene.
    Save,
    /// Read inputs of a contact in time.
    Inputs,
    /// Write a reduced model.
    Model {
        /// The content of its file.
        bytes: Arc<Vec<u8>>,
    },
    /// Write a table.
    Csv {
        /// Its content.
        text: String,
    },
    /// Write a picture.
    Picture {
        /// The content of its file.
        bytes: Arc<[u8]>,
        /// How its name ends: `png` or `svg`.
        extension: &'static str,
    },
}

impl Purpose {
    /// Whether a file is read: then it must exist, and none is replaced.
    pub fn reads(&self) -> bool {
        matches!(self, Self::Open | Self::Inputs)
    }
}
