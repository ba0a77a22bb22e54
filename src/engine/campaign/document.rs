//! Documents of a campaign: the input written by the user, and the plan.

use super::error::CampaignError;
use super::program::read;
use crate::scene::ron_message::message;
use crate::scene::{Scene, Study};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Version of the campaign files.
pub(super) const VERSION: u32 = 1;
/// Shortest accepted shard \[s\], so that the overhead of a scheduler is negligible.
const SHORTEST_S: f64 = 10.0;
/// Longest accepted shard \[s\].
const LONGEST_S: f64 = 86_400.0;

/// Campaign as written by the user, in RON.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Campaign {
    /// Version of the format, 1.
    pub version: u32,
    /// Scene to compute; relative to the folder of the campaign file.
    pub scene: PathBuf,
    /// Size of the shards.
    #[serde(default)]
    pub shard: Cut,
}

/// Size of a shard.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Cut {
    /// Approximate duration in seconds on this machine, based on trial pieces; from 10 s to one day.
    Seconds(f64),
    /// Number of pieces.
    Pieces(usize),
}

impl Default for Cut {
    fn default() -> Self {
        Self::Seconds(30.0)
    }
}

/// Plan, as stored in the campaign's folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Version of the campaign files.
    pub version: u32,
    /// The scene's title.
    pub title: String,
    /// Name of the results: the file name of the scene.
    pub name: String,
    /// Version of the program.
    pub program: String,
    /// Hash of the program.
    pub program_hash: String,
    /// Files that the work depends on, with their hashes.
    pub files: Vec<(String, String)>,
    /// Number of pieces per shard.
    pub per_shard: usize,
    /// Time per piece \[s\], measured on trial pieces; `None` if none was tried.
    pub seconds_per_piece: Option<f64>,
}

impl Campaign {
    /// Reads a campaign file.
    ///
    /// # Errors
    /// If it cannot be read, is not valid (with line and column), or has a field with an invalid value.
    pub fn read(path: &Path) -> Result<Self, CampaignError> {
        let refused = |reason: String| CampaignError::Document { path: path.to_owned(), reason };
        let text = String::from_utf8(read(path)?).map_err(|_| refused("it is not UTF-8 text".to_owned()))?;
        let campaign: Self = ron::from_str(&text).map_err(|error| {
            let at = error.span.start;
            refused(format!("line {}, column {}: {}", at.line, at.col, message(&error.code)))
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

/// Returns true if a scene is a training.
pub fn trains(scene: &Scene) -> bool {
    matches!(scene.study, Study::Training(_))
}
