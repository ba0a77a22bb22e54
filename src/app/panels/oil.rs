//! Panel of the oil: its grade and temperature determine η₀ and α.

use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, NAME_WIDTH, choice, named, row_name, sentence, typed_field, warning_ui};
use crate::app::document::Edit;
use crate::app::numbers;
use crate::app::theme::name_and_symbol;
use crate::solver::physics::engineering::{Grade, ISO_VG, KELVIN, Oil, OilFamily, QuantityKind, UnitSystem};
use egui::{Grid, Ui};

/// Name under which refusals of the oil are stored.
const GROUP: &str = "oil";
const FIELDS: [&str; 8] = [
    GROUP,
    "Oil temperature",
    "Oil density",
    "Viscosity 1",
    "At temperature 1",
    "Viscosity 2",
    "At temperature 2",
    "Measured coefficient",
];

/// Choice of the oil.
#[derive(Clone, Copy, PartialEq)]
enum Choice {
    /// η₀ and α as entered.
    Entered,
    Iso(f64),
    Two,
}

/// Value of an oil that can be typed.
struct Field {
    name: &'static str,
    row: &'static str,
    kind: QuantityKind,
    tip: &'static str,
    of: fn(&mut Oil) -> Option<&mut f64>,
}

const AT_TIP: &str = "The temperature of that viscosity";

const ROWS: [Field; 6] = [
    Field {
        name: FIELDS[3],
        row: "Viscosity",
        kind: QuantityKind::KinematicViscosity,
        tip: "Kinematic viscosity at the first temperature",
        of: |oil| Some(&mut two(oil)?.0.1),
    },
    Field {
        name: FIELDS[4],
        row: "at",
        kind: QuantityKind::Temperature,
        tip: AT_TIP,
        of: |oil| Some(&mut two(oil)?.0.0),
    },
    Field {
        name: FIELDS[5],
        row: "Viscosity",
        kind: QuantityKind::KinematicViscosity,
        tip: "Kinematic viscosity at the second temperature",
        of: |oil| Some(&mut two(oil)?.1.1),
    },
    Field {
        name: FIELDS[6],
        row: "at",
        kind: QuantityKind::Temperature,
        tip: AT_TIP,
        of: |oil| Some(&mut two(oil)?.1.0),
    },
    Field {
        name: FIELDS[1],
        row: "Temperature",
        kind: QuantityKind::Temperature,
        tip: "Temperature of the oil as it enters the contact",
        of: |oil| Some(&mut oil.temperature_k),
    },
    Field {
        name: FIELDS[2],
        row: "Density, 15 °C",
        kind: QuantityKind::Density,
        tip: "Density at 15 °C; it expands as lubricating oils do (ASTM D1250)",
        of: |oil| Some(&mut oil.density_15),
    },
];

type Points<'a> = (&'a mut (f64, f64), &'a mut (f64, f64));

fn two(oil: &mut Oil) -> Option<Points<'_>> {
    if let Grade::Two(first, second) = &mut oil.grade { Some((first, second)) } else { None }
}

/// Draws the group of the oil.
pub fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let document = context.document;
    if document.lubricant.own_coefficient().is_some() {
        return;
    }
    let before = document.view.oil;
    let mut wanted = before;
    Grid::new("oil").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        grade_ui(ui, &mut wanted);
        if let Some(oil) = &mut wanted {
            let tip = "Base oil. A published correlation gives its pressure–viscosity coefficient";
            choice(ui, "Base oil", tip, &mut oil.family, &OilFamily::ALL, |family| (family.name(), family.source()));
            if before.is_some_and(|former| former.family != oil.family) {
                oil.density_15 = oil.family.usual_density();
            }
        }
    });
    let mut field = GROUP;
    if let Some(oil) = &mut wanted {
        field = fields_ui(ui, oil, context.system, entries).unwrap_or(field);
    }
    if let Some(oil) = &mut wanted {
        field = measured_ui(ui, oil, context.system, entries).unwrap_or(field);
    }
    if wanted != before {
        commands.edit(Edit::Oil(wanted), field);
    }
    if let Some(oil) = before {
        state_ui(ui, context, oil, commands);
        entries.reserved_ui(ui, FIELDS);
    }
}

