//! `train`: a reduced model as a scene describes. What was solved is kept in `FILE.rom.training` until the model is
//! written, so that the same command goes on where a killed one stopped.

use super::failure::Failure;
use super::options::CavitationName;
use super::output::{self, ProgressLine};
use super::{Verdict, info};
use crate::engine::training_file::{self, TrainingKeeper};
use crate::engine::{EngineError, model_file};
use crate::scene::Scene;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::training::{Observer, Progress, TrainingObserver, TrainingState, train_resumable};
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
    /// How films rupture, in place of what the scene says
    #[arg(long, value_enum)]
    cavitation: Option<CavitationName>,
}

/// Runs the command.
pub fn run(args: &TrainArgs) -> Result<Verdict, Failure> {
    let mut scene = Scene::read(&args.scene)?;
    scene.cavitation = args.cavitation.map_or(scene.cavitation, Cavitation::from);
    let Some(spec) = scene.training() else {
        return Err(EngineError::NoTraining { path: args.scene.clone() }.into());
    };
    let kept = training_file::beside(&args.out);
    let folder = args.out.parent().filter(|folder| !folder.as_os_str().is_empty());
    if args.out.is_dir() || folder.is_some_and(|folder| !folder.is_dir()) {
        return Err(Failure::Request(format!(
            "cannot write {}: --out must name a file in a folder that exists",
            args.out.display()
        )));
    }
    // What would fail at the end fails here already.
    let keeper = TrainingKeeper::new(kept.clone()).map_err(EngineError::from)?;
    let mut state = match training_file::unfinished(&kept, &spec).map_err(EngineError::from)? {
        Some(state) => {
            let sentence = format!("going on with {}: {} full solutions are there", kept.display(), state.solutions());
            output::complain(&sentence);
            state
        }
        None => TrainingState::new(spec),
    };
    let watch = ProgressObserver { progress: ProgressLine::new(true), keeper };
    let trained = train_resumable(&mut state, &watch);
    watch.progress.finish();
    let keep = |keeper: TrainingKeeper| match keeper.keep(&state) {
        Err(reason) if state.solutions() > 0 => output::complain(&reason.to_string()),
        _ => {}
    };
    let model = match trained {
        Ok(model) => model,
        Err(error) => {
            keep(watch.keeper);
            return Err(EngineError::from(error).into());
        }
    };
    if let Err(reason) = model_file::write(&model, &args.out) {
        keep(watch.keeper);
        let refused = EngineError::Model { path: args.out.clone(), reason: reason.into() };
        let name = args.out.file_name().unwrap_or_default().to_string_lossy();
        let elsewhere = std::env::temp_dir().join(format!("{}-{name}", std::process::id()));
        return match model_file::write(&model, &elsewhere) {
            Ok(()) => {
                output::complain(&format!("{refused}; the model is in {} instead", elsewhere.display()));
                Ok(Verdict::FellShort)
            }
            Err(_) => Err(refused.into()),
        };
    }
    watch.keeper.discard().map_err(EngineError::from)?;
    output::print(&info::describe(&model))?;
    Ok(Verdict::Done)
}

/// Shows how far the training is and keeps it on disk meanwhile.
struct ProgressObserver {
    progress: ProgressLine,
    keeper: TrainingKeeper,
}

impl Observer for ProgressObserver {
    fn progress(&self, progress: Progress) {
        self.progress.progress(progress);
    }
}

impl TrainingObserver for ProgressObserver {
    fn checkpoint(&self, state: &TrainingState) {
        if let Err(reason) = self.keeper.checkpoint(state) {
            output::complain(&reason.to_string());
        }
    }
}
