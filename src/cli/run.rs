//! Command `run`: runs scenes and checks their expectations.

use super::animate;
use super::failure::Failure;
use super::output::{self, ProgressLine};
use super::verdict::Verdict;
use crate::engine::results::day_of;
use crate::engine::table::Number;
use crate::engine::{EngineError, SceneOutcome, Store, Workbench, model_file, run_scene};
use crate::scene::atomic_file::WriteError;
use crate::scene::{Method, Scene};
use clap::Args;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use time::Date;

/// Options of `run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// Scenes to run
    #[arg(value_name = "SCENE.ron", required_unless_present = "all", conflicts_with = "all")]
    pub(super) scenes: Vec<PathBuf>,
    /// Run every scene below a folder and write RESULTS.md, the results page, there; takes hours. Scenes marked
    /// `training: Embedded` run only if --only gives their full path
    #[arg(long)]
    pub(super) all: bool,
    /// Run only scenes marked `quick: true`, in a few minutes, without changing RESULTS.md
    #[arg(long, requires = "all")]
    pub(super) quick: bool,
    /// Folder of all scenes
    #[arg(long = "scenes", value_name = "DIR", default_value = "scenes", requires = "all")]
    pub(super) folder: PathBuf,
    /// Run only scenes whose path begins with one of these, such as line or time/fig_4_14.ron; RESULTS.md keeps the
    /// others
    #[arg(long, value_name = "PLACE", requires = "all", num_args = 1..)]
    pub(super) only: Vec<String>,
    /// Keep results in RESULTS.md of scenes that have not changed since and met all expectations
    #[arg(long, requires = "all")]
    pub(super) resume: bool,
    /// With --resume: only results from this day (UTC) or later, such as 2026-11-29
    #[arg(long, value_name = "DAY", requires = "resume", value_parser = day)]
    pub(super) since: Option<Date>,
    /// Write outcome (JSON), tables (CSV) and trained model (.rom) of every scene into this folder
    #[arg(long, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
    /// Write a transient scene, or a sweep over one quantity, as an animated PNG of 960×540 pixels, for slides
    #[arg(long, value_name = "FILE.png", conflicts_with = "all")]
    pub(super) animate: Option<PathBuf>,
    /// Print one JSON object per scene
    #[arg(long)]
    pub(super) json: bool,
}

/// Runs the command. All scenes and their models are read before the first one runs.
pub fn run(args: &RunArgs) -> Result<Verdict, Failure> {
    if args.all {
        return super::run_all::run(args);
    }
    let scenes = args.scenes.iter().map(|path| Scene::read(path)).collect::<Result<Vec<_>, _>>()?;
    if args.animate.is_some() {
        animate::check(&scenes)?;
    }
    make_out(args)?;
    let store = Store::default();
    let mut verdict = Verdict::Done;
    let named = |path: &Path, reason: EngineError| match reason {
        reason if reason.cancelled() => reason.into(),
        reason => Failure::Request(format!("the scene {}: {reason}", path.display())),
    };
    for (path, scene) in args.scenes.iter().zip(&scenes) {
        Workbench::on(&store, base(path)).check_models(scene).map_err(|reason| named(path, reason))?;
    }
    for (path, scene) in args.scenes.iter().zip(&scenes) {
        let outcome = match &args.animate {
            Some(file) => animate::run(scene, &mut Workbench::on(&store, base(path)), file)?,
            None => outcome_of(path, scene, &store).map_err(|reason| named(path, reason))?,
        };
        if !outcome.passed() {
            verdict = Verdict::FellShort;
        }
        if let Some(folder) = &args.out {
            let name = stem(path, &args.scenes);
            outcome.write(folder, &name)?;
            keep_model(scene, &store, folder, &name)?;
        }
        tell(&outcome, args.json)?;
    }
    Ok(verdict)
}

fn day(text: &str) -> Result<Date, Failure> {
    let accepted = "a day is written as year, month and day: 2026-11-29";
    day_of(text).ok_or_else(|| Failure::Request(accepted.to_owned()))
}

/// Creates the output folder, if one is given.
pub(super) fn make_out(args: &RunArgs) -> Result<(), Failure> {
    let Some(folder) = &args.out else { return Ok(()) };
    Ok(std::fs::create_dir_all(folder).map_err(|reason| WriteError { path: folder.clone(), reason })?)
}

/// Returns the folder to which a scene's paths are relative.
fn base(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// Runs one scene, with paths relative to its folder.
pub(super) fn outcome_of(path: &Path, scene: &Scene, store: &Store) -> Result<SceneOutcome, EngineError> {
    let progress = ProgressLine::new(false);
    let outcome = run_scene(scene, &mut Workbench::on(store, base(path)), &progress);
    progress.finish();
    outcome
}

/// Writes the model that a scene has just trained into the output folder.
pub(super) fn keep_model(scene: &Scene, store: &Store, folder: &Path, name: &str) -> Result<(), EngineError> {
    let Some(model) = scene.training().and_then(|spec| store.already_trained(&spec)) else { return Ok(()) };
    let path = folder.join(format!("{name}.rom"));
    model_file::write(&model, &path).map_err(|reason| EngineError::Model { path, reason: reason.into() })
}

/// Prints an outcome.
pub(super) fn tell(outcome: &SceneOutcome, json: bool) -> Result<(), Failure> {
    if json { output::print_json(&outcome.to_json()) } else { output::print(&describe(outcome)) }
}

/// Returns the name of a scene's output files, with a number if another scene of the run has the same name.
pub(super) fn stem(path: &Path, all: &[PathBuf]) -> String {
    let name = |path: &Path| path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
    let own = name(path);
    let before = all.iter().take_while(|other| other.as_path() != path).filter(|other| name(other) == own).count();
    if before == 0 { own } else { format!("{own}_{}", before + 1) }
}

/// Describes an outcome for users.
pub(super) fn describe(outcome: &SceneOutcome) -> String {
    let mut text = format!("{} ({:.2} s)\n", outcome.title, outcome.wall_s);
    let method = |method: &Option<Method>| method.as_ref().map_or("", Method::name);
    // Writing to a string cannot fail.
    for warning in &outcome.found.warnings {
        let _ = writeln!(text, "  note   {warning}");
    }
    if outcome.verdicts.is_empty() {
        for value in &outcome.found.values {
            let _ = writeln!(text, "         {:<26} {:<8} {}", value.name, method(&value.method), Number(value.value));
        }
    }
    for table in outcome.tables.iter().filter(|table| !table.labels.is_empty()) {
        text.push_str(&table.to_text("  "));
    }
    for verdict in &outcome.verdicts {
        let expected = &verdict.expected;
        let word = if verdict.holds { "ok   " } else { "SHORT" };
        let value = verdict.value.map_or("no such value".to_owned(), |value| Number(value).to_string());
        let (name, wanted) = (&expected.name, expected.wanted());
        let _ = writeln!(text, "  {word}  {name:<26} {:<8} {value} (expected {wanted})", method(&expected.method));
    }
    if !outcome.found.converged {
        let _ = writeln!(text, "  note   some solves did not converge");
    }
    text
}
