//! Panel of the operating point: the shape, the sliders, the quantities that follow M and L, the SI quantities, and
//! the Hertzian contact.

use super::sliders;
use crate::app::context::{Commands, Context};
use crate::app::controls::{
    Entries, NAME_WIDTH, choice, explained, heading, lock_ui, named, reserved, row_name, typed_field, warning_ui,
};
use crate::app::document::{Document, Edit, Shape};
use crate::app::numbers;
use crate::app::refusal::Refusal;
use crate::app::theme::name_and_symbol;
use crate::engine::Warning;
use crate::scene::{ShapeKeeps, View};
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering::{self, QuantityKind, UnitSystem};
use egui::{Grid, RichText, TextWrapMode, Ui};

/// Shapes and their tooltips.
const SHAPES: [(Shape, &str); 3] = [
    (
        Shape::Roller,
        "Line contact: a long roller on a raceway with its load per unit length, the same at every Y. All quantities \
         are kept except the load, which follows M or the Hertz pressure",
    ),
    (
        Shape::Ball,
        "Circular contact: a ball on a disc; its film has a horseshoe and side lobes. All quantities are kept except \
         the load of a line contact, which follows M or the Hertz pressure",
    ),
    (
        Shape::Ellipse,
        "Elliptical contact with a different radius across the rolling direction: a ball in a groove, a crowned \
         roller. R_y/R ranges from 0.02 over 1 (circular) to 500 (nearly a line contact)",
    ),
];
/// Name under which refusals of the shape are stored.
pub const SHAPE: &str = "shape of the contact";

/// Draws the first group of the panel.
pub fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    heading(ui, "Operating point");
    shape_ui(ui, Shape::of(&context.document.point), commands);
    sliders::column(ui, context, entries, commands);
    followers_ui(ui, context.document, commands);
    si_ui(ui, context, entries, commands);
    hertz_ui(ui, context);
}

/// Draws the choice of the shape.
pub(super) fn shape_ui(ui: &mut Ui, present: Shape, commands: &mut Commands) {
    let mut wanted = present;
    ui.horizontal(|ui| {
        for (shape, tip) in SHAPES {
            ui.selectable_value(&mut wanted, shape, shape.name()).on_hover_text(tip);
        }
    });
    if wanted != present {
        commands.edit(Edit::Shape(wanted), SHAPE);
    }
}

fn followers_ui(ui: &mut Ui, document: &Document, commands: &mut Commands) {
    Grid::new("followers").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let tip = "M is a combination of SI quantities. This quantity follows when M changes";
        let (load_before, lubricant_before) = document.followers();
        let (mut load, mut lubricant) = (load_before, lubricant_before);
        let (loads, lubricants) = document.possible_followers();
        choice(ui, "When M moves", tip, &mut load, loads, |f| (f.name(), ""));
        let tip = if document.lubricant.own_coefficient().is_some() {
            "L is another combination; α follows from the lubricant’s viscosity law"
        } else if document.point.kind.is_line() {
            "L is another combination. “α and speed together” keeps α = 5/GPa · L^0.463, along which the reduced \
             model is trained"
        } else {
            "L is another combination. “α and speed together” keeps α = 5/GPa · (L/1.7)^0.655"
        };
        choice(ui, "When L moves", tip, &mut lubricant, lubricants, |f| (f.name(), ""));
        let tip = "A roller has a load per length, a ball a load. This quantity stays constant when the shape changes";
        let keeps_before = document.view.new_shape_keeps;
        let mut keeps = keeps_before;
        choice(ui, "New shape keeps", tip, &mut keeps, &ShapeKeeps::ALL, |keeps| (keeps.name(), ""));
        if keeps != keeps_before {
            let view = View { new_shape_keeps: keeps, ..document.view.clone() };
            commands.edit(Edit::View(Box::new(view)), "New shape keeps");
        }
        if load != load_before {
            commands.edit(Edit::LoadFollower(load), "When M moves");
        } else if lubricant != lubricant_before {
            commands.edit(Edit::LubricantFollower(lubricant), "When L moves");
        }
    });
}

