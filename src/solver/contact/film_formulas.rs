//! Published film-thickness formulas for line contacts, each with its source and range of validity.

use super::{ContactKind, Moes, OperatingPoint};

/// A published formula, as the Regimes tab and the formula-comparison scene list them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmFormula {
    /// Moes' curve fit through the four asymptotes (central film).
    MoesLine,
    /// Dowson & Higginson (minimum film).
    DowsonHigginson,
    /// Dowson & Toyoda (central film).
    DowsonToyoda,
}

/// What a formula says of one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmPrediction {
    /// Film thickness h/R \[-\] times R \[m\].
    pub film_m: f64,
    /// Whether the contact lies in the range the formula was fitted to.
    pub in_range: bool,
}

impl FilmFormula {
    /// All line-contact formulas.
    pub const LINE: [Self; 3] = [Self::MoesLine, Self::DowsonHigginson, Self::DowsonToyoda];

    /// Short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::MoesLine => "Moes",
            Self::DowsonHigginson => "Dowson–Higginson",
            Self::DowsonToyoda => "Dowson–Toyoda",
        }
    }

    /// Whether it predicts the minimum film (else the central film).
    pub fn predicts_minimum(self) -> bool {
        self == Self::DowsonHigginson
    }

    /// Source and range of validity in one sentence.
    pub fn source(self) -> &'static str {
        match self {
            Self::MoesLine => {
                "Moes 1992, Optimum similarity analysis with applications to elastohydrodynamic lubrication, Wear 159; Barus viscosity, incompressible; M 5…1000, L 0…25"
            }
            Self::DowsonHigginson => {
                "Dowson & Higginson 1966 (as revised by Dowson 1968), h_min/R = 2.65 G^0.54 U^0.7 W^−0.13; piezoviscous-elastic regime"
            }
            Self::DowsonToyoda => {
                "Dowson & Toyoda 1979, h_c/R = 3.06 G^0.56 U^0.69 W^−0.10; piezoviscous-elastic regime"
            }
        }
    }

    /// The formula's film for a line contact.
    pub fn predict(self, point: &OperatingPoint) -> FilmPrediction {
        let moes = point.moes();
        let relative = match self {
            Self::MoesLine => moes_line_central(point),
            Self::DowsonHigginson => dowson_higginson_minimum(point),
            Self::DowsonToyoda => dowson_toyoda_central(point),
        };
        let in_range = match self {
            Self::MoesLine => (5.0..=1000.0).contains(&moes.m) && moes.l <= 25.0,
            _ => moes.m >= 10.0 && moes.l >= 5.0,
        };
        FilmPrediction { film_m: relative * point.radius_m, in_range }
    }
}

/// Moes' film number H = (h/R)(2U)^(−1/2) for a line contact, with the asymptotes rigid/elastic × isoviscous/piezoviscous.
///
/// Source: Moes, Wear 159 (1992) 57–66. Valid for 5 ≤ M ≤ 1000, 0 ≤ L ≤ 25, Barus viscosity, incompressible fluid.
pub fn moes_line_film(Moes { m, l }: Moes) -> f64 {
    let rigid_iso = 3.0 / m;
    let elastic_iso = 2.621 * m.powf(-0.2);
    let rigid_piezo = 1.287 * l.powf(2.0 / 3.0);
    let elastic_piezo = 1.311 * m.powf(-0.125) * l.powf(0.75);
    let s = (7.0 + 8.0 * (-2.0 * elastic_iso / rigid_iso).exp()) / 5.0;
    let iso = rigid_iso.powf(7.0 / 3.0) + elastic_iso.powf(7.0 / 3.0);
    let piezo = rigid_piezo.powf(-3.5) + elastic_piezo.powf(-3.5);
    (iso.powf(3.0 * s / 7.0) + piezo.powf(-2.0 * s / 7.0)).powf(1.0 / s)
}

/// Moes' central film as h_c/R.
pub fn moes_line_central(point: &OperatingPoint) -> f64 {
    moes_line_film(point.moes()) * point.speed_group().sqrt()
}

/// Dowson–Higginson minimum film as h_min/R, in U = η₀u_m/(E′R), G = αE′, W = w/(E′R).
pub fn dowson_higginson_minimum(point: &OperatingPoint) -> f64 {
    let (u, g, w) = groups(point);
    2.65 * g.powf(0.54) * u.powf(0.7) * w.powf(-0.13)
}

/// Dowson–Toyoda central film as h_c/R.
pub fn dowson_toyoda_central(point: &OperatingPoint) -> f64 {
    let (u, g, w) = groups(point);
    3.06 * g.powf(0.56) * u.powf(0.69) * w.powf(-0.10)
}

/// Hamrock–Dowson central film of a circular point contact as h_c/R, in U = η₀u_m/(E′R), G = αE′, W = w/(E′R²).
pub fn hamrock_dowson_central(point: &OperatingPoint) -> f64 {
    let (u, g, w) = groups(point);
    2.69 * u.powf(0.67) * g.powf(0.53) * w.powf(-0.067) * (1.0 - 0.61 * (-0.73f64).exp())
}

/// Hamrock–Dowson minimum film of a circular point contact as h_min/R.
pub fn hamrock_dowson_minimum(point: &OperatingPoint) -> f64 {
    let (u, g, w) = groups(point);
    3.63 * u.powf(0.68) * g.powf(0.49) * w.powf(-0.073) * (1.0 - (-0.68f64).exp())
}

fn groups(point: &OperatingPoint) -> (f64, f64, f64) {
    let area = match point.kind {
        ContactKind::Line => point.radius_m,
        ContactKind::Point => point.radius_m * point.radius_m,
    };
    (point.speed_group() / 2.0, point.alpha_per_pa * point.modulus_pa, point.load / (point.modulus_pa * area))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moes_formula_tends_to_its_asymptotes() {
        let elastic_iso = moes_line_film(Moes { m: 1e3, l: 1e-9 });
        assert!((elastic_iso / (2.621 * 1e3f64.powf(-0.2)) - 1.0).abs() < 1e-2);
        let elastic_piezo = moes_line_film(Moes { m: 1e5, l: 1e3 });
        assert!((elastic_piezo / (1.311 * 1e5f64.powf(-0.125) * 1e3f64.powf(0.75)) - 1.0).abs() < 2e-2);
        let rigid_iso = moes_line_film(Moes { m: 1e-3, l: 1e-9 });
        assert!((rigid_iso / 3e3 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn formulas_agree_with_each_other_to_engineering_accuracy() {
        let point = OperatingPoint::TABLE_2_1;
        let central = dowson_toyoda_central(&point) / moes_line_central(&point);
        assert!((0.8..1.25).contains(&central), "{central}");
        let minimum = dowson_higginson_minimum(&point) / moes_line_central(&point);
        assert!((0.6..1.1).contains(&minimum), "{minimum}");
    }
}
