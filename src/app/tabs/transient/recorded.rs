//! Rows of the last transient study, from which the Results tab makes its verdicts, charts and tables.

use super::setup::Setup;
use crate::host::clock::Stopwatch;
use crate::scene::StudyRow;
use crate::scene::study::transient::Row;
use std::sync::Arc;

/// Rows of a transient study without fields.
pub struct Recorded {
    /// Number of the study in this window, from 1.
    pub number: u64,
    /// Set-up of the runs.
    pub setup: Arc<Setup>,
    /// True if the user started the runs.
    pub by_hand: bool,
    /// Rows so far.
    pub rows: Vec<StudyRow>,
    /// End of the runs. `None` while they are computed.
    pub end: Option<End>,
    /// True after a stop request.
    stopping: bool,
    begun: Stopwatch,
}

/// End of runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// True if the runs ended by themselves and without an error.
    pub complete: bool,
    /// Time of all runs \[s\].
    pub wall_s: f64,
}

impl Recorded {
    /// Starts the record of a study that follows another one.
    pub fn begin(setup: &Arc<Setup>, before: Option<&Self>) -> Self {
        Self {
            number: before.map_or(0, |before| before.number) + 1,
            setup: Arc::clone(setup),
            by_hand: false,
            rows: Vec::new(),
            end: None,
            stopping: false,
            begun: Stopwatch::start(),
        }
    }

    /// Stores a row. Fields occur in no value and no table.
    pub fn push(&mut self, row: &Row) {
        if !matches!(row, Row::State { .. }) {
            self.rows.push(StudyRow::Transient(row.clone()));
        }
    }

    /// Records a stop request.
    pub fn stopping(&mut self) {
        self.stopping = true;
    }

    /// Records the end. `failed` is true after an error.
    pub fn end(&mut self, failed: bool) {
        if self.end.is_none() {
            let complete = !failed && !self.stopping;
            self.end = Some(End { complete, wall_s: self.begun.seconds() });
        }
    }
}
