//! Campaigns: the work of one scene divided into shards that any number of processes and machines compute. The merged
//! result is byte for byte that of a single machine.
//!
//! A campaign is a folder, and its files are its complete state. A process that crashes does no harm:
//!
//! ```text
//! campaign.ron            plan, with hashes of program, scene and models                  ([`plan`])
//! scene.ron, model_0.rom  the scene and all files that it refers to
//! rounds/000.ron          pieces of the study, or contacts of the training, and shard size
//! rounds/000.training     state of a training between rounds
//! shards/000017.shard     result of a shard: written to a temporary file, then renamed    ([`compute`])
//! result/                 outcome and tables, or the model                                ([`merge`])
//! slurm.sh                script for clusters with Slurm                                  ([`slurm`])
//! ```
//!
//! A divisible study ([`Divisible`](crate::scene::study::Divisible)) has one round, or a second one that depends on the
//! first. A training has one round for every set of full solutions that it selects. Between rounds, [`merge`] selects
//! the next set and computes the bases.

pub mod compute;
mod document;
mod error;
mod folder;
pub mod local;
pub mod merge;
pub mod plan;
mod program;
mod round;
pub mod shard;
pub mod slurm;
#[cfg(test)]
mod tests;
pub mod watch;

pub use document::{Campaign, Cut};
pub use error::CampaignError;
pub use folder::{Folder, Status};
