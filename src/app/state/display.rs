//! How the window shows things: kept with the session, not part of the document.

use crate::app::picture::Cuts;
use crate::app::tabs::contact_map::MapView;
use crate::app::tabs::film_shear::FilmShear;
use crate::app::traction::Choices;
use serde::{Deserialize, Serialize};

/// How things are shown; not part of the document.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Display {
    /// Draw the full solution over the reduced one.
    pub overlay: bool,
    /// Draw the difference below.
    pub difference: bool,
    /// What is shown across the film.
    pub film_shear: FilmShear,
    /// How the Traction tab shows it.
    pub traction: Choices,
    /// Where a point contact is cut.
    pub cuts: Cuts,
    /// What the contact map shows.
    pub map: MapView,
    /// Theme wanted.
    pub theme: egui::ThemePreference,
    /// Size of everything.
    pub zoom: f32,
}

impl Default for Display {
    fn default() -> Self {
        Self {
            overlay: false,
            difference: false,
            film_shear: FilmShear::Off,
            traction: Choices::default(),
            cuts: Cuts::default(),
            map: MapView::default(),
            theme: egui::ThemePreference::System,
            zoom: 1.0,
        }
    }
}
