//! Sampling plans: operating points of a range for full solutions and for tests.

use super::cell::Cell;
use super::spec::{TrainingSpec, WindowSpec};
use super::state::OVERLAP;
use crate::solver::parameters::{Metric, ParameterSpace, SHAPE_WEIGHT, Unit, apart, distance, middle};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::reduced::{BEYOND_CELLS, Window};
use fastrand::Rng;
use std::f64::consts::PI;

/// Weight of (ln α ratio)² in addition to (3.20) for points of a range in (M, L, α): α changes the central film
/// thickness H_c by a few per cent at equal M and L.
const ALPHA_WEIGHT: f64 = 0.02;
/// The same for boxes of SI quantities: a larger weight would take points from the corners in M and L.
const BOX_ALPHA_WEIGHT: f64 = 0.005;

/// Returns a random point near another one by (3.18) in the unit cube: μ = min(max(μ_ref + σN, 0), 1).
pub(super) fn local_point(mut unit: Unit, sigma: f64, count: usize, rng: &mut Rng) -> Unit {
    let mut normal = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (2.0 * PI * rng.f64()).cos();
    unit.iter_mut().take(count).for_each(|v| *v = (*v + sigma * normal()).clamp(0.0, 1.0));
    unit
}

/// Returns a random point by (3.17) in the unit cube; coordinates from `count` on are in the middle.
pub(super) fn global_point(count: usize, rng: &mut Rng) -> Unit {
    let mut unit = middle([]);
    unit.iter_mut().take(count).for_each(|v| *v = 0.5 * (1.0 - (PI * rng.f64()).cos()));
    unit
}

/// Number of draws per point after which a range counts as empty.
const MAX_DRAWS: usize = 10_000;

/// Point with its coordinates in the unit cube.
pub(super) type Drawn = (Unit, OperatingPoint);

/// Contacts of a range, of one kind and with M in an interval.
#[derive(Clone, Debug)]
pub(super) struct Within {
    pub range: ParameterSpace,
    pub kind: ContactKind,
    /// True for thermal contacts.
    pub heat: bool,
    pub m: (f64, f64),
    /// Interval of R_y/R.
    pub ratios: (f64, f64),
    /// Cell of an anchor, including the region of blending.
    pub cell: Option<Cell>,
}

/// Draws random points of a range by (3.17), which favours its boundary. The same seed always gives the same points.
/// Returns fewer than `count` if hardly any contact of the range is admissible.
pub fn random_points(range: &ParameterSpace, kind: ContactKind, count: usize, seed: u64) -> Vec<OperatingPoint> {
    random_points_while(range, kind, count, seed, || true)
}

/// Number of points between two checks of `wanted`.
const UNASKED: usize = 1000;

/// Draws points like [`random_points`] as long as `wanted` returns true. A hundred thousand points take a tenth of a
/// second.
pub fn random_points_while(
    range: &ParameterSpace,
    kind: ContactKind,
    count: usize,
    seed: u64,
    wanted: impl Fn() -> bool,
) -> Vec<OperatingPoint> {
    let (within, mut rng) = (Within::all(range, kind, false), Rng::with_seed(seed));
    let mut points = Vec::with_capacity(count);
    while points.len() < count && wanted() {
        let share = UNASKED.min(count - points.len());
        let more = within.random_points(share, &mut rng);
        let exhausted = more.len() < share;
        points.extend(more);
        if exhausted {
            break;
        }
    }
    points
}

impl TrainingSpec {
    /// Returns the contacts with M in an interval.
    pub(super) fn within(&self, m: (f64, f64)) -> Within {
        Within { m, ..Within::all(&self.range, self.contact(), self.heats()) }
    }
}

impl Within {
    /// Returns the contacts with any M.
    pub fn all(range: &ParameterSpace, kind: ContactKind, heat: bool) -> Self {
        Self { range: range.clone(), kind, heat, m: (0.0, f64::INFINITY), ratios: (0.0, f64::INFINITY), cell: None }
    }

    /// Restricts to the radius ratios that a local model covers, and to the cell of its anchor if given.
    pub fn served_by(self, window: &Window, cell: Option<Cell>) -> Self {
        Self { ratios: window.served_ratios(), cell, ..self }
    }

    /// Restricts to the radius ratios of a specification, and extends these and the range by the overlap of the
    /// training.
    pub fn beyond(self, window: &WindowSpec) -> Self {
        let (low, high) = window.served_ratios();
        Self { ratios: (low / OVERLAP, high * OVERLAP), range: self.range.beyond(), ..self }
    }

    fn at(&self, unit: Unit) -> Option<OperatingPoint> {
        let inside = |value: f64, (low, high): (f64, f64)| (low..=high).contains(&value);
        let wanted = |point: &OperatingPoint| {
            let moes = point.moes();
            let served = self.cell.as_ref().is_none_or(|cell| cell.holds(moes, BEYOND_CELLS));
            inside(moes.m, self.m) && point.has_ratio_in(self.ratios) && served
        };
        self.range.at(self.kind, &unit).filter(wanted)
    }

