//! Why a table of load cases is refused.

use super::columns::accepted;
use crate::scene::check::MAX_POINTS;
use std::path::PathBuf;

/// Why a whole table is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CasesError {
    /// The file cannot be read.
    #[error("cannot read the load cases {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// It holds nothing.
    #[error(
        "the table of load cases is empty; it needs a line of titles, as `radius, speed, load`, and a line for each contact"
    )]
    Empty,
    /// It holds too much.
    #[error("the table of load cases has more than {MAX_POINTS} lines")]
    TooLong,
    /// A title is unknown.
    #[error(
        "line {line}: the column “{title}” is unknown; accepted are name, {}; put # before a title that is not to be read",
        accepted()
    )]
    Title {
        /// Line of the titles.
        line: usize,
        /// The title.
        title: String,
    },
    /// A column is there twice.
    #[error("line {line}: two columns say the same thing, “{title}” and one before it")]
    Twice {
        /// Line of the titles.
        line: usize,
        /// The second title.
        title: String,
    },
    /// The unit in a title is none of its quantity.
    #[error("line {line}: the column “{title}”: {problem}")]
    Unit {
        /// Line of the titles.
        line: usize,
        /// The title.
        title: String,
        /// What is wrong, and what would be accepted.
        problem: String,
    },
}
