//! To what precision the modes, rules and starting values of a window are kept, by what kind of window it is.

use super::model::{Snapshot, Window};
use super::multiples::{Multiples, ROUNDS, kept_digits};
use crate::solver::physics::contact::ContactKind;
use faer::Mat;

/// Bits of the significand that are kept of films of snapshots, a relative step of 1.5e-5: starts in windows around anchors are a
/// hundred times as far off.
pub const FILM_DIGITS: u32 = 16;
/// How many times less exactly those of rare modes are kept at most: starts know little of these.
const COARSEST: f64 = 20.0;

/// What decides how exactly the modes of a window are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Keeping {
    /// Line or point contacts.
    pub kind: ContactKind,
    /// Whether it is one of many windows around anchors.
    pub anchored: bool,
    /// Whether it knows heat.
    pub heat: bool,
    /// Whether it knows ellipses.
    pub shapes: bool,
}

impl Keeping {
    /// Of a window of a model that knows heat or does not.
    pub fn of(window: &Window, heat: bool) -> Self {
        let (anchored, shapes) = (window.anchor.is_some(), window.shapes.is_some());
        Self { kind: window.grid.kind(), anchored, heat, shapes }
    }

    /// Whether what is made of the rows' values has few digits, [`RULE_ACCURACY`](super::RULE_ACCURACY), or is the weights of a cubature: of windows
    /// that come by the dozen, and of those with heat.
    pub fn shortens_rules(self) -> bool {
        self.anchored || self.shapes || self.heat
    }

    /// Accuracy of pressures at every node, relative to their own size there.
    pub fn accuracy(self) -> f64 {
        match self.kind {
            // Temperatures are not known to more.
            ContactKind::Line if self.anchored && self.heat => 1e-10,
            // These have dozens of windows, and thin films under heavy loads: at 1e-8 Newtonian ones lost more than their
            // modes miss, at 1e-10 sliding ones up to a tenth of the film, at 1e-11 nothing of it.
            ContactKind::Line if self.anchored => 1e-11,
            ContactKind::Line => 1e-13,
            // Their modes miss ten times more: here films are off by 1e-4 (95 of 100), 7e-4 at most; at 1e-7 by 4e-3.
            ContactKind::Point if self.anchored => 3e-8,
            // These have many windows, and K V is interpolated over the shapes: 6e-4 and 2e-3.
            ContactKind::Point if self.shapes => 8e-7,
            // 1e-4 and 2e-4.
            ContactKind::Point => 1e-7,
        }
    }

    /// Accuracy of the coefficients of the first mode in snapshots, relative to their size.
    pub fn starts(self) -> f64 {
        match self.kind {
            // A line's iteration starts at them as they are and has all modes of a whole range, with α p_H up to 45: at 1e-3
            // 47 of 10,000 iterations led nowhere, beside a snapshot of their own (Table 3.3's plan of 120 by hand). At 1e-4
            // all led to one, but some took six steps where at 1e-6 two are enough.
            ContactKind::Line if !self.anchored => 1e-6,
            ContactKind::Line | ContactKind::Point => 1e-3,
        }
    }
}

/// Coefficients of a window's snapshots in so many modes, snapshots × modes, as they are kept, and the scales of their
/// columns: no more than starts are made of them.
pub fn kept_starts(snapshots: &[Snapshot], modes: usize, accuracy: f64) -> (Vec<f64>, Mat<f64>) {
    let of = |i: usize, k: usize| snapshots.get(i)?.coefficients.get(k).copied();
    kept_coefficients(Mat::from_fn(snapshots.len(), modes, |i, k| of(i, k).unwrap_or_default()), accuracy)
}

fn kept_coefficients(mut coefficients: Mat<f64>, accuracy: f64) -> (Vec<f64>, Mat<f64>) {
    // Steps go with sizes, which rounding may change: what is kept stays as it is when it is kept again.
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

/// Snapshots of a window, in so many modes, with their films and coefficients as they are kept.
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
    fn starts_stay_as_they_are_when_they_are_kept_again_and_rare_modes_have_fewer_digits() {
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
