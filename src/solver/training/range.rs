//! Where contacts lie: what a model is trained for, and where random ones are drawn.

use super::heated_range::{HeatedOilRange, HeatedRange};
use super::oil_range::OilRange;
use super::sliding_oil_range::SlidingOilRange;
use crate::solver::limits::{Refused, interval, number};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Quantity, Sliding, si_from_moes};
use crate::solver::reduced::{CIRCLES, Domain, EyringDomain, HeatDomain};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

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

/// Intervals of R, u_m, w and α at fixed E′ and η₀, as Table 3.1 gives them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct QuantityBox {
    /// Radius \[m\].
    pub radius: (f64, f64),
    /// Speed \[m/s\].
    pub speed: (f64, f64),
    /// Load \[N/m\] (line) or \[N\] (point).
    pub load: (f64, f64),
    /// Pressure–viscosity coefficient \[1/Pa\].
    pub alpha: (f64, f64),
    /// Reduced modulus \[Pa\].
    pub modulus: f64,
    /// Viscosity at ambient pressure \[Pa·s\].
    pub viscosity: f64,
}

impl QuantityBox {
    /// Table 3.1 of the dissertation.
    pub const TABLE_3_1: Self = Self {
        radius: (2e-3, 4e-3),
        speed: (1.0, 10.0),
        load: (1e5, 5e5),
        alpha: (5e-9, 20e-9),
        modulus: 231e9,
        viscosity: 0.01,
    };

    /// The dissertation's box for a kind of contact.
    pub fn of_tables(kind: ContactKind) -> Self {
        match kind {
            ContactKind::Line => Self::TABLE_3_1,
            ContactKind::Point => Self::TABLE_3_4,
        }
    }

    /// The dissertation's Table 3.4, whose printed radii and loads contradict its M and L: with these they hold.
    pub const TABLE_3_4: Self = Self { radius: (10e-3, 20e-3), load: (20.0, 100.0), ..Self::TABLE_3_1 };

    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        between(Quantity::Radius, self.radius)?;
        between(Quantity::Speed, self.speed)?;
        between(Quantity::Load, self.load)?;
        between(Quantity::Alpha, self.alpha)?;
        single(Quantity::Modulus, self.modulus)?;
        single(Quantity::Viscosity, self.viscosity)
    }

    /// The point of a kind at fractions (0…1) of radius, speed, load and alpha.
    pub fn at(&self, kind: ContactKind, [radius, speed, load, alpha]: [f64; 4]) -> OperatingPoint {
        OperatingPoint {
            kind,
            radius_m: linear(self.radius, radius),
            speed_m_per_s: linear(self.speed, speed),
            load: linear(self.load, load),
            modulus_pa: self.modulus,
            viscosity_pa_s: self.viscosity,
            alpha_per_pa: linear(self.alpha, alpha),
            sliding: Sliding::NONE,
            radius_y_m: None,
        }
    }

    /// The point of the test trajectory (3.21) at the running parameter c.
    pub fn trajectory(&self, kind: ContactKind, c: f64) -> OperatingPoint {
        self.at(kind, Self::trajectory_place(c))
    }

    /// Its coordinates in the unit cube.
    pub fn trajectory_place(c: f64) -> [f64; 4] {
        [3.0, 4.0, 5.0, 2.0].map(|halves: f64| 0.5 + 0.5 * (halves * PI * c).sin())
    }
}

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

    #[test]
    fn the_trajectory_starts_in_the_middle_and_stays_in_the_box() {
        let range = QuantityBox::TABLE_3_1;
        let middle = [3e-3, 5.5, 3e5, 231e9, 0.01, 12.5e-9];
        assert!(
            range
                .trajectory(ContactKind::Line, 0.0)
                .quantities()
                .iter()
                .zip(middle)
                .all(|(q, m)| (q / m - 1.0).abs() < 1e-14)
        );
        for i in 0..=1000 {
            let point = range.trajectory(ContactKind::Line, i as f64 / 500.0);
            assert!((2e-3..=4e-3).contains(&point.radius_m) && (1e5..=5e5).contains(&point.load));
        }
    }

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
