//! Plots against time: central pressure, central film thickness, and differences between runs.

use super::runs::TransientRuns;
use crate::app::document::input::Input;
use crate::app::figure::Canvas;
use crate::app::plot::axes;
use crate::app::plot::frame::PlotFrame;
use crate::app::tabs::transient::Run;
use crate::app::theme::{Palette, THIN_WIDTH, faded};
use crate::app::units::{self, Scale, Scales};
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::{Frame, Interpolation, Moment, Quantity};
use crate::solver::physics::engineering::QuantityKind;
use crate::solver::reduced::tpwl::Weighting;
use egui::{Color32, Id, Ui, Vec2b};
use egui_plot::{HLine, Line, LineStyle, PlotPoint, PlotPoints, VLine};

/// Returns the line style of a run. Dashes distinguish the frames. Lines of linearised models are broad and pale,
/// of reduced models thick, and of full runs thin and on top. If there are only full runs, the first one is thick.
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

/// Returns the runs in the order of drawing, thick lines first, so that thin lines stay visible.
pub fn drawn(view: &TransientRuns) -> impl Iterator<Item = (usize, &Run)> {
    let of = |wanted: fn(MarchedBy) -> bool| view.runs.iter().enumerate().filter(move |(_, run)| wanted(run.by));
    of(|by| matches!(by, MarchedBy::Linearised(_)))
        .chain(of(|by| by == MarchedBy::Reduced))
        .chain(of(|by| by == MarchedBy::Full))
}

/// Quantity of the plot against time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Against {
    /// Film thickness, pressure and load, each relative to its initial steady value.
    #[default]
    Together,
    /// H_c.
    Film,
    /// P_c.
    Pressure,
    /// Load share of asperities; for rough surfaces only.
    Asperities,
}

/// Plot against time.
#[derive(Default)]
pub struct Along {
    against: Against,
}

impl Along {
    /// Draws the plot with its choices. `above` is true if another plot with the same axis is below it. Returns the
    /// time of a click.
    pub fn ui(&mut self, ui: &mut Ui, view: &TransientRuns, height: f32, above: bool) -> Option<f64> {
        let below = if above { "" } else { "{T}" };
        let palette = Palette::of(ui);
        let rough = view.setup.as_ref().is_some_and(|setup| setup.lubricant.is_rough());
        if self.against == Against::Asperities && !rough {
            self.against = Against::Together;
        }
        ui.horizontal_wrapped(|ui| {
            let asperities = (Against::Asperities, "Asperities", "Share of the load that asperities carry");
            let options = [
                (
                    Against::Together,
                    "Together",
                    "Central film thickness, central pressure and the inputs, relative to the start",
                ),
                (Against::Film, "Film", "Central film thickness"),
                (
                    Against::Pressure,
                    "Pressure",
                    "Central pressure, with the error of the whole pressure below. Dotted: the smallest error that the \
                     reduced basis permits, that of the projected full pressure",
                ),
            ];
            for (option, name, tip) in options.into_iter().chain(rough.then_some(asperities)) {
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
            Against::Asperities => ("asperities", Quantity::AsperityLoadShare, palette.traction, "Asperity load share"),
        };
        LinkedPlot { name, quantity, color }.show(ui, view, height, (below, title), false)
    }

    /// Draws the differences of the runs from their references against time: of the central film thickness, or of
    /// the whole pressure if pressure is chosen and there is a reduced run. Returns the time of a click.
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
                let name = format!("{}: projection error", run.name());
                let least = Line::new(name, PlotPoints::Owned(percent(&errors.least))).id((k, "least"));
                plot.line(least.color(palette.reference).width(1.6).style(LineStyle::dotted_dense()).allow_band(false));
            }
            now(plot, view, &palette)
        });
        shown.inner
    }
}

/// Draws the differences of the central film thickness from the references against time. Returns the time of a
/// click.
pub fn deviation(ui: &mut Ui, view: &TransientRuns, height: f32) -> Option<f64> {
    let known = |run: &Run| run.by != MarchedBy::Full && !run.trajectory.moments.is_empty();
    let known = view.runs.iter().any(known) || view.runs.iter().filter(|run| run.by == MarchedBy::Full).count() > 1;
    if !known || !view.runs.iter().any(|run| run.by == MarchedBy::Full) {
        let waits = "The differences from the full system appear with the runs";
        ui.add_sized([ui.available_width(), height], egui::Label::new(egui::RichText::new(waits).weak()));
        return None;
    }
    let color = Palette::of(ui).film;
    let plot = LinkedPlot { name: "deviation", quantity: Quantity::CentralFilm, color };
    plot.show(ui, view, height, ("{T}", "|Δ{H_c}| / %"), true)
}

