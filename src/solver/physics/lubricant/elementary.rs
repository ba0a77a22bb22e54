//! Powers and hyperbolic sines of several numbers at once. They use a logarithm and an exponential without branches
//! and tables. Loops over them run in the widest vector registers of the machine and give the same numbers on all
//! machines.
//!
//! The laws of a shear-thinning film need one or two of them at every quadrature point across it. Reductions and
//! coefficients are those of fdlibm (Sun Microsystems 1993, `e_log.c`, `e_exp.c`). Both functions differ by at most
//! 1e-15 from those of the C library, relative to their values, away from zeros.

use pulp::{Arch, Simd, WithSimd};

/// Raises every x > 0 to a power.
pub(super) fn raise(values: &mut [f64], exponent: f64) {
    Arch::new().dispatch(Raise { values, exponent });
}

struct Raise<'a> {
    values: &'a mut [f64],
    exponent: f64,
}

impl WithSimd for Raise<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for x in self.values.iter_mut() {
            *x = self.exponent * ln(*x);
        }
        for x in self.values {
            *x = exp(*x);
        }
    }
}

/// Replaces every x by e^x.
pub(super) fn exponentials(values: &mut [f64]) {
    Arch::new().dispatch(Exponentials(values));
}

struct Exponentials<'a>(&'a mut [f64]);

impl WithSimd for Exponentials<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for x in self.0 {
            *x = exp(*x);
        }
    }
}

/// Coefficients 1/(2k + 1)! of (sinh t)/t in t², and 2k/(2k + 1)! of cosh t − (sinh t)/t over t²; sufficient up to t
/// = 1.
const SINE: [f64; 10] = [
    1.0,
    1.0 / 6.0,
    1.0 / 120.0,
    1.0 / 5_040.0,
    1.0 / 362_880.0,
    1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
    1.0 / 121_645_100_408_832_000.0,
];
const RISE: [f64; 9] = [
    2.0 / 6.0,
    4.0 / 120.0,
    6.0 / 5_040.0,
    8.0 / 362_880.0,
    10.0 / 39_916_800.0,
    12.0 / 6_227_020_800.0,
    14.0 / 1_307_674_368_000.0,
    16.0 / 355_687_428_096_000.0,
    18.0 / 121_645_100_408_832_000.0,
];

/// Replaces every t in 0…700 by t/sinh t. The slopes are t times its derivative by t, t/sinh t (1 − t coth t). Both
/// have full relative accuracy, also near t = 0.
pub(super) fn hyperbolic_sines(values: &mut [f64], slopes: &mut [f64]) {
    Arch::new().dispatch(HyperbolicSines { values, slopes });
}

struct HyperbolicSines<'a> {
    values: &'a mut [f64],
    slopes: &'a mut [f64],
}

impl WithSimd for HyperbolicSines<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { values, slopes } = self;
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for t in values.iter() {
            (least, most) = (least.min(*t), most.max(*t));
        }
        let lanes = values.iter_mut().zip(slopes);
        // Loops without a branch: in most films all values lie on one side.
        if most < 1.0 {
            for (value, slope) in lanes {
                (*value, *slope) = near_sine(*value);
            }
        } else if least >= 1.0 {
            for (value, slope) in lanes {
                (*value, *slope) = far_sine(*value);
            }
        } else {
            for (value, slope) in lanes {
                let (near, far) = (near_sine(value.min(1.0)), far_sine(*value));
                (*value, *slope) = if *value < 1.0 { near } else { far };
            }
        }
    }
}

/// Uses the series, which has no cancellation, up to t = 1.
#[inline(always)]
fn near_sine(t: f64) -> (f64, f64) {
    let square = t * t;
    let value = 1.0 / polynomial(&SINE, square);
    (value, -square * value * value * polynomial(&RISE, square))
}

#[inline(always)]
fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    let mut sum = 0.0;
    for c in coefficients.iter().rev() {
        sum = sum * x + c;
    }
    sum
}

/// Uses the exponential for t ≥ 1.
#[inline(always)]
fn far_sine(t: f64) -> (f64, f64) {
    let growing = exp(t);
    let shrinking = 1.0 / growing;
    let per_sine = 2.0 / (growing - shrinking);
    let value = t * per_sine;
    (value, value * (1.0 - 0.5 * value * (growing + shrinking)))
}

