//! Form of a cam with its follower.

use super::field::{DEGREE, FORCE, Field, LENGTH, RPM};
use crate::app::controls::{Entries, NAME_WIDTH, choice, named};
use crate::solver::physics::engineering::{Dimension, QuantityKind};
use crate::solver::physics::machines::{CamFollower, Follower, Lift, lift_table};
use egui::{FontId, Grid, ScrollArea, TextEdit, Ui};

/// Name of the text of the lift table.
pub(super) const TABLE: &str = "Lift table";
/// Roller of a cam that had a flat follower.
const ROLLER: Follower = Follower::Roller { radius_m: 0.01 };

const FIELDS: [Field<CamFollower>; 11] = [
    Field {
        name: "Base circle radius",
        row: ("Base circle", "r", "b"),
        stored: LENGTH,
        tip: "Radius of the base circle",
        dimension: |_| Dimension::Length,
        get: |c| Some(c.base_radius_m),
        set: |c, value| c.base_radius_m = value,
    },
    Field {
        name: "Roller radius",
        row: ("Roller radius", "r", "r"),
        stored: LENGTH,
        tip: "Radius of the roller of the follower",
        dimension: |_| Dimension::Length,
        get: |c| if let Follower::Roller { radius_m } = c.follower { Some(radius_m) } else { None },
        set: |c, radius_m| c.follower = Follower::Roller { radius_m },
    },
    Field {
        name: "Largest lift",
        row: ("Lift", "L", ""),
        stored: LENGTH,
        tip: "Largest lift of the follower",
        dimension: |_| Dimension::Length,
        get: |c| if let Lift::Polynomial { lift_m, .. } = c.lift { Some(lift_m) } else { None },
        set: |c, value| {
            if let Lift::Polynomial { lift_m, .. } = &mut c.lift {
                *lift_m = value;
            }
        },
    },
    Field {
        name: "Half of the event",
        row: ("Half event", "β", ""),
        stored: DEGREE,
        tip: "Cam angle between the begin of the lift and its maximum",
        dimension: |_| Dimension::Angle,
        get: |c| if let Lift::Polynomial { half_event_deg, .. } = c.lift { Some(half_event_deg) } else { None },
        set: |c, value| {
            if let Lift::Polynomial { half_event_deg, .. } = &mut c.lift {
                *half_event_deg = value;
            }
        },
    },
    Field {
        name: "Eccentricity",
        row: ("Eccentricity", "e", ""),
        stored: LENGTH,
        tip: "Distance of the centre of the circular cam from its axis; the lift is 2e",
        dimension: |_| Dimension::Length,
        get: |c| if let Lift::Eccentric { eccentricity_m } = c.lift { Some(eccentricity_m) } else { None },
        set: |c, eccentricity_m| c.lift = Lift::Eccentric { eccentricity_m },
    },
    Field {
        name: "Cam width",
        row: ("Width", "b", ""),
        stored: LENGTH,
        tip: "Width of the contact between cam and follower",
        dimension: |_| Dimension::Length,
        get: |c| Some(c.width_m),
        set: |c, value| c.width_m = value,
    },
    Field {
        name: "Cam speed",
        row: ("Cam speed", "n", ""),
        stored: RPM,
        tip: "Speed of the cam",
        dimension: |_| Dimension::Rotation,
        get: |c| Some(c.rpm),
        set: |c, value| c.rpm = value,
    },
    Field {
        name: "Spring preload",
        row: ("Preload", "F", "0"),
        stored: FORCE,
        tip: "Force of the spring at zero lift",
        dimension: |_| Dimension::Force,
        get: |c| Some(c.preload_n),
        set: |c, value| c.preload_n = value,
    },
    Field {
        name: "Spring rate",
        row: ("Spring rate", "k", ""),
        stored: (QuantityKind::Stiffness, 1.0),
        tip: "Stiffness of the spring",
        dimension: |_| Dimension::Stiffness,
        get: |c| Some(c.spring_n_per_m),
        set: |c, value| c.spring_n_per_m = value,
    },
    Field {
        name: "Moving mass",
        row: ("Moving mass", "m", ""),
        stored: (QuantityKind::Mass, 1.0),
        tip: "Mass that moves with the follower, with a third of the spring",
        dimension: |_| Dimension::Mass,
        get: |c| Some(c.mass_kg),
        set: |c, value| c.mass_kg = value,
    },
    Field {
        name: "Cam angle",
        row: ("Cam angle", "θ", ""),
        stored: DEGREE,
        tip: "Cam angle of the contact; 0 is the nose of the laws of lift",
        dimension: |_| Dimension::Angle,
        get: |c| Some(c.angle_deg),
        set: |c, value| c.angle_deg = value,
    },
];

