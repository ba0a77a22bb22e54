//! What a sweep varies, and the values it takes.

use crate::solver::physics::contact::Quantity;
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
    /// As listed.
    List(Vec<f64>),
}

impl Steps {
    /// How many values there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Linear { n, .. } | Self::Log { n, .. } => *n,
            Self::List(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
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
    fn of_all_combinations_the_last_value_changes_fastest() {
        let two = [Steps::List(vec![1.0, 2.0]), Steps::Linear { from: 5.0, to: 7.0, n: 3 }];
        let pairs = [[1.0, 5.0], [1.0, 6.0], [1.0, 7.0], [2.0, 5.0], [2.0, 6.0], [2.0, 7.0]];
        assert_eq!(Steps::combinations(&two), pairs);
    }
}
