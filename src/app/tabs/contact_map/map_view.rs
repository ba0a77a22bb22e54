//! Settings of the map.

use crate::solver::full::heat::Temperatures;
use crate::solver::physics::lubricant::Lubricant;
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
    /// Asperity pressure, for rough surfaces.
    Asperities,
    /// Temperature rise at mid-film, for a thermal contact.
    Temperature,
}

impl Shown {
    /// All fields in their order.
    pub const ALL: [Self; 5] = [Self::Film, Self::Pressure, Self::Interferogram, Self::Asperities, Self::Temperature];

    /// Returns true if contacts with these laws have the field.
    pub fn is_of(self, laws: &Lubricant) -> bool {
        match self {
            Self::Film | Self::Pressure | Self::Interferogram => true,
            Self::Asperities => laws.is_rough(),
            Self::Temperature => laws.heat.is_some(),
        }
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Film => "Film map",
            Self::Pressure => "Pressure map",
            Self::Interferogram => "Interferogram",
            Self::Asperities => "Asperity pressure",
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
            Self::Asperities => "P_a over the plane, the part of the pressure that asperities carry",
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
