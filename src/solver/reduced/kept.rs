//! Precision in which the modes, sampled equations and starting values of a local model are stored, by kind of model.

use super::model::{Snapshot, Window};
use super::multiples::{Multiples, ROUNDS, kept_digits};
use crate::solver::physics::contact::ContactKind;
use faer::Mat;

/// Bits of the significand stored for film thicknesses of snapshots: a relative step of 1.5e-5, a hundredth of the
/// error of initial guesses in local models.
pub const FILM_DIGITS: u32 = 16;
/// Largest factor by which coefficients of rare modes are stored less accurately. Initial guesses predict these
/// coefficients poorly anyway.
const COARSEST: f64 = 20.0;

/// Properties that determine how accurately the modes of a local model are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keeping {
    /// Line or point contacts.
    pub kind: ContactKind,
    /// True for one of many local models around anchors, and for rough surfaces: initial guesses are kriged there.
    pub anchored: bool,
    /// True for thermal models.
    pub heat: bool,
    /// True for models of elliptical contacts.
    pub shapes: bool,
}

impl Keeping {
    /// Returns the properties of a local model of a model with or without heat.
    pub fn of(window: &Window, heat: bool) -> Self {
        let (anchored, shapes) = (window.anchor.is_some() || window.is_rough(), window.shapes.is_some());
        Self { kind: window.grid.kind(), anchored, heat, shapes }
    }

    /// Returns true if the reconstruction of the sampled equations is stored with few digits,
    /// [`RULE_ACCURACY`](super::RULE_ACCURACY), or as cubature weights: for models with many local models, and for
    /// thermal ones.
    pub fn shortens_rules(self) -> bool {
        self.anchored || self.shapes || self.heat
    }

    /// Returns the accuracy of pressures at every node, relative to their size there.
    pub fn accuracy(self) -> f64 {
        match self.kind {
            // Temperatures limit the accuracy.
            ContactKind::Line if self.anchored && self.heat => 1e-10,
            // These models have thin films under high loads, especially with sliding: 1e-11 leaves no measurable
            // error of the film thickness.
            ContactKind::Line if self.anchored => 1e-11,
            ContactKind::Line => 1e-13,
            // The modes themselves have a ten times larger error. The film thickness changes by 1e-4 (95 %), at most
            // 7e-4.
            ContactKind::Point if self.anchored => 3e-8,
            // Many local models, with the deformation K V of the modes interpolated over the radius ratio: 6e-4 (95 %)
            // and 2e-3 at most.
            ContactKind::Point if self.shapes => 8e-7,
            // 1e-4 (95 %) and 2e-4 at most.
            ContactKind::Point => 1e-7,
        }
    }

    /// Returns the accuracy of the first mode's coefficients in snapshots, relative to their size.
    pub fn starts(self) -> f64 {
        match self.kind {
            // The iteration of a line contact starts at these values and has all modes of a wide range, with
            // piezoviscous parameters α p_H up to 45. Coarser values cause failures and additional Newton steps.
            ContactKind::Line if !self.anchored => 1e-6,
            ContactKind::Line | ContactKind::Point => 1e-3,
        }
    }
}

/// Rounds the coefficients of snapshots to their stored precision: snapshots × modes, with the scales of the columns.
/// They serve only as initial guesses.
pub fn kept_starts(snapshots: &[Snapshot], modes: usize, accuracy: f64) -> (Vec<f64>, Mat<f64>) {
    let of = |i: usize, k: usize| snapshots.get(i)?.coefficients.get(k).copied();
    kept_coefficients(Mat::from_fn(snapshots.len(), modes, |i, k| of(i, k).unwrap_or_default()), accuracy)
}

fn kept_coefficients(mut coefficients: Mat<f64>, accuracy: f64) -> (Vec<f64>, Mat<f64>) {
    // The steps depend on the sizes, which rounding may change. Repeated until storing again changes nothing.
    for _ in 0..ROUNDS {
        let (_, kept) = Multiples::keep(coefficients.clone(), &start_scales(&coefficients), accuracy, 0.0);
        if kept == coefficients {
            break;
        }
        coefficients = kept;
    }
    (start_scales(&coefficients), coefficients)
}

fn start_scales(coefficients: &Mat<f64>) -> Vec<f64> {
    let size = |k: usize| (coefficients.col(k).squared_norm_l2() / coefficients.nrows() as f64).sqrt();
    let sizes: Vec<f64> = (0..coefficients.ncols()).map(|k| size(k).max(f64::MIN_POSITIVE)).collect();
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    sizes.iter().map(|own| 1.0 / (own * (largest / own).sqrt().min(COARSEST))).collect()
}

/// Rounds film thicknesses and coefficients of snapshots to their stored precision, for the given number of modes.
pub fn keep_snapshots(snapshots: &mut [Snapshot], modes: usize, keeping: Keeping) {
    let (_, kept) = kept_starts(snapshots, modes, keeping.starts());
    for (snapshot, kept) in snapshots.iter_mut().zip(kept.row_iter()) {
        snapshot.coefficients = kept.iter().copied().collect();
        for film in [&mut snapshot.h_0, &mut snapshot.h_c] {
            *film = f64::from(kept_digits(*film, FILM_DIGITS));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_of_starts_is_idempotent() {
        let size = |k: usize| [1.3, 2e-2, 1e-5][k];
        let coefficients = Mat::from_fn(40, 3, |i, k| size(k) * (1.0 + (i * (k + 2)) as f64 * 0.7).sin());
        let (scales, kept) = kept_coefficients(coefficients.clone(), 1e-3);
        assert!(kept_coefficients(kept.clone(), 1e-3) == (scales, kept.clone()));
        for (k, least) in [(0, 1e-5), (1, 1e-4), (2, 1e-3)] {
            let off = (0..40).map(|i| (kept[(i, k)] - coefficients[(i, k)]).abs()).fold(0.0, f64::max) / size(k);
            assert!(off > least && off < 2e-2, "{k}: {off:e}");
        }
    }
}
