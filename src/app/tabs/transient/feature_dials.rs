//! Sliders of height, length and place of the first feature that passes the contact.

use super::features::NAME;
use crate::app::context::{Commands, Context};
use crate::app::controls::RangeSlider;
use crate::app::document::Edit;
use crate::app::document::features::{FeatureKind, place_of, sizes_of};
use crate::app::numbers;
use crate::app::theme::rich;
use crate::app::units;
use crate::scene::study::transient::SurfaceShape;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::QuantityKind;
use egui::Ui;

/// Range of the height in central film thicknesses of the formula, and of lengths in half-widths.
const HEIGHTS: (f64, f64) = (0.02, 2.0);
const LENGTHS: (f64, f64) = (0.05, 2.0);
/// Range of the place X at T = 0.
const PLACES: (f64, f64) = (-3.5, 1.0);
/// Width of a slider.
const WIDTH: f32 = 96.0;

/// Labels of height and length.
fn words(shape: &SurfaceShape) -> [&'static str; 2] {
    match shape {
        SurfaceShape::Dent { .. } => ["depth", "radius"],
        SurfaceShape::Wave { .. } => ["amplitude", "wavelength"],
        _ => ["height", "width"],
    }
}

/// Draws the sliders.
pub fn ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let before = context.document.transient_study();
    let mut study = before.clone();
    let Some(feature) = study.surfaces.first_mut() else { return };
    let point = &context.document.point;
    ui.strong(FeatureKind::of(&feature.shape).words().0);
    let [height_word, length_word] = words(&feature.shape);
    if let Some((height, length)) = sizes_of(&mut feature.shape) {
        sizes_ui(ui, point, (height_word, height), (length_word, length));
    }
    if let Some(at) = place_of(&mut feature.shape) {
        let tip = "Position X at T = 0 in units of a";
        ui.label("start").on_hover_text(tip);
        let slider = RangeSlider {
            name: "Feature start",
            range: PLACES.0..=PLACES.1,
            marked: None,
            home: -2.5,
            tooltip: tip,
            logarithmic: false,
        };
        if let Some(moved) = slider.show(ui, *at, WIDTH) {
            *at = numbers::rounded(moved.clamp(PLACES.0, PLACES.1), 3);
        }
        ui.label(rich(&format!("{{X}} = {}", numbers::digits(*at, 3)), 13.0, ui.visuals().weak_text_color()));
    }
    let ratio = feature.speed(point.sliding.slide_to_roll_ratio);
    let speed = numbers::shown(QuantityKind::Speed, ratio * point.speed_m_per_s, units::system(ui.ctx()));
    let text = format!("{} at {speed}", if feature.body == 1 { "body 1" } else { "body 2" });
    ui.weak(text).on_hover_text("The slide-to-roll ratio sets the speed of the body that carries the feature");
    if study != before {
        commands.edit(Edit::Transient(Box::new(study)), NAME);
    }
}

fn sizes_ui(
    ui: &mut Ui,
    point: &OperatingPoint,
    (height_word, height): (&str, &mut f64),
    (length_word, length): (&str, &mut f64),
) {
    let film = point.formula_film_m();
    let (quiet, system) = (ui.visuals().weak_text_color(), units::system(ui.ctx()));
    let mut slide = |name: &str, word: &str, tip: &str, (low, high): (f64, f64), value: f64| {
        ui.label(word).on_hover_text(tip);
        let home = (low * high).sqrt();
        let slider = RangeSlider { name, range: low..=high, marked: None, home, tooltip: tip, logarithmic: true };
        let moved = slider.show(ui, value, WIDTH).map(|moved| numbers::rounded(moved.clamp(low, high), 3));
        ui.label(rich(&numbers::length(moved.unwrap_or(value), system), 13.0, quiet));
        moved
    };
    let heights = (HEIGHTS.0 * film, HEIGHTS.1 * film);
    if let Some(moved) = slide("Feature height", height_word, "Height or depth of the feature", heights, height.abs()) {
        *height = moved.copysign(*height);
    }
    let a = point.hertz().half_width_m;
    let lengths = (LENGTHS.0 * a, LENGTHS.1 * a);
    if let Some(moved) =
        slide("Feature length", length_word, "Length of the feature along the contact", lengths, *length)
    {
        *length = moved;
    }
}
