//! Elastic deformation δ = K P of the half-space under line loads, with pressure P and the logarithmic kernel (2.27).
//!
//! On a uniform grid the flexibility matrix K is Toeplitz, with the exact integral (2.39) of a constant pressure per
//! cell. It is applied by FFT. On a graded grid K is the exact integral of hat functions and is stored as a dense
//! matrix.

use super::convolution::{Convolution, KernelError};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, Par};
use realfft::num_complex::Complex64;
use std::f64::consts::PI;

/// Flexibility matrix K of a grid over node arrays, which include the node outside the inlet.
#[derive(Clone)]
pub enum Flexibility {
    /// Equidistant nodes: one column, applied by fast convolution.
    Toeplitz(Toeplitz),
    /// Arbitrary nodes: the full matrix. Columns of nodes without pressure are zero.
    Dense(Mat<f64>),
}

impl std::fmt::Debug for Flexibility {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Toeplitz(t) => write!(f, "Toeplitz({})", t.column.len()),
            Self::Dense(k) => write!(f, "Dense({}×{})", k.nrows(), k.ncols()),
        }
    }
}

/// Symmetric Toeplitz matrix with its transform.
#[derive(Clone)]
pub struct Toeplitz {
    column: Vec<f64>,
    spectrum: Vec<f64>,
    convolution: Convolution,
}

/// Buffers of the fast convolution. They grow on first use; later calls allocate nothing.
#[derive(Default, Clone, Debug)]
pub struct Scratch {
    real: Vec<f64>,
    complex: Vec<Complex64>,
    work: Vec<Complex64>,
}

impl Flexibility {
    /// Builds the kernel (2.39) of `nodes` equidistant nodes with spacing `h`.
    ///
    /// # Errors
    /// [`KernelError`] if the kernel cannot be transformed.
    pub fn uniform(h: f64, nodes: usize) -> Result<Self, KernelError> {
        let column: Vec<f64> = (0..nodes).map(|d| cell_kernel(d as f64 * h, h)).collect();
        let convolution = Convolution::new(2 * nodes);
        let length = convolution.len();
        let mut circular = vec![0.0; length];
        for (d, &k) in column.iter().enumerate() {
            (circular[d], circular[(length - d) % length]) = (k, k);
        }
        let spectrum = convolution.kernel(&mut circular)?;
        Ok(Self::Toeplitz(Toeplitz { column, spectrum, convolution }))
    }

    /// Builds the kernel of hat functions on the nodes `x`, which include the node outside the inlet. The first two
    /// nodes and the last one carry no pressure.
    pub fn graded(x: &[f64]) -> Self {
        let n = x.len();
        Self::Dense(Mat::from_fn(n, n, |i, j| {
            if j < 2 || j + 1 == n { 0.0 } else { hat_kernel(x[i], x[j - 1], x[j], x[j + 1]) }
        }))
    }

    /// Returns the deformation of node `i` by unit pressure at node `j`.
    #[inline]
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        match self {
            Self::Toeplitz(t) => t.column[i.abs_diff(j)],
            Self::Dense(k) => k[(i, j)],
        }
    }

    /// Computes δ = K P; both slices are node arrays.
    pub fn apply(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut Scratch) {
        match self {
            Self::Toeplitz(t) => t.apply(pressure, deformation, scratch),
            Self::Dense(k) => matmul(
                ColMut::from_slice_mut(deformation).as_mat_mut(),
                Accum::Replace,
                k.as_ref(),
                ColRef::from_slice(pressure).as_mat(),
                1.0,
                Par::Seq,
            ),
        }
    }
}

impl Toeplitz {
    fn apply(&self, input: &[f64], output: &mut [f64], scratch: &mut Scratch) {
        let Scratch { real, complex, work } = scratch;
        real.clear();
        real.extend_from_slice(input);
        real.resize(self.convolution.len(), 0.0);
        complex.resize(self.spectrum.len(), Complex64::default());
        work.resize(self.convolution.work(), Complex64::default());
        self.convolution.forward(real, complex, work);
        for (c, s) in complex.iter_mut().zip(&self.spectrum) {
            *c *= *s;
        }
        self.convolution.inverse(complex, real, work);
        output.copy_from_slice(&real[..output.len()]);
    }
}

/// Returns −(1/π) ∫ ln|x − s| ds over a cell of width h around the origin, (2.39).
fn cell_kernel(x: f64, h: f64) -> f64 {
    let antiderivative = |u: f64| if u == 0.0 { 0.0 } else { u * (u.abs().ln() - 1.0) };
    -(antiderivative(x + 0.5 * h) - antiderivative(x - 0.5 * h)) / PI
}

