//! Where contacts lie: what a model is trained for, and where random ones are drawn.

use super::heated_range::{HeatedOilRange, HeatedRange};
use super::oil_range::OilRange;
use super::quantity_box::QuantityBox;
use super::sliding_oil_range::SlidingOilRange;
use super::sliding_range::SlidingRange;
use crate::solver::limits::{Refused, interval, number};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Quantity, si_from_moes};
use crate::solver::reduced::{CIRCLES, Domain, EyringDomain, HeatDomain};
use serde::{Deserialize, Serialize};

/// A set of contacts.
///
/// M and α spread over their ratios and everything else linearly, as the distance between contacts takes them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Range {
    /// A box of SI quantities, (3.16). Tables 3.1 and 3.4.
    Box(QuantityBox),
    /// All contacts with M, L, α in these intervals and p_H up to a limit, at η₀ and the default R (3 mm line, 10 mm
    /// point) and E′ = 231 GPa; by ln M, L and ln α.
    Moes {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// α \[1/Pa\].
        alpha: (f64, f64),
        /// Largest p_H \[Pa\].
        max_hertz_pressure: f64,
        /// η₀ \[Pa·s\].
        viscosity: f64,
    },
    /// All contacts of a shear-thinning lubricant with M, L, SRR and NPR in intervals.
    Sliding(SlidingRange),
    /// All point contacts with M, L and R_y/R in these intervals and p_H up to a limit, in the default realisation; by ln
    /// M, L and ln(R_y/R).
    Ellipses {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// R_y/R.
        radius_ratio: (f64, f64),
        /// Largest p_H \[Pa\].
        max_hertz_pressure: f64,
    },
    /// All contacts with M and L in these intervals and p_H up to a limit, in the default realisation; by ln M and L.
    Realisation {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// Largest p_H \[Pa\].
        max_hertz_pressure: f64,
    },
    /// All contacts of many oils.
    Oils(OilRange),
    /// All contacts of one oil between bodies of one radius, with heat.
    Heated(HeatedRange),
    /// All contacts of many oils, with heat.
    HeatedOils(HeatedOilRange),
    /// All contacts of many oils that thin under shear by Eyring's law.
    SlidingOils(SlidingOilRange),
}

/// Coordinates in the unit cube, of which a range uses as many as it has quantities.
pub(super) type Unit = [f64; 8];

/// Four coordinates, and the middle for all others.
pub(super) fn in_the_middle_but([a, b, c, d]: [f64; 4]) -> Unit {
    [a, b, c, d, 0.5, 0.5, 0.5, 0.5]
}

impl From<&Domain> for Range {
    /// The intervals that a model declares; what it knows of sliding is left out.
    fn from(domain: &Domain) -> Self {
        if domain.radius_ratio != CIRCLES && domain.oils.is_none() {
            let Domain { m, l, radius_ratio, max_hertz_pressure_pa: max_hertz_pressure, .. } = *domain;
            return Self::Ellipses { m, l, radius_ratio, max_hertz_pressure };
        }
        let oils = domain.oils.map(|oils| OilRange {
            m: domain.m,
            l: domain.l,
            alpha: domain.alpha_per_pa,
            viscosity: oils.viscosity_pa_s,
            exponent: oils.exponent,
            hertz_pressure: (oils.lowest_hertz_pressure_pa, domain.max_hertz_pressure_pa),
            thinnest_film: oils.thinnest_film,
            radius_ratio: domain.radius_ratio,
        });
        if let Some((oils, eyring)) = oils.zip(domain.eyring) {
            let EyringDomain { srr, modulus_pa: modulus, limit_slope, gradient_stress_pa: gradient_stress } = eyring;
            return Self::SlidingOils(SlidingOilRange { oils, srr, modulus, limit_slope, gradient_stress });
        }
        match (oils, domain.heat) {
            (Some(oils), Some(heat)) => {
                let HeatDomain { srr, radius_m: radius, modulus_pa: modulus, speed_m_per_s: speed, thermal, .. } = heat;
                let sliding_speed = heat.fastest_sliding_m_per_s;
                return Self::HeatedOils(HeatedOilRange { oils, srr, radius, modulus, speed, sliding_speed, thermal });
            }
            (Some(oils), None) => return Self::Oils(oils),
            (None, Some(heat)) => {
                return Self::Heated(HeatedRange {
                    m: domain.m,
                    l: domain.l,
                    srr: heat.srr,
                    radius: heat.radius_m.0,
                    modulus: heat.modulus_pa.0,
                    viscosity: domain.viscosity_pa_s,
                    alpha: domain.alpha_per_pa.0,
                    max_hertz_pressure: domain.max_hertz_pressure_pa,
                });
            }
            (None, None) => {}
        }
        Self::Moes {
            m: domain.m,
            l: domain.l,
            alpha: domain.alpha_per_pa,
            max_hertz_pressure: domain.max_hertz_pressure_pa,
            viscosity: domain.viscosity_pa_s,
        }
    }
}

