//! Rounding of the numbers that a calibrated error estimate stores for each measured error (its evidence). The numbers
//! are the scaled features, called the position, and the surplus: the logarithm of the error minus that of the fitted
//! law. About two digits of them are sufficient.

/// Step of the coordinates of a position, which lie in −1…1.
const PLACE_STEP: f64 = 1.0 / 256.0;
/// Step of a surplus.
const SURPLUS_STEP: f64 = 1.0 / 64.0;

/// Rounds a coordinate of a position to its stored precision.
pub(super) fn kept_place(value: f32) -> f32 {
    rounded(f64::from(value), PLACE_STEP)
}

/// Rounds a surplus to its stored precision.
pub(super) fn kept_surplus(value: f64) -> f32 {
    rounded(value, SURPLUS_STEP)
}

/// Rounds to the nearest multiple of the step. Negative zero becomes zero, and every NaN the same NaN, so that equal
/// results have equal bits.
fn rounded(value: f64, step: f64) -> f32 {
    if value.is_nan() { f32::NAN } else { ((value / step).round() * step + 0.0) as f32 }
}
