//! Plans a campaign: writes a folder with everything that its shards need.

use super::document::{Campaign, Cut, Plan, VERSION};
use super::error::CampaignError;
use super::folder::{Folder, PLAN, ROUNDS, SCENE, SHARDS};
use super::program::{PROGRAM, hash_of, own_hash, read};
use super::round::{Pieces, Round};
use super::{compute, merge, slurm};
use crate::engine::{EngineError, Store, Workbench};
use crate::host::clock::Stopwatch;
use crate::scene::atomic_file::{self, WriteError};
use crate::scene::{CaseTable, ModelSource, Scene, SceneFileError};
use crate::solver::observer::{Observer, Progress};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Number of trial pieces, and time limit for them.
const TRIED: usize = 4;
const TRYING: Duration = Duration::from_secs(20);

/// Observer that cancels after the time limit.
struct Patience(Stopwatch);

impl Observer for Patience {
    fn cancelled(&self) -> bool {
        self.0.elapsed() > TRYING
    }
}
impl crate::solver::training::TrainingObserver for Patience {}
impl crate::scene::StudyObserver for Patience {}

/// Plans a campaign into a folder. If the folder already contains the same campaign, it is unchanged.
///
/// # Errors
/// If the document or its scene is refused, or if the folder cannot be written or contains another campaign.
pub fn plan(document: &Path, folder: &Path, observer: &dyn Observer) -> Result<Folder, CampaignError> {
    let campaign = Campaign::read(document)?;
    let beside = document.parent().unwrap_or(Path::new(""));
    let source = beside.join(&campaign.scene);
    let mut scene = Scene::read(&source).map_err(EngineError::from)?;
    let base = source.parent().unwrap_or(Path::new(""));
    // Models are checked before anything is written, so that errors contain their original paths.
    Workbench::on(&Store::default(), base).check_models(&scene)?;
    let files = self_contained(&mut scene, base)?;
    let name = source.file_stem().unwrap_or(source.as_os_str()).to_string_lossy().into_owned();
    let mut plan = Plan {
        version: VERSION,
        title: scene.title.clone(),
        name,
        program: PROGRAM.to_owned(),
        program_hash: own_hash()?.to_owned(),
        files: files.iter().map(|(name, bytes)| (name.clone(), hash_of(bytes))).collect(),
        per_shard: 1,
        seconds_per_piece: None,
    };
    if folder.join(PLAN).exists() {
        let there = Folder::open(folder)?;
        let same = there.plan.program_hash == plan.program_hash && there.plan.files == plan.files;
        let taken = || CampaignError::Taken { path: folder.to_owned(), title: there.plan.title.clone() };
        return if same { Ok(there) } else { Err(taken()) };
    }
    for inside in [ROUNDS, SHARDS] {
        let path = folder.join(inside);
        std::fs::create_dir_all(&path).map_err(|reason| WriteError { path, reason })?;
    }
    for (name, bytes) in &files {
        atomic_file::replace(&folder.join(name), bytes)?;
    }
    let mut bench = Workbench::on(&Store::default(), folder);
    let pieces = match scene.training() {
        Some(spec) => merge::first_contacts(folder, &scene, spec)?,
        None => {
            let numbers = scene.study.pieces(&scene.experiment(), &mut bench, 0, &[])?;
            Pieces::of_study(numbers)
        }
    };
    (plan.per_shard, plan.seconds_per_piece) = match campaign.shard {
        Cut::Pieces(pieces) => (pieces, None),
        Cut::Seconds(seconds) => {
            observer.progress(Progress { stage: "trying some pieces".to_owned(), done: 0, total: TRIED });
            let each = tried(&scene, &pieces, &mut bench)?;
            (((seconds / each).round() as usize).clamp(1, pieces.len().max(1)), Some(each))
        }
    };
    let round = Round { first: 0, per_shard: plan.per_shard, pieces };
    let (path, place) = (folder.join(ROUNDS).join("000.ron"), folder.join(PLAN));
    atomic_file::replace(&path, round.to_text(&path)?.as_bytes())?;
    let config = ron::ser::PrettyConfig::new().struct_names(true).compact_arrays(true);
    let text = ron::ser::to_string_pretty(&plan, config)
        .map_err(|error| CampaignError::Document { path: place.clone(), reason: error.to_string() })?;
    slurm::write(folder, &plan)?;
    // The plan is written last: a folder that contains it is complete.
    atomic_file::replace(&place, (text + "\n").as_bytes())?;
    Folder::open(folder)
}

/// Changes the references of a scene to files in its own folder, and returns these files. The scene itself is the
/// first.
fn self_contained(scene: &mut Scene, base: &Path) -> Result<Vec<(String, Vec<u8>)>, CampaignError> {
    let mut files = Vec::new();
    for method in scene.study.methods_mut() {
        let crate::scene::Method::Reduced { model, .. } = method else { continue };
        match model {
            ModelSource::Embedded => {}
            ModelSource::File(path) => {
                let (name, bytes) = (format!("model_{}.rom", files.len()), read(&base.join(&*path))?);
                *path = PathBuf::from(&name);
                files.push((name, bytes));
            }
            ModelSource::Trained(path) => {
                return Err(EngineError::Study(format!(
                    "`study.methods`: a campaign does not train models for its methods; train {} first, by `train` or in \
                     a separate campaign, and write File(…)",
                    path.display()
                ))
                .into());
            }
        }
    }
    if let Some(CaseTable::File(path)) = scene.study.table_mut() {
        files.push(("cases.csv".to_owned(), read(&base.join(&*path))?));
        *path = PathBuf::from("cases.csv");
    }
    let text = scene
        .to_ron()
        .map_err(|reason| EngineError::from(SceneFileError::Scene { path: PathBuf::from(SCENE), reason }))?;
    files.insert(0, (SCENE.to_owned(), text.into_bytes()));
    Ok(files)
}

/// Measures the time per piece \[s\] on trial pieces spread over all pieces. The first one includes building grids and
/// reading models. It is counted only if it is the only one.
fn tried(scene: &Scene, pieces: &Pieces, bench: &mut Workbench) -> Result<f64, CampaignError> {
    let (count, patience) = (pieces.len(), Patience(Stopwatch::start()));
    let mut seconds = Vec::new();
    for k in 0..TRIED.min(count) {
        let one = Round { first: 0, per_shard: 1, pieces: pieces.clone() }.part(k * count / TRIED.min(count));
        let clock = Stopwatch::start();
        match compute::work(scene, 0, &one, bench, &patience) {
            Err(stopped) if !matches!(&stopped, CampaignError::Run(error) if error.cancelled()) => return Err(stopped),
            _ => seconds.push(clock.seconds()),
        }
        if patience.cancelled() {
            break;
        }
    }
    let counted = seconds.get(1..).filter(|rest| !rest.is_empty()).unwrap_or(&seconds);
    Ok((counted.iter().sum::<f64>() / counted.len().max(1) as f64).max(1e-6))
}
