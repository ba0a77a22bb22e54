//! Draws a chart of a study: its series as lines, dots, rings or crosses, and measured points as diamonds.

use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::theme::Palette;
use crate::scene::{Chart, Marks};
use egui::{Color32, Ui, Vec2b};
use egui_plot::{Line, MarkerShape, PlotPoints, Points};

/// Maximum number of series in the key (legend) above a chart. Further series are named on hover.
const NAMED: usize = 24;
/// Name of measured points in the key.
const MEASURED: &str = "measured";
/// Radius of the diamond of a measured point, in points of the screen.
const DIAMOND: f32 = 4.0;

/// Draws a chart, its key and measured points in the units of its axes. `height` is the height of chart and key. If
/// `fresh`, the view is reset to fit the data.
pub fn ui(ui: &mut Ui, id: &str, (chart, measured): (&Chart, &[[f64; 2]]), height: f32, fresh: bool) {
    let palette = Palette::of(ui);
    let entries = chart.series.iter().enumerate().take(NAMED).map(|(k, series)| {
        let sample = match series.marks {
            Marks::Line => Sample::Line(2.0),
            Marks::Dots | Marks::Rings => Sample::Dot(2.8),
            Marks::Crosses => Sample::Cross(4.0),
        };
        Entry::new(plain(&series.name), color(&palette, series.marks, k), sample)
    });
    let diamonds = (!measured.is_empty()).then(|| Entry::new(MEASURED, palette.text, Sample::Diamond(DIAMOND)));
    let entries: Vec<Entry> = entries.chain(diamonds).collect();
    key::over(ui, height, entries, |ui, height| plot(ui, id, (chart, measured), height, fresh));
}

fn plot(ui: &mut Ui, id: &str, (chart, measured): (&Chart, &[[f64; 2]]), height: f32, fresh: bool) {
    let palette = Palette::of(ui);
    let (x_log, y_log) = (chart.x.log, chart.y.log);
    let mut plot = axes::plot(ui, id, height, &plain(&chart.x.label), &plain(&chart.y.label))
        .auto_bounds(Vec2b::TRUE)
        .label_formatter(move |hover| match hover {
            egui_plot::HoverPosition::NearDataPoint { plot_name, position, .. } => {
                let value = |at: f64, log: bool| numbers::significant(if log { 10f64.powf(at) } else { at });
                Some(format!("{plot_name}\n{}, {}", value(position.x, x_log), value(position.y, y_log)))
            }
            egui_plot::HoverPosition::Elsewhere { .. } => None,
        });
    if x_log {
        plot = plot.decades_x(8.0);
    }
    if y_log {
        plot = plot.decades_y(8.0);
    }
    if fresh {
        plot = plot.reset();
    }
    axes::show(plot, ui, &chart.title, |plot| {
        let place = |at: f64, log: bool| if log { at.log10() } else { at };
        for (k, series) in chart.series.iter().enumerate() {
            let color = color(&palette, series.marks, k);
            let points: PlotPoints<'_> =
                series.points.iter().map(|[x, y]| [place(*x, x_log), place(*y, y_log)]).collect();
            match series.marks {
                Marks::Line => plot.line(Line::new(&series.name, points).color(color).width(2.0)),
                Marks::Dots => plot.points(Points::new(&series.name, points).color(color).radius(2.4)),
                Marks::Rings => {
                    plot.points(Points::new(&series.name, points).color(color).radius(2.4).filled(false));
                }
                Marks::Crosses => {
                    plot.points(Points::new(&series.name, points).color(color).radius(4.5).shape(MarkerShape::Cross));
                }
            }
        }
        let shown = measured.iter().map(|[x, y]| [place(*x, x_log), place(*y, y_log)]);
        let shown: Vec<[f64; 2]> = shown.filter(|point| point.iter().all(|value| value.is_finite())).collect();
        if !shown.is_empty() {
            let points = Points::new(MEASURED, shown).color(palette.text).radius(DIAMOND);
            plot.points(points.shape(MarkerShape::Diamond));
        }
    });
}

/// Returns the colour of series `k`.
fn color(palette: &Palette, marks: Marks, k: usize) -> Color32 {
    if marks == Marks::Crosses {
        return palette.wrong;
    }
    let hues = [palette.film, palette.pressure, palette.deformation, palette.traction, palette.accent, palette.text];
    // After all hues have been used, they repeat with a fainter shade.
    let faint = 0.6f32.powi((k / hues.len()) as i32);
    hues.get(k % hues.len()).map_or(Color32::GRAY, |hue| hue.gamma_multiply(faint))
}

/// Removes braces, which would be read as marks of symbols. Titles of a study contain none, but file names may.
fn plain(text: &str) -> String {
    text.replace(['{', '}'], "")
}
