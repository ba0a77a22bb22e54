//! Table of the runs, which is also the key of the plots: values at the displayed time, error against the
//! reference, computing time.

use super::runs::TransientRuns;
use crate::app::numbers;
use crate::app::plot::key::Sample;
use crate::app::tabs::transient::shared::faster;
use crate::app::tabs::transient::{Run, series};
use crate::app::theme::{Palette, rich};
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::Quantity;
use egui::{Grid, Ui};

/// Width below which the table omits columns that the plots show.
const WIDE: f32 = 590.0;

/// Returns the height of the table.
pub fn height(view: &TransientRuns) -> f32 {
    18.0 * (view.setup.as_ref().map_or(0, |setup| setup.runs()).max(view.runs.len()) + 1) as f32
}

/// Draws the table.
pub fn ui(ui: &mut Ui, view: &TransientRuns) {
    let wide = ui.available_width() >= WIDE;
    let quiet = Palette::of(ui).quiet;
    let title = |ui: &mut Ui, text: &str, tip: &str| {
        ui.label(rich(text, 12.0, quiet)).on_hover_text(tip);
    };
    Grid::new(("transient cost", wide)).min_col_width(0.0).spacing([12.0, 2.0]).min_row_height(15.0).show(ui, |ui| {
        title(ui, "", "");
        title(ui, "", "");
        if wide {
            title(ui, "{H_c}", "Central film thickness at the displayed time");
            title(ui, "{P_c}", "Central pressure at the displayed time");
        }
        let tip = "Mean over the scene’s window, otherwise over the second half of the duration, relative to the \
                   steady start";
        title(ui, "Mean {H_c}", tip);
        let tip = "Maximum relative difference of {H_c}: of a frame from the first run, of a model from the full \
                   system in its frame";
        title(ui, "Δ{H_c}", &tip.replace(['{', '}'], ""));
        if wide {
            title(ui, "Steps", "Steps taken, and those discarded");
            title(ui, "Step error", "Estimated maximum relative error of H_c due to the time steps");
        }
        title(ui, "Per step", "Median of the time per step");
        title(ui, "Total", "Time of the whole run");
        ui.end_row();
        for (k, run) in view.runs.iter().enumerate() {
            row(ui, view, k, run, wide);
            ui.end_row();
        }
    });
}

fn row(ui: &mut Ui, view: &TransientRuns, k: usize, run: &Run, wide: bool) {
    let none = || "–".to_owned();
    sample(ui, view, k);
    let name = ui.label(run.name());
    if let Some(model) = run.model {
        let trained = numbers::duration(model.training_s);
        let (modes, chosen, what) = (model.modes, model.chosen, model.what);
        name.on_hover_text(format!("{modes} pressure modes, {chosen} {what}, trained in {trained}"));
    }
    if wide {
        let value = |quantity| run.trajectory.at(quantity, view.player.time()).map_or_else(none, numbers::significant);
        ui.label(value(Quantity::CentralFilm));
        ui.label(value(Quantity::CentralPressure));
    }
    let percent = |offset: f64| format!("{offset:+.2}{}%", numbers::THIN).replace('-', "−");
    ui.label(offset(run, view).map_or_else(none, percent));
    ui.label(run.difference.map_or_else(none, numbers::error_percent));
    if wide {
        let rejected = run.trajectory.rejected_steps;
        let discarded = if rejected > 0 { format!(" + {rejected}") } else { String::new() };
        ui.label(format!("{}{discarded}", run.trajectory.moments.len().saturating_sub(1)));
        ui.label(run.trajectory.step_error.map_or_else(none, numbers::error_percent));
    }
    let full = view.reference_of(k).filter(|_| run.by != MarchedBy::Full).and_then(Run::seconds_per_step);
    let per_step = run.seconds_per_step().map(|seconds| {
        let faster = full.map_or_else(String::new, |full| faster(full / seconds));
        format!("{}{faster}", numbers::duration(seconds))
    });
    ui.label(per_step.unwrap_or_else(none));
    ui.label(numbers::duration(run.seconds.iter().sum()));
}

/// Draws a sample of the run's line.
fn sample(ui: &mut Ui, view: &TransientRuns, k: usize) {
    let palette = Palette::of(ui);
    let (color, width, style) = series::style(view, k, palette.film, &palette);
    Sample::of_line(style, width).ui(ui, color);
}

/// Returns the mean of H_c over the window relative to its initial steady value, minus 1, in percent.
fn offset(run: &Run, view: &TransientRuns) -> Option<f64> {
    let study = &view.setup.as_ref()?.study;
    let window = study.window.unwrap_or((0.5 * study.duration, study.duration));
    let mean = run.trajectory.mean(Quantity::CentralFilm, window)?;
    Some(100.0 * (mean / run.trajectory.moments.first()?.h_c - 1.0))
}
