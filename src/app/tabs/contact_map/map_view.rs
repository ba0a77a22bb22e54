//! Settings of the map.

use crate::solver::full::heat::Temperatures;
use crate::solver::physics::optics::Interferometer;
use serde::{Deserialize, Serialize};

/// Displayed field of the map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Shown {
    /// Film thickness.
    #[default]
    Film,
    Pressure,
    /// Interference of light in the film.
    Interferogram,
    /// Temperature rise at mid-film, for a thermal contact.
    Temperature,
}

impl Shown {
    /// All fields in their order.
    pub const ALL: [Self; 4] = [Self::Film, Self::Pressure, Self::Interferogram, Self::Temperature];

    pub fn name(self) -> &'static str {
        match self {
            Self::Film => "Film map",
            Self::Pressure => "Pressure map",
            Self::Interferogram => "Interferogram",
            Self::Temperature => "Temperature map",
        }
    }

    /// Returns the tooltip.
    pub fn tip(self) -> &'static str {
        match self {
            Self::Film => "H over the plane, bright where the film is thin: the horseshoe with its side lobes",
            Self::Pressure => "P over the plane",
            Self::Interferogram => {
                "Image of an optical rig: a glass disc replaces one body, and light is reflected at both sides of the \
                 film"
            }
            Self::Temperature => "The temperature rise at mid-film over the plane",
        }
    }
}

/// Settings of the map. They are not part of the document.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct MapView {
    /// Displayed field.
    pub shown: Shown,
    /// True if contour lines are drawn over it.
    pub contours: bool,
    /// Optics of the interferogram.
    pub rig: Interferometer,
    /// True for three colours, false for one.
    pub three_colors: bool,
}

impl Default for MapView {
    fn default() -> Self {
        Self { shown: Shown::Film, contours: true, rig: Interferometer::default(), three_colors: true }
    }
}

/// Returns the temperature rises at mid-film \[K\] of all nodes.
pub fn mid_film_rises(heat: &Temperatures) -> Vec<f64> {
    heat.rises().map(|rises| rises.mid_film_k).collect()
}
