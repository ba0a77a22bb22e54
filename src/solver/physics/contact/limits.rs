//! Names, units and accepted values of the numbers that define an operating point.

use super::ContactError;

/// Quantity with its name, unit and accepted values. The range is wider than that of any contact and narrow enough to
/// keep numbers finite.
#[derive(Clone, Copy, Debug)]
pub struct Limit {
    /// Name in options, tables and messages.
    pub name: &'static str,
    /// SI unit with a leading space, or empty.
    pub unit: &'static str,
    /// Smallest and largest accepted value.
    pub range: (f64, f64),
    /// Accepts zero in addition to the range.
    pub or_zero: bool,
}

/// Load number M.
pub const M: Limit = Limit { name: "Moes number M", unit: "", range: (1e-5, 1e6), or_zero: false };
/// Lubricant number L; zero if the viscosity is independent of the pressure.
pub const L: Limit = Limit { name: "Moes number L", unit: "", range: (1e-6, 1e3), or_zero: true };
/// Reduced radius R.
pub const RADIUS: Limit = Limit { name: "radius", unit: " m", range: (1e-6, 1e3), or_zero: false };
/// Reduced radius across R_y.
pub const RADIUS_Y: Limit = Limit { name: "radius-y", unit: " m", range: (1e-7, 1e5), or_zero: false };
/// Entrainment speed u_m.
pub const SPEED: Limit = Limit { name: "speed", unit: " m/s", range: (1e-9, 1e7), or_zero: false };
/// Load w.
pub const LOAD: Limit = Limit { name: "load", unit: " N (or N/m)", range: (1e-6, 1e10), or_zero: false };
/// Reduced modulus E′.
pub const MODULUS: Limit = Limit { name: "modulus", unit: " Pa", range: (1e5, 1e14), or_zero: false };
/// Viscosity η₀.
pub const VISCOSITY: Limit = Limit { name: "viscosity", unit: " Pa·s", range: (1e-6, 1e4), or_zero: false };
/// Pressure–viscosity coefficient α; zero if the viscosity is independent of the pressure.
pub const ALPHA: Limit = Limit { name: "alpha", unit: " 1/Pa", range: (1e-12, 1e-5), or_zero: true };

/// Limits of [`super::OperatingPoint::quantities`], in that order.
pub const SI: [Limit; 6] = [RADIUS, SPEED, LOAD, MODULUS, VISCOSITY, ALPHA];

impl Limit {
    /// Checks that a value lies in the range.
    ///
    /// # Errors
    /// If it does not. The error names the quantity, its value and the accepted values.
    pub fn accept(&self, value: f64) -> Result<(), ContactError> {
        let Self { name: quantity, unit, range: (min, max), or_zero } = *self;
        let inside = (min..=max).contains(&value) || or_zero && value == 0.0;
        if inside { Ok(()) } else { Err(ContactError::OutOfRange { quantity, value, unit, min, max, or_zero }) }
    }
}
