//! Precision in which the modes of a model are stored.
//!
//! A file stores the values of modes as multiples of a power of two: one factor per node times one per mode. A mode
//! that hardly appears in any solution needs few digits. A node with small pressures needs as many digits as any
//! other, since the mobility of thick films amplifies errors there. Modes are rounded before rows are selected and
//! errors measured, so that a trained model and one read from a file are identical, and the error bounds hold for
//! both. Starting values are rounded too: in thin films the last Newton step does not remove the error of an
//! inaccurate initial guess completely.

use super::pod::PodBasis;
use faer::Mat;

/// Modes are stored as if none were rarer than this, relative to the first one.
const RAREST: f64 = 1e-5;
/// Fields are stored as if they were nowhere smaller than this, relative to their largest value.
const SMALLEST: f64 = 1e-30;
/// Maximum number of rounds until storing again changes nothing. A row whose size is near a power of two may change
/// its multiple once.
pub(super) const ROUNDS: usize = 8;

/// Accuracy of the reconstruction from sampled equations, relative to its size for a mode. The residuals that it is
/// applied to are nearly zero.
pub const RULE_ACCURACY: f64 = 1e-4;

/// Bits of the significand of an f32, without the leading one.
pub const ALL_DIGITS: u32 = 23;
/// Accuracy of the share of each mode of a shared basis in the pressures of a local model, relative to that share.
const FACTOR_ACCURACY: f64 = 1e-6;
/// Shares below this, relative to the largest, are stored with the digits of this share.
const SMALL_SHARE: f64 = 1e-2;
/// The same share if [`SMALL_SHARE`] spoils modes, as in local models whose pressures hardly differ.
const SMALLER_SHARE: f64 = 1e-3;
/// Largest accepted rounding error of a mode of norm one. Modes beyond it are noise, and the equations for their
/// coefficients are singular.
const SPOILT: f64 = 0.1;

/// Multiples in which columns over nodes are stored: 2^(exponent of the row + exponent of the column).
#[derive(Clone, Debug, PartialEq)]
pub struct Multiples {
    /// Exponents of the rows; `None` if all values of the row are negligible.
    pub rows: Vec<Option<i16>>,
    /// Exponents of the columns.
    pub columns: Vec<i16>,
}

impl Multiples {
    /// Rounds columns to `accuracy` relative to the size Σ_k (scale_k V_ik)² of each row, or relative to `least` of
    /// the largest row if that is more. Returns the multiples and the rounded matrix, which stays unchanged when it
    /// is rounded again.
    pub fn keep(mut matrix: Mat<f64>, scales: &[f64], accuracy: f64, least: f64) -> (Self, Mat<f64>) {
        let mut multiples = Self::of(&matrix, scales, accuracy, least);
        for _ in 0..ROUNDS {
            let kept = multiples.nearest(&matrix);
            if kept == matrix {
                break;
            }
            matrix = kept;
            multiples = Self::of(&matrix, scales, accuracy, least);
        }
        (multiples, matrix)
    }

    fn of(matrix: &Mat<f64>, scales: &[f64], accuracy: f64, least: f64) -> Self {
        let size = |i: usize| scales.iter().enumerate().map(|(k, s)| (s * matrix[(i, k)]).powi(2)).sum::<f64>().sqrt();
        let sizes: Vec<f64> = (0..matrix.nrows()).map(size).collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        let exponent = |step: f64| step.log2().floor() as i16;
        let rows = sizes.iter().map(|size| (*size > SMALLEST * largest).then(|| exponent(size.max(least * largest))));
        Self { rows: rows.collect(), columns: scales.iter().map(|scale| exponent(accuracy / scale)).collect() }
    }

    fn nearest(&self, matrix: &Mat<f64>) -> Mat<f64> {
        Mat::from_fn(matrix.nrows(), matrix.ncols(), |i, k| match self.rows[i] {
            Some(row) => {
                let step = f64::from(row).exp2() * f64::from(self.columns[k]).exp2();
                step * (matrix[(i, k)] / step).round()
            }
            None => 0.0,
        })
    }
}

/// Rounds the reconstruction from sampled equations, modes × rows, to its stored precision. Used for models with
/// dozens of local models.
pub fn kept_rule(rule: Mat<f64>) -> Mat<f64> {
    let scales = vec![1.0; rule.ncols()];
    Multiples::keep(rule, &scales, RULE_ACCURACY, 0.0).1
}

