//! Common style of all plots: size of titles, spacing, grid marks and axis labels. On a logarithmic axis the plotted
//! data are decimal logarithms, and marks and labels are computed from them.

use crate::app::figure::Canvas;
use crate::app::numbers;
use crate::app::plot::frame::PlotFrame;
use crate::app::theme::Palette;
use egui::{Rangef, Ui, Vec2, Vec2b, vec2};
use egui_plot::{AxisHints, GridInput, GridMark, Plot, PlotPoint, PlotResponse};

/// Font size of axis titles, in screen points.
pub const TITLE_SIZE: f32 = 12.5;

/// Width of the plot per mark of the horizontal axis, in screen points.
const WIDTH_PER_MARK: f32 = 80.0;

/// Minimum distance between labelled marks of the horizontal and of the vertical axis, in screen points. Marks that are
/// closer together have no labels.
const LABEL_SPACING: Vec2 = vec2(60.0, 20.0);

/// Number of points of a curve above which [`thinned`] reduces it.
const MOST_POINTS: usize = 3000;

/// Creates a plot in the style of the explorer. `id` must be unique in the window, `height` is in screen points. Axis
/// titles may contain symbols (see `rich`); an empty title is omitted.
pub fn plot<'a>(ui: &Ui, id: &str, height: f32, x_title: &str, y_title: &str) -> PlotFrame<'a> {
    let columns = f64::from(ui.available_width() / WIDTH_PER_MARK).clamp(2.0, 9.0);
    // With a range of this small width, the toolkit draws a label opaque or not at all, never faint.
    let spaced = |axis: AxisHints<'a>, room: f32| vec![axis.label_spacing(Rangef::new(room, room + 0.1))];
    let plot = Plot::new(id)
        .custom_x_axes(spaced(AxisHints::new_x(), LABEL_SPACING.x))
        .custom_y_axes(spaced(AxisHints::new_y(), LABEL_SPACING.y))
        .height(height)
        .grid_color(Palette::of(ui).grid)
        .allow_scroll(false)
        .y_axis_min_width(62.0);
    PlotFrame::new(ui, plot, [x_title, y_title], [columns, 6.0])
}

/// Draws a plot. `name` is its accessible name and its name in the export.
pub fn show<'a, R>(
    plot: PlotFrame<'a>,
    ui: &mut Ui,
    name: &str,
    content: impl FnOnce(&mut Canvas<'_, 'a>) -> R + 'a,
) -> PlotResponse<R> {
    plot.show(ui, name, content)
}

/// Fits the axes of a plot to its data if `wanted` is true, and when the plot is visible for the first time. Locked
/// axes are fitted only if `wanted` is true. Zooming and panning end the fit, and a double click restores it.
pub fn fit(plot: &mut Canvas<'_, '_>, wanted: bool) {
    let id = plot.response().id.with("seen");
    let seen = plot.ctx().data_mut(|d| std::mem::replace(d.get_temp_mut_or_default::<bool>(id), true));
    if wanted || !(seen || plot.locked) {
        plot.set_auto_bounds(Vec2b::TRUE);
    }
}

/// Returns the label of a number on a linear axis, with at most nine decimals, or in the form 2e9 if it is very large
/// or small.
pub fn tick(value: f64) -> String {
    let rounded = (value * 1e12).round() / 1e12;
    let text = match rounded.abs() {
        0.0 => return "0".to_owned(),
        size if !(1e-3..1e6).contains(&size) => format!("{:e}", format!("{rounded:.3e}").parse().unwrap_or(rounded)),
        _ => format!("{}", (rounded * 1e9).round() / 1e9),
    };
    text.replace('-', "−")
}

