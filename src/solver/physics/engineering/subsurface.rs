//! The largest shear stress under a dry Hertzian contact, on the line through its centre.

use crate::solver::physics::contact::ContactKind;

/// The largest shear stress under the surface and where it acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestShear {
    /// τ_max over the Hertzian pressure p_H.
    pub over_hertz_pressure: f64,
    /// Depth over the half width (line) or radius (point) a.
    pub depth_over_half_width: f64,
}

/// The largest shear stress on the axis below a frictionless Hertzian contact. Poisson's ratio counts for a point
/// contact only; Johnson, Contact Mechanics, (4.45) and (3.45).
pub fn largest_shear(kind: ContactKind, poisson: f64) -> LargestShear {
    let shear = |z: f64| match kind {
        // ½|σ_x − σ_z| with σ_x = −p_H((1 + 2z²)/√(1 + z²) − 2z), σ_z = −p_H/√(1 + z²).
        ContactKind::Line => z - z * z / (1.0 + z * z).sqrt(),
        ContactKind::Point => {
            let axial = 1.0 / (1.0 + z * z);
            let radial = (1.0 + poisson) * (1.0 - z * (1.0 / z).atan()) - 0.5 * axial;
            0.5 * (axial - radial).abs()
        }
    };
    let depth = maximum_between(0.05, 2.0, &shear);
    LargestShear { over_hertz_pressure: shear(depth), depth_over_half_width: depth }
}

/// Golden-section search for the one maximum inside.
fn maximum_between(mut low: f64, mut high: f64, value: &dyn Fn(f64) -> f64) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    for _ in 0..60 {
        let (left, right) = (high - golden * (high - low), low + golden * (high - low));
        if value(left) < value(right) { low = left } else { high = right }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_values_of_the_textbooks() {
        let line = largest_shear(ContactKind::Line, 0.3);
        assert!((line.over_hertz_pressure - 0.300).abs() < 5e-4 && (line.depth_over_half_width - 0.786).abs() < 5e-4);
        let point = largest_shear(ContactKind::Point, 0.3);
        assert!((point.over_hertz_pressure - 0.310).abs() < 5e-4, "{point:?}");
        assert!((point.depth_over_half_width - 0.481).abs() < 1e-3, "{point:?}");
    }
}
