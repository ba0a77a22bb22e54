//! A sweep of a stated contact along one or two of its fields, on the command line and in Python.

use super::answer::Request;
use super::axis::{GradingError, Steps};
use super::bench::Bench;
use super::check::MAX_POINTS;
use super::contact_result::{ContactResult, contact_columns_after, result_columns};
use super::contact_row::{ContactRow, RefusedContact, RowStatus};
use super::contact_spec::{ContactSpec, Field, NotVaried, Refusal, Words};
use super::error::RunError;
use super::names;
use super::table::Table;
use crate::solver::observer::Progress;
use crate::solver::training::TrainingObserver;
use crate::solver::warning::{Repeated, Warning};
use std::str::FromStr;

/// How varied options are written.
const SHAPE: &str = "write NAME=FROM:TO:N, as in moes-m=10:100:19, with :log for a constant ratio or :graded:HALF for half \
                     of the values up to HALF";

/// Why a text is no varied option.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VariedError {
    /// It is written in another way.
    #[error("{SHAPE}")]
    Shape,
    /// An end is no number.
    #[error("`{0}` is no number; {SHAPE}")]
    Number(String),
    /// The number of values is none.
    #[error("`{0}` is no count; {SHAPE}")]
    Count(String),
    /// An end is not finite.
    #[error("{0} to {1} is no finite range; {SHAPE}")]
    Infinite(f64, f64),
    /// There are too many values, or none.
    #[error("{0} values are asked for; between 1 and {MAX_POINTS} are accepted")]
    TooMany(usize),
    /// A constant ratio between ends that are not positive.
    #[error("a constant ratio needs positive ends; leave out :log")]
    Ratio,
    /// The grading does not fit.
    #[error(transparent)]
    Grading(#[from] GradingError),
    /// No number has that word.
    #[error(transparent)]
    Word(#[from] NotVaried),
}

/// One varied option and the values it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// The field.
    pub field: Field,
    /// Its values.
    pub steps: Steps,
}

impl Varied {
    /// A field by its word, and its values.
    ///
    /// # Errors
    /// When no number has that word.
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
    /// The varied values of each contact, and the contact or why it is refused.
    points: Vec<(Vec<f64>, Result<Request, Refusal>)>,
    /// Words of the refusals.
    words: Words,
}

/// One contact of a sweep with its varied options.
pub struct SweptContact<'a> {
    /// Names of the varied options.
    pub names: &'a [String],
    /// Their values.
    pub values: &'a [f64],
    /// What came of it.
    pub row: &'a ContactRow,
}

/// What a sweep gave.
pub struct Swept {
    /// A row for each contact: varied values, the contact and its result (NaN if it did not converge or is refused), and
    /// in words its status, the reason for it, and its warnings.
    pub table: Table,
    /// How many did not converge.
    pub failures: usize,
    /// How many are refused, with the reason of the first.
    pub refused: Option<(usize, String)>,
    /// How many carry each kind of warning.
    pub warnings: Vec<Repeated>,
}

impl ContactSweep {
    /// The contacts of which some fields are varied, the last one fastest. `words` are those of the interface.
    ///
    /// # Errors
    /// When all of them are refused, or there are too many.
    pub fn new(varied: &[Varied], contact: &ContactSpec, words: Words) -> Result<Self, Refusal> {
        let product = varied.iter().try_fold(1usize, |product, v| product.checked_mul(v.steps.len()));
        if product.is_none_or(|points| points > MAX_POINTS) {
            let field = varied.first().map_or(Field::Contact, |axis| axis.field);
            let sentence = format!("the sweep has too many points; at most {MAX_POINTS} are accepted");
            return Err(Refusal::new(field, sentence));
        }
        let point = |values: Vec<f64>| {
            let mut contact = contact.clone();
            varied.iter().zip(&values).for_each(|(axis, value)| contact.set(axis.field, *value));
            (values, contact.request())
        };
        let tuples = Steps::combinations(varied.iter().map(|axis| &axis.steps));
        let points: Vec<_> = tuples.into_iter().map(point).collect();
        match points.first() {
            Some((_, Err(first))) if points.iter().all(|(_, request)| request.is_err()) => Err(first.clone()),
            _ => Ok(Self { names: varied.iter().map(|axis| names::of_field(axis.field)).collect(), points, words }),
        }
    }

    /// Solves them, each from its neighbour; `tell` is shown each of them.
    ///
    /// # Errors
    /// When all of them are refused, a model cannot be had, the observer cancels, or `tell` refuses to hear more.
    pub fn solve<E: From<RunError>>(
        self,
        bench: &mut dyn Bench,
        observer: &dyn TrainingObserver,
        mut tell: impl FnMut(SweptContact<'_>) -> Result<(), E>,
    ) -> Result<Swept, E> {
        let warm = |request: &Request| request.lubricant.heat.is_some();
        let heat = self.points.iter().any(|(_, request)| request.as_ref().is_ok_and(warm));
        let columns = [contact_columns_after(&self.names), result_columns(heat)].concat();
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
