//! Reasons for refusing an operating point.

use crate::solver::limits::Number;

/// Reason for refusing an operating point. Each message names the quantity, its value and the accepted values.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// A quantity is NaN, infinite, or outside its valid range.
    #[error(
        "{quantity} is {}{unit}, but must be a finite number between {min:e} and {max:e}{unit}{}",
        Number(*value),
        if *or_zero { ", or 0" } else { "" }
    )]
    OutOfRange {
        /// Name of the quantity.
        quantity: &'static str,
        /// Given value.
        value: f64,
        /// Unit with a leading space, or empty.
        unit: &'static str,
        /// Smallest accepted value.
        min: f64,
        /// Largest accepted value.
        max: f64,
        /// Accepts zero in addition to the range.
        or_zero: bool,
    },
    /// Exactly one of α and L is zero. L is proportional to α.
    #[error(
        "alpha is {} 1/Pa, but L is {}: L is proportional to alpha, so that both are 0 or neither is", Number(*alpha),
        Number(*l)
    )]
    Isoviscous {
        /// Given coefficient \[1/Pa\].
        alpha: f64,
        /// Given lubricant number.
        l: f64,
    },
    /// A radius across was given for a line contact.
    #[error("a line contact has no radius across (radius-y): leave it out, or take a point contact")]
    LineAcross,
    /// The two bodies together are concave across the rolling direction.
    #[error(
        "radius-y is {} m, but the bodies must be convex together in both directions: R_y is what 1/R_y = 1/R_y1 + 1/R_y2 \
         leaves of a body and a groove, whose own radius counts as negative and must be the larger one; a positive number \
         is accepted", Number(*radius_y)
    )]
    Concave {
        /// Given radius \[m\].
        radius_y: f64,
    },
    /// More quantities were given than M and L leave free.
    #[error("M and L leave two quantities to follow, but {given} are all given; leave out at least one of them")]
    Overdetermined {
        /// Given quantities.
        given: &'static str,
    },
}
