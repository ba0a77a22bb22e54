//! Goal-oriented cubature: few rows with non-negative weights that give every Newton *step* what all rows would give it.
//!
//! For each iterate of the all-rows reduced model, three functionals of the Newton step are demanded to come out right (two random ones of Δp̃,
//! and ΔH_c): Σ_i ω_i (T V_i) w_i f_i = T Vᵀ W f with T = L J_r⁻¹, and the same with f replaced by J V Δz̃. Relative weights ω = 1 on all rows
//! solve the equations exactly; a greedy non-negative least squares finds few rows that nearly do, and pruning drops the least useful ones
//! (`NUMERICS` 5.4, 5.6). Only the Gram matrix of the equations is kept, whatever their number.

use super::pod::PodBasis;
use super::sampling::SampledRows;
use crate::solver::grid::FIRST_UNKNOWN;
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{Llt, Solve};
use faer::{Accum, Mat, Par, Side};

/// Rows the forward greedy collects before pruning, relative to the target.
const OVERSHOOT: f64 = 1.5;
/// Ridge on the Gram matrix of unit columns.
const RIDGE: f64 = 1e-12;

/// The equations' columns, accumulated as their Gram matrix AᵀA over the rows of the Reynolds equation.
#[derive(Clone, Debug)]
pub struct GoalEquations {
    gram: Mat<f64>,
    /// Equations collected.
    pub count: usize,
}

impl GoalEquations {
    /// No equations yet, over `rows` candidate rows.
    pub fn new(rows: usize) -> Self {
        Self { gram: Mat::zeros(rows, rows), count: 0 }
    }

    /// Adds equations: one per row of `block`, one column per candidate.
    pub fn add(&mut self, block: &Mat<f64>) {
        matmul(self.gram.as_mut(), Accum::Add, block.transpose(), block.as_ref(), 1.0, Par::Seq);
        self.count += block.nrows();
    }

    /// Adds the equations of another collection over the same rows.
    pub fn merge(&mut self, other: &Self) {
        self.gram += &other.gram;
        self.count += other.count;
    }

    /// Rows and relative weights: at most `target` rows. `None` when the equations are degenerate.
    pub fn solve(&self, target: usize) -> Option<(Vec<usize>, Vec<f64>)> {
        let n = self.gram.nrows();
        // Unit columns; rows that never matter are no candidates. The right-hand side is A·1.
        let norms: Vec<f64> = (0..n).map(|i| self.gram[(i, i)].max(0.0).sqrt()).collect();
        let largest = norms.iter().copied().fold(0.0, f64::max);
        let candidates: Vec<usize> = (0..n).filter(|&i| norms[i] > 1e-9 * largest).collect();
        let unit = |i: usize, j: usize| self.gram[(i, j)] / (norms[i] * norms[j]);
        let wanted: Vec<f64> = (0..n)
            .map(|i| if norms[i] > 0.0 { (0..n).map(|j| self.gram[(i, j)]).sum::<f64>() / norms[i] } else { 0.0 })
            .collect();
        let fit = |support: &[usize]| -> Option<Mat<f64>> {
            let m = support.len();
            let gram = Mat::from_fn(m, m, |r, c| unit(support[r], support[c]) + if r == c { RIDGE } else { 0.0 });
            let rhs = Mat::from_fn(m, 1, |r, _| wanted[support[r]]);
            Llt::new(gram.as_ref(), Side::Lower).ok().map(|llt| llt.solve(&rhs))
        };
        // Non-negative fit on a support: drop the most negative until none is left.
        let positive_fit = |support: &mut Vec<usize>| -> Option<Vec<f64>> {
            loop {
                let w = fit(support)?;
                let worst = (0..support.len()).min_by(|&a, &b| w[(a, 0)].total_cmp(&w[(b, 0)]))?;
                if w[(worst, 0)] > 0.0 {
                    return Some((0..support.len()).map(|k| w[(k, 0)]).collect());
                }
                support.swap_remove(worst);
            }
        };
        let forward = ((target as f64 * OVERSHOOT).ceil() as usize).min(candidates.len());
        let mut support: Vec<usize> = Vec::with_capacity(forward);
        let mut weights: Vec<f64> = Vec::new();
        let mut stalls = 0;
        while support.len() < forward && stalls < 8 {
            let before = support.len();
            let gradient =
                |i: usize| wanted[i] - support.iter().zip(&weights).map(|(&s, w)| unit(i, s) * w).sum::<f64>();
            let mut ranked: Vec<(usize, f64)> = candidates
                .iter()
                .filter(|i| !support.contains(i))
                .map(|&i| (i, gradient(i)))
                .filter(|g| g.1 > 0.0)
                .collect();
            ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
            // Several columns per round at first; one at a time after a stall, which also ends cycling.
            let batch = if stalls > 0 { 1 } else { (forward / 12).clamp(1, forward - before) };
            support.extend(ranked.iter().take(batch).map(|g| g.0));
            weights = positive_fit(&mut support)?;
            if support.len() <= before {
                stalls += 1;
            }
        }
        while support.len() > target {
            let m = support.len();
            let gram = Mat::from_fn(m, m, |r, c| unit(support[r], support[c]) + if r == c { RIDGE } else { 0.0 });
            let inverse = Llt::new(gram.as_ref(), Side::Lower).ok()?.solve(Mat::<f64>::identity(m, m));
            let w: Vec<f64> = (0..m).map(|r| (0..m).map(|c| inverse[(r, c)] * wanted[support[c]]).sum()).collect();
            // What the fit loses without a row is w²/(G⁻¹)ᵢᵢ; rows that want a negative weight go first.
            let value = |k: usize| if w[k] <= 0.0 { w[k] } else { w[k] * w[k] / inverse[(k, k)] };
            let mut order: Vec<usize> = (0..m).collect();
            order.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
            let mut leaving: Vec<usize> = order.into_iter().take(2.min(m - target)).collect();
            leaving.sort_unstable_by(|a, b| b.cmp(a));
            for k in leaving {
                support.swap_remove(k);
            }
        }
        let weights = positive_fit(&mut support)?;
        let mut pairs: Vec<(usize, f64)> = support.iter().zip(&weights).map(|(&i, w)| (i, w / norms[i])).collect();
        pairs.sort_by_key(|p| p.0);
        Some(pairs.into_iter().unzip())
    }
}

