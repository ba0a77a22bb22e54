//! Where contacts lie: what a model is trained for, and where random ones are drawn.

use super::{QuantityBox, SlidingRange, TrainingError};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use serde::{Deserialize, Serialize};

/// A set of contacts.
///
/// M and α spread over their ratios and everything else linearly, as the distance between contacts takes them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Range {
    /// A box of SI quantities, (3.16). Tables 3.1 and 3.4.
    Box(QuantityBox),
    /// All contacts with M, L, α in these intervals and p_H up to a limit, at η₀ and the default R (3 mm line, 10 mm point) and
    /// E′ = 231 GPa; by ln M, L and ln α.
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
    /// Refuses empty, inverted or non-finite ranges.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), TrainingError> {
        let intervals: &[(&str, (f64, f64))] = match self {
            Self::Box(QuantityBox { radius, speed, load, alpha, modulus, viscosity }) => &[
                ("radius", *radius),
                ("speed", *speed),
                ("load", *load),
                ("alpha", *alpha),
                ("modulus", (*modulus, *modulus)),
                ("viscosity", (*viscosity, *viscosity)),
            ],
            Self::Realisation { m, l, max_hertz_pressure } => {
                &[("m", *m), ("l", *l), ("max_hertz_pressure", (*max_hertz_pressure, *max_hertz_pressure))]
            }
            Self::Moes { m, l, alpha, max_hertz_pressure, viscosity } => &[
                ("m", *m),
                ("l", *l),
                ("alpha", *alpha),
                ("max_hertz_pressure", (*max_hertz_pressure, *max_hertz_pressure)),
                ("viscosity", (*viscosity, *viscosity)),
            ],
            Self::Sliding(SlidingRange { m, l, srr, npr, radius, modulus, viscosity, alpha, max_hertz_pressure }) => {
                for (name, (low, high), most) in [("srr", *srr, 10.0), ("npr", *npr, 1.0)] {
                    if !(0.0 <= low && low <= high && high <= most) {
                        return Err(TrainingError::Specification(format!(
                            "the range of {name} is {low}…{high}; both ends must lie between 0 and {most}, the first not above the second"
                        )));
                    }
                }
                &[
                    ("m", *m),
                    ("l", *l),
                    ("radius", (*radius, *radius)),
                    ("modulus", (*modulus, *modulus)),
                    ("viscosity", (*viscosity, *viscosity)),
                    ("alpha", (*alpha, *alpha)),
                    ("max_hertz_pressure", max_hertz_pressure.map_or((1.0, 1.0), |limit| (limit, limit))),
                ]
            }
        };
        for (name, (low, high)) in intervals {
            if !(low.is_finite() && high.is_finite() && *low > 0.0 && low <= high) {
                return Err(TrainingError::Specification(format!(
                    "the range of {name} is {low}…{high}; both ends must be positive and finite, the first not above the second"
                )));
            }
        }
        Ok(())
    }

    /// The operating point of a kind at coordinates in the unit cube, of which as many are used as the range has quantities; `None` where the
    /// range excludes it.
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

/// The contact of a request, unless it is pressed harder.
fn up_to(max_hertz_pressure: f64, request: &MoesRequest) -> Option<OperatingPoint> {
    si_from_moes(request).ok().filter(|point| point.hertz().pressure_pa <= max_hertz_pressure)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::training::random_points;

    const LINE: ContactKind = ContactKind::Line;

    #[test]
    fn the_moes_range_respects_its_pressure_limit() {
        let range = Range::Moes {
            m: (2.0, 500.0),
            l: (1.0, 20.0),
            alpha: (5e-9, 20e-9),
            max_hertz_pressure: 3.2e9,
            viscosity: 0.01,
        };
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
