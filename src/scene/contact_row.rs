//! One contact of a table of many: a contact that makes no sense refuses its own row only.

use super::answer::{Answer, Request};
use super::error::RunError;
use super::names;

/// How the solve of a row went.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RowStatus {
    /// There is a result.
    Converged,
    /// The solve did not converge.
    NotConverged,
    /// The contact is refused.
    #[default]
    Refused,
}

impl RowStatus {
    /// Its word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::NotConverged => "not converged",
            Self::Refused => "refused",
        }
    }
}

/// A row of a table: what came of one contact.
#[derive(Debug, Default)]
pub struct ContactRow {
    /// How its solve went.
    pub status: RowStatus,
    /// Why it did not converge or is refused; empty if it converged.
    pub reason: String,
    /// Its answer; `None` if it is refused.
    pub answer: Option<Answer>,
}

impl ContactRow {
    /// Solves the contact of a row, or refuses it with a sentence.
    ///
    /// # Errors
    /// If a model cannot be had, which concerns all rows, or the observer cancels.
    pub fn solve(
        request: Result<&Request, String>,
        solve: impl FnOnce(&Request) -> Result<Answer, RunError>,
    ) -> Result<Self, RunError> {
        let refused = |reason| Self { reason, ..Self::default() };
        let request = match request {
            Ok(request) => request,
            Err(reason) => return Ok(refused(reason)),
        };
        match solve(request) {
            Ok(answer) if answer.result.converged => {
                Ok(Self { status: RowStatus::Converged, reason: String::new(), answer: Some(answer) })
            }
            Ok(answer) => {
                let reason = answer.result.warning();
                Ok(Self { status: RowStatus::NotConverged, reason, answer: Some(answer) })
            }
            Err(error) if error.concerns_all_contacts() => Err(error),
            Err(error) => Ok(refused(error.to_string())),
        }
    }

    /// Writes the numbers of some columns, NaN if there is none. A refused contact counts as not converged.
    pub fn fill(&self, columns: &[&str], numbers: &mut [f64]) {
        let number = |column: &str| match &self.answer {
            Some(answer) => answer.result.value(column),
            None => (column == names::CONVERGED).then_some(0.0),
        };
        for (place, column) in numbers.iter_mut().zip(columns) {
            *place = number(column).unwrap_or(f64::NAN);
        }
    }

    /// Returns what a reader must know of it: the warnings of its result, or why it is refused.
    pub fn warning(&self) -> String {
        self.answer.as_ref().map_or_else(|| self.reason.clone(), |answer| answer.result.warning())
    }
}
