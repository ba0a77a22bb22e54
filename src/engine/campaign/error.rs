//! Why a campaign does not go on, each as one sentence.

use crate::engine::EngineError;
use crate::scene::atomic_file::WriteError;
use std::path::PathBuf;

/// Why a campaign does not go on. What is finished stays.
#[derive(Debug, thiserror::Error)]
pub enum CampaignError {
    /// The scene is refused, or its work ends with an error.
    #[error(transparent)]
    Run(#[from] EngineError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A file cannot be read.
    #[error("cannot read {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A file makes no sense.
    #[error("{} is refused: {reason}", path.display())]
    Document {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what would be accepted.
        reason: String,
    },
    /// A folder holds none.
    #[error("{} holds no campaign; `campaign plan CAMPAIGN.ron --out DIR` makes one", path.display())]
    None {
        /// The folder.
        path: PathBuf,
    },
    /// A folder holds another one.
    #[error("{} holds the campaign “{title}” already; go on with that one or choose another folder", path.display())]
    Taken {
        /// The folder.
        path: PathBuf,
        /// What is in it.
        title: String,
    },
    /// Another program's results may differ.
    #[error(
        "the campaign was planned by another build of the program (version {version}, {planned}; this is {own}); go on with that one or plan it anew"
    )]
    OtherProgram {
        /// Version of the other one.
        version: String,
        /// Its hash.
        planned: String,
        /// The hash of this one.
        own: String,
    },
    /// A file of the campaign was changed since it was planned.
    #[error("{} is not what it was when the campaign was planned; put it back or plan the campaign anew", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
    },
    /// There is no such shard.
    #[error("there is no shard {shard}; so far the campaign has {shards}, numbered from 0")]
    NoShard {
        /// What was asked for.
        shard: usize,
        /// How many there are.
        shards: usize,
    },
    /// A shard's file cannot be taken.
    #[error("{} cannot be merged: {reason}; delete it and compute that shard again", path.display())]
    Shard {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// Not all shards are there.
    #[error(
        "{missing} of {shards} shards are missing, the first of them is shard {first}; compute them, then merge again"
    )]
    Gaps {
        /// How many.
        missing: usize,
        /// Of how many.
        shards: usize,
        /// The first.
        first: usize,
    },
    /// A shard could not be computed here.
    #[error("shard {shard} was given up after {attempts} attempts: {reason}")]
    GivenUp {
        /// Which.
        shard: usize,
        /// How often it was tried.
        attempts: usize,
        /// What became of the last one.
        reason: String,
    },
    /// No process could be started.
    #[error("cannot start {}: {reason}", program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// Why.
        reason: std::io::Error,
    },
}
