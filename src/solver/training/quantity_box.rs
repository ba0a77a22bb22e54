//! Boxes of SI quantities, as the dissertation's tables give them.

use super::range::{between, linear, single};
use crate::solver::limits::Refused;
use crate::solver::physics::contact::{ContactKind, OperatingPoint, Quantity, Sliding};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Intervals of R, u_m, w and α at fixed E′ and η₀, as Table 3.1 gives them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuantityBox {
    /// Radius \[m\].
    pub radius: (f64, f64),
    /// Speed \[m/s\].
    pub speed: (f64, f64),
    /// Load \[N/m\] (line) or \[N\] (point).
    pub load: (f64, f64),
    /// Pressure–viscosity coefficient \[1/Pa\].
    pub alpha: (f64, f64),
    /// Reduced modulus \[Pa\].
    pub modulus: f64,
    /// Viscosity at ambient pressure \[Pa·s\].
    pub viscosity: f64,
}

impl QuantityBox {
    /// Table 3.1 of the dissertation.
    pub const TABLE_3_1: Self = Self {
        radius: (2e-3, 4e-3),
        speed: (1.0, 10.0),
        load: (1e5, 5e5),
        alpha: (5e-9, 20e-9),
        modulus: 231e9,
        viscosity: 0.01,
    };

    /// The dissertation's box for a kind of contact.
    pub fn of_tables(kind: ContactKind) -> Self {
        match kind {
            ContactKind::Line => Self::TABLE_3_1,
            ContactKind::Point => Self::TABLE_3_4,
        }
    }

    /// The dissertation's Table 3.4, whose printed radii and loads contradict its M and L: with these they hold.
    pub const TABLE_3_4: Self = Self { radius: (10e-3, 20e-3), load: (20.0, 100.0), ..Self::TABLE_3_1 };

    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        between(Quantity::Radius, self.radius)?;
        between(Quantity::Speed, self.speed)?;
        between(Quantity::Load, self.load)?;
        between(Quantity::Alpha, self.alpha)?;
        single(Quantity::Modulus, self.modulus)?;
        single(Quantity::Viscosity, self.viscosity)
    }

    /// The point of a kind at fractions (0…1) of radius, speed, load and alpha.
    pub fn at(&self, kind: ContactKind, [radius, speed, load, alpha]: [f64; 4]) -> OperatingPoint {
        OperatingPoint {
            kind,
            radius_m: linear(self.radius, radius),
            speed_m_per_s: linear(self.speed, speed),
            load: linear(self.load, load),
            modulus_pa: self.modulus,
            viscosity_pa_s: self.viscosity,
            alpha_per_pa: linear(self.alpha, alpha),
            sliding: Sliding::NONE,
            radius_y_m: None,
        }
    }

    /// The point of the test trajectory (3.21) at the running parameter c.
    pub fn trajectory(&self, kind: ContactKind, c: f64) -> OperatingPoint {
        self.at(kind, Self::trajectory_place(c))
    }

    /// Its coordinates in the unit cube.
    pub fn trajectory_place(c: f64) -> [f64; 4] {
        [3.0, 4.0, 5.0, 2.0].map(|halves: f64| 0.5 + 0.5 * (halves * PI * c).sin())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_trajectory_starts_in_the_middle_and_stays_in_the_box() {
        let range = QuantityBox::TABLE_3_1;
        let middle = [3e-3, 5.5, 3e5, 231e9, 0.01, 12.5e-9];
        assert!(
            range
                .trajectory(ContactKind::Line, 0.0)
                .quantities()
                .iter()
                .zip(middle)
                .all(|(q, m)| (q / m - 1.0).abs() < 1e-14)
        );
        for i in 0..=1000 {
            let point = range.trajectory(ContactKind::Line, i as f64 / 500.0);
            assert!((2e-3..=4e-3).contains(&point.radius_m) && (1e5..=5e5).contains(&point.load));
        }
    }
}
