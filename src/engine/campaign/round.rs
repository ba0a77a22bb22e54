//! Round of a campaign: its pieces, and their division into shards.

use super::CampaignError;
use super::program::hash_of;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Round, as stored in its file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Round {
    /// Number of its first shard.
    pub first: usize,
    /// Number of pieces per shard, except the last one.
    pub per_shard: usize,
    /// The pieces.
    pub pieces: Pieces,
}

/// The pieces of a round.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Pieces {
    /// Pieces of a study, numbered from 0 to n − 1.
    All(usize),
    /// Pieces of a study by their numbers.
    Chosen(Vec<usize>),
    /// Contacts that a training requests as full solutions on one grid, each with its place in the order.
    Contacts {
        /// Grid of all contacts.
        grid: GridSpec,
        /// The contacts.
        points: Vec<(usize, OperatingPoint)>,
    },
}

/// Pieces of one shard.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// Pieces of a study, by their numbers.
    Study(Vec<usize>),
    /// Contacts of a training.
    Training(GridSpec, Vec<(usize, OperatingPoint)>),
}

impl Pieces {
    /// Returns the pieces of a study.
    pub fn of_study(numbers: Vec<usize>) -> Self {
        if numbers.iter().copied().eq(0..numbers.len()) { Self::All(numbers.len()) } else { Self::Chosen(numbers) }
    }

    /// Returns the number of pieces.
    pub fn len(&self) -> usize {
        match self {
            Self::All(count) => *count,
            Self::Chosen(numbers) => numbers.len(),
            Self::Contacts { points, .. } => points.len(),
        }
    }
}

impl Round {
    /// Returns the number of shards.
    pub fn shards(&self) -> usize {
        self.pieces.len().div_ceil(self.per_shard.max(1))
    }

    /// Returns the pieces of a shard, given the shard's number in the campaign.
    pub fn part(&self, shard: usize) -> Part {
        let from = shard.saturating_sub(self.first).saturating_mul(self.per_shard).min(self.pieces.len());
        let to = from.saturating_add(self.per_shard).min(self.pieces.len());
        match &self.pieces {
            Pieces::All(_) => Part::Study((from..to).collect()),
            Pieces::Chosen(numbers) => Part::Study(numbers.get(from..to).unwrap_or_default().to_vec()),
            Pieces::Contacts { grid, points } => {
                Part::Training(*grid, points.get(from..to).unwrap_or_default().to_vec())
            }
        }
    }

    /// Returns the text of the round's file.
    ///
    /// # Errors
    /// Does not fail for planned rounds.
    pub fn to_text(&self, path: &Path) -> Result<String, CampaignError> {
        let text = ron::to_string(self).map_err(|error| CampaignError::Document {
            path: path.to_owned(),
            reason: format!("it cannot be written as text: {error}"),
        })?;
        Ok(text + "\n")
    }

    /// Reads the text of a round's file.
    ///
    /// # Errors
    /// If it is not valid.
    pub fn from_text(text: &str, path: &Path) -> Result<Self, CampaignError> {
        let refused = |reason: String| CampaignError::Document { path: path.to_owned(), reason };
        let round: Self = ron::from_str(text).map_err(|error| refused(error.to_string()))?;
        if round.per_shard == 0 || round.pieces.len() == 0 {
            return Err(refused("a round has at least one piece, and a shard as well".to_owned()));
        }
        if let Pieces::Contacts { points, .. } = &round.pieces {
            points.iter().try_for_each(|(_, point)| point.check()).map_err(|error| refused(error.to_string()))?;
        }
        Ok(round)
    }

    /// Returns the hash that identifies the shards of a round, from the hash of the campaign and the text of the round.
    pub fn hash(campaign: &str, text: &str) -> String {
        hash_of(format!("{campaign}\n{text}").as_bytes())
    }
}

impl Part {
    /// Returns the number of pieces.
    pub fn len(&self) -> usize {
        match self {
            Self::Study(numbers) => numbers.len(),
            Self::Training(_, points) => points.len(),
        }
    }
}