/// Returns the root mean square share of each of the first modes, at most `modes`, in the solutions of a local model.
pub fn factor_scales(singular_values: &[f64], modes: usize) -> Vec<f64> {
    let count = (singular_values.len() as f64).sqrt();
    singular_values.iter().take(modes).map(|sigma| (sigma / count).max(f64::MIN_POSITIVE)).collect()
}

/// Rounds the coefficients of a local model's orthonormal modes in a shared basis to their stored precision. Ends
/// before the first mode that is spoilt by rounding.
pub(super) fn kept_factors(factors: Mat<f64>, scales: &[f64]) -> Mat<f64> {
    let keep = |columns: usize, share: f64| {
        let (some, scales) = (factors.get(.., ..columns).to_owned(), &scales[..columns]);
        Multiples::keep(some, scales, FACTOR_ACCURACY, share).1
    };
    let spoilt = |kept: &Mat<f64>| (0..kept.ncols()).find(|&k| (kept.col(k) - factors.col(k)).norm_l2() > SPOILT);
    let all = factors.ncols().min(scales.len());
    let kept = keep(all, SMALL_SHARE);
    if spoilt(&kept).is_none() {
        return kept;
    }
    let finer = keep(all, SMALLER_SHARE);
    // The steps depend on the sizes of the rows, which then have fewer modes.
    spoilt(&finer).map_or(finer, |first| keep(first, SMALLER_SHARE))
}

/// Returns the accuracy for which stored coefficients of modes in a shared basis stay unchanged, and the smallest
/// share that determines digits.
pub fn factor_accuracy(factors: &Mat<f64>, scales: &[f64]) -> [f64; 2] {
    let stays = Multiples::keep(factors.clone(), scales, FACTOR_ACCURACY, SMALL_SHARE).1 == *factors;
    [FACTOR_ACCURACY, if stays { SMALL_SHARE } else { SMALLER_SHARE }]
}

/// Rounds a number to the nearest one with `digits` bits of the significand.
pub fn kept_digits(number: f64, digits: u32) -> f32 {
    let single = number as f32;
    let dropped = ALL_DIGITS.saturating_sub(digits);
    let half = (1u32 << dropped) / 2;
    let rounded = f32::from_bits(single.to_bits().wrapping_add(half) >> dropped << dropped);
    if rounded.is_finite() { rounded } else { single }
}

impl PodBasis {
    /// Returns the root mean square share of each mode in the snapshots: σ_k divided by the square root of their
    /// number.
    pub fn scales(&self) -> Vec<f64> {
        let sigma = &self.singular_values;
        let (largest, count) = (sigma.first().copied().unwrap_or(1.0).max(f64::MIN_POSITIVE), sigma.len() as f64);
        sigma.iter().take(self.modes.ncols()).map(|s| s.max(RAREST * largest) / count.sqrt()).collect()
    }

