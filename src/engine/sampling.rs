//! Random operating points, (3.17), the same ones for the same seed on every machine.

use crate::scene::TestRange;
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use std::f64::consts::PI;

/// SplitMix64: a small generator whose sequence is fixed by its seed.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// A generator.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number, uniform in \[0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A fraction pushed towards 0 and 1 by the cosine of (3.17).
    pub fn towards_ends(&mut self) -> f64 {
        0.5 * (1.0 - (PI * self.uniform()).cos())
    }
}

/// Draws per wanted point before a range is given up as holding none.
const MAX_DRAWS: usize = 10_000;

/// `n` random points of a range for one kind of contact; fewer where the range holds hardly any admissible point.
pub fn random_points(range: &TestRange, kind: ContactKind, n: usize, seed: u64) -> Vec<OperatingPoint> {
    let mut random = Random::new(seed);
    (0..n).map_while(|_| (0..MAX_DRAWS).find_map(|_| draw(range, kind, &mut random))).collect()
}

fn draw(range: &TestRange, kind: ContactKind, random: &mut Random) -> Option<OperatingPoint> {
    let mut fraction = || random.towards_ends();
    let linear = |(low, high): (f64, f64), t: f64| low + (high - low) * t;
    let logarithmic = |(low, high): (f64, f64), t: f64| low * (high / low).powf(t);
    let (request, limit) = match *range {
        TestRange::Box(range) => {
            let point = range.at(kind, [fraction(), fraction(), fraction(), fraction()]);
            return point.check().is_ok().then_some(point);
        }
        TestRange::Realisation { m, l, max_hertz_pressure } => {
            let (m, l) = (logarithmic(m, fraction()), linear(l, fraction()));
            (MoesRequest::new(kind, m, l), max_hertz_pressure)
        }
        TestRange::Moes { m, l, alpha, max_hertz_pressure, viscosity } => {
            let (m, l, alpha) = (logarithmic(m, fraction()), linear(l, fraction()), linear(alpha, fraction()));
            let request = MoesRequest {
                alpha_per_pa: Some(alpha),
                viscosity_pa_s: Some(viscosity),
                ..MoesRequest::new(kind, m, l)
            };
            (request, max_hertz_pressure)
        }
        TestRange::Sliding(range) => {
            return range.at(kind, [fraction(), fraction(), fraction(), fraction()]);
        }
    };
    si_from_moes(&request).ok().filter(|point| point.hertz().pressure_pa <= limit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::QuantityBox;

    #[test]
    fn points_repeat_with_the_seed_and_stay_in_their_range() {
        let table = TestRange::Box(QuantityBox::TABLE_3_1);
        let line = ContactKind::Line;
        assert_eq!(random_points(&table, line, 20, 7), random_points(&table, line, 20, 7));
        assert_ne!(random_points(&table, line, 20, 7), random_points(&table, line, 20, 8));
        let real = TestRange::Realisation { m: (2.0, 500.0), l: (1.0, 20.0), max_hertz_pressure: 3.2e9 };
        let points = random_points(&real, line, 200, 1);
        assert_eq!(points.len(), 200);
        assert!(points.iter().all(|p| p.hertz().pressure_pa <= 3.2e9 && (1.99..501.0).contains(&p.moes().m)));
    }

    #[test]
    fn an_empty_range_ends() {
        let none = TestRange::Realisation { m: (500.0, 500.0), l: (20.0, 20.0), max_hertz_pressure: 1e6 };
        assert!(random_points(&none, ContactKind::Line, 3, 1).is_empty());
    }
}
