//! Carrying a nodal field over to other abscissae, the interpolation of (4.11).

use serde::{Deserialize, Serialize};

/// How a field is interpolated between the nodes of its grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Interpolation {
    /// Cubic spline with parabolic ends, as a film has them: hardly damps.
    #[default]
    CubicSpline,
    /// Straight lines: damps the faster motions, as the dissertation warns.
    Linear,
}

/// Interpolates on fixed nodes; keeps its work space.
#[derive(Clone, Debug, Default)]
pub struct Interpolator {
    curvature: Vec<f64>,
    work: Vec<f64>,
}

impl Interpolator {
    /// Values of the field at `stretch` x for all nodes x, in order; x increase. Beyond the ends the last piece continues.
    pub fn stretched(
        &mut self,
        interpolation: Interpolation,
        x: &[f64],
        values: &[f64],
        stretch: f64,
        out: &mut [f64],
    ) {
        match interpolation {
            Interpolation::CubicSpline => self.fit(x, values),
            Interpolation::Linear => {
                self.curvature.clear();
                self.curvature.resize(x.len(), 0.0);
            }
        }
        let mut piece = 0;
        for (out, x_new) in out.iter_mut().zip(x) {
            let at = stretch * x_new;
            while piece + 2 < x.len() && x[piece + 1] < at {
                piece += 1;
            }
            let h = x[piece + 1] - x[piece];
            let (b, a) = ((at - x[piece]) / h, (x[piece + 1] - at) / h);
            let bend = (a * a * a - a) * self.curvature[piece] + (b * b * b - b) * self.curvature[piece + 1];
            *out = a * values[piece] + b * values[piece + 1] + bend * h * h / 6.0;
        }
    }

    /// Second derivatives of the spline, constant over its first and last piece: Thomas' algorithm on a tridiagonal system.
    fn fit(&mut self, x: &[f64], values: &[f64]) {
        let n = x.len();
        self.curvature.clear();
        self.curvature.resize(n, 0.0);
        self.work.clear();
        self.work.resize(n, 0.0);
        self.work[0] = 1.0;
        for i in 1..n - 1 {
            let (west, east) = (x[i] - x[i - 1], x[i + 1] - x[i]);
            let share = west / (west + east);
            let pivot = share * self.work[i - 1] + 2.0;
            self.work[i] = (share - 1.0) / pivot;
            let jump = (values[i + 1] - values[i]) / east - (values[i] - values[i - 1]) / west;
            self.curvature[i] = (6.0 * jump / (west + east) - share * self.curvature[i - 1]) / pivot;
        }
        self.curvature[n - 1] = self.curvature[n - 2] / (1.0 - self.work[n - 2]);
        for i in (0..n - 1).rev() {
            self.curvature[i] += self.work[i] * self.curvature[i + 1];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(interpolation: Interpolation, cells: usize) -> f64 {
        // Graded on purpose; the cosine's curvature is level at both ends.
        let x: Vec<f64> = (0..=cells)
            .map(|i| i as f64 / cells as f64)
            .map(|t| std::f64::consts::PI * (t + 0.1 * (std::f64::consts::TAU * t).sin() / std::f64::consts::TAU))
            .collect();
        let values: Vec<f64> = x.iter().map(|x| x.cos()).collect();
        let mut out = vec![0.0; x.len()];
        Interpolator::default().stretched(interpolation, &x, &values, 0.97, &mut out);
        x.iter().zip(&out).map(|(x, v)| (v - (0.97 * x).cos()).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn splines_converge_with_fourth_and_lines_with_second_order() {
        for (interpolation, order) in [(Interpolation::CubicSpline, 4.0), (Interpolation::Linear, 2.0)] {
            let seen = (error(interpolation, 40) / error(interpolation, 160)).log2() / 2.0;
            assert!((seen - order).abs() < 0.4, "{interpolation:?}: {seen}");
        }
    }

    #[test]
    fn a_stretch_by_one_changes_nothing() {
        let (x, values) = ([0.0, 0.3, 1.0, 1.2, 2.0], [1.0, -2.0, 0.5, 0.25, 3.0]);
        let mut out = [0.0; 5];
        Interpolator::default().stretched(Interpolation::CubicSpline, &x, &values, 1.0, &mut out);
        for (a, b) in out.iter().zip(&values) {
            assert!((a - b).abs() < 1e-14);
        }
    }
}
