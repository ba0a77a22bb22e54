//! Calibrated error estimate of a reduced solution, without large-scale work.
//!
//! The residual alone does not predict the error (`training/indicator.rs` has the correlations). The calibration
//! relates cheap properties of a reduced solution (its position in the parameter space, its residual e_f^I, the size
//! of its last modes) to errors measured at random points at the end of the training. It has three parts:
//!
//! 1. a quadratic law for the logarithm of the error;
//! 2. the local root mean square of the measured errors, in units of this law;
//! 3. the quantile of the errors in units of both. It is computed leave-one-out (split-free conformal prediction), so
//!    that it holds for new points from the same distribution, whatever the law misses.
//!
//! Models with many local models do not have hundreds of measured errors for each. Their errors follow one law, so the
//! law is fitted to all evidence together, with linear corrections per local model. The quantile uses the evidence of
//! the local model and a part of the others'. The local root mean square uses only the local model's own evidence.
//!
//! The unit of the quantile determines how tight the bound is. For normally distributed errors of known size, no
//! bound that holds for 99.6 % is less than 4.3 times the median error. The local root mean square follows the size
//! of the errors in the neighbourhood, so that the bound comes close to this factor.

mod features;
mod neighbours;
mod parts;
mod quantity;
mod steps;
#[cfg(test)]
mod tests;

pub use features::{Evidence, FeatureSet, Features, FurtherError, Measured};
pub use parts::CalibrationParts;
pub use quantity::LEAST_EVIDENCE;

use super::error_estimate::ErrorEstimate;
use features::{ERRORS, FEATURES, MOST_FEATURES, SIGNS};
use neighbours::Neighbours;
use quantity::{Quantity, quadratic};
use steps::kept_place;

/// Smaller errors are below the noise of the three Newton steps by which errors are measured.
const FLOOR: f64 = 1e-8;
/// Minimum evidence of one local model if several are calibrated together.
pub const LEAST_OF_WINDOW: usize = 32;

/// Calibration of the errors of one local model.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Smallest and largest value of each feature in the evidence.
    ranges: Vec<(f64, f64)>,
    /// Positions of the evidence, one after the other; each coordinate is scaled to −1…1.
    places: Vec<f32>,
    /// Central film thickness H_c, minimum film thickness H_min and state, then the further errors of the
    /// [`FeatureSet`].
    quantities: Vec<Quantity>,
}

impl Calibration {
    /// Fits the calibration to evidence of one kind. `None` if there is too little evidence, or if it is degenerate.
    pub fn fit(evidence: &[Evidence]) -> Option<Self> {
        Self::fit_together(&[evidence]).pop().flatten()
    }

    /// Fits the calibrations of several local models of one model together. An entry is `None` if that local model
    /// has too little evidence; all are `None` if there is too little evidence in total, or if it is degenerate.
    pub fn fit_together(evidence: &[&[Evidence]]) -> Vec<Option<Self>> {
        let fitted = Self::fitted(evidence);
        fitted.unwrap_or_else(|| vec![None; evidence.len()])
    }

    fn fitted(evidence: &[&[Evidence]]) -> Option<Vec<Option<Self>>> {
        let Features { count, errors, .. } = evidence.iter().find_map(|own| own.first())?.features;
        let sound =
            |e: &&Evidence| e.features.finite() && e.errors.of_every_solution().iter().all(|error| error.is_finite());
        let usable: Vec<Vec<&Evidence>> = evidence.iter().map(|own| own.iter().filter(sound).collect()).collect();
        if usable.iter().map(Vec::len).sum::<usize>() < LEAST_EVIDENCE {
            return None;
        }
        let range = |k: usize| {
            let values = usable.iter().flatten().map(|e| e.features.values[k]);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
        };
        let ranges: Vec<(f64, f64)> = (0..count).map(range).collect();
        let mut windows = Vec::with_capacity(usable.len());
        let mut terms = Vec::with_capacity(usable.len());
        for own in &usable {
            let mut window = Self { ranges: ranges.clone(), places: Vec::new(), quantities: Vec::new() };
            let scaled: Vec<Vec<f64>> = own.iter().map(|e| window.scaled(&e.features).0).collect();
            window.places = scaled.iter().flat_map(|scaled| place(scaled)).map(kept_place).collect();
            terms.push(scaled.iter().map(|scaled| quadratic(scaled)).collect::<Vec<_>>());
            windows.push(window);
        }
        let neighbours: Vec<Vec<Neighbours>> = windows.iter().map(Self::left_out).collect();
        for q in 0..ERRORS + errors.len() {
            let log = |e: &&Evidence| e.errors.values(errors).nth(q).map_or(f64::NAN, |v| (v + FLOOR).ln());
            let logs: Vec<Vec<f64>> = usable.iter().map(|own| own.iter().map(log).collect()).collect();
            let fitted = Quantity::fit(&terms, &logs, &neighbours)?;
            windows.iter_mut().zip(fitted).for_each(|(window, quantity)| window.quantities.push(quantity));
        }
        Some(windows.into_iter().map(|window| Some(window).filter(Self::sound)).collect())
    }

