//! Central pressure and film against time, and how far runs lie apart.

use super::runs::TransientRuns;
use crate::app::document::input::Input;
use crate::app::figure::Canvas;
use crate::app::plot::axes;
use crate::app::plot::frame::PlotFrame;
use crate::app::tabs::transient::Run;
use crate::app::theme::{Palette, THIN_WIDTH, faded};
use crate::app::units::Scales;
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::{Frame, Interpolation, Moment, Quantity};
use crate::solver::reduced::tpwl::Weighting;
use egui::{Color32, Id, Ui, Vec2b};
use egui_plot::{HLine, Line, LineStyle, PlotPoint, PlotPoints, VLine};

/// The line of a run: the frame by dashes; a linearised model broad and pale, the reduced model thick, the full one
/// thin over them, the first of full ones alone thick.
pub fn style(view: &TransientRuns, k: usize, color: Color32, palette: &Palette) -> (Color32, f32, LineStyle) {
    let Some(run) = view.runs.get(k) else { return (color, 1.0, LineStyle::Solid) };
    let dashes = match run.frame() {
        _ if run.by == MarchedBy::Linearised(Weighting::Dissertation) => LineStyle::dashed_dense(),
        Frame::Fixed => LineStyle::Solid,
        Frame::ArbitraryLagrangianEulerian => LineStyle::dashed_loose(),
        Frame::Remeshed(Interpolation::CubicSpline) => LineStyle::dashed_dense(),
        Frame::Remeshed(Interpolation::Linear) => LineStyle::dotted_dense(),
    };
    let thick = match run.by {
        MarchedBy::Linearised(_) => return (faded(color, 0.5), 5.0, dashes),
        MarchedBy::Reduced => true,
        MarchedBy::Full => k == 0 && view.runs.iter().all(|run| run.by == MarchedBy::Full),
    };
    let (color, width) = if thick { (color, 2.6) } else { (palette.over(color), 1.4) };
    (color, width, dashes)
}

/// The runs as they are drawn, thick ones first: a thin line stays visible over a thick one.
pub fn drawn(view: &TransientRuns) -> impl Iterator<Item = (usize, &Run)> {
    let of = |wanted: fn(MarchedBy) -> bool| view.runs.iter().enumerate().filter(move |(_, run)| wanted(run.by));
    of(|by| matches!(by, MarchedBy::Linearised(_)))
        .chain(of(|by| by == MarchedBy::Reduced))
        .chain(of(|by| by == MarchedBy::Full))
}

/// What is drawn against time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Against {
    /// Film, pressure and load, each relative to its stationary start.
    #[default]
    Together,
    /// H_c.
    Film,
    /// P_c.
    Pressure,
}

/// The series.
#[derive(Default)]
pub struct Along {
    against: Against,
}

impl Along {
    /// The plot with what it may show over it, above another with the same axis or not; returns the time that was
    /// clicked at.
    pub fn ui(&mut self, ui: &mut Ui, view: &TransientRuns, height: f32, above: bool) -> Option<f64> {
        let below = if above { "" } else { "{T}" };
        let palette = Palette::of(ui);
        ui.horizontal_wrapped(|ui| {
            let options = [
                (Against::Together, "Together", "Central film, central pressure and the inputs, relative to the start"),
                (Against::Film, "Film", "Central film in its own scale"),
                (
                    Against::Pressure,
                    "Pressure",
                    "Central pressure in its own scale; below it how far the whole pressure is off, and, dotted, the \
                     least that any pressure of the reduced basis could be: the projection of the full one",
                ),
            ];
            for (option, name, tip) in options {
                ui.selectable_value(&mut self.against, option, name).on_hover_text(tip);
            }
            if self.against == Against::Together {
                let looks = [("central film", palette.film), ("central pressure", palette.pressure)];
                for (name, color) in looks.into_iter().chain([("inputs, dotted", palette.reference)]) {
                    ui.label(egui::RichText::new(name).small().color(palette.ink(color)));
                }
            }
        });
        let (name, quantity, color, title) = match self.against {
            Against::Together => return together(ui, view, height, below),
            Against::Film => ("film", Quantity::CentralFilm, palette.film, "Film {H_c}"),
            Against::Pressure => ("pressure", Quantity::CentralPressure, palette.pressure, "Pressure {P_c}"),
        };
        LinkedPlot { name, quantity, color }.show(ui, view, height, (below, title), false)
    }

