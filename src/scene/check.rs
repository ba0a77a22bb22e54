//! Range checks of scene values. They run before anything is computed.

use super::method::Method;
use crate::solver::limits::Refused;
use crate::solver::parameters::ParameterSpace;

pub(super) use crate::solver::limits::{count, interval, number};

/// Largest number of points in a sweep, a trajectory or a formula comparison.
pub const MAX_POINTS: usize = 100_000;
/// Largest number of tests in a random validation.
pub const MAX_TESTS: usize = 1_000_000;

/// Largest number of full solutions that a study keeps for comparison.
pub const MAX_COMPARED: usize = 20_000;

pub(super) type Checked = Result<(), Refused>;

pub(super) fn refuse(field: impl Into<String>, problem: impl Into<String>) -> Refused {
    Refused::new(field, problem)
}

pub(super) fn space(field: &str, range: &ParameterSpace) -> Checked {
    range.check().map_err(|refused| refused.within(field))
}

pub(super) fn methods(field: &str, methods: &[Method]) -> Checked {
    count(&format!("{field} (how many)"), methods.len(), 1, 16)
}

/// Refuses names that are empty or occur twice.
pub(super) fn names<'a>(field: &str, names: impl Iterator<Item = &'a str>) -> Checked {
    let mut seen: Vec<&str> = Vec::new();
    for name in names {
        if name.is_empty() || seen.contains(&name) {
            return Err(refuse(field, "must not be empty or occur twice: results are named by it"));
        }
        seen.push(name);
    }
    Ok(())
}
