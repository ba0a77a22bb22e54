//! Errors of a table of load cases: reasons why the whole table is refused, and reasons why one line is refused while
//! the others are solved.

use super::columns::accepted;
use crate::scene::check::MAX_POINTS;
use crate::scene::contact_spec::{Refusal, Words};
use crate::solver::full::SolveError;
use crate::solver::limits::Refused;
use crate::solver::physics::engineering::UnitError;
use std::path::PathBuf;

/// Reason why a whole table is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CasesError {
    /// The file cannot be read.
    #[error("cannot read the load cases {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Reason given by the system.
        reason: String,
    },
    /// The table is empty.
    #[error(
        "the table of load cases is empty; it needs a line of titles, as `radius, speed, load`, and a line for each contact"
    )]
    Empty,
    /// The table has too many lines.
    #[error("the table of load cases has more than {MAX_POINTS} lines")]
    TooLong,
    /// A column title is unknown.
    #[error(
        "line {line}: the column “{title}” is unknown; accepted are name, measured, {}; put # before a title that is not to be read",
        accepted()
    )]
    Title {
        /// Number of the line with the titles.
        line: usize,
        /// The title.
        title: String,
    },
    /// Two columns give the same quantity.
    #[error("line {line}: two columns give the same quantity, “{title}” and a previous one")]
    Twice {
        /// Number of the line with the titles.
        line: usize,
        /// Title of the second column.
        title: String,
    },
    /// The unit in a title does not belong to its quantity.
    #[error("line {line}: the column “{title}”: {problem}")]
    Unit {
        /// Number of the line with the titles.
        line: usize,
        /// The title.
        title: String,
        /// What is wrong, and what is accepted.
        problem: UnitError,
    },
}

/// Reason why a line of a table is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LineError {
    /// The line has more cells than the table has titles.
    #[error("there are {cells} cells, but {titles} titles")]
    Cells {
        /// Number of cells.
        cells: usize,
        /// Number of titles.
        titles: usize,
    },
    /// The measured film thickness is not a length.
    #[error("measured: {0}")]
    Measured(UnitError),
    /// The measured film thickness is not positive.
    #[error("measured is {0} m, but must be above zero; leave the cell empty if there is no measurement")]
    MeasuredRange(f64),
    /// The inputs of the line do not define a valid contact.
    #[error("{}", .0.in_words(Words::Columns))]
    Contact(Refusal),
    /// The grid of the scene is not valid for the contact.
    #[error(transparent)]
    GridOfScene(Refused),
    /// The grid given in the line is not valid for the contact.
    #[error("{}", grid_of_line(.0))]
    Grid(Refused),
    /// The solver does not support the contact.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

impl From<Refusal> for LineError {
    fn from(refusal: Refusal) -> Self {
        Self::Contact(refusal)
    }
}

/// Returns the message for a grid that a line gives. It names the column `dx`, for instance, instead of the field
/// `grid.dx` of a scene.
fn grid_of_line(refused: &Refused) -> String {
    match refused.field.strip_prefix("grid.") {
        Some(name) => format!("{} {}", name.split('.').next().unwrap_or(name), refused.problem),
        None => refused.to_string(),
    }
}
