//! Panel of the grid of a point contact's full solutions: presets, resolution of the side lobes, discretisation
//! error.

use crate::app::answers::jobs::JobKind;
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{NAME_WIDTH, choice, heading, message_ui, warning_ui};
use crate::app::document::Edit;
use crate::app::numbers;
use crate::app::theme::{Palette, rich};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::point::second_grid;
use egui::{Grid, Ui};

/// Presets with name and tooltip.
const PRESETS: [(PointGridSpec, &str, &str); 5] = [
    (
        PointGridSpec::QUICK,
        "Quick, 151×41",
        "ΔX 0.04, ΔY 0.05: H_c 5 % too small at M = 200; also used while a slider moves",
    ),
    (
        PointGridSpec::DISSERTATION,
        "Dissertation, 301×41",
        "ΔX 0.02, ΔY 0.05: H_c 1.4 % too small at M = 200, H_min too small where the load is high",
    ),
    (
        PointGridSpec::EXPLORER,
        "Graded, 301×59",
        "The dissertation’s, four times finer in the side lobes: H_min within 2 % of ΔY 0.0125",
    ),
    (PointGridSpec::FINE, "Fine, 601×81", "ΔX 0.01, ΔY 0.025: H_c 0.4 % too small at M = 200; seconds"),
    (PointGridSpec::FINEST, "Finest, 601×116", "The fine one, four times finer in the side lobes; several seconds"),
];

/// Draws the group Grid. Draws nothing for a line contact.
pub fn ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let Context { document, answers, .. } = *context;
    if document.point.kind.is_line() {
        return;
    }
    heading(ui, "Grid");
    let chosen = document.plane();
    let mut wanted = chosen;
    Grid::new("plane").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let tip = "Nodes along X and across the half Y ≤ 0 of full solutions. H_c converges with ΔX, H_min with ΔY in the side lobes";
        let mut all: Vec<PointGridSpec> = PRESETS.iter().map(|preset| preset.0).collect();
        if !all.contains(&chosen) {
            all.push(chosen);
        }
        let describe = |spec: PointGridSpec| {
            let preset = PRESETS.iter().find(|preset| preset.0 == spec);
            preset.map_or(("The scene’s own", "As the scene gives it"), |preset| (preset.1, preset.2))
        };
        choice(ui, "Nodes", tip, &mut wanted, &all, describe);
    });
    if wanted != chosen {
        commands.edit(Edit::Plane(wanted), "Nodes");
    }
    if answers.model(document).is_some() {
        ui.weak("Used for full solutions outside the trained range; the reduced model has its own grid");
    }
    // Content that appears and disappears with solves is placed last, so that nothing below it moves.
    error_ui(ui, context, commands);
    if let Some(warning) = answers.shown_picture().and_then(|picture| picture.unresolved.as_ref()) {
        warning_ui(ui, warning);
    }
}

fn error_ui(ui: &mut Ui, Context { document, answers, .. }: &Context<'_>, commands: &mut Commands) {
    let runs = answers.runs(JobKind::Estimate);
    let there = answers.can_estimate();
    let mesh = answers.full().map(|full| full.solution.mesh);
    let spec = mesh.and_then(|mesh| mesh.plane()).unwrap_or(document.plane());
    let (nx, ny) = second_grid(spec).nodes().unwrap_or_default();
    let tip = format!(
        "Solves the same contact on {nx}×{ny} nodes and extrapolates H_c and H_min to fine grids, by the second order of the scheme"
    );
    let button = ui.add_enabled(there && !runs, egui::Button::new("Estimate grid error"));
    if button.on_hover_text(&tip).on_disabled_hover_text("A full solution on the chosen grid comes first").clicked() {
        commands.push(Command::EstimateGridError);
    }
    if let Some(why) = answers.no_estimate() {
        message_ui(ui, why);
    }
    let Some(error) = answers.grid_error().map(|error| error.accuracy) else { return };
    let palette = Palette::of(ui);
    let text = format!(
        "Error of {{H_c}} {}, in the limit {}\nError of {{H_min}} {}, in the limit {}",
        numbers::error_percent(error.h_c_error),
        numbers::significant(error.h_c_limit),
        numbers::error_percent(error.h_min_error),
        numbers::significant(error.h_min_limit)
    );
    let response = ui.label(rich(&text, 12.5, palette.text));
    response.on_hover_text(format!("Richardson’s extrapolation with the solution on {}×{} nodes", error.nx, error.ny));
    if !error.resolved {
        warning_ui(ui, "one of the two grids does not resolve the side lobes: the error of H_min may be larger");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_have_the_nodes_of_their_names() {
        for (spec, name, _) in PRESETS {
            let (nx, ny) = spec.nodes().unwrap();
            assert!(name.ends_with(&format!("{nx}×{ny}")), "{name}: {nx}×{ny}");
        }
    }
}
