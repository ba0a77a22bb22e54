//! Pressure and film thickness of every run at the displayed time.

use super::runs::TransientRuns;
use crate::app::figure::Canvas;
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::frame::PlotFrame;
use crate::app::tabs::transient::Run;
use crate::app::tabs::transient::series::{drawn, marks, rows, style};
use crate::app::theme::{Palette, THIN_WIDTH};
use crate::app::units::{self, Scale, Scales};
use crate::solver::full::transient::{Moment, Quantity};
use crate::solver::physics::contact::ContactKind;
use egui::{Color32, Id, Ui, Vec2b};
use egui_plot::{Line, LineStyle, PlotPoint, PlotPoints};

/// Initial X range, as in the Profiles tab.
const X_RANGE: (f64, f64) = (-2.2, 1.6);

/// Draws both plots, each with this height.
pub fn ui(ui: &mut Ui, view: &TransientRuns, fit: bool, height: f32) {
    let palette = Palette::of(ui);
    let most = |quantity: Quantity| {
        let values = view.runs.iter().flat_map(|run| &run.trajectory.moments).map(|moment| moment.value(quantity));
        numbers::round_up(1.12 * values.fold(0.0, f64::max))
    };
    let time = view.player.time();
    let generation = view.generation;
    let columns = marks(ui.available_width());
    let stacked = |name: &str, titles: (&str, &str), (low, top): (f64, f64)| {
        // The axis stays fixed while the profiles play.
        let id = format!("transient {name} {generation} {low} {top}");
        axes::plot(ui, &id, height, titles.0, titles.1)
            .paper_x("{X}")
            .marks_x(columns)
            .marks_y(rows(height))
            .y_axis_min_width(54.0)
            .link_axis(Id::unique(("transient profiles", generation)), Vec2b::new(true, false))
            .link_cursor(Id::unique(("transient profiles", generation)), Vec2b::new(true, false))
            .set_margin_fraction(egui::vec2(0.0, 0.0))
            .default_x_bounds(X_RANGE.0, X_RANGE.1)
            .default_y_bounds(low, top)
    };
    let scales = view.setup.as_ref().map(|setup| Scales::of(&setup.point, units::system(ui.ctx())));
    let pressure = stacked("profile of pressure", ("", "Pressure {P}"), (0.0, most(Quantity::MaximumPressure)));
    let pressure = with_units(pressure, scales, |of| of.pressure, "Pressure {p}");
    let depth = view.runs.first().map_or(0.0, deepest);
    let range = (-2.0 * BELOW * depth, 3.0 * most(Quantity::CentralFilm));
    let film = stacked("profile of film", ("{X}", "Film {H}"), range);
    let film = with_units(film, scales, |of| of.film, "Film {h}");
    axes::show(pressure, ui, "Pressure at this moment", |plot| {
        axes::fit(plot, fit);
        if let Some((run, moment)) = view.runs.first().and_then(|run| Some((run, moment_at(run, time)?))) {
            hertz(plot, dry(run.trajectory.transient.point.kind, moment), &palette);
        }
        curves(plot, view, time, (palette.pressure, &palette), |(x, p, _)| PlotPoint::new(x, p));
    });
    axes::show(film, ui, "Film at this moment", |plot| {
        axes::fit(plot, fit);
        curves(plot, view, time, (palette.film, &palette), |(x, _, h)| PlotPoint::new(x, h));
        if let Some(run) = view.runs.first().filter(|_| depth > 0.0) {
            undeformed(plot, run, time, (depth, &palette));
        }
    });
}

/// Distance of the undeformed features below H = 0, in units of their largest height.
const BELOW: f64 = 1.3;
/// Number of points of their curve.
const UNDEFORMED: usize = 600;

/// Returns the largest height or depth of the features of a run. 0 without features.
fn deepest(run: &Run) -> f64 {
    let surfaces = &run.trajectory.transient.surfaces;
    surfaces.iter().map(|surface| surface.shape.greatest()).fold(0.0, f64::max)
}

/// Draws the undeformed features at the displayed time below the film, in its scale.
fn undeformed(plot: &mut Canvas<'_, '_>, run: &Run, time: f64, (depth, palette): (f64, &Palette)) {
    let Some(state) = run.state_at(time) else { return };
    let (from, to) = match run.trajectory.x.as_slice() {
        [first, .., last] => (*first, *last),
        _ => return,
    };
    let surfaces = &run.trajectory.transient.surfaces;
    let height = |x: f64| surfaces.iter().map(|surface| surface.height(x, 0.0, state.time)).sum::<f64>();
    let curve = (0..=UNDEFORMED).map(|k| from + (to - from) * k as f64 / UNDEFORMED as f64);
    let points = curve.map(|x| PlotPoint::new(x, height(x) - BELOW * depth)).collect();
    let line = Line::new("Undeformed feature", PlotPoints::Owned(points)).color(palette.reference).width(THIN_WIDTH);
    plot.line(line.allow_band(false));
}

fn with_units<'a>(
    plot: PlotFrame<'a>,
    scales: Option<Scales>,
    unit: fn(Scales) -> Scale,
    title: &str,
) -> PlotFrame<'a> {
    match scales {
        Some(scales) => plot.units_x(scales.along, "{x}").units_y(unit(scales), title),
        None => plot,
    }
}

fn moment_at(run: &Run, time: f64) -> Option<&Moment> {
    let state = run.state_at(time)?;
    run.trajectory.moments.iter().find(|moment| moment.time == state.time)
}

/// Returns half-width and largest pressure of the dry contact at a moment, in the scales of the reference contact (4.1).
pub fn dry(kind: ContactKind, moment: &Moment) -> (f64, f64) {
    let (load, radius) = (moment.input.load, moment.input.radius);
    (kind.hertz_root(load * radius), kind.hertz_root(load / radius.powi(kind.radius_power())))
}

/// Draws the pressure of a dry contact.
fn hertz(plot: &mut Canvas<'_, '_>, (half_width, top): (f64, f64), palette: &Palette) {
    let shape = move |x: f64| top * (1.0 - (x / half_width).powi(2)).max(0.0).sqrt();
    let curve = PlotPoints::from_explicit_callback(shape, -half_width..=half_width, 160);
    let line = Line::new("Hertz", curve).color(palette.reference).width(THIN_WIDTH);
    plot.line(line.style(LineStyle::dashed_dense()));
}

fn curves(
    plot: &mut Canvas<'_, '_>,
    view: &TransientRuns,
    time: f64,
    (color, palette): (Color32, &Palette),
    of: impl Fn((f64, f64, f64)) -> PlotPoint,
) {
    for (k, run) in drawn(view) {
        let Some(state) = run.state_at(time) else { continue };
        let points = run.profile(state).map(&of).collect();
        let (color, width, line_style) = style(view, k, color, palette);
        let line = Line::new(run.name(), PlotPoints::Owned(points));
        plot.line(line.color(color).width(width).style(line_style).allow_band(false));
    }
}