/// Returns −(1/π) ∫ hat(s) ln|x − s| ds for the hat function on a < b < c.
fn hat_kernel(x: f64, a: f64, b: f64, c: f64) -> f64 {
    let (left, right) = (b - a, c - b);
    let distance = (x - b).abs();
    if distance > 12.0 * left.max(right) {
        // Far from the hat, the second difference below suffers from cancellation. Gauss's rule is exact to rounding
        // there.
        let mut sum = 0.0;
        for (node, weight) in GAUSS_5 {
            let t = 0.5 * (1.0 + node);
            sum +=
                weight * 0.5 * t * (left * (x - (a + t * left)).abs().ln() + right * (x - (c - t * right)).abs().ln());
        }
        return -sum / PI;
    }
    // G'' = ln|u|, so the integral is the second divided difference of G.
    let g = |u: f64| if u == 0.0 { 0.0 } else { u * u * (0.5 * u.abs().ln() - 0.75) };
    let (ga, gb, gc) = (g(x - a), g(x - b), g(x - c));
    -((ga - gb) / left + (gc - gb) / right) / PI
}

const GAUSS_5: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Composite midpoint rule with equal panels.
    fn quadrature(f: impl Fn(f64) -> f64, from: f64, to: f64) -> f64 {
        let n = 400_000;
        let h = (to - from) / n as f64;
        (0..n).map(|i| f(from + (i as f64 + 0.5) * h)).sum::<f64>() * h
    }

    #[test]
    fn kernels_agree_with_quadrature() {
        for x in [0.0, 0.05, 0.3, 4.0] {
            let want = -quadrature(|s| (x - s).abs().max(1e-300).ln(), -0.05, 0.05) / PI;
            assert!((cell_kernel(x, 0.1) - want).abs() < 2e-6, "cell at {x}");
        }
        let hat = |s: f64| if s < 0.1 { s / 0.1 } else { (0.25 - s) / 0.15 };
        for x in [0.0, 0.1, 0.17, 0.25, -0.4, 1.8, 2.2, 9.0] {
            let want = -quadrature(|s| hat(s) * (x - s).abs().max(1e-300).ln(), 0.0, 0.25) / PI;
            let got = hat_kernel(x, 0.0, 0.1, 0.25);
            assert!((got - want).abs() < 2e-6, "hat at {x}: {got} against {want}");
        }
    }

    #[test]
    fn near_and_far_forms_of_the_hat_kernel_meet() {
        // The kernel must be smooth across the switching distance.
        let (inside, outside) = (hat_kernel(0.1 + 1.199, 0.0, 0.1, 0.2), hat_kernel(0.1 + 1.201, 0.0, 0.1, 0.2));
        let slope = -0.1 / (PI * 1.2);
        assert!((outside - inside - 0.002 * slope).abs() < 1e-7);
    }

    #[test]
    fn fast_convolution_is_the_direct_sum() {
        let n = 137;
        let k = Flexibility::uniform(0.03, n).unwrap();
        let p: Vec<f64> = (0..n).map(|i| ((i * 37 % 19) as f64) / 19.0).collect();
        let mut fast = vec![0.0; n];
        k.apply(&p, &mut fast, &mut Scratch::default());
        for (i, fast) in fast.iter().enumerate() {
            let direct: f64 = (0..n).map(|j| k.entry(i, j) * p[j]).sum();
            assert!((fast - direct).abs() < 1e-12);
        }
    }

    #[test]
    fn hertz_pressure_flattens_the_contact() {
        // δ + X²/2 is constant under P = √(1 − X²): the dry contact is flat.
        for spec in [
            crate::solver::discrete::grid::GridSpec::Uniform { dx: 0.005, domain: (-4.0, 2.0) },
            crate::solver::discrete::grid::GridSpec::Graded { nodes: 600, domain: (-8.0, 1.9), registered: false },
        ] {
            let grid = spec.line().unwrap().scaled(1.0);
            let p: Vec<f64> = grid.x.iter().map(|x| (1.0 - x * x).max(0.0).sqrt()).collect();
            let mut d = vec![0.0; p.len()];
            grid.deform(&p, &mut d, &mut Scratch::default());
            let shape = |x: f64| grid.at(&d, x) + 0.5 * x * x;
            for x in [-0.9, -0.5, 0.3, 0.8] {
                assert!((shape(x) - shape(0.0)).abs() < 2e-4, "{spec:?} at {x}");
            }
            // Analytic: δ(0) = (1/2)(ln 2 + 1/2), from −(1/π)∫√(1−s²) ln|s| ds.
            let want = 0.5 * (2f64.ln() + 0.5);
            assert!((shape(0.0) - want).abs() < 2e-4, "{} against {want}", shape(0.0));
        }
    }

    #[test]
    fn a_registered_grid_deforms_as_the_same_nodes_built_directly() {
        let spec =
            crate::solver::discrete::grid::GridSpec::Graded { nodes: 200, domain: (-5.0, 1.9), registered: false };
        let mapped = spec.line().unwrap().scaled(0.8);
        let direct = Flexibility::graded(&mapped.x);
        let p: Vec<f64> = (0..mapped.len())
            .map(|i| if i < 2 || i + 1 == mapped.len() { 0.0 } else { (i as f64).sin().abs() })
            .collect();
        let (mut a, mut b) = (vec![0.0; p.len()], vec![0.0; p.len()]);
        mapped.deform(&p, &mut a, &mut Scratch::default());
        direct.apply(&p, &mut b, &mut Scratch::default());
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() < 1e-11);
        }
    }
}
