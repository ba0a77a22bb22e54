//! Input form of a gear pair in the machine window. Each row of the form edits one parameter of a [`GearPair`].

use super::field::{DEGREE, Field, LENGTH, NUMBER, RPM, whole};
use crate::app::controls::Entries;
use crate::solver::physics::engineering::{Dimension, QuantityKind};
use crate::solver::physics::machines::GearPair;
use egui::Ui;
use std::f64::consts::PI;

/// Rows of the form, from top to bottom.
const FIELDS: [Field<GearPair>; 11] = [
    Field {
        name: "Teeth of the pinion",
        row: ("Pinion teeth", "z", "1"),
        stored: NUMBER,
        tip: "Number of teeth of the pinion, which drives. It is body 1",
        dimension: |_| Dimension::Ratio,
        get: |p| Some(f64::from(p.teeth.0)),
        set: |p, value| p.teeth.0 = whole(value),
    },
    Field {
        name: "Teeth of the wheel",
        row: ("Wheel teeth", "z", "2"),
        stored: NUMBER,
        tip: "Number of teeth of the wheel. It is body 2",
        dimension: |_| Dimension::Ratio,
        get: |p| Some(f64::from(p.teeth.1)),
        set: |p, value| p.teeth.1 = whole(value),
    },
    Field {
        name: "Module",
        row: ("Module", "m", "n"),
        stored: LENGTH,
        tip: "Normal module",
        dimension: |_| Dimension::Length,
        get: |p| Some(p.module_m),
        set: |p, value| p.module_m = value,
    },
    Field {
        name: "Pressure angle",
        row: ("Pressure angle", "α", "n"),
        stored: DEGREE,
        tip: "Normal pressure angle of the basic rack, usually 20°",
        dimension: |_| Dimension::Angle,
        get: |p| Some(p.pressure_angle_deg),
        set: |p, value| p.pressure_angle_deg = value,
    },
    Field {
        name: "Helix angle",
        row: ("Helix angle", "β", ""),
        stored: DEGREE,
        tip: "Helix angle at the reference cylinder; 0 for spur gears",
        dimension: |_| Dimension::Angle,
        get: |p| Some(p.helix_angle_deg),
        set: |p, value| p.helix_angle_deg = value,
    },
    Field {
        name: "Profile shift of the pinion",
        row: ("Profile shift", "x", "1"),
        stored: NUMBER,
        tip: "Profile shift coefficient of the pinion. Both shifts determine the centre distance without backlash",
        dimension: |_| Dimension::Ratio,
        get: |p| Some(p.shifts.0),
        set: |p, value| p.shifts.0 = value,
    },
    Field {
        name: "Profile shift of the wheel",
        row: ("Profile shift", "x", "2"),
        stored: NUMBER,
        tip: "Profile shift coefficient of the wheel",
        dimension: |_| Dimension::Ratio,
        get: |p| Some(p.shifts.1),
        set: |p, value| p.shifts.1 = value,
    },
    Field {
        name: "Face width",
        row: ("Face width", "b", ""),
        stored: LENGTH,
        tip: "Common face width of both gears",
        dimension: |_| Dimension::Length,
        get: |p| Some(p.face_width_m),
        set: |p, value| p.face_width_m = value,
    },
    Field {
        name: "Pinion speed",
        row: ("Pinion speed", "n", "1"),
        stored: RPM,
        tip: "Speed of the pinion",
        dimension: |_| Dimension::Rotation,
        get: |p| Some(p.pinion_rpm),
        set: |p, value| p.pinion_rpm = value,
    },
    Field {
        name: "Pinion torque",
        row: ("Torque, power", "T", "1"),
        stored: (QuantityKind::Torque, 1.0),
        tip: "Torque on the pinion, or the transmitted power with its unit: 30 kW",
        dimension: |p| Dimension::Torque { turning: Some(p.pinion_rpm * PI / 30.0) },
        get: |p| Some(p.torque_n_m),
        set: |p, value| p.torque_n_m = value,
    },
    Field {
        name: "Distance from the pitch point",
        row: ("Position", "g", ""),
        stored: LENGTH,
        tip: "Distance from the pitch point along the path of contact; negative where the teeth approach",
        dimension: |_| Dimension::Length,
        get: |p| Some(p.position_m),
        set: |p, value| p.position_m = value,
    },
];

/// Draws the form of a gear pair. Returns true if the user changed a value.
pub(super) fn ui(ui: &mut Ui, pair: &mut GearPair, entries: &mut Entries) -> bool {
    let before = *pair;
    for field in &FIELDS {
        field.ui(ui, pair, entries);
    }
    *pair != before
}

/// Returns the accessible names of the rows, by which the window finds the messages about typed values.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FIELDS.iter().map(|field| field.name)
}
