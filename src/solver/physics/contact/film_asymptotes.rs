//! The four asymptotes of the film thickness, and formulas that join them: Moes' for line contacts, and that of
//! Nijenbanning, Venner and Moes for elliptical contacts.

use super::{ContactKind, Hertz, Moes, OperatingPoint};
use std::f64::consts::PI;

/// The four asymptotes of a film number H = (h/R)(2U)^(−1/2), as joined by the formulas of Moes and of Nijenbanning,
/// Venner and Moes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmAsymptotes {
    /// Rigid bodies, constant viscosity.
    pub rigid_isoviscous: f64,
    /// Elastic bodies, constant viscosity.
    pub elastic_isoviscous: f64,
    /// Rigid bodies, viscosity rising with pressure.
    pub rigid_piezoviscous: f64,
    /// Elastic bodies, viscosity rising with pressure.
    pub elastic_piezoviscous: f64,
}

/// Shape of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilmShape {
    /// Line contact.
    Line,
    /// Elliptical contact with radii R_y/R across and along the rolling direction; circular if the ratio is 1.
    Ellipse(f64),
}

impl FilmShape {
    /// Circular contact.
    pub const CIRCLE: Self = Self::Ellipse(1.0);

    /// Returns the shape of a contact.
    pub fn of(point: &OperatingPoint) -> Self {
        if point.kind.is_line() { Self::Line } else { Self::Ellipse(point.radius_ratio()) }
    }

    /// Returns its kind of contact.
    pub fn kind(self) -> ContactKind {
        match self {
            Self::Line => ContactKind::Line,
            Self::Ellipse(_) => ContactKind::Point,
        }
    }

    /// Returns its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "line contact",
            Self::CIRCLE => "circular contact",
            Self::Ellipse(_) => "elliptical contact",
        }
    }

    /// Returns the Hertzian scales of an elliptical contact, and those of a circular contact with the same R, load and
    /// modulus. Only their ratios have a meaning; they are 1 for a line contact.
    pub fn hertz_and_circle(self) -> [Hertz; 2] {
        let contact = OperatingPoint { kind: self.kind(), ..OperatingPoint::TABLE_2_1 };
        let radius_y_m = match self {
            Self::Line => None,
            Self::Ellipse(radius_ratio) => Some(radius_ratio * contact.radius_m),
        };
        [OperatingPoint { radius_y_m, ..contact }, contact].map(|point| point.hertz())
    }

    /// Returns the factor 3 + 2R/R_y of the pressure P = −λ̄X/(3 + 2R/R_y)/H² far from the contact; 3 for a line
    /// contact. H is the film thickness, λ̄ the speed parameter of (2.23). Source: Kapitza 1955.
    pub fn far_field_factor(self) -> f64 {
        match self {
            Self::Line => 3.0,
            Self::Ellipse(radius_ratio) => 3.0 + 2.0 / radius_ratio,
        }
    }

    /// Returns the film number H = (h/R)(2U)^(−1/2) of the central film thickness.
    ///
    /// Line contact: Moes, Wear 159 (1992) 57–66; 5 ≤ M ≤ 1000, 0 ≤ L ≤ 25, Barus viscosity, incompressible fluid.
    ///
    /// Circular and elliptical contact: Nijenbanning, Venner and Moes, Wear 176 (1994) 217–229. The formula covers all
    /// regimes; its accuracy is shown there for R_y/R ≥ 1. For circular contacts full solutions with Barus' law and no
    /// compressibility lie 8–15 % above it, with Roelands and Dowson–Higginson 6–13 % below (M 20…200, L 2.5…10,
    /// default realisation).
    pub fn film(self, moes: Moes) -> f64 {
        match self {
            Self::Line => line_film(moes),
            Self::Ellipse(radius_ratio) => ellipse_film(radius_ratio, moes),
        }
    }
}

impl FilmAsymptotes {
    /// Returns the asymptotes at M and L: for a line contact, Moes 1992; for an elliptical contact, Nijenbanning,
    /// Venner & Moes 1994.
    pub fn of(shape: FilmShape, moes: Moes) -> Self {
        let Moes { m, l } = moes;
        match shape {
            FilmShape::Line => Self {
                rigid_isoviscous: 3.0 / m,
                elastic_isoviscous: 2.621 * m.powf(-0.2),
                rigid_piezoviscous: 1.287 * l.powf(2.0 / 3.0),
                elastic_piezoviscous: 1.311 * m.powf(-0.125) * l.powf(0.75),
            },
            FilmShape::Ellipse(radius_ratio) => Self::of_ellipse(radius_ratio, moes),
        }
    }

