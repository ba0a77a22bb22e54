//! Why a contact cannot be a part of another program's simulation, each as one sentence.

use crate::scene::RunError;
use crate::solver::full::SolveError;
use crate::solver::limits::Number;
use crate::solver::physics::contact::ContactError;
use crate::solver::reduced::ReducedError;
use crate::solver::reduced::transient::CoupledError as MarchError;
use crate::solver::warning::Warning;

/// Why a contact is refused, or has no solution.
#[derive(Debug, thiserror::Error)]
pub enum CoupledError {
    /// The model is empty.
    #[error("the reduced model `{0}` holds no window")]
    NoWindow(String),
    /// Two half-planes have no approach.
    #[error("the approach of a line contact depends on the size of its bodies; give its load instead")]
    LineApproach,
    /// Transient models have no approach as input.
    #[error("a model in time is driven by its load; leave out --approach")]
    ApproachInTime,
    /// There is no contact to begin with.
    #[error("the reduced model `{0}` solves none of its own training points")]
    NoStart(String),
    /// A transient model without a reference contact.
    #[error("the model `{0}` knows no contact")]
    NoReference(String),
    /// An input makes no sense.
    #[error("the {name} is {}{unit}, but must be a finite number{accepted}", Number(*value))]
    Input {
        /// Its name.
        name: &'static str,
        /// What was given.
        value: f64,
        /// Its unit, after a blank; empty if it has none.
        unit: &'static str,
        /// The accepted range, after a blank; empty if all numbers are.
        accepted: &'static str,
    },
    /// A variable is given a value that is no number.
    #[error("`{name}` is {value}, but must be a finite number")]
    NoNumber {
        /// Its name.
        name: &'static str,
        /// What was given.
        value: f64,
    },
    /// A variable is an output.
    #[error("`{0}` follows from the inputs and cannot be set")]
    Output(&'static str),
    /// The search for a load found none.
    #[error("no load was found that gives an approach of {} m", Number(*.0))]
    NoLoad(f64),
    /// Nothing converges.
    #[error("neither the reduced model nor the full solver has a solution here: {0}")]
    NoSolution(String),
    /// An input states no contact.
    #[error("{0}")]
    Stated(String),
    /// The model was not trained for the contact, or for how its inputs change.
    #[error("{}", Warning::joined(.0))]
    Untrained(Vec<Warning>),
    /// The request is refused.
    #[error(transparent)]
    Run(#[from] Box<RunError>),
    /// It is asked for outputs before it has begun.
    #[error("the contact in time has not begun")]
    NotBegun,
    /// A state cannot be encoded.
    #[error("the state cannot be written")]
    Unwritable,
    /// The bytes are no state.
    #[error("this is no state of this unit")]
    Foreign,
    /// The contact is refused.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The problem is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The reduced model refuses it.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The march does not go on.
    #[error(transparent)]
    March(#[from] MarchError),
}

impl From<RunError> for CoupledError {
    fn from(error: RunError) -> Self {
        Self::Run(Box::new(error))
    }
}

/// Refuses a value outside its range.
pub(super) fn check(
    name: &'static str,
    value: f64,
    unit: &'static str,
    (accepted, range): (&'static str, impl Fn(f64) -> bool),
) -> Result<(), CoupledError> {
    let fine = value.is_finite() && range(value);
    if fine { Ok(()) } else { Err(CoupledError::Input { name, value, unit, accepted }) }
}

/// Refuses a slide-to-roll ratio beyond any sense.
pub(super) fn check_sliding(ratio: f64) -> Result<(), CoupledError> {
    check("slide-to-roll ratio", ratio, "", (" between -10 and 10", |ratio| ratio.abs() <= 10.0))
}