/// Fewest rows per mode that are accepted: a rule with fewer leaves the reduced Jacobian (nearly) singular.
const LEAST_ROWS_PER_MODE: f64 = 1.2;

/// Sampled rows with G = V_Iᵀ diag(w ω). `None` when the equations are satisfied by too few rows to carry the modes: collect more of them.
pub fn cubature(basis: &PodBasis, weights: &[f64], equations: &GoalEquations, target: usize) -> Option<SampledRows> {
    let (rows, relative) = equations.solve(target)?;
    if (rows.len() as f64) < LEAST_ROWS_PER_MODE * basis.modes.ncols() as f64 {
        return None;
    }
    let reconstruction = Mat::from_fn(basis.modes.ncols(), rows.len(), |k, r| {
        let node = rows[r] + FIRST_UNKNOWN;
        relative[r] * weights[node] * basis.modes[(node, k)]
    });
    Some(SampledRows { rows, reconstruction })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_an_exact_sparse_rule_where_one_exists() {
        // Integrals of polynomials up to degree 5 over 60 equal cells: few nodes suffice, and the fit must reproduce them.
        let n = 60;
        let x = |i: usize| (i as f64 + 0.5) / n as f64;
        let block = Mat::from_fn(6, n, |degree, i| x(i).powi(degree as i32) / n as f64);
        let mut equations = GoalEquations::new(n);
        equations.add(&block);
        let (rows, weights) = equations.solve(10).unwrap();
        assert!(rows.len() <= 10 && weights.iter().all(|w| *w > 0.0));
        for degree in 0..6 {
            let exact: f64 = (0..n).map(|i| block[(degree, i)]).sum();
            let rule: f64 = rows.iter().zip(&weights).map(|(&i, w)| w * block[(degree, i)]).sum();
            assert!((rule / exact - 1.0).abs() < 1e-4, "degree {degree}: {rule} against {exact}");
        }
    }

    #[test]
    fn collections_merge() {
        let block = Mat::from_fn(2, 5, |r, c| (r * 5 + c) as f64);
        let (mut a, mut b) = (GoalEquations::new(5), GoalEquations::new(5));
        a.add(&block);
        b.add(&block);
        a.merge(&b);
        assert_eq!(a.count, 4);
        assert!((a.gram[(1, 2)] - 2.0 * b.gram[(1, 2)]).abs() < 1e-12);
    }
}
