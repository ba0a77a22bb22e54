//! Colour bar of a map, with dimensionless values and units.

use crate::app::theme::{Palette, rich};
use crate::app::units::{Scale, Units};
use crate::app::{figure, numbers};
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use egui::{Align2, Color32, FontId, Rect, Sense, Stroke, Ui, pos2, vec2};

/// Width of the bar with its numbers.
pub const WIDTH: f32 = 118.0;
/// Width of the bar.
const BAR: f32 = 16.0;
/// Number of strips of the bar.
pub const STRIPS: usize = 128;
/// Number of parts of a film thickness scale. Parts below the minimum film thickness are omitted.
pub const UNITS: f64 = 8.0;
/// Height of a number.
const ROW: f32 = 15.0;

/// Returns round values of the scale from its lower to its upper end.
pub fn ticks((low, high): (f64, f64)) -> Vec<f64> {
    let unit = if low > 0.0 { high / UNITS } else { high / 4.0 };
    let count = ((high - low) / unit).round() as usize;
    (0..=count).map(|k| low + unit * k as f64).collect()
}

/// Draws the bar: colours from the lower to the upper end, their values, and the values with units.
pub fn ui(
    ui: &mut Ui,
    title: &str,
    (colors, (low, high)): (&[Color32], (f64, f64)),
    height: f32,
    si: impl Fn(f64) -> String,
) {
    let palette = Palette::of(ui);
    let (area, _) = ui.allocate_exact_size(vec2(WIDTH, height), Sense::hover());
    let painter = ui.painter();
    let text = ui.visuals().text_color();
    let galley = painter.layout_job(rich(title, 13.5, text));
    painter.galley(pos2(area.left() + 2.0, area.top()), galley, text);
    let bar = Rect::from_min_max(area.min + vec2(0.0, 24.0), pos2(area.left() + BAR, area.bottom() - 38.0));
    let at = |t: f32| bar.bottom() - t * bar.height();
    let strip = bar.height() / colors.len().max(1) as f32;
    for (k, color) in colors.iter().enumerate() {
        let top = bar.bottom() - (k + 1) as f32 * strip;
        painter.rect_filled(Rect::from_min_size(pos2(bar.left(), top), vec2(BAR, strip + 0.6)), 0.0, *color);
    }
    painter.rect_stroke(bar, 0.0, Stroke::new(1.0, palette.quiet), egui::StrokeKind::Outside);
    let small = FontId::proportional(11.5);
    let ticks = ticks((low, high));
    let every = (ROW * ticks.len() as f32 / bar.height().max(1.0)).ceil().max(1.0) as usize;
    for value in ticks.into_iter().step_by(every) {
        let y = at(((value - low) / (high - low)) as f32);
        painter.line_segment([pos2(bar.right(), y), pos2(bar.right() + 4.0, y)], Stroke::new(1.0, palette.quiet));
        let label = numbers::digits(value, 2);
        painter.text(pos2(bar.right() + 7.0, y), Align2::LEFT_CENTER, label, small.clone(), text);
        let twin = pos2(bar.right() + 42.0, y);
        painter.text(twin, Align2::LEFT_CENTER, si(value), small.clone(), palette.quiet);
    }
}

/// Sets the colour scale for the figure of the map that was drawn last. With units it has another title and a scale.
pub fn on_paper(
    ui: &Ui,
    title: &str,
    (scale, dimensional): (Scale, &str),
    (colors, (low, high)): (&[Color32], (f64, f64)),
) {
    let (title, factor) = match Units::of(ui.ctx()) {
        Units::Dimensional => (format!("{dimensional} / {}", scale.unit), scale.factor),
        Units::Dimensionless => (title.to_owned(), 1.0),
    };
    figure::scale(ui.ctx(), &title, (factor * low, factor * high), colors);
}

/// Returns the colours of a table for the strips of the bar.
pub fn strips(table: &[Color32]) -> Vec<Color32> {
    let last = table.len().saturating_sub(1) as f64;
    let place = |k: usize| ((k as f64 + 0.5) / STRIPS as f64 * last).round() as usize;
    (0..STRIPS).filter_map(|k| table.get(place(k)).copied()).collect()
}

/// Returns a value in SI units as a short text.
pub fn short(kind: QuantityKind, si: f64, system: UnitSystem) -> String {
    let unit = kind.unit_of(system, si);
    if si == 0.0 {
        "0".to_owned()
    } else {
        format!("{}{}{}", numbers::digits(unit.number(si), 3), numbers::THIN, unit.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_names_its_ends_and_round_values_between() {
        assert_eq!(ticks((0.0, 1.2)).len(), 5);
        let film = ticks((0.15, 0.4));
        assert_eq!(film.len(), 6);
        assert!((film[0] - 0.15).abs() < 1e-12 && (film[5] - 0.4).abs() < 1e-12 && (film[1] - 0.2).abs() < 1e-12);
    }
}
