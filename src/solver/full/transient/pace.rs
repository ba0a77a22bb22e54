//! Lengths of the steps of a march, and times at which it is recorded.

use serde::{Deserialize, Serialize};

/// Rule for the lengths of the steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum TimeStep {
    /// Equal steps; they divide the duration evenly. A step whose iteration fails is divided into up to 64 smaller
    /// ones, and only its end is recorded.
    Fixed(f64),
    /// Step lengths such that the solution stays near the straight line through the two previous ones.
    Adaptive {
        /// Target value of ‖P − extrapolation‖/‖P‖, with the pressure P.
        tolerance: f64,
        /// Length of the longest step, which is also the first.
        longest: f64,
    },
    /// Step lengths such that the estimated time-step error is at most this share of the central film thickness H_c.
    /// Adaptive marches are repeated with shorter steps until two of them agree.
    Controlled(f64),
}

/// Largest ratio of a step to the previous one; (2.34) is stable up to 2.4.
pub(crate) const GREATEST_RATIO: f64 = 1.8;
/// Shortest adaptive step, relative to the longest.
const SHORTEST_PART: f64 = 1e-5;
/// A step is repeated if it should have been shorter than this part of its length.
const TOO_FAR: f64 = 0.5;
/// Part of its length with which a failed step is tried again, adaptive and fixed. A failed adaptive step was much
/// too long, a fixed one only slightly.
const RETRIED: [f64; 2] = [0.25, 0.5];
/// Maximum number of parts of a fixed step.
pub(crate) const MOST_PARTS: f64 = 64.0;
/// Largest growth of the parts of a fixed step from one to the next.
const DOUBLED: f64 = 2.0;
/// Longest step of controlled marches: the flow crosses the contact in twenty such steps.
const LONGEST: f64 = 0.1;
/// Minimum number of steps of controlled marches.
const FEWEST_STEPS: f64 = 20.0;
/// Target ‖P − extrapolation‖/‖P‖ of the first march of a controlled one, relative to its tolerance for H_c.
const FIRST_DEVIATION: f64 = 40.0;
/// A remainder of a step below this share is rounding, not a separate step.
pub(crate) const ROUNDING: f64 = 1e-6;

impl TimeStep {
    /// Returns the rule of a march over a duration; for controlled steps the rule of the first march.
    pub(super) fn rule(self, duration: f64) -> Rule {
        match self {
            Self::Fixed(step) => Rule::Fixed(step),
            Self::Adaptive { tolerance, longest } => Rule::Adaptive { tolerance, longest },
            Self::Controlled(tolerance) => {
                Rule::Adaptive { tolerance: FIRST_DEVIATION * tolerance, longest: self.longest(duration) }
            }
        }
    }

    /// Returns the longest step over a duration.
    pub fn longest(self, duration: f64) -> f64 {
        match self {
            Self::Fixed(step) => step,
            Self::Adaptive { longest, .. } => longest,
            Self::Controlled(_) => LONGEST.min(duration / FEWEST_STEPS),
        }
    }
}

/// Rule that determines the next step of one march from the previous one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum Rule {
    /// All steps have this length, up to an even division of the duration.
    Fixed(f64),
    /// As in [`TimeStep::Adaptive`].
    Adaptive {
        /// Target value of ‖P − extrapolation‖/‖P‖.
        tolerance: f64,
        /// Length of the longest step, which is also the first.
        longest: f64,
    },
}

impl Rule {
    /// Returns the rule of steps that are shorter by `factor`.
    pub(super) fn shorter(self, factor: f64) -> Self {
        match self {
            Self::Fixed(step) => Self::Fixed(step / factor),
            Self::Adaptive { tolerance, longest } => {
                Self::Adaptive { tolerance: tolerance / (factor * factor), longest: longest / factor }
            }
        }
    }
}

/// Lengths of the next and of the previous step.
pub struct Pace {
    rule: Rule,
    duration: f64,
    /// Time that the steps must meet: the end of a fixed step or of the march.
    due: f64,
    /// Number of fixed steps up to that time. A sum of steps would drift by 1e-11 over ten thousand.
    steps: f64,
    /// Length of the next step.
    pub length: f64,
    /// Length of the previous step; for the first step its own length.
    pub before: f64,
}

impl Pace {
    /// Creates the state at T = 0.
    pub(crate) fn new(rule: Rule, duration: f64) -> Self {
        let (rule, length) = match rule {
            Rule::Fixed(step) => {
                let step = duration / (duration / step).round().max(1.0);
                (Rule::Fixed(step), step)
            }
            Rule::Adaptive { longest, .. } => (rule, longest),
        };
        let mut pace = Self { rule, duration, due: 0.0, steps: 0.0, length, before: length };
        pace.set_due();
        pace
    }

    fn set_due(&mut self) {
        self.steps += 1.0;
        self.due = match self.rule {
            Rule::Fixed(step) if self.duration - self.due > step * (1.0 + ROUNDING) => self.steps * step,
            _ => self.duration,
        };
    }

    /// Returns the end of the next step from `time`, and adapts its length to the time that must be met.
    pub fn aim(&mut self, time: f64) -> f64 {
        let left = self.due - time;
        let parts = (left / self.length - ROUNDING).ceil();
        if parts <= 1.0 {
            // Late in a march the rounding of T is a noticeable part of a step.
            self.length = match self.rule {
                Rule::Fixed(step) if (left / step - 1.0).abs() < ROUNDING => step,
                _ => left,
            };
            return self.due;
        }
        if let Rule::Fixed(_) = self.rule {
            self.length = left / parts;
        }
        time + self.length
    }

