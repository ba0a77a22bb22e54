//! Interpolation of a nodal field to other abscissae, (4.11).

use serde::{Deserialize, Serialize};

/// Interpolation of a field between the nodes of its grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Interpolation {
    /// Cubic spline with parabolic ends, which suit film thicknesses. Its damping is negligible.
    #[default]
    CubicSpline,
    /// Linear interpolation. It damps fast motions, as the dissertation states.
    Linear,
}

/// Nodal field as a function between its nodes. Keeps its work space.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Interpolated {
    values: Vec<f64>,
    curvature: Vec<f64>,
    #[serde(skip)]
    work: Vec<f64>,
}

impl Interpolated {
    /// Copies another field without allocating, if the capacity suffices.
    pub fn copy_from(&mut self, other: &Self) {
        self.values.clone_from(&other.values);
        self.curvature.clone_from(&other.curvature);
    }

    /// Returns true if the field has the given number of values, all finite.
    pub fn is_of(&self, nodes: usize) -> bool {
        [&self.values, &self.curvature].iter().all(|own| own.len() == nodes && own.iter().all(|v| v.is_finite()))
    }

    /// Sets the values at the increasing nodes `x`.
    pub fn set(&mut self, interpolation: Interpolation, x: &[f64], values: impl Iterator<Item = f64>) {
        self.values.clear();
        self.values.extend(values);
        self.curvature.clear();
        self.curvature.resize(x.len(), 0.0);
        if interpolation == Interpolation::CubicSpline {
            self.bend(x);
        }
    }

    /// Evaluates the field at `stretch` x and passes index and value to `out`; fastest for increasing x. The first
    /// and the last piece are continued beyond the ends of the `nodes`.
    pub fn stretched(
        &self,
        nodes: &[f64],
        stretch: f64,
        x: impl Iterator<Item = f64>,
        mut out: impl FnMut(usize, f64),
    ) {
        let (values, curvature) = (&self.values, &self.curvature);
        let mut piece = 0;
        for (i, x) in x.enumerate() {
            let at = stretch * x;
            while piece > 0 && nodes[piece] > at {
                piece -= 1;
            }
            while piece + 2 < nodes.len() && nodes[piece + 1] < at {
                piece += 1;
            }
            let h = nodes[piece + 1] - nodes[piece];
            let (b, a) = ((at - nodes[piece]) / h, (nodes[piece + 1] - at) / h);
            let bend = (a * a * a - a) * curvature[piece] + (b * b * b - b) * curvature[piece + 1];
            out(i, a * values[piece] + b * values[piece + 1] + bend * h * h / 6.0);
        }
    }

    /// Computes the second derivatives of the spline, which are constant over its first and last piece, by Thomas's
    /// algorithm.
    fn bend(&mut self, x: &[f64]) {
        let (n, values) = (x.len(), &self.values);
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
        // Graded on purpose; the cosine's curvature has zero slope at both ends.
        let x: Vec<f64> = (0..=cells)
            .map(|i| i as f64 / cells as f64)
            .map(|t| std::f64::consts::PI * (t + 0.1 * (std::f64::consts::TAU * t).sin() / std::f64::consts::TAU))
            .collect();
        let values: Vec<f64> = x.iter().map(|x| x.cos()).collect();
        let mut out = vec![0.0; x.len()];
        let mut field = Interpolated::default();
        field.set(interpolation, &x, values.into_iter());
        field.stretched(&x, 0.97, x.iter().copied(), |i, value| out[i] = value);
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
        let mut field = Interpolated::default();
        field.set(Interpolation::CubicSpline, &x, values.into_iter());
        field.stretched(&x, 1.0, x.iter().copied(), |i, value| out[i] = value);
        for (a, b) in out.iter().zip(&values) {
            assert!((a - b).abs() < 1e-14);
        }
    }
}
