//! Sampling plans: which operating points of a range are solved in full, and which are tested.

use super::{QuantityBox, Range, SlidingRange, TrainingError};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::reduced::distance;
use fastrand::Rng;
use std::f64::consts::PI;

/// Weight of (ln α ratio)² beside (3.20) when points of a range in (M, L, α) are spread: α changes H_c by a few per cent at equal M
/// and L. Boxes of SI quantities use (3.20) alone, as the dissertation does: there a weight took 3 of 120 points too many from M and L
/// and cost failures at low M and high L.
const ALPHA_WEIGHT: f64 = 0.02;

impl Range {
    /// Refuses empty, inverted or non-finite ranges.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), TrainingError> {
        let intervals: &[(&str, (f64, f64))] = match self {
            Self::Box(QuantityBox { radius, speed, load, alpha, modulus, viscosity }) => &[
                ("radius", *radius),
                ("speed", *speed),
                ("load", *load),
                ("alpha", *alpha),
                ("modulus", (*modulus, *modulus)),
                ("viscosity", (*viscosity, *viscosity)),
            ],
            Self::Moes { m, l, alpha, max_hertz_pressure, viscosity } => &[
                ("m", *m),
                ("l", *l),
                ("alpha", *alpha),
                ("max_hertz_pressure", (*max_hertz_pressure, *max_hertz_pressure)),
                ("viscosity", (*viscosity, *viscosity)),
            ],
            Self::Sliding(SlidingRange { m, l, srr, npr, radius, modulus, viscosity, alpha, max_hertz_pressure }) => {
                for (name, (low, high), most) in [("srr", *srr, 10.0), ("npr", *npr, 1.0)] {
                    if !(0.0 <= low && low <= high && high <= most) {
                        return Err(TrainingError::Specification(format!(
                            "the range of {name} is {low}…{high}; both ends must lie between 0 and {most}, the first not above the second"
                        )));
                    }
                }
                &[
                    ("m", *m),
                    ("l", *l),
                    ("radius", (*radius, *radius)),
                    ("modulus", (*modulus, *modulus)),
                    ("viscosity", (*viscosity, *viscosity)),
                    ("alpha", (*alpha, *alpha)),
                    ("max_hertz_pressure", max_hertz_pressure.map_or((1.0, 1.0), |limit| (limit, limit))),
                ]
            }
        };
        for (name, (low, high)) in intervals {
            if !(low.is_finite() && high.is_finite() && *low > 0.0 && low <= high) {
                return Err(TrainingError::Specification(format!(
                    "the range of {name} is {low}…{high}; both ends must be positive and finite, the first not above the second"
                )));
            }
        }
        Ok(())
    }

    /// The operating point of a kind at coordinates in the unit cube (3 or 4 of them are used); `None` where the range excludes it.
    pub fn at(&self, kind: ContactKind, unit: [f64; 4]) -> Option<OperatingPoint> {
        let linear = |(low, high): (f64, f64), t: f64| low + (high - low) * t;
        let logarithmic = |(low, high): (f64, f64), t: f64| low * (high / low).powf(t);
        match *self {
            Self::Box(range) => {
                let point = range.at(kind, unit);
                point.check().ok().map(|()| point)
            }
            Self::Moes { m, l, alpha, max_hertz_pressure, viscosity } => {
                let request = MoesRequest {
                    alpha_per_pa: Some(logarithmic(alpha, unit[2])),
                    viscosity_pa_s: Some(viscosity),
                    ..MoesRequest::new(kind, logarithmic(m, unit[0]), linear(l, unit[1]))
                };
                si_from_moes(&request).ok().filter(|p| p.hertz().pressure_pa <= max_hertz_pressure)
            }
            Self::Sliding(range) => range.at(kind, unit),
        }
    }
}

/// A random point near another one by (3.18), coordinates in the unit cube: μ = min(max(μ_ref + σN, 0), 1).
pub fn local_point(reference: [f64; 4], sigma: f64, rng: &mut Rng) -> [f64; 4] {
    let mut normal = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (2.0 * PI * rng.f64()).cos();
    reference.map(|v| (v + sigma * normal()).clamp(0.0, 1.0))
}

/// Coordinates of (3.17) in the unit cube.
pub(super) fn global_point(rng: &mut Rng) -> [f64; 4] {
    std::array::from_fn(|_| 0.5 * (1.0 - (PI * rng.f64()).cos()))
}

/// A random point of a range by (3.17), which pushes towards the boundary; `None` where the range excludes it.
pub fn test_point(range: &Range, kind: ContactKind, rng: &mut Rng) -> Option<OperatingPoint> {
    range.at(kind, global_point(rng))
}

/// `count` random points of a range with M in a window.
pub fn random_points(
    range: &Range,
    kind: ContactKind,
    m: (f64, f64),
    count: usize,
    rng: &mut Rng,
) -> Vec<OperatingPoint> {
    let mut points = Vec::with_capacity(count);
    // A window that the range never meets must not loop for ever.
    for _ in 0..count.saturating_mul(400) {
        if points.len() == count {
            break;
        }
        points.extend(test_point(range, kind, rng).filter(|p| (m.0..=m.1).contains(&p.moes().m)));
    }
    points
}

