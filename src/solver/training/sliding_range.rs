//! Contacts of one shear-thinning lubricant by M, L, SRR and NPR.

use super::range::{Unit, between, hertz_pressure, linear, single, up_to};
use crate::solver::limits::Refused;
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Quantity, Sliding};
use serde::{Deserialize, Serialize};

/// All contacts of a shear-thinning lubricant with M, L, SRR and NPR in these intervals and p_H up to a limit. M and L
/// do not say all about them: E′ fixes the stress.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlidingRange {
    /// Load number.
    pub m: (f64, f64),
    /// Lubricant number.
    pub l: (f64, f64),
    /// Slide-to-roll ratio; films are even in it.
    pub srr: (f64, f64),
    /// Newtonian plateau ratio.
    pub npr: (f64, f64),
    /// R \[m\].
    pub radius: f64,
    /// E′ \[Pa\].
    pub modulus: f64,
    /// η₀ \[Pa·s\].
    pub viscosity: f64,
    /// α \[1/Pa\]: the lubricant's own, where its viscosity law determines it.
    pub alpha: f64,
    /// Largest p_H \[Pa\], where M and L alone do not limit it: traction means little where α* p_H exceeds 12.
    #[serde(default)]
    pub max_hertz_pressure: Option<f64>,
}

impl SlidingRange {
    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        between(Quantity::M, self.m)?;
        between(Quantity::L, self.l)?;
        between(Quantity::SlideToRollRatio, self.srr)?;
        between(Quantity::NewtonianPlateauRatio, self.npr)?;
        single(Quantity::Radius, self.radius)?;
        single(Quantity::Modulus, self.modulus)?;
        single(Quantity::Viscosity, self.viscosity)?;
        single(Quantity::Alpha, self.alpha)?;
        self.max_hertz_pressure.map_or(Ok(()), hertz_pressure)
    }

    /// The operating point of a kind at coordinates in the unit cube, by ln M, L, SRR and NPR; `None` where the range
    /// excludes it.
    pub(super) fn at(&self, kind: ContactKind, unit: Unit) -> Option<OperatingPoint> {
        let request = MoesRequest {
            radius_m: Some(self.radius),
            modulus_pa: Some(self.modulus),
            viscosity_pa_s: Some(self.viscosity),
            alpha_per_pa: Some(self.alpha),
            ..MoesRequest::new(kind, self.m.0, self.l.0)
        };
        let sliding = Sliding {
            slide_to_roll_ratio: linear(self.srr, unit[2]),
            newtonian_plateau_ratio: Some(linear(self.npr, unit[3])),
        };
        let point = up_to(self.max_hertz_pressure.unwrap_or(f64::INFINITY), (self.m, self.l), unit, request)?;
        Some(OperatingPoint { sliding, ..point })
    }

    /// The largest Hertzian pressure \[Pa\] of a kind of contact in it; 0 where M and L make no contact.
    pub fn highest_pressure(&self, kind: ContactKind) -> f64 {
        let unlimited = Self { max_hertz_pressure: None, ..*self };
        let heaviest = unlimited.at(kind, [1.0; 8]).map_or(0.0, |point| point.hertz().pressure_pa);
        heaviest.min(self.max_hertz_pressure.unwrap_or(f64::INFINITY))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::training::range::in_the_middle_but;

    const SLIDING: SlidingRange = SlidingRange {
        m: (10.0, 200.0),
        l: (4.0, 11.0),
        srr: (0.0, 1.0),
        npr: (0.2, 1.0),
        radius: 12.7e-3,
        modulus: 123.9e9,
        viscosity: 0.07,
        alpha: 1.9e-8,
        max_hertz_pressure: Some(660e6),
    };

    #[test]
    fn contacts_beyond_the_pressure_are_left_out_and_the_others_lie_inside() {
        let mut inside = 0;
        for i in 0..=10 {
            for j in 0..=10 {
                let unit = in_the_middle_but([f64::from(i) / 10.0, f64::from(j) / 10.0, 0.5, 0.25]);
                let Some(point) = SLIDING.at(ContactKind::Point, unit) else { continue };
                let moes = point.moes();
                assert!(point.hertz().pressure_pa <= 660e6);
                assert!((9.999..200.01).contains(&moes.m) && (3.999..11.001).contains(&moes.l));
                assert_eq!(point.sliding.slide_to_roll_ratio, 0.5);
                assert!((point.sliding.newtonian_plateau_ratio.unwrap() - 0.4).abs() < 1e-12);
                inside += 1;
            }
        }
        assert!((20..121).contains(&inside), "{inside} of 121");
    }

    #[test]
    fn the_highest_pressure_is_the_limit_or_that_of_the_heaviest_corner() {
        assert_eq!(SLIDING.highest_pressure(ContactKind::Point), 660e6);
        let light = SlidingRange { m: (10.0, 12.0), ..SLIDING };
        // α p_H = L (3M/2π³)^⅓ of a point contact.
        let expected = 11.0 * (3.0 * 12.0 / (2.0 * std::f64::consts::PI.powi(3))).cbrt() / 1.9e-8;
        assert!((light.highest_pressure(ContactKind::Point) / expected - 1.0).abs() < 1e-9);
    }
}
