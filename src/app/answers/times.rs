//! Times of the last solves. Their median gives a better prediction than a single solve on a busy machine.

use crate::scene::median;
use std::collections::VecDeque;

/// Number of stored times.
const REMEMBERED: usize = 15;

/// Times \[s\] of the last solves by one method.
#[derive(Clone, Debug, Default)]
pub struct Times(VecDeque<f64>);

impl Times {
    /// Adds a time and drops the oldest one if necessary.
    pub fn add(&mut self, seconds: f64) {
        if self.0.len() == REMEMBERED {
            self.0.pop_front();
        }
        self.0.push_back(seconds);
    }

    /// Removes all times, because contact or method has changed.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Returns the number of times.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Returns the median \[s\]. `None` without times.
    pub fn median_s(&self) -> Option<f64> {
        let seconds: Vec<f64> = self.0.iter().copied().collect();
        (!seconds.is_empty()).then(|| median(&seconds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn median_ignores_outliers_and_old_solves() {
        let mut times = Times::default();
        assert_eq!(times.median_s(), None);
        [1.0, 1.0, 90.0].into_iter().for_each(|seconds| times.add(seconds));
        assert_eq!((times.median_s(), times.len()), (Some(1.0), 3));
        (0..REMEMBERED).for_each(|_| times.add(2.0));
        assert_eq!((times.median_s(), times.len()), (Some(2.0), REMEMBERED));
    }
}
