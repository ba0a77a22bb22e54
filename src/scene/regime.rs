//! Lubrication regime of a contact: its elastic deformation compared with its film thickness, and the viscosity in it
//! compared with that at ambient pressure.

use super::table::significant;
use crate::solver::full::Solution;
use crate::solver::physics::contact::{DEFAULT_VISCOSITY_PA_S, FilmShape, Moes, MoesRequest, OperatingPoint};
use crate::solver::physics::lubricant::{ROELANDS_PRESSURE_PA, roelands_exponent};
use std::f64::consts::PI;

/// Lubrication regime.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// Rigid bodies, constant viscosity.
    RigidIsoviscous,
    /// Elastic bodies, constant viscosity.
    ElasticIsoviscous,
    /// Rigid bodies, viscosity rising with pressure.
    RigidPiezoviscous,
    /// Elastic bodies, viscosity rising with pressure.
    ElasticPiezoviscous,
}

impl Regime {
    /// Returns the name on two lines, for the chart.
    pub fn name(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "rigid,\nisoviscous",
            Self::ElasticIsoviscous => "elastic,\nisoviscous",
            Self::RigidPiezoviscous => "rigid,\npiezoviscous",
            Self::ElasticPiezoviscous => "elastic,\npiezoviscous",
        }
    }

    /// Returns the name on one line.
    pub fn title(self) -> &'static str {
        match self {
            Self::RigidIsoviscous => "Rigid, isoviscous",
            Self::ElasticIsoviscous => "Elastic, isoviscous",
            Self::RigidPiezoviscous => "Rigid, piezoviscous",
            Self::ElasticPiezoviscous => "Elastic, piezoviscous",
        }
    }

    /// True if the elastic deformation exceeds the film thickness.
    pub fn is_elastic(self) -> bool {
        matches!(self, Self::ElasticIsoviscous | Self::ElasticPiezoviscous)
    }

    /// True if pressure more than doubles the viscosity.
    pub fn is_piezoviscous(self) -> bool {
        matches!(self, Self::RigidPiezoviscous | Self::ElasticPiezoviscous)
    }
}

/// The two ratios that define the regime.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratios {
    /// Elastic deformation over central film thickness. The deformation is that of the centre relative to the ends of
    /// the Hertzian contact, X = −1 and X = 1: a²/(2R) in a dry contact, less under a thick film. Above 1 the bodies
    /// are elastic.
    pub deformation: f64,
    /// Highest viscosity in the film over that at ambient pressure. Above 2 the contact is piezoviscous.
    pub viscosity: f64,
}

impl Ratios {
    /// Returns the ratios of a computed solution, with its own lubricant.
    pub fn of(solution: &Solution) -> Self {
        let axis: Vec<(f64, f64)> = solution.profile().map(|(x, _, film)| (x, film)).collect();
        let film = |x: f64| {
            let after = axis.partition_point(|(at, _)| *at < x).clamp(1, axis.len().saturating_sub(1).max(1));
            match (axis.get(after - 1), axis.get(after)) {
                (Some((x0, h0)), Some((x1, h1))) => h0 + (h1 - h0) * (x - x0) / (x1 - x0),
                _ => f64::NAN,
            }
        };
        // H = H₀ + X²/2 + deformation on the axis.
        let deformation = (0.5 + film(0.0) - 0.5 * (film(-1.0) + film(1.0))).max(0.0);
        let viscosity = solution.problem.fluid.at(solution.scalars.p_max).viscosity;
        // The mean planes of rough surfaces may touch; their mean gap is positive.
        let h_c = solution.scalars.h_c;
        let gap = solution.problem.rough.map_or(h_c, |rough| rough.mean_gap(h_c).0);
        Self { deformation: deformation / gap, viscosity }
    }

    /// Returns the regime.
    pub fn regime(self) -> Regime {
        match (self.deformation > 1.0, self.viscosity > 2.0) {
            (false, false) => Regime::RigidIsoviscous,
            (true, false) => Regime::ElasticIsoviscous,
            (false, true) => Regime::RigidPiezoviscous,
            (true, true) => Regime::ElasticPiezoviscous,
        }
    }

