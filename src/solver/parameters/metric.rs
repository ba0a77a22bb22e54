//! Distances between the solutions of contacts, computed from their quantities.
//!
//! [`distance`] is the measure of the dissertation. [`Metric`] is for spaces whose lubricant varies. Under the laws
//! of Roelands and of Dowson and Higginson, a contact has four parameters: the Moes numbers M and L, the Hertzian
//! pressure p_H and Roelands' exponent z. Further axes add theirs. The scale of each number is such that the sum of
//! squares approximates the distance of registered pressures.

use super::quantity::Quantity;
use super::space::ParameterSpace;
use crate::solver::physics::contact::{Moes, OperatingPoint};

/// Weight of (ln of the ratio of two R_y/R)² in addition to (3.20).
pub const SHAPE_WEIGHT: f64 = 0.15;

/// Returns the distance (3.20) between two contacts, as in the dissertation.
pub fn distance(a: Moes, b: Moes) -> f64 {
    (a.m - b.m).powi(2) / (a.m * a.m + b.m * b.m) + 0.001 * (a.l - b.l).powi(2)
}

/// Returns (3.20) with the contributions of SRR, NPR and the shape.
pub fn separation(a: &OperatingPoint, b: &OperatingPoint) -> f64 {
    let shape = if a.radius_y_m == b.radius_y_m && a.radius_m == b.radius_m {
        0.0
    } else {
        SHAPE_WEIGHT * a.log_ratio_over(b).powi(2)
    };
    distance(a.moes(), b.moes()) + a.sliding.distance(b.sliding) + shape
}

/// Maximum number of coordinates of a [`Metric`].
pub const MOST_NUMBERS: usize = 8;

/// Coordinates of a contact. Unused ones are zero.
pub type Place = [f64; MOST_NUMBERS];

/// Transformation of a number of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    Log,
    Linear,
    /// Absolute value, for numbers in which solutions are even.
    Absolute,
}

/// Numbers that distinguish contacts, with their scales.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metric {
    numbers: Vec<(Quantity, Form, f64)>,
}

/// Numbers M, L, p_H and z.
const LUBRICANTS: [(Quantity, Form, f64); 4] = [
    (Quantity::M, Form::Log, 0.27),
    (Quantity::L, Form::Log, 0.29),
    (Quantity::HertzPressure, Form::Log, 0.18),
    (Quantity::RoelandsExponent, Form::Linear, 0.34),
];
/// Stress and sliding of shear-thinning lubricants. In thick films they change pressures by up to 0.06 and 0.2; in
/// thin films they have hardly any effect.
const STRESSES: [(Quantity, Form, f64); 2] =
    [(Quantity::StressUnit, Form::Log, 0.05), (Quantity::SlideToRollRatio, Form::Absolute, 0.15)];
/// Speed and sliding of thermal contacts, by the effect of heat on registered pressures.
const HEAT: [(Quantity, Form, f64); 2] =
    [(Quantity::Speed, Form::Log, 0.1), (Quantity::SlideToRollRatio, Form::Linear, 0.4)];
/// Shape; its weight relative to ln M is the same as in [`separation`].
const SHAPE: (Quantity, Form, f64) = (Quantity::RadiusRatio, Form::Log, 0.15);
/// Scale of any other axis.
const OTHER: f64 = 0.15;
/// Quantities included in the numbers above.
const COUNTED: [Quantity; 9] = [
    Quantity::M,
    Quantity::L,
    Quantity::Alpha,
    Quantity::Viscosity,
    Quantity::Radius,
    Quantity::Modulus,
    Quantity::Speed,
    Quantity::SlideToRollRatio,
    Quantity::RadiusRatio,
];

impl Metric {
    /// Creates the metric for distances between stored solutions. It has isothermal numbers only, since temperatures
    /// change pressures little.
    pub fn of_solutions(space: &ParameterSpace) -> Self {
        Self::with(if space.knows(Quantity::GradientStress) { &STRESSES } else { &[] }, space)
    }

    /// Creates the metric for the interpolation of starting values.
    pub fn of_starts(space: &ParameterSpace) -> Self {
        Self::with(if space.slides() { &STRESSES } else { &[] }, space)
    }

