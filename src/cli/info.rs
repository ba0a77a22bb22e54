//! Command `info`: contents of a reduced model.

use super::failure::Failure;
use super::model_argument::model_of;
use super::output::{self, ProgressLine};
use super::verdict::Verdict;
use crate::engine::arrays::npz;
use crate::engine::{SavedModel, model_arrays, model_snapshots, model_text};
use crate::scene::atomic_file;
use clap::Args;
use std::path::PathBuf;

/// Options of `info`.
#[derive(Debug, Args)]
pub struct InfoArgs {
    /// Reduced model: a file, or the name of an embedded model, such as line or point
    #[arg(value_name = "MODEL.rom")]
    model: PathBuf,
    /// Write its bases, sampled equations and snapshots as arrays for numpy
    #[arg(long, value_name = "FILE.npz")]
    arrays: Option<PathBuf>,
    /// Solve the training contacts in full again, and add their fields to the arrays
    #[arg(long, requires = "arrays")]
    snapshots: bool,
    /// Add the pressures after every Newton step of these solves
    #[arg(long, requires = "snapshots")]
    iterates: bool,
}

/// Message for transient models.
const TRANSIENT: &str = "a transient model was trained from the steps of marches, which its file does not contain; leave out \
                         --snapshots";

/// Runs the command.
pub fn run(args: &InfoArgs) -> Result<Verdict, Failure> {
    let (model, _) = model_of(&args.model)?;
    let (mut holds, text) = match &model {
        SavedModel::Stationary(model) => (model_arrays::of_model(model), model_text::describe(model)),
        SavedModel::InTime(model) => (model_arrays::of_trajectories(model), model_text::describe_in_time(model)),
    };
    match &model {
        SavedModel::Stationary(model) if args.snapshots => {
            let line = ProgressLine::new(true);
            for window in 1..=model.windows.len() {
                holds.extend(model_snapshots::solve(model, window, args.iterates, &line)?);
            }
            line.finish();
        }
        SavedModel::InTime(_) if args.snapshots => return Err(Failure::Request(TRANSIENT.to_owned())),
        _ => {}
    }
    if let Some(file) = &args.arrays {
        atomic_file::replace(file, &npz(&holds))?;
    }
    output::print(&text)?;
    Ok(Verdict::Done)
}
