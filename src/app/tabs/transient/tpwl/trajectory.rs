//! Training trajectory with the operating points of the rule in use, and those of the other rule.

use super::shown::{ShownModel, near, point_under};
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::frame::PlotFrame;
use crate::app::tabs::transient::linearised::PointNow;
use crate::app::tabs::transient::method::rule_name;
use crate::app::tabs::transient::{Run, series};
use crate::app::theme::{THIN_WIDTH, faded};
use crate::app::units::{self, Scale, Scales};
use crate::solver::full::transient::Quantity;
use crate::solver::physics::engineering::QuantityKind;
use crate::solver::reduced::tpwl::Selection;
use egui::{Color32, Id, Ui, Vec2b};
use egui_plot::{Line, MarkerShape, PlotPoint, PlotPoints, Points, VLine};

/// Returns colour and symbol of the drawn quantity.
fn look(shown: &ShownModel<'_>) -> (Color32, &'static str) {
    match shown.choices.quantity {
        Quantity::CentralPressure => (shown.palette.pressure, "{P_c}"),
        _ => (shown.palette.film, "{H_c}"),
    }
}

fn plot<'a>(ui: &Ui, shown: &ShownModel<'_>, id: &str, titles: (&str, &str), height: f32) -> PlotFrame<'a> {
    let columns = series::marks(ui.available_width());
    let group = Id::unique(("tpwl trajectory", shown.view.generation, shown.choices.trajectory));
    let (generation, quantity, trajectory) = (shown.view.generation, shown.choices.quantity, shown.choices.trajectory);
    let plot = axes::plot(ui, &format!("{id} {generation} {quantity:?} {trajectory}"), height, titles.0, titles.1);
    let plot = match &shown.view.setup {
        Some(setup) => {
            let system = units::system(ui.ctx());
            let time = Scale::of(QuantityKind::TransitTime, system, setup.time_scale_s());
            let (scales, plot) = (Scales::of(&setup.point, system), plot.units_x(time, "{t}"));
            match quantity {
                Quantity::CentralPressure => plot.units_y(scales.pressure, "{p_c}"),
                _ => plot.units_y(scales.film, "{h_c}"),
            }
        }
        None => plot,
    };
    plot.marks_x(columns)
        .marks_y(3.0)
        .link_axis(group, Vec2b::new(true, false))
        .link_cursor(group, Vec2b::new(true, false))
        .set_margin_fraction(egui::vec2(0.02, 0.12))
        .auto_bounds(Vec2b::TRUE)
}

/// Returns the trajectory as a line.
fn curve(shown: &ShownModel<'_>) -> Vec<PlotPoint> {
    let moments = shown.linearised.trainings.get(shown.choices.trajectory).map_or(&[][..], Vec::as_slice);
    axes::thinned(
        moments.iter().map(|moment| PlotPoint::new(moment.time, moment.value(shown.choices.quantity))).collect(),
    )
}

/// Returns the runs of the linearised model if the run itself trained it. They are drawn broad and pale, as in all
/// plots.
fn runs(shown: &ShownModel<'_>) -> Vec<(String, Vec<PlotPoint>)> {
    let runs = shown.runs.iter().filter(|_| shown.linearised.own);
    let points = |run: &Run| -> Vec<PlotPoint> {
        run.trajectory.moments.iter().map(|m| PlotPoint::new(m.time, m.value(shown.choices.quantity))).collect()
    };
    runs.map(|(_, run)| (run.name(), axes::thinned(points(run)))).collect()
}

fn place(shown: &ShownModel<'_>, time: f64) -> Option<PlotPoint> {
    let value = shown.linearised.value(shown.choices.trajectory, shown.choices.quantity, time)?;
    Some(PlotPoint::new(time, value))
}

fn title(ui: &mut Ui, rule: Selection, points: usize, used: &str) {
    let tolerance = numbers::digits(rule.tolerance(), 3);
    let plural = if points == 1 { "" } else { "s" };
    ui.weak(format!("{}, {used}: {points} point{plural}, β = {tolerance}", rule_name(rule).0))
        .on_hover_text(rule_name(rule).1);
}

