//! View of the quality of the calibrated bound: bound against true error of H_c.

use super::failure_map::{By, is_former, stamp, summary};
use super::parts::tests_toolbar;
use super::random_tests::{RandomTests, Results, bound_of};
use crate::app::context::Context;
use crate::app::controls::spoken;
use crate::app::in_use::InUse;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::theme::Palette;
use crate::engine::{median, rank_correlation};
use egui::{Grid, Ui, Vec2b};
use egui_plot::{Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points};

/// Smaller errors are below the tolerance of the full solver.
const FLOOR: f64 = 1e-11;
/// Radius of a test's mark.
const RADIUS: f32 = 2.8;
/// Accessible name of the plot.
const PLOT: &str = "Bound against true error";

/// Quality of the bound, from pairs (bound, true error).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Worth {
    /// Number of pairs.
    count: usize,
    /// Spearman's rank correlation.
    correlation: f64,
    /// Share of pairs whose true error does not exceed the bound.
    holds: f64,
    /// Median of bound over true error.
    effectivity: f64,
}

impl Worth {
    fn of(pairs: &[(f64, f64)]) -> Self {
        let (bounds, truths): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
        let effectivities: Vec<f64> = pairs.iter().map(|(e, t)| e / t.max(FLOOR)).collect();
        Self {
            count: pairs.len(),
            correlation: rank_correlation(&bounds, &truths),
            holds: pairs.iter().filter(|(e, t)| e >= t).count() as f64 / pairs.len() as f64,
            effectivity: median(&effectivities),
        }
    }
}

/// Content of the view, updated after a change.
pub struct Scatter {
    of: (usize, usize, By),
    worth: Worth,
    /// (log10 of the true error, log10 of the bound) of pairs where the bound holds.
    holds: Vec<PlotPoint>,
    /// The same for pairs where the bound does not hold.
    fails: Vec<PlotPoint>,
    /// Ends of the line of perfect bounds.
    line: (f64, f64),
}

impl Scatter {
    /// Returns the content. `None` without any pair.
    fn new(results: &Results) -> Option<Self> {
        let pairs: Vec<(f64, f64)> = results.pairs().collect();
        if pairs.is_empty() {
            return None;
        }
        let log = |v: f64| v.max(FLOOR).log10();
        let place = |&(bound, truth): &(f64, f64)| PlotPoint::new(log(truth), log(bound));
        let (holds, fails): (Vec<_>, Vec<_>) = pairs.iter().partition(|(bound, truth)| bound >= truth);
        let truths = pairs.iter().map(|pair| log(pair.1));
        let (low, high) = truths.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        Some(Self {
            of: stamp(results, By::Truth),
            worth: Worth::of(&pairs),
            holds: holds.iter().map(place).collect(),
            fails: fails.iter().map(place).collect(),
            line: (low.floor(), high.ceil()),
        })
    }
}

/// Draws the view.
pub fn ui(
    ui: &mut Ui,
    (shown, tests): (&mut Option<Scatter>, &mut RandomTests),
    context: &Context<'_>,
    in_use: &InUse,
) {
    tests_toolbar(ui, context.answers.store(), tests, in_use);
    let Some(results) = &tests.results else {
        super::parts::nothing_yet(ui, "Run the validation with full solutions to see the quality of the bound");
        return;
    };
    let stale = is_former(ui, results, context);
    ui.weak(summary(results));
    super::parts::bound_note(ui, results.tests.iter().map(bound_of));
    if shown.as_ref().is_none_or(|s| s.of != stamp(results, By::Truth)) {
        *shown = Scatter::new(results);
    }
    match shown {
        Some(shown) => {
            worth_ui(ui, &shown.worth);
            scatter(ui, shown, stale);
        }
        None => super::parts::nothing_yet(ui, "No test has been compared with a full solution yet"),
    }
}

