//! Charts of a training: the position of its full solutions, and the indicators of the bad approximations that led
//! to them.

use super::chart::Chart;
use super::trainings::Training;
use crate::app::context::Context;
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::theme::{Palette, faded};
use crate::solver::training::Plan;
use egui::{Color32, RichText, Ui};
use egui_plot::{GridInput, GridMark, HLine, Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points};

/// Width of the axis numbers, so that both charts are equally wide.
const AXIS_WIDTH: f32 = 44.0;

/// Keeps only marks at whole numbers.
fn whole(marks: Vec<GridMark>) -> Vec<GridMark> {
    marks.into_iter().filter(|mark| mark.value.fract() == 0.0).collect()
}

/// Returns decades with enough space for their labels.
fn legible(input: GridInput, height: f32) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let stride = (34.0 * (high - low) / f64::from((height - 50.0).max(34.0))).ceil().max(1.0);
    let kept = axes::few_decade_marks(input, 8.0).into_iter().filter(|mark| mark.value % stride == 0.0);
    kept.map(|mark| GridMark { step_size: stride, ..mark }).collect()
}

/// Draws the key of the charts above them, because the charts have no free corner.
pub fn key(ui: &mut Ui, chart: &Chart) {
    let palette = Palette::of(ui);
    let searched = chart.solved.iter().filter(|dot| dot.searched).count();
    let failed = chart.bad.iter().filter(|bad| bad.indicator.is_none()).count();
    let entries = [
        (palette.reference, "Pre-computed", chart.solved.len() - searched),
        (palette.accent, "Found by the search", searched),
        (palette.warning, "Bad approximations", chart.bad.len() - failed),
        (palette.wrong, "Failed reduced solves", failed),
    ];
    ui.horizontal_wrapped(|ui| {
        for (color, name, count) in entries.into_iter().filter(|entry| entry.2 > 0) {
            ui.label(RichText::new(format!("{name} {count}")).small().color(palette.ink(color)));
        }
    });
}

/// Returns a function that fades colours if the form shows another training.
fn look(ui: &Ui, training: &Training, context: &Context<'_>) -> impl Fn(Color32) -> Color32 + use<> {
    // A running training is always current, whatever the form shows.
    let there = training.job().is_none() && !(training.chart.solved.is_empty() && training.chart.bad.is_empty());
    let of = training.spec.as_ref().filter(|_| there).map(|spec| Owner::Training(spec.clone()));
    let grey = of.is_some_and(|of| drawn::is_grey(ui.ctx(), "training", of, context));
    move |color| if grey { faded(color, 0.4) } else { color }
}

