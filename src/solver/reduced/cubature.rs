//! Goal-oriented cubature: few rows with non-negative weights for which every Newton *step* is nearly the one of all
//! rows.
//!
//! For each iterate of the reduced model with all rows, some functionals of the Newton step must be reproduced (random
//! ones of Δp̃, and ΔH_c, the changes of pressure coefficients and central film thickness): Σ_i ω_i (T V_i) w_i f_i = T
//! Vᵀ W f with T = L J_r⁻¹, and the same with f replaced by J V Δz̃. Symbols: residual f, Jacobian J, reduced Jacobian
//! J_r, modes V, quadrature weights w, functionals L. Relative weights ω = 1 on all rows solve the equations exactly. A
//! greedy non-negative least squares finds few rows that nearly solve them, and pruning removes the least useful ones.
//!
//! A point contact has thousands of equations with thousands of rows. They are stored in single precision, and inner
//! products are computed only for rows that the greedy algorithm has visited.

use super::sampling::{SampledRows, TestSpace};
use faer::linalg::matmul::matmul;
use faer::linalg::solvers::{Llt, Solve};
use faer::{Accum, Mat, Par, Side};

/// Number of rows of the forward greedy before pruning, relative to the target.
const OVERSHOOT: f64 = 2.0;
/// Ridge on the inner products of unit columns.
const RIDGE: f64 = 1e-12;
/// Rows with test functions √w ‖V_i‖ below this are no candidates, since they do not matter.
const LEAST_TEST: f64 = 3e-4;
/// Maximum number of rounds per row of [`GoalEquations::fit`], and relative gradient at which it ends.
const ROUNDS: usize = 20;
const CLOSE: f64 = 1e-9;
/// Number of rounds without growth after which the greedy ends.
const STALLS: usize = 8;

/// Equations that a cubature rule should satisfy, one column per candidate row.
#[derive(Clone, Debug, PartialEq)]
pub struct GoalEquations {
    /// Rows that may be sampled, ascending.
    candidates: Vec<usize>,
    /// Coefficients, equation by equation.
    entries: Vec<f32>,
    /// Value of all rows together, one per equation.
    wanted: Vec<f64>,
}

impl GoalEquations {
    /// Creates an empty collection over the given candidate rows.
    pub fn new(candidates: Vec<usize>) -> Self {
        Self { candidates, entries: Vec::new(), wanted: Vec::new() }
    }

    /// Creates an empty collection over the rows of a test space that matter.
    pub fn over(test: &TestSpace) -> Self {
        let matters = |&row: &usize| {
            let square: f64 = test.modes.row(row).iter().map(|v| v * v).sum();
            (test.weights[row] * square).sqrt() > LEAST_TEST
        };
        Self::new((0..test.weights.len()).filter(matters).collect())
    }

    /// Returns the candidate rows.
    pub fn candidates(&self) -> &[usize] {
        &self.candidates
    }

    /// Returns the number of equations.
    pub fn count(&self) -> usize {
        self.wanted.len()
    }

    /// Adds an equation, given its coefficient at every row.
    pub fn add(&mut self, coefficients: impl Fn(usize) -> f64, rows: usize) {
        self.wanted.push((0..rows).map(&coefficients).sum());
        self.entries.extend(self.candidates.iter().map(|&row| coefficients(row) as f32));
    }

    /// Adds the equations of another collection over the same rows.
    pub fn merge(&mut self, other: &Self) {
        self.entries.extend_from_slice(&other.entries);
        self.wanted.extend_from_slice(&other.wanted);
    }

    /// Returns at most `target` rows and their relative weights. `None` if the equations are degenerate.
    pub fn solve(&self, target: usize) -> Option<(Vec<usize>, Vec<f64>)> {
        let mut fit = Fit::new(self);
        let forward = ((target as f64 * OVERSHOOT).ceil() as usize).min(fit.useful());
        let mut support: Vec<usize> = Vec::with_capacity(forward);
        let mut weights: Vec<f64> = Vec::new();
        let mut stalls = 0;
        while support.len() < forward && stalls < STALLS {
            let before = support.len();
            let gradient = fit.gradient(&support, &weights);
            let mut ranked: Vec<usize> = (0..gradient.len()).filter(|&i| gradient[i] > 0.0).collect();
            ranked.sort_by(|&a, &b| gradient[b].total_cmp(&gradient[a]));
            // Several columns per round at first; one at a time after a stall, which also ends cycles.
            let batch = if stalls > 0 { 1 } else { (forward / 12).clamp(1, forward - before) };
            let further = ranked.into_iter().filter(|i| !support.contains(i)).take(batch);
            let further: Vec<usize> = further.collect();
            support.extend(further);
            fit.look_at(&support);
            weights = fit.non_negative(&mut support)?;
            if support.len() <= before {
                stalls += 1;
            }
        }
        while support.len() > target {
            fit.prune(&mut support, target)?;
        }
        let weights = fit.non_negative(&mut support)?;
        Some(fit.rule(&support, &weights))
    }

