//! View of the convergence of the last full solve.

use crate::app::answers::jobs::Running;
use crate::app::context::Context;
use crate::app::document::Key;
use crate::app::drawn::{self, Owner};
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::theme::{Palette, rich};
use crate::app::{export, numbers};
use crate::solver::full::Report;
use egui::{Grid, Ui};
use egui_plot::{Line, LineStyle, MarkerShape, Points};

/// Age from which a solve is shown \[s\]. Shorter solves would only flicker.
const NEWS_S: f64 = 0.12;
/// Width of both lines.
const WIDTH: f32 = 1.6;
/// Accessible name of the plot.
const PLOT: &str = "Newton residuals of the last solve";

/// Draws the running solve, otherwise the last one that ended.
pub fn ui(ui: &mut Ui, context: &Context<'_>) {
    let news = |job: &&Running| job.since.elapsed().as_secs_f64() > NEWS_S && !job.steps.is_empty();
    if let Some(job) = context.answers.running().iter().find(news) {
        running_ui(ui, job, context);
        return;
    }
    let Some((key, report)) = context.answers.last_report() else {
        ui.centered_and_justified(|ui| ui.weak("No full solve has finished yet"));
        return;
    };
    let moes = key.point.moes();
    let current = !drawn::is_grey(ui.ctx(), "residuals", Owner::Contact(*key), context);
    ui.horizontal_wrapped(|ui| {
        ui.strong("Last full solve");
        ui.label(format!("{}: {}", numbers::moes(moes), report.termination.describe()));
        if !current {
            ui.weak("(other parameters than the sliders)");
        }
    });
    Grid::new("solve").num_columns(4).spacing([14.0, 3.0]).show(ui, |ui| {
        let cells = [
            ("Newton steps", report.newton_iterations.to_string()),
            ("Krylov steps", report.linear_iterations.to_string()),
            ("Initial guesses", report.attempts.to_string()),
            ("Final residual", numbers::digits(report.residual_norm, 3)),
        ];
        for (name, _) in &cells {
            ui.weak(*name);
        }
        ui.end_row();
        for (_, value) in &cells {
            ui.label(value);
        }
        ui.end_row();
    });
    if let Some(c) = context.answers.comparison().filter(|_| context.answers.picture_follows()) {
        let text = format!("Reduced against full: {}", c.describe());
        ui.label(rich(&text, 13.5, ui.visuals().text_color()));
    }
    residual_plot(ui, &report.residuals, &report.steps, current);
}

/// Returns every Newton step as a row of CSV.
pub fn csv(key: &Key, report: &Report) -> String {
    let moes = key.point.moes();
    let rows = report.residuals.iter().zip(&report.steps).enumerate();
    let rows = rows.map(|(k, (r, s))| vec![Some(k as f64 + 1.0), Some(*r), Some(*s)]);
    let comment = format!("M {:e}; L {:e}; {}", moes.m, moes.l, report.termination.describe());
    export::csv(&[comment], &["newton_step", "residual", "relative_step"], rows)
}

/// Draws a running solve: its parameters and its residuals so far.
fn running_ui(ui: &mut Ui, job: &Running, context: &Context<'_>) {
    let current = !drawn::is_grey(ui.ctx(), "residuals", Owner::Contact(job.key), context);
    ui.horizontal_wrapped(|ui| {
        ui.strong(job.kind.name());
        ui.label(format!("{}: running", numbers::contact(&job.key.point)));
        if let Some(step) = job.steps.last() {
            ui.weak(format!("Newton step {}, residual {}", step.iteration, numbers::digits(step.residual, 3)));
        }
    });
    let (residuals, steps): (Vec<f64>, Vec<f64>) = job.steps.iter().map(|s| (s.residual, s.step)).unzip();
    residual_plot(ui, &residuals, &steps, current);
}

fn residual_plot(ui: &mut Ui, residuals: &[f64], steps: &[f64], current: bool) {
    let palette = Palette::of(ui);
    let log = |values: &[f64]| -> Vec<[f64; 2]> {
        values
            .iter()
            .enumerate()
            .filter(|(_, v)| **v > 0.0 && v.is_finite())
            .map(|(k, v)| [k as f64 + 1.0, v.log10()])
            .collect()
    };
    let grey = |color| if current { color } else { palette.reference };
    let series = [
        ("Residual", residuals, grey(palette.accent), LineStyle::Solid),
        ("Relative step", steps, palette.reference, LineStyle::dashed_dense()),
    ];
    let entries = series.map(|(name, _, color, style)| Entry::new(name, color, Sample::of_line(style, WIDTH)));
    let height = (ui.available_height() - 4.0).max(120.0);
    key::over(ui, height, entries, |ui, height| {
        let plot = axes::plot(ui, "residuals", height, "Newton step", "Residual, relative step")
            .decades_y(8.0)
            .auto_bounds(egui::Vec2b::TRUE);
        axes::show(plot, ui, PLOT, |plot| {
            for (name, values, color, style) in series {
                let points = log(values);
                plot.line(Line::new(name, points.clone()).color(color).width(WIDTH).style(style));
                plot.points(
                    Points::new(name, points).color(color).radius(3.0).shape(MarkerShape::Circle).id((name, 1)),
                );
            }
        });
    });
}
