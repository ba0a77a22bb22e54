//! View of the comparison of models.

use super::trainings::Training;
use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::{sentence, warning_ui};
use crate::app::numbers;
use crate::app::plot::axes;
use crate::app::plot::key::{self, Entry, Sample};
use crate::app::tabs::training::comparison::{ModelScore, POINTS};
use crate::app::theme::{Palette, rich};
use egui::{Grid, Ui};
use egui_plot::{Line, PlotPoints};

/// Row: its name, its tooltip, and the text for one model.
type Row = (&'static str, &'static str, fn(&ModelScore) -> String);

/// Height of the distributions of errors.
const HEIGHT: f32 = 200.0;

/// Draws table and distributions of errors if the comparison is complete.
pub fn ui(ui: &mut Ui, training: &Training, commands: &mut Commands) {
    let Some(comparison) = training.comparison.as_ref().filter(|comparison| comparison.done()) else { return };
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        ui.strong("Models compared");
        let tip = "The errors of each model at every contact";
        if ui.button("Export comparison…").on_hover_text(tip).clicked() {
            commands.push(Command::csv(comparison.csv()));
        }
    });
    ui.weak(format!(
        "{POINTS} random points of the range of “{}”; errors against full solutions on each model’s own grid",
        comparison.range_of
    ))
    .on_hover_text("Uniform random numbers in the range (3.17)");
    let unknown = comparison.scores.iter().map(|score| score.value("full_failures")).fold(0.0, f64::max);
    if unknown > 0.0 {
        warning_ui(ui, &format!("At {unknown} contacts there is no full solution and therefore no error"));
    }
    let errors = "Relative to the full solution";
    let rows: [Row; 12] = [
        ("Full solutions", "All local models", |s| {
            s.model.windows.iter().map(|window| window.snapshots.len()).sum::<usize>().to_string()
        }),
        ("Pressure modes", "Largest local model", |s| s.largest(|window| window.pressure.count()).to_string()),
        ("Sampled equations", "Largest local model", |s| s.largest(|window| window.sampled_rows.len()).to_string()),
        ("Online median", "Time of a reduced solve while other jobs may run", |s| {
            numbers::duration(s.value("median_s"))
        }),
        ("Outside the range", "Contacts outside its trained range", |s| s.value("untrained").to_string()),
        ("Failures", "Reduced solves without convergence", |s| s.value("failures").to_string()),
        ("Error of {H_c}, median", errors, |s| numbers::error_percent(s.value("H_c_error_median"))),
        ("Error of {H_c}, 95 %", errors, |s| numbers::error_percent(s.value("H_c_error_p95"))),
        ("Error of {H_c}, maximum", errors, |s| numbers::error_percent(s.value("H_c_error_max"))),
        ("Error of {H_min}, median", errors, |s| numbers::error_percent(s.value("H_min_error_median"))),
        ("Error of {H_min}, 95 %", errors, |s| numbers::error_percent(s.value("H_min_error_p95"))),
        ("Error of {H_min}, maximum", errors, |s| numbers::error_percent(s.value("H_min_error_max"))),
    ];
    Grid::new("model comparison")
        .num_columns(1 + comparison.scores.len())
        .min_row_height(16.0)
        .striped(true)
        .spacing([18.0, 3.0])
        .show(ui, |ui| {
            ui.weak("");
            for score in &comparison.scores {
                ui.strong(sentence(&score.name).trim_end_matches('.')).on_hover_text(&score.model.title);
            }
            ui.end_row();
            for (name, tip, value) in rows {
                ui.label(rich(name, 13.5, ui.visuals().text_color())).on_hover_text(tip);
                for score in &comparison.scores {
                    ui.label(value(score));
                }
                ui.end_row();
            }
        });
    distributions(ui, &comparison.scores);
}

/// Draws the share of contacts whose error does not exceed a value, for each model.
fn distributions(ui: &mut Ui, scores: &[ModelScore]) {
    let palette = Palette::of(ui);
    let hues =
        [palette.reference, palette.film, palette.pressure, palette.deformation, palette.accent, palette.warning];
    let hue = |k: usize| hues[k % hues.len()];
    let entries =
        scores.iter().enumerate().map(|(k, score)| Entry::new(score.name.as_str(), hue(k), Sample::Line(2.0)));
    let name = "Distribution of errors";
    key::over(ui, HEIGHT, entries, |ui, height| {
        let plot =
            axes::plot(ui, "errors of models", height, "Relative error of {H_c}", "Contacts up to this error / %")
                .decades_x(8.0)
                .include_y(0.0)
                .include_y(100.0);
        axes::show(plot, ui, name, |plot| {
            for (k, score) in scores.iter().enumerate() {
                let errors = score.errors();
                let share = 100.0 / errors.len().max(1) as f64;
                let points = errors.iter().enumerate().filter(|(_, error)| **error > 0.0);
                let points: PlotPoints<'_> = points.map(|(n, error)| [error.log10(), share * (n + 1) as f64]).collect();
                plot.line(Line::new(score.name.as_str(), points).color(hue(k)).width(2.0));
            }
        });
    });
}