    /// Returns at most `most` rows and their relative weights by the non-negative least squares of Lawson and Hanson
    /// (1974, chapter 23), whose residual decreases with every row. Suitable for equations that can be met closely
    /// and whose neighbouring columns hardly differ. `None` if the equations are degenerate.
    pub fn fit(&self, most: usize) -> Option<(Vec<usize>, Vec<f64>)> {
        let mut fit = Fit::new(self);
        let mut support: Vec<usize> = Vec::with_capacity(most);
        let mut weights: Vec<f64> = Vec::with_capacity(most);
        let mut refused = vec![false; self.candidates.len()];
        let wanted = self.wanted.iter().map(|v| v * v).sum::<f64>().sqrt();
        // Each round ends with a smaller residual, or excludes a row that would not stay.
        for _ in 0..ROUNDS * most {
            if support.len() == most {
                break;
            }
            let gradient = fit.gradient(&support, &weights);
            let free = (0..gradient.len()).filter(|i| !refused[*i] && !support.contains(i));
            let Some(next) = free.max_by(|&a, &b| gradient[a].total_cmp(&gradient[b])) else { break };
            if gradient[next] <= CLOSE * wanted {
                break;
            }
            support.push(next);
            weights.push(0.0);
            fit.look_at(&support);
            loop {
                let fitted = fit.free(&support)?;
                if fitted.iter().all(|w| *w > 0.0) {
                    weights = fitted;
                    refused.fill(false);
                    break;
                }
                // The step ends where the first weight becomes zero; rows with zero weight leave.
                let steps =
                    weights.iter().zip(&fitted).filter(|(_, to)| **to <= 0.0).map(|(from, to)| from / (from - to));
                let share = steps.fold(1.0, f64::min);
                weights.iter_mut().zip(&fitted).for_each(|(from, to)| *from += share * (to - *from));
                let stays: Vec<bool> = weights.iter().zip(&fitted).map(|(w, to)| *to > 0.0 || *w > 1e-12).collect();
                refused[next] |= support.iter().zip(&stays).any(|(row, stays)| *row == next && !stays);
                let mut kept = stays.iter().copied();
                support.retain(|_| kept.next().unwrap_or(false));
                let mut kept = stays.iter().copied();
                weights.retain(|_| kept.next().unwrap_or(false));
            }
        }
        Some(fit.rule(&support, &weights))
    }
}

/// Least squares with the columns of the equations, scaled to unit length. Columns are identified by their index
/// among the candidates.
struct Fit<'a> {
    equations: &'a GoalEquations,
    /// Lengths of the columns.
    norms: Vec<f64>,
    /// Columns visited so far, and the index of each column among them.
    seen: Vec<usize>,
    place: Vec<Option<usize>>,
    /// Visited unit columns, their inner products, and those with the right-hand side.
    columns: Mat<f64>,
    gram: Mat<f64>,
    right: Vec<f64>,
}

impl<'a> Fit<'a> {
    fn new(equations: &'a GoalEquations) -> Self {
        let n = equations.candidates.len();
        let mut norms = vec![0.0; n];
        for equation in equations.entries.chunks_exact(n.max(1)) {
            norms.iter_mut().zip(equation).for_each(|(norm, &a)| *norm += f64::from(a) * f64::from(a));
        }
        norms.iter_mut().for_each(|norm| *norm = norm.sqrt());
        let (columns, gram) = (Mat::zeros(equations.count(), 0), Mat::zeros(0, 0));
        Self { equations, norms, seen: Vec::new(), place: vec![None; n], columns, gram, right: Vec::new() }
    }

    /// Returns rows, ascending, and relative weights of a fit.
    fn rule(&self, support: &[usize], weights: &[f64]) -> (Vec<usize>, Vec<f64>) {
        let rule = support.iter().zip(weights).map(|(&i, w)| (self.equations.candidates[i], w / self.norms[i]));
        let mut pairs: Vec<(usize, f64)> = rule.collect();
        pairs.sort_by_key(|p| p.0);
        pairs.into_iter().unzip()
    }

    /// Returns true if a column may be used; columns of negligible length may not.
    fn usable(&self, i: usize, largest: f64) -> bool {
        self.norms[i] > 1e-9 * largest
    }

    fn largest(&self) -> f64 {
        self.norms.iter().copied().fold(0.0, f64::max)
    }

