//! `info`: what a reduced model holds.

use super::failure::Failure;
use super::output;
use super::verdict::Verdict;
use crate::engine::arrays::npz;
use crate::engine::{EngineError, SavedModel, model_arrays, model_text};
use crate::scene::atomic_file;
use clap::Args;
use std::path::PathBuf;

/// Options of `info`.
#[derive(Debug, Args)]
pub struct InfoArgs {
    /// The reduced model
    #[arg(value_name = "FILE.rom")]
    file: PathBuf,
    /// Write its bases, sampled rows and snapshots as arrays that numpy reads
    #[arg(long, value_name = "FILE.npz")]
    arrays: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: &InfoArgs) -> Result<Verdict, Failure> {
    let path = &args.file;
    let model =
        SavedModel::read(path).map_err(|reason| EngineError::Model { path: path.clone(), reason: reason.into() })?;
    let (holds, text) = match &model {
        SavedModel::Stationary(model) => (model_arrays::of_model(model), model_text::describe(model)),
        SavedModel::InTime(model) => (model_arrays::of_trajectories(model), model_text::describe_in_time(model)),
    };
    if let Some(file) = &args.arrays {
        atomic_file::replace(file, &npz(&holds))?;
    }
    output::print(&text)?;
    Ok(Verdict::Done)
}
