//! The reduced model that serves the contact: what it keeps, and how it deforms the bodies.

use crate::app::context::{Commands, Context};
use crate::app::controls::{NAME_WIDTH, choice, heading, reserved, warning_ui};
use crate::app::document::Edit;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::ShearLaw;
use crate::solver::reduced::Trust;
use egui::{Grid, Ui};

/// The group Model.
pub fn ui(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    heading(ui, "Model");
    model_ui(ui, context, commands);
}

fn deformation_operator(projected: bool) -> (&'static str, &'static str) {
    if projected {
        ("through its basis", "V_δ V_δ^T K V_p, as in the dissertation: its own truncation")
    } else {
        ("exact", "K V_p, no error of its own")
    }
}

fn model_ui(ui: &mut Ui, Context { document, answers, .. }: &Context<'_>, commands: &mut Commands) {
    let Some(model) = answers.model(document) else {
        ui.weak(match (document.point.kind, document.lubricant.shear) {
            (ContactKind::Line, ShearLaw::Newtonian) => {
                "No reduced model is loaded; the full solver draws the picture."
            }
            (ContactKind::Point, ShearLaw::Newtonian) => {
                "There is no reduced model of point contacts; the full solver draws the picture."
            }
            _ => "There is no reduced model of lubricants that thin under shear; the full solver draws the picture.",
        });
        return;
    };
    let Some(window) = model.windows.get(model.window_for(&document.point)) else { return };
    let options = answers.options(document);
    let (all, all_deformation) = (window.pressure.modes.ncols(), window.deformation.modes.ncols());
    ui.label(&model.title).on_hover_text(model.log.join("\n"));
    Grid::new("model").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        ui.label("Pressure modes").on_hover_text("Kept of all; drag the tolerance in the tab Reduced basis");
        ui.label(format!("{} of {all}", options.pressure_modes.unwrap_or(all)));
        ui.end_row();
        ui.label("Sampled rows").on_hover_text("Rows of the Reynolds equation that the reduced model evaluates");
        ui.label(format!("{} of {}", window.sampled_rows.len(), window.grid.unknowns()));
        ui.end_row();
        let tip = "How the reduced model deforms the bodies";
        let mut view = document.view;
        choice(ui, "Deformation", tip, &mut view.projected_deformation, &[false, true], deformation_operator);
        if view != document.view {
            commands.edit(Edit::View(view.into()), "Deformation");
        }
        if view.projected_deformation {
            ui.label("Deformation modes");
            ui.label(format!("{} of {all_deformation}", options.deformation_modes.unwrap_or(all_deformation)));
            ui.end_row();
        }
    });
    reserved(ui, 3, |ui| {
        if let Some(Trust::Outside(why)) = answers.trust(document) {
            warning_ui(ui, &format!("{why}; the full solver draws the picture"));
        }
    });
}
