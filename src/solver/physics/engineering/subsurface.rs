//! The largest shear stress under a dry Hertzian contact, on the line through its centre.

use crate::solver::physics::contact::{ContactKind, Ellipse, OperatingPoint};
use std::f64::consts::FRAC_PI_2;

/// The largest shear stress under the surface and where it acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LargestShear {
    /// τ_max over the Hertzian pressure p_H.
    pub over_hertz_pressure: f64,
    /// Depth over the half width (line) or the semi-axis along the rolling direction (point) a.
    pub depth_over_half_width: f64,
}

/// The largest shear stress on the axis below a frictionless Hertzian contact. Poisson's ratio counts for a point
/// contact only; Johnson, Contact Mechanics, (4.45) and (3.45), and for an ellipse the point loads of his (3.18) summed
/// over it.
pub fn largest_shear(point: &OperatingPoint, poisson: f64) -> LargestShear {
    match (point.kind, point.ellipse()) {
        (ContactKind::Line, _) => deepest(1.0, &below_line),
        (ContactKind::Point, shape) if shape == Ellipse::CIRCLE => deepest(1.0, &|z| below_circle(z, poisson)),
        (ContactKind::Point, ellipse) => deepest(ellipse.kappa.min(1.0), &|z| below_ellipse(z, ellipse.kappa, poisson)),
    }
}

fn deepest(shorter: f64, shear: &dyn Fn(f64) -> f64) -> LargestShear {
    let depth = maximum_between(0.05 * shorter, 2.0 * shorter, shear);
    LargestShear { over_hertz_pressure: shear(depth), depth_over_half_width: depth }
}

/// ½|σ_x − σ_z| with σ_x = −p_H((1 + 2z²)/√(1 + z²) − 2z), σ_z = −p_H/√(1 + z²).
fn below_line(z: f64) -> f64 {
    z - z * z / (1.0 + z * z).sqrt()
}

fn below_circle(z: f64, poisson: f64) -> f64 {
    let axial = 1.0 / (1.0 + z * z);
    let radial = (1.0 + poisson) * (1.0 - z * (1.0 / z).atan()) - 0.5 * axial;
    0.5 * (axial - radial).abs()
}

/// Nodes of the midpoint rules over the radius and a quarter of the angle.
const QUADRATURE: (usize, usize) = (40, 24);

/// Half the largest difference of the stresses on the axis, which are principal there.
fn below_ellipse(z: f64, kappa: f64, poisson: f64) -> f64 {
    let (radii, angles) = QUADRATURE;
    let mut stress = [0.0; 3];
    for i in 0..radii {
        // With r = R sin t the square root at the pressure's edge is gone: √(1 − r²/R²) r dr = R² cos²t sin t dt; with
        // t = ½π s³ what lies near the axis, where the stress is made, has many nodes.
        let s = (i as f64 + 0.5) / radii as f64;
        let (rho, cosine) = (FRAC_PI_2 * s * s * s).sin_cos();
        let weight = 3.0 * s * s * cosine * cosine * rho;
        for j in 0..angles {
            let (sine, cosine) = (FRAC_PI_2 * (j as f64 + 0.5) / angles as f64).sin_cos();
            let edge = 1.0 / (cosine * cosine + sine * sine / (kappa * kappa)).sqrt();
            let weight = weight * edge * edge;
            let (x, y) = (rho * edge * cosine, rho * edge * sine);
            let r = (x * x + y * y + z * z).sqrt();
            let (cube, sum) = (r * r * r, r + z);
            let along = |s: f64| {
                let lateral = z / cube - 1.0 / (r * sum) + s * s * (r + sum) / (cube * sum * sum);
                (1.0 - 2.0 * poisson) * lateral - 3.0 * s * s * z / (cube * r * r)
            };
            let point = [along(x), along(y), -3.0 * z * z * z / (cube * r * r)];
            stress.iter_mut().zip(point).for_each(|(sum, own)| *sum += weight * own);
        }
    }
    let area = FRAC_PI_2 / radii as f64 / angles as f64;
    let [x, y, z] = stress.map(|sum| area * sum);
    0.5 * (x - z).abs().max((y - z).abs()).max((x - y).abs())
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
    use crate::solver::physics::contact::Quantity;

    #[test]
    fn the_values_of_the_textbooks() {
        let line = largest_shear(&OperatingPoint::TABLE_2_1, 0.3);
        assert!((line.over_hertz_pressure - 0.300).abs() < 5e-4 && (line.depth_over_half_width - 0.786).abs() < 5e-4);
        let ball = OperatingPoint { kind: ContactKind::Point, load: 50.0, ..OperatingPoint::TABLE_2_1 };
        let point = largest_shear(&ball, 0.3);
        assert!((point.over_hertz_pressure - 0.310).abs() < 5e-4, "{point:?}");
        assert!((point.depth_over_half_width - 0.481).abs() < 1e-3, "{point:?}");
    }

    #[test]
    fn an_ellipse_lies_between_circle_and_line_and_does_not_care_how_it_is_turned() {
        for z in [0.2, 0.48, 1.0] {
            assert!((below_ellipse(z, 1.0, 0.3) / below_circle(z, 0.3) - 1.0).abs() < 2e-6, "{z}");
            // Nearer to the surface the largest stress of a line is another one than that of its plane.
            assert!(z < 0.4 || (below_ellipse(z, 12.0, 0.3) / below_line(z) - 1.0).abs() < 6e-2, "{z}");
        }
        let ball = OperatingPoint { kind: ContactKind::Point, load: 50.0, ..OperatingPoint::TABLE_2_1 };
        let [long, short] = [5.0, 0.2].map(|ratio| Quantity::RadiusRatio.at(&ball, ratio));
        let [one, other] = [long, short].map(|point| largest_shear(&point, 0.3));
        assert!((one.over_hertz_pressure / other.over_hertz_pressure - 1.0).abs() < 1e-6, "{one:?} {other:?}");
        assert!((0.300..0.330).contains(&one.over_hertz_pressure), "{one:?}");
        assert!((other.depth_over_half_width / (short.ellipse().kappa * one.depth_over_half_width) - 1.0).abs() < 1e-5);
    }
}
