//! How far a reduced solution is off, in the units people care about: a calibrated bound without large-scale work.
//!
//! The residual alone does not say it (`training/indicator.rs` has the correlations). What is cheap to know about a reduced solution (where it
//! lies, e_f^I, how much it leans on the basis's last modes) is therefore related to errors that were measured at random points when the
//! training ended: a quadratic law in the logarithms, then the mean surplus of the nearest evidence, then the quantile of what both
//! leave over in units of the local spread. That quantile is taken over leave-one-out residues (split-free conformal prediction), so
//! that it holds for fresh points drawn like the evidence, whatever the law misses.
//!
//! Tried on Table 3.1's box (77 solutions, 800 pieces of evidence, 1,200 fresh points; rank with e_z, cover of H_c, median bound/error of H_c):
//! place alone 0.75, 99.6 %, 5.1; with e_f^I 0.93, 99.8 %, 4.8; and nearest evidence 0.95, 99.5 %, 4.2; and the last modes 0.95, 99.4 %, 4.0; and
//! local spread 0.95, 99.0 %, 2.7. The distance to the nearest snapshot adds nothing to these.

use super::ReducedSolution;
use crate::solver::contact::{Moes, OperatingPoint};
use faer::Mat;
use faer::linalg::solvers::{PartialPivLu, Solve};
use serde::{Deserialize, Serialize};

/// Coordinates of the place: ln M, L, ln α.
const PLACE: usize = 3;
/// Features: the place, ln e_f^I, and the logarithm of the last modes' share.
const FEATURES: usize = PLACE + 2;
/// Terms of a quadratic law in the features.
const TERMS: usize = 1 + FEATURES + FEATURES * (FEATURES + 1) / 2;
/// Modes at the end of the basis whose share is a sign of what it lacks.
const LAST_MODES: usize = 3;
/// Nearest evidence that corrects the law.
const NEAR: usize = 16;
/// Nearest evidence that says how much errors scatter here.
const AROUND: usize = 48;
/// Share of the local surplus that is believed.
const BELIEF: f64 = 0.8;
/// Share of the overall scatter added to the local one.
const COMMON_SPREAD: f64 = 0.1;
/// Part of the evidence that must lie below the bound; more than the 99 % promised, since fresh points scatter.
const QUANTILE: f64 = 0.996;
/// Errors below this are noise of the three Newton steps they were measured by.
const FLOOR: f64 = 1e-8;
/// Evidence without which nothing is said.
pub const LEAST_EVIDENCE: usize = 100;

/// An error that was not measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimated {
    /// Its likely size (median of similar cases).
    pub likely: f64,
    /// What 99 of 100 errors stay below.
    pub bound: f64,
}

/// Relative errors of a reduced solution against the full one on the same grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ErrorEstimate {
    /// Of the central film, |H̃_c/H_c − 1|.
    pub h_c: Estimated,
    /// Of the smallest film.
    pub h_min: Estimated,
    /// Of the state, e_z of (3.10).
    pub state: Estimated,
}

/// One measured case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// What was known of the reduced solution.
    pub features: Features,
    /// Measured relative errors of H_c, H_min and the state.
    pub errors: [f64; 3],
}

/// What is cheap to know of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features([f64; FEATURES]);

impl Features {
    /// The features of a reduced solution.
    pub fn of(solution: &ReducedSolution) -> Self {
        Self::new(&solution.point, solution.residual_estimate, &solution.coefficients)
    }

    pub(super) fn new(point: &OperatingPoint, residual: f64, coefficients: &[f64]) -> Self {
        let Moes { m, l } = point.moes();
        let norm = |c: &[f64]| c.iter().map(|v| v * v).sum::<f64>().sqrt();
        let last = norm(&coefficients[coefficients.len().saturating_sub(LAST_MODES)..]) / norm(coefficients);
        Self([m.ln(), l, point.alpha_per_pa.ln(), residual.max(1e-300).ln(), last.max(1e-300).ln()])
    }

