//! How far a reduced solution is off, in the units people care about: a calibrated bound without large-scale work.
//!
//! The residual alone does not say it (`training/indicator.rs` has the correlations). What is cheap to know about a
//! reduced solution (where it lies, e_f^I, how much it leans on the basis's last modes) is therefore related to errors
//! that were measured at random points when the training ended: a quadratic law in the logarithms, then the root mean
//! square of the errors around in units of the law, then the quantile of the errors in units of both. That quantile is
//! taken leaving one out (split-free conformal prediction), so that it holds for fresh points drawn like the evidence,
//! whatever the law misses.
//!
//! Windows around anchors are too many for hundreds of measured errors each, and the errors of one model follow one law:
//! the law is that of all evidence together, with what a window's own says of its linear terms, the quantile that of the
//! window's own and of some of theirs, and how large errors are around a place each window's own evidence says.
//!
//! What the quantile counts in decides how loose a bound is. Of errors that are normally distributed, with a size known
//! everywhere, no bound that holds for 99.6 % is less than 4.3 times the true error in the median; counted in the local
//! root mean square, which follows how large errors are around a place, it comes near that.

mod features;
mod neighbours;
mod parts;
mod quantity;
mod steps;
#[cfg(test)]
mod tests;

pub use features::{Evidence, FeatureSet, Features, Measured};
pub use parts::CalibrationParts;
pub use quantity::LEAST_EVIDENCE;

use super::error_estimate::ErrorEstimate;
use features::{ERRORS, FEATURES, MOST_FEATURES, SIGNS};
use neighbours::Neighbours;
use quantity::{Quantity, quadratic};
use steps::kept_place;

/// Errors below this are noise of the three Newton steps they were measured by.
const FLOOR: f64 = 1e-8;
/// Evidence of a window's own without which nothing is said there, where several learn together.
pub const LEAST_OF_WINDOW: usize = 32;

/// What a window knows about its own errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// Smallest and largest value of each feature in the evidence.
    ranges: Vec<(f64, f64)>,
    /// Places of the evidence, each coordinate in −1…1, one after the other.
    places: Vec<f32>,
    /// H_c, H_min, state, of a model that knows sliding or heat traction, and of one that knows heat the rise.
    quantities: Vec<Quantity>,
}

impl Calibration {
    /// Learns from evidence of one kind; `None` when there is too little, or it is degenerate.
    pub fn fit(evidence: &[Evidence]) -> Option<Self> {
        Self::fit_together(&[evidence]).pop().flatten()
    }

    /// Learns from the evidence of several windows of one model; `None` for windows with too little of their own, and for
    /// all when there is too little together, or it is degenerate.
    pub fn fit_together(evidence: &[&[Evidence]]) -> Vec<Option<Self>> {
        let fitted = Self::fitted(evidence);
        fitted.unwrap_or_else(|| vec![None; evidence.len()])
    }

    fn fitted(evidence: &[&[Evidence]]) -> Option<Vec<Option<Self>>> {
        let Features { count, errors, .. } = evidence.iter().find_map(|own| own.first())?.features;
        let sound = |e: &&Evidence| e.features.finite() && e.errors.values(ERRORS).all(f64::is_finite);
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
        for q in 0..errors {
            let log = |e: &&Evidence| e.errors.values(errors).nth(q).map_or(f64::NAN, |v| (v + FLOOR).ln());
            let logs: Vec<Vec<f64>> = usable.iter().map(|own| own.iter().map(log).collect()).collect();
            let fitted = Quantity::fit(&terms, &logs, &neighbours)?;
            windows.iter_mut().zip(fitted).for_each(|(window, quantity)| window.quantities.push(quantity));
        }
        Some(windows.into_iter().map(|window| Some(window).filter(Self::sound)).collect())
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
            rise: self.quantities.get(4).map(of),
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

    /// True if it has these features and errors.
    pub fn is_of(&self, set: &FeatureSet) -> bool {
        self.ranges.len() == set.count() && self.quantities.len() == set.errors
    }

    /// Whether its errors are those against full solutions, not what a few full Newton steps change.
    pub fn by_full_solutions(&self) -> bool {
        self.quantities.len() > ERRORS
    }

    /// Whether every number in it makes sense, as when it was read from a file.
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

    /// Features in −1…1 (clamped to the evidence), and by how much ln e_f^I and the last modes exceed it: errors are
    /// taken to grow with them.
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

    /// Of each piece of evidence the others around it: fresh points find no more.
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

/// The coordinates of the place among scaled features.
fn place(scaled: &[f64]) -> impl Iterator<Item = f32> {
    scaled.iter().enumerate().filter(|(k, _)| !SIGNS.contains(k)).map(|(_, v)| *v as f32)
}
