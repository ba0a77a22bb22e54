//! Colour bar of the map, with dimensionless and SI values.

use super::images::{Images, table};
use super::map_view::{MapView, Shown};
use crate::app::answers::picture::Picture;
use crate::app::plot::color_bar::{self, STRIPS, in_gigapascals, in_nanometres};
use crate::app::plot::raster;
use crate::app::units::Scales;
use egui::{Color32, Ui};

/// Draws the bar.
pub fn ui(ui: &mut Ui, images: &Images, picture: &Picture, view: &MapView, height: f32) {
    let scales = Scales::of(&picture.key.point);
    let (title, name, in_si) = match view.shown {
        Shown::Pressure => ("{P}", "Pressure {P}", (scales.pressure_gpa, "Pressure {p} / GPa")),
        Shown::Asperities => {
            ("{P_a}", "Asperity pressure {P_a}", (scales.pressure_gpa, "Asperity pressure {p_a} / GPa"))
        }
        Shown::Temperature => ("K", "Rise at mid-film / K", (1.0, "Rise at mid-film / K")),
        _ => ("{H}", "Film {H}", (scales.film_um, "Film {h} / µm")),
    };
    let colors = colors(picture, view, images.range());
    color_bar::on_paper(ui, name, in_si, (&colors, images.range()));
    color_bar::ui(ui, title, (&colors, images.range()), height, |value| si(picture, view, value));
}

/// Returns a value of the scale with its unit.
pub fn si(picture: &Picture, view: &MapView, value: f64) -> String {
    let point = &picture.key.point;
    match view.shown {
        Shown::Pressure | Shown::Asperities => in_gigapascals(value * point.hertz().pressure_pa),
        // The numbers of the scale are in kelvin already.
        Shown::Temperature => String::new(),
        _ => in_nanometres(value * point.film_scale_m()),
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
