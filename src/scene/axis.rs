//! What a sweep varies, and the values it takes.

use crate::solver::parameters::Quantity;
use serde::{Deserialize, Serialize};

/// One varied quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// What is varied; M and L need an operating point given by Moes numbers.
    pub vary: Quantity,
    /// Its values.
    pub values: Steps,
}

/// Values of a varied quantity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Steps {
    /// Equidistant, both ends counted.
    Linear {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// How many.
        n: usize,
    },
    /// With a constant ratio, both ends counted.
    Log {
        /// First value.
        from: f64,
        /// Last value.
        to: f64,
        /// How many.
        n: usize,
    },
    /// Close together at the first value and ever wider apart, both ends counted: half of them up to `half`, which is
    /// nearer to `from` than to `to`. For what rises at once and then levels off, such as traction over sliding.
    Graded {
        /// First value.
        from: f64,
        /// Up to here lie half of the values.
        half: f64,
        /// Last value.
        to: f64,
        /// How many.
        n: usize,
    },
    /// As listed.
    List(Vec<f64>),
}

/// A graded spacing that ends so far from where half of its values lie has no sensible steps left.
const MOST_GRADING: f64 = 1e6;

/// Ends and middle of a graded spacing that makes no sense.
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
    /// How many values there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Linear { n, .. } | Self::Log { n, .. } | Self::Graded { n, .. } => *n,
            Self::List(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Ends and middle of a graded spacing that makes no sense.
    ///
    /// # Errors
    /// When half of the values do not fit there.
    pub fn check_grading(from: f64, half: f64, to: f64) -> Result<(), GradingError> {
        let ratio = (to - from) / (half - from);
        if ratio > 2.0 && ratio <= MOST_GRADING {
            return Ok(());
        }
        Err(GradingError { from, half, to })
    }

    /// All combinations of the values of several, the last one fastest.
    pub fn combinations<'a>(steps: impl IntoIterator<Item = &'a Self>) -> Vec<Vec<f64>> {
        let beside = |heads: Vec<Vec<f64>>, own: &Self| {
            let values = own.values();
            let with = |head: &Vec<f64>| values.iter().map(|&v| [&head[..], &[v]].concat()).collect::<Vec<_>>();
            heads.iter().flat_map(with).collect()
        };
        steps.into_iter().fold(vec![Vec::new()], beside)
    }

    /// The values; both ends are hit exactly.
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
                // sinh(b/2)/sinh(b) = 1/(2 cosh(b/2)): half of the way along lies `half`.
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
    fn half_of_graded_values_lie_where_they_are_wanted_and_steps_only_grow() {
        for (from, half, to) in [(0.0, 0.05, 1.0), (0.0, 0.05, 2.0), (-1.0, -0.9, 3.0), (1.0, 0.9, -2.0)] {
            assert_eq!(Steps::check_grading(from, half, to), Ok(()));
            let values = Steps::Graded { from, half, to, n: 41 }.values();
            assert!(values[0] == from && values[40] == to && (values[20] - half).abs() < 1e-12, "{values:?}");
            let steps: Vec<f64> = values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
            assert!(steps.windows(2).all(|pair| pair[1] > pair[0]), "{steps:?}");
            // A coarser spacing lies on the finer one.
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