    fn finite(&self) -> bool {
        self.0.iter().all(|v| v.is_finite())
    }
}

/// What a window knows about its own errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Smallest and largest value of each feature in the evidence.
    ranges: [(f64, f64); FEATURES],
    /// One law per quantity: coefficients of the quadratic's terms.
    laws: [Vec<f64>; 3],
    /// Scatter about the corrected law over all evidence, one variance per quantity.
    variance: [f64; 3],
    /// Bound in units of the local spread.
    quantile: [f64; 3],
    points: Vec<Known>,
}

/// What is kept of a measured case.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Known {
    /// Its place, each coordinate in −1…1.
    place: [f32; PLACE],
    /// How much larger the logarithms of its errors are than the law says.
    surplus: [f32; 3],
    /// Squares of what its neighbours leave of that.
    scatter: [f32; 3],
}

impl Calibration {
    /// Learns from evidence; `None` when there is too little, or it is degenerate.
    pub fn fit(evidence: &[Evidence]) -> Option<Self> {
        let usable: Vec<&Evidence> =
            evidence.iter().filter(|e| e.features.finite() && e.errors.iter().all(|v| v.is_finite())).collect();
        if usable.len() < LEAST_EVIDENCE {
            return None;
        }
        let ranges = std::array::from_fn(|k| {
            let values = usable.iter().map(|e| e.features.0[k]);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
        });
        let mut out = Self {
            ranges,
            laws: Default::default(),
            variance: [0.0; 3],
            quantile: [0.0; 3],
            points: Vec::with_capacity(usable.len()),
        };
        let terms: Vec<[f64; TERMS]> = usable.iter().map(|e| quadratic(&out.scaled(&e.features).0)).collect();
        let logs: Vec<[f64; 3]> = usable.iter().map(|e| e.errors.map(|v| (v + FLOOR).ln())).collect();
        for q in 0..3 {
            out.laws[q] = least_squares(&terms, &logs, q)?;
        }
        for ((e, terms), logs) in usable.iter().zip(&terms).zip(&logs) {
            let (scaled, _) = out.scaled(&e.features);
            out.points.push(Known {
                place: std::array::from_fn(|k| scaled[k] as f32),
                surplus: std::array::from_fn(|q| (logs[q] - dot(&out.laws[q], terms)) as f32),
                scatter: [0.0; 3],
            });
        }
        // Leave-one-out, so that fresh points find the same scatter.
        let neighbours: Vec<Neighbours> =
            (0..out.points.len()).map(|i| out.neighbours(out.points[i].place, Some(i))).collect();
        let left: Vec<[f64; 3]> = neighbours
            .iter()
            .zip(&out.points)
            .map(|(near, own)| {
                std::array::from_fn(|q| {
                    f64::from(own.surplus[q]) - BELIEF * near.mean(NEAR, |i| f64::from(out.points[i].surplus[q]))
                })
            })
            .collect();
        for (point, left) in out.points.iter_mut().zip(&left) {
            point.scatter = left.map(|v| (v * v) as f32);
        }
        let count = left.len();
        for q in 0..3 {
            out.variance[q] = left.iter().map(|v| v[q] * v[q]).sum::<f64>() / count as f64;
            let mut scores: Vec<f64> =
                left.iter().zip(&neighbours).map(|(v, near)| v[q] / out.spread(near, q)).collect();
            scores.sort_by(f64::total_cmp);
            let place = ((QUANTILE * (count + 1) as f64).ceil() as usize).clamp(1, count);
            out.quantile[q] = scores[place - 1].max(0.0);
        }
        out.sound().then_some(out)
    }

    /// What the errors of a reduced solution are likely to be.
    pub fn estimate(&self, features: &Features) -> ErrorEstimate {
        let (scaled, beyond) = self.scaled(features);
        let terms = quadratic(&scaled);
        let near = self.neighbours(std::array::from_fn(|k| scaled[k] as f32), None);
        let of = |q: usize| {
            let surplus = BELIEF * near.mean(NEAR, |i| f64::from(self.points[i].surplus[q]));
            let log = dot(&self.laws[q], &terms) + surplus + beyond;
            Estimated { likely: log.exp(), bound: (log + self.quantile[q] * self.spread(&near, q)).exp() }
        };
        ErrorEstimate { h_c: of(0), h_min: of(1), state: of(2) }
    }

