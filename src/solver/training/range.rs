//! Where contacts lie: what a model is trained for, and where random ones are drawn.

use super::{QuantityBox, SlidingRange};
use crate::solver::limits::{Refused, interval, number};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Quantity, si_from_moes};
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
    /// All contacts with M and L in these intervals and p_H up to a limit, in the default realisation; by ln M and L.
    Realisation {
        /// Load number.
        m: (f64, f64),
        /// Lubricant number.
        l: (f64, f64),
        /// Largest p_H \[Pa\].
        max_hertz_pressure: f64,
    },
}

impl Range {
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
        }
    }

    /// The operating point of a kind at coordinates in the unit cube, of which as many are used as the range has
    /// quantities; `None` where the range excludes it.
    pub fn at(&self, kind: ContactKind, unit: [f64; 4]) -> Option<OperatingPoint> {
        let linear = |(low, high): (f64, f64), t: f64| low + (high - low) * t;
        let logarithmic = |(low, high): (f64, f64), t: f64| low * (high / low).powf(t);
        match *self {
            Self::Box(range) => {
                let point = range.at(kind, unit);
                point.check().ok().map(|()| point)
            }
            Self::Realisation { m, l, max_hertz_pressure } => {
                let request = MoesRequest::new(kind, logarithmic(m, unit[0]), linear(l, unit[1]));
                up_to(max_hertz_pressure, &request)
            }
            Self::Moes { m, l, alpha, max_hertz_pressure, viscosity } => {
                let request = MoesRequest {
                    alpha_per_pa: Some(logarithmic(alpha, unit[2])),
                    viscosity_pa_s: Some(viscosity),
                    ..MoesRequest::new(kind, logarithmic(m, unit[0]), linear(l, unit[1]))
                };
                up_to(max_hertz_pressure, &request)
            }
            Self::Sliding(range) => range.at(kind, unit),
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

/// The contact of a request, unless it is pressed harder.
fn up_to(max_hertz_pressure: f64, request: &MoesRequest) -> Option<OperatingPoint> {
    si_from_moes(request).ok().filter(|point| point.hertz().pressure_pa <= max_hertz_pressure)
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
