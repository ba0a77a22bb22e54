//! Kinds of contact.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Kind of contact: an infinitely long line contact, or a circular or elliptical point contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum ContactKind {
    /// Line contact: loads in N/m, unknowns along X only.
    #[default]
    Line,
    /// Point contact, circular or elliptical: loads in N.
    Point,
}

impl ContactKind {
    /// Both kinds.
    pub const BOTH: [Self; 2] = [Self::Line, Self::Point];

    /// Returns its name in options and results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Point => "point",
        }
    }

    /// Returns the kind with this [name](Self::name); `None` if there is none.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::BOTH.into_iter().find(|kind| kind.name() == name)
    }

    /// Returns true for a line contact.
    pub const fn is_line(self) -> bool {
        matches!(self, Self::Line)
    }

    /// Returns true for a point contact, circular or elliptical.
    pub const fn is_point(self) -> bool {
        matches!(self, Self::Point)
    }

    /// Returns the SI unit of the load w.
    pub const fn load_unit(self) -> &'static str {
        if self.is_line() { "N/m" } else { "N" }
    }

    /// Returns d, the power of the radius in the load number M = w/(E′ R^d (2U)^q), (3.19) and (3.22). The Hertzian
    /// half width is proportional to (w R)^(1/(d + 1)), the pressure to (w/R^d)^(1/(d + 1)).
    pub const fn radius_power(self) -> i32 {
        if self.is_line() { 1 } else { 2 }
    }

    /// Returns q, the power of the speed group 2U in the load number M = w/(E′ R^d (2U)^q), (3.19) and (3.22).
    pub const fn speed_power(self) -> f64 {
        if self.is_line() { 0.5 } else { 0.75 }
    }

    /// Returns the power 1/(d + 1) of a value, with which the Hertzian half width and pressure grow: the square root
    /// for a line contact, the cube root for a point contact. See [`Self::radius_power`].
    pub fn hertz_root(self, value: f64) -> f64 {
        if self.is_line() { value.sqrt() } else { value.cbrt() }
    }

    /// Returns the integral of the Hertzian pressure √(1 − X² − Y²) over X, and Y, which is the dimensionless load: π/2
    /// for a line contact, 2π/3 for a point contact.
    pub const fn pressure_integral(self) -> f64 {
        if self.is_line() { 0.5 * PI } else { 2.0 / 3.0 * PI }
    }

    /// Returns the extent of the Hertzian contact in units of a for a line contact, 2, and of ab for a point contact, π.
    pub const fn hertz_area(self) -> f64 {
        if self.is_line() { 2.0 } else { PI }
    }
}
