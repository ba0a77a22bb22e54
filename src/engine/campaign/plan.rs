//! Planning: from a campaign's document to a folder that holds everything its shards need.

use super::folder::{Folder, PLAN, ROUNDS, SCENE, SHARDS};
use super::program::{PROGRAM, hash_of, own_hash, read};
use super::round::{Pieces, Round};
use super::{CampaignError, VERSION, merge, shard, slurm};
use crate::engine::{EngineError, Store, Workbench};
use crate::host::clock::Stopwatch;
use crate::scene::atomic_file::{self, WriteError};
use crate::scene::{CaseTable, ModelSource, Scene, SceneFileError, Study};
use crate::solver::observer::{Observer, Progress};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Shortest shards that may be asked for \[s\]: what a scheduler adds to each is to be next to nothing.
const SHORTEST_S: f64 = 10.0;
/// Longest shards \[s\].
const LONGEST_S: f64 = 86_400.0;
/// Pieces that are tried for the time they take, and how long at most.
const TRIED: usize = 4;
const TRYING: Duration = Duration::from_secs(20);

/// A campaign as people write it, in RON.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Campaign {
    /// Version of the format, 1.
    pub version: u32,
    /// The scene whose work it is; relative to the campaign's folder.
    pub scene: PathBuf,
    /// How its work is cut.
    #[serde(default)]
    pub shard: Cut,
}

/// How large a shard is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Cut {
    /// Of about so many seconds on this machine, by some pieces that are tried; from 10 to a day.
    Seconds(f64),
    /// Of so many pieces.
    Pieces(usize),
}

impl Default for Cut {
    fn default() -> Self {
        Self::Seconds(30.0)
    }
}

/// What was planned, as the folder of the campaign keeps it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Version of the files.
    pub version: u32,
    /// The scene's title.
    pub title: String,
    /// What results are called: the name of the scene's file.
    pub name: String,
    /// Version of the program.
    pub program: String,
    /// Its hash.
    pub program_hash: String,
    /// Files that the work depends on, with their hashes.
    pub files: Vec<(String, String)>,
    /// Pieces of a shard.
    pub per_shard: usize,
    /// Seconds that a piece took when it was tried; none where none was.
    pub seconds_per_piece: Option<f64>,
}

impl Campaign {
    /// Reads a campaign's document.
    ///
    /// # Errors
    /// When it cannot be read, with line and column where it is wrong, or naming the field that makes no sense.
    pub fn read(path: &Path) -> Result<Self, CampaignError> {
        let refused = |reason: String| CampaignError::Document { path: path.to_owned(), reason };
        let text = String::from_utf8(read(path)?).map_err(|_| refused("it is not UTF-8 text".to_owned()))?;
        let campaign: Self = ron::from_str(&text).map_err(|error| {
            let at = error.span.start;
            refused(format!("line {}, column {}: {}", at.line, at.col, error.code))
        })?;
        if campaign.version != VERSION {
            return Err(refused(format!("its version is {}, this program reads {VERSION}", campaign.version)));
        }
        match campaign.shard {
            Cut::Seconds(seconds) if !(SHORTEST_S..=LONGEST_S).contains(&seconds) => {
                Err(refused(format!("`shard` is Seconds({seconds}), but must be between {SHORTEST_S} and {LONGEST_S}")))
            }
            Cut::Pieces(0) => Err(refused("`shard` is Pieces(0), but must be at least 1".to_owned())),
            _ => Ok(campaign),
        }
    }
}

/// Stops once it has taken long enough.
struct Patience(Stopwatch);

impl Observer for Patience {
    fn cancelled(&self) -> bool {
        self.0.elapsed() > TRYING
    }
}
impl crate::solver::training::TrainingObserver for Patience {}
impl crate::scene::StudyObserver for Patience {}

/// Plans a campaign into a folder. The same campaign planned again is left as it is.
///
/// # Errors
/// When the document or its scene is refused, or the folder cannot be written or holds another campaign.
pub fn plan(document: &Path, folder: &Path, observer: &dyn Observer) -> Result<Folder, CampaignError> {
    let campaign = Campaign::read(document)?;
    let beside = document.parent().unwrap_or(Path::new(""));
    let source = beside.join(&campaign.scene);
    let mut scene = Scene::read(&source).map_err(EngineError::from)?;
    let base = source.parent().unwrap_or(Path::new(""));
    // Refused by their own names, before anything is written.
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
    // Written last: a folder with it is whole.
    atomic_file::replace(&place, (text + "\n").as_bytes())?;
    Folder::open(folder)
}

/// Makes a scene refer to nothing but files beside it, and gives these; the scene itself is the first.
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
                    "`study.methods`: a campaign trains no model on the way; train {} first, by `train` or as a campaign \
                     of its own, and write File(…)",
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

/// Seconds that a piece takes here, by some that lie apart; the first one, which makes grids and reads models, counts
/// only where it is alone.
fn tried(scene: &Scene, pieces: &Pieces, bench: &mut Workbench) -> Result<f64, CampaignError> {
    let (count, patience) = (pieces.len(), Patience(Stopwatch::start()));
    let mut seconds = Vec::new();
    for k in 0..TRIED.min(count) {
        let one = Round { first: 0, per_shard: 1, pieces: pieces.clone() }.part(k * count / TRIED.min(count));
        let clock = Stopwatch::start();
        match shard::work(scene, 0, &one, bench, &patience) {
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

/// Whether a scene asks for a training.
pub fn trains(scene: &Scene) -> bool {
    matches!(scene.study, Study::Training(_))
}
