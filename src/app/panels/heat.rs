//! Panel of the thermal contact: the switch for temperatures, and the constants of the oil and of both bodies.

use super::lubricant::{Constant, GROUP, constant, constants_ui};
use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, NAME_WIDTH, choice, named};
use crate::app::document::Edit;
use crate::solver::physics::bodies::{BodyHeat, MATERIALS, Material};
use crate::solver::physics::engineering::QuantityKind;
use egui::{Checkbox, Grid, Ui};

const TIP: &str = "Computes temperatures across and along the film and of both bodies, and their effect on film \
                   thickness and traction. By full solutions; for line and circular contacts also by a reduced thermal \
                   model";

const INLET_TIP: &str = "Temperature of the oil and of both bodies in front of the contact, at which η₀ and α apply";
const VISCOSITY_TIP: &str = "β = −d ln η/dT at ambient pressure; Doolittle’s law has its own constants";
const DENSITY_TIP: &str = "−d ln ρ/dT at ambient pressure; Tait’s law has its own constants";
const CONDUCTIVITY_TIP: &str = "Thermal conductivity of the oil";
const CAPACITY_TIP: &str = "Specific heat capacity of the oil";
const OIL_DENSITY_TIP: &str = "Density of the oil at ambient pressure and inlet temperature";

/// Constants of the oil.
pub(super) const CONSTANTS: [Constant; 6] = [
    constant("Inlet temperature", ("Inlet", "T", "0"), QuantityKind::Temperature, INLET_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.inlet_temperature)
    }),
    constant(
        "Viscosity's temperature coefficient",
        ("Viscosity", "β", ""),
        QuantityKind::PerKelvin,
        VISCOSITY_TIP,
        |l| l.heat.as_mut().map(|heat| &mut heat.oil.viscosity_temperature),
    ),
    constant("Density's temperature coefficient", ("Density", "β", "ρ"), QuantityKind::PerKelvin, DENSITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.density_temperature)
    }),
    constant("Thermal conductivity", ("Conductivity", "k", ""), QuantityKind::Conductivity, CONDUCTIVITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.conductivity)
    }),
    constant("Heat capacity", ("Heat capacity", "c", "p"), QuantityKind::HeatCapacity, CAPACITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.heat_capacity)
    }),
    constant("Density of the oil", ("Density", "ρ", "0"), QuantityKind::Density, OIL_DENSITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.density)
    }),
];

/// Draws the switch and, if it is on, the constants.
pub(super) fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let before = context.document.lubricant;
    let mut on = before.heat.is_some();
    let heat = ui.add(Checkbox::new(&mut on, "Heat"));
    if named(ui, heat, "Heat").on_hover_text(TIP).changed() {
        commands.edit(Edit::Heat(on), GROUP);
    }
    let Some(heat) = before.heat else { return };
    materials_ui(ui, &heat.bodies, commands);
    let mut wanted = before;
    let field = constants_ui(ui, entries, &CONSTANTS, &mut wanted, context.system);
    if wanted != before {
        commands.edit(Edit::Laws(Box::new(wanted)), field);
    }
}

/// Draws the material of each body. Bodies of a scene that are no named material keep their constants.
fn materials_ui(ui: &mut Ui, bodies: &[BodyHeat; 2], commands: &mut Commands) {
    let names = [("Body 1", "Moves with u_m (1 − SRR/2)"), ("Body 2", "Moves with u_m (1 + SRR/2)")];
    Grid::new("bodies with heat").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        for (body, (thermal, (name, tip))) in bodies.iter().zip(names).enumerate() {
            let known = thermal.material();
            let mut wanted = known;
            let own = known.is_none().then_some(None);
            let options: Vec<Option<Material>> = MATERIALS.into_iter().map(Some).chain(own).collect();
            choice(ui, name, tip, &mut wanted, &options, |material| {
                material.map_or(("Own", "Custom constants"), |material| (material.name, material.source))
            });
            if let Some(material) = wanted.filter(|_| wanted != known) {
                commands.edit(Edit::Material(body, material), GROUP);
            }
        }
    });
}