    /// Returns both ratios in one line.
    pub fn describe(self) -> String {
        let bodies = if self.regime().is_elastic() { "The bodies flatten" } else { "The bodies hardly flatten" };
        let flat = match self.deformation {
            ..0.01 => "less than 0.01".to_owned(),
            _ => whole(self.deformation),
        };
        let viscosity = match self.viscosity - 1.0 {
            ..1.0 => format!("the viscosity rises by {:.0} % at most", 100.0 * (self.viscosity - 1.0)),
            1.0..1e4 => format!("pressure raises the viscosity up to {} times", whole(self.viscosity)),
            _ => "pressure raises the viscosity more than 10,000 times".to_owned(),
        };
        format!("{bodies}, by {flat} × the film thickness; {viscosity}")
    }
}

/// Returns a number with two significant digits, or without decimals.
fn whole(value: f64) -> String {
    if value < 10.0 {
        return significant(value, 2);
    }
    let unit = 10f64.powi(value.log10().floor() as i32 - 1);
    let digits = format!("{:.0}", (value / unit).round() * unit);
    match digits.len() {
        4.. => format!("{},{}", &digits[..digits.len() - 3], &digits[digits.len() - 3..]),
        _ => digits,
    }
}

/// Estimate of the ratios everywhere on the chart of M and L, for contacts of one shape. It holds for fully flooded,
/// isothermal contacts with an oil of Roelands' law whose α is that of the default realisation of M and L.
#[derive(Clone, Copy, Debug)]
pub struct RegimeMap {
    shape: FilmShape,
    /// (a of a circular contact / a)² at the same R, load and modulus.
    film: f64,
    /// p_H over that of a circular contact.
    pressure: f64,
}

impl RegimeMap {
    /// Prepares the estimate for a shape.
    pub fn new(shape: FilmShape) -> Self {
        let [own, circle] = shape.hertz_and_circle();
        let film = (circle.half_width_m / own.half_width_m).powi(2);
        Self { shape, film, pressure: own.pressure_pa / circle.pressure_pa }
    }

    /// Returns the estimated ratios at M and L.
    pub fn at(&self, moes: Moes) -> Ratios {
        let Moes { m, l } = moes;
        // (H_c in units of a²/R) / Ĥ_c, and α p_H.
        let (unit, hertz) = match self.shape {
            FilmShape::Line => (PI / (8.0 * m), l * (m / (2.0 * PI)).sqrt()),
            FilmShape::Ellipse(_) => {
                let circle = (1.5 * m).cbrt();
                (self.film / circle.powi(2), self.pressure * l * circle / PI)
            }
        };
        let film = unit * self.shape.film(moes);
        // A thick film spreads the pressure beyond the Hertzian contact, less so if the viscosity rises.
        let spread = film / (1.0 + 0.4 * hertz);
        // Below the pressure that doubles the viscosity, the pressure is about that of the isoviscous film.
        let isoviscous = unit * self.shape.film(Moes { m, l: 0.0 });
        let (flattening, pressure) = match self.shape {
            FilmShape::Line => (0.5 * (-0.65 * spread).exp(), (1.0 + 0.7 * isoviscous).powf(-0.5)),
            FilmShape::Ellipse(_) => {
                let thick = 3.4 * isoviscous * isoviscous / (1.0 + isoviscous);
                (0.5 * (-1.1 * spread).exp(), (1.0 + 0.4 * isoviscous + thick).recip())
            }
        };
        let alpha = MoesRequest::new(self.shape.kind(), m, l).default_alpha();
        Ratios { deformation: flattening / (COMPRESSED * film), viscosity: roelands(hertz * pressure, alpha) }
    }

    /// Returns the regime at M and L.
    pub fn regime(&self, moes: Moes) -> Regime {
        self.at(moes).regime()
    }
}

/// Film thickness of compressible oils over that of Moes' formula.
const COMPRESSED: f64 = 0.92;

/// Returns η/η₀ by Roelands' law at α p, for α \[1/Pa\] and the viscosity of the default realisation.
fn roelands(alpha_pressure: f64, alpha: f64) -> f64 {
    if alpha == 0.0 {
        return 1.0;
    }
    let z = roelands_exponent(&OperatingPoint {
        alpha_per_pa: alpha,
        viscosity_pa_s: DEFAULT_VISCOSITY_PA_S,
        ..OperatingPoint::TABLE_2_1
    });
    let reference = alpha * ROELANDS_PRESSURE_PA;
    (reference / z * ((1.0 + alpha_pressure / reference).powf(z) - 1.0)).exp()
}
