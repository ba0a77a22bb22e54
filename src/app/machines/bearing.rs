//! Form of a rolling bearing.

use super::field::{CLEARANCE, DEGREE, FORCE, Field, LENGTH, NUMBER, RPM, whole};
use crate::app::controls::{Entries, NAME_WIDTH, choice};
use crate::solver::physics::engineering::{Dimension, QuantityKind};
use crate::solver::physics::machines::{Bearing, Element, Race};
use egui::{Grid, Ui};

/// Rolling elements that can be chosen.
const ELEMENTS: [Element; 2] = [Element::BALL, Element::ROLLER];

const FIELDS: [Field<Bearing>; 14] = [
    Field {
        name: "Pitch diameter",
        row: ("Pitch diameter", "d", "m"),
        stored: LENGTH,
        tip: "Mean of the diameters of both raceways at their bottom",
        dimension: |_| Dimension::Length,
        get: |b| Some(b.pitch_diameter_m),
        set: |b, value| b.pitch_diameter_m = value,
    },
    Field {
        name: "Element diameter",
        row: ("Ball, roller", "D", ""),
        stored: LENGTH,
        tip: "Diameter of the balls or rollers",
        dimension: |_| Dimension::Length,
        get: |b| Some(b.element_diameter_m),
        set: |b, value| b.element_diameter_m = value,
    },
    Field {
        name: "Number of elements",
        row: ("Number", "Z", ""),
        stored: NUMBER,
        tip: "Number of balls or rollers",
        dimension: |_| Dimension::Ratio,
        get: |b| Some(f64::from(b.elements)),
        set: |b, value| b.elements = whole(value),
    },
    Field {
        name: "Inner conformity",
        row: ("Groove, inner", "f", "i"),
        stored: (QuantityKind::Percent, 1.0),
        tip: "Radius of the inner groove over the diameter of the ball, usually 51 to 53 %",
        dimension: |_| Dimension::Ratio,
        get: |b| ball(&mut { b.element }).map(|(inner, ..)| *inner),
        set: |b, value| _ = ball(&mut b.element).map(|(inner, ..)| *inner = value),
    },
    Field {
        name: "Outer conformity",
        row: ("Groove, outer", "f", "o"),
        stored: (QuantityKind::Percent, 1.0),
        tip: "Radius of the outer groove over the diameter of the ball, usually 51 to 54 %",
        dimension: |_| Dimension::Ratio,
        get: |b| ball(&mut { b.element }).map(|(_, outer, _)| *outer),
        set: |b, value| _ = ball(&mut b.element).map(|(_, outer, _)| *outer = value),
    },
    Field {
        name: "Contact angle",
        row: ("Contact angle", "α", ""),
        stored: DEGREE,
        tip: "Contact angle of the unloaded bearing without clearance; 0 for a deep-groove bearing",
        dimension: |_| Dimension::Angle,
        get: |b| ball(&mut { b.element }).map(|(.., angle)| *angle),
        set: |b, value| _ = ball(&mut b.element).map(|(.., angle)| *angle = value),
    },
    Field {
        name: "Roller length",
        row: ("Length", "l", ""),
        stored: LENGTH,
        tip: "Effective length of the rollers",
        dimension: |_| Dimension::Length,
        get: |b| roller(&mut { b.element }).map(|(length, _)| *length),
        set: |b, value| _ = roller(&mut b.element).map(|(length, _)| *length = value),
    },
    Field {
        name: "Crown radius",
        row: ("Crown radius", "", ""),
        stored: LENGTH,
        tip: "Radius of the crown of the rollers. The contact is then elliptical. “none” for a line contact",
        dimension: |_| Dimension::Length,
        get: |b| roller(&mut { b.element }).map(|(_, crown)| crown.unwrap_or(f64::INFINITY)),
        set: |b, value| _ = roller(&mut b.element).map(|(_, crown)| *crown = Some(value).filter(|v| v.is_finite())),
    },
    Field {
        name: "Diametral clearance",
        row: ("Clearance", "P", "d"),
        stored: CLEARANCE,
        tip: "Diametral clearance of the mounted bearing; negative for a radial preload",
        dimension: |_| Dimension::Length,
        get: |b| Some(b.clearance_m),
        set: |b, value| b.clearance_m = value,
    },
    Field {
        name: "Inner speed",
        row: ("Inner speed", "n", "i"),
        stored: RPM,
        tip: "Speed of the inner ring",
        dimension: |_| Dimension::Rotation,
        get: |b| Some(b.inner_rpm),
        set: |b, value| b.inner_rpm = value,
    },
    Field {
        name: "Outer speed",
        row: ("Outer speed", "n", "o"),
        stored: RPM,
        tip: "Speed of the outer ring",
        dimension: |_| Dimension::Rotation,
        get: |b| Some(b.outer_rpm),
        set: |b, value| b.outer_rpm = value,
    },
    Field {
        name: "Radial load",
        row: ("Radial load", "F", "r"),
        stored: FORCE,
        tip: "Radial load of the bearing",
        dimension: |_| Dimension::Force,
        get: |b| Some(b.radial_n),
        set: |b, value| b.radial_n = value,
    },
    Field {
        name: "Axial load",
        row: ("Axial load", "F", "a"),
        stored: FORCE,
        tip: "Axial load of the bearing",
        dimension: |_| Dimension::Force,
        get: |b| ball(&mut { b.element }).map(|_| b.axial_n),
        set: |b, value| b.axial_n = value,
    },
    Field {
        name: "Orbit angle",
        row: ("Orbit angle", "ψ", ""),
        stored: DEGREE,
        tip: "Angle of the element from the direction of the radial load; 0 is the heaviest contact",
        dimension: |_| Dimension::Angle,
        get: |b| Some(b.orbit_deg),
        set: |b, value| b.orbit_deg = value,
    },
];

