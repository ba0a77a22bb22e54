//! The weights of the operating points at this moment, both kinds beside each other.

use super::{Shown, near, point_under};
use crate::app::numbers;
use crate::app::plots::axes;
use crate::app::transient::linearised::PointNow;
use crate::app::transient::method::{WEIGHTINGS, weighting_name};
use egui::{Align2, RichText, Ui};
use egui_plot::{Bar, BarChart, Corner, Legend, PlotPoint, Text};

/// Bars against the number of the point; returns the moment that was clicked at.
pub fn ui(ui: &mut Ui, shown: &Shown<'_>, height: f32) -> Option<f64> {
    head(ui, shown);
    let both = (0..WEIGHTINGS.len()).filter(|&k| shown.was_run(k)).count() > 1;
    let charts: Vec<BarChart> = (0..WEIGHTINGS.len())
        .filter(|&k| shown.was_run(k))
        .map(|k| {
            let width = if both { 0.42 } else { 0.8 };
            let aside = if both { [-0.22, 0.22][k] } else { 0.0 };
            let bar = |now: &PointNow| Bar::new(now.point as f64 + 1.0 + aside, now.weights[k]).width(width);
            let used = shown.points.iter().filter(|now| now.weights[k] > 0.0);
            let chart = BarChart::new(weighting_name(WEIGHTINGS[k]).0, used.map(bar).collect());
            chart.color(shown.color(k)).allow_hover(false)
        })
        .collect();
    let labels: Vec<(PlotPoint, String)> = shown
        .points
        .iter()
        .filter(|now| now.weights.iter().any(|w| *w > 0.0))
        .filter_map(|now| {
            let trained = shown.linearised.model.points.get(now.point)?;
            let top = now.weights.iter().copied().fold(0.0, f64::max);
            let time = format!("T {}", numbers::digits(trained.moment.time, 3));
            Some((PlotPoint::new(now.point as f64 + 1.0, top), time))
        })
        .collect();
    let count = shown.points.len() as f64;
    let quiet = shown.palette.quiet;
    let plot =
        axes::plot(ui, &format!("tpwl weights {}", shown.view.generation), height - 22.0, "Operating point", "Weight")
            .legend(Legend::default().position(Corner::RightTop).background_alpha(0.6))
            .y_grid_spacer(|input| axes::round_marks(input, 4.0))
            .default_x_bounds(0.0, count + 1.0)
            .default_y_bounds(0.0, 1.15)
            .include_y(0.0);
    let shown_fit = shown.fit;
    let drawn = axes::show(ui, "Weights of the operating points", plot, move |plot| {
        if shown_fit {
            plot.set_plot_bounds(egui_plot::PlotBounds::from_min_max([0.0, 0.0], [count + 1.0, 1.15]));
        }
        charts.into_iter().for_each(|chart| plot.bar_chart(chart));
        for (k, (place, time)) in labels.into_iter().enumerate() {
            let text = Text::new("", place, RichText::new(time).size(11.0).color(quiet)).anchor(Align2::CENTER_BOTTOM);
            plot.text(text.id(("time of a point", k)).allow_hover(false));
        }
    });
    let pointer = drawn.response.hover_pos()?;
    let at = drawn.transform.value_from_position(pointer).x;
    let bars = shown.points.iter().map(|now| (now, PlotPoint::new(now.point as f64 + 1.0, 0.0)));
    let level = drawn.transform.position_from_point(&PlotPoint::new(at, 0.0)).y;
    let under = near(bars, &drawn.transform, egui::pos2(pointer.x, level));
    point_under(shown, drawn.response, under)
}

/// How far the step lies from what was trained.
fn head(ui: &mut Ui, shown: &Shown<'_>) {
    let reach = shown.runs.iter().find_map(|(_, run)| {
        let record = run.record.as_ref()?;
        record.steps().get(run.step_at(shown.view.player.time())?).map(|step| step.reach())
    });
    let said = reach
        .filter(|reach| reach.is_finite())
        .map_or_else(String::new, |reach| format!(", {} distances between points away", numbers::digits(reach, 2)));
    ui.weak(format!("Weights at this moment{said}")).on_hover_text(
        "The distance of the extrapolated state from the barycentre of the points that carry it, over the distance between those points: \
         beyond about two a linearised model knows nothing",
    );
}
