//! Size, resolution, theme and units of figures.

use crate::app::units::Units;
use crate::scene::Page;
use crate::scene::drawing::DPI;
use serde::{Deserialize, Serialize};

/// Permitted sizes of a figure \[mm\].
pub const SIZES: (f64, f64) = (30.0, 500.0);

/// Settings of figures, stored with the session.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FigureSettings {
    /// Width \[mm\].
    pub width_mm: f64,
    /// Height \[mm\].
    pub height_mm: f64,
    /// Resolution of an image \[dpi\].
    pub dpi: f64,
    /// True for light text on a dark background.
    pub dark: bool,
    /// Units of its axes.
    pub units: Units,
}

impl FigureSettings {
    /// Returns true if sizes and resolution are within their ranges.
    pub fn is_sound(&self) -> bool {
        let within = |value: f64, (least, most): (f64, f64)| least <= value && value <= most;
        within(self.width_mm, SIZES) && within(self.height_mm, SIZES) && within(self.dpi, DPI)
    }
}

impl Default for FigureSettings {
    fn default() -> Self {
        let Page { width_mm, height_mm, dark, .. } = Page::default();
        Self { width_mm, height_mm, dpi: 300.0, dark, units: Units::default() }
    }
}
