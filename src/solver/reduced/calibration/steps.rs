//! To how many digits a calibration is kept: where its evidence lies, and by how much the errors there exceed the law, need
//! no more than two.

/// Steps of the coordinates of places in −1…1.
const PLACE: f64 = 1.0 / 256.0;
/// Steps of the logarithms of errors.
const SURPLUS: f64 = 1.0 / 64.0;

/// A coordinate of a place as it is kept.
pub(super) fn kept_place(value: f32) -> f32 {
    kept(f64::from(value), PLACE)
}

/// A surplus as it is kept.
pub(super) fn kept_surplus(value: f64) -> f32 {
    kept(value, SURPLUS)
}

/// The nearest of so wide steps; one zero only, and one that is no number.
fn kept(value: f64, step: f64) -> f32 {
    if value.is_nan() { f32::NAN } else { ((value / step).round() * step + 0.0) as f32 }
}
