//! A round of a campaign: what is computed in it, and how that is cut into shards.

use super::CampaignError;
use super::program::hash_of;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// A round as its file holds it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Round {
    /// Number of its first shard.
    pub first: usize,
    /// Pieces of each shard but the last one.
    pub per_shard: usize,
    /// What its pieces are.
    pub pieces: Pieces,
}

/// The pieces of a round.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Pieces {
    /// So many pieces of a study, numbered from 0.
    All(usize),
    /// Pieces of a study by their numbers.
    Chosen(Vec<usize>),
    /// Contacts that a training wants solved in full on one grid, each with its place in the order.
    Contacts {
        /// The grid of all.
        grid: GridSpec,
        /// The contacts.
        points: Vec<(usize, OperatingPoint)>,
    },
}

/// The pieces of one shard.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// Of a study, by their numbers.
    Study(Vec<usize>),
    /// Contacts of a training.
    Training(GridSpec, Vec<(usize, OperatingPoint)>),
}

impl Pieces {
    /// Pieces of a study.
    pub fn of_study(numbers: Vec<usize>) -> Self {
        if numbers.iter().copied().eq(0..numbers.len()) { Self::All(numbers.len()) } else { Self::Chosen(numbers) }
    }

    /// How many.
    pub fn len(&self) -> usize {
        match self {
            Self::All(count) => *count,
            Self::Chosen(numbers) => numbers.len(),
            Self::Contacts { points, .. } => points.len(),
        }
    }
}

impl Round {
    /// How many shards it has.
    pub fn shards(&self) -> usize {
        self.pieces.len().div_ceil(self.per_shard.max(1))
    }

    /// The pieces of one of its shards, by its number in the campaign.
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

    /// Its text, and the hash of it under the campaign's.
    ///
    /// # Errors
    /// Never for rounds that are planned.
    pub fn to_text(&self, path: &Path) -> Result<String, CampaignError> {
        let text = ron::to_string(self).map_err(|error| CampaignError::Document {
            path: path.to_owned(),
            reason: format!("it cannot be written as text: {error}"),
        })?;
        Ok(text + "\n")
    }

    /// Reads its text.
    ///
    /// # Errors
    /// When it makes no sense.
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

    /// What a shard of it is known by: the hash of the campaign, and of the round's own text.
    pub fn hash(campaign: &str, text: &str) -> String {
        hash_of(format!("{campaign}\n{text}").as_bytes())
    }
}

impl Part {
    /// Pieces in it.
    pub fn len(&self) -> usize {
        match self {
            Self::Study(numbers) => numbers.len(),
            Self::Training(_, points) => points.len(),
        }
    }
}
