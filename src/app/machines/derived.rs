//! Values that follow from a machine, shown next to its form.

use crate::app::numbers::{length, pressure, quantity};
use crate::app::refusal::Refusal;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::machines::{Machine, MachineContact};

/// Row of the derived values: name, value, tooltip.
pub(super) type Row = (&'static str, String, &'static str);

/// Returns the values of the contact.
pub(super) fn of_contact(point: &OperatingPoint, contact: &MachineContact) -> Vec<Row> {
    let hertz = point.hertz();
    let [first, second] = point.surface_speeds();
    let mut rows = vec![("R", length(point.radius_m), "Reduced radius along the rolling direction")];
    if let Some(radius_y) = point.radius_y_m {
        rows.push(("R_y", length(radius_y), "Reduced radius across the rolling direction"));
    }
    rows.extend([
        ("u_1", quantity(first, "m/s"), "Speed of body 1 relative to the contact"),
        ("u_2", quantity(second, "m/s"), "Speed of body 2 relative to the contact"),
        ("u_m", quantity(point.speed_m_per_s, "m/s"), "Mean entrainment speed"),
        ("SRR", quantity(100.0 * point.sliding.slide_to_roll_ratio, "%"), "(u₂ − u₁)/u_m"),
    ]);
    rows.push(match point.kind {
        ContactKind::Line => ("w", quantity(1e-3 * point.load, "N/mm"), "Load per length"),
        ContactKind::Point => ("w", quantity(point.load, "N"), "Load of this contact"),
    });
    if let Some(long) = contact.length_m {
        rows.push(("Force", quantity(point.load * long, "N"), "Load per length times the length of the contact"));
    }
    rows.push(("p_H", pressure(hertz.pressure_pa), "Hertzian pressure"));
    rows
}

/// Returns the values of the machine.
///
/// # Errors
/// A sentence if the machine does not exist.
pub(super) fn of_machine(machine: &Machine, modulus_pa: f64) -> Result<Vec<Row>, Refusal> {
    Ok(match machine {
        Machine::Bearing(bearing) => {
            let state = bearing.state(modulus_pa)?;
            let degrees = |angle: f64| quantity(angle.to_degrees(), "°");
            vec![
                ("Q_max", quantity(state.largest_load_n, "N"), "Load of the heaviest element"),
                ("Contact angle", degrees(state.contact_angle), "Contact angle of the heaviest element under load"),
                (
                    "Loaded zone",
                    format!("±{}", degrees(state.loaded_zone)),
                    "Orbit angles at which elements carry load",
                ),
                ("Cage", quantity(state.cage_speed * 30.0 / std::f64::consts::PI, "rpm"), "Speed of the cage"),
            ]
        }
        Machine::Gear(pair) => {
            let geometry = pair.geometry()?;
            vec![
                ("Centre distance", length(geometry.centre_distance_m), "Without backlash"),
                (
                    "Working angle",
                    quantity(geometry.working_angle.to_degrees(), "°"),
                    "Working transverse pressure angle",
                ),
                ("ε_α", quantity(geometry.contact_ratio, ""), "Transverse contact ratio"),
                ("ε_β", quantity(geometry.overlap_ratio, ""), "Overlap ratio"),
                (
                    "Load share",
                    quantity(100.0 * geometry.share(pair.position_m), "%"),
                    "Share of a single pair of spur teeth",
                ),
            ]
        }
        Machine::Cam(cam) => {
            let state = cam.state()?;
            vec![
                ("Lift", length(state.lift_m), "Lift at this cam angle"),
                ("Acceleration", quantity(state.acceleration, "m/s²"), "Acceleration of the follower"),
                ("Pressure angle", quantity(state.pressure_angle.to_degrees(), "°"), "Between force and motion"),
            ]
        }
    })
}
