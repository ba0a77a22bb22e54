//! Contacts with heat: of one oil between bodies of one radius, or of many oils.
//!
//! With M, L, α and η₀ given λ, p_H and the scaled film are; so is u_m ∝ a (a/R)², with a/R = 4 p_H/E′, and Péclet's and
//! Brinkman's numbers of the film and what its bodies take up go with that alone. A stress that is limited goes with a/R
//! besides: so R and E′ are two further numbers.

use super::oil_range::{BEYOND, OilRange, beyond};
use super::range::{Range, Unit, between, hertz_pressure, linear, logarithmic, single, up_to};
use super::{Plan, TrainingSpec};
use crate::solver::limits::{Refused, interval, number};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Quantity, Sliding};
use crate::solver::physics::lubricant::{LARGEST_HEATED_SRR, Lubricant};
use crate::solver::reduced::{HeatDomain, ThermalDomain};
use fastrand::Rng;
use serde::{Deserialize, Serialize};

/// How much faster contacts slide in a training for many thermal constants than in its range: heat goes with β and the
/// inverse of k besides, of which solutions have those in the middle.
const WARMER: f64 = 2.0;
/// One in so many full solutions of a line, and of a plane, has the training's own thermal constants, and is one that online
/// iterations begin from: a solution of a plane takes seconds.
const OWN: [u64; 2] = [4, 2];

/// All contacts, lines or circles, with M, L and SRR in these intervals and p_H up to a limit, with heat: R, E′, η₀ and α make M a load
/// and L a speed, by which films warm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeatedRange {
    /// Load number, by the load.
    pub m: (f64, f64),
    /// Lubricant number, by the speed.
    pub l: (f64, f64),
    /// Slide-to-roll ratio; films hardly tell which body is the faster one where both are of one material.
    pub srr: (f64, f64),
    /// R \[m\].
    pub radius: f64,
    /// E′ \[Pa\].
    pub modulus: f64,
    /// η₀ \[Pa·s\] at the inlet's temperature.
    pub viscosity: f64,
    /// α \[1/Pa\]: the lubricant's own, where its viscosity law determines it.
    pub alpha: f64,
    /// Largest p_H \[Pa\].
    pub max_hertz_pressure: f64,
}

impl HeatedRange {
    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        between(Quantity::M, self.m)?;
        between(Quantity::L, self.l)?;
        interval("srr", self.srr, 0.0, LARGEST_HEATED_SRR)?;
        single(Quantity::Radius, self.radius)?;
        single(Quantity::Modulus, self.modulus)?;
        single(Quantity::Viscosity, self.viscosity)?;
        single(Quantity::Alpha, self.alpha)?;
        hertz_pressure(self.max_hertz_pressure)
    }

    /// The contact of a kind at coordinates in the unit cube, by ln M, L and SRR; `None` where the range excludes it.
    pub(super) fn at(&self, kind: ContactKind, unit: Unit) -> Option<OperatingPoint> {
        let request = MoesRequest {
            radius_m: Some(self.radius),
            modulus_pa: Some(self.modulus),
            viscosity_pa_s: Some(self.viscosity),
            alpha_per_pa: Some(self.alpha),
            ..MoesRequest::new(kind, self.m.0, self.l.0)
        };
        let point = up_to(self.max_hertz_pressure, (self.m, self.l), unit, request)?;
        Some(sliding(point, linear(self.srr, unit[2])))
    }

    /// What a model of it declares beside M, L, α, η₀ and p_H.
    pub(super) fn declared(&self) -> HeatDomain {
        let Self { srr, radius, modulus, .. } = *self;
        HeatDomain {
            srr,
            radius_m: (radius, radius),
            modulus_pa: (modulus, modulus),
            speed_m_per_s: (0.0, f64::INFINITY),
            fastest_sliding_m_per_s: f64::INFINITY,
            thermal: None,
        }
    }
}

