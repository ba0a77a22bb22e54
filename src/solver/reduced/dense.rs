//! Products and solutions of dense matrices on one thread, so that results do not depend on the number of threads.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::linalg::matmul::matmul;
use faer::perm::PermRef;
use faer::{Accum, ColMut, ColRef, Mat, MatMut, MatRef, Par, Spec};

/// Returns A B.
pub(crate) fn product(a: MatRef<'_, f64>, b: MatRef<'_, f64>) -> Mat<f64> {
    let mut out = Mat::zeros(a.nrows(), b.ncols());
    matmul(out.as_mut(), Accum::Replace, a, b, 1.0, Par::Seq);
    out
}

/// Computes out = A x.
pub(crate) fn times(a: MatRef<'_, f64>, x: &[f64], out: &mut [f64]) {
    let (out, x) = (ColMut::from_slice_mut(out), ColRef::from_slice(x));
    matmul(out.as_mat_mut(), Accum::Replace, a, x.as_mat(), 1.0, Par::Seq);
}

/// Returns xᵀ A x.
pub(crate) fn quadratic_form(a: MatRef<'_, f64>, x: &[f64]) -> f64 {
    let columns = a.col_iter().zip(x);
    columns.map(|(column, factor)| factor * column.iter().zip(x).map(|(a, x)| a * x).sum::<f64>()).sum()
}

/// Returns A⁻¹ B by an LU factorisation with partial pivoting; not finite if A is singular.
pub(crate) fn solved(a: MatRef<'_, f64>, mut b: Mat<f64>) -> Mat<f64> {
    let size = a.nrows();
    let scratch = factor::lu_in_place_scratch::<usize, f64>(size, size, Par::Seq, Spec::default());
    let scratch = scratch.or(solve::solve_in_place_scratch::<usize, f64>(size, b.ncols(), Par::Seq));
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    let (mut lu, mut forward, mut backward) = (a.to_owned(), vec![0usize; size], vec![0; size]);
    let (_, order) = factor::lu_in_place(lu.as_mut(), &mut forward, &mut backward, Par::Seq, stack, Spec::default());
    solve::solve_in_place(lu.as_ref(), lu.as_ref(), order, b.as_mut(), Par::Seq, stack);
    b
}

/// Small square system with one right-hand side and all work space. Solving it allocates nothing.
pub(crate) struct SmallSystem {
    /// Matrix; its factors after a solve.
    pub matrix: Mat<f64>,
    /// Right-hand side; the solution after a solve, not finite if the matrix is singular.
    pub rhs: Vec<f64>,
    perm: Vec<usize>,
    perm_inverse: Vec<usize>,
    memory: MemBuffer,
}

impl SmallSystem {
    /// Allocates the work space for `len` equations.
    pub fn new(len: usize) -> Self {
        let memory = factor::lu_in_place_scratch::<usize, f64>(len, len, Par::Seq, Spec::default())
            .or(solve::solve_in_place_scratch::<usize, f64>(len, 1, Par::Seq));
        Self {
            matrix: Mat::zeros(len, len),
            rhs: vec![0.0; len],
            perm: vec![0; len],
            perm_inverse: vec![0; len],
            memory: MemBuffer::new(memory),
        }
    }

    /// Solves the system by an LU factorisation with partial pivoting.
    pub fn solve(&mut self) {
        let stack = MemStack::new(&mut self.memory);
        let (matrix, perms) = (self.matrix.as_mut(), (&mut self.perm, &mut self.perm_inverse));
        let (_, perm) = factor::lu_in_place(matrix, perms.0, perms.1, Par::Seq, stack, Spec::default());
        let lu = self.matrix.as_ref();
        let rhs = MatMut::from_column_major_slice_mut(&mut self.rhs, lu.nrows(), 1);
        solve::solve_in_place(lu, lu, perm, rhs, Par::Seq, stack);
    }

    /// Solves the system for another right-hand side with the factors of the last [`Self::solve`].
    pub fn solve_again(&mut self) {
        let (lu, stack) = (self.matrix.as_ref(), MemStack::new(&mut self.memory));
        let perm = PermRef::new_checked(&self.perm, &self.perm_inverse, lu.nrows());
        let rhs = MatMut::from_column_major_slice_mut(&mut self.rhs, lu.nrows(), 1);
        solve::solve_in_place(lu, lu, perm, rhs, Par::Seq, stack);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_solved_solves_and_no_number_of_threads_changes_a_bit() {
        // Beyond the sizes from which factorisations and products would use several threads.
        let size = 200;
        let entry =
            |i: usize, j: usize| ((i * 37 + j * 91 + i * j) % 101) as f64 / 101.0 + if i == j { 20.0 } else { 0.0 };
        let a = Mat::from_fn(size, size, entry);
        let b = Mat::from_fn(size, 5, |i, j| (i as f64 * 0.3 + j as f64).sin());
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| (solved(a.as_ref(), b.clone()), product(a.as_ref(), a.as_ref())))
        };
        let [(x, square), (other_x, other_square)] = [1, 3].map(on);
        assert!(x == other_x && square == other_square);
        assert!((product(a.as_ref(), x.as_ref()) - &b).norm_max() < 1e-12);
        let column: Vec<f64> = b.col(1).iter().copied().collect();
        let bent = product(a.as_ref(), b.as_ref());
        let form: f64 = bent.col(1).iter().zip(&column).map(|(a, b)| a * b).sum();
        assert!((quadratic_form(a.as_ref(), &column) / form - 1.0).abs() < 1e-12);
    }
}
