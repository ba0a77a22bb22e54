//! Sliding contacts of many oils that thin under shear by Eyring's law.
//!
//! Beside M, L, p_H and z an isothermal contact then has SRR and what its stresses are compared with: those that the
//! pressure's gradient makes go with N = p_H (a/R)/τ₀, those of sliding with SRR λ̄ N/12. a/R goes with p_H/E′, so R is
//! free, and of E′ and τ₀ the product alone counts: a contact with another τ₀ than the range's lubricant is one with as
//! much more E′. What a limiting stress cuts off traction goes with its Λ p_H over τ₀ besides.

use super::oil_range::{BEYOND, OilRange, beyond};
use super::range::{Unit, between, linear, logarithmic};
use crate::solver::limits::{Refused, interval, number};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Quantity, Sliding};
use crate::solver::physics::lubricant::{LimitingStress, Lubricant, ShearLaw};
use crate::solver::reduced::{EyringDomain, gradient_stress};
use fastrand::Rng;
use serde::{Deserialize, Serialize};

/// Contacts of these oils, sliding, by what oils have and SRR and ln E′ besides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlidingOilRange {
    /// The oils, M, L and p_H.
    pub oils: OilRange,
    /// Slide-to-roll ratio; films are even in it.
    pub srr: (f64, f64),
    /// E′ \[Pa\] at the lubricant's own Eyring stress.
    pub modulus: (f64, f64),
    /// Λ \[-\] of the limiting stresses that may cut traction, at that stress.
    pub limit_slope: (f64, f64),
    /// The largest stress \[Pa\] that the pressure's gradient makes across a film, by [`gradient_stress`], at that Eyring
    /// stress: from one and a half Eyring stresses on many contacts have no full solution.
    pub gradient_stress: f64,
}

/// The largest stress that a lubricant carries at ambient pressure and traction is fitted to, in Eyring stresses.
const LARGEST_AMBIENT: f64 = 2.0;

impl SlidingOilRange {
    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        self.oils.check().map_err(|refused| refused.within("oils"))?;
        interval("srr", self.srr, 0.0, 10.0)?;
        between(Quantity::Modulus, self.modulus)?;
        interval("limit_slope", self.limit_slope, 1e-4, 1.0)?;
        number("gradient_stress", self.gradient_stress, 1.0, 1e12)
    }

    /// The contact at coordinates in the unit cube, by ln M, ln L, ln α, ln η₀, SRR and ln E′; `None` where the range
    /// excludes it.
    pub(super) fn at(&self, kind: ContactKind, unit: Unit) -> Option<OperatingPoint> {
        let [_, _, _, _, srr, modulus, ..] = unit;
        let request =
            MoesRequest { modulus_pa: Some(logarithmic(self.modulus, modulus)), ..self.oils.request(kind, unit) };
        let slide_to_roll_ratio = linear(self.srr, srr);
        let sliding = Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: None };
        let point = self.oils.contact(&request, unit).filter(|point| gradient_stress(point) <= self.gradient_stress)?;
        Some(OperatingPoint { sliding, ..point })
    }

    /// A little more on all sides.
    pub(super) fn beyond(&self) -> Self {
        let (_, gradient_stress) = beyond((0.0, self.gradient_stress), BEYOND);
        Self { oils: self.oils.beyond(), modulus: beyond(self.modulus, BEYOND), gradient_stress, ..*self }
    }

    /// What a model of it declares beside the oils, M, L, α and p_H.
    pub(super) fn declared(&self) -> EyringDomain {
        let Self { srr, modulus: modulus_pa, limit_slope, gradient_stress: gradient_stress_pa, .. } = *self;
        EyringDomain { srr, modulus_pa, limit_slope, gradient_stress_pa }
    }

    /// A lubricant with a limiting stress of those that may cut its traction.
    pub(super) fn limited(&self, lubricant: Lubricant, rng: &mut Rng) -> Lubricant {
        let ShearLaw::Eyring { critical_stress, .. } = lubricant.shear else { return lubricant };
        let ambient = LARGEST_AMBIENT * critical_stress * rng.f64();
        let limit = LimitingStress { ambient, slope: logarithmic(self.limit_slope, rng.f64()), eyring: None };
        Lubricant { limiting_stress: Some(limit), ..lubricant }
    }
}