    /// Returns the asymptotes of an elliptical contact with radii R_y/R = `radius_ratio` (above 0) across and along
    /// the rolling direction, for M and L with R along it: Nijenbanning, Venner & Moes 1994.
    fn of_ellipse(radius_ratio: f64, Moes { m, l }: Moes) -> Self {
        let d = radius_ratio.recip();
        let g = 1.0 + 0.006 * d.ln() + 0.63 * d.powf(4.0 / 7.0);
        Self {
            rigid_isoviscous: 145.0 * (1.0 + 0.796 * d.powf(14.0 / 15.0)).powf(-15.0 / 7.0) / d * m.powi(-2),
            elastic_isoviscous: 3.18 * g.powf(-14.0 / 25.0) * d.powf(-1.0 / 15.0) * m.powf(-2.0 / 15.0),
            rigid_piezoviscous: 1.29 * (1.0 + 0.691 * d).powf(-2.0 / 3.0) * l.powf(2.0 / 3.0),
            elastic_piezoviscous: 1.48 * g.powf(-7.0 / 20.0) * d.powf(-1.0 / 24.0) * m.powf(-1.0 / 12.0) * l.powf(0.75),
        }
    }
}

/// Returns Moes' film number of a line contact, see [`FilmShape::film`].
fn line_film(moes: Moes) -> f64 {
    let a = FilmAsymptotes::of(FilmShape::Line, moes);
    let s = (7.0 + 8.0 * (-2.0 * a.elastic_isoviscous / a.rigid_isoviscous).exp()) / 5.0;
    let iso = a.rigid_isoviscous.powf(7.0 / 3.0) + a.elastic_isoviscous.powf(7.0 / 3.0);
    let piezo = a.rigid_piezoviscous.powf(-3.5) + a.elastic_piezoviscous.powf(-3.5);
    (iso.powf(3.0 * s / 7.0) + piezo.powf(-2.0 * s / 7.0)).powf(1.0 / s)
}

/// Returns Nijenbanning, Venner and Moes' film number of an elliptical contact, see [`FilmShape::film`].
/// `radius_ratio` (above 0) is R_y/R, the ratio of the radii across and along the rolling direction.
fn ellipse_film(radius_ratio: f64, moes: Moes) -> f64 {
    let a = FilmAsymptotes::of_ellipse(radius_ratio, moes);
    let s = 1.5 * (1.0 + (-1.2 * a.elastic_isoviscous / a.elastic_piezoviscous).exp());
    // The isoviscous-elastic asymptote is limited where the contact is rigid.
    let rigid = 1.8 * radius_ratio;
    let iso = a.rigid_isoviscous.powf(1.5) + (a.elastic_isoviscous.powi(-4) + rigid.powi(-4)).powf(-0.375);
    let piezo = a.rigid_piezoviscous.powi(-8) + a.elastic_piezoviscous.powi(-8);
    (iso.powf(2.0 * s / 3.0) + piezo.powf(-s / 8.0)).powf(1.0 / s)
}

