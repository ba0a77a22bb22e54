//! What the last solves took: one slow solve on a busy machine says little, the middle one of several says what to
//! expect.

use crate::scene::median;
use std::collections::VecDeque;

/// Solves that are remembered.
const REMEMBERED: usize = 15;

/// Seconds of the last solves by one method.
#[derive(Clone, Debug, Default)]
pub struct Times(VecDeque<f64>);

impl Times {
    /// Remembers one more.
    pub fn add(&mut self, seconds: f64) {
        if self.0.len() == REMEMBERED {
            self.0.pop_front();
        }
        self.0.push_back(seconds);
    }

    /// Forgets them: they were of other contacts or by other means.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The middle one; `None` of none.
    pub fn median_s(&self) -> Option<f64> {
        let seconds: Vec<f64> = self.0.iter().copied().collect();
        (!seconds.is_empty()).then(|| median(&seconds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_slow_solve_does_not_move_the_median_and_old_ones_are_forgotten() {
        let mut times = Times::default();
        assert_eq!(times.median_s(), None);
        [1.0, 1.0, 90.0].into_iter().for_each(|seconds| times.add(seconds));
        assert_eq!((times.median_s(), times.len()), (Some(1.0), 3));
        (0..REMEMBERED).for_each(|_| times.add(2.0));
        assert_eq!((times.median_s(), times.len()), (Some(2.0), REMEMBERED));
    }
}
