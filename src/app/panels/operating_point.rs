//! The same state in SI units beside the sliders, what follows what, and the Hertzian contact behind it.

use super::sliders;
use crate::app::context::{Commands, Context};
use crate::app::controls::{
    Entries, NAME_WIDTH, choice, explained, heading, lock_ui, named, reserved, row_name, typed_field, warning_ui,
};
use crate::app::document::{Document, Edit};
use crate::app::numbers;
use crate::app::theme::name_and_symbol;
use crate::solver::physics::contact::{ContactKind, PLAUSIBLE_HERTZ_PRESSURE_PA, Quantity};
use crate::solver::physics::engineering::{self, Dimension};
use egui::{Grid, RichText, Ui};

const KINDS: [(ContactKind, &str, &str); 2] = [
    (ContactKind::Line, "Line contact", "A long roller on a raceway: load per unit length, the same at every Y"),
    (
        ContactKind::Point,
        "Point contact",
        "A ball on a raceway or a disc, circular: the film has its horseshoe and side lobes",
    ),
];
/// Under this name the switch between both is refused.
pub const KIND: &str = "kind of contact";

/// The panel's first group.
pub fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    heading(ui, "Operating point");
    kind_ui(ui, context.document.point.kind, commands);
    sliders::column(ui, context, entries, commands);
    followers_ui(ui, context.document, commands);
    si_ui(ui, context.document, entries, commands);
    hertz_ui(ui, context.document);
}

/// Line or point.
pub(super) fn kind_ui(ui: &mut Ui, present: ContactKind, commands: &mut Commands) {
    let mut wanted = present;
    ui.horizontal(|ui| {
        for (kind, name, tip) in KINDS {
            let tip = format!("{tip}. All stays but the load, which follows M");
            ui.selectable_value(&mut wanted, kind, name).on_hover_text(tip);
        }
    });
    if wanted != present {
        commands.edit(Edit::Kind(wanted), KIND);
    }
}

fn followers_ui(ui: &mut Ui, document: &Document, commands: &mut Commands) {
    Grid::new("followers").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let tip = "M fixes one combination of the SI values: this is the one that gives way";
        let (load_before, lubricant_before) = document.followers();
        let (mut load, mut lubricant) = (load_before, lubricant_before);
        let (loads, lubricants) = document.possible_followers();
        choice(ui, "When M moves", tip, &mut load, loads, |f| (f.name(), ""));
        let tip = match (document.lubricant.own_coefficient(), document.point.kind) {
            (Some(_), _) => "L fixes another one; α follows from the lubricant’s viscosity law",
            (None, ContactKind::Line) => {
                "L fixes another one. “α and speed together” keeps to α = 5/GPa · L^0.463, along which the reduced model is trained"
            }
            (None, ContactKind::Point) => {
                "L fixes another one. “α and speed together” keeps to α = 5/GPa · (L/1.7)^0.655"
            }
        };
        choice(ui, "When L moves", tip, &mut lubricant, lubricants, |f| (f.name(), ""));
        if load != load_before {
            commands.edit(Edit::LoadFollower(load), "When M moves");
        } else if lubricant != lubricant_before {
            commands.edit(Edit::LubricantFollower(lubricant), "When L moves");
        }
    });
}

/// The names of the fields of the SI quantities, by which screen readers know them.
pub const FIELDS: [(Quantity, &str); 6] = [
    (Quantity::Radius, "Radius R"),
    (Quantity::Speed, "Speed u_m"),
    (Quantity::Load, "Load w"),
    (Quantity::Modulus, "Modulus E'"),
    (Quantity::Viscosity, "Viscosity η₀"),
    (Quantity::Alpha, "Coefficient α"),
];

fn si_ui(ui: &mut Ui, document: &Document, entries: &mut Entries, commands: &mut Commands) {
    ui.add_space(4.0);
    let own_alpha = document.lubricant.own_coefficient().is_some();
    let kind = document.point.kind;
    for (quantity, field) in FIELDS {
        let Some(si) = quantity.of(&document.point) else { continue };
        let ((base, subscript), (unit, scale)) = (quantity.symbol(), quantity.reading_unit(kind));
        let meaning = quantity.meaning(kind);
        ui.horizontal(|ui| {
            let name = field.split(' ').next().unwrap_or(field);
            row_name(ui, name_and_symbol(ui, name, base, subscript), meaning);
            if quantity == Quantity::Alpha && own_alpha {
                let tip = "α* follows from the lubricant’s own viscosity law: 1/α* = ∫ η₀/μ dp, Blok 1963";
                ui.label(numbers::significant(si / scale)).on_hover_text(tip);
                ui.label(unit);
                return;
            }
            let read = |text: &str| read(text, quantity, kind).map(|si| si / scale);
            if let Some(value) = typed_field(ui, entries, field, si / scale, 70.0, meaning, read) {
                commands.edit(Edit::Typed(quantity, value * scale), field);
            }
            ui.label(unit);
            held_ui(ui, document, (quantity, field), commands);
        });
    }
    entries.reserved_ui(ui, FIELDS.map(|(_, field)| field).into_iter().chain(sliders::FIELDS).chain([KIND]));
}