fn ball(element: &mut Element) -> Option<(&mut f64, &mut f64, &mut f64)> {
    match element {
        Element::Ball { inner_conformity, outer_conformity, contact_angle_deg } => {
            Some((inner_conformity, outer_conformity, contact_angle_deg))
        }
        Element::Roller { .. } => None,
    }
}

fn roller(element: &mut Element) -> Option<(&mut f64, &mut Option<f64>)> {
    match element {
        Element::Roller { length_m, crown_radius_m } => Some((length_m, crown_radius_m)),
        Element::Ball { .. } => None,
    }
}

/// Draws the values of a bearing. Returns true if one was changed.
pub(super) fn ui(ui: &mut Ui, bearing: &mut Bearing, entries: &mut Entries) -> bool {
    let before = *bearing;
    Grid::new("bearing").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let tip = "Balls in grooves, or cylindrical rollers with or without a crown";
        let mut chosen = ELEMENTS.into_iter().position(|element| same_kind(element, bearing.element)).unwrap_or(0);
        let was = chosen;
        choice(ui, "Elements", tip, &mut chosen, &[0, 1], |k| (["Balls", "Cylindrical rollers"][k.min(1)], ""));
        if chosen != was {
            bearing.element = ELEMENTS[chosen.min(1)];
            bearing.axial_n = if chosen == 1 { 0.0 } else { bearing.axial_n };
        }
        let tip = "Ring whose contact is computed";
        choice(ui, "Ring", tip, &mut bearing.race, &[Race::Inner, Race::Outer], |race| match race {
            Race::Inner => ("Inner ring", ""),
            Race::Outer => ("Outer ring", ""),
        });
    });
    for field in &FIELDS {
        field.ui(ui, bearing, entries);
    }
    *bearing != before
}

fn same_kind(one: Element, other: Element) -> bool {
    matches!(one, Element::Ball { .. }) == matches!(other, Element::Ball { .. })
}

/// Names of the fields, for their messages.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FIELDS.iter().map(|field| field.name)
}