    /// Estimates the errors of a reduced solution.
    pub fn estimate(&self, features: &Features) -> ErrorEstimate {
        let (scaled, beyond) = self.scaled(features);
        let terms = quadratic(&scaled);
        let near = self.neighbours(&place(&scaled).collect::<Vec<f32>>(), None);
        let of = |quantity: &Quantity| quantity.estimate(&terms, &near, beyond);
        let further = |asked: FurtherError| {
            let place = features.errors.iter().position(|error| *error == asked)?;
            self.quantities.get(ERRORS + place).map(of)
        };
        ErrorEstimate {
            h_c: of(&self.quantities[0]),
            h_min: of(&self.quantities[1]),
            state: of(&self.quantities[2]),
            traction: further(FurtherError::Traction),
            rise: further(FurtherError::Rise),
            load_share: further(FurtherError::LoadShare),
        }
    }

    /// Returns the largest residual e_f^I, (3.15), of the evidence; infinity without evidence.
    pub fn largest_residual(&self) -> f64 {
        self.ranges.get(SIGNS.start).map_or(f64::INFINITY, |range| range.1.exp())
    }

    /// Returns the number of measured errors used.
    pub fn evidence(&self) -> usize {
        self.places.len() / (self.ranges.len() - SIGNS.len()).max(1)
    }

    /// Returns true if the calibration has these features and errors.
    pub fn is_of(&self, set: &FeatureSet) -> bool {
        self.ranges.len() == set.count() && self.quantities.len() == ERRORS + set.errors.len()
    }

    /// Returns true if the errors were measured against full solutions, not estimated by a few full Newton steps.
    pub fn by_full_solutions(&self) -> bool {
        self.quantities.len() > ERRORS
    }

    /// Returns true if all numbers are valid, for example after reading from a file.
    pub fn sound(&self) -> bool {
        let features = self.ranges.len();
        let known =
            (FEATURES..=MOST_FEATURES).contains(&features) && (ERRORS..=ERRORS + 2).contains(&self.quantities.len());
        if !known {
            return false;
        }
        let (evidence, terms) = (self.evidence(), 1 + features + features * (features + 1) / 2);
        self.places.len() == evidence * (features - SIGNS.len())
            && evidence >= LEAST_OF_WINDOW
            && self.ranges.iter().all(|(low, high)| low.is_finite() && high.is_finite() && low <= high)
            && self.places.iter().all(|v| v.is_finite())
            && self.quantities.iter().all(|quantity| quantity.sound(terms, evidence))
    }

    /// Returns the features scaled to −1…1 (clamped to the range of the evidence), and by how much ln e_f^I and the
    /// last modes exceed this range. Errors are assumed to grow with the excess.
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

    /// Returns the neighbours of each piece of evidence without itself, as a new point would find them.
    fn left_out(&self) -> Vec<Neighbours> {
        let places = self.places.chunks_exact((self.ranges.len() - SIGNS.len()).max(1));
        places.enumerate().map(|(i, place)| self.neighbours(place, Some(i))).collect()
    }

    fn neighbours(&self, place: &[f32], except: Option<usize>) -> Neighbours {
        let mut near = Neighbours::none();
        for (i, other) in self.places.chunks_exact(place.len()).enumerate() {
            if except != Some(i) {
                near.meet(other.iter().zip(place).map(|(a, b)| (a - b) * (a - b)).sum(), i);
            }
        }
        near
    }
}

/// Returns the coordinates of the position among scaled features.
fn place(scaled: &[f64]) -> impl Iterator<Item = f32> {
    scaled.iter().enumerate().filter(|(k, _)| !SIGNS.contains(k)).map(|(_, v)| *v as f32)
}
