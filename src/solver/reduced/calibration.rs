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

/// Features of a contact without sliding: ln M, L, ln α, ln e_f^I, and the logarithm of the last modes' share.
const FEATURES: usize = 5;
/// Those of one in a model that knows sliding: |SRR| and NPR as well.
const SLIDING_FEATURES: usize = FEATURES + 2;
/// The two features among them that are no place but a sign of the error.
const SIGNS: std::ops::Range<usize> = 3..5;
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
    /// Of the traction coefficient (3.41), of a model that knows sliding and where an isothermal traction has a meaning.
    pub traction: Option<Estimated>,
}

/// One measured case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evidence {
    /// What was known of the reduced solution.
    pub features: Features,
    /// Measured relative errors.
    pub errors: Measured,
}

/// Measured relative errors of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Of H_c.
    pub h_c: f64,
    /// Of H_min.
    pub h_min: f64,
    /// Of the state, e_z.
    pub state: f64,
    /// Of the traction coefficient; not where nothing slides, the traction has no meaning, or the model has no rule for it.
    pub traction: Option<f64>,
}

impl Measured {
    /// H_c, H_min, state and, of evidence about sliding, traction.
    fn values(&self, sliding: bool) -> impl Iterator<Item = f64> {
        let traction = sliding.then_some(self.traction.unwrap_or(f64::NAN));
        [self.h_c, self.h_min, self.state].into_iter().chain(traction)
    }
}

/// What is cheap to know of a reduced solution: ln M, L, ln α, ln e_f^I, the last modes' share, and of a model that knows sliding |SRR| and NPR.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features {
    values: [f64; SLIDING_FEATURES],
    count: usize,
}

impl Features {
    /// The features of a reduced solution; `sliding` where its model knows sliding.
    pub fn of(solution: &ReducedSolution, sliding: bool) -> Self {
        Self::new(&solution.point, solution.residual_estimate, &solution.coefficients, sliding)
    }

    pub(super) fn new(point: &OperatingPoint, residual: f64, coefficients: &[f64], sliding: bool) -> Self {
        let Moes { m, l } = point.moes();
        let norm = |c: &[f64]| c.iter().map(|v| v * v).sum::<f64>().sqrt();
        let last = norm(&coefficients[coefficients.len().saturating_sub(LAST_MODES)..]) / norm(coefficients);
        let srr = point.sliding.slide_to_roll_ratio.abs();
        let npr = point.sliding.newtonian_plateau_ratio.unwrap_or(1.0);
        let (residual, last) = (residual.max(1e-300).ln(), last.max(1e-300).ln());
        Self {
            values: [m.ln(), l, point.alpha_per_pa.ln(), residual, last, srr, npr],
            count: if sliding { SLIDING_FEATURES } else { FEATURES },
        }
    }

    fn used(&self) -> &[f64] {
        &self.values[..self.count]
    }

    fn finite(&self) -> bool {
        self.used().iter().all(|v| v.is_finite())
    }
}

/// What a window knows about its own errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    /// Smallest and largest value of each feature in the evidence.
    ranges: Vec<(f64, f64)>,
    /// Places of the evidence, each coordinate in −1…1, one after the other.
    places: Vec<f32>,
    /// H_c, H_min, state and, of a model that knows sliding, traction.
    quantities: Vec<Quantity>,
}

/// How one relative error depends on the features.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Quantity {
    /// Coefficients of a quadratic law's terms.
    law: Vec<f64>,
    /// Scatter about the corrected law over all evidence: a variance.
    variance: f64,
    /// Bound in units of the local spread.
    quantile: f64,
    /// How much larger the logarithms of the evidence's errors are than the law says; not a number where none was measured.
    surplus: Vec<f32>,
    /// Squares of what their neighbours leave of that.
    scatter: Vec<f32>,
}

impl Quantity {
    fn sound(&self, terms: usize, evidence: usize) -> bool {
        let spread = [self.variance, self.quantile].iter().all(|v| v.is_finite() && *v >= 0.0);
        let known = self.surplus.iter().zip(&self.scatter).all(|(a, b)| a.is_finite() == b.is_finite());
        let lengths = [self.law.len() == terms, self.surplus.len() == evidence, self.scatter.len() == evidence];
        spread && known && lengths == [true; 3] && self.law.iter().all(|v| v.is_finite())
    }

    /// Standard deviation of the logarithm of an error here.
    fn spread(&self, near: &Neighbours) -> f64 {
        (near.mean(AROUND, &self.scatter) + COMMON_SPREAD * self.variance).sqrt()
    }

    fn estimate(&self, terms: &[f64], near: &Neighbours, beyond: f64) -> Estimated {
        let log = dot(&self.law, terms) + BELIEF * near.mean(NEAR, &self.surplus) + beyond;
        Estimated { likely: log.exp(), bound: (log + self.quantile * self.spread(near)).exp() }
    }
}

