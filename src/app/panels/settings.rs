//! Lubricant laws and the reduced model's settings.

use crate::app::controls::{NAME_WIDTH, choice, heading, warning_ui};
use crate::app::state::State;
use crate::solver::lubricant::{DensityLaw, ViscosityLaw};
use crate::solver::reduced::Trust;
use egui::{Grid, Ui};

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
        let laws = [ViscosityLaw::Roelands, ViscosityLaw::Barus];
        choice(ui, "Viscosity", "How the viscosity rises with pressure", &mut wanted.viscosity, &laws, viscosity_law);
        let laws = [DensityLaw::DowsonHigginson, DensityLaw::Incompressible];
        choice(ui, "Density", "How the density rises with pressure", &mut wanted.density, &laws, density_law);
    });
    if wanted != state.document.lubricant {
        let result = state.document.set_lubricant(wanted);
        state.entries.answer("lubricant", result);
    }
    state.entries.message_ui(ui, "lubricant");
}

fn viscosity_law(law: ViscosityLaw) -> (&'static str, &'static str) {
    match law {
        ViscosityLaw::Roelands => (
            "Roelands",
            "ln(η/η₀) = (ln η₀ + 9.67)((1 + p/0.196 GPa)^z − 1) (2.12), Roelands 1966; mineral oils to about 1 GPa",
        ),
        ViscosityLaw::Barus => ("Barus", "η = η₀ exp(αp) (2.11), Barus 1893; overestimates above some 0.5 GPa"),
        ViscosityLaw::Doolittle(_) => {
            ("Doolittle", "from the free volume that Tait's equation leaves (3.39), Doolittle 1951")
        }
    }
}

fn density_law(law: DensityLaw) -> (&'static str, &'static str) {
    match law {
        DensityLaw::DowsonHigginson => (
            "Dowson–Higginson",
            "ρ/ρ₀ = (0.59 GPa + 1.34p)/(0.59 GPa + p) (2.10), Dowson & Higginson 1966; saturates at 1.34",
        ),
        DensityLaw::Incompressible => ("Incompressible", "ρ = ρ₀"),
        DensityLaw::Tait(_) => ("Tait", "from the relative volume of Tait's equation (3.37), Dymond & Malhotra 1988"),
    }
}

fn deformation_operator(projected: bool) -> (&'static str, &'static str) {
    if projected {
        ("through its basis", "V_δ V_δ^T K V_p, as in the dissertation: its own truncation")
    } else {
        ("exact", "K V_p, no error of its own")
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
        ui.label(format!("{} of {}", window.sampled_rows.len(), window.grid.unknowns()));
        ui.end_row();
        let tip = "How the reduced model deforms the bodies";
        let projected = &mut state.document.view.projected_deformation;
        choice(ui, "Deformation", tip, projected, &[false, true], deformation_operator);
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
