//! The same state in SI units beside the sliders, what follows what, and the Hertzian contact behind it.

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
use crate::solver::parameters::Quantity;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::engineering;
use egui::{Grid, RichText, TextWrapMode, Ui};

/// What there is to choose from, and what it is.
const SHAPES: [(Shape, &str); 3] = [
    (
        Shape::Roller,
        "A line contact: a long roller on a raceway, with its load per unit length, the same at every Y. \
        All stays but the load, which follows M",
    ),
    (
        Shape::Ball,
        "A circular point contact: a ball on a disc, the film with its horseshoe and side lobes. \
        All stays but the load of a line, which follows M",
    ),
    (
        Shape::Ellipse,
        "A point contact with a radius across the rolling direction of its own: a ball in a groove, a crowned roller. \
        R_y/R runs from 0.02 over 1, the circle, to 500, which is nearly a line",
    ),
];
/// Under this name the choice between them is refused.
pub const SHAPE: &str = "shape of the contact";

/// The panel's first group.
pub fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    heading(ui, "Operating point");
    shape_ui(ui, Shape::of(&context.document.point), commands);
    sliders::column(ui, context, entries, commands);
    followers_ui(ui, context.document, commands);
    si_ui(ui, context.document, entries, commands);
    hertz_ui(ui, context.document);
}

/// Roller, ball or ellipse.
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
pub const FIELDS: [(Quantity, &str); 7] = [
    (Quantity::Radius, "Radius R"),
    (Quantity::RadiusY, "Across R_y"),
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
            if quantity == Quantity::RadiusY && Shape::of(&document.point) == Shape::Ball {
                ui.add_sized(HELD, egui::Label::new(RichText::new("as R").small().weak()))
                    .on_hover_text("A ball is as round across as along; another value makes it an ellipse");
                return;
            }
            held_ui(ui, document, (quantity, field), commands);
        });
    }
    entries.reserved_ui(ui, FIELDS.map(|(_, field)| field).into_iter().chain(sliders::FIELDS).chain([SHAPE]));
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
fn read(text: &str, quantity: Quantity, kind: ContactKind) -> Result<f64, Refusal> {
    let (unit, scale) = quantity.reading_unit(kind);
    let value = engineering::parse(text, quantity.dimension(kind), unit)?;
    let (low, high) = quantity.range();
    if (low..=high).contains(&value) {
        return Ok(value);
    }
    let [low, high] = [low, high].map(|end| numbers::quantity(end / scale, unit));
    let value = numbers::quantity(value / scale, unit);
    Err(Refusal::new(format!("{} is {value}; {low} to {high} are accepted", quantity.name())))
}

fn hertz_ui(ui: &mut Ui, document: &Document) {
    let point = &document.point;
    let hertz = point.hertz();
    let (width_name, width_tip, pressure_tip, stiffening_tip) = match Shape::of(point) {
        Shape::Roller => (
            "Half width",
            "Hertzian half width, a² = 8wR/(πE’) (2.21)",
            "Largest pressure of the dry contact, p_H² = wE’/(2πR) (2.21)",
            "α p_H = L √(M/2π): the exponent of Barus’ law at the Hertzian pressure",
        ),
        Shape::Ball => (
            "Radius",
            "Radius of the Hertzian circle, a³ = 3wR/(2E’) (2.21)",
            "Largest pressure of the dry contact, p_H = 3w/(2πa²) (2.21)",
            "α p_H = L (3M/2π³)^⅓: the exponent of Barus’ law at the Hertzian pressure",
        ),
        Shape::Ellipse => (
            "Semi-axes",
            "Semi-axes of the Hertzian ellipse along and across the rolling direction, and κ = b/a, which R_y/R alone decides",
            "Largest pressure of the dry contact, p_H = 3w/(2πab)",
            "α p_H: the exponent of Barus’ law at the Hertzian pressure",
        ),
    };
    let width = match Shape::of(point) {
        Shape::Ellipse => {
            let [a, b] = [hertz.half_width_m, hertz.half_length_m].map(numbers::length);
            format!("{a}, {b}; κ {}", numbers::digits(point.ellipse().kappa, 3))
        }
        _ => numbers::length(hertz.half_width_m),
    };
    let axes = if Shape::of(point) == Shape::Ellipse { "a, b" } else { "a" };
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
            ((width_name, axes, ""), width, width_tip),
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
        if let Some(warning) = Warning::of_hertz_pressure(hertz.pressure_pa) {
            // The rest of the sentence is read under the pointer.
            ui.style_mut().wrap_mode = Some(TextWrapMode::Truncate);
            warning_ui(ui, &warning.to_string());
        }
    });
}