    /// Returns up to `count` points at the coordinates of `draw`; fewer if hardly any is admissible.
    pub fn drawn(&self, count: usize, mut draw: impl FnMut() -> Unit) -> Vec<Drawn> {
        let mut one = || {
            let unit = draw();
            self.at(unit).map(|point| (unit, point))
        };
        (0..count).map_while(|_| (0..MAX_DRAWS).find_map(|_| one())).collect()
    }

    /// Draws random points by (3.17).
    pub fn random_points(&self, count: usize, rng: &mut Rng) -> Vec<OperatingPoint> {
        let coordinates = self.range.coordinates();
        self.drawn(count, || global_point(coordinates, rng)).into_iter().map(|(_, point)| point).collect()
    }

    /// Selects points by farthest-point sampling (3.16), in addition to known points: every next point of a random
    /// pool is the one farthest from all others.
    pub fn farthest_points(&self, known: &[OperatingPoint], count: usize, rng: &mut Rng) -> Vec<OperatingPoint> {
        let mut pool = self.random_points((40 * count).max(2000), rng);
        // The corners of the range are its extremes, which a random pool never quite reaches.
        pool.extend(self.range.corners().filter_map(|corner| self.at(corner)));
        let place = |p: &OperatingPoint| (p.moes(), p.alpha_per_pa.ln(), p.sliding, p.log_ratio());
        let by_metric = self.range.varies_lubricant() || self.range.is_rough();
        let metric = by_metric.then(|| Metric::of_plan(&self.range, self.heat));
        let coordinates: Vec<_> = pool.iter().map(place).collect();
        let places: Vec<_> = metric.iter().flat_map(|metric| pool.iter().map(|point| metric.place(point))).collect();
        let alpha_weight = if self.range.is_si_box() { BOX_ALPHA_WEIGHT } else { ALPHA_WEIGHT };
        let mut nearest = vec![f64::INFINITY; pool.len()];
        let approach = |nearest: &mut [f64], point: &OperatingPoint| {
            if let Some(metric) = &metric {
                let own = metric.place(point);
                nearest.iter_mut().zip(&places).for_each(|(best, other)| *best = best.min(apart(own, *other)));
                return;
            }
            let (moes, log_alpha, sliding, log_ratio) = place(point);
            for (best, (other, other_alpha, other_sliding, other_ratio)) in nearest.iter_mut().zip(&coordinates) {
                let d = distance(moes, *other) + alpha_weight * (log_alpha - other_alpha).powi(2);
                let shape = SHAPE_WEIGHT * (log_ratio - other_ratio).powi(2);
                *best = best.min(d + sliding.distance(*other_sliding) + shape);
            }
        };
        let farthest = |nearest: &[f64]| {
            (0..pool.len()).max_by(|&a, &b| nearest[a].total_cmp(&nearest[b])).filter(|&i| nearest[i] > 0.0)
        };
        known.iter().for_each(|point| approach(&mut nearest, point));
        let mut chosen = Vec::with_capacity(count);
        let mut next = if known.is_empty() {
            (0..pool.len()).min_by(|&a, &b| coordinates[a].0.m.total_cmp(&coordinates[b].0.m))
        } else {
            farthest(&nearest)
        };
        while let Some(index) = next.filter(|_| chosen.len() < count) {
            chosen.push(pool[index]);
            approach(&mut nearest, &pool[index]);
            next = farthest(&nearest);
        }
        chosen
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::training::small;

    const LINE: ContactKind = ContactKind::Line;
    #[test]
    fn random_points_repeat_with_the_seed_and_an_empty_range_ends() {
        let table = ParameterSpace::table_3_1();
        assert_eq!(random_points(&table, LINE, 20, 7), random_points(&table, LINE, 20, 7));
        assert_ne!(random_points(&table, LINE, 20, 7), random_points(&table, LINE, 20, 8));
        let none = small::moes_as_realised((500.0, 500.0), (20.0, 20.0), 1e6);
        assert!(random_points(&none, LINE, 3, 1).is_empty());
    }

    #[test]
    fn farthest_points_spread_wider_than_random_ones() {
        let table = ParameterSpace::table_3_1();
        let farthest = || Within::all(&table, LINE, false).farthest_points(&[], 60, &mut Rng::with_seed(3));
        let chosen = farthest();
        assert_eq!(chosen, farthest());
        let random = random_points(&table, LINE, 60, 4);
        let closest = |points: &[OperatingPoint]| {
            let mut d = f64::INFINITY;
            for (i, a) in points.iter().enumerate() {
                for b in &points[..i] {
                    d = d.min(
                        distance(a.moes(), b.moes()) + ALPHA_WEIGHT * (a.alpha_per_pa / b.alpha_per_pa).ln().powi(2),
                    );
                }
            }
            d
        };
        assert!(closest(&chosen) > 10.0 * closest(&random));
    }
}