/// Farthest-point sampling (3.16): every next point of a random pool is the one farthest from all chosen ones.
pub fn farthest_points(
    range: &Range,
    kind: ContactKind,
    m: (f64, f64),
    count: usize,
    rng: &mut Rng,
) -> Vec<OperatingPoint> {
    farther_points(range, kind, m, &[], count, rng)
}

/// (3.16) beside points that are there already: `count` more of them.
pub(super) fn farther_points(
    range: &Range,
    kind: ContactKind,
    m: (f64, f64),
    known: &[OperatingPoint],
    count: usize,
    rng: &mut Rng,
) -> Vec<OperatingPoint> {
    let mut pool = random_points(range, kind, m, (40 * count).max(2000), rng);
    // The corners of the range are its extremes, and a random pool never quite reaches them.
    let corners = (0..16u8).filter_map(|c| range.at(kind, std::array::from_fn(|k| f64::from(c >> k & 1))));
    pool.extend(corners.filter(|p| (m.0..=m.1).contains(&p.moes().m)));
    let coordinates: Vec<_> = pool.iter().map(|p| (p.moes(), p.alpha_per_pa.ln(), p.sliding)).collect();
    let alpha_weight = if matches!(range, Range::Box(_)) { 0.005 } else { ALPHA_WEIGHT };
    let mut nearest = vec![f64::INFINITY; pool.len()];
    let approach = |nearest: &mut [f64], point: &OperatingPoint| {
        let (moes, log_alpha) = (point.moes(), point.alpha_per_pa.ln());
        for (best, (other, other_alpha, sliding)) in nearest.iter_mut().zip(&coordinates) {
            let d = distance(moes, *other) + alpha_weight * (log_alpha - other_alpha).powi(2);
            *best = best.min(d + point.sliding.distance(*sliding));
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

/// The tensor grid of Table 3.2 over a box: equidistant in R, u_m and α, logarithmic in w. Empty for a range given in M and L.
pub fn grid_points(range: &Range, kind: ContactKind, nodes: [usize; 4]) -> Vec<OperatingPoint> {
    let Range::Box(QuantityBox { load, .. }) = range else { return Vec::new() };
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
                    let at = [unit(r, nodes[0]), unit(u, nodes[1]), log_unit(unit(w, nodes[2])), unit(a, nodes[3])];
                    points.extend(range.at(kind, at));
                }
            }
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: ContactKind = ContactKind::Line;
    const TABLE_3_1: Range = Range::Box(QuantityBox::TABLE_3_1);

    #[test]
    fn table_3_1_has_the_moes_numbers_the_dissertation_prints() {
        let points = grid_points(&TABLE_3_1, LINE, [2, 2, 2, 2]);
        let m = points.iter().map(|p| p.moes().m);
        let l = points.iter().map(|p| p.moes().l);
        let (low, high) = (m.clone().fold(f64::INFINITY, f64::min), m.fold(0.0, f64::max));
        // The dissertation prints them rounded, with a tilde.
        assert!((low / 7.4 - 1.0).abs() < 0.01 && (high / 164.6 - 1.0).abs() < 1e-3, "{low} {high}");
        let (low, high) = (l.clone().fold(f64::INFINITY, f64::min), l.fold(0.0, f64::max));
        assert!((low / 2.5 - 1.0).abs() < 0.02 && (high / 21.1 - 1.0).abs() < 5e-3, "{low} {high}");
    }

    #[test]
    fn table_3_2_grids_have_the_printed_sizes() {
        assert_eq!(grid_points(&TABLE_3_1, LINE, [3, 4, 5, 4]).len(), 240);
        assert_eq!(grid_points(&TABLE_3_1, LINE, [2, 3, 5, 4]).len(), 120);
    }

    #[test]
    fn farthest_points_are_spread_wider_than_random_ones_and_follow_the_seed() {
        let all = (0.0, f64::INFINITY);
        let chosen = farthest_points(&TABLE_3_1, LINE, all, 60, &mut Rng::with_seed(3));
        assert_eq!(chosen, farthest_points(&TABLE_3_1, LINE, all, 60, &mut Rng::with_seed(3)));
        let random = random_points(&TABLE_3_1, LINE, all, 60, &mut Rng::with_seed(4));
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

    #[test]
    fn the_moes_range_respects_its_pressure_limit() {
        let range = Range::Moes {
            m: (2.0, 500.0),
            l: (1.0, 20.0),
            alpha: (5e-9, 20e-9),
            max_hertz_pressure: 3.2e9,
            viscosity: 0.01,
        };
        for p in random_points(&range, LINE, (2.0, 500.0), 300, &mut Rng::with_seed(1)) {
            assert!(p.hertz().pressure_pa <= 3.2e9);
            assert!((5e-9..=20.0001e-9).contains(&p.alpha_per_pa));
        }
    }

    #[test]
    fn empty_and_inverted_ranges_are_refused() {
        for load in [(5e5, 1e5), (0.0, 1.0), (f64::NAN, 1.0), (1.0, f64::INFINITY)] {
            let range = Range::Box(QuantityBox { load, ..QuantityBox::TABLE_3_1 });
            assert!(range.check().unwrap_err().to_string().contains("load"));
        }
    }
}