    /// Creates the metric for distributing the contacts of a thermal or isothermal training.
    pub fn of_plan(space: &ParameterSpace, heat: bool) -> Self {
        if heat { Self::with(&HEAT, space) } else { Self::of_solutions(space) }
    }

    fn with(further: &[(Quantity, Form, f64)], space: &ParameterSpace) -> Self {
        // Without lubricant ranges p_H and z follow from M and L.
        let own = if space.is_rough() && !space.varies_lubricant() { 2 } else { LUBRICANTS.len() };
        let mut numbers = LUBRICANTS[..own].to_vec();
        numbers.extend(further);
        numbers.extend(space.of_ellipses().then_some(SHAPE));
        let other = space.axes.iter().filter(|axis| !COUNTED.contains(&axis.quantity));
        numbers.extend(other.map(|axis| match axis.scale {
            super::Scale::Log => (axis.quantity, Form::Log, OTHER),
            super::Scale::Linear => (axis.quantity, Form::Linear, OTHER),
        }));
        numbers.truncate(MOST_NUMBERS);
        Self { numbers }
    }

    /// Returns the number of coordinates.
    pub fn len(&self) -> usize {
        self.numbers.len()
    }

    /// Returns true if a quantity is one of the numbers.
    pub fn counts(&self, quantity: Quantity) -> bool {
        self.numbers.iter().any(|(own, _, _)| *own == quantity)
    }

    /// True for a metric without numbers.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// Returns the coordinates of a contact.
    pub fn place(&self, point: &OperatingPoint) -> Place {
        let mut place = [0.0; MOST_NUMBERS];
        for (own, (quantity, form, length)) in place.iter_mut().zip(&self.numbers) {
            let value = quantity.of(point).unwrap_or(1.0);
            *own = length
                * match form {
                    Form::Log => value.ln(),
                    Form::Linear => value,
                    Form::Absolute => value.abs(),
                };
        }
        place
    }
}

/// Returns the squared distance of two points.
pub fn apart<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::parameters::Axis;

    #[test]
    fn the_distance_is_the_dissertations() {
        let d = distance(Moes { m: 10.0, l: 5.0 }, Moes { m: 20.0, l: 8.0 });
        assert!((d - (100.0 / 500.0 + 0.009)).abs() < 1e-15);
    }

    #[test]
    fn every_axis_of_a_space_moves_a_place() {
        let mut space = ParameterSpace::of([
            Axis::new(Quantity::M, (2.0, 50.0)),
            Axis::new(Quantity::L, (2.0, 10.0)),
            Axis::new(Quantity::Alpha, (1e-8, 2e-8)),
            Axis::new(Quantity::Viscosity, (0.01, 0.1)),
            Axis::new(Quantity::NewtonianPlateauRatio, (0.1, 0.9)),
        ]);
        space.limits.push((Quantity::GradientStress, (0.0, 1e6)));
        space.axes.push(Axis::new(Quantity::SlideToRollRatio, (0.0, 1.0)));
        let here = OperatingPoint::TABLE_2_1;
        let mut metrics = [Metric::of_solutions(&space), Metric::of_starts(&space), Metric::of_plan(&space, true)];
        for metric in &mut metrics {
            for axis in &space.axes {
                let own = axis.quantity.of(&here).filter(|own| *own > 0.0).unwrap_or(0.1);
                let moved = axis.quantity.at(&here, 1.5 * own);
                assert!(apart(metric.place(&here), metric.place(&moved)) > 1e-6, "{:?} in {metric:?}", axis.quantity);
            }
        }
    }

    #[test]
    fn places_of_rough_contacts_are_load_lubricant_and_film_ratio() {
        let space = ParameterSpace::of([
            Axis::new(Quantity::M, (10.0, 100.0)),
            Axis::new(Quantity::L, (3.0, 13.0)),
            Axis::new(Quantity::SmoothFilmRatio, (0.1, 5.0)),
        ]);
        let (metric, here) = (Metric::of_solutions(&space), OperatingPoint::TABLE_2_1);
        assert_eq!(metric.len(), 3);
        for axis in &space.axes {
            assert!(metric.counts(axis.quantity));
            let moved = axis.quantity.at(&here, 1.5 * axis.quantity.of(&here).unwrap());
            assert!(apart(metric.place(&here), metric.place(&moved)) > 1e-6, "{:?}", axis.quantity);
        }
    }
}
