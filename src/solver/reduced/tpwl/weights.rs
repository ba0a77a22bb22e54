//! Weights of operating points for a state: those of the dissertation, and those of the nearest barycentre.

use faer::Mat;
use serde::{Deserialize, Serialize};

/// Method of combining operating points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Weighting {
    /// Weights such that the barycentre of near points is nearest to the state, with expansions half about the points
    /// and half about the barycentre. Expansions about points on one side of a curved trajectory have an error of one
    /// sign; here the error is of third order.
    #[default]
    DualTaylor,
    /// Exponential weights of all points, (4.29), and interpolation between parameters, (4.27).
    Dissertation,
}

impl Weighting {
    /// Returns the name used in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::DualTaylor => "dual_taylor",
            Self::Dissertation => "dissertation",
        }
    }
}

/// Number of nearest points for a set with one trajectory.
pub const NEAREST: usize = 5;
/// The same for a circular contact. Loads and speeds vary along its trajectory, so that the points of neighbouring times
/// are not enough to enclose a state.
pub const NEAREST_OF_PLANES: usize = 10;
/// Number of nearest points per trajectory for a set with several.
pub const NEAREST_EACH: usize = 2;
/// Weights below this count as zero, section 4.2.
const LEAST_WEIGHT: f64 = 1e-3;
/// Exponent of (4.29).
const SHARPNESS: f64 = 25.0;
/// Penalty on distant points, relative to the squared distance of the barycentre.
const SPREAD: f64 = 1e-3;

/// Operating point with its weight.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Weight {
    /// Index of the operating point.
    pub point: usize,
    /// Weight of the point.
    pub weight: f64,
}

/// Number of partial sums: a single sum would wait for each addition.
const LANES: usize = 8;

/// Returns Σ (aᵢ − cᵢ)(bᵢ − cᵢ) over reduced states of one length.
fn product_about(a: &[f64], b: &[f64], center: &[f64]) -> f64 {
    let ((a, a_end), (b, b_end), (c, c_end)) =
        (a.as_chunks::<LANES>(), b.as_chunks::<LANES>(), center.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for ((a, b), c) in a.iter().zip(b).zip(c) {
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += (a[k] - c[k]) * (b[k] - c[k]);
        }
    }
    let end: f64 = a_end.iter().zip(b_end).zip(c_end).map(|((a, b), c)| (a - c) * (b - c)).sum();
    sums.iter().sum::<f64>() + end
}

/// Returns the squared Euclidean distance of two reduced states.
pub fn square_distance(a: &[f64], b: &[f64]) -> f64 {
    product_about(a, a, b)
}

/// Computes the weights (4.29) from the distances of all points. Weights below 0.001 are omitted; the sum is 1. A
/// point at distance zero has weight 1.
pub fn exponential(distances: &[(usize, f64)], out: &mut Vec<Weight>) {
    out.clear();
    let nearest = distances.iter().fold(f64::INFINITY, |least, (_, d)| least.min(*d));
    let raw = |d: f64| if nearest > 0.0 { (-SHARPNESS * d / nearest).exp() } else { f64::from(u8::from(d == nearest)) };
    let total: f64 = distances.iter().map(|(_, d)| raw(*d)).sum();
    out.extend(distances.iter().map(|&(point, d)| Weight { point, weight: raw(d) / total }));
    out.retain(|w| w.weight >= LEAST_WEIGHT);
    normalise(out);
}

fn normalise(weights: &mut [Weight]) {
    let total: f64 = weights.iter().map(|w| w.weight).sum();
    weights.iter_mut().for_each(|w| w.weight /= total);
}

/// Work space of [`Barycentre::weights`].
#[derive(Debug)]
pub struct Barycentre {
    /// G of all points, and indices of the remaining ones.
    products: Mat<f64>,
    kept: Vec<usize>,
    gram: Mat<f64>,
    solution: Vec<f64>,
}

impl Barycentre {
    /// Allocates the work space for up to `most` points at once.
    pub fn new(most: usize) -> Self {
        Self {
            products: Mat::zeros(most, most),
            kept: Vec::with_capacity(most),
            gram: Mat::zeros(most, most + 1),
            solution: vec![0.0; most],
        }
    }

