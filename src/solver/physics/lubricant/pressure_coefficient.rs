//! Reciprocal asymptotic isoviscous pressure coefficient α*, which defines M and L for any viscosity law.
//!
//! 1/α* = ∫₀^∞ η₀/μ(p) dp, Blok 1963. It is the coefficient for which the film formulas hold (Bair, Liu & Wang 2006).
//! For Barus' law α* = α.

use super::free_volume::Doolittle;

/// Abscissae and weights of the six-point Gauss rule on (−½, ½).
pub const GAUSS_6: [(f64, f64); 6] = [
    (-0.466_234_757_101_576, 0.085_662_246_189_585_2),
    (-0.330_604_693_233_132_25, 0.180_380_786_524_069_3),
    (-0.119_309_593_041_598_45, 0.233_956_967_286_345_5),
    (0.119_309_593_041_598_45, 0.233_956_967_286_345_5),
    (0.330_604_693_233_132_25, 0.180_380_786_524_069_3),
    (0.466_234_757_101_576, 0.085_662_246_189_585_2),
];

/// Returns α* \[1/unit of p\] of a law ln(μ/η₀)(p), whose slope at ambient pressure is `ambient`.
///
/// Each panel has a width of one e-folding at ambient pressure and six Gauss points. The sum ends when a panel is
/// negligible, or after 400 panels.
pub(super) fn reciprocal_asymptotic(ambient: f64, log_viscosity: impl Fn(f64) -> f64) -> f64 {
    let width = 1.0 / ambient;
    let mut integral = 0.0;
    for panel in 0..400 {
        let middle = (f64::from(panel) + 0.5) * width;
        let part: f64 = GAUSS_6.iter().map(|(at, weight)| weight * (-log_viscosity(middle + at * width)).exp()).sum();
        integral += width * part;
        if width * part < 1e-17 * integral {
            break;
        }
    }
    1.0 / integral
}

impl Doolittle {
    /// Returns α* \[1/Pa\] of this law.
    pub fn reciprocal_asymptotic_coefficient(&self) -> f64 {
        reciprocal_asymptotic(self.log_viscosity(0.0).1, |p| self.log_viscosity(p).0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Tait;
    use super::*;

    #[test]
    fn barus_law_has_the_coefficient_alpha() {
        assert!((reciprocal_asymptotic(2e-8, |p| 2e-8 * p) / 2e-8 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn doolittles_law_has_an_ambient_slope_near_its_coefficient() {
        let squalane = Doolittle { b: 4.2, r_0: 0.658, volume: Tait { k_0: 1.007837e9, k_0_prime: 11.29 } };
        // B R₀/(1 − R₀)²/K₀ at ambient pressure.
        let slope = 4.2 * 0.658 / (0.342 * 0.342) / 1.007837e9;
        assert!((squalane.log_viscosity(0.0).1 / slope - 1.0).abs() < 1e-12);
        let coefficient = squalane.reciprocal_asymptotic_coefficient();
        // A fine trapezoidal sum to 3 GPa, where the rest is below 1e-12.
        let step = 2e4;
        let fluidity = |k: f64| (-squalane.log_viscosity(k * step).0).exp();
        let sum: f64 = step * (0.5 + (1..150_000).map(|k| fluidity(f64::from(k))).sum::<f64>());
        assert!((coefficient * sum - 1.0).abs() < 1e-7, "{coefficient} against {}", 1.0 / sum);
    }
}
