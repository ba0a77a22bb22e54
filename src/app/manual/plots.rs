//! Plots of the generated page of the manual.

use super::SPEED;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::theme::Palette;
use crate::engine::results::PAGE;
use crate::engine::{speed, validation};
use crate::scene::examples;
use egui::Ui;
use egui_plot::{HoverPosition, PlotPoints, Points, VLine};
use std::path::Path;
use std::sync::LazyLock;

/// First words of a reference to a plot.
pub(super) const FOLDER: &str = "plots/";
/// Height of a row, and of the horizontal axis \[points\]. Names of lower rows are faint or not drawn at all.
const ROW: f32 = 28.0;
const AXIS: f32 = 46.0;
/// Width of the names of the rows \[points\].
const NAMES: f32 = 220.0;

/// Rows of a plot: names, and values on a logarithmic axis.
struct Rows {
    title: &'static str,
    axis: &'static str,
    rows: Vec<(String, Vec<f64>)>,
    /// Vertical line.
    limit: Option<f64>,
}

static MARGINS: LazyLock<Rows> = LazyLock::new(|| {
    let results = examples::text_of(&Path::new(examples::ROOT).join(PAGE)).unwrap_or_default();
    let rows = validation::margins(results).into_iter().map(|(folder, shares)| (folder.to_owned(), shares));
    Rows {
        title: "Deviations over their limits",
        axis: "value or deviation over its limit",
        rows: rows.collect(),
        limit: Some(1.0),
    }
});

static TIMES: LazyLock<Rows> = LazyLock::new(|| {
    let rows = speed::medians(SPEED).into_iter().map(|(name, seconds)| (name.to_owned(), vec![seconds * 1e3]));
    Rows { title: "Median times", axis: "median time / ms", rows: rows.collect(), limit: None }
});

/// Draws the plot at a place of [`FOLDER`]. Draws nothing for other places.
pub(super) fn ui(ui: &mut Ui, place: &str) {
    match place {
        validation::MARGINS_PLOT => draw(ui, &MARGINS),
        validation::SPEED_PLOT => draw(ui, &TIMES),
        _ => {}
    }
}

fn draw(ui: &mut Ui, plotted: &'static Rows) {
    let Rows { title, axis, rows, limit } = plotted;
    let palette = Palette::of(ui);
    let height = ROW * (rows.len() as f32 + 1.0) + AXIS;
    let names = rows.iter().enumerate().map(|(k, (name, _))| (-(k as f64), name.clone())).collect();
    let plot = axes::plot(ui, title, height, axis, "")
        .allow_drag(false)
        .allow_zoom(false)
        .allow_boxed_zoom(false)
        .show_x(false)
        .show_y(false)
        .y_axis_min_width(NAMES)
        .include_y(0.6)
        .include_y(0.4 - rows.len() as f64)
        .decades_x(10.0)
        .names_y(names, true)
        .label_formatter(|hover| match hover {
            HoverPosition::NearDataPoint { plot_name, position, .. } => {
                Some(format!("{plot_name}: {}", numbers::significant(10f64.powf(position.x))))
            }
            HoverPosition::Elsewhere { .. } => None,
        });
    axes::show(plot, ui, title, |plot| {
        if let Some(limit) = limit {
            plot.vline(VLine::new("limit", limit.log10()).color(palette.quiet));
        }
        for (k, (name, values)) in rows.iter().enumerate() {
            let place = |value: &f64| [value.log10(), -(k as f64)];
            let (within, beyond): (Vec<f64>, Vec<f64>) =
                values.iter().partition(|value| limit.is_none_or(|limit| **value <= limit));
            for (values, color) in [(within, palette.film), (beyond, palette.wrong)] {
                let points: PlotPoints<'_> = values.iter().map(place).collect();
                plot.points(Points::new(name.as_str(), points).color(color).radius(3.0));
            }
        }
    });
}
