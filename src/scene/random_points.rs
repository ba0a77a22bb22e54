//! Random operating points, (3.17), for studies.

use super::error::RunError;
use crate::solver::observer::Observer;
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::training::random_points_while;

/// Returns exactly `n` random points of a range for one contact kind. The same seed gives the same points.
///
/// # Errors
/// If the range contains hardly any admissible point, or if the observer cancels.
pub(super) fn all_random_points(
    range: &ParameterSpace,
    kind: ContactKind,
    n: usize,
    seed: u64,
    observer: &dyn Observer,
) -> Result<Vec<OperatingPoint>, RunError> {
    let points = random_points_while(range, kind, n, seed, || !observer.cancelled());
    let found = points.len();
    if observer.cancelled() {
        return Err(RunError::Cancelled);
    }
    if found < n {
        return Err(RunError::Study(format!(
            "`study.range` contains too few points below its largest Hertzian pressure; only {found} of {n} were found"
        )));
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::parameters::{Axis, Quantity};

    #[test]
    fn a_range_with_hardly_any_point_is_refused_in_a_sentence() {
        let none = ParameterSpace::of([Axis::new(Quantity::M, (500.0, 500.0)), Axis::new(Quantity::L, (20.0, 20.0))])
            .limited([(Quantity::HertzPressure, (0.0, 1e6))]);
        let sentence = all_random_points(&none, ContactKind::Line, 3, 1, &()).unwrap_err().to_string();
        assert!(sentence.contains("only 0 of 3"), "{sentence}");
    }
}