/// Returns the central film thickness H_c in units of a²/R by the formula for a contact's shape, [`FilmShape::film`].
pub fn expected_film(point: &OperatingPoint) -> f64 {
    let (shape, moes) = (FilmShape::of(point), point.moes());
    let film = shape.film(moes);
    match shape {
        // (a/R)² = (8/π) M √(2U) of a line contact, and h/R = Ĥ √(2U).
        FilmShape::Line => film * PI / (8.0 * moes.m),
        // (a/R)³ = (3J_x/π) M (2U)^¾ of an elliptical contact, where J_x = π/2 for a circular one.
        FilmShape::CIRCLE => film * (1.5 * moes.m).powf(-2.0 / 3.0),
        FilmShape::Ellipse(_) => film * (3.0 * point.ellipse().integral * moes.m / PI).powf(-2.0 / 3.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moes_formula_tends_to_its_asymptotes() {
        let elastic_iso = FilmShape::Line.film(Moes { m: 1e3, l: 1e-9 });
        assert!((elastic_iso / (2.621 * 1e3f64.powf(-0.2)) - 1.0).abs() < 1e-2);
        let elastic_piezo = FilmShape::Line.film(Moes { m: 1e5, l: 1e3 });
        assert!((elastic_piezo / (1.311 * 1e5f64.powf(-0.125) * 1e3f64.powf(0.75)) - 1.0).abs() < 2e-2);
        let rigid_iso = FilmShape::Line.film(Moes { m: 1e-3, l: 1e-9 });
        assert!((rigid_iso / 3e3 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn the_expected_film_has_the_unit_of_the_solver() {
        let ball = OperatingPoint { kind: ContactKind::Point, load: 50.0, radius_m: 0.01, ..OperatingPoint::TABLE_2_1 };
        let ellipse = |ratio: f64| OperatingPoint { radius_y_m: Some(ratio * ball.radius_m), ..ball };
        for point in [OperatingPoint::TABLE_2_1, ball, ellipse(0.5), ellipse(8.0), ellipse(200.0)] {
            let ratio = expected_film(&point) * point.film_scale_m() / point.formula_film_m();
            assert!((ratio - 1.0).abs() < 1e-9, "{point:?}: {ratio}");
        }
    }

    #[test]
    fn the_fit_of_ellipses_tends_to_its_asymptotes() {
        for ratio in [0.1, 0.5, 1.0, 4.0, 40.0] {
            let close = |m: f64, l: f64, asymptote: fn(&FilmAsymptotes) -> f64| {
                let moes = Moes { m, l };
                let ratio_to = ellipse_film(ratio, moes) / asymptote(&FilmAsymptotes::of_ellipse(ratio, moes));
                assert!((ratio_to - 1.0).abs() < 0.02, "R_y/R {ratio}, M {m}, L {l}: {ratio_to}");
            };
            close(1e-4, 1e-9, |a| a.rigid_isoviscous);
            close(1e15, 1e-9, |a| a.elastic_isoviscous);
            close(100.0, 1e6, |a| a.rigid_piezoviscous);
            close(1e24, 1e6, |a| a.elastic_piezoviscous);
        }
    }

    #[test]
    fn asymptotes_of_wide_ellipses_are_those_of_lines() {
        let line = FilmAsymptotes::of(FilmShape::Line, Moes { m: 1.0, l: 8.0 }).rigid_piezoviscous;
        let wide = FilmAsymptotes::of_ellipse(1e4, Moes { m: 1.0, l: 8.0 }).rigid_piezoviscous;
        assert!((wide / line - 1.0).abs() < 5e-3, "{wide}");
        // Rigid ellipsoids in an isoviscous film by another fit: Brewe, Hamrock & Taylor 1979, for the minimum film
        // thickness. It equals the central one of rigid bodies.
        for ratio in [0.1f64, 0.5, 1.0, 5.0, 40.0] {
            let side = (1.0 + 2.0 / (3.0 * ratio)).recip() * (0.131 * (0.5 * ratio).atan() + 1.683);
            let other = 32.0 * ratio * side * side;
            let own = FilmAsymptotes::of_ellipse(ratio, Moes { m: 1.0, l: 1.0 }).rigid_isoviscous;
            assert!((0.78..0.90).contains(&(other / own)), "{ratio}: {own} against {other}");
        }
    }

    #[test]
    fn wide_ellipses_have_the_film_of_an_equal_line() {
        // κ = b/a and J_x = πE′a³/(3wR) of the Hertzian ellipse of R_y/R = 20, by Carlson's integrals.
        let (ratio, kappa, j) = (20.0, 6.9286809644, 0.2830404228f64);
        for (m, l) in [(200.0, 6.0), (1000.0, 10.0), (2000.0, 15.0)] {
            let load = 0.5 * PI * (3.0 * m * j / PI).powf(2.0 / 3.0) / f64::powi(kappa * j, 2);
            let line = FilmShape::Line.film(Moes { m: load, l });
            let film = ellipse_film(ratio, Moes { m, l }) / line;
            assert!((0.9..1.02).contains(&film), "M {m}, L {l}: {film}");
        }
    }
}
