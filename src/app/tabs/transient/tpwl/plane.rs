//! Plane of two reduced coordinates: training trajectories, operating points, and the path of the run.

use super::shown::{ShownModel, near, point_under};
use crate::app::plot::axes;
use crate::app::tabs::transient::linearised::PointNow;
use crate::app::tabs::transient::tpwl::trajectory::{marks, weighted};
use egui::{RichText, Ui, Vec2b};
use egui_plot::{Line, MarkerShape, PlotPoint, PlotPoints, Points};

/// Maximum number of drawn points of the run's path.
const MOST_POINTS: usize = 2000;

/// Returns the name of a coordinate. The last one is H_0.
pub fn coordinate_name(k: usize, modes: usize) -> String {
    if k >= modes { "H_0".to_owned() } else { format!("Mode {}", k + 1) }
}

/// Returns the title of a coordinate's axis.
fn axis_title(k: usize, modes: usize) -> String {
    if k >= modes { "{H_0}".to_owned() } else { format!("Pressure mode {}", k + 1) }
}

/// Draws the plane. Returns the time of a click.
pub fn ui(ui: &mut Ui, shown: &ShownModel<'_>, height: f32) -> Option<f64> {
    let model = &shown.linearised.model;
    let [across, up] = shown.choices.coordinates;
    let modes = model.space.modes();
    let at = |state: &[f64]| {
        let place = PlotPoint::new(*state.get(across)?, *state.get(up)?);
        (place.x.is_finite() && place.y.is_finite()).then_some(place)
    };
    let places: Vec<(&PointNow, PlotPoint)> =
        shown.points.iter().filter_map(|now| Some((now, at(&model.points.get(now.point)?.moment.state)?))).collect();
    let (palette, film) = (shown.palette, shown.palette.film);
    let trainings: Vec<Vec<PlotPoint>> = model
        .trajectories
        .iter()
        .map(|moments| moments.iter().filter_map(|moment| at(&moment.state)).collect())
        .collect();
    let (path, now) = path(shown, at);
    let (dots, markers) = (places.iter().map(|(_, place)| *place).collect(), weighted(shown, &places));
    let id = format!("tpwl plane {} {across} {up}", shown.view.generation);
    let key = [("training", film), ("operating points", palette.text), ("run, dashed", palette.quiet)];
    ui.horizontal(|ui| {
        for (name, color) in key.into_iter().chain([("weights", shown.color(0)), ("now", palette.pressure)]) {
            ui.label(RichText::new(name).small().color(palette.ink(color))).on_hover_text(
                "Reduced coordinates V^T W P and H_0: the training trajectories, the operating points with a size by \
                 their weights, the path of the run, and a diamond at the displayed time",
            );
        }
    });
    let plot = axes::plot(ui, &id, height - 22.0, &axis_title(across, modes), &axis_title(up, modes))
        .marks_x(3.0)
        .marks_y(5.0)
        .set_margin_fraction(egui::vec2(0.06, 0.06))
        .auto_bounds(Vec2b::TRUE);
    let fit = shown.fit;
    let drawn = axes::show(plot, ui, "Operating points in the plane", move |plot| {
        axes::fit(plot, fit);
        for (k, points) in trainings.into_iter().enumerate() {
            let line = Line::new("Training", PlotPoints::Owned(points)).id(("training", k)).color(film);
            plot.line(line.width(1.4).allow_hover(false).allow_band(false));
        }
        let line = Line::new("Run", PlotPoints::Owned(path)).color(palette.quiet).width(1.2);
        plot.line(line.style(egui_plot::LineStyle::dashed_dense()).allow_hover(false).allow_band(false));
        plot.points(marks("Operating points", dots, 2.6, palette.text));
        markers.into_iter().for_each(|marker| plot.points(marker));
        if let Some(now) = now {
            let marker = Points::new("Now", PlotPoints::Owned(vec![now])).shape(MarkerShape::Diamond);
            plot.points(marker.color(palette.pressure).radius(6.0).allow_hover(false));
        }
    });
    let pointer = drawn.response.hover_pos()?;
    let under = near(places.into_iter(), &drawn.transform, pointer);
    point_under(shown, drawn.response, under)
}

/// Returns the path of the first linearised run, and its position at the displayed time.
fn path(shown: &ShownModel<'_>, at: impl Fn(&[f64]) -> Option<PlotPoint>) -> (Vec<PlotPoint>, Option<PlotPoint>) {
    let Some((run, record)) = shown.runs.iter().find_map(|(_, run)| Some((run, run.record.as_ref()?))) else {
        return (Vec::new(), None);
    };
    let steps = record.steps().len();
    let every = steps.div_ceil(MOST_POINTS).max(1);
    let path = (0..steps).step_by(every).filter_map(|step| at(record.state(step))).collect();
    (path, run.step_at(shown.view.player.time()).and_then(|step| at(record.state(step))))
}
