//! Campaigns: one scene's work in shards that any number of processes and machines compute, and that come together
//! byte for byte as one machine would have made them.
//!
//! A campaign is a folder, and all its state is files in it; whoever dies, dies without harm:
//!
//! ```text
//! campaign.ron            what was planned, with hashes of program, scene and models      ([`plan`])
//! scene.ron, model_0.rom  the scene and all that it refers to
//! rounds/000.ron          pieces of the study, or contacts of the training, and how they are cut into shards
//! shards/000017.shard     what came of a shard: written beside, then put in its place      ([`compute`])
//! result/                 outcome and tables, or the model                                 ([`merge`])
//! slurm.sh                the same on a cluster under Slurm                                ([`slurm`])
//! ```
//!
//! A study that falls into pieces ([`Divisible`](crate::scene::study::Divisible)) has one round, or a second one that
//! follows from the first. A training has a round for every set of full solutions that it decides on; what it decides,
//! and the bases, are worked out between rounds by [`merge`].

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
