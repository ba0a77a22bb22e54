//! Expected values of a scene's results.

use super::method::Method;
use serde::{Deserialize, Serialize};

/// Expected value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// Name of the value in results: `H_c`, `moes.M`, `order`, …
    pub name: String,
    /// Method that computes the value. Left out if the value belongs to no method or if the scene uses only one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub method: Option<Method>,
    /// Reference value. May be left out for `Between`, `AtMost` and `AtLeast`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// Accepted deviation.
    pub within: Within,
    /// Origin of the reference value.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub from: String,
}

/// Accepted deviation from the reference value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Within {
    /// |result/value − 1| at most this.
    Relative(f64),
    /// |result − value| at most this.
    Absolute(f64),
    /// Result at most this.
    AtMost(f64),
    /// Result at least this.
    AtLeast(f64),
    /// Result between these two, both included.
    Between(f64, f64),
}

impl Within {
    /// Returns true if a result is accepted. NaN is never accepted.
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
    /// Returns true if the expectation is about failures and accepts some. Expectations about failures beyond plausible
    /// pressures do not count.
    pub fn admits_failures(&self) -> bool {
        let value = self.value.unwrap_or(0.0);
        self.name.contains("failure")
            && !self.name.ends_with("failures_beyond")
            && match self.within {
                Within::Relative(tolerance) => value + tolerance * value.abs() > 0.0,
                Within::Absolute(tolerance) => value + tolerance > 0.0,
                Within::AtLeast(_) => true,
                Within::AtMost(most) | Within::Between(_, most) => most > 0.0,
            }
    }

    /// Describes the accepted values as text.
    pub fn wanted(&self) -> String {
        let value = self.value.map_or_else(|| "?".to_owned(), |v| format!("{v}"));
        match self.within {
            Within::Relative(0.0) | Within::Absolute(0.0) => value,
            Within::Relative(tolerance) => format!("{value}, relative error at most {tolerance:e}"),
            Within::Absolute(tolerance) => format!("{value} ± {tolerance:e}"),
            Within::AtMost(limit) => format!("at most {limit:?}"),
            Within::AtLeast(limit) => format!("at least {limit:?}"),
            Within::Between(low, high) => format!("between {low} and {high}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failures_are_admitted_by_name_and_number() {
        let about = |name: &str, value, within| {
            let expectation = Expectation { name: name.to_owned(), method: None, value, within, from: String::new() };
            expectation.admits_failures()
        };
        assert!(
            about("failures", Some(2.0), Within::Absolute(0.0)) && about("failure_percent", None, Within::AtMost(0.5))
        );
        assert!(!about("failures", Some(0.0), Within::Absolute(0.0)) && !about("failures", None, Within::AtMost(0.0)));
        assert!(!about("H_c", Some(2.0), Within::Relative(0.1)));
        assert!(!about("failures_beyond", None, Within::AtMost(9.0)));
    }

    #[test]
    fn every_kind_of_closeness() {
        assert!(Within::Relative(0.1).holds(Some(-10.0), -10.9) && !Within::Relative(0.1).holds(Some(10.0), 11.1));
        assert!(Within::Absolute(0.1).holds(Some(0.0), 0.05) && !Within::Absolute(0.1).holds(None, 0.0));
        assert!(Within::AtMost(1.0).holds(None, 1.0) && !Within::AtMost(1.0).holds(None, f64::NAN));
        assert!(Within::AtLeast(1.0).holds(None, 1.0) && !Within::AtLeast(1.0).holds(None, 0.9));
        assert!(Within::Between(1.0, 2.0).holds(None, 1.5) && !Within::Between(1.0, 2.0).holds(None, 2.5));
    }
}
