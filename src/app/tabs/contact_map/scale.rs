//! The colour bar beside the map, with its values and their SI twins.

use super::images::{Images, table, ticks};
use super::{MapView, Shown};
use crate::app::answers::picture::Picture;
use crate::app::numbers;
use crate::app::tabs::raster;
use crate::app::theme::{Palette, rich};
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, Ui, pos2, vec2};

/// Width of the bar itself.
const BAR: f32 = 16.0;
/// Strips that it is painted with.
const STRIPS: usize = 128;

/// The bar.
pub fn ui(ui: &mut Ui, images: &Images, picture: &Picture, view: &MapView, height: f32) {
    let palette = Palette::of(ui);
    let (low, high) = images.range();
    let (area, _) = ui.allocate_exact_size(vec2(super::SCALE_WIDTH, height), Sense::hover());
    let painter = ui.painter();
    let title = match view.shown {
        Shown::Pressure => "{P}",
        _ => "{H}",
    };
    let text = ui.visuals().text_color();
    let galley = painter.layout_job(rich(title, 13.5, text));
    painter.galley(pos2(area.left() + 2.0, area.top()), galley, text);
    let bar = Rect::from_min_max(area.min + vec2(0.0, 24.0), pos2(area.left() + BAR, area.bottom() - 38.0));
    let at = |t: f32| bar.bottom() - t * bar.height();
    let strip = bar.height() / STRIPS as f32;
    for (k, color) in colors(picture, view, (low, high)).into_iter().enumerate() {
        let top = bar.bottom() - (k + 1) as f32 * strip;
        painter.rect_filled(Rect::from_min_size(pos2(bar.left(), top), vec2(BAR, strip + 0.6)), 0.0, color);
    }
    painter.rect_stroke(bar, 0.0, Stroke::new(1.0, palette.quiet), egui::StrokeKind::Outside);
    let small = FontId::proportional(11.5);
    for value in ticks((low, high)) {
        let y = at(((value - low) / (high - low)) as f32);
        painter.line_segment([pos2(bar.right(), y), pos2(bar.right() + 4.0, y)], Stroke::new(1.0, palette.quiet));
        let label = numbers::digits(value, 2);
        painter.text(pos2(bar.right() + 7.0, y), Align2::LEFT_CENTER, label, small.clone(), text);
        painter.text(
            pos2(bar.right() + 42.0, y),
            Align2::LEFT_CENTER,
            si(picture, view, value),
            small.clone(),
            palette.quiet,
        );
    }
}

/// A value of the scale with its unit.
pub fn si(picture: &Picture, view: &MapView, value: f64) -> String {
    let point = &picture.key.point;
    match view.shown {
        Shown::Pressure => {
            let pressure = value * point.hertz().pressure_pa;
            if pressure == 0.0 { "0".to_owned() } else { short(pressure * 1e-9, "GPa") }
        }
        _ => {
            let nanometres = value * point.film_scale_m() * 1e9;
            if nanometres >= 1000.0 { short(nanometres * 1e-3, "µm") } else { short(nanometres, "nm") }
        }
    }
}

fn short(value: f64, unit: &str) -> String {
    format!("{}{}{unit}", numbers::digits(value, 3), numbers::THIN)
}

/// The colours of the bar from its lower end to its upper one.
pub fn colors(picture: &Picture, view: &MapView, (low, high): (f64, f64)) -> Vec<Color32> {
    let place = |k: usize| (k as f64 + 0.5) / STRIPS as f64;
    if view.shown == Shown::Interferogram {
        let scale = picture.key.point.film_scale_m();
        let film = |k: usize| (low + (high - low) * place(k)) * scale;
        return (0..STRIPS).map(|k| raster::fringe(&view.rig, view.three_colors, film(k))).collect();
    }
    let table = table(view.shown);
    let last = table.len().saturating_sub(1);
    (0..STRIPS).filter_map(|k| table.get((place(k) * last as f64).round() as usize).copied()).collect()
}
