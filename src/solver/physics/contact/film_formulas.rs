//! Published film-thickness formulas for line and circular point contacts, each with its source and range of validity.

use super::{ContactKind, Moes, OperatingPoint};
use serde::{Deserialize, Serialize};

/// A published formula, as the Regimes tab and the formula-comparison scene list them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FilmFormula {
    /// Moes' curve fit through the four asymptotes (central film).
    #[serde(rename = "Moes")]
    MoesLine,
    /// Dowson & Higginson (minimum film).
    DowsonHigginson,
    /// Dowson & Toyoda (central film).
    DowsonToyoda,
    /// Hamrock & Dowson, point contact (central film).
    HamrockDowsonCentral,
    /// Hamrock & Dowson, point contact (minimum film).
    HamrockDowsonMinimum,
    /// Nijenbanning, Venner & Moes' curve fit through the asymptotes of a point contact (central film).
    NijenbanningVennerMoes,
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
    /// All formulas for a kind of contact.
    pub fn of(kind: ContactKind) -> [Self; 3] {
        match kind {
            ContactKind::Line => Self::LINE,
            ContactKind::Point => Self::POINT,
        }
    }

    /// All line-contact formulas.
    pub const LINE: [Self; 3] = [Self::MoesLine, Self::DowsonHigginson, Self::DowsonToyoda];

    /// All point-contact formulas.
    pub const POINT: [Self; 3] = [Self::NijenbanningVennerMoes, Self::HamrockDowsonCentral, Self::HamrockDowsonMinimum];

    /// The kind of contact it was made for.
    pub fn contact(self) -> ContactKind {
        if Self::POINT.contains(&self) { ContactKind::Point } else { ContactKind::Line }
    }

    /// Short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::MoesLine => "Moes",
            Self::DowsonHigginson => "Dowson–Higginson",
            Self::DowsonToyoda => "Dowson–Toyoda",
            Self::HamrockDowsonCentral => "Hamrock–Dowson, central",
            Self::HamrockDowsonMinimum => "Hamrock–Dowson, minimum",
            Self::NijenbanningVennerMoes => "Nijenbanning–Venner–Moes",
        }
    }

    /// Whether it predicts the minimum film (else the central film).
    pub fn predicts_minimum(self) -> bool {
        matches!(self, Self::DowsonHigginson | Self::HamrockDowsonMinimum)
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
            Self::HamrockDowsonCentral => {
                "Hamrock & Dowson 1977, ASME J. Lubr. Technol. 99, h_c/R = 2.69 U^0.67 G^0.53 W^−0.067 (1 − 0.61 exp(−0.73 k)), k = 1.03 for a circle; piezoviscous-elastic regime"
            }
            Self::HamrockDowsonMinimum => {
                "Hamrock & Dowson 1977, ASME J. Lubr. Technol. 99, h_min/R = 3.63 U^0.68 G^0.49 W^−0.073 (1 − exp(−0.68 k)), k = 1.03 for a circle; piezoviscous-elastic regime"
            }
            Self::NijenbanningVennerMoes => {
                "Nijenbanning, Venner & Moes 1994, Film thickness in elastohydrodynamically lubricated elliptic contacts, Wear 176; all four regimes; real fluids deviate to both sides"
            }
        }
    }

    /// The formula's film over the radius, h/R, in U = η₀u_m/(E′R), G = αE′ and W = w/(E′R) of a line, w/(E′R²) of a
    /// point contact; meaningless for the other kind of contact.
    pub fn relative_film(self, point: &OperatingPoint) -> f64 {
        let area = match point.kind {
            ContactKind::Line => point.radius_m,
            ContactKind::Point => point.radius_m * point.radius_m,
        };
        let (u, g) = (point.speed_group() / 2.0, point.alpha_per_pa * point.modulus_pa);
        let w = point.load / (point.modulus_pa * area);
        match self {
            Self::MoesLine | Self::NijenbanningVennerMoes => {
                moes_film(self.contact(), point.moes()) * point.speed_group().sqrt()
            }
            Self::DowsonHigginson => 2.65 * g.powf(0.54) * u.powf(0.7) * w.powf(-0.13),
            Self::DowsonToyoda => 3.06 * g.powf(0.56) * u.powf(0.69) * w.powf(-0.10),
            Self::HamrockDowsonCentral => {
                2.69 * u.powf(0.67) * g.powf(0.53) * w.powf(-0.067) * (1.0 - 0.61 * (-0.73 * CIRCLE).exp())
            }
            Self::HamrockDowsonMinimum => {
                3.63 * u.powf(0.68) * g.powf(0.49) * w.powf(-0.073) * (1.0 - (-0.68 * CIRCLE).exp())
            }
        }
    }

    /// The formula's film and whether it was made for such a contact; meaningless for the other kind of contact.
    pub fn predict(self, point: &OperatingPoint) -> FilmPrediction {
        let moes = point.moes();
        let in_range = match self {
            Self::MoesLine => (5.0..=1000.0).contains(&moes.m) && moes.l <= 25.0,
            Self::NijenbanningVennerMoes => true,
            _ => moes.m >= 10.0 && moes.l >= 5.0,
        };
        FilmPrediction { film_m: self.relative_film(point) * point.radius_m, in_range }
    }
}

/// Hamrock and Dowson's ellipticity parameter 1.03 (R_y/R_x)^0.64 of a circular contact.
const CIRCLE: f64 = 1.03;

/// The four asymptotes of a film number H = (h/R)(2U)^(−1/2), as Moes' and Nijenbanning, Venner and Moes' formulas join
/// them.
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