fn grade_ui(ui: &mut Ui, wanted: &mut Option<Oil>) {
    let present = match wanted.map(|oil| oil.grade) {
        None => Choice::Entered,
        Some(Grade::IsoVg(grade)) => Choice::Iso(grade),
        Some(Grade::Two(..)) => Choice::Two,
    };
    let mut chosen = present;
    let grades = ISO_VG.iter().map(|(grade, _)| Choice::Iso(*grade));
    let options: Vec<Choice> = std::iter::once(Choice::Entered).chain(grades).chain([Choice::Two]).collect();
    let tip = "An oil by its ISO grade, or by two viscosities, gives η₀ and α at its temperature";
    choice(ui, "Oil", tip, &mut chosen, &options, |option| match option {
        Choice::Entered => ("η₀ and α as entered", "No oil by grade"),
        Choice::Two => ("Two viscosities", "Kinematic viscosities at two temperatures, ASTM D341 between them"),
        Choice::Iso(grade) => (grade_name(grade), "Mineral oil with a viscosity index of 95"),
    });
    if chosen == present {
        return;
    }
    let usual = Oil {
        grade: Grade::IsoVg(68.0),
        family: OilFamily::Mineral,
        temperature_k: KELVIN + 40.0,
        density_15: OilFamily::Mineral.usual_density(),
        alpha_per_pa: None,
    };
    let oil = wanted.unwrap_or(usual);
    *wanted = match chosen {
        Choice::Entered => None,
        Choice::Iso(grade) => Some(Oil { grade: Grade::IsoVg(grade), ..oil }),
        Choice::Two => {
            let at_40 = if let Grade::IsoVg(grade) = oil.grade { grade } else { 68.0 };
            let at_100 = ISO_VG.iter().find(|(grade, _)| *grade == at_40).map_or(8.53, |(_, hot)| *hot);
            let points = [(40.0, at_40), (100.0, at_100)].map(|(celsius, nu)| (KELVIN + celsius, 1e-6 * nu));
            Some(Oil { grade: Grade::Two(points[0], points[1]), ..oil })
        }
    };
}

fn grade_name(grade: f64) -> &'static str {
    const NAMES: [&str; ISO_VG.len()] = [
        "ISO VG 10",
        "ISO VG 15",
        "ISO VG 22",
        "ISO VG 32",
        "ISO VG 46",
        "ISO VG 68",
        "ISO VG 100",
        "ISO VG 150",
        "ISO VG 220",
        "ISO VG 320",
        "ISO VG 460",
        "ISO VG 680",
        "ISO VG 1000",
        "ISO VG 1500",
    ];
    let found = ISO_VG.iter().zip(NAMES).find(|((at_40, _), _)| *at_40 == grade);
    found.map_or("", |(_, name)| name)
}

/// Draws a row for each value that can be typed. Returns the name of the field that was changed.
fn fields_ui(ui: &mut Ui, oil: &mut Oil, system: UnitSystem, entries: &mut Entries) -> Option<&'static str> {
    let mut entered = None;
    for Field { name, row, kind, tip, of } in &ROWS {
        let Some(value) = of(oil) else { continue };
        let unit = kind.unit(system);
        ui.horizontal(|ui| {
            row_name(ui, name_and_symbol(ui, row, "", ""), tip);
            let read = |text: &str| Ok(unit.number(kind.read(text, system)?));
            if let Some(typed) = typed_field(ui, entries, name, unit.number(*value), 78.0, tip, read) {
                *value = unit.si(typed);
                entered = Some(*name);
            }
            ui.label(unit.name);
        });
    }
    entered
}

/// Draws the choice between the estimate of α and a measured value. Returns the name of the field that was changed.
fn measured_ui(ui: &mut Ui, oil: &mut Oil, system: UnitSystem, entries: &mut Entries) -> Option<&'static str> {
    let mut entered = None;
    ui.horizontal(|ui| {
        let tip = "Switch on to type the α of a data sheet at the temperature of the oil. Otherwise it is estimated";
        let mut measured = oil.alpha_per_pa.is_some();
        let switch = ui.add(egui::Checkbox::new(&mut measured, "Measured α"));
        if named(ui, switch, "Measured α").on_hover_text(tip).changed() {
            let estimate = Oil { alpha_per_pa: None, ..*oil }.state().map_or(2e-8, |state| state.alpha_per_pa);
            oil.alpha_per_pa = measured.then_some(estimate);
            entered = Some(FIELDS[7]);
        }
        if let Some(alpha) = &mut oil.alpha_per_pa {
            let unit = QuantityKind::PressureCoefficient.unit(system);
            let read = |text: &str| Ok(unit.number(QuantityKind::PressureCoefficient.read(text, system)?));
            if let Some(typed) = typed_field(ui, entries, FIELDS[7], unit.number(*alpha), 78.0, tip, read) {
                *alpha = unit.si(typed);
                entered = Some(FIELDS[7]);
            }
            ui.label(unit.name);
        }
    });
    entered
}

/// Draws the values that follow from the oil, and a warning if the contact no longer has them.
fn state_ui(ui: &mut Ui, context: &Context<'_>, oil: Oil, commands: &mut Commands) {
    if let Ok(state) = oil.state() {
        let shown = |kind, si| numbers::in_field_unit(kind, si, context.system);
        let text = format!(
            "η₀ {}, α {}, ρ {}",
            shown(QuantityKind::Viscosity, state.viscosity_pa_s),
            shown(QuantityKind::PressureCoefficient, state.alpha_per_pa),
            shown(QuantityKind::Density, state.density)
        );
        ui.weak(text).on_hover_text(sentence(oil.family.source()));
    }
    if !context.document.oil_counts() {
        warning_ui(ui, "η₀ or α have been changed and no longer match this oil");
        if ui.button("Use the oil’s values").clicked() {
            commands.edit(Edit::Oil(Some(oil)), GROUP);
        }
    }
}
