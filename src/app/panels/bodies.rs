//! Panel of the two bodies: materials, radii and surface speeds. They determine R, R_y, E′, u_m, SRR and, for a
//! thermal contact, the thermal constants.

use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{Entries, named, ringed, row_name, typed_field, warning_ui};
use crate::app::document::{Document, Edit};
use crate::app::machines::MachineKind;
use crate::app::theme::name_and_symbol;
use crate::solver::physics::bodies::{Bodies, Body, MATERIALS, Material};
use crate::solver::physics::engineering::{self, Dimension, QuantityKind, UnitSystem};
use egui::{CollapsingHeader, ComboBox, Ui};

/// Name under which refusals of the bodies are stored.
const GROUP: &str = "bodies";

/// Value of a body that can be typed.
struct Field {
    names: [&'static str; 2],
    row: &'static str,
    kind: QuantityKind,
    tip: &'static str,
    dimension: fn(&Body) -> Dimension,
    get: fn(&Body) -> Option<f64>,
    set: fn(&mut Body, Option<f64>),
}

const ROWS: [Field; 3] = [
    Field {
        names: ["Radius of body 1", "Radius of body 2"],
        row: "Radius",
        kind: QuantityKind::Length,
        tip: "Radius of curvature along the rolling direction; negative for a concave surface, “plane” for none (2.3)",
        dimension: |_| Dimension::Length,
        get: |body| body.radius_m,
        set: |body, radius| body.radius_m = radius,
    },
    Field {
        names: ["Radius across of body 1", "Radius across of body 2"],
        row: ACROSS,
        kind: QuantityKind::Length,
        tip: "Radius of curvature across the rolling direction; negative for a groove, “plane” for none. If it equals \
              the radius along, the body is round and stays round",
        dimension: |_| Dimension::Length,
        get: Body::transverse_radius_m,
        set: |body, radius| *body = body.with_transverse_radius_m(radius),
    },
    Field {
        names: ["Speed of body 1", "Speed of body 2"],
        row: "Speed",
        kind: QuantityKind::Speed,
        tip: "Speed of the surface through the contact; “1500 rpm” of a body with a radius (2.1)",
        dimension: |body| Dimension::Speed { radius_m: body.radius_m.map(f64::abs) },
        get: |body| Some(body.speed_m_per_s),
        set: |body, speed| body.speed_m_per_s = speed.unwrap_or(body.speed_m_per_s),
    },
];

/// Row shown only for point contacts.
const ACROSS: &str = "Across";

/// Draws the group. It is collapsed until bodies have been entered.
pub fn ui(ui: &mut Ui, context: &Context<'_>, entries: &mut Entries, commands: &mut Commands) {
    let document = context.document;
    let bodies = CollapsingHeader::new("Two bodies").default_open(document.view.bodies.is_some());
    let shown = bodies.show(ui, |ui| {
        let before = document.bodies();
        let mut wanted = before;
        let mut field = materials_ui(ui, &mut wanted);
        let line = document.point.kind.is_line();
        for row in ROWS.iter().filter(|row| !(line && row.row == ACROSS)) {
            field = row.ui(ui, &mut wanted, context.system, entries).or(field);
        }
        if let Some(field) = field.filter(|_| wanted != before) {
            commands.edit(Edit::Bodies(wanted), field);
        }
        machines_ui(ui, document, commands);
        if document.view.bodies.is_some() && document.bodies_in_force().is_none() {
            warning_ui(
                ui,
                "R, R_y, E’, u_m, SRR or thermal constants have been changed and no longer match these bodies",
            );
            if ui.button("Use the bodies’ values").clicked()
                && let Some(entered) = document.view.bodies
            {
                commands.edit(Edit::Bodies(entered), GROUP);
            }
        }
        entries.reserved_ui(ui, ROWS.iter().flat_map(|row| row.names).chain([GROUP]));
    });
    ringed(ui, shown.header_response, "Two bodies");
}

/// Draws the buttons that open the forms of the machines.
fn machines_ui(ui: &mut Ui, document: &Document, commands: &mut Commands) {
    ui.horizontal_wrapped(|ui| {
        for kind in MachineKind::ALL {
            if ui.button(kind.title()).on_hover_text(kind.tip()).clicked() {
                commands.push(Command::Machine(kind));
            }
        }
    });
    if let Some(machine) = document.view.machine.as_ref().filter(|_| document.machine_counts()) {
        ui.weak(format!("These are the bodies of a {}", machine.name()));
    }
}

fn materials_ui(ui: &mut Ui, bodies: &mut Bodies) -> Option<&'static str> {
    let mut chosen = None;
    ui.horizontal(|ui| {
        row_name(
            ui,
            name_and_symbol(ui, "Material", "", ""),
            "E and ν determine E’ (2.5). With Heat, k, c and ρ are used as well",
        );
        for (body, name) in bodies.0.iter_mut().zip(["Material of body 1", "Material of body 2"]) {
            // E of a body that was not entered follows from E’ and differs slightly from that of its material.
            let near = |material: &Material| (body.modulus_pa / material.modulus_pa - 1.0).abs() < 0.01;
            let present = body.material().or(body.heat.material().filter(near));
            let text = present.map_or("Own", |material| material.name);
            let response = ComboBox::from_id_salt(name).width(78.0).selected_text(text).show_ui(ui, |ui| {
                for material in MATERIALS {
                    let label = ui.selectable_label(present == Some(material), material.name);
                    if label.on_hover_text(material.describe()).clicked() {
                        *body = body.of(material);
                        chosen = Some(GROUP);
                    }
                }
            });
            named(ui, response.response, name);
        }
    });
    chosen
}

impl Field {
    /// Draws the values of both bodies. Returns the name of the field that was changed.
    fn ui(&self, ui: &mut Ui, bodies: &mut Bodies, system: UnitSystem, entries: &mut Entries) -> Option<&'static str> {
        let mut entered = None;
        let unit = self.kind.unit(system);
        ui.horizontal(|ui| {
            row_name(ui, name_and_symbol(ui, self.row, "", ""), self.tip);
            for (body, name) in bodies.0.iter_mut().zip(self.names) {
                let dimension = (self.dimension)(body);
                // A plane has no radius. It is shown and typed as infinite.
                let read = |text: &str| match text.trim().to_lowercase().as_str() {
                    "plane" | "flat" | "∞" | "inf" => Ok(f64::INFINITY),
                    _ => Ok(unit.number(engineering::parse(text, dimension, unit.name)?)),
                };
                let value = (self.get)(body).map_or(f64::INFINITY, |si| unit.number(si));
                if let Some(typed) = typed_field(ui, entries, name, value, 66.0, self.tip, read) {
                    (self.set)(body, Some(unit.si(typed)).filter(|si| si.is_finite()));
                    entered = Some(name);
                }
            }
            ui.label(unit.name);
        });
        entered
    }
}
