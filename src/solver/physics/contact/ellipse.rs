//! Contact ellipse of two smooth bodies by Hertz's theory, in Carlson's integrals.
//!
//! Lengths along X are in units of the semi-axis a, across in units of b = κa. The pressure √(1 − X² − Y²) flattens a
//! gap ½X² + ½g_y Y² if a³ = 3 w R_x J_x/(π E′) and κ solves J_x/J_y = R_y/R_x. The integrals are J_x = ⅔ R_D(0, κ²,
//! 1) and J_y = ⅔ R_D(0, 1, κ²). Sources: Johnson, Contact Mechanics, section 4.2; DLMF 19.16.

use super::error::ContactError;
use super::limits::Limit;
use ellip::elliprd;
use std::f64::consts::PI;

/// Shape parameters of a point contact, which depend only on R_y/R_x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// R_y/R_x, 1 for a circular contact.
    pub radius_ratio: f64,
    /// κ = b/a.
    pub kappa: f64,
    /// J_x, π/2 for a circular contact.
    pub integral: f64,
}

impl Ellipse {
    /// Circular contact: equal radii.
    pub const CIRCLE: Self = Self { radius_ratio: 1.0, kappa: 1.0, integral: 0.5 * PI };

    /// Accepted range of R_y/R_x. Contacts beyond it are nearly line contacts.
    pub const RADIUS_RATIOS: (f64, f64) = (0.02, 500.0);

    /// Returns the ellipse of R_y/R_x, accurate to rounding.
    ///
    /// # Errors
    /// If the ratio lies outside [`Ellipse::RADIUS_RATIOS`].
    pub fn of_ratio(radius_ratio: f64) -> Result<Self, ContactError> {
        Limit { name: "radius ratio R_y/R_x", unit: "", range: Self::RADIUS_RATIOS, or_zero: false }
            .accept(radius_ratio)?;
        Ok(Self::near(radius_ratio))
    }

    /// Returns the ellipse of κ = b/a; the circle if κ is not a positive number.
    pub fn of_kappa(kappa: f64) -> Self {
        let square = kappa * kappa;
        let (Ok(along), Ok(across)) = (elliprd(0.0, square, 1.0), elliprd(0.0, 1.0, square)) else {
            return Self::CIRCLE;
        };
        Self { radius_ratio: along / across, kappa, integral: 2.0 / 3.0 * along }
    }

    /// Returns the ellipse of R_y/R_x without a check; the circle if the ratio is not a positive number.
    pub(super) fn near(radius_ratio: f64) -> Self {
        if radius_ratio == 1.0 || !(radius_ratio > 0.0 && radius_ratio.is_finite()) {
            return Self::CIRCLE;
        }
        let wanted = radius_ratio.ln();
        let integrals = |log_kappa: f64| {
            let square = (2.0 * log_kappa).exp();
            (elliprd(0.0, square, 1.0).unwrap_or(f64::NAN), elliprd(0.0, 1.0, square).unwrap_or(f64::NAN))
        };
        // ln(J_x/J_y) is nearly linear in ln κ, so the secant method converges to rounding.
        let (mut before, mut here) = (0.0, 0.636 * wanted);
        let mut miss_before = -wanted;
        for _ in 0..20 {
            let (along, across) = integrals(here);
            let miss = (along / across).ln() - wanted;
            let step = miss * (here - before) / (miss - miss_before);
            if !step.is_finite() {
                break;
            }
            (before, miss_before, here) = (here, miss, here - step);
            if step.abs() < 1e-15 {
                break;
            }
        }
        Self { radius_ratio, kappa: here.exp(), integral: 2.0 / 3.0 * integrals(here).0 }
    }

    /// Returns g_y = κ² R_x/R_y, the curvature of the undeformed gap ½X² + ½g_y Y² across.
    pub fn gap_curvature(&self) -> f64 {
        self.kappa * self.kappa / self.radius_ratio
    }