    /// Rounds the modes to their stored precision. The error of each mode changes the fields of the snapshots by at
    /// most `accuracy` of their size at every node (both as root mean squares over the snapshots). Rounding again
    /// changes nothing.
    pub fn kept(self, accuracy: f64) -> Self {
        let scales = self.scales();
        Self { modes: Multiples::keep(self.modes, &scales, accuracy, 0.0).1, singular_values: self.singular_values }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_idempotent_within_its_accuracy() {
        let pressure = |k: usize, i: usize| {
            let x = 0.02 * i as f64 - 1.2 - 0.01 * k as f64;
            if x < 0.0 { 1e-6 * (4.0 * x).exp() } else { x * (-x * (1.0 + 0.1 * k as f64)).exp() }
        };
        let pressures = Mat::from_fn(300, 24, |i, k| if i < 4 { 0.0 } else { pressure(k, i) });
        let mut basis = PodBasis::new(pressures.as_ref(), &[0.02; 300], 1e-9).unwrap().cut(12);
        // Rounding errors of a decomposition would otherwise have a size like other values.
        basis.modes.row_mut(2).fill(0.0);
        for accuracy in [1e-5, 1e-8, 1e-11] {
            let kept = basis.clone().kept(accuracy);
            assert!(kept.modes.row(2).iter().all(|v| *v == 0.0) && kept.modes != basis.modes);
            let again = kept.clone().kept(accuracy);
            assert!(again.modes == kept.modes);
            for k in 0..24 {
                let of = basis.coefficients(&[0.02; 300], |i| pressures[(i, k)]);
                let made = |basis: &PodBasis, i: usize| -> f64 {
                    of.iter().enumerate().map(|(m, c)| c * basis.modes[(i, m)]).sum()
                };
                for i in [10, 59, 61, 100, 250] {
                    let size = pressures.row(i).norm_l2() / 24f64.sqrt();
                    let off = (made(&kept, i) - made(&basis, i)).abs();
                    assert!(off < 30.0 * accuracy * size, "{accuracy:e} {k} {i}: {off:e} of {size:e}");
                }
            }
        }
    }

    #[test]
    fn modes_in_a_shared_basis_end_where_their_digits_do() {
        let of = Mat::from_fn(40, 12, |i, k| ((i * (k + 3)) as f64 * 0.61).sin() * 0.6f64.powi(i as i32));
        let factors = PodBasis::new(of.as_ref(), &[1.0; 40], 0.0).unwrap().cut(12).modes;
        let falls = |by: f64| -> Vec<f64> { (0..12).map(|k| by.powi(k)).collect() };
        // Ratio of successive shares, number of remaining modes, and share that determines digits.
        for (by, modes, share) in [(0.6, 12..=12, 1e-2), (0.2, 12..=12, 1e-3), (0.03, 3..=8, 1e-3)] {
            let kept = kept_factors(factors.clone(), &falls(by));
            let scales = &falls(by)[..kept.ncols()];
            assert!(modes.contains(&kept.ncols()), "{by}: {}", kept.ncols());
            let lost = |k: usize| (kept.col(k) - factors.col(k)).norm_l2();
            assert!(lost(0) > 0.0 && (0..kept.ncols()).all(|k| lost(k) < SPOILT), "{by}: {}", lost(kept.ncols() - 1));
            assert_eq!(factor_accuracy(&kept, scales), [FACTOR_ACCURACY, share], "{by}");
            assert!(Multiples::keep(kept.clone(), scales, FACTOR_ACCURACY, share).1 == kept);
        }
        assert_eq!(factor_scales(&[8.0, 2.0, 0.0, 0.0], 3), [4.0, 1.0, f64::MIN_POSITIVE]);
    }

    #[test]
    fn numbers_keep_their_digits_and_are_rounded_to_the_nearest() {
        assert_eq!(kept_digits(1.0, 16).to_bits(), 1f32.to_bits());
        assert!((f64::from(kept_digits(1.0 + 2f64.powi(-16), 16)) - 1.0 - 2f64.powi(-16)).abs() < 1e-12);
        assert_eq!(kept_digits(1.0 + 2f64.powi(-18), 16).to_bits(), 1f32.to_bits());
        assert_eq!(kept_digits(-2.0 + 2f64.powi(-18), 16).to_bits(), (-2f32).to_bits());
        assert!(kept_digits(f64::from(f32::MAX), 8).is_finite() && kept_digits(f64::NAN, 8).is_nan());
        for number in [0.0, 3.7e-9, -12.25, 8.1e10] {
            let once = kept_digits(number, 16);
            assert_eq!(kept_digits(f64::from(once), 16).to_bits(), once.to_bits(), "{number}");
        }
    }

    #[test]
    fn small_rows_are_kept_no_better_than_a_share_of_the_largest() {
        let matrix = Mat::from_fn(3, 5, |i, k| [1.0, 0.3, 1e-4][i] * (1.0 + i as f64 + 2.0 * k as f64).sin());
        for (least, finer) in [(0.0, 1e-4), (1e-2, 1e-2)] {
            let (_, kept) = Multiples::keep(matrix.clone(), &[1.0; 5], 1e-6, least);
            let off = |i: usize| (0..5).map(|k| (kept[(i, k)] - matrix[(i, k)]).abs()).fold(0.0, f64::max);
            assert!(off(0) > 0.0 && off(0) <= 3e-6, "{:e}", off(0));
            assert!(off(2) > 0.0 && off(2) <= 3e-6 * finer, "{least}: {:e}", off(2));
            assert!(Multiples::keep(kept.clone(), &[1.0; 5], 1e-6, least).1 == kept);
        }
        let (_, coarse) = Multiples::keep(matrix.clone(), &[1.0; 5], 1e-6, 1e-2);
        assert!((0..5).any(|k| (coarse[(2, k)] - matrix[(2, k)]).abs() > 1e-10));
    }
}