/// The lock of a quantity that is held, or what it follows.
fn held_ui(ui: &mut Ui, document: &Document, (quantity, field): (Quantity, &'static str), commands: &mut Commands) {
    let (held, follows) = (document.holds(quantity), document.follows(quantity));
    let (name, tip) = match (held, follows) {
        (true, _) => (format!("Free {field}"), "Held: it stays when M or L moves. Click to free it"),
        (_, "") => (format!("Hold {field}"), "Free, but nothing moves it now. Click to hold it"),
        _ => (format!("Hold {field}"), "It gives way. Click to hold it; another quantity follows then"),
    };
    let response = if held || follows.is_empty() {
        lock_ui(ui, HELD, held)
    } else {
        // As wide whatever it says, so that nothing beside it moves.
        ui.add_sized(HELD, egui::Button::new(RichText::new(follows).small().weak()).frame(false))
    };
    if named(ui, response, &name).on_hover_text(tip).clicked() {
        commands.edit(Edit::Hold(quantity, !held), field);
    }
}

/// Room for a lock, or for what a quantity follows.
const HELD: [f32; 2] = [62.0, 22.0];

/// The value in SI units of a typed text with or without unit, inside what is accepted.
fn read(text: &str, quantity: Quantity, kind: ContactKind) -> Result<f64, String> {
    let (unit, scale) = quantity.reading_unit(kind);
    let value = engineering::parse(text, Dimension::of(quantity, kind), unit).map_err(|error| error.to_string())?;
    let (low, high) = quantity.range();
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    let [low, high] = [low, high].map(|end| numbers::quantity(end / scale, unit));
    Err(format!("{} is {}; {low} to {high} are accepted", quantity.name(), numbers::quantity(value / scale, unit)))
}

fn hertz_ui(ui: &mut Ui, document: &Document) {
    let point = &document.point;
    let hertz = point.hertz();
    let (width_name, width_tip, pressure_tip, stiffening_tip) = match point.kind {
        ContactKind::Line => (
            "Half width",
            "Hertzian half width, a² = 8wR/(πE’) (2.21)",
            "Largest pressure of the dry contact, p_H² = wE’/(2πR) (2.21)",
            "α p_H = L √(M/2π): the exponent of Barus’ law at the Hertzian pressure",
        ),
        ContactKind::Point => (
            "Radius",
            "Radius of the Hertzian circle, a³ = 3wR/(2E’) (2.21)",
            "Largest pressure of the dry contact, p_H = 3w/(2πa²) (2.21)",
            "α p_H = L (3M/2π³)^⅓: the exponent of Barus’ law at the Hertzian pressure",
        ),
    };
    ui.add_space(4.0);
    Grid::new("hertz").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 3.0]).show(ui, |ui| {
        let shear = engineering::largest_shear(point, 0.3);
        let deepest = format!(
            "{} at {}",
            numbers::pressure(shear.over_hertz_pressure * hertz.pressure_pa),
            numbers::length(shear.depth_over_half_width * hertz.half_width_m)
        );
        let shear_tip =
            "The largest shear stress under the dry contact and its depth, where rolling fatigue begins; ν = 0.3";
        let rows = [
            ((width_name, "a", ""), numbers::length(hertz.half_width_m), width_tip),
            (("Hertz pressure", "p", "H"), numbers::pressure(hertz.pressure_pa), pressure_tip),
            (("Stiffening", "αp", "H"), numbers::significant(point.alpha_hertz()), stiffening_tip),
            (("Shear below", "τ", "max"), deepest, shear_tip),
        ];
        for ((name, base, subscript), value, tip) in rows {
            explained(ui, name_and_symbol(ui, name, base, subscript), tip);
            ui.label(value).on_hover_text(tip);
            ui.end_row();
        }
    });
    reserved(ui, 1, |ui| {
        if hertz.pressure_pa > PLAUSIBLE_HERTZ_PRESSURE_PA {
            warning_ui(ui, "Beyond 3.2 GPa steel yields: no real contact");
        }
    });
}
