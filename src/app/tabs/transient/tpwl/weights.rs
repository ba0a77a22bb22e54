//! Weights of the operating points at the displayed time, both kinds in one plot.

use super::shown::{ShownModel, near, point_under};
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::tabs::transient::method::{WEIGHTINGS, weighting_name};
use crate::app::theme::faded;
use egui::{Align2, RichText, Ui};
use egui_plot::{Line, PlotBounds, PlotPoint, Text};

/// Width of a stem, in the order of [`WEIGHTINGS`]. The one behind is broader.
const STEMS: [f32; 2] = [4.0, 11.0];
/// Top of the plot, with space for the times above the stems.
const TOP: f64 = 1.15;

/// Draws stems over the numbers of the points. Returns the time of a click.
pub fn ui(ui: &mut Ui, shown: &ShownModel<'_>, height: f32) -> Option<f64> {
    head(ui, shown);
    let number = |point: usize| point as f64 + 1.0;
    let mut stems = Vec::new();
    for k in (0..WEIGHTINGS.len()).rev() {
        for now in shown.points.iter().filter(|now| now.weights[k] > 0.0) {
            let ends = vec![[number(now.point), 0.0], [number(now.point), now.weights[k]]];
            let color = if k == 0 { shown.color(k) } else { faded(shown.color(k), 0.6) };
            let stem = Line::new(weighting_name(WEIGHTINGS[k]).0, ends).id(("stem", k, now.point));
            stems.push(stem.color(color).width(STEMS[k]).allow_hover(false).allow_band(false));
        }
    }
    let used = shown.points.iter().filter(|now| now.weights.iter().any(|w| *w > 0.0));
    let labels: Vec<(PlotPoint, String)> = used
        .filter_map(|now| {
            let trained = shown.linearised.model.points.get(now.point)?;
            let top = now.weights.iter().copied().fold(0.0, f64::max);
            let time = format!("T {}", numbers::digits(trained.moment.time, 3));
            Some((PlotPoint::new(number(now.point), top), time))
        })
        .collect();
    // Space at the end for the time above the last stem.
    let end = 1.05 * number(shown.points.len());
    let bounds = PlotBounds::from_min_max([0.0, 0.0], [end, TOP]);
    let (quiet, fit) = (shown.palette.quiet, shown.fit);
    let id = format!("tpwl weights {}", shown.view.generation);
    let plot = axes::plot(ui, &id, height - 22.0, "Operating point", "Weight")
        .marks_y(4.0)
        .default_x_bounds(0.0, end)
        .default_y_bounds(0.0, TOP);
    let drawn = axes::show(plot, ui, "Weights of the operating points", move |plot| {
        if fit {
            plot.set_plot_bounds(bounds);
        }
        stems.into_iter().for_each(|stem| plot.line(stem));
        for (k, (place, time)) in labels.into_iter().enumerate() {
            let text = Text::new("", place, RichText::new(time).size(11.0).color(quiet)).anchor(Align2::CENTER_BOTTOM);
            plot.text(text.id(("time of a point", k)).allow_hover(false));
        }
    });
    let pointer = drawn.response.hover_pos()?;
    let level = drawn.transform.value_from_position(pointer).y;
    let stems = shown.points.iter().map(|now| (now, PlotPoint::new(number(now.point), level)));
    let under = near(stems, &drawn.transform, pointer);
    point_under(shown, drawn.response, under)
}

/// Draws the distance of the step from the training, and the key of the colours.
fn head(ui: &mut Ui, shown: &ShownModel<'_>) {
    let reach = shown.runs.iter().find_map(|(_, run)| {
        let record = run.record.as_ref()?;
        record.steps().get(run.step_at(shown.view.player.time())?).map(|step| step.reach())
    });
    let said = reach
        .filter(|reach| reach.is_finite())
        .map_or_else(String::new, |reach| format!(", {} distances between points away", numbers::digits(reach, 2)));
    ui.horizontal_wrapped(|ui| {
        ui.weak(format!("Weights{said}")).on_hover_text(
            "Distance of the extrapolated state from the barycentre of the points that carry it, over the distance \
             between those points. Above about two a linearised model is not valid",
        );
        let both = (0..WEIGHTINGS.len()).all(|k| shown.was_run(k));
        for k in (0..WEIGHTINGS.len()).filter(|_| both) {
            let (name, meaning) = weighting_name(WEIGHTINGS[k]);
            ui.label(RichText::new(name).color(shown.palette.ink(shown.color(k)))).on_hover_text(meaning);
        }
    });
}
