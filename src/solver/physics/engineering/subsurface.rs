//! Maximum subsurface shear stress of a dry Hertzian contact, on the line through its centre.

use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use ellip::{elliprd, elliprf};

/// Maximum shear stress below the surface and its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestShear {
    /// τ_max over the Hertzian pressure p_H.
    pub over_hertz_pressure: f64,
    /// Depth over the half width (line contact) or the semi-axis along the rolling direction (point contact) a.
    pub depth_over_half_width: f64,
}

/// Relative difference of the semi-axes below which the formula of elliptical contacts becomes 0/0.
const NEARLY_ROUND: f64 = 1e-4;

/// Returns the maximum shear stress on the axis below a frictionless Hertzian contact. Poisson's ratio is used for a
/// point contact only. Source: Johnson, Contact Mechanics, (4.45) and (3.45), for ellipses (3.69).
pub fn largest_shear(point: &OperatingPoint, poisson: f64) -> LargestShear {
    let kappa = point.ellipse().kappa;
    // Stresses are independent of the rolling direction.
    let ratio = kappa.min(kappa.recip());
    match point.kind {
        ContactKind::Line => deepest(1.0, &below_line),
        ContactKind::Point if 1.0 - ratio < NEARLY_ROUND => deepest(1.0, &|z| below_circle(z, poisson)),
        ContactKind::Point => deepest(kappa.min(1.0), &|z| below_ellipse(ratio, ratio * z, poisson)),
    }
}

/// Returns the maximum over the depth in units of the smaller semi-axis. `smaller` is that semi-axis over a.
fn deepest(smaller: f64, shear: &dyn Fn(f64) -> f64) -> LargestShear {
    let depth = maximum_between(0.05, 2.0, shear);
    LargestShear { over_hertz_pressure: shear(depth), depth_over_half_width: smaller * depth }
}

/// Returns ½|σ_x − σ_z| with σ_x = −p_H((1 + 2z²)/√(1 + z²) − 2z), σ_z = −p_H/√(1 + z²).
fn below_line(z: f64) -> f64 {
    z - z * z / (1.0 + z * z).sqrt()
}

fn below_circle(z: f64, poisson: f64) -> f64 {
    let axial = 1.0 / (1.0 + z * z);
    let radial = (1.0 + poisson) * (1.0 - z * (1.0 / z).atan()) - 0.5 * axial;
    0.5 * (axial - radial).abs()
}

/// Returns the shear stress below an ellipse. `ratio` is the smaller over the larger semi-axis, and the depth is in
/// units of the larger one.
fn below_ellipse(ratio: f64, z: f64, poisson: f64) -> f64 {
    let (square, eccentricity) = (ratio * ratio, 1.0 - ratio * ratio);
    let t = ((square + z * z) / (1.0 + z * z)).sqrt();
    // Incomplete elliptic integrals F and E of the angle whose cotangent is z, by Carlson's integrals.
    let (sin, cos_squared) = ((1.0 + z * z).sqrt().recip(), z * z / (1.0 + z * z));
    let delta = 1.0 - eccentricity * sin * sin;
    let first = sin * elliprf(cos_squared, delta, 1.0).unwrap_or(f64::NAN);
    let second = first - eccentricity / 3.0 * sin.powi(3) * elliprd(cos_squared, delta, 1.0).unwrap_or(f64::NAN);
    let (plain, stretched) = (z * (first - second), z * (second / square - first));
    let scale = 2.0 * ratio / eccentricity;
    // Stresses on the axis, where they are principal: along the larger and the smaller semi-axis, and downwards.
    let larger = scale * (0.5 * (t - 1.0) + plain + poisson * (1.0 - t / square + stretched));
    let smaller = scale * (0.5 + 0.5 / t - t / square + stretched + poisson * (t - 1.0 + plain));
    let down = -0.5 * scale * (1.0 - t * t) / t;
    0.5 * (larger.max(smaller).max(down) - larger.min(smaller).min(down))
}

/// Finds the only maximum in the interval by golden-section search.
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

    fn close(shear: LargestShear, stress: f64, depth: f64, within: f64) {
        assert!((shear.over_hertz_pressure - stress).abs() < 1e-3, "{shear:?}, {stress}");
        assert!((shear.depth_over_half_width - depth).abs() < within, "{shear:?}, {depth}");
    }

    #[test]
    fn the_values_of_the_textbooks() {
        close(largest_shear(&OperatingPoint::TABLE_2_1, 0.3), 0.300, 0.786, 5e-4);
        let ball = OperatingPoint { kind: ContactKind::Point, load: 50.0, ..OperatingPoint::TABLE_2_1 };
        close(largest_shear(&ball, 0.3), 0.310, 0.481, 1e-3);
        // Johnson's Table 4.1, by the ratio of the semi-axes.
        for (ratio, stress, depth) in [
            (0.999, 0.310, 0.480),
            (0.8, 0.317, 0.530),
            (0.6, 0.323, 0.590),
            (0.4, 0.325, 0.665),
            (0.2, 0.322, 0.745),
            (0.005, 0.301, 0.786),
        ] {
            close(deepest(1.0, &|z| below_ellipse(ratio, ratio * z, 0.3)), stress, depth, 8e-3);
        }
    }

    #[test]
    fn an_ellipse_does_not_care_how_it_is_turned() {
        let ball = OperatingPoint { kind: ContactKind::Point, load: 50.0, ..OperatingPoint::TABLE_2_1 };
        let [long, short] = [5.0, 0.2].map(|ratio| OperatingPoint { radius_y_m: Some(ratio * ball.radius_m), ..ball });
        let [one, other] = [long, short].map(|point| largest_shear(&point, 0.3));
        assert!((one.over_hertz_pressure / other.over_hertz_pressure - 1.0).abs() < 1e-9, "{one:?} {other:?}");
        let depth = short.ellipse().kappa * one.depth_over_half_width;
        assert!((other.depth_over_half_width / depth - 1.0).abs() < 1e-6, "{one:?} {other:?}");
    }
}
