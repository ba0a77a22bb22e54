//! Sweep of a contact specification along one or two of its fields, for the command line and Python.

use super::answer::Request;
use super::axis::{GradingError, Steps};
use super::bench::Bench;
use super::check::MAX_POINTS;
use super::contact_result::{ContactResult, contact_columns_after, result_columns};
use super::contact_row::{ContactRow, RefusedContact, RowStatus};
use super::contact_spec::{ContactSpec, Field, NotVaried, Refusal, Words};
use super::error::RunError;
use super::extras::Extras;
use super::names;
use super::table::Table;
use crate::solver::observer::Progress;
use crate::solver::training::TrainingObserver;
use crate::solver::warning::{Repeated, Warning};
use std::str::FromStr;

/// Syntax of varied options, for messages.
const SHAPE: &str = "write NAME=FROM:TO:N, as in moes-m=10:100:19, with :log for a constant ratio or :graded:HALF for half \
                     of the values up to HALF";

/// Error: a text is not a valid varied option.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VariedError {
    /// The form is wrong.
    #[error("{SHAPE}")]
    Shape,
    /// An end is not a number.
    #[error("`{0}` is not a number; {SHAPE}")]
    Number(String),
    /// The number of values is not a whole number.
    #[error("`{0}` is not a number of values; {SHAPE}")]
    Count(String),
    /// An end is not finite.
    #[error("{0} to {1} is not a finite range; {SHAPE}")]
    Infinite(f64, f64),
    /// Too many values, or none.
    #[error("{0} values are requested; between 1 and {MAX_POINTS} are accepted")]
    TooMany(usize),
    /// Constant ratio between ends that are not both positive.
    #[error("a constant ratio needs positive ends; leave out :log")]
    Ratio,
    /// The grading is inconsistent.
    #[error(transparent)]
    Grading(#[from] GradingError),
    /// No numeric field has this name.
    #[error(transparent)]
    Word(#[from] NotVaried),
}

/// Varied option with the values it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// The field.
    pub field: Field,
    /// Its values.
    pub steps: Steps,
}

impl Varied {
    /// Returns the field with this name and its values.
    ///
    /// # Errors
    /// If no numeric field has this name.
    pub fn new(name: &str, steps: Steps) -> Result<Self, VariedError> {
        Ok(Self { field: Field::varied(name)?, steps })
    }
}

impl FromStr for Varied {
    type Err = VariedError;

    /// Reads `NAME=FROM:TO:N[:log|:graded:HALF]`.
    fn from_str(text: &str) -> Result<Self, VariedError> {
        let (name, range) = text.split_once('=').ok_or(VariedError::Shape)?;
        let parts: Vec<&str> = range.split(':').collect();
        let (ends, log, half) = match parts.as_slice() {
            [from, to, n] => ((*from, *to, *n), false, None),
            [from, to, n, "log"] => ((*from, *to, *n), true, None),
            [from, to, n, "graded", half] => ((*from, *to, *n), false, Some(*half)),
            _ => return Err(VariedError::Shape),
        };
        let number = |text: &str| text.parse::<f64>().map_err(|_| VariedError::Number(text.to_owned()));
        let (from, to) = (number(ends.0)?, number(ends.1)?);
        let n: usize = ends.2.parse().map_err(|_| VariedError::Count(ends.2.to_owned()))?;
        if !(from.is_finite() && to.is_finite()) {
            return Err(VariedError::Infinite(from, to));
        }
        if !(1..=MAX_POINTS).contains(&n) {
            return Err(VariedError::TooMany(n));
        }
        if log && !(from > 0.0 && to > 0.0) {
            return Err(VariedError::Ratio);
        }
        let steps = match half.map(number).transpose()? {
            Some(half) => {
                Steps::check_grading(from, half, to)?;
                Steps::Graded { from, half, to, n }
            }
            None if log => Steps::Log { from, to, n },
            None => Steps::Linear { from, to, n },
        };
        Self::new(name, steps)
    }
}

/// Contacts along one or two varied options, not yet solved.
pub struct ContactSweep {
    names: Vec<String>,
    /// Varied values of each contact, and its request or the reason why it is refused.
    points: Vec<(Vec<f64>, Result<Request, Refusal>)>,
    /// Option names used in refusals.
    words: Words,
}

/// Solved contact of a sweep with its varied options.
pub struct SweptContact<'a> {
    /// Names of the varied options.
    pub names: &'a [String],
    /// Values of the varied options.
    pub values: &'a [f64],
    /// Result of the contact.
    pub row: &'a ContactRow,
}

