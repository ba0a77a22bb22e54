//! Precision in which a calibration is stored. Positions of the evidence and surpluses of its errors need only two
//! digits.

/// Step of the coordinates of positions in −1…1.
const PLACE: f64 = 1.0 / 256.0;
/// Step of the logarithms of errors.
const SURPLUS: f64 = 1.0 / 64.0;

/// Rounds a coordinate of a position to its stored precision.
pub(super) fn kept_place(value: f32) -> f32 {
    kept(f64::from(value), PLACE)
}

/// Rounds a surplus to its stored precision.
pub(super) fn kept_surplus(value: f64) -> f32 {
    kept(value, SURPLUS)
}

/// Rounds to the nearest multiple of the step. Zero is always positive, and NaN always the same.
fn kept(value: f64, step: f64) -> f32 {
    if value.is_nan() { f32::NAN } else { ((value / step).round() * step + 0.0) as f32 }
}