    /// Returns the number of usable columns.
    fn useful(&self) -> usize {
        let largest = self.largest();
        (0..self.norms.len()).filter(|&i| self.usable(i, largest)).count()
    }

    /// Returns the inner product of every unit column with the residual of a rule; 0 for unusable columns.
    fn gradient(&self, support: &[usize], weights: &[f64]) -> Vec<f64> {
        let GoalEquations { candidates, entries, wanted } = self.equations;
        let mut rest = wanted.clone();
        for (i, weight) in support.iter().zip(weights) {
            if let Some(place) = self.place[*i] {
                rest.iter_mut().zip(self.columns.col(place).iter()).for_each(|(r, a)| *r -= weight * a);
            }
        }
        let mut gradient = vec![0.0; candidates.len()];
        for (equation, rest) in entries.chunks_exact(candidates.len().max(1)).zip(&rest) {
            gradient.iter_mut().zip(equation).for_each(|(g, &a)| *g += rest * f64::from(a));
        }
        let largest = self.largest();
        for (i, g) in gradient.iter_mut().enumerate() {
            *g = if self.usable(i, largest) { *g / self.norms[i] } else { 0.0 };
        }
        gradient
    }

    /// Computes the inner products of columns that were not visited before.
    fn look_at(&mut self, columns: &[usize]) {
        let fresh: Vec<usize> = columns.iter().copied().filter(|&i| self.place[i].is_none()).collect();
        let (rows, known, n) = (self.equations.count(), self.seen.len(), self.equations.candidates.len());
        for &i in &fresh {
            self.place[i] = Some(self.seen.len());
            self.seen.push(i);
        }
        let (seen, entries, norms) = (&self.seen, &self.equations.entries, &self.norms);
        self.columns.resize_with(rows, seen.len(), |e, c| f64::from(entries[e * n + seen[c]]) / norms[seen[c]]);
        let new = self.columns.get(.., known..);
        let mut products = Mat::zeros(seen.len(), fresh.len());
        matmul(products.as_mut(), Accum::Replace, self.columns.transpose(), new, 1.0, Par::Seq);
        let column = |r: usize, c: usize| if c >= known { products[(r, c - known)] } else { products[(c, r - known)] };
        self.gram.resize_with(seen.len(), seen.len(), column);
        let wanted = &self.equations.wanted;
        self.right.extend(new.col_iter().map(|column| column.iter().zip(wanted).map(|(a, b)| a * b).sum::<f64>()));
    }

    /// Returns the inner products and the right-hand side of a support.
    fn normal_equations(&self, support: &[usize]) -> Option<(Mat<f64>, Mat<f64>)> {
        let places: Vec<usize> = support.iter().map(|&i| self.place[i]).collect::<Option<_>>()?;
        let m = places.len();
        let ridge = |r: usize, c: usize| if r == c { RIDGE } else { 0.0 };
        let gram = Mat::from_fn(m, m, |r, c| self.gram[(places[r], places[c])] + ridge(r, c));
        Some((gram, Mat::from_fn(m, 1, |r, _| self.right[places[r]])))
    }

    /// Fits weights of any sign on a support.
    fn free(&self, support: &[usize]) -> Option<Vec<f64>> {
        let (gram, right) = self.normal_equations(support)?;
        let w = Llt::new(gram.as_ref(), Side::Lower).ok()?.solve(&right);
        Some((0..support.len()).map(|k| w[(k, 0)]).collect())
    }

    /// Fits non-negative weights on a support: removes the most negative one until none is left.
    fn non_negative(&self, support: &mut Vec<usize>) -> Option<Vec<f64>> {
        loop {
            let w = self.free(support)?;
            let worst = (0..support.len()).min_by(|&a, &b| w[a].total_cmp(&w[b]))?;
            if w[worst] > 0.0 {
                return Some(w);
            }
            support.swap_remove(worst);
        }
    }

    /// Removes the one or two rows with the smallest loss.
    fn prune(&self, support: &mut Vec<usize>, target: usize) -> Option<()> {
        let (gram, right) = self.normal_equations(support)?;
        let m = support.len();
        let inverse = Llt::new(gram.as_ref(), Side::Lower).ok()?.solve(Mat::<f64>::identity(m, m));
        let w: Vec<f64> = (0..m).map(|r| (0..m).map(|c| inverse[(r, c)] * right[(c, 0)]).sum()).collect();
        // The loss of the fit without a row is w²/(G⁻¹)ᵢᵢ. Rows with negative weights are removed first.
        let value = |k: usize| if w[k] <= 0.0 { w[k] } else { w[k] * w[k] / inverse[(k, k)] };
        let mut order: Vec<usize> = (0..m).collect();
        order.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
        let mut leaving: Vec<usize> = order.into_iter().take(2.min(m - target)).collect();
        leaving.sort_unstable_by(|a, b| b.cmp(a));
        for k in leaving {
            support.swap_remove(k);
        }
        Some(())
    }
}