/// Result of a sweep.
pub struct Swept {
    /// Table with one row per contact: varied values, contact and result as numbers (NaN if it did not converge or is
    /// refused); status, reason and warnings as text.
    pub table: Table,
    /// Number of contacts that did not converge.
    pub failures: usize,
    /// Number of refused contacts, with the reason for the first one.
    pub refused: Option<(usize, String)>,
    /// Kinds of warnings, each with the number of contacts that have it.
    pub warnings: Vec<Repeated>,
}

impl ContactSweep {
    /// Builds the contacts for all combinations of the varied fields; the last field varies fastest. `words` are the
    /// option names of the interface, for refusals.
    ///
    /// # Errors
    /// If all contacts are refused, or if there are too many.
    pub fn new(varied: &[Varied], contact: &ContactSpec, words: Words) -> Result<Self, Refusal> {
        let product = varied.iter().try_fold(1usize, |product, v| product.checked_mul(v.steps.len()));
        if product.is_none_or(|points| points > MAX_POINTS) {
            let field = varied.first().map_or(Field::Contact, |axis| axis.field);
            let sentence = format!("the sweep has too many points; at most {MAX_POINTS} are accepted");
            return Err(Refusal::new(field, sentence));
        }
        let point = |values: Vec<f64>| {
            let mut contact = contact.clone();
            varied.iter().zip(&values).for_each(|(axis, value)| contact.set_as_typed(axis.field, *value));
            (values, contact.request())
        };
        let tuples = Steps::combinations(varied.iter().map(|axis| &axis.steps));
        let points: Vec<_> = tuples.into_iter().map(point).collect();
        match points.first() {
            Some((_, Err(first))) if points.iter().all(|(_, request)| request.is_err()) => Err(first.clone()),
            _ => Ok(Self { names: varied.iter().map(|axis| names::of_field(axis.field)).collect(), points, words }),
        }
    }

    /// Solves the contacts, each with its neighbour as initial guess. `tell` receives each contact as soon as it is
    /// solved.
    ///
    /// # Errors
    /// If all contacts are refused, a model is not available, the observer cancels, or `tell` returns an error.
    pub fn solve<E: From<RunError>>(
        self,
        bench: &mut dyn Bench,
        observer: &dyn TrainingObserver,
        mut tell: impl FnMut(SweptContact<'_>) -> Result<(), E>,
    ) -> Result<Swept, E> {
        let lubricants = self.points.iter().filter_map(|(_, request)| Some(&request.as_ref().ok()?.lubricant));
        let columns = [contact_columns_after(&self.names), result_columns(Extras::of(lubricants))].concat();
        let titles: Vec<&str> = self.names.iter().map(String::as_str).chain(columns.iter().copied()).collect();
        let mut table = Table::new("sweep", &titles);
        let (mut former, mut results, total) = (None, Vec::<ContactResult>::new(), self.points.len());
        let (mut statuses, mut reasons, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
        for (i, (values, request)) in self.points.into_iter().enumerate() {
            observer.progress(Progress { stage: "sweep".to_owned(), done: i, total });
            let request = request.as_ref().map_err(|refusal| refusal.in_words(self.words));
            let row = ContactRow::solve(request, |request| bench.answer(request, former.as_ref(), observer))?;
            tell(SweptContact { names: &self.names, values: &values, row: &row })?;
            let mut numbers = vec![f64::NAN; columns.len()];
            row.fill(&columns, &mut numbers);
            table.rows.push([values, numbers].concat());
            warnings.push(row.warning());
            statuses.push(row.status);
            reasons.push(row.reason);
            if let Some(answer) = row.answer {
                results.push(answer.result.clone());
                former = answer.into_fields().or(former);
            }
        }
        let count = |status: RowStatus| statuses.iter().filter(|own| **own == status).count();
        let failures = count(RowStatus::NotConverged);
        let first = statuses.iter().position(|status| *status == RowStatus::Refused);
        let refused = first.and_then(|first| Some((count(RowStatus::Refused), reasons.get(first)?.clone())));
        if let Some((_, first)) = refused.as_ref().filter(|(count, _)| *count == total) {
            return Err(RunError::from(RefusedContact::of(first)).into());
        }
        let statuses = statuses.iter().map(|status| status.name().to_owned()).collect();
        table.remarks = vec![(names::STATUS, statuses), (names::REASON, reasons), (names::WARNING, warnings)];
        let warnings = Warning::summary(results.iter().map(|result| &result.warnings[..]));
        Ok(Swept { table, failures, refused, warnings })
    }
}
