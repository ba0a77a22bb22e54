//! Quantity that a sweep varies, and the values it takes.

use crate::solver::parameters::Quantity;
use serde::{Deserialize, Serialize};

/// Varied quantity with its values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// The quantity. M and L need an operating point given by Moes numbers.
    pub vary: Quantity,
    /// Its values.
    pub values: Steps,
}

/// Values of a varied quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Steps {
    /// Equal steps, including both ends.
    Linear {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// Number of values.
        n: usize,
    },
    /// Constant ratio between neighbours, including both ends.
    Log {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// Number of values.
        n: usize,
    },
    /// Steps that grow from the first value to the last, including both ends. Half of the values lie between `from` and
    /// `half`, which must be nearer to `from` than to `to`. Suited to quantities that rise quickly and then level off,
    /// such as traction over sliding.
    Graded {
        /// First value.
        from: f64,
        /// Half of the values lie between `from` and this value.
        half: f64,
        /// Last value.
        to: f64,
        /// Number of values.
        n: usize,
    },
    /// Listed values.
    List(Vec<f64>),
}

/// Largest accepted ratio (to − from)/(half − from) of a graded spacing.
const MOST_GRADING: f64 = 1e6;

/// Error: ends and middle of a graded spacing are inconsistent.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "half of the values up to {half} do not fit between {from} and {to}; a value nearer to {from} than to {to} is accepted"
)]
pub struct GradingError {
    from: f64,
    half: f64,
    to: f64,
}

impl Steps {
    /// Returns the number of values.
    pub fn len(&self) -> usize {
        match self {
            Self::Linear { n, .. } | Self::Log { n, .. } | Self::Graded { n, .. } => *n,
            Self::List(values) => values.len(),
        }
    }

    /// Returns true if there are no values.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Checks ends and middle of a graded spacing.
    ///
    /// # Errors
    /// If `half` is not nearer to `from` than to `to`, or is too near to `from`.
    pub fn check_grading(from: f64, half: f64, to: f64) -> Result<(), GradingError> {
        let ratio = (to - from) / (half - from);
        if ratio > 2.0 && ratio <= MOST_GRADING {
            return Ok(());
        }
        Err(GradingError { from, half, to })
    }

    /// Returns all combinations of the values of several axes. The values of the last axis change fastest.
    pub fn combinations<'a>(steps: impl IntoIterator<Item = &'a Self>) -> Vec<Vec<f64>> {
        let beside = |heads: Vec<Vec<f64>>, own: &Self| {
            let values = own.values();
            let with = |head: &Vec<f64>| values.iter().map(|&v| [&head[..], &[v]].concat()).collect::<Vec<_>>();
            heads.iter().flat_map(with).collect()
        };
        steps.into_iter().fold(vec![Vec::new()], beside)
    }

    /// Returns the values. The first and the last one are exactly the given ends.
    pub fn values(&self) -> Vec<f64> {
        let spaced = |from: f64, to: f64, n: usize, at: &dyn Fn(f64) -> f64| {
            (0..n)
                .map(|i| match i {
                    0 => from,
                    i if i + 1 == n => to,
                    i => at(i as f64 / (n - 1) as f64),
                })
                .collect()
        };
        match *self {
            Self::Linear { from, to, n } => spaced(from, to, n, &|t| from + (to - from) * t),
            Self::Log { from, to, n } => spaced(from, to, n, &|t| from * (to / from).powf(t)),
            Self::Graded { from, half, to, n } => {
                // sinh(b/2)/sinh(b) = 1/(2 cosh(b/2)): the value halfway through the list is `half`.
                let b = 2.0 * (0.5 * (to - from) / (half - from)).acosh();
                spaced(from, to, n, &|t| from + (to - from) * (b * t).sinh() / b.sinh())
            }
            Self::List(ref values) => values.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_hit_both_ends() {
        assert_eq!(Steps::Linear { from: 1.0, to: 2.0, n: 3 }.values(), [1.0, 1.5, 2.0]);
        let log = Steps::Log { from: 1.0, to: 100.0, n: 3 }.values();
        assert!(log[0] == 1.0 && (log[1] - 10.0).abs() < 1e-12 && log[2] == 100.0);
        assert_eq!(Steps::Linear { from: 7.0, to: 9.0, n: 1 }.values(), [7.0]);
    }

    #[test]
    fn half_of_graded_values_are_in_the_refined_part() {
        for (from, half, to) in [(0.0, 0.05, 1.0), (0.0, 0.05, 2.0), (-1.0, -0.9, 3.0), (1.0, 0.9, -2.0)] {
            assert_eq!(Steps::check_grading(from, half, to), Ok(()));
            let values = Steps::Graded { from, half, to, n: 41 }.values();
            assert!(values[0] == from && values[40] == to && (values[20] - half).abs() < 1e-12, "{values:?}");
            let steps: Vec<f64> = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
            assert!(steps.windows(2).all(|pair| pair[1] > pair[0]), "{steps:?}");
            // Every fourth value of the finer spacing equals a value of the coarser one.
            let coarse = Steps::Graded { from, half, to, n: 11 }.values();
            assert!(coarse.iter().zip(values.iter().step_by(4)).all(|(a, b)| a == b));
        }
        for (from, half, to) in
            [(0.0, 0.5, 1.0), (0.0, 0.0, 1.0), (0.0, -0.1, 1.0), (0.0, f64::NAN, 1.0), (1.0, 1.1, 0.0)]
        {
            assert!(
                Steps::check_grading(from, half, to).unwrap_err().to_string().contains("is accepted"),
                "{from} {half} {to}"
            );
        }
    }

    #[test]
    fn of_all_combinations_the_last_value_changes_fastest() {
        let two = [Steps::List(vec![1.0, 2.0]), Steps::Linear { from: 5.0, to: 7.0, n: 3 }];
        let pairs = [[1.0, 5.0], [1.0, 6.0], [1.0, 7.0], [2.0, 5.0], [2.0, 6.0], [2.0, 7.0]];
        assert_eq!(Steps::combinations(&two), pairs);
    }
}
