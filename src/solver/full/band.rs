//! LU factorisation of a band matrix with partial pivoting, used as the Krylov preconditioner.

/// Square band matrix and, after [`BandLu::factorise`], its LU factors. Rows are stored with room for pivoting.
#[derive(Clone, Debug, Default)]
pub struct BandLu {
    n: usize,
    lower: usize,
    upper: usize,
    /// Entries; row i holds columns i − lower … i + upper + lower.
    rows: Vec<f64>,
    pivots: Vec<usize>,
    multipliers: Vec<f64>,
}

impl BandLu {
    /// Resizes to n × n with the given half-bandwidths and clears all entries.
    pub fn reset(&mut self, n: usize, lower: usize, upper: usize) {
        (self.n, self.lower, self.upper) = (n, lower, upper);
        self.rows.clear();
        self.rows.resize(n * self.stride(), 0.0);
        self.multipliers.clear();
        self.multipliers.resize(n * lower, 0.0);
        self.pivots.clear();
        self.pivots.resize(n, 0);
    }

    fn stride(&self) -> usize {
        2 * self.lower + self.upper + 1
    }

    /// Returns the stored entries of row i, from column i − lower on.
    #[inline]
    pub fn row_mut(&mut self, i: usize) -> &mut [f64] {
        let stride = self.stride();
        &mut self.rows[i * stride..(i + 1) * stride]
    }

    /// Factorises in place. Zero pivots are replaced by a tiny number: a preconditioner need not be exact.
    pub fn factorise(&mut self) {
        let (n, lower, stride) = (self.n, self.lower, self.stride());
        // Left-align every row so that the pivot column is always the first stored one.
        for i in 0..lower.min(n) {
            let shift = lower - i;
            let row = &mut self.rows[i * stride..(i + 1) * stride];
            row.copy_within(shift.., 0);
            row[stride - shift..].fill(0.0);
        }
        // Row i now starts at column max(0, i − lower). During the elimination of column k, rows k…k+lower start at
        // column k.
        for k in 0..n {
            let last = (k + lower).min(n - 1);
            let (mut pivot, mut largest) = (k, self.rows[k * stride].abs());
            for i in k + 1..=last {
                let value = self.rows[i * stride].abs();
                if value > largest {
                    (pivot, largest) = (i, value);
                }
            }
            self.pivots[k] = pivot;
            if pivot != k {
                let (head, tail) = self.rows.split_at_mut(pivot * stride);
                head[k * stride..(k + 1) * stride].swap_with_slice(&mut tail[..stride]);
            }
            if largest < 1e-300 {
                self.rows[k * stride] = 1e-300;
            }
            let (head, tail) = self.rows.split_at_mut((k + 1) * stride);
            let pivot_row = &head[k * stride..];
            let inverse = 1.0 / pivot_row[0];
            for (i, row) in tail.chunks_exact_mut(stride).take(last - k).enumerate() {
                let factor = row[0] * inverse;
                self.multipliers[k * lower + i] = factor;
                if factor == 0.0 {
                    row.copy_within(1.., 0);
                } else {
                    for j in 1..stride {
                        row[j - 1] = row[j] - factor * pivot_row[j];
                    }
                }
                row[stride - 1] = 0.0;
            }
        }
    }

    /// Solves in place for one right-hand side.
    pub fn solve(&self, b: &mut [f64]) {
        let (n, lower, stride) = (self.n, self.lower, self.stride());
        for k in 0..n {
            b.swap(k, self.pivots[k]);
            let value = b[k];
            let last = (k + lower).min(n - 1);
            let below = &mut b[k + 1..=last];
            for (b, factor) in below.iter_mut().zip(&self.multipliers[k * lower..]) {
                *b -= factor * value;
            }
        }
        for k in (0..n).rev() {
            let row = &self.rows[k * stride..(k + 1) * stride];
            let width = stride.min(n - k);
            let (head, tail) = b.split_at_mut(k + 1);
            let sum: f64 = row[1..width].iter().zip(&*tail).map(|(a, x)| a * x).sum();
            head[k] = (head[k] - sum) / row[0];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_a_band_system_that_needs_pivoting() {
        let (n, lower, upper) = (40, 3, 2);
        let entry = |i: usize, j: usize| {
            if j + lower < i || j > i + upper {
                0.0
            } else if i == j {
                1e-3 * ((i * 7 % 5) as f64 - 2.0)
            } else {
                1.0 + ((i * 31 + j * 17) % 11) as f64
            }
        };
        let mut lu = BandLu::default();
        lu.reset(n, lower, upper);
        for i in 0..n {
            for j in i.saturating_sub(lower)..(i + upper + 1).min(n) {
                lu.row_mut(i)[j + lower - i] = entry(i, j);
            }
        }
        lu.factorise();
        let x: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
        let mut b: Vec<f64> = (0..n).map(|i| (0..n).map(|j| entry(i, j) * x[j]).sum()).collect();
        lu.solve(&mut b);
        for (got, want) in b.iter().zip(&x) {
            assert!((got - want).abs() < 1e-9, "{got} against {want}");
        }
    }
}