    /// Returns true if the last step is short enough. Its deviation from the extrapolation, which is of second order
    /// in its length, decides. Sets the length of the next step, or of the repetition of this one.
    pub fn accepts(&mut self, deviation: impl FnOnce() -> f64) -> bool {
        let wanted = match self.rule {
            Rule::Fixed(step) => (DOUBLED * self.length).min(step),
            Rule::Adaptive { tolerance, longest } => {
                let factor = 0.9 * (tolerance / deviation()).sqrt();
                (self.length * factor.clamp(0.2, GREATEST_RATIO)).clamp(SHORTEST_PART * longest, longest)
            }
        };
        let accepted = wanted >= TOO_FAR * self.length;
        if accepted {
            self.before = self.length;
        }
        self.length = wanted;
        accepted
    }

    /// Returns true if the moment `time` at the end of a step is recorded.
    pub fn records(&mut self, time: f64) -> bool {
        let met = time >= self.due;
        if met {
            self.set_due();
        }
        met || matches!(self.rule, Rule::Adaptive { .. })
    }

    /// Shortens the next step after a failed one. Returns false if the step is already the shortest.
    pub fn shorten(&mut self) -> bool {
        let (part, shortest) = match self.rule {
            Rule::Adaptive { longest, .. } => (RETRIED[0], SHORTEST_PART * longest),
            Rule::Fixed(step) => (RETRIED[1], step / MOST_PARTS * (1.0 + ROUNDING)),
        };
        let allowed = self.length > shortest;
        if allowed {
            self.length *= part;
        }
        allowed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ends of the steps, and recorded times, if steps longer than `longest(T)` fail.
    fn walked(rule: Rule, duration: f64, longest: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>, bool) {
        let mut pace = Pace::new(rule, duration);
        let (mut time, mut ends, mut recorded) = (0.0, Vec::new(), Vec::new());
        while time < duration {
            let end = pace.aim(time);
            if pace.length > longest(time) * (1.0 + 1e-9) {
                if !pace.shorten() {
                    return (ends, recorded, false);
                }
                continue;
            }
            let ratio = pace.length / pace.before;
            assert!(ends.is_empty() || ratio < 2.4, "(2.34) is not stable at {ratio}");
            assert!(pace.accepts(|| 0.0));
            time = end;
            ends.push(time);
            if pace.records(time) {
                recorded.push(time);
            }
        }
        (ends, recorded, true)
    }

    #[test]
    fn fixed_steps_divide_the_duration_evenly() {
        let (ends, recorded, finished) = walked(Rule::Fixed(0.3), 1.0, |_| 1.0);
        assert!(finished && ends == recorded && ends.len() == 3 && ends[2] == 1.0);
        assert!((ends[0] - 1.0 / 3.0).abs() < 1e-15);
    }

    #[test]
    fn ten_thousand_fixed_steps_end_where_they_should() {
        let (ends, _, finished) = walked(Rule::Fixed(0.01), 100.0, |_| 1.0);
        assert!(finished && ends.len() == 10_000);
        assert!(ends.iter().enumerate().all(|(k, end)| (end - 0.01 * (k + 1) as f64).abs() < 1e-13));
    }

    #[test]
    fn a_fixed_step_that_fails_is_taken_in_parts_and_recorded_once() {
        let steep = |time: f64| if (0.4..0.5).contains(&time) { 0.03 } else { 1.0 };
        let (ends, recorded, finished) = walked(Rule::Fixed(0.1), 1.0, steep);
        assert!(finished && ends.len() > recorded.len());
        assert_eq!(recorded.len(), 10);
        for (k, time) in recorded.iter().enumerate() {
            assert!((time - 0.1 * (k + 1) as f64).abs() < 1e-12, "{recorded:?}");
        }
        for pair in ends.windows(2) {
            assert!(pair[1] - pair[0] <= steep(pair[0]) + 1e-12, "{ends:?}");
        }
        let last = ends.windows(2).last().unwrap();
        assert!((last[1] - last[0] - 0.1).abs() < 1e-12, "steps grow back to what was asked: {ends:?}");
    }

    #[test]
    fn a_fixed_step_is_not_divided_for_ever() {
        let wall = |time: f64| if time < 0.5 { 1.0 } else { 0.1 / 65.0 };
        let (ends, recorded, finished) = walked(Rule::Fixed(0.1), 1.0, wall);
        assert!(!finished);
        assert_eq!((ends.len(), recorded.len()), (5, 5));
        assert!(walked(Rule::Fixed(0.1), 1.0, |_| 0.1 / 64.0).2);
    }

    #[test]
    fn all_adaptive_steps_are_recorded() {
        let adaptive = Rule::Adaptive { tolerance: 1e-3, longest: 0.2 };
        let (ends, recorded, finished) = walked(adaptive, 1.0, |_| 0.07);
        assert!(finished && ends == recorded && ends.last() == Some(&1.0));
        let mut pace = Pace::new(adaptive, 1.0);
        pace.aim(0.0);
        assert!(!pace.accepts(|| 1.0) && pace.length < 0.5 * pace.before);
    }
}