/// Accessible names of the fields of the SI quantities.
pub const FIELDS: [(Quantity, &str); 7] = [
    (Quantity::Radius, "Radius R"),
    (Quantity::RadiusY, "Across R_y"),
    (Quantity::Speed, "Speed u_m"),
    (Quantity::Load, "Load w"),
    (Quantity::Modulus, "Modulus E'"),
    (Quantity::Viscosity, "Viscosity η₀"),
    (Quantity::Alpha, "Coefficient α"),
];

fn si_ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let (document, system) = (context.document, context.system);
    ui.add_space(4.0);
    let own_alpha = document.lubricant.own_coefficient().is_some();
    let kind = document.point.kind;
    for (quantity, field) in FIELDS {
        let Some(si) = quantity.of(&document.point) else { continue };
        let ((base, subscript), unit) = (quantity.symbol(), quantity.kind(kind).unit(system));
        let meaning = quantity.meaning(kind);
        ui.horizontal(|ui| {
            let name = field.split(' ').next().unwrap_or(field);
            row_name(ui, name_and_symbol(ui, name, base, subscript), meaning);
            if quantity == Quantity::Alpha && own_alpha {
                let tip = "α* follows from the lubricant’s own viscosity law: 1/α* = ∫ η₀/μ dp, Blok 1963";
                ui.label(numbers::significant(unit.number(si))).on_hover_text(tip);
                ui.label(unit.name);
                return;
            }
            let read = |text: &str| read(text, quantity, kind, system).map(|si| unit.number(si));
            if let Some(value) = typed_field(ui, entries, field, unit.number(si), 70.0, meaning, read) {
                commands.edit(Edit::Typed(quantity, unit.si(value)), field);
            }
            ui.label(unit.name);
            if quantity == Quantity::RadiusY && Shape::of(&document.point) == Shape::Ball {
                ui.add_sized(HELD, egui::Label::new(RichText::new("as R").small().weak())).on_hover_text(
                    "A ball has the same radius across and along. Another value gives an elliptical contact",
                );
                return;
            }
            held_ui(ui, document, (quantity, field), commands);
        });
    }
    if kind.is_line() {
        length_ui(ui, context, entries, commands);
    }
    entries.reserved_ui(ui, FIELDS.map(|(_, field)| field).into_iter().chain(sliders::FIELDS).chain([SHAPE, LENGTH]));
}

/// Name under which refusals of the length are stored.
const LENGTH: &str = "Length";

/// Draws the field of the length of a line contact.
fn length_ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let (document, system) = (context.document, context.system);
    let unit = QuantityKind::Length.unit(system);
    let meaning = "Length of the line contact, for the friction force, the torques and the power loss of the whole \
                   contact; “none” for values per length";
    ui.horizontal(|ui| {
        row_name(ui, name_and_symbol(ui, LENGTH, "", ""), meaning);
        let read = |text: &str| {
            if matches!(text.trim().to_lowercase().as_str(), "none" | "–" | "-") {
                return Ok(f64::NAN);
            }
            let length = QuantityKind::Length.read(text, system)?;
            let (least, most) = engineering::Extent::LENGTHS_M;
            if length == 0.0 || (least..=most).contains(&length) {
                return Ok(if length == 0.0 { f64::NAN } else { unit.number(length) });
            }
            let [least, most] = [least, most].map(|length| numbers::length(length, system));
            Err(Refusal::new(format!("the length must be none or from {least} to {most}")))
        };
        let value = document.length_m.map_or(f64::NAN, |length| unit.number(length));
        if let Some(length) = typed_field(ui, entries, LENGTH, value, 70.0, meaning, read) {
            commands.edit(Edit::Length(Some(unit.si(length)).filter(|length| *length > 0.0)), LENGTH);
        }
        ui.label(unit.name);
    });
}

