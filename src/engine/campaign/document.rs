//! The documents of a campaign: what people write, and what was planned.

use super::error::CampaignError;
use super::program::read;
use crate::scene::{Scene, Study};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Version of the files of a campaign.
pub(super) const VERSION: u32 = 1;
/// Shortest shards that may be asked for \[s\]: what a scheduler adds to each is to be next to nothing.
const SHORTEST_S: f64 = 10.0;
/// Longest shards \[s\].
const LONGEST_S: f64 = 86_400.0;

/// A campaign as people write it, in RON.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Campaign {
    /// Version of the format, 1.
    pub version: u32,
    /// The scene whose work it is; relative to the campaign's folder.
    pub scene: PathBuf,
    /// How its work is cut.
    #[serde(default)]
    pub shard: Cut,
}

/// How large a shard is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Cut {
    /// Of about so many seconds on this machine, by some pieces that are tried; from 10 to a day.
    Seconds(f64),
    /// Of so many pieces.
    Pieces(usize),
}

impl Default for Cut {
    fn default() -> Self {
        Self::Seconds(30.0)
    }
}

/// What was planned, as the folder of the campaign keeps it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Version of the files.
    pub version: u32,
    /// The scene's title.
    pub title: String,
    /// What results are called: the name of the scene's file.
    pub name: String,
    /// Version of the program.
    pub program: String,
    /// Its hash.
    pub program_hash: String,
    /// Files that the work depends on, with their hashes.
    pub files: Vec<(String, String)>,
    /// Pieces of a shard.
    pub per_shard: usize,
    /// Seconds that a piece took when it was tried; none where none was.
    pub seconds_per_piece: Option<f64>,
}

impl Campaign {
    /// Reads a campaign's document.
    ///
    /// # Errors
    /// When it cannot be read, with line and column where it is wrong, or naming the field that makes no sense.
    pub fn read(path: &Path) -> Result<Self, CampaignError> {
        let refused = |reason: String| CampaignError::Document { path: path.to_owned(), reason };
        let text = String::from_utf8(read(path)?).map_err(|_| refused("it is not UTF-8 text".to_owned()))?;
        let campaign: Self = ron::from_str(&text).map_err(|error| {
            let at = error.span.start;
            refused(format!("line {}, column {}: {}", at.line, at.col, error.code))
        })?;
        if campaign.version != VERSION {
            return Err(refused(format!("its version is {}, this program reads {VERSION}", campaign.version)));
        }
        match campaign.shard {
            Cut::Seconds(seconds) if !(SHORTEST_S..=LONGEST_S).contains(&seconds) => {
                Err(refused(format!("`shard` is Seconds({seconds}), but must be between {SHORTEST_S} and {LONGEST_S}")))
            }
            Cut::Pieces(0) => Err(refused("`shard` is Pieces(0), but must be at least 1".to_owned())),
            _ => Ok(campaign),
        }
    }
}

/// Whether a scene asks for a training.
pub fn trains(scene: &Scene) -> bool {
    matches!(scene.study, Study::Training(_))
}
