//! To what precision the modes of a model are kept.
//!
//! A file has a mode's values as multiples of a power of two, one for each node times one for each mode: a mode that hardly
//! appears in any solution needs few digits, and a node where pressures are small as many as any other, since the mobility
//! of thick films multiplies what is lost there. Modes are rounded to these before rows are chosen and errors measured, so
//! that a model that was trained and one that is read are the same, and bounds are those of both. So are what starts are
//! made of: where films are thin, what Newton's last step leaves of a start that is a thousandth off is what they are off.

use super::pod::PodBasis;
use faer::Mat;

/// Modes are kept as if none were rarer than this, relative to the first one.
const RAREST: f64 = 1e-5;
/// Fields are nowhere kept as if they were smaller than this, relative to their largest value.
const SMALLEST: f64 = 1e-30;
/// Rounds after which what is kept stays: a row whose size lies at a power of two may turn to the next multiple once.
pub(super) const ROUNDS: usize = 8;

/// Accuracy of what an interpolation makes of the values of its rows, relative to what it makes of all for a mode: residuals
/// that are nearly zero are what it is given.
pub const RULE_ACCURACY: f64 = 1e-4;

/// Bits of the significand of an f32, the leading one not counted.
pub const ALL_DIGITS: u32 = 23;
/// Accuracy of the share of each mode of a shared basis in the pressures of a window, relative to that share.
const FACTOR_ACCURACY: f64 = 1e-6;
/// The share, relative to the largest, below which digits are those of that.
const SMALL_SHARE: f64 = 1e-2;
/// The same where that spoils modes: of windows whose pressures hardly differ it left half of them.
const SMALLER_SHARE: f64 = 1e-3;
/// What a mode of norm one may lose by that and still be one: those that follow it are noise, and equations that ask for
/// their coefficients are singular.
const SPOILT: f64 = 0.1;

/// The multiples that columns over nodes are kept as: 2^(exponent of the row + exponent of the column).
#[derive(Clone, Debug, PartialEq)]
pub struct Multiples {
    /// None where no column has a value worth the name.
    pub rows: Vec<Option<i16>>,
    /// Of each column.
    pub columns: Vec<i16>,
}

impl Multiples {
    /// Those that keep columns to `accuracy` relative to the size Σ_k (scale_k V_ik)² of each row, or to `least` of the
    /// largest row where that is more, and what is kept: it stays as it is when it is kept again.
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

/// What is made of the values of sampled rows, modes × rows, as it is kept where dozens of windows have one each.
pub fn kept_rule(rule: Mat<f64>) -> Mat<f64> {
    let scales = vec![1.0; rule.ncols()];
    Multiples::keep(rule, &scales, RULE_ACCURACY, 0.0).1
}

/// How large the share of each of the first modes, so many at most, in the solutions of a window is, root mean square.
pub fn factor_scales(singular_values: &[f64], modes: usize) -> Vec<f64> {
    let count = (singular_values.len() as f64).sqrt();
    singular_values.iter().take(modes).map(|sigma| (sigma / count).max(f64::MIN_POSITIVE)).collect()
}

/// What a window's orthonormal modes are in a shared basis, as it is kept, up to the first of them that is spoilt by that.
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
    // Steps go with the sizes of rows, which have fewer modes then.
    spoilt(&finer).map_or(finer, |first| keep(first, SMALLER_SHARE))
}

/// The accuracy to which what a window's modes are in a shared basis stays as it is once it is kept, and the least share
/// that it counts for.
pub fn factor_accuracy(factors: &Mat<f64>, scales: &[f64]) -> [f64; 2] {
    let stays = Multiples::keep(factors.clone(), scales, FACTOR_ACCURACY, SMALL_SHARE).1 == *factors;
    [FACTOR_ACCURACY, if stays { SMALL_SHARE } else { SMALLER_SHARE }]
}

/// A number with so many digits of its significand, rounded to the nearest.
pub fn kept_digits(number: f64, digits: u32) -> f32 {
    let single = number as f32;
    let dropped = ALL_DIGITS.saturating_sub(digits);
    let half = (1u32 << dropped) / 2;
    let rounded = f32::from_bits(single.to_bits().wrapping_add(half) >> dropped << dropped);
    if rounded.is_finite() { rounded } else { single }
}

impl PodBasis {
    /// How large each mode's share in the snapshots is, root mean square: σ_k over the root of their number.
    pub fn scales(&self) -> Vec<f64> {
        let sigma = &self.singular_values;
        let (largest, count) = (sigma.first().copied().unwrap_or(1.0).max(f64::MIN_POSITIVE), sigma.len() as f64);
        sigma.iter().take(self.modes.ncols()).map(|s| s.max(RAREST * largest) / count.sqrt()).collect()
    }

    /// The same with its modes as they are kept: what each one loses changes the fields of the snapshots by `accuracy` of
    /// their size at every node at most (both as root mean squares over the snapshots). What is kept stays as it is when it
    /// is kept again.
    pub fn kept(self, accuracy: f64) -> Self {
        let scales = self.scales();
        Self { modes: Multiples::keep(self.modes, &scales, accuracy, 0.0).1, singular_values: self.singular_values }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_kept_is_kept_when_it_is_kept_again_and_fields_change_by_the_accuracy() {
        let pressure = |k: usize, i: usize| {
            let x = 0.02 * i as f64 - 1.2 - 0.01 * k as f64;
            if x < 0.0 { 1e-6 * (4.0 * x).exp() } else { x * (-x * (1.0 + 0.1 * k as f64)).exp() }
        };
        let pressures = Mat::from_fn(300, 24, |i, k| if i < 4 { 0.0 } else { pressure(k, i) });
        let mut basis = PodBasis::new(pressures.as_ref(), &[0.02; 300], 1e-9).unwrap().cut(12);
        // What a decomposition leaves of zeros has a size like any other.
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
        // The rarest share, how many modes are left, and to what share they are kept.
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