impl Calibration {
    /// Learns from evidence of one kind; `None` when there is too little, or it is degenerate.
    pub fn fit(evidence: &[Evidence]) -> Option<Self> {
        let sliding = evidence.first()?.features.count == SLIDING_FEATURES;
        let sound = |e: &&Evidence| e.features.finite() && e.errors.values(false).all(f64::is_finite);
        let usable: Vec<&Evidence> = evidence.iter().filter(sound).collect();
        if usable.len() < LEAST_EVIDENCE {
            return None;
        }
        let range = |k: usize| {
            let values = usable.iter().map(|e| e.features.values[k]);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
        };
        let ranges = (0..if sliding { SLIDING_FEATURES } else { FEATURES }).map(range).collect();
        let mut out = Self { ranges, places: Vec::new(), quantities: Vec::new() };
        let scaled: Vec<Vec<f64>> = usable.iter().map(|e| out.scaled(&e.features).0).collect();
        out.places = scaled.iter().flat_map(|scaled| place(scaled)).collect();
        let terms: Vec<Vec<f64>> = scaled.iter().map(|scaled| quadratic(scaled)).collect();
        // Leave-one-out, so that fresh points find the same scatter.
        let neighbours: Vec<Neighbours> =
            (0..usable.len()).map(|i| out.neighbours(&place(&scaled[i]).collect::<Vec<f32>>(), Some(i))).collect();
        for q in 0..if sliding { 4 } else { 3 } {
            let log = |e: &&Evidence| e.errors.values(sliding).nth(q).map_or(f64::NAN, |v| (v + FLOOR).ln());
            out.quantities.push(quantity(&terms, &usable.iter().map(log).collect::<Vec<f64>>(), &neighbours)?);
        }
        out.sound().then_some(out)
    }

    /// What the errors of a reduced solution are likely to be.
    pub fn estimate(&self, features: &Features) -> ErrorEstimate {
        let (scaled, beyond) = self.scaled(features);
        let terms = quadratic(&scaled);
        let near = self.neighbours(&place(&scaled).collect::<Vec<f32>>(), None);
        let of = |quantity: &Quantity| quantity.estimate(&terms, &near, beyond);
        ErrorEstimate {
            h_c: of(&self.quantities[0]),
            h_min: of(&self.quantities[1]),
            state: of(&self.quantities[2]),
            traction: self.quantities.get(3).map(of),
        }
    }

    /// The largest e_f^I, (3.15), of the evidence.
    pub fn largest_residual(&self) -> f64 {
        self.ranges.get(SIGNS.start).map_or(f64::INFINITY, |range| range.1.exp())
    }

    /// Cases it rests on.
    pub fn evidence(&self) -> usize {
        self.places.len() / (self.ranges.len() - SIGNS.len()).max(1)
    }

    /// Whether it belongs to a model that knows sliding.
    pub fn sliding(&self) -> bool {
        self.ranges.len() == SLIDING_FEATURES
    }

    /// Whether every number in it makes sense, as when it was read from a file.
    pub fn sound(&self) -> bool {
        let features = self.ranges.len();
        let quantities = match features {
            FEATURES => 3,
            SLIDING_FEATURES => 4,
            _ => return false,
        };
        let (evidence, terms) = (self.evidence(), 1 + features + features * (features + 1) / 2);
        self.places.len() == evidence * (features - SIGNS.len())
            && evidence >= LEAST_EVIDENCE
            && self.ranges.iter().all(|(low, high)| low.is_finite() && high.is_finite() && low <= high)
            && self.places.iter().all(|v| v.is_finite())
            && self.quantities.len() == quantities
            && self.quantities.iter().all(|quantity| quantity.sound(terms, evidence))
    }

    /// Features in −1…1 (clamped to the evidence), and by how much ln e_f^I and the last modes exceed it: errors are taken to grow with them.
    fn scaled(&self, features: &Features) -> (Vec<f64>, f64) {
        let mut beyond = 0.0;
        let scale = |(k, (&(low, high), &value)): (usize, (&(f64, f64), &f64))| {
            if SIGNS.contains(&k) {
                beyond += (value - high).max(0.0);
            }
            if high > low { (2.0 * (value - low) / (high - low) - 1.0).clamp(-1.0, 1.0) } else { 0.0 }
        };
        let scaled = self.ranges.iter().zip(&features.values).enumerate().map(scale).collect();
        (scaled, beyond)
    }

    fn neighbours(&self, place: &[f32], except: Option<usize>) -> Neighbours {
        let mut near = Neighbours { nearest: [(f32::INFINITY, 0); AROUND], count: 0 };
        for (i, other) in self.places.chunks_exact(place.len()).enumerate() {
            if except != Some(i) {
                near.meet(other.iter().zip(place).map(|(a, b)| (a - b) * (a - b)).sum(), i);
            }
        }
        near
    }
}