/// Draws film thickness, pressure and inputs on one axis, in percent of their initial values.
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

/// Accessible name of the plot.
const TOGETHER: &str = "Film, pressure and inputs against time";

/// Returns a plot over the duration with the same time axis as its neighbours.
fn linked<'a>(ui: &Ui, view: &TransientRuns, name: &str, height: f32, titles: (&str, &str)) -> PlotFrame<'a> {
    let duration = view.setup.as_ref().map_or(0.0, |setup| setup.study.duration);
    let group = Id::unique(("transient", view.generation));
    let columns = marks(ui.available_width());
    let system = units::system(ui.ctx());
    let time = view.setup.as_ref().map(|setup| Scale::of(QuantityKind::TransitTime, system, setup.time_scale_s()));
    axes::plot(ui, &format!("transient {name} {}", view.generation), height, titles.0, titles.1)
        .marks_x(columns)
        .marks_y(rows(height))
        .link_axis(group, Vec2b::new(true, false))
        .link_cursor(group, Vec2b::new(true, false))
        .paper_x("{T}")
        .units_x(time, "{t}")
        .include_x(0.0)
        .include_x(duration)
        .set_margin_fraction(egui::vec2(0.0, 0.08))
        .auto_bounds(Vec2b::TRUE)
}

/// Draws the displayed time as a line. Returns the time of a click.
fn now(plot: &mut Canvas<'_, '_>, view: &TransientRuns, palette: &Palette) -> Option<f64> {
    let now = VLine::new("", view.player.time()).id("now").color(palette.accent).width(1.0);
    plot.vline(now.allow_hover(false));
    plot.response().clicked().then(|| plot.pointer_coordinate()).flatten().map(|at| at.x)
}

/// Plot of a quantity against time.
struct LinkedPlot {
    name: &'static str,
    quantity: Quantity,
    color: Color32,
}

impl LinkedPlot {
    /// Draws the quantity of all runs, or their differences from the references in percent.
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
        let system = units::system(ui.ctx());
        if let Some(scales) = view.setup.as_ref().map(|setup| Scales::of(&setup.point, system)).filter(|_| !deviation) {
            plot = match self.quantity {
                Quantity::CentralPressure => plot.units_y(scales.pressure, "Pressure {p_c}"),
                Quantity::AsperityLoadShare => plot,
                _ => plot.units_y(scales.film, "Film {h_c}"),
            };
        }
        if deviation {
            plot = plot.decades_y(rows(height));
        }
        let name = match self.name {
            "pressure" => "Central pressure against time",
            "film" => "Central film against time",
            "asperities" => "Asperity load share against time",
            _ => "Deviation between runs",
        };
        let shown = axes::show(plot, ui, name, |plot| {
            if let Some(start) = first.trajectory.moments.first().filter(|_| !deviation) {
                let line = HLine::new("Steady at T = 0", start.value(self.quantity)).color(palette.reference);
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

/// Returns the differences of a run from another in percent, as powers of ten. Equal values are omitted.
fn deviations(run: &Run, reference: &Run, quantity: Quantity) -> Vec<PlotPoint> {
    let percent = |time: f64, value: f64| {
        let off = 100.0 * (value / reference.trajectory.at(quantity, time)? - 1.0).abs();
        (off > 0.0).then(|| PlotPoint::new(time, off.max(LEAST_OFF).log10()))
    };
    run.trajectory.moments.iter().filter_map(|moment| percent(moment.time, moment.value(quantity))).collect()
}

/// Smallest displayed difference in percent.
const LEAST_OFF: f64 = 1e-6;

/// Returns the number of marks on a horizontal axis of this width.
pub fn marks(width: f32) -> f64 {
    f64::from((width - 60.0).max(75.0) / 75.0)
}

/// Returns the number of marks on a vertical axis of this height.
pub fn rows(height: f32) -> f64 {
    f64::from((height - 24.0).max(48.0) / 24.0).min(6.0)
}
