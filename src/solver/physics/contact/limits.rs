//! Names, units and accepted values of the numbers that define an operating point.

use super::ContactError;

/// A number with its name, its SI unit behind a number (a leading space, or empty), and its accepted values: wider than
/// any contact, narrow enough to keep numbers finite.
#[derive(Clone, Copy, Debug)]
pub struct Limit {
    /// Word in options, tables and messages.
    pub name: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Smallest and largest accepted value.
    pub range: (f64, f64),
}

/// Load number M.
pub const M: Limit = Limit { name: "Moes number M", unit: "", range: (0.05, 1e5) };
/// Lubricant number L.
pub const L: Limit = Limit { name: "Moes number L", unit: "", range: (1e-3, 1e3) };
/// Reduced radius R.
pub const RADIUS: Limit = Limit { name: "radius", unit: " m", range: (1e-6, 1e3) };
/// Reduced radius across R_y.
pub const RADIUS_Y: Limit = Limit { name: "radius-y", unit: " m", range: (1e-7, 1e5) };
/// Entrainment speed u_m.
pub const SPEED: Limit = Limit { name: "speed", unit: " m/s", range: (1e-9, 1e4) };
/// Load w.
pub const LOAD: Limit = Limit { name: "load", unit: " N (or N/m)", range: (1e-6, 1e10) };
/// Reduced modulus E′.
pub const MODULUS: Limit = Limit { name: "modulus", unit: " Pa", range: (1e5, 1e14) };
/// Viscosity η₀.
pub const VISCOSITY: Limit = Limit { name: "viscosity", unit: " Pa·s", range: (1e-6, 1e4) };
/// Pressure–viscosity coefficient α.
pub const ALPHA: Limit = Limit { name: "alpha", unit: " 1/Pa", range: (1e-12, 1e-5) };

/// Limits of [`super::OperatingPoint::quantities`], in that order.
pub const SI: [Limit; 6] = [RADIUS, SPEED, LOAD, MODULUS, VISCOSITY, ALPHA];

impl Limit {
    /// Refuses a value outside the range.
    ///
    /// # Errors
    /// Naming the number, its value and what is accepted.
    pub fn accept(&self, value: f64) -> Result<(), ContactError> {
        let Self { name: quantity, unit, range: (min, max) } = *self;
        let inside = (min..=max).contains(&value);
        if inside { Ok(()) } else { Err(ContactError::OutOfRange { quantity, value, unit, min, max }) }
    }
}
