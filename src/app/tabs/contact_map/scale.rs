//! Colour bar of the map, with dimensionless values and units.

use super::images::{Images, table};
use super::map_view::{MapView, Shown};
use crate::app::answers::picture::Picture;
use crate::app::plot::color_bar::{self, STRIPS};
use crate::app::plot::raster;
use crate::app::units::{self, Scale, Scales};
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use egui::{Color32, Ui};

/// Draws the bar.
pub fn ui(ui: &mut Ui, images: &Images, picture: &Picture, view: &MapView, height: f32) {
    let system = units::system(ui.ctx());
    let scales = Scales::of(&picture.key.point, system);
    let rise = Scale::of(QuantityKind::TemperatureRise, system, 1.0);
    let (title, name, dimensional) = match view.shown {
        Shown::Pressure => ("{P}", "Pressure {P}", (scales.pressure, "Pressure {p}")),
        Shown::Asperities => ("{P_a}", "Asperity pressure {P_a}", (scales.pressure, "Asperity pressure {p_a}")),
        Shown::Temperature => ("K", "Rise at mid-film / K", (rise, "Rise at mid-film")),
        _ => ("{H}", "Film {H}", (scales.film, "Film {h}")),
    };
    let colors = colors(picture, view, images.range());
    color_bar::on_paper(ui, name, dimensional, (&colors, images.range()));
    color_bar::ui(ui, title, (&colors, images.range()), height, |value| si(picture, view, value, system));
}

/// Returns a value of the scale with its unit.
pub fn si(picture: &Picture, view: &MapView, value: f64, system: UnitSystem) -> String {
    let point = &picture.key.point;
    match view.shown {
        Shown::Pressure | Shown::Asperities => {
            color_bar::short(QuantityKind::Pressure, value * point.hertz().pressure_pa, system)
        }
        Shown::Temperature => color_bar::short(QuantityKind::TemperatureRise, value, system),
        _ => color_bar::short(QuantityKind::FilmThickness, value * point.film_scale_m(), system),
    }
}

/// Returns the colours of the bar from its lower to its upper end.
pub fn colors(picture: &Picture, view: &MapView, (low, high): (f64, f64)) -> Vec<Color32> {
    let place = |k: usize| (k as f64 + 0.5) / STRIPS as f64;
    if view.shown == Shown::Interferogram {
        let scale = picture.key.point.film_scale_m();
        let film = |k: usize| (low + (high - low) * place(k)) * scale;
        return (0..STRIPS).map(|k| raster::fringe(&view.rig, view.three_colors, film(k))).collect();
    }
    color_bar::strips(&table(view.shown))
}