/// Draws the M–L plane: full solutions by their selection, bad approximations, failed reduced solves, the range.
pub fn plane(ui: &mut Ui, training: &Training, context: &Context<'_>, height: f32) {
    let palette = Palette::of(ui);
    let (chart, look) = (&training.chart, look(ui, training, context));
    // Use the range of the running training, otherwise of the training in the form.
    let runs = training.spec.as_deref().filter(|_| training.job().is_some());
    let spec = runs.or_else(|| context.document.training_spec());
    let range = spec.map(|spec| spec.domain()).map(|domain| (domain.m(), domain.l()));
    let group = |searched: bool| -> Vec<PlotPoint> {
        chart.solved.iter().filter(|dot| dot.searched == searched).map(|dot| dot.at.into()).collect()
    };
    let bad = |failed: bool| -> Vec<PlotPoint> {
        chart.bad.iter().filter(|bad| bad.indicator.is_none() == failed).map(|bad| bad.at.into()).collect()
    };
    axes::show(
        axes::plot(ui, "training plane", height, "Load number {M}", "Lubricant number {L}")
            .log_x()
            .y_axis_min_width(AXIS_WIDTH)
            .auto_bounds(egui::Vec2b::TRUE)
            .label_formatter(|hover| {
                let (egui_plot::HoverPosition::NearDataPoint { position: at, .. }
                | egui_plot::HoverPosition::Elsewhere { position: at }) = hover;
                Some(format!("M {}   L {}", numbers::significant(10f64.powf(at.x)), numbers::significant(at.y)))
            }),
        ui,
        "Chart of the training solutions",
        |plot| {
            if let Some((m, (low, high))) = range.filter(|(m, _)| m.0 > 0.0 && m.0 <= m.1 && m.1.is_finite()) {
                let (left, right) = (m.0.log10(), m.1.log10());
                let corners = vec![[left, low], [right, low], [right, high], [left, high], [left, low]];
                let outline = Line::new("Range of M and L", corners).color(faded(palette.accent, 0.8)).width(1.2);
                plot.line(outline.allow_hover(false));
            }
            let dots = |name: &str, points: Vec<PlotPoint>, color, radius: f32| {
                Points::new(name, PlotPoints::Owned(points)).color(look(color)).radius(radius)
            };
            plot.points(dots("Pre-computed", group(false), palette.reference, 2.8));
            let (searched, found, failed) = (group(true), bad(false), bad(true));
            if !searched.is_empty() {
                plot.points(dots("Found by the search", searched, palette.accent, 3.4));
            }
            if !found.is_empty() {
                let rings = dots("Bad approximation", found, palette.warning, 6.0).filled(false);
                plot.points(rings.shape(MarkerShape::Circle).allow_hover(false));
            }
            if !failed.is_empty() {
                let crosses = dots("Reduced solve failed", failed, palette.wrong, 6.0).shape(MarkerShape::Cross);
                plot.points(crosses.allow_hover(false));
            }
            if let Some(last) = chart.solved.last().filter(|_| training.job().is_some()) {
                let ring = dots("", vec![last.at.into()], palette.accent, 8.0).filled(false).id("newest");
                plot.points(ring.shape(MarkerShape::Circle).allow_hover(false));
            }
        },
    );
}

/// Draws the indicator of every bad approximation against the number of full solutions when it was found.
/// Tolerances are lines.
pub fn indicator(ui: &mut Ui, training: &Training, context: &Context<'_>, height: f32) {
    let palette = Palette::of(ui);
    let (chart, look) = (&training.chart, look(ui, training, context));
    let tolerances: &[f64] = match training.spec.as_deref().map(|spec| &spec.plan) {
        Some(Plan::Adaptive { tolerances, .. }) => tolerances,
        Some(Plan::WorstOfPool { tolerance, .. }) => std::slice::from_ref(tolerance),
        _ => &[],
    };
    let known: Vec<[f64; 2]> = chart
        .bad
        .iter()
        .filter_map(|bad| bad.indicator.filter(|value| *value > 0.0).map(|v| [bad.solutions as f64, v.log10()]))
        .collect();
    // Failed solves have no indicator. They are drawn above all others.
    let top = known.iter().map(|p| p[1]).chain(tolerances.iter().map(|t| t.log10())).fold(f64::MIN, f64::max);
    let failed: Vec<[f64; 2]> =
        chart.bad.iter().filter(|bad| bad.indicator.is_none()).map(|bad| [bad.solutions as f64, top + 0.5]).collect();
    let solved = chart.solved.len() as f64;
    axes::show(
        axes::plot(ui, "training indicator", height, "Full solutions", "Indicator")
            .x_grid_spacer(|input| whole(axes::round_marks(input, 6.0)))
            .y_axis_min_width(AXIS_WIDTH)
            .decades_y_at(move |input| legible(input, height))
            .auto_bounds(egui::Vec2b::TRUE),
        ui,
        "Indicator against full solutions",
        |plot| {
            for tolerance in tolerances {
                let line = HLine::new(format!("Tolerance {tolerance:e}"), tolerance.log10());
                plot.hline(line.color(palette.quiet).width(1.0).style(LineStyle::dashed_dense()));
            }
            let now = Points::new("", vec![[solved, top]]).id("now").radius(0.1).allow_hover(false);
            plot.points(now.color(egui::Color32::TRANSPARENT));
            plot.points(Points::new("Bad approximation", known).color(look(palette.warning)).radius(3.0));
            if !failed.is_empty() {
                let crosses = Points::new("Reduced solve failed", failed).color(look(palette.wrong)).radius(5.0);
                plot.points(crosses.shape(MarkerShape::Cross));
            }
        },
    );
}
