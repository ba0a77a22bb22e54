//! Contacts at points of the unit cube.

use super::quantity::Quantity;
use super::space::ParameterSpace;
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, Sliding, si_from_moes};
use std::f64::consts::PI;

/// Maximum number of axes of a space.
pub const MOST_AXES: usize = 12;
/// Minimum number of random coordinates per contact, for spaces with fewer axes as well.
const FEWEST_COORDINATES: usize = 4;

/// Maximum number of coordinates of a space whose corners are all used.
const MOST_WITH_CORNERS: usize = 7;

/// Coordinates 0…1 in the unit cube. A space uses as many as it has axes.
pub type Unit = [f64; MOST_AXES];

/// Returns the centre of the unit cube with the first coordinates replaced.
pub fn middle<const N: usize>(first: [f64; N]) -> Unit {
    let mut unit = [0.5; MOST_AXES];
    unit.iter_mut().zip(first).for_each(|(own, given)| *own = given);
    unit
}

/// Returns the corners of the unit cube along the first coordinates.
pub(super) fn corners(coordinates: usize) -> impl Iterator<Item = Unit> {
    (0..1u32 << coordinates.min(MOST_AXES)).map(|corner| std::array::from_fn(|k| f64::from(corner >> k & 1)))
}

impl ParameterSpace {
    /// Returns the number of coordinates that are drawn for a random contact.
    pub fn coordinates(&self) -> usize {
        self.axes.len().max(FEWEST_COORDINATES)
    }

    /// Returns the corners of the unit cube along its coordinates. For more than seven coordinates it returns the
    /// lowest corner only, since a plan of farthest points would consist of corners alone.
    pub fn corners(&self) -> impl Iterator<Item = Unit> {
        let coordinates = self.coordinates();
        corners(if coordinates > MOST_WITH_CORNERS { 0 } else { coordinates })
    }

    /// Returns the contact of a kind at a point of the unit cube. `None` if it does not exist, or if a limit excludes
    /// it.
    pub fn at(&self, kind: ContactKind, unit: &Unit) -> Option<OperatingPoint> {
        let value = |quantity: Quantity| {
            let along = self.axes.iter().zip(unit).find(|(axis, _)| axis.quantity == quantity);
            along.map(|(axis, t)| axis.value(*t)).or(self.fixed(quantity))
        };
        let shape = |point: OperatingPoint| match value(Quantity::RadiusRatio) {
            Some(ratio) => Quantity::RadiusRatio.at(&point, ratio),
            None => point,
        };
        let point = match (value(Quantity::M), value(Quantity::L)) {
            (Some(m), Some(l)) => {
                let request = MoesRequest {
                    radius_m: value(Quantity::Radius),
                    modulus_pa: value(Quantity::Modulus),
                    viscosity_pa_s: value(Quantity::Viscosity),
                    alpha_per_pa: value(Quantity::Alpha),
                    ..MoesRequest::new(kind, m, l)
                };
                si_from_moes(&request).ok()?
            }
            _ => {
                let [radius, speed, load, modulus, viscosity, alpha] = Quantity::SI.map(value);
                let si = [radius?, speed?, load?, modulus?, viscosity?, alpha?];
                OperatingPoint::from_quantities(kind, si, Sliding::NONE)
            }
        };
        let sliding = Sliding {
            slide_to_roll_ratio: value(Quantity::SlideToRollRatio).unwrap_or(0.0),
            newtonian_plateau_ratio: value(Quantity::NewtonianPlateauRatio),
        };
        let mut point = OperatingPoint { sliding, ..shape(point) };
        if let Some(ratio) = value(Quantity::SmoothFilmRatio) {
            point = Quantity::SmoothFilmRatio.at(&point, ratio);
        }
        let within = |(quantity, (low, high)): &(Quantity, (f64, f64))| {
            quantity.of(&point).is_some_and(|value| (*low..=*high).contains(&value))
        };
        (point.check().is_ok() && self.limits.iter().all(within)).then_some(point)
    }

    /// Returns the contact of the test trajectory (3.21) at the running parameter c, along the first four axes.
    /// `None` if a limit excludes it.
    pub fn trajectory(&self, kind: ContactKind, c: f64) -> Option<OperatingPoint> {
        let place = [3.0, 4.0, 5.0, 2.0].map(|halves: f64| 0.5 + 0.5 * (halves * PI * c).sin());
        self.at(kind, &middle(place))
    }

