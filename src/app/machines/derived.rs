//! Values that follow from a machine, shown next to its form.

use crate::app::numbers::{self, in_field_unit, quantity, slide_to_roll};
use crate::app::refusal::Refusal;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::{QuantityKind, UnitSystem};
use crate::solver::physics::machines::{Machine, MachineContact};

/// Row of the derived values: name, value, tooltip.
pub(super) type Row = (&'static str, String, &'static str);

/// Returns the values of the contact.
pub(super) fn of_contact(point: &OperatingPoint, contact: &MachineContact, system: UnitSystem) -> Vec<Row> {
    let length = |metre: f64| numbers::length(metre, system);
    let speed = |si: f64| in_field_unit(QuantityKind::Speed, si, system);
    let hertz = point.hertz();
    let [first, second] = point.surface_speeds();
    let mut rows = vec![("R", length(point.radius_m), "Reduced radius along the rolling direction")];
    if let Some(radius_y) = point.radius_y_m {
        rows.push(("R_y", length(radius_y), "Reduced radius across the rolling direction"));
    }
    rows.extend([
        ("u_1", speed(first), "Speed of body 1 relative to the contact"),
        ("u_2", speed(second), "Speed of body 2 relative to the contact"),
        ("u_m", speed(point.speed_m_per_s), "Mean entrainment speed"),
        ("SRR", slide_to_roll(point.sliding.slide_to_roll_ratio), "(u₂ − u₁)/u_m"),
    ]);
    let load = if point.kind.is_line() { "Load per length" } else { "Load of this contact" };
    rows.push(("w", numbers::load(point.load, point.kind, system), load));
    if let Some(long) = contact.length_m {
        rows.push((
            "Force",
            in_field_unit(QuantityKind::Force, point.load * long, system),
            "Load per length times the length of the contact",
        ));
    }
    rows.push(("p_H", numbers::pressure(hertz.pressure_pa, system), "Hertzian pressure"));
    rows
}

/// Returns the values of the machine.
///
/// # Errors
/// A sentence if the machine does not exist.
pub(super) fn of_machine(machine: &Machine, modulus_pa: f64, system: UnitSystem) -> Result<Vec<Row>, Refusal> {
    let shown = |kind, si| in_field_unit(kind, si, system);
    let length = |metre: f64| numbers::length(metre, system);
    let angle = |radians: f64| shown(QuantityKind::Angle, radians);
    Ok(match machine {
        Machine::Bearing(bearing) => {
            let state = bearing.state(modulus_pa)?;
            vec![
                ("Q_max", shown(QuantityKind::Force, state.largest_load_n), "Load of the heaviest element"),
                ("Contact angle", angle(state.contact_angle), "Contact angle of the heaviest element under load"),
                ("Loaded zone", format!("±{}", angle(state.loaded_zone)), "Orbit angles at which elements carry load"),
                ("Cage", shown(QuantityKind::Rotation, state.cage_speed), "Speed of the cage"),
            ]
        }
        Machine::Gear(pair) => {
            let geometry = pair.geometry()?;
            vec![
                ("Centre distance", length(geometry.centre_distance_m), "Without backlash"),
                ("Working angle", angle(geometry.working_angle), "Working transverse pressure angle"),
                ("ε_α", quantity(geometry.contact_ratio, ""), "Transverse contact ratio"),
                ("ε_β", quantity(geometry.overlap_ratio, ""), "Overlap ratio"),
                (
                    "Load share",
                    shown(QuantityKind::Percent, geometry.share(pair.position_m)),
                    "Share of a single pair of spur teeth",
                ),
            ]
        }
        Machine::Cam(cam) => {
            let state = cam.state()?;
            vec![
                ("Lift", length(state.lift_m), "Lift at this cam angle"),
                ("Acceleration", shown(QuantityKind::Acceleration, state.acceleration), "Acceleration of the follower"),
                ("Pressure angle", angle(state.pressure_angle), "Between force and motion"),
            ]
        }
    })
}
