//! Reasons why a bearing, a gear pair or a cam is refused, and the check of a value against its range.

use crate::solver::limits::digits;

/// Reason why a machine element has no contact to compute.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MachineError {
    /// A value lies outside the accepted range.
    #[error("the {name} is {}{unit}, but must be between {}{unit} and {}{unit}", digits(*.value), digits(*.min), digits(*.max))]
    Range {
        /// Name of the value.
        name: &'static str,
        /// Value in the unit of the message.
        value: f64,
        /// Unit with a leading space, or empty.
        unit: &'static str,
        /// Smallest accepted value.
        min: f64,
        /// Largest accepted value.
        max: f64,
    },
    /// Rolling elements do not fit between the rings.
    #[error(
        "{elements} elements of {diameter:.4} mm do not fit on a pitch diameter of {pitch:.4} mm: at most {most} do"
    )]
    Crowded {
        /// Number of elements.
        elements: u32,
        /// Diameter of an element \[mm\].
        diameter: f64,
        /// Pitch diameter \[mm\].
        pitch: f64,
        /// Largest number of elements that fits.
        most: u32,
    },
    /// Both rings turn together.
    #[error("both rings turn at {0} rpm, so nothing rolls; inner and outer speed must differ")]
    NothingRolls(f64),
    /// The bearing carries no load.
    #[error("the bearing carries no load; give a radial or an axial load above 0 N")]
    NoLoad,
    /// A cylindrical roller bearing with an axial load.
    #[error("a cylindrical roller bearing carries no axial load over its rollers; set the axial load to 0 N")]
    AxialOnRollers,
    /// An angular-contact bearing without an axial load.
    #[error(
        "an angular-contact bearing without axial load loses its contact angle; give an axial load, or a contact angle of 0°"
    )]
    NoAxialLoad,
    /// The equilibrium of the ring was not found.
    #[error("the equilibrium of the ring was not found; check loads and clearance")]
    NoEquilibrium,
    /// The rolling element carries no load at this orbit angle.
    #[error("the element carries no load at an orbit angle of {angle:.1}°; the loaded zone is ±{zone:.1}°")]
    Unloaded {
        /// Orbit angle \[°\].
        angle: f64,
        /// Half of the angle of the loaded zone \[°\].
        zone: f64,
    },
    /// The cage does not turn.
    #[error("the cage stands still at these speeds, so that there is no path over the orbit angle")]
    CageStands,
    /// The teeth are undercut.
    #[error("the {gear} with {teeth} teeth is undercut: its profile shift is {shift}, but must be at least {least:.3}")]
    Undercut {
        /// Pinion or wheel.
        gear: &'static str,
        /// Number of teeth.
        teeth: u32,
        /// Profile shift coefficient.
        shift: f64,
        /// Smallest profile shift coefficient without undercut.
        least: f64,
    },
    /// The teeth end in a point below the tip circle.
    #[error("the teeth of the {gear} are pointed below the tip circle: its profile shift of {shift} is too large")]
    Pointed {
        /// Pinion or wheel.
        gear: &'static str,
        /// Profile shift coefficient.
        shift: f64,
    },
    /// No position without backlash exists.
    #[error("profile shifts of {0} and {1} leave no centre distance at which the teeth mesh; their sum must be larger")]
    NoMesh(f64, f64),
    /// A tip reaches below the base circle of the other gear.
    #[error("the tip of the {gear} reaches below the base circle of the other gear; reduce its profile shift")]
    Interference {
        /// Pinion or wheel.
        gear: &'static str,
    },
    /// The contact ratio is not covered.
    #[error("the transverse contact ratio is {0:.3}, but must be at least 1 and below 2")]
    ContactRatio(f64),
    /// The position lies beyond the path of contact.
    #[error(
        "the position is {position:.3} mm from the pitch point, but the path of contact is {from:.3} mm to {to:.3} mm"
    )]
    OffThePath {
        /// Position along the path, from the pitch point \[mm\].
        position: f64,
        /// Start of the path of contact, from the pitch point \[mm\].
        from: f64,
        /// End of the path of contact, from the pitch point \[mm\].
        to: f64,
    },
    /// The radius of curvature of the cam is not accepted.
    #[error("at a cam angle of {angle:.1}° the cam has a radius of curvature of {radius:.3} mm; {remedy}")]
    Profile {
        /// Cam angle \[°\].
        angle: f64,
        /// Radius of curvature \[mm\].
        radius: f64,
        /// What is accepted.
        remedy: &'static str,
    },
    /// The follower leaves the cam.
    #[error(
        "at a cam angle of {angle:.1}° the follower leaves the cam: the spring gives {spring:.1} N, inertia needs {inertia:.1} N"
    )]
    Separation {
        /// Cam angle \[°\].
        angle: f64,
        /// Force of the spring \[N\].
        spring: f64,
        /// Force that the deceleration needs \[N\].
        inertia: f64,
    },
    /// The lift table is refused.
    #[error("lift table, line {line}: {problem}")]
    LiftLine {
        /// Line from 1.
        line: usize,
        /// What is wrong, and what is accepted.
        problem: &'static str,
    },
    /// The lift table is too short or too long.
    #[error("the lift table has {0} points, but must have 8 to 4000")]
    LiftPoints(usize),
}

/// Refuses a value outside a range. `value / scale`, `min` and `max` are in the unit of the message, `unit`.
pub(super) fn check(
    name: &'static str,
    value: f64,
    (unit, scale): (&'static str, f64),
    (min, max): (f64, f64),
) -> Result<(), MachineError> {
    let value = value / scale;
    if (min..=max).contains(&value) { Ok(()) } else { Err(MachineError::Range { name, value, unit, min, max }) }
}
