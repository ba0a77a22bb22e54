//! What a scene expects of its answer.

use super::Method;
use serde::{Deserialize, Serialize};

/// One expected value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Name of the value as results call it: `H_c`, `moes.M`, `order`, …
    pub name: String,
    /// The method it belongs to; left out where the value belongs to none or only one method is used.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<Method>,
    /// The value; for `Between`, `AtMost` and `AtLeast` it may be left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// How close the answer must come.
    pub within: Within,
    /// Where the expectation comes from.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub from: String,
}

/// How close is close enough.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Within {
    /// |answer/value − 1| at most this.
    Relative(f64),
    /// |answer − value| at most this.
    Absolute(f64),
    /// The answer is at most this.
    AtMost(f64),
    /// The answer is at least this.
    AtLeast(f64),
    /// The answer lies between these two, both included.
    Between(f64, f64),
}

impl Within {
    /// Whether an answer is close enough. No answer and NaN never are.
    pub fn holds(self, value: Option<f64>, answer: f64) -> bool {
        match (self, value) {
            (Self::Relative(tolerance), Some(value)) => (answer - value).abs() <= tolerance * value.abs(),
            (Self::Absolute(tolerance), Some(value)) => (answer - value).abs() <= tolerance,
            (Self::Relative(_) | Self::Absolute(_), None) => false,
            (Self::AtMost(limit), _) => answer <= limit,
            (Self::AtLeast(limit), _) => answer >= limit,
            (Self::Between(low, high), _) => (low..=high).contains(&answer),
        }
    }
}

impl Expectation {
    /// What is wanted, in words.
    pub fn wanted(&self) -> String {
        let value = self.value.map_or_else(|| "?".to_owned(), |v| format!("{v}"));
        match self.within {
            Within::Relative(tolerance) => format!("{value} within {tolerance:e} of itself"),
            Within::Absolute(tolerance) => format!("{value} ± {tolerance:e}"),
            Within::AtMost(limit) => format!("at most {limit}"),
            Within::AtLeast(limit) => format!("at least {limit}"),
            Within::Between(low, high) => format!("between {low} and {high}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_closeness() {
        assert!(Within::Relative(0.1).holds(Some(-10.0), -10.9) && !Within::Relative(0.1).holds(Some(10.0), 11.1));
        assert!(Within::Absolute(0.1).holds(Some(0.0), 0.05) && !Within::Absolute(0.1).holds(None, 0.0));
        assert!(Within::AtMost(1.0).holds(None, 1.0) && !Within::AtMost(1.0).holds(None, f64::NAN));
        assert!(Within::AtLeast(1.0).holds(None, 1.0) && !Within::AtLeast(1.0).holds(None, 0.9));
        assert!(Within::Between(1.0, 2.0).holds(None, 1.5) && !Within::Between(1.0, 2.0).holds(None, 2.5));
    }
}
