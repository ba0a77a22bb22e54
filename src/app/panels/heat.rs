//! Heat: whether temperatures are computed, and what they need of the oil and of both bodies.

use super::lubricant::{Constant, constant, constants_ui};
use crate::app::context::Commands;
use crate::app::controls::{Entries, NAME_WIDTH, choice};
use crate::app::document::{Document, Edit};
use crate::scene::named_lubricant;
use crate::solver::physics::engineering::{MATERIALS, Material};
use crate::solver::physics::lubricant::{Heat, Lubricant};
use egui::{Checkbox, Grid, Ui};

const TIP: &str = "Temperatures across and along the film and of both bodies, and what they do to film and traction: by \
    full solutions, of lines and circles also by a reduced model that was trained with heat";

const INLET_TIP: &str = "Temperature of the oil and of both bodies in front of the contact; η₀ and α are those at it";
const VISCOSITY_TIP: &str = "β = −d ln η/dT at ambient pressure; Doolittle’s law has constants of its own";
const DENSITY_TIP: &str = "−d ln ρ/dT at ambient pressure; Tait’s law has constants of its own";
const CONDUCTIVITY_TIP: &str = "Thermal conductivity of the oil";
const CAPACITY_TIP: &str = "Specific heat capacity of the oil";
const OIL_DENSITY_TIP: &str = "Density of the oil at ambient pressure and the inlet’s temperature";

/// The constants of the oil.
pub(super) const CONSTANTS: [Constant; 6] = [
    constant("Inlet temperature", ("Inlet", "T", "0"), ("K", 1.0), INLET_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.inlet_temperature)
    }),
    constant("Viscosity's temperature coefficient", ("Viscosity", "β", ""), ("1/K", 1.0), VISCOSITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.viscosity_temperature)
    }),
    constant("Density's temperature coefficient", ("Density", "β", "ρ"), ("1/K", 1.0), DENSITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.density_temperature)
    }),
    constant("Thermal conductivity", ("Conductivity", "k", ""), ("W/(m K)", 1.0), CONDUCTIVITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.conductivity)
    }),
    constant("Heat capacity", ("Heat capacity", "c", "p"), ("J/(kg K)", 1.0), CAPACITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.heat_capacity)
    }),
    constant("Density of the oil", ("Density", "ρ", "0"), ("kg/m³", 1.0), OIL_DENSITY_TIP, |l| {
        l.heat.as_mut().map(|heat| &mut heat.oil.density)
    }),
];

/// The switch, and below it the constants where it is on.
pub(super) fn ui(ui: &mut Ui, document: &Document, entries: &mut Entries, commands: &mut Commands) {
    let before = document.lubricant;
    let mut wanted = before;
    let mut on = wanted.heat.is_some();
    if ui.add(Checkbox::new(&mut on, "Heat")).on_hover_text(TIP).changed() {
        let own = named_lubricant::of_laws(&wanted).map(|named| named.heat).unwrap_or_default();
        wanted.heat = on.then_some(Heat { oil: own, ..Heat::default() });
    }
    bodies(ui, &mut wanted);
    let field = constants_ui(ui, entries, &CONSTANTS, &mut wanted);
    if wanted != before {
        commands.edit(Edit::Laws(Box::new(wanted)), field);
    }
}

/// The material of each body; those of a scene that are none of the named ones stay as they are.
fn bodies(ui: &mut Ui, laws: &mut Lubricant) {
    let Some(heat) = &mut laws.heat else { return };
    Grid::new("bodies with heat").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        for (body, (name, tip)) in heat
            .bodies
            .iter_mut()
            .zip([("Body 1", "It moves with u_m (1 + SRR/2)"), ("Body 2", "It moves with u_m (1 − SRR/2)")])
        {
            let known: Option<Material> = MATERIALS.into_iter().find(|material| material.heat == *body);
            let mut wanted = known;
            let own = if known.is_none() { Some(None) } else { None };
            let options: Vec<Option<Material>> = MATERIALS.into_iter().map(Some).chain(own).collect();
            choice(ui, name, tip, &mut wanted, &options, |material| {
                material.map_or(("Own", "Constants of its own"), |material| (material.name, ""))
            });
            if let Some(material) = wanted.filter(|_| wanted != known) {
                *body = material.heat;
            }
        }
    });
}
