//! Backward difference quotient in time, (2.34), and the linear extrapolation from which each step starts.

/// Weights of the newest value and the two previous ones in ∂/∂T, already divided by the step length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BackwardDifference {
    /// Weight of the value at the end of the step.
    pub now: f64,
    /// Weights of the values one step and two steps before.
    pub former: [f64; 2],
}

impl BackwardDifference {
    /// Returns the second-order quotient (2.34) for the current step and the one before it.
    pub fn second_order(step: f64, step_before: f64) -> Self {
        let r = step / step_before;
        Self { now: (1.0 + 2.0 * r) / (1.0 + r) / step, former: [-(1.0 + r) / step, r * r / (1.0 + r) / step] }
    }

    /// Returns the quotient of three values, the newest first.
    pub fn of(&self, [now, former, before]: [f64; 3]) -> f64 {
        self.now * now + self.former[0] * former + self.former[1] * before
    }
}

/// Extrapolates the straight line through two previous values; `ratio` = step / previous step.
#[inline]
pub fn extrapolated(ratio: f64, former: f64, before: f64) -> f64 {
    former + ratio * (former - before)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_order_quotients_are_exact_for_quadratics() {
        let (value, slope) = (|t: f64| 2.0 - 3.0 * t + 5.0 * t * t, |t: f64| -3.0 + 10.0 * t);
        for (step, step_before) in [(0.1, 0.1), (0.2, 0.1), (0.03, 0.1), (1e-3, 2.4e-3)] {
            let quotient = BackwardDifference::second_order(step, step_before);
            let t = 0.7;
            let values = [value(t), value(t - step), value(t - step - step_before)];
            assert!((quotient.of(values) - slope(t)).abs() < 1e-9, "{step} after {step_before}");
        }
    }

    #[test]
    fn equal_steps_give_the_textbook_weights() {
        let quotient = BackwardDifference::second_order(0.5, 0.5);
        for (got, want) in [(quotient.now, 3.0), (quotient.former[0], -4.0), (quotient.former[1], 1.0)] {
            assert!((got - want).abs() < 1e-14);
        }
    }

    #[test]
    fn the_extrapolation_is_exact_for_straight_lines() {
        assert!((extrapolated(0.5, 3.0, 1.0) - 4.0).abs() < 1e-15);
    }
}