impl Range {
    /// Whether it says how fast its contacts slide.
    pub fn slides(&self) -> bool {
        matches!(self, Self::Sliding(_) | Self::SlidingOils(_)) || self.heats()
    }

    /// Whether it is one of films with heat.
    pub fn heats(&self) -> bool {
        matches!(self, Self::Heated(_) | Self::HeatedOils(_))
    }

    /// Whether it is one of many oils.
    pub(super) fn of_oils(&self) -> bool {
        matches!(self, Self::Oils(_) | Self::HeatedOils(_) | Self::SlidingOils(_))
    }

    /// R_y/R of its contacts; that of circles where it knows these, or lines, only.
    pub fn radius_ratio(&self) -> (f64, f64) {
        match self {
            Self::Ellipses { radius_ratio, .. } => *radius_ratio,
            Self::Oils(oils)
            | Self::HeatedOils(HeatedOilRange { oils, .. })
            | Self::SlidingOils(SlidingOilRange { oils, .. }) => oils.radius_ratio,
            _ => CIRCLES,
        }
    }

    /// Coordinates that it uses of the unit cube, at least four: all of them where the last one is a shape.
    pub(super) fn coordinates(&self) -> usize {
        match self {
            _ if self.of_oils() && self.radius_ratio() != CIRCLES => 8,
            Self::HeatedOils(_) => 7,
            Self::SlidingOils(_) => 6,
            _ => 4,
        }
    }

    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        match *self {
            Self::Box(range) => range.check(),
            Self::Realisation { m, l, max_hertz_pressure } => {
                between(Quantity::M, m)?;
                between(Quantity::L, l)?;
                hertz_pressure(max_hertz_pressure)
            }
            Self::Moes { m, l, alpha, max_hertz_pressure, viscosity } => {
                between(Quantity::M, m)?;
                between(Quantity::L, l)?;
                hertz_pressure(max_hertz_pressure)?;
                between(Quantity::Alpha, alpha)?;
                single(Quantity::Viscosity, viscosity)
            }
            Self::Sliding(range) => range.check(),
            Self::Oils(range) => range.check(),
            Self::Heated(range) => range.check(),
            Self::HeatedOils(range) => range.check(),
            Self::SlidingOils(range) => range.check(),
            Self::Ellipses { m, l, radius_ratio, max_hertz_pressure } => {
                between(Quantity::M, m)?;
                between(Quantity::L, l)?;
                between(Quantity::RadiusRatio, radius_ratio)?;
                hertz_pressure(max_hertz_pressure)
            }
        }
    }

    /// The point of the test trajectory (3.21) at the running parameter c, by the first four of its quantities; `None` where
    /// the range excludes it.
    pub fn trajectory(&self, kind: ContactKind, c: f64) -> Option<OperatingPoint> {
        self.at(kind, in_the_middle_but(QuantityBox::trajectory_place(c)))
    }

    /// The operating point of a kind at coordinates in the unit cube, of which as many are used as the range has
    /// quantities; `None` where the range excludes it.
    pub(super) fn at(&self, kind: ContactKind, unit: Unit) -> Option<OperatingPoint> {
        let [a, b, c, d, ..] = unit;
        match *self {
            Self::Box(range) => Some(range.at(kind, [a, b, c, d])).filter(|point| point.check().is_ok()),
            Self::Realisation { m, l, max_hertz_pressure } => {
                up_to(max_hertz_pressure, (m, l), unit, MoesRequest::new(kind, m.0, l.0))
            }
            Self::Moes { m, l, alpha, max_hertz_pressure, viscosity } => {
                let request = MoesRequest {
                    alpha_per_pa: Some(logarithmic(alpha, unit[2])),
                    viscosity_pa_s: Some(viscosity),
                    ..MoesRequest::new(kind, m.0, l.0)
                };
                up_to(max_hertz_pressure, (m, l), unit, request)
            }
            Self::Sliding(range) => range.at(kind, unit),
            Self::Oils(range) => range.at(kind, unit),
            Self::Heated(range) => range.at(kind, unit),
            Self::HeatedOils(range) => range.at(kind, unit),
            Self::SlidingOils(range) => range.at(kind, unit),
            Self::Ellipses { m, l, radius_ratio, max_hertz_pressure } => {
                let circle = up_to(f64::INFINITY, (m, l), unit, MoesRequest::new(kind, m.0, l.0))?;
                let point = Quantity::RadiusRatio.at(&circle, logarithmic(radius_ratio, unit[2]));
                (point.check().is_ok() && point.hertz().pressure_pa <= max_hertz_pressure).then_some(point)
            }
        }
    }
}

