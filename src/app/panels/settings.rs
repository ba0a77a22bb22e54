//! Lubricant laws and the reduced model's settings.

use crate::app::controls::{NAME_WIDTH, heading, warning_ui};
use crate::app::state::State;
use crate::solver::lubricant::{DensityLaw, ViscosityLaw};
use crate::solver::reduced::Trust;
use egui::{ComboBox, Grid, Ui};

/// The groups Lubricant and Model.
pub fn ui(ui: &mut Ui, state: &mut State) {
    heading(ui, "Lubricant");
    lubricant_ui(ui, state);
    heading(ui, "Model");
    model_ui(ui, state);
}

fn lubricant_ui(ui: &mut Ui, state: &mut State) {
    let mut wanted = state.document.lubricant;
    Grid::new("lubricant").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let label = ui.label("Viscosity");
        ComboBox::from_id_salt("viscosity law")
            .selected_text(viscosity_name(wanted.viscosity))
            .width(140.0)
            .show_ui(ui, |ui| {
                for law in [ViscosityLaw::Roelands, ViscosityLaw::Barus] {
                    ui.selectable_value(&mut wanted.viscosity, law, viscosity_name(law))
                        .on_hover_text(viscosity_tip(law));
                }
            })
            .response
            .labelled_by(label.id)
            .on_hover_text(viscosity_tip(wanted.viscosity));
        ui.end_row();
        let label = ui.label("Density");
        ComboBox::from_id_salt("density law")
            .selected_text(density_name(wanted.density))
            .width(140.0)
            .show_ui(ui, |ui| {
                for law in [DensityLaw::DowsonHigginson, DensityLaw::Incompressible] {
                    ui.selectable_value(&mut wanted.density, law, density_name(law)).on_hover_text(density_tip(law));
                }
            })
            .response
            .labelled_by(label.id)
            .on_hover_text(density_tip(wanted.density));
        ui.end_row();
    });
    if wanted != state.document.lubricant {
        let result = state.document.set_lubricant(wanted);
        state.entries.answer("lubricant", result);
    }
    state.entries.message_ui(ui, "lubricant");
}

fn viscosity_name(law: ViscosityLaw) -> &'static str {
    match law {
        ViscosityLaw::Roelands => "Roelands",
        ViscosityLaw::Barus => "Barus",
    }
}

fn viscosity_tip(law: ViscosityLaw) -> &'static str {
    match law {
        ViscosityLaw::Roelands => {
            "ln(η/η₀) = (ln η₀ + 9.67)((1 + p/0.196 GPa)^z − 1) (2.12), Roelands 1966; mineral oils to about 1 GPa"
        }
        ViscosityLaw::Barus => "η = η₀ exp(αp) (2.11), Barus 1893; overestimates above some 0.5 GPa",
    }
}

fn density_name(law: DensityLaw) -> &'static str {
    match law {
        DensityLaw::DowsonHigginson => "Dowson–Higginson",
        DensityLaw::Incompressible => "Incompressible",
    }
}

fn density_tip(law: DensityLaw) -> &'static str {
    match law {
        DensityLaw::DowsonHigginson => {
            "ρ/ρ₀ = (0.59 GPa + 1.34p)/(0.59 GPa + p) (2.10), Dowson & Higginson 1966; saturates at 1.34"
        }
        DensityLaw::Incompressible => "ρ = ρ₀",
    }
}

fn model_ui(ui: &mut Ui, state: &mut State) {
    let moes = state.document.point.moes();
    let Some(model) = state.model.clone() else {
        ui.weak("No reduced model is loaded; the full solver draws the picture.");
        return;
    };
    let Some(window) = model.windows.get(model.window_for(moes)) else { return };
    let options = state.reduced_options();
    let (all, all_deformation) = (window.pressure.modes.ncols(), window.deformation.modes.ncols());
    ui.label(&model.title).on_hover_text(model.log.join("\n"));
    Grid::new("model").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        ui.label("Pressure modes").on_hover_text("Kept of all; drag the tolerance in the tab Reduced basis");
        ui.label(format!("{} of {all}", options.pressure_modes.unwrap_or(all)));
        ui.end_row();
        ui.label("Sampled rows").on_hover_text("Rows of the Reynolds equation that the reduced model evaluates");
        ui.label(format!("{} of {}", window.sampled_rows.len(), window.grid.xi.len().saturating_sub(3)));
        ui.end_row();
        let label = ui.label("Deformation");
        let name = |projected: bool| if projected { "through its basis" } else { "exact" };
        let projected = &mut state.document.view.projected_deformation;
        ComboBox::from_id_salt("deformation")
            .selected_text(name(*projected))
            .width(140.0)
            .show_ui(ui, |ui| {
                ui.selectable_value(projected, false, name(false)).on_hover_text("K V_p, no error of its own");
                ui.selectable_value(projected, true, name(true))
                    .on_hover_text("V_δ V_δ^T K V_p, as in the dissertation: its own truncation");
            })
            .response
            .labelled_by(label.id);
        ui.end_row();
        if state.document.view.projected_deformation {
            ui.label("Deformation modes");
            ui.label(format!("{} of {all_deformation}", options.deformation_modes.unwrap_or(all_deformation)));
            ui.end_row();
        }
    });
    if let Some(Trust::Outside(why)) = state.trust() {
        warning_ui(ui, &format!("{why}; the full solver draws the picture"));
    }
}