/// The law of one quantity from the logarithms of its errors, not a number where none was measured.
fn quantity(terms: &[Vec<f64>], logs: &[f64], neighbours: &[Neighbours]) -> Option<Quantity> {
    let known: Vec<usize> = (0..logs.len()).filter(|&i| logs[i].is_finite()).collect();
    if known.len() < LEAST_EVIDENCE {
        return None;
    }
    let law = least_squares(terms, logs, &known)?;
    let surplus: Vec<f32> = terms.iter().zip(logs).map(|(terms, log)| (log - dot(&law, terms)) as f32).collect();
    let left: Vec<f64> = neighbours
        .iter()
        .zip(&surplus)
        .map(|(near, own)| f64::from(*own) - BELIEF * near.mean(NEAR, &surplus))
        .collect();
    let scatter = left.iter().map(|v| (v * v) as f32).collect();
    let variance = known.iter().map(|&i| left[i] * left[i]).sum::<f64>() / known.len() as f64;
    let mut out = Quantity { law, variance, quantile: 0.0, surplus, scatter };
    let mut scores: Vec<f64> = known.iter().map(|&i| left[i] / out.spread(&neighbours[i])).collect();
    scores.sort_by(f64::total_cmp);
    let place = ((QUANTILE * (known.len() + 1) as f64).ceil() as usize).clamp(1, known.len());
    out.quantile = scores[place - 1].max(0.0);
    Some(out)
}

/// The coordinates of the place among scaled features.
fn place(scaled: &[f64]) -> impl Iterator<Item = f32> {
    scaled.iter().enumerate().filter(|(k, _)| !SIGNS.contains(k)).map(|(_, v)| *v as f32)
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

    /// Mean of what is known of the first `count`, near ones counting more.
    fn mean(&self, count: usize, values: &[f32]) -> f64 {
        let (mut sum, mut weights) = (0.0, 0.0);
        for &(distance, index) in &self.nearest[..self.count.min(count)] {
            if values[index].is_finite() {
                let weight = 1.0 / (f64::from(distance) + 1e-2);
                sum += weight * f64::from(values[index]);
                weights += weight;
            }
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// 1, features, and their products.
fn quadratic(x: &[f64]) -> Vec<f64> {
    let products = (0..x.len()).flat_map(|i| (i..x.len()).map(move |j| x[i] * x[j]));
    [1.0].into_iter().chain(x.iter().copied()).chain(products).collect()
}

/// Coefficients that fit the known logarithms, with a slight ridge for features that do not vary.
fn least_squares(terms: &[Vec<f64>], logs: &[f64], known: &[usize]) -> Option<Vec<f64>> {
    let count = terms.first()?.len();
    let normal = Mat::from_fn(count, count, |r, c| {
        known.iter().map(|&i| terms[i][r] * terms[i][c]).sum::<f64>() + if r == c { 1e-3 } else { 0.0 }
    });
    let rhs = Mat::from_fn(count, 1, |r, _| known.iter().map(|&i| terms[i][r] * logs[i]).sum::<f64>());
    let solved = PartialPivLu::new(normal.as_ref()).solve(&rhs);
    let law: Vec<f64> = solved.col(0).iter().copied().collect();
    law.iter().all(|v| v.is_finite()).then_some(law)
}

/// A calibration without sliding as model files keep it beside a window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RollingCalibration {
    ranges: [(f64, f64); FEATURES],
    laws: [Vec<f64>; 3],
    variance: [f64; 3],
    quantile: [f64; 3],
    points: Vec<RollingCase>,
}

/// One case of its evidence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct RollingCase {
    place: [f32; FEATURES - SIGNS.end + SIGNS.start],
    surplus: [f32; 3],
    scatter: [f32; 3],
}

impl From<RollingCalibration> for Calibration {
    fn from(kept: RollingCalibration) -> Self {
        let RollingCalibration { ranges, laws, variance, quantile, points } = kept;
        let quantity = |(q, law): (usize, Vec<f64>)| Quantity {
            law,
            variance: variance[q],
            quantile: quantile[q],
            surplus: points.iter().map(|case| case.surplus[q]).collect(),
            scatter: points.iter().map(|case| case.scatter[q]).collect(),
        };
        Self {
            ranges: ranges.to_vec(),
            places: points.iter().flat_map(|case| case.place).collect(),
            quantities: laws.into_iter().enumerate().map(quantity).collect(),
        }
    }
}

impl TryFrom<&Calibration> for RollingCalibration {
    type Error = std::array::TryFromSliceError;

    /// Fails for the calibration of a model that knows sliding.
    fn try_from(calibration: &Calibration) -> Result<Self, Self::Error> {
        let Calibration { ranges, places, quantities } = calibration;
        let ranges = <[(f64, f64); FEATURES]>::try_from(ranges.as_slice())?;
        let each = |number: fn(&Quantity) -> f64| std::array::from_fn(|q| number(&quantities[q]));
        let case = |(i, place): (usize, &[f32])| -> Result<RollingCase, Self::Error> {
            Ok(RollingCase {
                place: place.try_into()?,
                surplus: std::array::from_fn(|q| quantities[q].surplus[i]),
                scatter: std::array::from_fn(|q| quantities[q].scatter[i]),
            })
        };
        Ok(Self {
            ranges,
            laws: std::array::from_fn(|q| quantities[q].law.clone()),
            variance: each(|quantity| quantity.variance),
            quantile: each(|quantity| quantity.quantile),
            points: places.chunks_exact(ranges.len() - SIGNS.len()).enumerate().map(case).collect::<Result<_, _>>()?,
        })
    }
}

#[cfg(test)]
mod tests;
