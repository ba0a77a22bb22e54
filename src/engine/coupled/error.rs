//! Errors of contacts in co-simulations.

use crate::scene::RunError;
use crate::solver::full::SolveError;
use crate::solver::limits::Number;
use crate::solver::physics::contact::ContactError;
use crate::solver::reduced::ReducedError;
use crate::solver::reduced::transient::CoupledError as MarchError;
use crate::solver::warning::Warning;

/// Reason why a contact is refused or has no solution.
#[derive(Debug, thiserror::Error)]
pub enum CoupledError {
    /// The model contains no local model.
    #[error("the reduced model `{0}` contains no local model")]
    NoWindow(String),
    /// An approach was given for a transient model.
    #[error("the input of a transient model is its load; leave out --approach")]
    ApproachInTime,
    /// The model solves none of its training points.
    #[error("the reduced model `{0}` does not converge at any of its training points")]
    NoStart(String),
    /// A transient model without reference contact.
    #[error("the transient model `{0}` contains no reference contact")]
    NoReference(String),
    /// An input is out of range.
    #[error("the {name} is {}{unit}, but must be a finite number{accepted}", Number(*value))]
    Input {
        /// Name of the input.
        name: &'static str,
        /// Value that was given.
        value: f64,
        /// Unit, after a blank; empty if there is none.
        unit: &'static str,
        /// Accepted range, after a blank; empty if all numbers are accepted.
        accepted: &'static str,
    },
    /// A variable was set to a value that is not finite.
    #[error("`{name}` is {value}, but must be a finite number")]
    NoNumber {
        /// Name of the variable.
        name: &'static str,
        /// Value that was given.
        value: f64,
    },
    /// A variable is an output.
    #[error("`{0}` follows from the inputs and cannot be set")]
    Output(&'static str),
    /// No load was found for the approach.
    #[error("no load was found that gives an approach of {} m", Number(*.0))]
    NoLoad(f64),
    /// The outputs have no derivative.
    #[error("there is no derivative: {0}")]
    NoDerivative(&'static str),
    /// Neither the model nor the full solver converged.
    #[error("neither the reduced model nor the full solver found a solution here: {0}")]
    NoSolution(String),
    /// The inputs do not define a valid contact.
    #[error("{0}")]
    Stated(String),
    /// The contact, or the rate of change of its inputs, is outside the trained range.
    #[error("{}", Warning::joined(.0))]
    Untrained(Vec<Warning>),
    /// The request is refused.
    #[error(transparent)]
    Run(#[from] Box<RunError>),
    /// Outputs were requested before the start.
    #[error("the transient contact has not been initialised")]
    NotBegun,
    /// A state cannot be encoded.
    #[error("the state cannot be written")]
    Unwritable,
    /// The bytes are not a valid state.
    #[error("this is not a state of this unit")]
    Foreign,
    /// The contact is refused.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The problem is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The reduced model refuses the problem.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The march failed.
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

/// Refuses a slide-to-roll ratio outside −10 to 10.
pub(super) fn check_sliding(ratio: f64) -> Result<(), CoupledError> {
    check("slide-to-roll ratio", ratio, "", (" between -10 and 10", |ratio| ratio.abs() <= 10.0))
}
