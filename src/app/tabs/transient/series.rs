//! Central pressure and film against time, and how far runs lie apart.

use crate::app::tabs::axes;
use crate::app::theme::{Palette, THIN_WIDTH, faded};
use crate::app::transient::{Run, TransientView};
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::{Frame, Interpolation, Quantity};
use crate::solver::reduced::tpwl::Weighting;
use egui::{Color32, Id, Ui, Vec2b};
use egui_plot::{HLine, Line, LineStyle, PlotPoint, PlotPoints, VLine};

/// The line of a run: the frame by dashes; a linearised model broad and pale, the reduced model thick, the full one
/// thin over them, the first of full ones alone thick.
pub fn style(view: &TransientView, k: usize, color: Color32, palette: &Palette) -> (Color32, f32, LineStyle) {
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
pub fn drawn(view: &TransientView) -> impl Iterator<Item = (usize, &Run)> {
    let of = |wanted: fn(MarchedBy) -> bool| view.runs.iter().enumerate().filter(move |(_, run)| wanted(run.by));
    of(|by| matches!(by, MarchedBy::Linearised(_)))
        .chain(of(|by| by == MarchedBy::Reduced))
        .chain(of(|by| by == MarchedBy::Full))
}

/// The plots; returns the time that was clicked at.
pub fn ui(ui: &mut Ui, view: &TransientView, unit: f32) -> Option<f64> {
    let palette = Palette::of(ui);
    let several = view.runs.len() > 1;
    let pressure = LinkedPlot { name: "pressure", quantity: Quantity::CentralPressure, color: palette.pressure };
    let film = LinkedPlot { name: "film", quantity: Quantity::CentralFilm, color: palette.film };
    let mut clicked = pressure.show(ui, view, unit, ("", "Pressure {P_c}"), false);
    clicked = film.show(ui, view, unit, (if several { "" } else { "{T}" }, "Film {H_c}"), false).or(clicked);
    if several {
        let titles = ("{T}", "Δ{H_c} / %");
        let deviation = LinkedPlot { name: "deviation", ..film };
        clicked = deviation.show(ui, view, 0.7 * unit, titles, true).or(clicked);
    }
    clicked
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
        view: &TransientView,
        height: f32,
        titles: (&str, &str),
        deviation: bool,
    ) -> Option<f64> {
        let palette = Palette::of(ui);
        let first = view.runs.first()?;
        let duration = view.setup.as_ref().map_or(0.0, |setup| setup.study.duration);
        let group = Id::unique(("transient", view.generation));
        let id = format!("transient {} {}", self.name, view.generation);
        let marks = super::marks(ui.available_width());
        let plot = axes::plot(ui, &id, height, titles.0, titles.1)
            .x_grid_spacer(move |input| axes::round_marks(input, marks))
            .y_grid_spacer(move |input| axes::round_marks(input, super::rows(height)))
            .link_axis(group, Vec2b::new(true, false))
            .link_cursor(group, Vec2b::new(true, false))
            .include_x(0.0)
            .include_x(duration)
            .set_margin_fraction(egui::vec2(0.0, 0.08))
            .auto_bounds(Vec2b::TRUE);
        let name = match self.name {
            "pressure" => "Central pressure against time",
            "film" => "Central film against time",
            _ => "Deviation between runs",
        };
        let shown = axes::show(plot, ui, name, |plot| {
            if deviation {
                plot.hline(
                    HLine::new("", 0.0).id("none").color(palette.reference).width(THIN_WIDTH).allow_hover(false),
                );
            } else if let Some(start) = first.trajectory.moments.first() {
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
            let now = VLine::new("", view.player.time()).id("now").color(palette.accent).width(1.0);
            plot.vline(now.allow_hover(false));
            plot.response().clicked().then(|| plot.pointer_coordinate()).flatten()
        });
        shown.inner.map(|at| at.x)
    }
}

fn values(run: &Run, quantity: Quantity) -> Vec<PlotPoint> {
    run.trajectory.moments.iter().map(|moment| PlotPoint::new(moment.time, moment.value(quantity))).collect()
}

fn deviations(run: &Run, reference: &Run, quantity: Quantity) -> Vec<PlotPoint> {
    let percent = |time: f64, value: f64| {
        Some(PlotPoint::new(time, 100.0 * (value / reference.trajectory.at(quantity, time)? - 1.0)))
    };
    run.trajectory.moments.iter().filter_map(|moment| percent(moment.time, moment.value(quantity))).collect()
}
