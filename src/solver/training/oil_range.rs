//! Contacts of many oils.

use super::range::{Unit, between, logarithmic};
use crate::solver::limits::{Refused, interval, number};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Quantity, si_from_moes};
use crate::solver::physics::lubricant::roelands_exponent;
use crate::solver::reduced::{CIRCLES, OilDomain, circles, expected_film};
use serde::{Deserialize, Serialize};

/// By how much training reaches beyond the ends of a range.
pub(super) const BEYOND: f64 = 1.04;

/// An interval of positive numbers and a little more.
pub(super) fn beyond((low, high): (f64, f64), by: f64) -> (f64, f64) {
    (low / by, high * by)
}

/// All contacts with M, L and p_H in these intervals of the oils with η₀, α and Roelands' exponent in these; by ln M,
/// ln L, ln α, ln η₀ and, of ellipses, ln(R_y/R). R and E′ are free: what they change is in M, L and p_H.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OilRange {
    /// Load number.
    pub m: (f64, f64),
    /// Lubricant number.
    pub l: (f64, f64),
    /// α \[1/Pa\].
    pub alpha: (f64, f64),
    /// η₀ \[Pa·s\].
    pub viscosity: (f64, f64),
    /// Roelands' exponent z, which leaves out α and η₀ that no oil has together.
    pub exponent: (f64, f64),
    /// p_H \[Pa\].
    pub hertz_pressure: (f64, f64),
    /// The thinnest central film, H_c in units of a²/R by [`expected_film`]: heavy contacts of light oils have films that
    /// no grid of a model resolves. 0 leaves none of them out.
    #[serde(default)]
    pub thinnest_film: f64,
    /// R_y/R of point contacts; circles where it is left out.
    #[serde(default = "circles")]
    pub radius_ratio: (f64, f64),
}

impl OilRange {
    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        between(Quantity::M, self.m)?;
        between(Quantity::L, self.l)?;
        between(Quantity::Alpha, self.alpha)?;
        between(Quantity::Viscosity, self.viscosity)?;
        interval("exponent", self.exponent, 0.05, 2.0)?;
        interval("hertz_pressure", self.hertz_pressure, 1e5, 1e12)?;
        if self.radius_ratio != CIRCLES {
            between(Quantity::RadiusRatio, self.radius_ratio)?;
        }
        number("thinnest_film", self.thinnest_film, 0.0, 1.0)
    }

    /// The operating point at coordinates in the unit cube; `None` where p_H or the exponent exclude it.
    pub(super) fn at(&self, kind: ContactKind, unit: Unit) -> Option<OperatingPoint> {
        self.contact(&self.request(kind, unit), unit)
    }

    /// M, L, α and η₀ at coordinates in the unit cube.
    pub(super) fn request(&self, kind: ContactKind, unit: Unit) -> MoesRequest {
        MoesRequest {
            alpha_per_pa: Some(logarithmic(self.alpha, unit[2])),
            viscosity_pa_s: Some(logarithmic(self.viscosity, unit[3])),
            ..MoesRequest::new(kind, logarithmic(self.m, unit[0]), logarithmic(self.l, unit[1]))
        }
    }

    /// The contact that is asked for, of a shape by the last coordinate in the unit cube where the range has more than
    /// one, unless p_H, the exponent or the film exclude it.
    pub(super) fn contact(&self, request: &MoesRequest, [.., shape]: Unit) -> Option<OperatingPoint> {
        let inside = |value: f64, (low, high): (f64, f64)| (low..=high).contains(&value);
        let circle = si_from_moes(request).ok()?;
        let point = match self.radius_ratio {
            CIRCLES => circle,
            ratios => Quantity::RadiusRatio.at(&circle, logarithmic(ratios, shape)),
        };
        Some(point).filter(|point| {
            inside(point.hertz().pressure_pa, self.hertz_pressure)
                && inside(roelands_exponent(point), self.exponent)
                && expected_film(point.kind, point.moes()) >= self.thinnest_film
        })
    }

    /// A little more on all sides: solutions there keep a model from ending at its last ones.
    pub(super) fn beyond(&self) -> Self {
        Self {
            m: beyond(self.m, BEYOND),
            l: beyond(self.l, BEYOND),
            alpha: beyond(self.alpha, BEYOND),
            viscosity: beyond(self.viscosity, BEYOND),
            exponent: beyond(self.exponent, BEYOND),
            hertz_pressure: beyond(self.hertz_pressure, BEYOND),
            thinnest_film: self.thinnest_film / BEYOND,
            radius_ratio: self.radius_ratio,
        }
    }

    /// What a model of it declares beside M, L, α and the largest p_H.
    pub(super) fn declared(&self) -> OilDomain {
        OilDomain {
            viscosity_pa_s: self.viscosity,
            exponent: self.exponent,
            lowest_hertz_pressure_pa: self.hertz_pressure.0,
            thinnest_film: self.thinnest_film,
        }
    }

    /// The viscosity in the middle \[Pa·s\].
    pub(super) fn middle_viscosity(&self) -> f64 {
        logarithmic(self.viscosity, 0.5)
    }
}