const LN_2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// Returns ln x for normal x > 0. Zero and subnormal numbers are treated as the smallest normal one, infinity as
/// 2^1024. Results for other arguments are meaningless.
#[inline(always)]
pub(super) fn ln(x: f64) -> f64 {
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
    /// √½: x is 2^k m with m between √½ and √2.
    const LEAST: u64 = 0x3fe6_a09e_667f_3bcd;
    /// 2^52: the bits below are integers.
    const WHOLE: u64 = 0x4330_0000_0000_0000;
    let shifted = x.max(f64::MIN_POSITIVE).to_bits().wrapping_add(ONE - LEAST);
    let exponent = f64::from_bits(shifted >> 52 | WHOLE) - (f64::from_bits(WHOLE) + 1023.0);
    let f = f64::from_bits((shifted & MANTISSA) + LEAST) - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let odd = z
        * (0.666_666_666_666_673_5
            + z * z * (0.285_714_287_436_623_9 + z * z * (0.181_835_721_616_180_5 + z * z * 0.147_981_986_051_165_86)));
    let even =
        z * z * (0.399_999_999_994_094_2 + z * z * (0.222_221_984_321_497_84 + z * z * 0.153_138_376_992_093_73));
    let half_square = 0.5 * f * f;
    exponent * LN_2_HIGH - ((half_square - (s * (half_square + odd + even) + exponent * LN_2_LOW)) - f)
}

/// Returns exp x, limited to exp(±700), so that divisions by it do not overflow.
#[inline(always)]
pub(super) fn exp(x: f64) -> f64 {
    /// 1.5 · 2^52: a sum with it is rounded to an integer, which its last bits contain.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let x = if x > 700.0 { 700.0 } else { x };
    let x = if x < -700.0 { -700.0 } else { x };
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let (high, low) = (x - k * LN_2_HIGH, k * LN_2_LOW);
    let r = high - low;
    let z = r * r;
    let c = r - z
        * (0.166_666_666_666_666_02
            + z * (-2.777_777_777_701_559_3e-3
                + z * (6.613_756_321_437_934e-5 + z * (-1.653_390_220_546_525_2e-6 + z * 4.138_136_797_057_238e-8))));
    let value = 1.0 - ((low - r * c / (2.0 - c)) - high);
    f64::from_bits(value.to_bits().wrapping_add(shifted.to_bits() << 52))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_agree_with_the_library_over_all_magnitudes() {
        for k in 0..200_000 {
            let x = -690.0 + 1380.0 * f64::from(k) / 200_000.0;
            assert!((exp(x) / x.exp() - 1.0).abs() < 1e-15, "exp {x}");
            let t = x.exp();
            assert!((ln(t) - t.ln()).abs() <= 5e-16 * t.ln().abs(), "ln {t}");
            // Near the zero of the logarithm.
            let t = 0.5 + f64::from(k) / 100_000.0;
            assert!((ln(t) - t.ln()).abs() <= 5e-16 * t.ln().abs(), "ln {t}");
        }
    }

    #[test]
    fn hyperbolic_sines_are_exact_relative_to_themselves() {
        let ts: Vec<f64> = (0..4000).map(|k| 1e-9 * 1.007f64.powi(k)).filter(|t| *t < 150.0).collect();
        let (mut factors, mut slopes) = (ts.clone(), vec![0.0; ts.len()]);
        hyperbolic_sines(&mut factors, &mut slopes);
        for ((t, factor), slope) in ts.iter().zip(&factors).zip(&slopes) {
            assert!((factor * t.sinh() / t - 1.0).abs() < 2e-15, "{t}");
            // t coth t − 1 = t²/3 − t⁴/45 + 2 t⁶/945 − …, because the difference itself loses its accuracy.
            let wanted = if *t < 0.01 {
                -t * t / 3.0 * (1.0 - t * t / 15.0 + 2.0 / 315.0 * t.powi(4))
            } else {
                1.0 - t / t.tanh()
            };
            let rounding = 1e-15 + 4e-16 * t / t.tanh() / wanted.abs();
            assert!((slope / (factor * wanted) - 1.0).abs() < rounding, "{t}: {slope}");
        }
        let (mut factor, mut slope) = ([0.0], [1.0]);
        hyperbolic_sines(&mut factor, &mut slope);
        assert_eq!((factor, slope), ([1.0], [-0.0]));
    }

    #[test]
    fn the_ends_are_finite() {
        assert_eq!(ln(0.0), ln(f64::MIN_POSITIVE));
        assert!(
            (ln(0.0) / f64::MIN_POSITIVE.ln() - 1.0).abs() < 1e-15
                && (ln(f64::INFINITY) / (1024.0 * 2f64.ln()) - 1.0).abs() < 1e-15
        );
        assert_eq!((exp(-1e9), exp(1e9)), (exp(-700.0), exp(700.0)));
        assert!(exp(700.0).is_finite() && exp(-700.0) > 0.0 && exp(f64::NAN).is_nan());
    }
}
