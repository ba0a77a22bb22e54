//! The model that was made beside the one before it.

use crate::app::numbers;
use crate::app::state::State;
use crate::app::training::COMPARED_POINTS;
use crate::harness::ModelScore;
use egui::{Grid, Ui};

/// A row: its name, what it is, and what one model has there.
type Row = (&'static str, &'static str, fn(&ModelScore) -> String);

/// The table, when there is one.
pub fn ui(ui: &mut Ui, state: &State) {
    let Some(comparison) = &state.training.comparison else { return };
    ui.add_space(4.0);
    ui.strong("Compared with the model before");
    ui.weak(format!(
        "{} of {COMPARED_POINTS} random points of the trained range (3.17), each model against full solutions on its own grid",
        comparison.points
    ));
    let errors = "Relative to the full solution";
    let rows: [Row; 14] = [
        ("Full solutions", "All windows", |s| s.solutions.to_string()),
        ("Pressure modes", "Largest window", |s| s.modes.to_string()),
        ("Sampled rows", "Largest window", |s| s.rows.to_string()),
        ("Online median", "Time of a reduced solve, beside whatever else runs", |s| {
            numbers::duration(s.online_median_s)
        }),
        ("Not trained for", "Points outside the range it declares", |s| s.untrained.to_string()),
        ("Failures", "Reduced solves without convergence", |s| s.failures.to_string()),
        ("Full failures", "Full solves without convergence: no error is known there", |s| s.full_failures.to_string()),
        ("Error of H_c, median", errors, |s| numbers::error_percent(s.h_c.median)),
        ("Error of H_c, 95 %", errors, |s| numbers::error_percent(s.h_c.p95)),
        ("Error of H_c, largest", errors, |s| numbers::error_percent(s.h_c.max)),
        ("Error of H_min, median", errors, |s| numbers::error_percent(s.h_min.median)),
        ("Error of H_min, 95 %", errors, |s| numbers::error_percent(s.h_min.p95)),
        ("Error of H_min, largest", errors, |s| numbers::error_percent(s.h_min.max)),
        ("Title", "What the model is called", |s| s.title.clone()),
    ];
    Grid::new("model comparison").num_columns(3).striped(true).spacing([18.0, 3.0]).show(ui, |ui| {
        ui.weak("");
        for name in ["Before", "New"].iter().take(comparison.scores.len()) {
            ui.strong(*name);
        }
        ui.end_row();
        for (name, tip, value) in rows {
            ui.label(name).on_hover_text(tip);
            for score in &comparison.scores {
                ui.label(value(score));
            }
            ui.end_row();
        }
    });
}