    /// Returns c_K = 1/(π κ J_x), the factor of the deformation Δ = c_K ∬ P dX dκY / r; 2/π² for a circle.
    pub fn kernel_factor(&self) -> f64 {
        if *self == Self::CIRCLE { 2.0 / (PI * PI) } else { 1.0 / (PI * self.kappa * self.integral) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ellip::elliprf;

    #[test]
    fn the_published_numbers_of_five_ratios() {
        for (ratio, kappa, integral, curvature, factor) in [
            (0.2, 0.3459990866, 3.1199551159, 0.59857684, 0.29486745),
            (0.5, 0.6305957014, 2.1746914698, 0.79530188, 0.23211407),
            (2.0, 1.5858021197, 1.0906380986, 1.25738418, 0.18404349),
            (5.0, 2.8901810398, 0.6461646685, 1.67062929, 0.17044406),
            (20.0, 6.9286809644, 0.2830404228, 2.40033100, 0.16231218),
        ] {
            let ellipse = Ellipse::of_ratio(ratio).unwrap();
            assert!((ellipse.kappa / kappa - 1.0).abs() < 1e-9, "κ of {ratio}: {}", ellipse.kappa);
            assert!((ellipse.integral / integral - 1.0).abs() < 1e-9, "J_x of {ratio}");
            assert!((ellipse.gap_curvature() / curvature - 1.0).abs() < 1e-8, "g_y of {ratio}");
            assert!((ellipse.kernel_factor() / factor - 1.0).abs() < 1e-7, "c_K of {ratio}");
        }
    }

    #[test]
    fn quarter_turns_and_nearly_equal_radii_are_consistent() {
        for ratio in [0.1, 0.3, 0.99, 1.01, 3.0, 7.0, 10.0] {
            let (own, turned) = (Ellipse::of_ratio(ratio).unwrap(), Ellipse::of_ratio(1.0 / ratio).unwrap());
            assert!((own.kappa * turned.kappa - 1.0).abs() < 1e-13, "{ratio}");
            // a³ ∝ R_x J_x: the semi-axis a of the turned ellipse is b.
            let turned_a = (turned.integral * ratio / own.integral).cbrt();
            assert!((turned_a / own.kappa - 1.0).abs() < 1e-12, "{ratio}");
        }
        let near = Ellipse::of_ratio(1.0 + 1e-9).unwrap();
        assert!((near.kappa - 1.0).abs() < 1e-9 && (near.integral / (0.5 * PI) - 1.0).abs() < 1e-9);
        assert!((near.kernel_factor() / Ellipse::CIRCLE.kernel_factor() - 1.0).abs() < 1e-9);
        assert_eq!(Ellipse::of_ratio(1.0).unwrap(), Ellipse::CIRCLE);
        for ratio in [0.2, 3.0, 20.0] {
            let ellipse = Ellipse::of_ratio(ratio).unwrap();
            let other = Ellipse::of_kappa(ellipse.kappa);
            assert!(
                (other.radius_ratio / ratio - 1.0).abs() < 1e-13
                    && (other.integral / ellipse.integral - 1.0).abs() < 1e-13
            );
        }
    }

    #[test]
    fn hertz_pressure_gives_the_centre_what_both_integrals_say() {
        // Δ(0,0) = (1/π J_x) ∬ √(1 − X² − Y²)/√(X² + κ²Y²) = R_F(0, 1, κ²)/J_x.
        for (ratio, centre) in [(0.2, 0.7993), (1.0, 1.0), (20.0, 1.7002)] {
            let ellipse = Ellipse::of_ratio(ratio).unwrap();
            let own = elliprf(0.0, 1.0, ellipse.kappa * ellipse.kappa).unwrap() / ellipse.integral;
            assert!((own - centre).abs() < 1e-4, "{ratio}: {own}");
        }
    }

    #[test]
    fn long_ellipses_tend_to_the_limit_of_a_strip() {
        // For large κ: J_x → 2/κ and J_y → 2(ln 4κ − 1)/κ³, so that R_y/R → κ²/(ln 4κ − 1), with errors of (ln κ)/κ².
        for ratio in [40.0, 100.0, 206.0, 500.0] {
            let long = Ellipse::of_ratio(ratio).unwrap();
            let kappa = long.kappa;
            let bar = 2.0 * kappa.ln() / (kappa * kappa);
            assert!((long.integral * kappa / 2.0 - 1.0).abs() < bar, "J_x of {ratio}");
            assert!((kappa * kappa / ((4.0 * kappa).ln() - 1.0) / ratio - 1.0).abs() < bar, "κ of {ratio}: {kappa}");
            let short = Ellipse::of_ratio(1.0 / ratio.min(50.0)).unwrap();
            let turned = Ellipse::of_ratio(ratio.min(50.0)).unwrap();
            assert!((short.kappa * turned.kappa - 1.0).abs() < 1e-12, "{ratio}");
        }
    }

    #[test]
    fn ratios_beyond_all_ellipses_are_refused() {
        for bad in [f64::NAN, 0.0, -2.0, 0.01, 600.0, f64::INFINITY] {
            let message = Ellipse::of_ratio(bad).unwrap_err().to_string();
            assert!(message.starts_with("radius ratio R_y/R_x is") && message.contains("between"), "{message}");
        }
    }
}
