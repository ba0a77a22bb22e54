//! Finished shard and its file.

use super::document::{Plan, VERSION};
use super::error::CampaignError;
use crate::engine::checked_file::{Flaw, Format, Unreadable};
use crate::scene::StudyRow;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::Solved;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// File format. The size limit corresponds to the full solutions of one day on the finest grids.
pub(super) const FORMAT: Format = Format { magic: b"EHLSHD\r\n", version: VERSION, max_payload: 2 << 30 };

/// Result of a shard.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Content {
    /// Rows of a study, in the order of their pieces, without measured times.
    Rows(Vec<StudyRow>),
    /// Contacts of a training with their full solutions; `None` if the solver did not converge.
    Contacts(Vec<(usize, OperatingPoint, Option<Solved>)>),
}

/// A finished shard.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Shard {
    /// Hash of the program that computed it.
    pub(super) program: String,
    /// Hashes of the campaign files.
    pub(super) files: Vec<String>,
    /// Hash that identifies the round.
    pub(super) round: String,
    /// Number of the shard.
    pub(super) number: usize,
    /// Number of pieces.
    pub(super) pieces: usize,
    /// Result: the same bytes on every machine.
    pub content: Content,
    /// Measured times of the rows, in order \[s\].
    pub times: Vec<f64>,
    /// Total time \[s\].
    pub seconds: f64,
    /// Type of the processor.
    pub processor: String,
}

impl Content {
    /// Removes the measured times from the rows, so that the rest is reproducible, and returns them.
    pub(super) fn take_seconds(&mut self) -> Vec<f64> {
        let Self::Rows(rows) = self else { return Vec::new() };
        let seconds = rows.iter_mut().flat_map(StudyRow::seconds);
        seconds.map(|seconds| std::mem::replace(seconds, f64::NAN)).collect()
    }

    /// Returns true if the contacts are valid and the solutions finite. A correct hash does not guarantee this.
    fn is_sound(&self) -> bool {
        match self {
            Self::Rows(rows) => rows.iter().all(StudyRow::is_sound),
            Self::Contacts(contacts) => contacts.iter().all(|(_, point, solved)| {
                let numbers = solved.iter().flat_map(|s| s.pressure.iter().chain([&s.h_0, &s.h_c]));
                point.check().is_ok() && numbers.into_iter().all(|number| number.is_finite())
            }),
        }
    }
}

impl Shard {
    /// Returns the rows with their measured times.
    pub fn rows(mut self) -> Vec<StudyRow> {
        let Content::Rows(rows) = &mut self.content else { return Vec::new() };
        let seconds = rows.iter_mut().flat_map(StudyRow::seconds);
        seconds.zip(&self.times).for_each(|(seconds, taken)| *seconds = *taken);
        std::mem::take(rows)
    }

    /// Reads a shard's file.
    pub(super) fn read(
        path: &Path,
        number: usize,
        (plan, round): (&Plan, &str),
        pieces: usize,
    ) -> Result<Self, CampaignError> {
        let refused = |reason: &str| CampaignError::Shard { path: path.to_owned(), reason: reason.to_owned() };
        let flawed = |flaw: Flaw| match flaw {
            Flaw::Foreign => refused("it is another kind of file"),
            Flaw::OtherVersion { .. } => refused("its format has another version"),
            Flaw::Truncated { .. } => refused("it is cut off"),
            Flaw::TooLarge { .. } => refused("it announces more bytes than any shard has"),
            Flaw::Changed => refused("its content does not match its hash"),
        };
        let bytes = FORMAT.read(path).map_err(|reason| match reason {
            Unreadable::Io(error) => CampaignError::Read { path: path.to_owned(), reason: error.to_string() },
            Unreadable::Flaw(flaw) => flawed(flaw),
        })?;
        let payload = FORMAT.open(&bytes).map_err(flawed)?;
        let shard: Self = postcard::from_bytes(payload).map_err(|_| refused("its content cannot be decoded"))?;
        let files = plan.files.iter().map(|(_, hash)| hash);
        if shard.program != plan.program_hash {
            Err(refused("it was computed by another build of the program"))
        } else if !shard.files.iter().eq(files) {
            Err(refused("it was computed for another scene or with another model"))
        } else if shard.round != round || shard.number != number {
            Err(refused("it belongs to another campaign or place"))
        } else if shard.pieces != pieces || !shard.content.is_sound() {
            Err(refused("its content contradicts itself"))
        } else {
            Ok(shard)
        }
    }
}
