//! Anderson mixing of the states of a fixed-point iteration (1965; Walker & Ni 2011). The next state is the
//! combination of the last ones whose changes cancel best.

use crate::solver::discrete::grid::dot;

/// Number of previous changes in use.
const DEPTH: usize = 8;

/// Growth of a change beyond which the history is discarded, and the number of turns without mixing that follow. A
/// moving cavitation boundary gives no useful direction.
const WORSE: f64 = 1.5;
const REST: usize = 6;

/// States and their changes. The storage grows as needed and is reused.
#[derive(Default)]
pub(in crate::solver) struct Mixing {
    /// Result of the last turn, and its difference from the turn's initial state.
    image: Vec<f64>,
    change: Vec<f64>,
    /// Differences of successive results and of successive changes. The first `known` of each ring are valid.
    moved: Vec<Vec<f64>>,
    turned: Vec<Vec<f64>>,
    /// Inner products of the differences of changes.
    products: [[f64; DEPTH]; DEPTH],
    /// Number of valid differences, and position of the next one in the ring.
    known: usize,
    next: usize,
    /// True after the first turn.
    begun: bool,
    /// Remaining turns without mixing.
    rest: usize,
}

impl Mixing {
    /// Discards all states.
    pub fn forget(&mut self) {
        (self.known, self.next, self.begun) = (0, 0, false);
    }

    /// Discards all states and ends the turns without mixing, as before another contact.
    pub fn begin(&mut self) {
        self.forget();
        self.rest = 0;
    }

    /// Replaces the result `image` of a turn that began at `from` by an improved state, if the history provides one.
    pub fn improve(&mut self, from: &[f64], image: &mut [f64]) {
        let size: f64 = image.iter().zip(from).map(|(to, from)| (to - from) * (to - from)).sum();
        let worse = self.begun && size > WORSE * WORSE * dot(&self.change, &self.change);
        if worse || !size.is_finite() {
            self.forget();
            self.rest = REST;
        }
        if self.rest > 0 {
            self.rest -= 1;
            return;
        }
        self.take_in(from, image);
        if self.known == 0 {
            return;
        }
        let m = self.known;
        let mut rows = [[0.0; DEPTH + 1]; DEPTH];
        for (i, row) in rows.iter_mut().enumerate().take(m) {
            row[..m].copy_from_slice(&self.products[i][..m]);
            row[i] *= 1.0 + 1e-10;
            row[DEPTH] = dot(&self.turned[i], &self.change);
        }
        let Some(shares) = solve(rows, m) else { return self.forget() };
        for (share, moved) in shares.into_iter().zip(&self.moved).take(m) {
            for (image, moved) in image.iter_mut().zip(moved) {
                *image -= share * moved;
            }
        }
    }

    /// Adds a turn to the history.
    fn take_in(&mut self, from: &[f64], image: &[f64]) {
        if self.begun {
            let place = self.next;
            if self.moved.len() == place {
                self.moved.push(Vec::new());
                self.turned.push(Vec::new());
            }
            let difference = |out: &mut Vec<f64>, new: &mut dyn Iterator<Item = f64>, old: &[f64]| {
                out.clear();
                out.extend(new.zip(old).map(|(new, old)| new - old));
            };
            difference(&mut self.moved[place], &mut image.iter().copied(), &self.image);
            let mut changes = image.iter().zip(from).map(|(to, from)| to - from);
            difference(&mut self.turned[place], &mut changes, &self.change);
            (self.next, self.known) = ((place + 1) % DEPTH, (self.known + 1).min(DEPTH));
            for other in 0..self.known {
                let product = dot(&self.turned[place], &self.turned[other]);
                (self.products[place][other], self.products[other][place]) = (product, product);
            }
        }
        self.begun = true;
        self.image.clear();
        self.image.extend_from_slice(image);
        self.change.clear();
        self.change.extend(image.iter().zip(from).map(|(to, from)| to - from));
    }
}

/// Solves m equations with a positive definite matrix; the right-hand side is the last column. `None` if the matrix
/// is singular.
fn solve(mut rows: [[f64; DEPTH + 1]; DEPTH], m: usize) -> Option<[f64; DEPTH]> {
    for k in 0..m {
        let head = rows[k];
        if head[k] <= 0.0 || !head[k].is_finite() {
            return None;
        }
        for row in &mut rows[k + 1..m] {
            let factor = row[k] / head[k];
            for (entry, above) in row.iter_mut().zip(&head).skip(k) {
                *entry -= factor * above;
            }
        }
    }
    let mut out = [0.0; DEPTH];
    for k in (0..m).rev() {
        let known: f64 = (k + 1..m).map(|j| rows[k][j] * out[j]).sum();
        out[k] = (rows[k][DEPTH] - known) / rows[k][k];
    }
    out.iter().all(|share| share.is_finite()).then_some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_iteration_ends_after_as_many_turns_as_it_has_rates() {
        // Rates −0.9 and 0.8 of two modes, around (1, 2).
        let turn = |x: &[f64]| vec![1.0 - 0.9 * (x[0] - 1.0), 2.0 + 0.8 * (x[1] - 2.0)];
        let mut mixing = Mixing::default();
        let mut x = vec![5.0, -3.0];
        for _ in 0..4 {
            let mut image = turn(&x);
            mixing.improve(&x, &mut image);
            x = image;
        }
        assert!((x[0] - 1.0).abs() < 1e-6 && (x[1] - 2.0).abs() < 1e-6, "{x:?}");
    }
}