    /// How far runs lie from what they are compared with, against time: their central film, or the whole pressure where
    /// that is looked at and a reduced run is there; returns the time that was clicked at.
    pub fn deviation(&self, ui: &mut Ui, view: &TransientRuns, height: f32) -> Option<f64> {
        let known = |run: &Run| run.field_errors.as_ref().is_some_and(|errors| !errors.least.is_empty());
        if self.against != Against::Pressure || !view.runs.iter().any(known) {
            return deviation(ui, view, height);
        }
        let palette = Palette::of(ui);
        let percent = |points: &[(f64, f64)]| -> Vec<PlotPoint> {
            points.iter().map(|(time, off)| PlotPoint::new(*time, (100.0 * off).max(LEAST_OFF).log10())).collect()
        };
        let plot = linked(ui, view, "pressure error", height, ("{T}", "|Δ{P}|/|{P}| / %")).decades_y(rows(height));
        let shown = axes::show(plot, ui, "Pressure error and its least", |plot| {
            for (k, run) in drawn(view) {
                let Some(errors) = &run.field_errors else { continue };
                let (color, width, line_style) = style(view, k, palette.pressure, &palette);
                let own = Line::new(run.name(), PlotPoints::Owned(percent(&errors.own))).id((k, "own"));
                plot.line(own.color(color).width(width).style(line_style).allow_band(false));
                let name = format!("{}: the least that its modes can miss", run.name());
                let least = Line::new(name, PlotPoints::Owned(percent(&errors.least))).id((k, "least"));
                plot.line(least.color(palette.reference).width(1.6).style(LineStyle::dotted_dense()).allow_band(false));
            }
            now(plot, view, &palette)
        });
        shown.inner
    }
}

/// How far runs lie from what they are compared with, against time; returns the time that was clicked at.
pub fn deviation(ui: &mut Ui, view: &TransientRuns, height: f32) -> Option<f64> {
    let known = |run: &Run| run.by != MarchedBy::Full && !run.trajectory.moments.is_empty();
    let known = view.runs.iter().any(known) || view.runs.iter().filter(|run| run.by == MarchedBy::Full).count() > 1;
    if !known || !view.runs.iter().any(|run| run.by == MarchedBy::Full) {
        let waits = "How far each method lies from the full system comes with them";
        ui.add_sized([ui.available_width(), height], egui::Label::new(egui::RichText::new(waits).weak()));
        return None;
    }
    let color = Palette::of(ui).film;
    let plot = LinkedPlot { name: "deviation", quantity: Quantity::CentralFilm, color };
    plot.show(ui, view, height, ("{T}", "|Δ{H_c}| / %"), true)
}

/// Film, pressure and inputs on one axis, in percent of their starts.
fn together(ui: &mut Ui, view: &TransientRuns, height: f32, below: &str) -> Option<f64> {
    let palette = Palette::of(ui);
    let looks = [(Quantity::CentralFilm, palette.film), (Quantity::CentralPressure, palette.pressure)];
    let shown = axes::show(linked(ui, view, "together", height, (below, "Change / %")), ui, TOGETHER, |plot| {
        plot.hline(HLine::new("", 0.0).id("none").color(palette.reference).width(THIN_WIDTH).allow_hover(false));
        let first = view.runs.first();
        for input in Input::ALL {
            let value = |m: &Moment| match input {
                Input::Load => m.input.load,
                Input::Speed => m.input.speed,
                Input::Radius => m.input.radius,
            };
            let moments = first.map_or(&[][..], |run| &run.trajectory.moments);
            let points: Vec<PlotPoint> =
                moments.iter().map(|m| PlotPoint::new(m.time, 100.0 * (value(m) - 1.0))).collect();
            if points.iter().any(|point| point.y.abs() > 1e-9) {
                let line = Line::new(input.name(), PlotPoints::Owned(axes::thinned(points))).color(palette.reference);
                plot.line(line.width(1.6).style(LineStyle::dotted_dense()).allow_band(false));
            }
        }
        for (quantity, color) in looks {
            for (k, run) in drawn(view) {
                let Some(start) = run.trajectory.moments.first().map(|m| m.value(quantity)) else { continue };
                let mut points = values(run, quantity);
                points.iter_mut().for_each(|point| point.y = 100.0 * (point.y / start - 1.0));
                let (color, width, line_style) = style(view, k, color, &palette);
                let of = if quantity == Quantity::CentralFilm { "film" } else { "pressure" };
                let name = format!("{of}, {}", run.name());
                let line = Line::new(name, PlotPoints::Owned(axes::thinned(points))).id((k, quantity as u8));
                plot.line(line.color(color).width(width).style(line_style).allow_band(false));
            }
        }
        now(plot, view, &palette)
    });
    shown.inner
}

/// By which the plot is known.
const TOGETHER: &str = "Film, pressure and inputs against time";

