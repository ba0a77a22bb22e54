//! `train`: a reduced model as a scene describes.

use super::failure::Failure;
use super::output::{self, ProgressLine};
use super::{Verdict, info};
use crate::harness::{HarnessError, model_file};
use crate::scene::{Scene, Study};
use crate::solver::training::train;
use clap::Args;
use std::path::PathBuf;

/// Options of `train`.
#[derive(Debug, Args)]
pub struct TrainArgs {
    /// The scene; its study must be a training
    #[arg(value_name = "SCENE.ron")]
    scene: PathBuf,
    /// Write the model here
    #[arg(long, value_name = "FILE.rom")]
    out: PathBuf,
}

/// Runs the command.
pub fn run(args: &TrainArgs) -> Result<Verdict, Failure> {
    let Study::Training(spec) = Scene::read(&args.scene)?.study else {
        return Err(HarnessError::NoTraining { path: args.scene.clone() }.into());
    };
    let folder = args.out.parent().filter(|folder| !folder.as_os_str().is_empty());
    if args.out.is_dir() || folder.is_some_and(|folder| !folder.is_dir()) {
        // Better now than after minutes of training.
        return Err(Failure::Request(format!(
            "cannot write {}: --out must name a file in a folder that exists",
            args.out.display()
        )));
    }
    let progress = ProgressLine::new(true);
    let trained = train(&spec, &progress);
    progress.finish();
    let model = trained.map_err(HarnessError::from)?;
    model_file::write(&model, &args.out).map_err(|reason| HarnessError::Model { path: args.out.clone(), reason })?;
    output::print(&info::describe(&model))?;
    Ok(Verdict::Done)
}
