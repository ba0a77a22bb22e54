//! Trait that every study implements, and the services that it receives.

pub use crate::scene::chart::{Chart, ChartAxis, Marks};
pub(super) use crate::scene::check::Checked;
pub use crate::scene::error::RunError;
pub use crate::scene::experiment::Experiment;
pub use crate::scene::notice::Notice;
pub use crate::scene::outcome::Findings;
pub use crate::scene::table::{Column, Table};

use crate::scene::bench::Bench;
use crate::scene::method::Method;
use crate::solver::observer::Progress;
use crate::solver::training::TrainingObserver;

/// Study of an experiment. Its rows are its complete result: values, tables and charts are computed from them, also
/// while it is running.
pub trait Question: Sync {
    /// Row of the result.
    type Row;

    /// Refuses invalid values, and names the field.
    ///
    /// # Errors
    /// With the first invalid field.
    fn check(&self, experiment: &Experiment) -> Checked;

    /// Returns the methods that the study uses, in order.
    fn methods(&self) -> &[Method] {
        &[]
    }

    /// Runs the study, and passes each row to `tell` as soon as it is computed.
    ///
    /// # Errors
    /// If something is refused or the observer cancels. A solve that does not converge is a row.
    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Self::Row>) -> Result<(), RunError>;

    /// Evaluates the rows.
    fn findings(&self, experiment: &Experiment, rows: &[&Self::Row], found: &mut Findings);

    /// Returns the rows as tables.
    fn tables(&self, rows: &[&Self::Row]) -> Vec<Table>;

    /// Returns charts of the rows.
    fn charts(&self, rows: &[&Self::Row]) -> Vec<Chart>;
}

/// Study that can be divided into independent pieces, so that several machines can compute it together. The rows are
/// bitwise the same as those of a single run.
pub trait Divisible: Question {
    /// Returns the pieces of a round as numbers defined by the study, in the order of their rows; empty after the last
    /// round. A round may depend on the rows of the rounds `before` it.
    ///
    /// # Errors
    /// If something is refused.
    fn pieces(&self, setting: &mut Setting<'_>, round: usize, before: &[&Self::Row]) -> Result<Vec<usize>, RunError>;

    /// Computes some pieces of a round.
    ///
    /// # Errors
    /// As [`Question::run`].
    fn work(
        &self,
        setting: &mut Setting<'_>,
        round: usize,
        pieces: &[usize],
        tell: &Tell<'_, Self::Row>,
    ) -> Result<(), RunError>;

    /// Returns the measured times in a row, the only difference between two runs.
    fn seconds(row: &mut Self::Row) -> Vec<&mut f64>;

    /// Returns the methods that it uses, so that their models can be replaced.
    fn methods_mut(&mut self) -> &mut [Method];
}

/// Function that receives rows.
pub type Tell<'a, Row> = dyn Fn(Row) + Sync + 'a;

/// Experiment, bench and observer of a study.
pub struct Setting<'a> {
    /// Contact and solver settings.
    pub experiment: &'a Experiment,
    /// Services for solving contacts.
    pub bench: &'a mut dyn Bench,
    /// Observer of the progress, which may cancel.
    pub observer: &'a dyn TrainingObserver,
    /// True if fields of transient contacts are requested as rows.
    pub wants_states: bool,
}

impl Setting<'_> {
    /// Reports the progress of a stage, and stops if the observer has cancelled.
    ///
    /// # Errors
    /// If the observer has cancelled.
    pub fn step(&self, stage: &str, done: usize, total: usize) -> Result<(), RunError> {
        self.observer.progress(Progress { stage: stage.to_owned(), done, total });
        if self.observer.cancelled() { Err(RunError::Cancelled) } else { Ok(()) }
    }
}