/// Minimum number of rows per mode. With fewer, the reduced Jacobian is (nearly) singular.
const LEAST_ROWS_PER_MODE: f64 = 1.2;
/// Share of the target below which pruning has removed too many rows: thermal lines, transient contacts and sliding
/// circular contacts solved cold need more.
const LEAST_SHARE: f64 = 0.85;

/// Returns sampled equations with G = V_Iᵀ diag(w ω), at most `target` of them. If pruning leaves far fewer, the
/// closer fit is used instead, if it has more. `None` if the equations are satisfied by too few rows for the modes:
/// more equations are then needed.
pub fn cubature(test: &TestSpace, equations: &GoalEquations, target: usize) -> Option<SampledRows> {
    let modes = test.modes.ncols();
    let least = (LEAST_ROWS_PER_MODE * modes as f64).ceil() as usize;
    let few = ((LEAST_SHARE * target as f64) as usize).max(least);
    let solved = equations.solve(target);
    let of = |count: usize| move |(rows, _): &(Vec<usize>, Vec<f64>)| rows.len() >= count;
    // Pruning can remove neighbouring rows together if their columns hardly differ; the closer fit keeps one of them.
    let closer = if solved.as_ref().is_some_and(of(few)) { None } else { equations.fit(target) };
    let (rows, relative) = closer.filter(of(few)).or(solved.filter(of(least)))?;
    let reconstruction =
        Mat::from_fn(modes, rows.len(), |k, r| relative[r] * test.weights[rows[r]] * test.modes[(rows[r], k)]);
    Some(SampledRows::tested(rows, reconstruction))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_an_exact_sparse_rule_where_one_exists() {
        // Integrals of polynomials up to degree 5 over 60 equal cells: few nodes suffice, and the fit must reproduce
        // them.
        let n = 60;
        let x = |i: usize| (i as f64 + 0.5) / n as f64;
        let block = Mat::from_fn(6, n, |degree, i| x(i).powi(degree as i32) / n as f64);
        let mut equations = GoalEquations::new((0..n).collect());
        (0..6).for_each(|degree| equations.add(|i| block[(degree, i)], n));
        let (rows, weights) = equations.solve(10).unwrap();
        assert!(rows.len() <= 10 && weights.iter().all(|w| *w > 0.0));
        for degree in 0..6 {
            let exact: f64 = (0..n).map(|i| block[(degree, i)]).sum();
            let rule: f64 = rows.iter().zip(&weights).map(|(&i, w)| w * block[(degree, i)]).sum();
            assert!((rule / exact - 1.0).abs() < 1e-4, "degree {degree}: {rule} against {exact}");
        }
    }

    #[test]
    fn a_close_fit_meets_smooth_equations_with_few_rows() {
        // Moving bumps: neighbouring columns hardly differ, and the rule must hold for bumps it was not fitted to.
        let n = 400;
        let bump = |centre: f64, i: usize| (-((i as f64 / n as f64 - centre) * 8.0).powi(2)).exp();
        let mut equations = GoalEquations::new((0..n).collect());
        for k in 0..120 {
            let centre = 0.3 + 0.4 * f64::from(k) / 119.0;
            let whole: f64 = (0..n).map(|i| bump(centre, i)).sum();
            equations.add(|i| bump(centre, i) / whole, n);
        }
        let (rows, weights) = equations.fit(24).unwrap();
        assert!(rows.len() <= 24 && weights.iter().all(|w| *w > 0.0));
        for k in 0..50 {
            let centre = 0.305 + 0.39 * f64::from(k) / 49.0;
            let whole: f64 = (0..n).map(|i| bump(centre, i)).sum();
            let rule: f64 = rows.iter().zip(&weights).map(|(&i, w)| w * bump(centre, i)).sum();
            assert!((rule / whole - 1.0).abs() < 1e-4, "centre {centre}: {rule} against {whole}");
        }
    }

    #[test]
    fn collections_merge_and_want_what_all_rows_give() {
        let coefficient = |e: usize| move |row: usize| (e * 5 + row) as f64;
        let mut both = GoalEquations::new(vec![1, 3]);
        both.add(coefficient(0), 5);
        let mut second = GoalEquations::new(vec![1, 3]);
        second.add(coefficient(1), 5);
        both.merge(&second);
        assert_eq!(both.entries, [1.0, 3.0, 6.0, 8.0]);
        assert_eq!((both.count(), both.wanted.as_slice()), (2, &[10.0, 35.0][..]));
    }
}