/// Returns marks of a linear axis at multiples of 1, 2 or 5 times a power of ten, at most about `target` of them.
pub fn round_marks(input: GridInput, target: f64) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let wanted = (high - low) / target;
    if !(wanted.is_finite() && wanted > 0.0) {
        return Vec::new();
    }
    let decade = 10f64.powf(wanted.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().find(|s| s * decade >= wanted).unwrap_or(10.0) * decade;
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last).map(|k| GridMark { value: k as f64 * step, step_size: step }).collect()
}

/// Returns marks of a logarithmic axis over many decades: one for each n-th decade, at most about `most` of them.
pub fn few_decade_marks(input: GridInput, most: f64) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    if !(low.is_finite() && high.is_finite() && high > low && high - low < 400.0) {
        return Vec::new();
    }
    let stride = ((high - low) / most).ceil().max(1.0);
    let (first, last) = ((low / stride).ceil() as i64, (high / stride).floor() as i64);
    (first..=last).map(|k| GridMark { value: k as f64 * stride, step_size: stride }).collect()
}

/// Returns the label of a mark at a whole decade.
pub fn decade_label(mark: GridMark) -> String {
    match mark.value.round() as i32 {
        e @ -3..=4 => tick(10f64.powi(e)),
        e => format!("1e{e}").replace('-', "−"),
    }
}

/// Returns marks of a logarithmic axis over few decades: strong ones at the decades, faint ones at 2…9 times a decade.
/// Empty above twelve decades.
pub fn log_marks(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    if !(low.is_finite() && high.is_finite()) || high - low > 12.0 {
        return Vec::new();
    }
    let decades = (low.floor() as i32)..=(high.ceil() as i32);
    decades
        .flat_map(|e| (1..10).map(move |digit| (e, digit)))
        .map(|(e, digit)| GridMark {
            value: f64::from(e) + f64::from(digit).log10(),
            step_size: if digit == 1 { 1.0 } else { 0.12 },
        })
        .filter(|mark| (low..=high).contains(&mark.value))
        .collect()
}

/// Returns the label of a mark of [`log_marks`]. It is empty except at 1, 2 and 5 times a decade.
pub fn log_label(mark: GridMark) -> String {
    let value = 10f64.powf(mark.value);
    let leading = value / 10f64.powf((mark.value + 1e-9).floor());
    let near = |d: f64| (leading / d - 1.0).abs() < 1e-6;
    if near(1.0) || near(2.0) || near(5.0) { numbers::digits(value, 1) } else { String::new() }
}

/// Reduces a long curve to about 3000 points. Of each group of neighbouring points only the lowest and the highest
/// remain, so that no extreme is lost.
pub fn thinned(points: Vec<PlotPoint>) -> Vec<PlotPoint> {
    if points.len() <= MOST_POINTS {
        return points;
    }
    let group = points.len().div_ceil(MOST_POINTS / 2);
    points
        .chunks(group)
        .flat_map(|chunk| {
            let least = chunk.iter().copied().min_by(|a, b| a.y.total_cmp(&b.y));
            let greatest = chunk.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y));
            let mut pair: Vec<PlotPoint> = least.into_iter().chain(greatest).collect();
            pair.sort_by(|a, b| a.x.total_cmp(&b.x));
            pair
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_short_in_every_system_of_units() {
        let texts = [2_000_000_000.000_000_2, -5e-7, 0.25, 12_345.0, 0.0].map(tick);
        assert_eq!(texts, ["2e9", "−5e−7", "0.25", "12345", "0"]);
    }

    #[test]
    fn long_series_keep_their_extremes_and_their_order() {
        let wave = |k: usize| PlotPoint::new(k as f64, (k as f64 / 900.0).sin() + if k == 7777 { 5.0 } else { 0.0 });
        let points = thinned((0..20_000).map(wave).collect());
        assert!(points.len() <= MOST_POINTS + 2);
        assert!(points.iter().any(|p| p.x == 7777.0));
        assert!(points.windows(2).all(|pair| pair[0].x <= pair[1].x));
        assert_eq!(thinned((0..10).map(wave).collect()).len(), 10);
    }
}