impl FilmAsymptotes {
    /// The asymptotes at M and L: of a line contact, Moes 1992; of a circular point contact, Nijenbanning, Venner &
    /// Moes 1994 at equal radii.
    pub fn of(kind: ContactKind, Moes { m, l }: Moes) -> Self {
        match kind {
            ContactKind::Line => Self {
                rigid_isoviscous: 3.0 / m,
                elastic_isoviscous: 2.621 * m.powf(-0.2),
                rigid_piezoviscous: 1.287 * l.powf(2.0 / 3.0),
                elastic_piezoviscous: 1.311 * m.powf(-0.125) * l.powf(0.75),
            },
            ContactKind::Point => Self {
                rigid_isoviscous: 145.0 * 1.796f64.powf(-15.0 / 7.0) * m.powi(-2),
                elastic_isoviscous: 3.18 * 1.63f64.powf(-14.0 / 25.0) * m.powf(-2.0 / 15.0),
                rigid_piezoviscous: 1.29 * 1.691f64.powf(-2.0 / 3.0) * l.powf(2.0 / 3.0),
                elastic_piezoviscous: 1.48 * 1.63f64.powf(-7.0 / 20.0) * m.powf(-1.0 / 12.0) * l.powf(0.75),
            },
        }
    }
}

/// Moes' film number H = (h/R)(2U)^(−1/2) of a kind of contact, central film.
///
/// Line: Moes, Wear 159 (1992) 57–66; 5 ≤ M ≤ 1000, 0 ≤ L ≤ 25, Barus viscosity, incompressible fluid. Circular point
/// contact: Nijenbanning, Venner & Moes, Wear 176 (1994) 217–229, at equal radii. Full solutions with Barus' law and no
/// compressibility lie 8–15 % above it, with Roelands and Dowson–Higginson 6–13 % below (M 20…200, L 2.5…10, default
/// realisation).
pub fn moes_film(kind: ContactKind, moes: Moes) -> f64 {
    let a = FilmAsymptotes::of(kind, moes);
    match kind {
        ContactKind::Line => {
            let s = (7.0 + 8.0 * (-2.0 * a.elastic_isoviscous / a.rigid_isoviscous).exp()) / 5.0;
            let iso = a.rigid_isoviscous.powf(7.0 / 3.0) + a.elastic_isoviscous.powf(7.0 / 3.0);
            let piezo = a.rigid_piezoviscous.powf(-3.5) + a.elastic_piezoviscous.powf(-3.5);
            (iso.powf(3.0 * s / 7.0) + piezo.powf(-2.0 * s / 7.0)).powf(1.0 / s)
        }
        ContactKind::Point => {
            let s = 1.5 * (1.0 + (-1.2 * a.elastic_isoviscous / a.elastic_piezoviscous).exp());
            // The isoviscous elastic asymptote is cut off at 1.8, beyond which a contact is rigid.
            let iso = a.rigid_isoviscous.powf(1.5) + (a.elastic_isoviscous.powi(-4) + 1.8f64.powi(-4)).powf(-0.375);
            let piezo = a.rigid_piezoviscous.powi(-8) + a.elastic_piezoviscous.powi(-8);
            (iso.powf(2.0 * s / 3.0) + piezo.powf(-s / 8.0)).powf(1.0 / s)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moes_formula_tends_to_its_asymptotes() {
        let elastic_iso = moes_film(ContactKind::Line, Moes { m: 1e3, l: 1e-9 });
        assert!((elastic_iso / (2.621 * 1e3f64.powf(-0.2)) - 1.0).abs() < 1e-2);
        let elastic_piezo = moes_film(ContactKind::Line, Moes { m: 1e5, l: 1e3 });
        assert!((elastic_piezo / (1.311 * 1e5f64.powf(-0.125) * 1e3f64.powf(0.75)) - 1.0).abs() < 2e-2);
        let rigid_iso = moes_film(ContactKind::Line, Moes { m: 1e-3, l: 1e-9 });
        assert!((rigid_iso / 3e3 - 1.0).abs() < 1e-3);
    }

    #[test]
    fn the_point_formula_agrees_with_published_and_independent_films() {
        // Film numbers extrapolated by an independent multigrid code (Roelands, compressible): within some per cent of
        // the fit.
        for (m, l, film) in [(20.0, 5.0, 2.99), (50.0, 10.0, 4.03), (100.0, 5.0, 2.74)] {
            let fit = moes_film(ContactKind::Point, Moes { m, l });
            assert!((fit / film - 1.0).abs() < 0.05, "{m} {l}: {fit}");
        }
        let rigid = moes_film(ContactKind::Point, Moes { m: 0.01, l: 1e-9 });
        assert!((rigid / (145.0 * 1.796f64.powf(-15.0 / 7.0) * 1e4) - 1.0).abs() < 1e-3, "{rigid}");
        let point =
            OperatingPoint { kind: ContactKind::Point, load: 50.0, radius_m: 0.01, ..OperatingPoint::TABLE_2_1 };
        let ratio = FilmFormula::HamrockDowsonCentral.relative_film(&point)
            / FilmFormula::NijenbanningVennerMoes.relative_film(&point);
        assert!((0.85..1.15).contains(&ratio), "{ratio}");
    }

    #[test]
    fn formulas_agree_with_each_other_to_engineering_accuracy() {
        let film = |formula: FilmFormula| formula.relative_film(&OperatingPoint::TABLE_2_1);
        let central = film(FilmFormula::DowsonToyoda) / film(FilmFormula::MoesLine);
        assert!((0.8..1.25).contains(&central), "{central}");
        let minimum = film(FilmFormula::DowsonHigginson) / film(FilmFormula::MoesLine);
        assert!((0.6..1.1).contains(&minimum), "{minimum}");
    }
}
