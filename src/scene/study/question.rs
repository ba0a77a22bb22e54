//! What every study is made of, and what it is given.

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

/// A question about an experiment. Its rows are all that comes of it: values, tables and charts are read off them, also
/// while it runs.
pub trait Question: Sync {
    /// What it finds out, piece by piece.
    type Row;

    /// Refuses what makes no sense, naming the field.
    ///
    /// # Errors
    /// With the first such field.
    fn check(&self, experiment: &Experiment) -> Checked;

    /// The methods it uses, in order.
    fn methods(&self) -> &[Method] {
        &[]
    }

    /// Finds out, and tells each row as soon as it is known.
    ///
    /// # Errors
    /// When something is refused or the observer cancels. What does not converge is a row.
    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Self::Row>) -> Result<(), RunError>;

    /// What the rows say.
    fn findings(&self, experiment: &Experiment, rows: &[&Self::Row], found: &mut Findings);

    /// The rows in numbers.
    fn tables(&self, rows: &[&Self::Row]) -> Vec<Table>;

    /// How the rows are best looked at.
    fn charts(&self, rows: &[&Self::Row]) -> Vec<Chart>;
}

/// A question that falls into pieces which know nothing of each other, so that many machines can answer it together: the
/// same rows come of them, to the last bit, as of one run.
pub trait Divisible: Question {
    /// The pieces of a round, each by a number of the study's own, in the order of their rows; none behind the last
    /// round. What a round asks may follow from the rows of the rounds `before` it.
    ///
    /// # Errors
    /// When something is refused.
    fn pieces(&self, setting: &mut Setting<'_>, round: usize, before: &[&Self::Row]) -> Result<Vec<usize>, RunError>;

    /// Works out some pieces of a round.
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

    /// The seconds in a row: all that two runs of it differ by.
    fn seconds(row: &mut Self::Row) -> Vec<&mut f64>;

    /// The methods it uses, to be given other models.
    fn methods_mut(&mut self) -> &mut [Method];
}

/// Where rows go.
pub type Tell<'a, Row> = dyn Fn(Row) + Sync + 'a;

/// What a study is about, what it may use, and who watches.
pub struct Setting<'a> {
    /// Its contact.
    pub experiment: &'a Experiment,
    /// Whoever solves contacts.
    pub bench: &'a mut dyn Bench,
    /// Who is told how far it is, and may stop it.
    pub observer: &'a dyn TrainingObserver,
    /// Whether fields are wanted along the way.
    pub wants_states: bool,
}

impl Setting<'_> {
    /// Tells how far a stage is, and stops where that is wanted.
    ///
    /// # Errors
    /// When it is to stop.
    pub fn step(&self, stage: &str, done: usize, total: usize) -> Result<(), RunError> {
        self.observer.progress(Progress { stage: stage.to_owned(), done, total });
        if self.observer.cancelled() { Err(RunError::Cancelled) } else { Ok(()) }
    }
}
