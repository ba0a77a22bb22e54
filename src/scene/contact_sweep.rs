//! A sweep of a stated contact along one or two of its fields, on the command line and in Python.

use super::answer::Request;
use super::axis::Steps;
use super::bench::Bench;
use super::check::MAX_POINTS;
use super::contact_result::{ContactResult, contact_columns_after, result_columns};
use super::contact_spec::{ContactSpec, Field, Refusal};
use super::error::RunError;
use super::names;
use super::table::Table;
use crate::solver::observer::Progress;
use crate::solver::training::TrainingObserver;
use crate::solver::warning::Warning;
use std::str::FromStr;

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
    /// A sentence when no number has that word.
    pub fn new(name: &str, steps: Steps) -> Result<Self, String> {
        Ok(Self { field: Field::varied(name)?, steps })
    }
}

impl FromStr for Varied {
    type Err = String;

    /// Reads `NAME=FROM:TO:N[:log|:graded:HALF]`.
    fn from_str(text: &str) -> Result<Self, String> {
        let shape = "write NAME=FROM:TO:N, as in moes-m=10:100:19, with :log for a constant ratio or :graded:HALF for half \
                     of the values up to HALF";
        let (name, range) = text.split_once('=').ok_or(shape)?;
        let parts: Vec<&str> = range.split(':').collect();
        let (ends, log, half) = match parts.as_slice() {
            [from, to, n] => ((*from, *to, *n), false, None),
            [from, to, n, "log"] => ((*from, *to, *n), true, None),
            [from, to, n, "graded", half] => ((*from, *to, *n), false, Some(*half)),
            _ => return Err(shape.to_owned()),
        };
        let number = |text: &str| text.parse::<f64>().map_err(|_| format!("`{text}` is no number; {shape}"));
        let (from, to) = (number(ends.0)?, number(ends.1)?);
        let n: usize = ends.2.parse().map_err(|_| format!("`{}` is no count; {shape}", ends.2))?;
        if !(from.is_finite() && to.is_finite()) {
            return Err(format!("{from} to {to} is no finite range; {shape}"));
        }
        if !(1..=MAX_POINTS).contains(&n) {
            return Err(format!("{n} values are asked for; between 1 and {MAX_POINTS} are accepted"));
        }
        if log && !(from > 0.0 && to > 0.0) {
            return Err("a constant ratio needs positive ends; leave out :log".to_owned());
        }
        let steps = match half.map(number).transpose()? {
            Some(half) => {
                Steps::check_grading(from, half, to).map_err(|error| error.to_string())?;
                Steps::Graded { from, half, to, n }
            }
            None if log => Steps::Log { from, to, n },
            None => Steps::Linear { from, to, n },
        };
        Self::new(name, steps)
    }
}

/// Contacts along one or two varied options, checked and not yet solved.
pub struct ContactSweep {
    names: Vec<String>,
    /// The varied values of each contact, and the contact.
    pub points: Vec<(Vec<f64>, Request)>,
}

/// What a sweep gave.
pub struct Swept {
    /// A row for each contact: varied values, the contact, its result (NaN if it did not converge), its warnings.
    pub table: Table,
    /// How many did not converge.
    pub failures: usize,
    /// How many carry each kind of warning.
    pub warnings: Vec<String>,
}

impl ContactSweep {
    /// The contacts of which some fields are varied, the last one fastest.
    ///
    /// # Errors
    /// When one of them is refused, or there are too many.
    pub fn new(varied: &[Varied], contact: &ContactSpec) -> Result<Self, Refusal> {
        let product = varied.iter().try_fold(1usize, |product, v| product.checked_mul(v.steps.len()));
        if product.is_none_or(|points| points > MAX_POINTS) {
            let field = varied.first().map_or(Field::Contact, |axis| axis.field);
            let sentence = format!("the sweep has too many points; at most {MAX_POINTS} are accepted");
            return Err(Refusal::new(field, sentence));
        }
        let point = |values: Vec<f64>| {
            let mut contact = contact.clone();
            varied.iter().zip(&values).for_each(|(axis, value)| contact.set(axis.field, *value));
            Ok((values, contact.request()?))
        };
        let tuples = Steps::combinations(varied.iter().map(|axis| &axis.steps));
        let points = tuples.into_iter().map(point).collect::<Result<_, Refusal>>()?;
        Ok(Self { names: varied.iter().map(|axis| names::of_field(axis.field)).collect(), points })
    }

    /// Solves them, each from its neighbour; `tell` is shown each result.
    ///
    /// # Errors
    /// When one is refused, the observer cancels, or `tell` refuses to hear more.
    pub fn solve<E: From<RunError>>(
        self,
        bench: &mut dyn Bench,
        observer: &dyn TrainingObserver,
        mut tell: impl FnMut(&ContactResult) -> Result<(), E>,
    ) -> Result<Swept, E> {
        let heat = self.points.iter().any(|(_, request)| request.lubricant.heat.is_some());
        let columns = [contact_columns_after(&self.names), result_columns(heat)].concat();
        let titles: Vec<&str> = self.names.iter().map(String::as_str).chain(columns.iter().copied()).collect();
        let mut table = Table::new("sweep", &titles);
        let (mut former, mut results, total) = (None, Vec::new(), self.points.len());
        for (i, (values, request)) in self.points.into_iter().enumerate() {
            observer.progress(Progress { stage: "sweep".to_owned(), done: i, total });
            let answer = bench.answer(&request, former.as_ref(), observer)?;
            let result = answer.result.clone();
            tell(&result)?;
            table.rows.push(values.into_iter().chain(result.row(&columns)).collect());
            results.push(result);
            former = answer.into_fields().or(former);
        }
        let failures = results.iter().filter(|result| !result.converged).count();
        let warnings = || results.iter().map(|result| &result.warnings[..]);
        Ok(Swept { table: table.with_warnings(warnings()), failures, warnings: Warning::summary(warnings()) })
    }
}
