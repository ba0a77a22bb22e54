//! The quantities of a contact, each defined once: names, symbol, units, ranges, and how it moves an operating point.

use super::{ContactKind, Ellipse, OperatingPoint};
use serde::{Deserialize, Serialize};

/// A quantity of a contact. The names of the variants are those of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Quantity {
    /// Load number M.
    M,
    /// Lubricant number L.
    L,
    /// Reduced radius R \[m\].
    Radius,
    /// Reduced radius across R_y \[m\], of a point contact.
    RadiusY,
    /// R_y/R, of a point contact.
    RadiusRatio,
    /// Mean entrainment speed u_m \[m/s\].
    Speed,
    /// Load w: \[N/m\] for a line, \[N\] for a point contact.
    Load,
    /// Reduced modulus E′ \[Pa\].
    Modulus,
    /// Viscosity at ambient pressure η₀ \[Pa·s\].
    Viscosity,
    /// Pressure–viscosity coefficient α \[1/Pa\].
    Alpha,
    /// Slide-to-roll ratio SRR.
    SlideToRollRatio,
    /// Newtonian plateau ratio NPR.
    NewtonianPlateauRatio,
}

/// What [`Quantity::facts`] lists.
type Facts = (&'static str, &'static str, (&'static str, &'static str), &'static str, (f64, f64));

impl Quantity {
    /// The six in SI units, in the order of [`OperatingPoint::quantities`].
    pub const SI: [Self; 6] = [Self::Radius, Self::Speed, Self::Load, Self::Modulus, Self::Viscosity, Self::Alpha];

    /// Its word, its label, its symbol with the subscript of that, its unit and its range.
    const fn facts(self) -> Facts {
        match self {
            Self::M => ("M", "Load number M", ("M", ""), "", (0.05, 1e5)),
            Self::L => ("L", "Lubricant number L", ("L", ""), "", (1e-3, 1e3)),
            Self::Radius => ("radius", "Radius R [m]", ("R", ""), " m", (1e-6, 1e3)),
            Self::RadiusY => ("radius-y", "Radius across R_y [m]", ("R", "y"), " m", (1e-7, 1e5)),
            Self::RadiusRatio => ("radius-ratio", "Ratio of radii R_y/R", ("R_y/R", ""), "", Ellipse::RADIUS_RATIOS),
            Self::Speed => ("speed", "Entrainment speed u_m [m/s]", ("u", "m"), " m/s", (1e-9, 1e4)),
            Self::Load => ("load", "Load w [N/m or N]", ("w", ""), " N (or N/m)", (1e-6, 1e10)),
            Self::Modulus => ("modulus", "Reduced modulus E’ [Pa]", ("E'", ""), " Pa", (1e5, 1e14)),
            Self::Viscosity => ("viscosity", "Viscosity η₀ [Pa s]", ("η", "0"), " Pa·s", (1e-6, 1e4)),
            Self::Alpha => ("alpha", "Pressure–viscosity coefficient α [1/Pa]", ("α", ""), " 1/Pa", (1e-12, 1e-5)),
            Self::SlideToRollRatio => ("srr", "Slide-to-roll ratio SRR", ("SRR", ""), "", (-10.0, 10.0)),
            Self::NewtonianPlateauRatio => ("npr", "Newtonian plateau ratio NPR", ("NPR", ""), "", (0.0, 1.0)),
        }
    }

    /// The word that stands for it in tables, options and messages.
    pub fn name(self) -> &'static str {
        self.facts().0
    }

    /// Its name for people, with symbol and SI unit.
    pub fn label(self) -> &'static str {
        self.facts().1
    }

    /// Its symbol and the subscript of that.
    pub fn symbol(self) -> (&'static str, &'static str) {
        self.facts().2
    }

    /// What it is, and its equation.
    pub fn meaning(self, kind: ContactKind) -> &'static str {
        match (self, kind) {
            (Self::M, ContactKind::Line) => "Load number M = w/(E’R) · (2η₀u_m/(E’R))^(−1/2) (3.19)",
            (Self::M, ContactKind::Point) => "Load number M = w/(E’R²) · (2η₀u_m/(E’R))^(−3/4) (3.22)",
            (Self::L, _) => "Lubricant number L = αE’ · (2η₀u_m/(E’R))^(1/4)",
            (Self::Radius, _) => "Reduced radius of curvature, 1/R = 1/R₁ + 1/R₂ (2.3)",
            (Self::RadiusY, _) => "Reduced radius across the rolling direction, 1/R_y = 1/R_y1 + 1/R_y2",
            (Self::RadiusRatio, _) => "Radius across over radius along: 1 is a circle, large ones are nearly lines",
            (Self::Speed, _) => "Mean entrainment speed, u_m = (u₁ + u₂)/2 (2.1)",
            (Self::Load, ContactKind::Line) => "Load per unit length of the line contact (2.9)",
            (Self::Load, ContactKind::Point) => "Load of the point contact (2.9)",
            (Self::Modulus, _) => "Reduced modulus, 2/E’ = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ (2.5)",
            (Self::Viscosity, _) => "Viscosity at ambient pressure",
            (Self::Alpha, _) => "Pressure–viscosity coefficient, the slope of ln η at ambient pressure",
            (Self::SlideToRollRatio, _) => "Slide-to-roll ratio SRR = (u₂ − u₁)/u_m (3.25)",
            (Self::NewtonianPlateauRatio, _) => "Newtonian plateau ratio NPR of (3.40)",
        }
    }

    /// Its SI unit as it stands behind a number: with a leading space, or empty.
    pub fn unit(self) -> &'static str {
        self.facts().3
    }

    /// The unit in which people read it, and SI units in that.
    pub fn reading_unit(self, kind: ContactKind) -> (&'static str, f64) {
        match (self, kind) {
            (Self::Radius | Self::RadiusY, _) => ("mm", 1e-3),
            (Self::Speed, _) => ("m/s", 1.0),
            (Self::Load, ContactKind::Line) => ("kN/m", 1e3),
            (Self::Load, ContactKind::Point) => ("N", 1.0),
            (Self::Modulus, _) => ("GPa", 1e9),
            (Self::Viscosity, _) => ("mPa·s", 1e-3),
            (Self::Alpha, _) => ("1/GPa", 1e-9),
            (Self::M | Self::L | Self::RadiusRatio | Self::SlideToRollRatio | Self::NewtonianPlateauRatio, _) => {
                ("", 1.0)
            }
        }
    }

    /// Smallest and largest accepted value: wider than any contact, narrow enough to keep numbers sane.
    pub const fn range(self) -> (f64, f64) {
        self.facts().4
    }

    /// Where sliders and curves of it begin and end.
    pub const fn usual_range(self) -> (f64, f64) {
        match self {
            Self::M => (1.0, 1000.0),
            Self::L => (0.5, 25.0),
            Self::SlideToRollRatio => (0.0, 2.0),
            other => other.range(),
        }
    }

    /// Its value of a contact; `None` for the plateau ratio where it is the lubricant's own, and for what a line has not.
    pub fn of(self, point: &OperatingPoint) -> Option<f64> {
        Some(match self {
            Self::M => point.moes().m,
            Self::L => point.moes().l,
            Self::Radius => point.radius_m,
            Self::RadiusY if point.kind == ContactKind::Line => return None,
            Self::RadiusY => point.radius_y_m.unwrap_or(point.radius_m),
            Self::RadiusRatio if point.kind == ContactKind::Line => return None,
            Self::RadiusRatio => point.radius_ratio(),
            Self::Speed => point.speed_m_per_s,
            Self::Load => point.load,
            Self::Modulus => point.modulus_pa,
            Self::Viscosity => point.viscosity_pa_s,
            Self::Alpha => point.alpha_per_pa,
            Self::SlideToRollRatio => point.sliding.slide_to_roll_ratio,
            Self::NewtonianPlateauRatio => return point.sliding.newtonian_plateau_ratio,
        })
    }

    /// The same contact with another value of it. M moves by the load, L by α; a speed, radius, modulus or viscosity
    /// moves M and L along.
    pub fn at(self, point: &OperatingPoint, value: f64) -> OperatingPoint {
        let mut point = *point;
        match self {
            Self::M => point.load *= value / point.moes().m,
            Self::L => point.alpha_per_pa *= value / point.moes().l,
            Self::Radius => point.radius_m = value,
            Self::RadiusY => point.radius_y_m = Some(value),
            Self::RadiusRatio => point.radius_y_m = Some(value * point.radius_m),
            Self::Speed => point.speed_m_per_s = value,
            Self::Load => point.load = value,
            Self::Modulus => point.modulus_pa = value,
            Self::Viscosity => point.viscosity_pa_s = value,
            Self::Alpha => point.alpha_per_pa = value,
            Self::SlideToRollRatio => point.sliding.slide_to_roll_ratio = value,
            Self::NewtonianPlateauRatio => point.sliding.newtonian_plateau_ratio = Some(value),
        }
        point
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_contact_that_was_moved_has_the_value_and_keeps_all_others() {
        const ALL: [Quantity; 12] = [
            Quantity::M,
            Quantity::L,
            Quantity::Radius,
            Quantity::RadiusY,
            Quantity::RadiusRatio,
            Quantity::Speed,
            Quantity::Load,
            Quantity::Modulus,
            Quantity::Viscosity,
            Quantity::Alpha,
            Quantity::SlideToRollRatio,
            Quantity::NewtonianPlateauRatio,
        ];
        for kind in [ContactKind::Line, ContactKind::Point] {
            let here = OperatingPoint { kind, ..OperatingPoint::TABLE_2_1 };
            for quantity in ALL {
                if kind == ContactKind::Line && matches!(quantity, Quantity::RadiusY | Quantity::RadiusRatio) {
                    assert_eq!(quantity.of(&here), None);
                    continue;
                }
                let value = quantity.of(&here).filter(|value| *value != 0.0).map_or(0.3, |value| 1.1 * value);
                let moved = quantity.at(&here, value);
                assert!((quantity.of(&moved).unwrap() / value - 1.0).abs() < 1e-12, "{quantity:?}");
                let others = here.quantities().into_iter().zip(moved.quantities()).filter(|(a, b)| a != b).count();
                assert!(others <= 1, "{quantity:?}");
            }
            assert_eq!(Quantity::SI.map(|quantity| quantity.of(&here).unwrap()), here.quantities());
        }
    }
}