/// Draws the lock of a held quantity, or the number that a free quantity follows.
fn held_ui(ui: &mut Ui, document: &Document, (quantity, field): (Quantity, &'static str), commands: &mut Commands) {
    let (held, follows) = (document.holds(quantity), document.follows(quantity));
    let (name, tip) = match (held, follows) {
        (true, _) => (format!("Free {field}"), "Held: it keeps its value when M or L changes. Click to release it"),
        (_, "") => (format!("Hold {field}"), "Free, but nothing changes it now. Click to hold it"),
        _ => (format!("Hold {field}"), "It follows. Click to hold it; another quantity then follows"),
    };
    let response = if held || follows.is_empty() {
        lock_ui(ui, HELD, held)
    } else {
        // The width is constant, so that nothing next to it moves.
        ui.add_sized(HELD, egui::Button::new(RichText::new(follows).small().weak()).frame(false))
    };
    if named(ui, response, &name).on_hover_text(tip).clicked() {
        commands.edit(Edit::Hold(quantity, !held), field);
    }
}

/// Size of a lock, or of the number that a quantity follows.
const HELD: [f32; 2] = [62.0, 22.0];

/// Parses a text with or without unit. Returns the value in SI units if it is in the accepted range.
fn read(text: &str, quantity: Quantity, contact: ContactKind, system: UnitSystem) -> Result<f64, Refusal> {
    let kind = quantity.kind(contact);
    let value = kind.read(text, system)?;
    let (low, high) = quantity.range();
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    let [low, high] = [low, high].map(|end| numbers::in_field_unit(kind, end, system));
    let value = numbers::in_field_unit(kind, value, system);
    Err(Refusal::new(format!("{} is {value}; {low} to {high} are accepted", quantity.name())))
}

fn hertz_ui(ui: &mut Ui, context: &Context<'_>) {
    let (point, system) = (&context.document.point, context.system);
    let hertz = point.hertz();
    let (width_name, width_tip, pressure_tip, stiffening_tip) = match Shape::of(point) {
        Shape::Roller => (
            "Half width",
            "Hertzian half width, a² = 8wR/(πE’) (2.21)",
            "Maximum pressure of the dry contact, p_H² = wE’/(2πR) (2.21)",
            "Piezoviscous parameter α p_H = L √(M/2π): the exponent of Barus’ law at the Hertzian pressure",
        ),
        Shape::Ball => (
            "Radius",
            "Radius of the Hertzian circle, a³ = 3wR/(2E’) (2.21)",
            "Maximum pressure of the dry contact, p_H = 3w/(2πa²) (2.21)",
            "Piezoviscous parameter α p_H = L (3M/2π³)^⅓: the exponent of Barus’ law at the Hertzian pressure",
        ),
        Shape::Ellipse => (
            "Semi-axes",
            "Semi-axes of the Hertzian ellipse along and across the rolling direction, and κ = b/a, which depends only \
             on R_y/R",
            "Maximum pressure of the dry contact, p_H = 3w/(2πab)",
            "Piezoviscous parameter α p_H: the exponent of Barus’ law at the Hertzian pressure",
        ),
    };
    let width = match Shape::of(point) {
        Shape::Ellipse => {
            let [a, b] = [hertz.half_width_m, hertz.half_length_m].map(|axis| numbers::length(axis, system));
            format!("{a}, {b}; κ {}", numbers::digits(point.ellipse().kappa, 3))
        }
        _ => numbers::length(hertz.half_width_m, system),
    };
    let axes = if Shape::of(point) == Shape::Ellipse { "a, b" } else { "a" };
    ui.add_space(4.0);
    Grid::new("hertz").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 3.0]).show(ui, |ui| {
        let shear = engineering::largest_shear(point, 0.3);
        let deepest = format!(
            "{} at {}",
            numbers::pressure(shear.over_hertz_pressure * hertz.pressure_pa, system),
            numbers::length(shear.depth_over_half_width * hertz.half_width_m, system)
        );
        let shear_tip =
            "Maximum subsurface shear stress of the dry contact and its depth, where rolling fatigue begins; ν = 0.3";
        let rows = [
            ((width_name, axes, ""), width, width_tip),
            (("Hertz pressure", "p", "H"), numbers::pressure(hertz.pressure_pa, system), pressure_tip),
            (("Piezoviscous", "αp", "H"), numbers::significant(point.alpha_hertz()), stiffening_tip),
            (("Max. shear", "τ", "max"), deepest, shear_tip),
        ];
        for ((name, base, subscript), value, tip) in rows {
            explained(ui, name_and_symbol(ui, name, base, subscript), tip);
            ui.label(value).on_hover_text(tip);
            ui.end_row();
        }
    });
    reserved(ui, 1, |ui| {
        if let Some(warning) = Warning::of_hertz_pressure(hertz.pressure_pa) {
            // The full sentence is shown on hover.
            ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
            warning_ui(ui, &warning.to_string());
        }
    });
}
