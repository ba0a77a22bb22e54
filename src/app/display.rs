//! How the window shows things: kept with the session, not part of the document.

use super::answers::picture::Cuts;
use serde::{Deserialize, Serialize};

/// How things are shown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Display {
    /// Where a point contact is cut.
    pub cuts: Cuts,
    /// Theme wanted.
    pub theme: egui::ThemePreference,
    /// Size of everything.
    pub zoom: f32,
}

impl Display {
    /// Smallest and largest size of everything.
    pub const ZOOMS: (f32, f32) = (0.6, 3.0);
}

impl Default for Display {
    fn default() -> Self {
        Self { cuts: Cuts::default(), theme: egui::ThemePreference::System, zoom: 1.0 }
    }
}