/// Refuses an interval of a quantity that reaches beyond its limits.
pub(super) fn between(quantity: Quantity, ends: (f64, f64)) -> Result<(), Refused> {
    let (low, high) = quantity.range();
    interval(&quantity.name().to_lowercase(), ends, low, high)
}

/// Refuses a quantity beyond its limits.
pub(super) fn single(quantity: Quantity, value: f64) -> Result<(), Refused> {
    let (low, high) = quantity.range();
    number(quantity.name(), value, low, high)
}

/// Refuses a limit of p_H \[Pa\] that is none.
pub(super) fn hertz_pressure(most: f64) -> Result<(), Refused> {
    number("max_hertz_pressure", most, 1e5, 1e12)
}

pub(super) fn linear((low, high): (f64, f64), t: f64) -> f64 {
    low + (high - low) * t
}

pub(super) fn logarithmic((low, high): (f64, f64), t: f64) -> f64 {
    low * (high / low).powf(t)
}

/// The contact of a request with M and L at the first two coordinates in their intervals, unless it is pressed harder.
pub(super) fn up_to(
    max_hertz_pressure: f64,
    (m, l): ((f64, f64), (f64, f64)),
    unit: Unit,
    request: MoesRequest,
) -> Option<OperatingPoint> {
    let request = MoesRequest { m: logarithmic(m, unit[0]), l: linear(l, unit[1]), ..request };
    si_from_moes(&request).ok().filter(|point| point.hertz().pressure_pa <= max_hertz_pressure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::training::random_points;
    use crate::solver::training::small::moes;

    const LINE: ContactKind = ContactKind::Line;

    #[test]
    fn the_moes_range_respects_its_pressure_limit() {
        let range = moes((2.0, 500.0), (1.0, 20.0), 3.2e9);
        for p in random_points(&range, LINE, 300, 1) {
            assert!(p.hertz().pressure_pa <= 3.2e9);
            assert!((5e-9..=20.0001e-9).contains(&p.alpha_per_pa));
        }
        let realised = Range::Realisation { m: (2.0, 500.0), l: (1.0, 20.0), max_hertz_pressure: 3.2e9 };
        let points = random_points(&realised, LINE, 200, 1);
        assert_eq!(points.len(), 200);
        assert!(points.iter().all(|p| p.hertz().pressure_pa <= 3.2e9 && (1.99..501.0).contains(&p.moes().m)));
    }

    #[test]
    fn empty_and_inverted_ranges_are_refused() {
        for load in [(5e5, 1e5), (0.0, 1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
            let range = Range::Box(QuantityBox { load, ..QuantityBox::TABLE_3_1 });
            assert!(range.check().unwrap_err().to_string().contains("load"));
        }
    }
}
