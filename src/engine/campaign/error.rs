//! Errors of campaigns.

use crate::engine::EngineError;
use crate::scene::atomic_file::WriteError;
use std::path::PathBuf;

/// Reason why a campaign stopped. Finished shards are kept.
#[derive(Debug, thiserror::Error)]
pub enum CampaignError {
    /// The scene is refused, or its computation fails.
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
        /// Reason given by the system.
        reason: String,
    },
    /// A file has invalid content.
    #[error("{} is refused: {reason}", path.display())]
    Document {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what is accepted.
        reason: String,
    },
    /// The folder contains no campaign.
    #[error("{} holds no campaign; `campaign plan CAMPAIGN.ron --out DIR` makes one", path.display())]
    None {
        /// The folder.
        path: PathBuf,
    },
    /// The folder contains another campaign.
    #[error("{} already contains the campaign “{title}”; continue that one or choose another folder", path.display())]
    Taken {
        /// The folder.
        path: PathBuf,
        /// Title of the other campaign.
        title: String,
    },
    /// Another build of the program, whose results may differ.
    #[error(
        "the campaign was planned by another build of the program (version {version}, {planned}; this is {own}); continue with that build or plan the campaign again"
    )]
    OtherProgram {
        /// Version of the other program.
        version: String,
        /// Hash of the other program.
        planned: String,
        /// Hash of this program.
        own: String,
    },
    /// A file of the campaign has changed since planning.
    #[error("{} has changed since the campaign was planned; restore it or plan the campaign again", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
    },
    /// There is no such shard.
    #[error("there is no shard {shard}; so far the campaign has {shards}, numbered from 0")]
    NoShard {
        /// Requested shard.
        shard: usize,
        /// Number of shards.
        shards: usize,
    },
    /// A shard's file is not valid.
    #[error("{} cannot be merged: {reason}; delete it and compute that shard again", path.display())]
    Shard {
        /// The file.
        path: PathBuf,
        /// Reason.
        reason: String,
    },
    /// Shards are missing.
    #[error(
        "{missing} of {shards} shards are missing, the first of them is shard {first}; compute them, then merge again"
    )]
    Gaps {
        /// Number of missing shards.
        missing: usize,
        /// Number of all shards.
        shards: usize,
        /// First missing shard.
        first: usize,
    },
    /// A shard could not be computed on this machine.
    #[error("shard {shard} was given up after {attempts} attempts: {reason}")]
    GivenUp {
        /// Number of the shard.
        shard: usize,
        /// Number of attempts.
        attempts: usize,
        /// Reason of the last failure.
        reason: String,
    },
    /// A process could not be started.
    #[error("cannot start {}: {reason}", program.display())]
    Start {
        /// The program.
        program: PathBuf,
        /// Reason given by the system.
        reason: std::io::Error,
    },
}