/// Draws the values of a cam. `table` is the text of its lift table. Returns true if a value was changed.
pub(super) fn ui(ui: &mut Ui, cam: &mut CamFollower, table: &mut String, entries: &mut Entries) -> bool {
    let before = cam.clone();
    Grid::new("cam").num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, |ui| {
        let flat = cam.follower == Follower::Flat;
        let mut chosen = flat;
        let tip = "Flat face, or a roller that does not slide";
        choice(ui, "Follower", tip, &mut chosen, &[true, false], |flat| {
            (if flat { "Flat follower" } else { "Roller follower" }, "")
        });
        if chosen != flat {
            cam.follower = if chosen { Follower::Flat } else { ROLLER };
        }
        let law = law_of(&cam.lift);
        let mut chosen = law;
        let tip = "Lift of the follower over the cam angle";
        choice(ui, "Law of lift", tip, &mut chosen, &[0, 1, 2], |law| match law {
            0 => ("Polynomial", "L (1 − (θ/β)²)³ between −β and β"),
            1 => ("Eccentric", "e (1 + cos θ): a circular cam"),
            _ => ("Table", "Cam angles in degrees and lifts in mm, joined by a cubic spline"),
        });
        if chosen != law {
            let known = before.lift.curve();
            cam.lift = match chosen {
                0 => Lift::Polynomial { lift_m: 7e-3, half_event_deg: 75.0 },
                1 => Lift::Eccentric { eccentricity_m: 3e-3 },
                // The table begins with the present law, every 5°.
                _ => Lift::Table(known.map_or_else(
                    |_| Vec::new(),
                    |curve| {
                        let degrees = (0..=72).map(|k| 5.0 * f64::from(k) - 180.0);
                        degrees.map(|degree| (degree, curve.at(degree.to_radians())[0])).collect()
                    },
                )),
            };
            *table = text_of(&cam.lift);
        }
    });
    if matches!(cam.lift, Lift::Table(_)) {
        ScrollArea::vertical().id_salt("lift table").max_height(110.0).show(ui, |ui| {
            let hint = "angle [°]; lift [mm]\n-70; 0\n-65; 0.002";
            let field = TextEdit::multiline(table).code_editor().hint_text(hint).desired_rows(5);
            let field = ui.add(field.desired_width(210.0).font(FontId::monospace(12.0)));
            if named(ui, field, TABLE).changed() {
                let read = lift_table(table);
                if let Ok(points) = &read {
                    cam.lift = Lift::Table(points.clone());
                }
                entries.answer(TABLE, read.map(drop).map_err(Into::into));
            }
        });
    }
    for field in &FIELDS {
        field.ui(ui, cam, entries);
    }
    *cam != before
}

fn law_of(lift: &Lift) -> u8 {
    match lift {
        Lift::Polynomial { .. } => 0,
        Lift::Eccentric { .. } => 1,
        Lift::Table(_) => 2,
    }
}

/// Returns a lift table as text; empty for a law.
pub(super) fn text_of(lift: &Lift) -> String {
    let Lift::Table(points) = lift else { return String::new() };
    points.iter().map(|(angle, lift)| format!("{angle}; {}\n", 1e3 * lift)).collect()
}

/// Names of the fields, for their messages.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    FIELDS.iter().map(|field| field.name).chain([TABLE])
}