/// A plot over the duration whose axis of time is that of its neighbours.
fn linked<'a>(ui: &Ui, view: &TransientRuns, name: &str, height: f32, titles: (&str, &str)) -> PlotFrame<'a> {
    let duration = view.setup.as_ref().map_or(0.0, |setup| setup.study.duration);
    let group = Id::unique(("transient", view.generation));
    let columns = marks(ui.available_width());
    axes::plot(ui, &format!("transient {name} {}", view.generation), height, titles.0, titles.1)
        .marks_x(columns)
        .marks_y(rows(height))
        .link_axis(group, Vec2b::new(true, false))
        .link_cursor(group, Vec2b::new(true, false))
        .paper_x("{T}")
        .si_x(view.setup.as_ref().map_or(0.0, |setup| 1e6 * setup.time_scale_s()), "{t} / µs")
        .include_x(0.0)
        .include_x(duration)
        .set_margin_fraction(egui::vec2(0.0, 0.08))
        .auto_bounds(Vec2b::TRUE)
}

/// The moment that is looked at as a line; returns the time that was clicked at.
fn now(plot: &mut Canvas<'_, '_>, view: &TransientRuns, palette: &Palette) -> Option<f64> {
    let now = VLine::new("", view.player.time()).id("now").color(palette.accent).width(1.0);
    plot.vline(now.allow_hover(false));
    plot.response().clicked().then(|| plot.pointer_coordinate()).flatten().map(|at| at.x)
}

/// One plot of a quantity against time.
struct LinkedPlot {
    name: &'static str,
    quantity: Quantity,
    color: Color32,
}

impl LinkedPlot {
    /// The quantity of all runs, or how far they lie from what they are compared with, in percent.
    fn show(
        &self,
        ui: &mut Ui,
        view: &TransientRuns,
        height: f32,
        titles: (&str, &str),
        deviation: bool,
    ) -> Option<f64> {
        let palette = Palette::of(ui);
        let first = view.runs.first()?;
        let mut plot = linked(ui, view, self.name, height, titles);
        if let Some(scales) = view.setup.as_ref().map(|setup| Scales::of(&setup.point)).filter(|_| !deviation) {
            plot = match self.quantity {
                Quantity::CentralPressure => plot.si_y(scales.pressure_gpa, "Pressure {p_c} / GPa"),
                _ => plot.si_y(scales.film_um, "Film {h_c} / µm"),
            };
        }
        if deviation {
            plot = plot.decades_y(rows(height));
        }
        let name = match self.name {
            "pressure" => "Central pressure against time",
            "film" => "Central film against time",
            _ => "Deviation between runs",
        };
        let shown = axes::show(plot, ui, name, |plot| {
            if let Some(start) = first.trajectory.moments.first().filter(|_| !deviation) {
                let line = HLine::new("Stationary at T = 0", start.value(self.quantity)).color(palette.reference);
                plot.hline(line.width(THIN_WIDTH).style(LineStyle::dashed_dense()).allow_hover(false));
            }
            for (k, run) in drawn(view) {
                let points = match (deviation, view.reference_of(k)) {
                    (true, None) => continue,
                    (true, Some(reference)) => deviations(run, reference, self.quantity),
                    (false, _) => values(run, self.quantity),
                };
                let (color, width, line_style) = style(view, k, self.color, &palette);
                let line = Line::new(run.name(), PlotPoints::Owned(axes::thinned(points)));
                plot.line(line.color(color).width(width).style(line_style).allow_band(false));
            }
            now(plot, view, &palette)
        });
        shown.inner
    }
}

fn values(run: &Run, quantity: Quantity) -> Vec<PlotPoint> {
    run.trajectory.moments.iter().map(|moment| PlotPoint::new(moment.time, moment.value(quantity))).collect()
}

/// How far a run lies from another, in percent, as powers of ten; nothing where they are equal.
fn deviations(run: &Run, reference: &Run, quantity: Quantity) -> Vec<PlotPoint> {
    let percent = |time: f64, value: f64| {
        let off = 100.0 * (value / reference.trajectory.at(quantity, time)? - 1.0).abs();
        (off > 0.0).then(|| PlotPoint::new(time, off.max(LEAST_OFF).log10()))
    };
    run.trajectory.moments.iter().filter_map(|moment| percent(moment.time, moment.value(quantity))).collect()
}

/// What is less is not told apart, in percent.
const LEAST_OFF: f64 = 1e-6;

/// Marks of an axis of this width that leave their labels room.
pub fn marks(width: f32) -> f64 {
    f64::from((width - 60.0).max(75.0) / 75.0)
}

/// The same for an axis of this height.
pub fn rows(height: f32) -> f64 {
    f64::from((height - 24.0).max(48.0) / 24.0).min(6.0)
}