/// Draws the rule in use. The size of a point shows its weight, and a click moves to its time.
pub fn chosen(ui: &mut Ui, shown: &ShownModel<'_>, height: f32) -> Option<f64> {
    let rule = shown.linearised.model.training.selection;
    let places: Vec<(&PointNow, PlotPoint)> = shown
        .of_trajectory()
        .filter_map(|now| {
            let trained = shown.linearised.model.points.get(now.point)?;
            Some((now, place(shown, trained.moment.time)?))
        })
        .collect();
    title(ui, rule, places.len(), "in use");
    let (color, symbol) = look(shown);
    let (line, time, own) = (curve(shown), shown.view.player.time(), shown.linearised.own);
    let (palette, markers) = (shown.palette, weighted(shown, &places));
    let dots: Vec<PlotPoint> = places.iter().map(|(_, place)| *place).collect();
    let plot = plot(ui, shown, "tpwl chosen", ("{T}", symbol), height - 22.0);
    let runs = runs(shown);
    let drawn = axes::show(plot, ui, "Operating points along the trajectory", move |plot| {
        for (name, points) in runs {
            let line = Line::new(name, PlotPoints::Owned(points)).color(faded(color, 0.5)).width(5.0);
            plot.line(line.allow_hover(false));
        }
        plot.line(Line::new("Training", PlotPoints::Owned(line)).color(color).width(1.6).allow_hover(false));
        if own {
            plot.vline(VLine::new("", time).id("now").color(palette.accent).width(1.0).allow_hover(false));
        }
        plot.points(marks("Operating points", dots, 2.6, palette.text));
        markers.into_iter().for_each(|marker| plot.points(marker));
    });
    let pointer = drawn.response.hover_pos();
    let under = pointer.and_then(|pointer| near(places.into_iter(), &drawn.transform, pointer));
    if under.is_none() && own && drawn.response.clicked() {
        return pointer.map(|pointer| drawn.transform.value_from_position(pointer).x);
    }
    point_under(shown, drawn.response, under)
}

/// Draws the points of the other rule for the same number of points.
pub fn not_chosen(ui: &mut Ui, shown: &ShownModel<'_>, height: f32) -> Option<f64> {
    let Some(other) = &shown.linearised.other else {
        ui.weak("The points of the other rule are being computed");
        return None;
    };
    let rule = other.selection;
    let chosen = other.chosen.get(shown.choices.trajectory).map_or(&[][..], Vec::as_slice);
    title(ui, rule, chosen.len(), "the other rule");
    let (color, symbol) = look(shown);
    let moments = shown.linearised.model.trajectories.get(shown.choices.trajectory).map_or(&[][..], Vec::as_slice);
    let times = chosen.iter().filter_map(|&i| moments.get(i)).map(|moment| moment.time);
    let dots: Vec<PlotPoint> = times.filter_map(|time| place(shown, time)).collect();
    let (line, reference, quiet, time, own) =
        (curve(shown), shown.palette.accent, shown.palette.quiet, shown.view.player.time(), shown.linearised.own);
    let plot = plot(ui, shown, "tpwl other", ("{T}", symbol), height - 22.0);
    let places = dots.clone();
    let drawn = axes::show(plot, ui, "Points of the other rule", move |plot| {
        plot.line(Line::new("Training", PlotPoints::Owned(line)).color(color).width(THIN_WIDTH).allow_hover(false));
        if own {
            plot.vline(VLine::new("", time).id("now").color(reference).width(1.0).allow_hover(false));
        }
        plot.points(marks("Other rule", dots, 2.6, quiet));
    });
    let clicked = own && drawn.response.clicked();
    let pointer = drawn.response.hover_pos().filter(|_| clicked)?;
    let under = near(places.iter().map(|place| (place.x, *place)), &drawn.transform, pointer);
    under.or(Some(drawn.transform.value_from_position(pointer).x))
}

/// Returns dots of one size.
pub fn marks(name: &str, dots: Vec<PlotPoint>, radius: f32, color: Color32) -> Points<'static> {
    let points = Points::new(name.to_owned(), PlotPoints::Owned(dots)).shape(MarkerShape::Circle);
    points.color(color).radius(radius).allow_hover(false)
}

/// Returns the points with a weight at the displayed time. Their size shows the weight; points of the second
/// weighting are rings.
pub fn weighted(shown: &ShownModel<'_>, places: &[(&PointNow, PlotPoint)]) -> Vec<Points<'static>> {
    let mut markers = Vec::new();
    for weighting in 0..2 {
        for (now, place) in places.iter().filter(|(now, _)| now.weights[weighting] > 0.0) {
            let radius = 3.0 + 7.0 * (now.weights[weighting] as f32).sqrt();
            let marker = marks("Weight", vec![*place], radius, shown.color(weighting)).filled(weighting == 0);
            markers.push(marker.id(("weight", weighting, now.point)));
        }
    }
    markers
}
