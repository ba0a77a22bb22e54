//! Tait's equation of state, and Doolittle's viscosity law, which follows from the free volume of that equation.
//!
//! Sources: Dymond & Malhotra 1988 for Tait's equation; Doolittle 1951 for the viscosity; both in the form of Bair
//! 2007, *High Pressure Rheology for Quantitative Elastohydrodynamics*, isothermal.

use super::error::{LubricantError, check_constant};
use serde::{Deserialize, Serialize};

/// Tait's equation of state, (3.37).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tait {
    /// Initial bulk modulus K₀ \[Pa\].
    pub k_0: f64,
    /// Its rate of change K₀′ \[-\].
    pub k_0_prime: f64,
}

/// Doolittle's law, (3.39), with the equation of state for its free volume.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Doolittle {
    /// Doolittle's parameter B \[-\].
    pub b: f64,
    /// Occupied volume R₀ over the volume at ambient pressure \[-\].
    pub r_0: f64,
    /// Relative volume under pressure.
    pub volume: Tait,
}

impl Tait {
    /// Refuses unphysical constants.
    pub(super) fn check(&self) -> Result<(), LubricantError> {
        check_constant("Tait's bulk modulus k_0", self.k_0, 1e7, 1e12)?;
        check_constant("Tait's rate of change k_0_prime", self.k_0_prime, 1.0, 100.0)
    }

    /// Returns V/V₀ at p \[Pa\] and its derivative \[1/Pa\].
    #[inline]
    pub fn relative_volume(&self, p: f64) -> (f64, f64) {
        let slope = (1.0 + self.k_0_prime) / self.k_0;
        let argument = 1.0 + p * slope;
        (1.0 - argument.ln() / (1.0 + self.k_0_prime), -1.0 / (self.k_0 * argument))
    }

    /// Returns the pressure \[Pa\] at which V/V₀ has fallen to `volume`: (3.37) solved for p.
    pub fn pressure_at(&self, volume: f64) -> f64 {
        let compressed = 1.0 + self.k_0_prime;
        ((compressed * (1.0 - volume)).exp_m1()) * self.k_0 / compressed
    }

    /// Returns ρ/ρ₀ at p \[Pa\], (3.38), and its derivative \[1/Pa\]. Below V/V₀ = 0.1 the density
    /// is constant.
    #[inline]
    pub fn density(&self, p: f64) -> (f64, f64) {
        const LEAST_VOLUME: f64 = 0.1;
        let (volume, slope) = self.relative_volume(p);
        if volume < LEAST_VOLUME {
            return (1.0 / LEAST_VOLUME, 0.0);
        }
        (1.0 / volume, -slope / (volume * volume))
    }
}

impl Doolittle {
    pub(super) fn check(&self) -> Result<(), LubricantError> {
        check_constant("Doolittle's parameter b", self.b, 1e-3, 1e3)?;
        check_constant("Doolittle's occupied volume r_0", self.r_0, 0.05, 0.99)?;
        self.volume.check()
    }

    /// Returns the pressure \[Pa\] at which no free volume is left. This is the end of the law's range.
    pub fn largest_pressure(&self) -> f64 {
        self.volume.pressure_at(self.r_0)
    }

    /// Returns ln(μ/η₀) at p \[Pa\] and its derivative \[1/Pa\]. Without free volume the logarithm is infinite and
    /// the derivative zero.
    #[inline]
    pub fn log_viscosity(&self, p: f64) -> (f64, f64) {
        let (volume, slope) = self.volume.relative_volume(p);
        let free = volume - self.r_0;
        // A NaN volume, from pressures far below −K₀/(1 + K₀′), has no free volume either.
        if free.is_nan() || free <= 0.0 {
            return (f64::INFINITY, 0.0);
        }
        let strength = self.b * self.r_0;
        (strength * (1.0 / free - 1.0 / (1.0 - self.r_0)), -strength * slope / (free * free))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUALANE: Doolittle = Doolittle { b: 4.2, r_0: 0.658, volume: Tait { k_0: 1.007837e9, k_0_prime: 11.29 } };

    #[test]
    fn slopes_agree_with_finite_differences() {
        for p in [-1e7, 0.0, 1e8, 5e8, 1.5e9, 4e9] {
            let step = 1e3;
            let difference = |f: &dyn Fn(f64) -> f64| (f(p + step) - f(p - step)) / (2.0 * step);
            let density = difference(&|p| SQUALANE.volume.density(p).0);
            let viscosity = difference(&|p| SQUALANE.log_viscosity(p).0);
            assert!((density / SQUALANE.volume.density(p).1 - 1.0).abs() < 1e-5, "{p}");
            assert!((viscosity / SQUALANE.log_viscosity(p).1 - 1.0).abs() < 1e-5, "{p}");
        }
    }

    #[test]
    fn the_law_ends_where_the_free_volume_does() {
        let end = SQUALANE.largest_pressure();
        assert!((SQUALANE.volume.relative_volume(end).0 - SQUALANE.r_0).abs() < 1e-12);
        assert!(SQUALANE.log_viscosity(0.999 * end).0 > 1e3 && SQUALANE.log_viscosity(1.001 * end).0.is_infinite());
        assert!(SQUALANE.log_viscosity(0.0).0 == 0.0 && SQUALANE.volume.density(0.0).0 == 1.0);
    }
}
