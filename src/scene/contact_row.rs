//! One contact in a table of contacts. An invalid contact is refused in its own row and does not affect the others.

use super::answer::{Answer, Request};
use super::contact_result::ContactResult;
use super::error::RunError;
use super::names;
use serde::{Deserialize, Serialize};
use std::fmt::Display;

/// Status of a row.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RowStatus {
    /// Converged: there is a result.
    Converged,
    /// The solve did not converge.
    NotConverged,
    /// The contact was refused.
    #[default]
    Refused,
}

impl RowStatus {
    /// Returns the word used in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::NotConverged => "not converged",
            Self::Refused => "refused",
        }
    }
}

/// Reason why a contact in a table is refused. It is stored as text so that it can be sent between machines.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[error("{0}")]
pub struct RefusedContact(String);

impl RefusedContact {
    /// Stores the message of a reason.
    pub fn of(why: &impl Display) -> Self {
        Self(why.to_string())
    }
}

impl From<RefusedContact> for RunError {
    fn from(refused: RefusedContact) -> Self {
        Self::Study(refused.0)
    }
}

/// Results of a contact by several methods, or the reason why it is refused.
pub type ByMethods = Result<Vec<ContactResult>, RefusedContact>;

/// Returns the text columns for contacts solved by several methods: status, reason, warnings.
pub fn remarks<'a>(rows: impl Iterator<Item = &'a ByMethods> + Clone) -> Vec<(&'static str, Vec<String>)> {
    let converged = |results: &[ContactResult]| results.iter().all(|result| result.converged);
    let status = |row: &ByMethods| match row {
        Ok(results) if converged(results) => RowStatus::Converged,
        Ok(_) => RowStatus::NotConverged,
        Err(_) => RowStatus::Refused,
    };
    let reason = |row: &ByMethods| match row {
        Ok(results) if converged(results) => String::new(),
        Ok(results) => ContactResult::warning_of_all(results),
        Err(why) => why.to_string(),
    };
    let warning = |row: &ByMethods| match row {
        Ok(results) => ContactResult::warning_of_all(results),
        Err(why) => why.to_string(),
    };
    vec![
        (names::STATUS, rows.clone().map(|row| status(row).name().to_owned()).collect()),
        (names::REASON, rows.clone().map(reason).collect()),
        (names::WARNING, rows.map(warning).collect()),
    ]
}

/// Row of a table: the result of one contact.
#[derive(Debug, Default)]
pub struct ContactRow {
    /// Status of the solve.
    pub status: RowStatus,
    /// Reason why it did not converge or is refused; empty if it converged.
    pub reason: String,
    /// Its answer; `None` if it is refused.
    pub answer: Option<Answer>,
}

impl ContactRow {
    /// Solves the contact of a row. A refusal is stored as a sentence in the row.
    ///
    /// # Errors
    /// If a model is not available, which affects all rows, or if the observer cancels.
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

    /// Writes the values of the named columns, NaN for missing ones. A refused contact counts as not converged.
    pub fn fill(&self, columns: &[&str], numbers: &mut [f64]) {
        let number = |column: &str| match &self.answer {
            Some(answer) => answer.result.value(column),
            None => (column == names::CONVERGED).then_some(0.0),
        };
        for (place, column) in numbers.iter_mut().zip(columns) {
            *place = number(column).unwrap_or(f64::NAN);
        }
    }

    /// Returns the warnings of the result, or the reason why the contact is refused.
    pub fn warning(&self) -> String {
        self.answer.as_ref().map_or_else(|| self.reason.clone(), |answer| answer.result.warning())
    }
}
