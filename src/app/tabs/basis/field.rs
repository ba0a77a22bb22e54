//! Field of a basis: pressure or deformation.

use crate::app::theme::Palette;
use crate::solver::reduced::{PodBasis, Window};
use egui::Color32;

/// Name under which the refusal of a truncation is stored.
pub const TRUNCATION: &str = "truncation";

/// Field of a basis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Field {
    #[default]
    Pressure,
    Deformation,
}

impl Field {
    pub fn name(self) -> &'static str {
        match self {
            Self::Pressure => "Pressure",
            Self::Deformation => "Deformation",
        }
    }

    /// Returns its basis.
    pub fn of(self, window: &Window) -> &PodBasis {
        match self {
            Self::Pressure => window.pressure.basis(),
            Self::Deformation => &window.deformation,
        }
    }

    /// Returns its colour.
    pub fn color(self, palette: &Palette) -> Color32 {
        match self {
            Self::Pressure => palette.pressure,
            Self::Deformation => palette.deformation,
        }
    }
}