    /// Cases it rests on.
    pub fn evidence(&self) -> usize {
        self.points.len()
    }

    /// Whether every number in it makes sense, as when it was read from a file.
    pub fn sound(&self) -> bool {
        self.points.len() >= LEAST_EVIDENCE
            && self.ranges.iter().all(|(low, high)| low.is_finite() && high.is_finite() && low <= high)
            && self.laws.iter().all(|law| law.len() == TERMS && law.iter().all(|v| v.is_finite()))
            && self.variance.iter().chain(&self.quantile).all(|v| v.is_finite() && *v >= 0.0)
            && self.points.iter().all(|p| p.place.iter().chain(&p.surplus).chain(&p.scatter).all(|v| v.is_finite()))
    }

    /// Features in −1…1 (clamped to the evidence), and by how much ln e_f^I and the last modes exceed it: errors are taken to grow with them.
    fn scaled(&self, features: &Features) -> ([f64; FEATURES], f64) {
        let mut beyond = 0.0;
        let scaled = std::array::from_fn(|k| {
            let ((low, high), value) = (self.ranges[k], features.0[k]);
            if k >= PLACE {
                beyond += (value - high).max(0.0);
            }
            if high > low { (2.0 * (value - low) / (high - low) - 1.0).clamp(-1.0, 1.0) } else { 0.0 }
        });
        (scaled, beyond)
    }

    /// Standard deviation of the logarithm of an error here.
    fn spread(&self, near: &Neighbours, q: usize) -> f64 {
        (near.mean(AROUND, |i| f64::from(self.points[i].scatter[q])) + COMMON_SPREAD * self.variance[q]).sqrt()
    }

    fn neighbours(&self, place: [f32; PLACE], except: Option<usize>) -> Neighbours {
        let mut near = Neighbours { nearest: [(f32::INFINITY, 0); AROUND], count: 0 };
        for (i, point) in self.points.iter().enumerate() {
            if except != Some(i) {
                near.meet(point.place.iter().zip(&place).map(|(a, b)| (a - b) * (a - b)).sum(), i);
            }
        }
        near
    }
}

/// The nearest evidence, by squared distance.
struct Neighbours {
    nearest: [(f32, usize); AROUND],
    count: usize,
}

impl Neighbours {
    fn meet(&mut self, distance: f32, index: usize) {
        if self.count == AROUND && distance >= self.nearest[AROUND - 1].0 {
            return;
        }
        let known = &self.nearest[..self.count];
        let at = known.partition_point(|(d, _)| *d <= distance);
        self.count = (self.count + 1).min(AROUND);
        self.nearest[at..self.count].rotate_right(1);
        self.nearest[at] = (distance, index);
    }

