//! Parameter spaces of the dissertation's tables.

use super::axis::Axis;
use super::quantity::Quantity;
use super::space::ParameterSpace;
use crate::solver::physics::contact::ContactKind;

impl ParameterSpace {
    /// Returns a box of R \[m\], u_m \[m/s\], w \[N/m or N\] and α \[1/Pa\] at fixed E′ \[Pa\] and η₀ \[Pa·s\],
    /// (3.16).
    pub fn si_box([radius, speed, load, alpha]: [(f64, f64); 4], modulus: f64, viscosity: f64) -> Self {
        Self::of([
            Axis::linear(Quantity::Radius, radius),
            Axis::linear(Quantity::Speed, speed),
            Axis::linear(Quantity::Load, load),
            Axis::linear(Quantity::Alpha, alpha),
        ])
        .fixing([(Quantity::Modulus, modulus), (Quantity::Viscosity, viscosity)])
    }

    /// Returns the space of Table 3.1: line contacts.
    pub fn table_3_1() -> Self {
        Self::si_box([(2e-3, 4e-3), (1.0, 10.0), (1e5, 5e5), (5e-9, 20e-9)], 231e9, 0.01)
    }

    /// Returns the space of Table 3.4: circular contacts. Its printed radii and loads contradict its M and L; those
    /// given here are consistent with them.
    pub fn table_3_4() -> Self {
        Self::si_box([(10e-3, 20e-3), (1.0, 10.0), (20.0, 100.0), (5e-9, 20e-9)], 231e9, 0.01)
    }

    /// Returns the dissertation's box for a kind of contact.
    pub fn of_tables(kind: ContactKind) -> Self {
        if kind.is_line() { Self::table_3_1() } else { Self::table_3_4() }
    }
}