fn worth_ui(ui: &mut Ui, worth: &Worth) {
    let cells = [
        ("Compared", worth.count.to_string(), "Tests with a bound and a true error"),
        (
            "Rank correlation",
            numbers::digits(worth.correlation, 3),
            "Spearman’s rank correlation: 1 if the bound orders all errors correctly",
        ),
        (
            "Bound holds",
            format!("{}{}%", numbers::digits(100.0 * worth.holds, 3), numbers::THIN),
            "Share of contacts whose true error does not exceed the bound; nominally 99 %",
        ),
        (
            "Median effectivity",
            numbers::digits(worth.effectivity, 3),
            "Bound over true error: 1 is ideal, below 10 is useful",
        ),
    ];
    Grid::new("worth").num_columns(cells.len()).spacing([22.0, 2.0]).show(ui, |ui| {
        for (name, _, tip) in &cells {
            ui.weak(*name).on_hover_text(*tip);
        }
        ui.end_row();
        for (name, value, tip) in &cells {
            let label = ui.strong(value).on_hover_text(*tip);
            spoken(ui, label, &format!("{name}: {value}"));
        }
        ui.end_row();
    });
}

fn scatter(ui: &mut Ui, shown: &Scatter, stale: bool) {
    let palette = Palette::of(ui);
    let grey = |color| if stale { palette.reference } else { color };
    let (low, high) = shown.line;
    let height = (ui.available_height() - 4.0).max(150.0);
    let series = [
        ("holds", &shown.holds, grey(palette.film), MarkerShape::Circle),
        ("does not hold", &shown.fails, grey(palette.warning), MarkerShape::Down),
    ];
    let entries = series.iter().filter(|series| !series.1.is_empty()).map(|(name, _, color, shape)| {
        let sample = if *shape == MarkerShape::Down { Sample::Down(RADIUS) } else { Sample::Dot(RADIUS) };
        Entry::new(*name, *color, sample)
    });
    let entries = entries.chain([Entry::new("bound = true error", palette.reference, Sample::Dashed(1.2))]);
    key::over(ui, height, entries, |ui, height| {
        let plot = axes::plot(ui, "truth", height, "True relative error of {H_c}", "Bound on the error of {H_c}")
            .decades_x(8.0)
            .decades_y(8.0)
            .auto_bounds(Vec2b::TRUE)
            .label_formatter(|hover| match hover {
                egui_plot::HoverPosition::NearDataPoint { position, .. } => Some(format!(
                    "true error {}\nbound {}",
                    numbers::error_percent(10f64.powf(position.x)),
                    numbers::error_percent(10f64.powf(position.y))
                )),
                egui_plot::HoverPosition::Elsewhere { .. } => None,
            });
        axes::show(plot, ui, PLOT, |plot| {
            // Line of perfect bounds, over the range of the true errors.
            let identity = Line::new("bound = true error", vec![[low, low], [high, high]]).color(palette.reference);
            plot.line(identity.width(1.2).style(LineStyle::dashed_dense()).allow_hover(false));
            for (name, points, color, shape) in series.into_iter().filter(|s| !s.1.is_empty()) {
                let points = Points::new(name, PlotPoints::Borrowed(points));
                plot.points(points.color(color).radius(RADIUS).shape(shape));
            }
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worth_of_a_bound_twice_too_large_and_once_too_small() {
        let mut pairs: Vec<(f64, f64)> = (1..=9).map(|k| (2e-6 * f64::from(k), 1e-6 * f64::from(k))).collect();
        let worth = Worth::of(&pairs);
        assert!(
            (worth.correlation - 1.0).abs() < 1e-12 && worth.holds == 1.0 && (worth.effectivity - 2.0).abs() < 1e-9
        );
        pairs.push((1e-9, 1e-3));
        let worth = Worth::of(&pairs);
        assert!(worth.correlation < 0.9 && (worth.holds - 0.9).abs() < 1e-12 && worth.count == 10);
    }
}