    /// Mean over the first `count`, near ones counting more.
    fn mean(&self, count: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for &(distance, index) in &self.nearest[..self.count.min(count)] {
            let weight = 1.0 / (f64::from(distance) + 1e-2);
            sum += weight * value(index);
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// 1, features, and their products.
fn quadratic(x: &[f64; FEATURES]) -> [f64; TERMS] {
    let mut out = [1.0; TERMS];
    out[1..=FEATURES].copy_from_slice(x);
    let mut at = 1 + FEATURES;
    for i in 0..FEATURES {
        for j in i..FEATURES {
            out[at] = x[i] * x[j];
            at += 1;
        }
    }
    out
}

/// Coefficients that fit quantity `q`, with a slight ridge for features that do not vary.
fn least_squares(terms: &[[f64; TERMS]], logs: &[[f64; 3]], q: usize) -> Option<Vec<f64>> {
    let normal = Mat::from_fn(TERMS, TERMS, |r, c| {
        terms.iter().map(|t| t[r] * t[c]).sum::<f64>() + if r == c { 1e-3 } else { 0.0 }
    });
    let rhs = Mat::from_fn(TERMS, 1, |r, _| terms.iter().zip(logs).map(|(t, l)| t[r] * l[q]).sum::<f64>());
    let solved = PartialPivLu::new(normal.as_ref()).solve(&rhs);
    let law: Vec<f64> = solved.col(0).iter().copied().collect();
    law.iter().all(|v| v.is_finite()).then_some(law)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fastrand::Rng;

    /// Errors that follow e_f^I and a bump in the place, with a scatter that is larger on one side.
    fn synthetic(count: usize, seed: u64) -> Vec<Evidence> {
        let mut rng = Rng::with_seed(seed);
        let mut normal = move || {
            let (a, b) = (rng.f64(), rng.f64());
            ((-2.0 * (1.0 - a).ln()).sqrt() * (2.0 * std::f64::consts::PI * b).cos(), a, b)
        };
        (0..count)
            .map(|_| {
                let ((n, a, b), (k, c, _)) = (normal(), normal());
                let place = [2.0 + 3.0 * a, 2.0 + 18.0 * b, -19.0 + c];
                let residual = -8.0 + k + (4.0 * a).sin();
                let error = residual - 2.0 + (6.0 * a).cos() * b + (0.3 + b) * n;
                Evidence {
                    features: Features([place[0], place[1], place[2], residual, -12.0]),
                    errors: [error.exp(), (error - 1.0).exp(), (error + 1.0).exp()],
                }
            })
            .collect()
    }

    #[test]
    fn the_bound_covers_fresh_cases_and_is_not_idle() {
        let calibration = Calibration::fit(&synthetic(1000, 1)).unwrap();
        let fresh = synthetic(4000, 2);
        let mut ratios = Vec::new();
        let mut medians = 0;
        for case in &fresh {
            let estimate = calibration.estimate(&case.features);
            ratios.push(estimate.h_c.bound / case.errors[0]);
            medians += usize::from(estimate.h_min.likely > case.errors[1]);
        }
        let covered = ratios.iter().filter(|r| **r >= 1.0).count();
        assert!(covered >= 3960, "{covered} of 4000");
        ratios.sort_by(f64::total_cmp);
        // 2.65 standard deviations of 0.8 on average.
        assert!(ratios[2000] < 10.0, "{}", ratios[2000]);
        assert!((1800..2200).contains(&medians), "the likely error is the median: {medians} of 4000 below");
    }

    #[test]
    fn a_residual_beyond_the_evidence_raises_the_bound_in_proportion() {
        let evidence = synthetic(300, 3);
        let calibration = Calibration::fit(&evidence).unwrap();
        let mut features = evidence[0].features;
        features.0[PLACE] = calibration.ranges[PLACE].1;
        let at_the_edge = calibration.estimate(&features).h_c.bound;
        features.0[PLACE] += 3.0;
        assert!((calibration.estimate(&features).h_c.bound / at_the_edge / 3f64.exp() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn too_little_or_broken_evidence_gives_no_calibration() {
        assert!(Calibration::fit(&synthetic(LEAST_EVIDENCE - 1, 1)).is_none());
        let mut broken = synthetic(LEAST_EVIDENCE, 1);
        broken[7].errors[0] = f64::NAN;
        assert!(Calibration::fit(&broken).is_none());
    }

    #[test]
    fn neighbours_are_the_nearest_in_order() {
        let mut near = Neighbours { nearest: [(f32::INFINITY, 0); AROUND], count: 0 };
        let mut rng = Rng::with_seed(5);
        let distances: Vec<f32> = (0..300).map(|_| rng.f32()).collect();
        for (i, d) in distances.iter().enumerate() {
            near.meet(*d, i);
        }
        let mut sorted = distances.clone();
        sorted.sort_by(f32::total_cmp);
        assert!(near.nearest.iter().zip(&sorted).all(|((d, i), wanted)| d == wanted && distances[*i] == *d));
    }
}
