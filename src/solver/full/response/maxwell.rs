//! Element of springs and dashpots that replaces the film in a multibody program.
//!
//! The damping of a film falls severalfold once a period is shorter than the passage of the lubricant through the
//! contact. One spring and one dashpot in parallel (Voigt) cannot describe this. A spring in series with a dashpot
//! (Maxwell) can.

use super::dynamics::Dynamics;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Spring k₀, dashpot c, and a spring k₁ in series with a dashpot k₁τ, all in parallel:
/// k*(ω) = k₀ + iωc + k₁ iωτ/(1 + iωτ).
///
/// Units as in [`Dynamics`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Maxwell {
    /// Stiffness k₀ at ω = 0.
    pub static_stiffness: f64,
    /// Stiffness k₁ of the spring in series with a dashpot.
    pub series_stiffness: f64,
    /// Relaxation time τ of that pair \[s\].
    pub relaxation_s: f64,
    /// Damping c of the single dashpot.
    pub parallel_damping: f64,
    /// Largest deviation of k relative to the largest k, and of c relative to the largest c, among the fitted values.
    pub deviation: f64,
}

/// Smallest number of frequencies for four constants; each has two values.
pub const FEWEST_FREQUENCIES: usize = 3;
/// Number of relaxation times that the search compares, and the number of its refinements.
const TRIED: usize = 41;
const REFINEMENTS: usize = 8;

impl Maxwell {
    /// Returns stiffness and damping at a frequency.
    pub fn at(&self, frequency_hz: f64) -> Dynamics {
        let ratio = TAU * frequency_hz * self.relaxation_s;
        let square = ratio * ratio;
        Dynamics {
            frequency_hz,
            stiffness: self.static_stiffness + self.series_stiffness * square / (1.0 + square),
            damping: self.parallel_damping + self.series_stiffness * self.relaxation_s / (1.0 + square),
        }
    }

    /// Fits the element to computed values by least squares. k and c count relative to their largest values. Returns
    /// `None` for fewer than three different frequencies above zero.
    pub fn fit(values: &[Dynamics]) -> Option<Self> {
        let mut above: Vec<f64> = values.iter().map(|v| v.frequency_hz).filter(|f| *f > 0.0).collect();
        above.sort_by(f64::total_cmp);
        above.dedup();
        let (first, last) = (*above.first()?, *above.last()?);
        if above.len() < FEWEST_FREQUENCIES {
            return None;
        }
        let mut range = [0.1 / (TAU * last), 10.0 / (TAU * first)].map(f64::ln);
        let mut best: Option<(f64, Self)> = None;
        for _ in 0..REFINEMENTS {
            let spacing = (range[1] - range[0]) / (TRIED - 1) as f64;
            for k in 0..TRIED {
                let relaxation = (range[0] + spacing * k as f64).exp();
                let tried = Self::with_relaxation(relaxation, values)?;
                if best.as_ref().is_none_or(|(error, _)| tried.0 < *error) {
                    best = Some(tried);
                }
            }
            let middle = best.as_ref()?.1.relaxation_s.ln();
            range = [middle - 2.0 * spacing, middle + 2.0 * spacing];
        }
        best.map(|(_, element)| element)
    }

    /// Returns the sum of squares and the best element with a given relaxation time.
    fn with_relaxation(relaxation_s: f64, values: &[Dynamics]) -> Option<(f64, Self)> {
        let largest = |of: fn(&Dynamics) -> f64| values.iter().map(|v| of(v).abs()).fold(0.0, f64::max);
        let (k, c) = (largest(|v| v.stiffness), largest(|v| v.damping));
        // Normal equations of k₀, k₁ and, if it is not negative, c.
        let solve = |dashpot: bool| -> Option<[f64; 3]> {
            let mut matrix = [[0.0; 4]; 3];
            let mut add = |row: [f64; 3], value: f64| {
                for i in 0..3 {
                    for j in 0..3 {
                        matrix[i][j] += row[i] * row[j];
                    }
                    matrix[i][3] += row[i] * value;
                }
            };
            let free = f64::from(u8::from(dashpot));
            for value in values {
                let square = (TAU * value.frequency_hz * relaxation_s).powi(2);
                add([1.0 / k, square / (1.0 + square) / k, 0.0], value.stiffness / k);
                add([0.0, relaxation_s / (1.0 + square) / c, free / c], value.damping / c);
            }
            if !dashpot {
                matrix[2] = [0.0, 0.0, 1.0, 0.0];
            }
            eliminated(matrix)
        };
        let mut found = solve(true)?;
        if found[2] < 0.0 {
            found = solve(false)?;
        }
        let [static_stiffness, series_stiffness, parallel_damping] = found;
        let element =
            Self { static_stiffness, series_stiffness, relaxation_s, parallel_damping, deviation: f64::INFINITY };
        let (mut sum, mut deviation) = (0.0, 0.0f64);
        for value in values {
            let own = element.at(value.frequency_hz);
            for miss in [(own.stiffness - value.stiffness) / k, (own.damping - value.damping) / c] {
                sum += miss * miss;
                deviation = deviation.max(miss.abs());
            }
        }
        Some((sum, Self { deviation, ..element }))
    }
}

/// Solves three equations, each with its right-hand side as fourth entry. `None` if they are singular.
fn eliminated(mut rows: [[f64; 4]; 3]) -> Option<[f64; 3]> {
    // The unknowns have different units: scale them by the diagonal.
    let scale: [f64; 3] = std::array::from_fn(|k| rows[k][k].sqrt());
    if scale.iter().any(|s| !(s.is_finite() && *s > 0.0)) {
        return None;
    }
    for (row, s) in rows.iter_mut().zip(scale) {
        let divisors = [scale[0], scale[1], scale[2], 1.0];
        row.iter_mut().zip(divisors).for_each(|(entry, d)| *entry /= s * d);
    }
    for k in 0..3 {
        let pivot = (k..3).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs()))?;
        rows.swap(k, pivot);
        let own = rows[k];
        if own[k].abs() < 1e-14 {
            return None;
        }
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k] / own[k];
            row.iter_mut().zip(own).for_each(|(entry, own)| *entry -= factor * own);
        }
    }
    let mut found = [0.0; 3];
    for k in (0..3).rev() {
        let known: f64 = (k + 1..3).map(|j| rows[k][j] * found[j]).sum();
        found[k] = (rows[k][3] - known) / rows[k][k];
    }
    Some(std::array::from_fn(|k| found[k] / scale[k]))
}
