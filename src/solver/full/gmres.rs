//! GMRES with right preconditioning, the linear solver of the full system. It never forms a dense n × n matrix.

use crate::solver::discrete::grid::dot;

/// Solver with its work space, which is allocated once and reused by every solve.
#[derive(Clone, Debug, Default)]
pub struct Gmres {
    basis: Vec<Vec<f64>>,
    hessenberg: Vec<Vec<f64>>,
    rotations: Vec<(f64, f64)>,
    rhs: Vec<f64>,
    preconditioned: Vec<f64>,
    product: Vec<f64>,
}

/// Result of a linear solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearOutcome {
    /// Number of products with the matrix.
    pub iterations: usize,
    /// Final residual divided by the initial one.
    pub relative_residual: f64,
}

impl Gmres {
    /// Solves A x = b to `tolerance` relative to ‖b‖, within `limit` iterations. `x` receives the solution; the
    /// initial guess is zero.
    ///
    /// `apply(v, out)` sets out = A v, and `precondition(v)` replaces v by M⁻¹ v. `go_on` is called after each
    /// iteration with the number of iterations. If it returns `false`, the solve ends and returns its current
    /// iterate.
    pub fn solve(
        &mut self,
        b: &[f64],
        x: &mut [f64],
        (tolerance, limit): (f64, usize),
        mut apply: impl FnMut(&[f64], &mut [f64]),
        mut precondition: impl FnMut(&mut [f64]),
        mut go_on: impl FnMut(usize) -> bool,
    ) -> LinearOutcome {
        let n = b.len();
        x.fill(0.0);
        self.preconditioned.resize(n, 0.0);
        self.product.resize(n, 0.0);
        while self.basis.len() <= limit {
            self.basis.push(vec![0.0; n]);
            self.hessenberg.push(vec![0.0; limit + 1]);
        }
        self.rotations.clear();
        self.rhs.clear();
        let norm = dot(b, b).sqrt();
        if norm == 0.0 || !norm.is_finite() {
            return LinearOutcome { iterations: 0, relative_residual: if norm == 0.0 { 0.0 } else { f64::NAN } };
        }
        self.rhs.push(norm);
        for (v, b) in self.basis[0].iter_mut().zip(b) {
            *v = b / norm;
        }
        let mut iterations = 0;
        for k in 0..limit {
            self.preconditioned.copy_from_slice(&self.basis[k]);
            precondition(&mut self.preconditioned);
            apply(&self.preconditioned, &mut self.product);
            iterations += 1;
            // Modified Gram–Schmidt.
            let column = &mut self.hessenberg[k];
            for (h, v) in column.iter_mut().zip(&self.basis[..=k]) {
                *h = dot(v, &self.product);
                for (p, v) in self.product.iter_mut().zip(v) {
                    *p -= *h * v;
                }
            }
            let next = dot(&self.product, &self.product).sqrt();
            for (i, &(c, s)) in self.rotations.iter().enumerate() {
                let (a, b) = (column[i], column[i + 1]);
                (column[i], column[i + 1]) = if i < k { (c * a + s * b, c * b - s * a) } else { (a, b) };
            }
            let length = column[k].hypot(next);
            let (c, s) = if length > 0.0 { (column[k] / length, next / length) } else { (1.0, 0.0) };
            column[k] = length;
            self.rotations.push((c, s));
            let r = self.rhs[k];
            self.rhs[k] = c * r;
            self.rhs.push(-s * r);
            let ended = self.rhs[k + 1].abs() <= tolerance * norm || next <= 1e-14 * norm.min(1.0) || !next.is_finite();
            if ended || !go_on(iterations) {
                break;
            }
            for (v, p) in self.basis[k + 1].iter_mut().zip(&self.product) {
                *v = p / next;
            }
        }
        // Back substitution for y, then x = M⁻¹ V y.
        let m = iterations;
        for i in (0..m).rev() {
            let mut sum = self.rhs[i];
            for j in i + 1..m {
                sum -= self.hessenberg[j][i] * self.product[j];
            }
            let pivot = self.hessenberg[i][i];
            // `product` is no longer needed and holds y from here on.
            self.product[i] = if pivot == 0.0 { 0.0 } else { sum / pivot };
        }
        for (k, v) in self.basis[..m].iter().enumerate() {
            let y = self.product[k];
            for (x, v) in x.iter_mut().zip(v) {
                *x += y * v;
            }
        }
        precondition(x);
        LinearOutcome { iterations, relative_residual: self.rhs[m].abs() / norm }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_nonsymmetric_system() {
        let n = 30;
        let entry = |i: usize, j: usize| if i == j { 4.0 } else { ((i * 13 + j * 7) % 5) as f64 / 10.0 };
        let want: Vec<f64> = (0..n).map(|i| (i as f64).sin()).collect();
        let apply = |v: &[f64], out: &mut [f64]| {
            for (i, out) in out.iter_mut().enumerate() {
                *out = (0..n).map(|j| entry(i, j) * v[j]).sum();
            }
        };
        let mut b = vec![0.0; n];
        apply(&want, &mut b);
        let mut x = vec![0.0; n];
        let mut solver = Gmres::default();
        for _ in 0..2 {
            let out = solver.solve(&b, &mut x, (1e-12, 30), apply, |v| v.iter_mut().for_each(|v| *v /= 4.0), |_| true);
            assert!(out.relative_residual < 1e-12 && out.iterations < 30);
            for (got, want) in x.iter().zip(&want) {
                assert!((got - want).abs() < 1e-10);
            }
        }
    }
}
