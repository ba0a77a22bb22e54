//! Error against the number of operating points for both rules and both weightings.

use super::shown::ShownModel;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::tabs::transient::linearised::NumberRow;
use crate::app::tabs::transient::method::{RULES, WEIGHTINGS, rule_name, weighting_name};
use crate::app::theme::rich;
use crate::solver::full::transient::Quantity;
use egui::{Color32, RichText, Ui};
use egui_plot::{Line, LineStyle, MarkerShape, PlotPoint, PlotPoints, Points, VLine};

/// Text size above the plot.
const SIZE: f32 = 11.0;

/// Draws the plot with logarithmic axes.
pub fn ui(ui: &mut Ui, shown: &ShownModel<'_>, height: f32) {
    let study = &shown.view.number;
    let head = ui.horizontal(|ui| {
        if study.rows.is_empty() {
            ui.label(rich("Error vs. number of points: being computed", 12.5, shown.palette.quiet));
            return;
        }
        ui.spacing_mut().item_spacing.x = 5.0;
        let line = |name, sample| Entry::new(name, shown.palette.quiet, sample);
        let rules = [line("distance", Sample::Line(1.6)), line("missed step", Sample::Dashed(1.6))];
        key::entries_ui(ui, rules, SIZE);
        for (k, name) in ["dual Taylor", "exponential"].into_iter().enumerate() {
            let meaning = weighting_name(WEIGHTINGS[k]).1;
            let ink = shown.palette.ink(shown.color(k));
            ui.label(RichText::new(name).size(SIZE).color(ink)).on_hover_text(meaning);
        }
    });
    head.response.on_hover_text(
        "Relative L2 difference of H_c from the full run: solid for points chosen by distance, dashed by missed steps, \
         for a sequence of tolerances. The dotted line and the diamond are the model in use",
    );
    if study.rows.is_empty() {
        return;
    }
    let curve = |rule: &str, weighting| -> Vec<PlotPoint> {
        let own = |row: &&NumberRow| row.selection.name() == rule && row.weighting == weighting;
        let place = |row: &NumberRow| Some(PlotPoint::new((row.points as f64).log10(), row.difference?.log10()));
        study.rows.iter().filter(own).filter_map(place).filter(|place| place.y.is_finite()).collect()
    };
    let mut lines = Vec::new();
    for (rule, style, shape) in
        [(RULES[0], LineStyle::Solid, MarkerShape::Circle), (RULES[1], LineStyle::dashed_dense(), MarkerShape::Square)]
    {
        for (k, &weighting) in WEIGHTINGS.iter().enumerate() {
            let name = format!("{}, {}", rule_name(rule).0, weighting_name(weighting).0);
            lines.push((name, curve(rule.name(), weighting), style, shape, shown.color(k)));
        }
    }
    let present = shown.runs.iter().filter_map(|(weighting, run)| {
        let full = shown.view.reference_of_linearised()?;
        let whole = (0.0, run.reached());
        let (_, l2) = run.trajectory.difference(&full.trajectory, Quantity::CentralFilm, whole)?;
        let color = WEIGHTINGS.iter().position(|own| own == weighting).map(|k| shown.color(k))?;
        Some((PlotPoint::new((shown.linearised.model.points.len() as f64).log10(), l2.log10()), color))
    });
    let present: Vec<(PlotPoint, Color32)> = present.filter(|(place, _)| place.y.is_finite()).collect();
    let used = (shown.linearised.model.points.len().max(1) as f64).log10();
    let reference = shown.palette.reference;
    let id = format!("tpwl number {}", shown.view.generation);
    let plot = axes::plot(ui, &id, height - 22.0, "Operating points", "Error of {H_c}")
        .log_x()
        .decades_y(8.0)
        .set_margin_fraction(egui::vec2(0.05, 0.1))
        .auto_bounds(egui::Vec2b::TRUE);
    axes::show(plot, ui, "Error against the number of operating points", move |plot| {
        let line = VLine::new("", used).id("in use").color(reference).width(1.0).style(LineStyle::dotted_dense());
        plot.vline(line.allow_hover(false));
        for (k, (name, points, style, shape, color)) in lines.into_iter().enumerate() {
            let dots = Points::new(name.clone(), PlotPoints::Owned(points.clone())).id(("dots", k)).shape(shape);
            plot.line(Line::new(name, PlotPoints::Owned(points)).id(("line", k)).color(color).style(style).width(1.6));
            plot.points(dots.color(color).radius(3.2).allow_hover(false));
        }
        for (k, (place, color)) in present.into_iter().enumerate() {
            let mark = Points::new("In use", PlotPoints::Owned(vec![place])).id(("present", k));
            plot.points(mark.shape(MarkerShape::Diamond).color(color).radius(7.0).allow_hover(false));
        }
    });
}