/// All contacts of many oils with R, E′, u_m and SRR in these intervals, with heat.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeatedOilRange {
    /// The oils, with M, L and p_H.
    pub oils: OilRange,
    /// Slide-to-roll ratio; films hardly tell which body is the faster one where both are of one material.
    pub srr: (f64, f64),
    /// R \[m\]; by its logarithm.
    pub radius: (f64, f64),
    /// E′ \[Pa\]; by its logarithm.
    pub modulus: (f64, f64),
    /// u_m \[m/s\].
    pub speed: (f64, f64),
    /// Largest sliding speed SRR u_m \[m/s\]: heat goes with it.
    pub sliding_speed: f64,
    /// The thermal constants and limiting stresses, where these are more than the lubricant's own.
    #[serde(default)]
    pub thermal: Option<ThermalDomain>,
}

impl HeatedOilRange {
    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        self.oils.check().map_err(|refused| refused.within("oils"))?;
        interval("srr", self.srr, 0.0, LARGEST_HEATED_SRR)?;
        between(Quantity::Radius, self.radius)?;
        between(Quantity::Modulus, self.modulus)?;
        between(Quantity::Speed, self.speed)?;
        number("sliding_speed", self.sliding_speed, 1e-3, 1e3)?;
        self.thermal.map_or(Ok(()), |thermal| thermal.check().map_err(|refused| refused.within("thermal")))
    }

    /// The contact of a kind at coordinates in the unit cube, by ln M, L, α, η₀, R, SRR, E′ and, of ellipses, R_y/R; `None`
    /// where the range excludes it.
    pub(super) fn at(&self, kind: ContactKind, unit: Unit) -> Option<OperatingPoint> {
        let [_, _, _, _, radius, srr, modulus, _] = unit;
        let request = MoesRequest {
            radius_m: Some(logarithmic(self.radius, radius)),
            modulus_pa: Some(logarithmic(self.modulus, modulus)),
            ..self.oils.request(kind, unit)
        };
        let (point, srr) = (self.oils.contact(&request, unit)?, linear(self.srr, srr));
        let (speed, (slowest, fastest)) = (point.speed_m_per_s, self.speed);
        let inside = (slowest..=fastest).contains(&speed) && srr * speed <= self.sliding_speed;
        inside.then(|| sliding(point, srr))
    }

    /// A little more on all sides.
    pub(super) fn beyond(&self) -> Self {
        let Self { oils, srr, radius, modulus, speed, sliding_speed, thermal } = *self;
        // Oils of other constants warm by more at the same speed.
        let (_, sliding_speed) = beyond((0.0, sliding_speed), if thermal.is_some() { WARMER } else { BEYOND });
        let [radius, modulus, speed] = [radius, modulus, speed].map(|own| beyond(own, BEYOND));
        Self { oils: oils.beyond(), srr, radius, modulus, speed, sliding_speed, thermal }
    }

    /// What a model of it declares beside the oils, M, L, α and p_H.
    pub(super) fn declared(&self) -> HeatDomain {
        let Self { srr, radius: radius_m, modulus: modulus_pa, speed: speed_m_per_s, sliding_speed, thermal, .. } =
            *self;
        HeatDomain { srr, radius_m, modulus_pa, speed_m_per_s, fastest_sliding_m_per_s: sliding_speed, thermal }
    }
}

impl Range {
    /// A lubricant with thermal constants and limiting stresses at random of those that the range knows; its own where the
    /// range knows none.
    pub fn warmed(&self, own: Lubricant, rng: &mut Rng) -> Lubricant {
        match self {
            Self::HeatedOils(HeatedOilRange { thermal: Some(thermal), .. }) => thermal.drawn(own, rng),
            _ => own,
        }
    }
}

impl TrainingSpec {
    /// The lubricant of the full solution of a contact. Of a range of thermal constants most of those that a farthest-point
    /// plan asks for, told by the last digits of their loads, have some of these: the basis is made of all, snapshots are
    /// those of the training's own lubricant.
    pub fn lubricant_of(&self, point: &OperatingPoint) -> Lubricant {
        let digits = point.load.to_bits();
        let own =
            digits.is_multiple_of(OWN[self.contact() as usize]) || !matches!(self.plan, Plan::FarthestPoint { .. });
        if own { self.lubricant } else { self.range.warmed(self.lubricant, &mut Rng::with_seed(self.seed ^ digits)) }
    }
}

fn sliding(point: OperatingPoint, slide_to_roll_ratio: f64) -> OperatingPoint {
    OperatingPoint { sliding: Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: None }, ..point }
}
