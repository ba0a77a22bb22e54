//! The model that was made beside the one before it.

use crate::app::context::Context;
use crate::app::controls::warning_ui;
use crate::app::numbers;
use crate::app::theme::rich;
use crate::app::training::comparison::{ModelScore, POINTS};
use egui::{Grid, Ui};

/// A row: its name, what it is, and what one model has there.
type Row = (&'static str, &'static str, fn(&ModelScore) -> String);

/// The table, when there is one.
pub fn ui(ui: &mut Ui, context: &Context<'_>) {
    let Some(comparison) = context.training.comparison.as_ref().filter(|comparison| comparison.done()) else { return };
    ui.add_space(4.0);
    ui.strong("Compared with the model before");
    ui.weak(format!(
        "{POINTS} random points of the trained range; errors against full solutions on each model’s own grid"
    ))
    .on_hover_text("Uniform random numbers in the range (3.17)");
    let unknown = comparison.scores.iter().map(|score| score.value("full_failures")).fold(0.0, f64::max);
    if unknown > 0.0 {
        warning_ui(ui, &format!("At {unknown} points there is no full solution and so no error"));
    }
    let errors = "Relative to the full solution";
    let rows: [Row; 12] = [
        ("Full solutions", "All windows", |s| {
            s.model.windows.iter().map(|window| window.snapshots.len()).sum::<usize>().to_string()
        }),
        ("Pressure modes", "Largest window", |s| s.largest(|window| window.pressure.modes.ncols()).to_string()),
        ("Sampled rows", "Largest window", |s| s.largest(|window| window.sampled_rows.len()).to_string()),
        ("Online median", "Time of a reduced solve, beside whatever else runs", |s| {
            numbers::duration(s.value("median_s"))
        }),
        ("Not trained for", "Points outside the range it declares", |s| s.value("untrained").to_string()),
        ("Failures", "Reduced solves without convergence", |s| s.value("failures").to_string()),
        ("Error of {H_c}, median", errors, |s| numbers::error_percent(s.value("H_c_error_median"))),
        ("Error of {H_c}, 95 %", errors, |s| numbers::error_percent(s.value("H_c_error_p95"))),
        ("Error of {H_c}, largest", errors, |s| numbers::error_percent(s.value("H_c_error_max"))),
        ("Error of {H_min}, median", errors, |s| numbers::error_percent(s.value("H_min_error_median"))),
        ("Error of {H_min}, 95 %", errors, |s| numbers::error_percent(s.value("H_min_error_p95"))),
        ("Error of {H_min}, largest", errors, |s| numbers::error_percent(s.value("H_min_error_max"))),
    ];
    Grid::new("model comparison").num_columns(3).min_row_height(16.0).striped(true).spacing([18.0, 3.0]).show(
        ui,
        |ui| {
            ui.weak("");
            for (name, score) in ["Before", "New"].into_iter().zip(&comparison.scores) {
                ui.strong(name).on_hover_text(&score.model.title);
            }
            ui.end_row();
            for (name, tip, value) in rows {
                ui.label(rich(name, 13.5, ui.visuals().text_color())).on_hover_text(tip);
                for score in &comparison.scores {
                    ui.label(value(score));
                }
                ui.end_row();
            }
        },
    );
}