    /// Returns the contacts of the tensor grid of Table 3.2 over a box of R, u_m, w and α: equal steps along all but
    /// w, equal ratios along w. Empty for a space of other axes.
    pub fn grid_points(&self, kind: ContactKind, nodes: [usize; 4]) -> Vec<OperatingPoint> {
        let wanted = [Quantity::Radius, Quantity::Speed, Quantity::Load, Quantity::Alpha];
        let Some(load) = self.axis(Quantity::Load).map(|axis| axis.ends) else { return Vec::new() };
        if !self.axes.iter().map(|axis| axis.quantity).eq(wanted) {
            return Vec::new();
        }
        let unit = |i: usize, n: usize| if n < 2 { 0.5 } else { i as f64 / (n - 1) as f64 };
        let log_unit = |t: f64| {
            let width = load.1 - load.0;
            if width > 0.0 { (load.0 * (load.1 / load.0).powf(t) - load.0) / width } else { 0.0 }
        };
        let mut points = Vec::new();
        for r in 0..nodes[0] {
            for u in 0..nodes[1] {
                for w in 0..nodes[2] {
                    for a in 0..nodes[3] {
                        let place =
                            [unit(r, nodes[0]), unit(u, nodes[1]), log_unit(unit(w, nodes[2])), unit(a, nodes[3])];
                        points.extend(self.at(kind, &middle(place)));
                    }
                }
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::parameters::Axis;

    const LINE: ContactKind = ContactKind::Line;

    #[test]
    fn table_3_2_grids_have_the_printed_sizes() {
        assert_eq!(ParameterSpace::table_3_1().grid_points(LINE, [3, 4, 5, 4]).len(), 240);
        assert_eq!(ParameterSpace::table_3_1().grid_points(LINE, [2, 3, 5, 4]).len(), 120);
    }

    #[test]
    fn the_trajectory_starts_in_the_middle_and_stays_in_the_box() {
        let space = ParameterSpace::table_3_1();
        let middle = [3e-3, 5.5, 3e5, 231e9, 0.01, 12.5e-9];
        let first = space.trajectory(LINE, 0.0).unwrap().quantities();
        assert!(first.iter().zip(middle).all(|(q, m)| (q / m - 1.0).abs() < 1e-14));
        for i in 0..=1000 {
            let point = space.trajectory(LINE, i as f64 / 500.0).unwrap();
            assert!((2e-3..=4e-3).contains(&point.radius_m) && (1e5..=5e5).contains(&point.load));
        }
    }

    #[test]
    fn sampled_contacts_respect_the_limits() {
        let space = ParameterSpace::of([
            Axis::new(Quantity::M, (10.0, 200.0)),
            Axis::new(Quantity::L, (4.0, 11.0)),
            Axis::new(Quantity::SlideToRollRatio, (0.0, 1.0)),
            Axis::new(Quantity::NewtonianPlateauRatio, (0.2, 1.0)),
        ])
        .limited([(Quantity::HertzPressure, (0.0, 660e6))])
        .fixing([
            (Quantity::Radius, 12.7e-3),
            (Quantity::Modulus, 123.9e9),
            (Quantity::Viscosity, 0.07),
            (Quantity::Alpha, 1.9e-8),
        ]);
        let mut inside = 0;
        for i in 0..=10 {
            for j in 0..=10 {
                let unit = middle([f64::from(i) / 10.0, f64::from(j) / 10.0, 0.5, 0.25]);
                let Some(point) = space.at(ContactKind::Point, &unit) else { continue };
                let moes = point.moes();
                assert!(point.hertz().pressure_pa <= 660e6);
                assert!((9.999..200.01).contains(&moes.m) && (3.999..11.001).contains(&moes.l));
                assert_eq!(point.sliding.slide_to_roll_ratio, 0.5);
                assert!((point.sliding.newtonian_plateau_ratio.unwrap() - 0.4).abs() < 1e-12);
                inside += 1;
            }
        }
        assert!((20..121).contains(&inside), "{inside} of 121");
        assert_eq!(space.interval(Quantity::HertzPressure, ContactKind::Point), Some((0.0, 660e6)));
        // α p_H = L (3M/2π³)^⅓ of a point contact.
        let expected = 11.0 * (3.0 * 200.0 / (2.0 * PI.powi(3))).cbrt() / 1.9e-8;
        let free = ParameterSpace { limits: Vec::new(), ..space };
        let (_, highest) = free.interval(Quantity::HertzPressure, ContactKind::Point).unwrap();
        assert!((highest / expected - 1.0).abs() < 1e-9);
    }
}
