//! Command `train`: trains the reduced model of steady or transient contacts that a scene describes. The full solutions
//! of a steady training are stored in `FILE.rom.training` until the model is written. The same command therefore
//! continues an interrupted training.

use super::failure::Failure;
use super::options::choices;
use super::output::{self, ProgressLine};
use super::verdict::Verdict;
use crate::engine::model_file::ModelFileError;
use crate::engine::training_file::{self, TrainingKeeper};
use crate::engine::{EngineError, SavedModel, Workbench, model_file, model_text};
use crate::scene::{ContactSpec, Field, Scene};
use crate::solver::training::{Observer, Progress, TrainingObserver, TrainingState, train_resumable};
use clap::Args;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Options of `train`.
#[derive(Debug, Args)]
pub struct TrainArgs {
    /// Scene; its study must be a training, or a transient study that trains a reduced model
    #[arg(value_name = "SCENE.ron")]
    scene: PathBuf,
    /// Output file of the model
    #[arg(long, value_name = "FILE.rom")]
    out: PathBuf,
    /// Cavitation model; replaces that of the scene
    #[arg(long, value_parser = choices(Field::Cavitation))]
    cavitation: Option<String>,
}

/// Runs the command.
pub fn run(args: &TrainArgs) -> Result<Verdict, Failure> {
    let mut scene = Scene::read(&args.scene)?;
    if let Some(word) = &args.cavitation {
        let mut stated = ContactSpec::default();
        stated.read(Field::Cavitation, word, "")?;
        scene.cavitation = stated.cavitation.unwrap_or_default();
    }
    if scene.trains_in_time() {
        check_out(&args.out)?;
        return train_transient(&scene, args);
    }
    let Some(spec) = scene.training() else {
        return Err(EngineError::NoTraining { path: args.scene.clone() }.into());
    };
    let training_path = training_file::beside(&args.out);
    check_out(&args.out)?;
    // Refuses a training file that cannot be written now, before the training.
    let keeper = TrainingKeeper::new(training_path.clone()).map_err(EngineError::from)?;
    let mut state = match training_file::unfinished(&training_path, &spec).map_err(EngineError::from)? {
        Some(state) => {
            let (path, solutions) = (training_path.display(), state.solutions());
            let sentence = format!("continuing {path}: it contains {solutions} full solutions");
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
    match write(&args.out, |path| model_file::write(&model, path)) {
        Ok(Verdict::Done) => {}
        // The model is not in its file, so the training is kept.
        other => {
            keep(watch.keeper);
            return other;
        }
    }
    watch.keeper.discard().map_err(EngineError::from)?;
    output::print(&model_text::describe(&model))?;
    Ok(Verdict::Done)
}

/// Refuses an invalid output path before the training starts.
fn check_out(out: &Path) -> Result<(), Failure> {
    let folder = out.parent().filter(|folder| !folder.as_os_str().is_empty());
    if out.is_dir() || folder.is_some_and(|folder| !folder.is_dir()) {
        let out = out.display();
        let sentence = format!("cannot write {out}: --out must name a file in a folder that exists");
        return Err(Failure::Request(sentence));
    }
    Ok(())
}

/// Writes a model by `write` to the path `out`. If that fails, writes it to the folder for temporary files and reports
/// this path.
fn write(out: &Path, write: impl Fn(&Path) -> Result<(), ModelFileError>) -> Result<Verdict, Failure> {
    let Err(reason) = write(out) else { return Ok(Verdict::Done) };
    let refused = EngineError::Model { path: out.to_owned(), reason: reason.into() };
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let elsewhere = std::env::temp_dir().join(format!("{}-{name}", std::process::id()));
    match write(&elsewhere) {
        Ok(()) => {
            output::complain(&format!("{refused}; the model is in {} instead", elsewhere.display()));
            Ok(Verdict::FellShort)
        }
        Err(_) => Err(refused.into()),
    }
}

/// Trains a transient model. Its few full transient solutions take seconds to minutes and are not stored.
fn train_transient(scene: &Scene, args: &TrainArgs) -> Result<Verdict, Failure> {
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    let progress = ProgressLine::new(true);
    let trained = scene.train_in_time(&mut Workbench::new(folder), &progress);
    progress.finish();
    let (model, stopped) = trained?;
    let model = Arc::new(model);
    let saved = SavedModel::InTime(Arc::clone(&model));
    let written = write(&args.out, |path| saved.write(path))?;
    stopped.iter().for_each(|notice| output::complain(&notice.to_string()));
    output::print(&model_text::describe_in_time(&model))?;
    Ok(written)
}

/// Observer that shows the progress and stores the training on disk.
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