    /// Computes the weights of `out`'s points for which Σ wᵢ yᵢ is nearest to `state`, with preference for near
    /// points: min ‖y − Σ wᵢ yᵢ‖² + 10⁻³ Σ wᵢ² dᵢ² with Σ wᵢ = 1. Points with negative weights are removed and the
    /// rest solved again. The work space limits the number of points.
    pub fn weights<'a>(&mut self, state: &[f64], point: impl Fn(usize) -> &'a [f64], out: &mut Vec<Weight>) {
        self.set_products(state, &point, out);
        let square = |k: usize| self.products[(k, k)];
        let Some(nearest) = (0..out.len()).min_by(|&a, &b| square(a).total_cmp(&square(b))) else { return };
        let (only, least) = (out[nearest].point, square(nearest));
        while out.len() > 1 && least > 0.0 {
            if !self.solve(out) {
                break;
            }
            // Only the most negative weight is removed at a time. Removing all negative ones could lose a point that
            // a second solve would keep.
            let lowest = (0..out.len()).min_by(|&a, &b| out[a].weight.total_cmp(&out[b].weight));
            match lowest {
                Some(k) if out[k].weight < 0.0 => {
                    out.remove(k);
                    self.kept.remove(k);
                }
                _ => return,
            }
        }
        out.clear();
        out.push(Weight { point: only, weight: 1.0 });
    }

    /// Computes Gᵢⱼ = (yᵢ − y)·(yⱼ − y).
    fn set_products<'a>(&mut self, state: &[f64], point: &impl Fn(usize) -> &'a [f64], points: &[Weight]) {
        self.kept.clear();
        self.kept.extend(0..points.len());
        for (i, own) in points.iter().enumerate() {
            for (j, other) in points[..=i].iter().enumerate() {
                let product = product_about(point(own.point), point(other.point), state);
                (self.products[(i, j)], self.products[(j, i)]) = (product, product);
            }
        }
    }

    /// Solves (G + 10⁻³ diag G) w ∝ 1 for the remaining points; returns false if the matrix is singular.
    fn solve(&mut self, out: &mut [Weight]) -> bool {
        let n = out.len();
        let g = &mut self.gram;
        for (i, &own) in self.kept.iter().enumerate() {
            for (j, &other) in self.kept.iter().enumerate() {
                g[(i, j)] = self.products[(own, other)];
            }
            g[(i, i)] *= 1.0 + SPREAD;
            g[(i, n)] = 1.0;
        }
        // Symmetric and positive definite: elimination needs no pivots.
        for k in 0..n {
            for i in k + 1..n {
                let factor = g[(i, k)] / g[(k, k)];
                for j in k..=n {
                    let above = g[(k, j)];
                    g[(i, j)] -= factor * above;
                }
            }
        }
        for k in (0..n).rev() {
            let known: f64 = (k + 1..n).map(|j| g[(k, j)] * self.solution[j]).sum();
            self.solution[k] = (g[(k, n)] - known) / g[(k, k)];
        }
        let total: f64 = self.solution[..n].iter().sum();
        out.iter_mut().zip(&self.solution).for_each(|(w, s)| w.weight = s / total);
        out.iter().all(|w| w.weight.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 5.0]];

    fn barycentric(state: [f64; 2], points: &[usize]) -> Vec<Weight> {
        let mut out: Vec<Weight> = points.iter().map(|&point| Weight { point, weight: 0.0 }).collect();
        Barycentre::new(4).weights(&state, |point| &POINTS[point], &mut out);
        out
    }

    fn sum(weights: &[Weight]) -> f64 {
        weights.iter().map(|w| w.weight).sum()
    }

    #[test]
    fn the_barycentre_lies_beside_a_state_among_the_points() {
        let weights = barycentric([0.3, 0.2], &[0, 1, 2]);
        assert!((sum(&weights) - 1.0).abs() < 1e-14);
        for (axis, want) in [0.3, 0.2].into_iter().enumerate() {
            let got: f64 = weights.iter().map(|w| w.weight * POINTS[w.point][axis]).sum();
            assert!((got - want).abs() < 2e-3, "{weights:?}");
        }
    }

    #[test]
    fn points_of_negative_weight_are_left_out() {
        let weights = barycentric([0.5, -0.5], &[0, 1, 2, 3]);
        assert!(weights.iter().all(|w| w.weight >= 0.0 && w.point < 2), "{weights:?}");
        assert!((weights[0].weight - 0.5).abs() < 1e-12);
    }

    #[test]
    fn a_point_met_exactly_has_all_the_weight() {
        assert_eq!(barycentric([1.0, 0.0], &[0, 1, 2]), [Weight { point: 1, weight: 1.0 }]);
        let mut out = Vec::new();
        exponential(&[(4, 0.3), (7, 0.0), (9, 0.1)], &mut out);
        assert_eq!(out, [Weight { point: 7, weight: 1.0 }]);
    }

    #[test]
    fn exponential_weights_are_those_of_4_29() {
        let mut out = Vec::new();
        exponential(&[(0, 1.0), (1, 1.1), (2, 1.5)], &mut out);
        // e^(−25) : e^(−27.5); the third, e^(−12.5) of the first, falls under 0.001.
        assert_eq!(out.len(), 2);
        assert!((out[1].weight / out[0].weight - (-2.5f64).exp()).abs() < 1e-12);
        assert!((sum(&out) - 1.0).abs() < 1e-14);
    }
}
