//! Online step of residual minimisation, (2.69): least squares of more equations than unknowns, by QR. An iteration
//! allocates nothing.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::qr::no_pivoting::factor::{qr_in_place, qr_in_place_scratch, recommended_block_size};
use faer::linalg::qr::no_pivoting::solve::{solve_lstsq_in_place, solve_lstsq_in_place_scratch};
use faer::{Mat, MatMut, Par, Spec};

/// Overdetermined equations with all work space.
pub(super) struct LeastSquares {
    /// Matrix, equations × unknowns; overwritten by a solve.
    pub matrix: Mat<f64>,
    /// Right-hand side; after a solve its first entries are the solution, not finite if the columns are dependent.
    pub rhs: Vec<f64>,
    coefficients: Mat<f64>,
    memory: MemBuffer,
}

impl LeastSquares {
    /// Allocates the work space for the given numbers of equations and unknowns.
    pub fn new(equations: usize, unknowns: usize) -> Self {
        let block = recommended_block_size::<f64>(equations, unknowns);
        let factor = qr_in_place_scratch::<f64>(equations, unknowns, block, Par::Seq, Spec::default());
        let solve = solve_lstsq_in_place_scratch::<f64>(equations, unknowns, block, 1, Par::Seq);
        Self {
            matrix: Mat::zeros(equations, unknowns),
            rhs: vec![0.0; equations],
            coefficients: Mat::zeros(block, unknowns.min(equations)),
            memory: MemBuffer::new(factor.or(solve)),
        }
    }

    /// Solves the equations.
    pub fn solve(&mut self) {
        let Self { matrix, rhs, coefficients, memory } = self;
        let stack = MemStack::new(memory);
        qr_in_place(matrix.as_mut(), coefficients.as_mut(), Par::Seq, stack, Spec::default());
        let (factors, equations) = (matrix.as_ref(), matrix.nrows());
        let rhs = MatMut::from_column_major_slice_mut(rhs, equations, 1);
        solve_lstsq_in_place(factors, coefficients.as_ref(), factors, rhs, Par::Seq, stack);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_is_orthogonal_to_every_column() {
        let (equations, unknowns) = (60, 17);
        let entry = |i: usize, j: usize| ((i * 37 + j * 91 + i * j) % 101) as f64 / 101.0 - 0.3;
        let mut system = LeastSquares::new(equations, unknowns);
        let right = |i: usize| (i as f64 * 0.7).sin();
        for _ in 0..2 {
            system.matrix = Mat::from_fn(equations, unknowns, entry);
            system.rhs = (0..equations).map(right).collect();
            system.solve();
        }
        let rest = |i: usize| right(i) - (0..unknowns).map(|j| entry(i, j) * system.rhs[j]).sum::<f64>();
        for j in 0..unknowns {
            let product: f64 = (0..equations).map(|i| entry(i, j) * rest(i)).sum();
            assert!(product.abs() < 1e-12, "column {j}: {product:e}");
        }
    }
}
