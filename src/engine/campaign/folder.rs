//! Folder of a campaign: its content and progress.

use super::document::{Plan, VERSION, trains};
use super::error::CampaignError;
use super::program::{hash_of, own_hash, read};
use super::round::Round;
use super::shard::Shard;
use crate::engine::EngineError;
use crate::scene::{Scene, SceneFileError};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// File of the plan.
pub const PLAN: &str = "campaign.ron";
/// File of the scene.
pub const SCENE: &str = "scene.ron";
/// Folder of the rounds.
pub const ROUNDS: &str = "rounds";
/// Folder of the shards.
pub const SHARDS: &str = "shards";
/// Folder of the result.
pub const RESULT: &str = "result";

/// Campaign folder.
#[derive(Clone, Debug)]
pub struct Folder {
    /// Path of the folder.
    pub path: PathBuf,
    /// The plan.
    pub plan: Plan,
    /// The scene. It refers only to files in the folder.
    pub scene: Scene,
    /// Rounds so far, each with the hash that identifies its shards.
    pub rounds: Vec<(Round, String)>,
}

/// Progress of a campaign.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Status {
    /// The scene's title.
    pub title: String,
    /// Number of rounds so far.
    pub rounds: usize,
    /// Number of shards so far.
    pub shards: usize,
    /// Number of finished shards.
    pub done: usize,
    /// Shards to compute.
    pub open: Vec<usize>,
    /// Shards whose last attempt failed, with the reason.
    pub failed: Vec<(usize, String)>,
    /// Estimated processor time of the open shards \[s\], if trial pieces were timed.
    pub left_s: Option<f64>,
    /// True if all shards are merged.
    pub merged: bool,
}

impl Folder {
    /// Returns true if the shards contain rows of a study.
    pub fn holds_rows(&self) -> bool {
        !trains(&self.scene)
    }

    /// Reads a campaign folder. Also possible with another build of the program, for viewing.
    ///
    /// # Errors
    /// If it contains no campaign, or an invalid one.
    pub fn open(path: &Path) -> Result<Self, CampaignError> {
        let place = path.join(PLAN);
        if !place.is_file() {
            return Err(CampaignError::None { path: path.to_owned() });
        }
        let refused = |reason: String| CampaignError::Document { path: place.clone(), reason };
        let bytes = read(&place)?;
        let plan: Plan = ron::de::from_bytes(&bytes).map_err(|error| refused(error.to_string()))?;
        if plan.version != VERSION {
            return Err(refused(format!("its version is {}, this program reads {VERSION}", plan.version)));
        }
        for (name, hash) in &plan.files {
            let file = path.join(name);
            if Path::new(name).components().count() != 1 || hash_of(&read(&file)?) != *hash {
                return Err(CampaignError::Changed { path: file });
            }
        }
        let (own, scene_path) = (hash_of(&bytes), path.join(SCENE));
        let text = String::from_utf8(read(&scene_path)?).map_err(|_| refused("its scene is not text".to_owned()))?;
        let scene = Scene::from_ron(&text)
            .map_err(|reason| EngineError::from(SceneFileError::Scene { path: scene_path, reason }))?;
        let mut rounds: Vec<(Round, String)> = Vec::new();
        loop {
            let file = path.join(ROUNDS).join(format!("{:03}.ron", rounds.len()));
            if !file.exists() {
                break;
            }
            let text = String::from_utf8_lossy(&read(&file)?).into_owned();
            let round = Round::from_text(&text, &file)?;
            let first = rounds.last().map_or(0, |(round, _)| round.first + round.shards());
            if round.first != first {
                let reason = format!("its first shard is {}, but must be {first}", round.first);
                return Err(CampaignError::Document { path: file, reason });
            }
            let hash = Round::hash(&own, &text);
            rounds.push((round, hash));
        }
        if rounds.is_empty() {
            return Err(refused("its first round is missing; plan the campaign again".to_owned()));
        }
        Ok(Self { path: path.to_owned(), plan, scene, rounds })
    }

    /// Returns the campaign folder for a path to the folder or to its `campaign.ron`; `None` if there is no campaign.
    pub fn meant(path: &Path) -> Option<PathBuf> {
        let own = path.file_name().is_some_and(|name| name == PLAN).then(|| path.parent().unwrap_or(Path::new(".")));
        let folder = own.unwrap_or(path);
        folder.join(PLAN).is_file().then(|| folder.to_owned())
    }

    /// Returns the path of the scene.
    pub fn scene_path(&self) -> PathBuf {
        self.path.join(SCENE)
    }

    /// Refuses a build of the program other than the one that planned the campaign.
    ///
    /// # Errors
    /// With both hashes.
    pub fn check_program(&self) -> Result<(), CampaignError> {
        let own = own_hash()?;
        if own == self.plan.program_hash {
            return Ok(());
        }
        let (version, planned) = (self.plan.program.clone(), self.plan.program_hash.clone());
        Err(CampaignError::OtherProgram { version, planned, own: own.to_owned() })
    }

    /// Returns the number of shards so far.
    pub fn shards(&self) -> usize {
        self.rounds.last().map_or(0, |(round, _)| round.first + round.shards())
    }

    /// Returns number and content of the round of a shard, and the hash that identifies its shards.
    ///
    /// # Errors
    /// If there is no such shard.
    pub fn round_of(&self, shard: usize) -> Result<(usize, &Round, &str), CampaignError> {
        let holds =
            |(_, (round, _)): &(usize, &(Round, String))| (round.first..round.first + round.shards()).contains(&shard);
        let found = self.rounds.iter().enumerate().find(holds);
        let found = found.map(|(number, (round, hash))| (number, round, hash.as_str()));
        found.ok_or(CampaignError::NoShard { shard, shards: self.shards() })
    }

    /// Returns the path of a shard.
    pub fn shard_path(&self, shard: usize) -> PathBuf {
        self.path.join(SHARDS).join(format!("{shard:06}.shard"))
    }

    /// Returns the path of the file with the reason why a shard failed.
    pub fn failure_path(&self, shard: usize) -> PathBuf {
        self.shard_path(shard).with_extension("failed")
    }

    /// Returns the folder of the result.
    pub fn result_path(&self) -> PathBuf {
        self.path.join(RESULT)
    }

    /// Returns the path of the model of a training in the result.
    pub fn model_path(&self) -> PathBuf {
        self.result_path().join(self.model_name())
    }

    /// Returns the file name of a training's model.
    pub(super) fn model_name(&self) -> String {
        format!("{}.rom", self.plan.name)
    }

    /// Returns the path of a training's state between rounds.
    pub fn state_path(&self, round: usize) -> PathBuf {
        self.path.join(ROUNDS).join(format!("{round:03}.training"))
    }

    /// Reads a finished shard.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or belongs to another program, scene, model or campaign.
    pub fn shard(&self, shard: usize) -> Result<Shard, CampaignError> {
        let (_, round, hash) = self.round_of(shard)?;
        let path = self.shard_path(shard);
        Shard::read(&path, shard, (&self.plan, hash), round.part(shard).len())
    }

    /// Returns the numbers of the shards whose files exist, complete or not.
    pub fn done(&self) -> BTreeSet<usize> {
        let number = |entry: std::io::Result<std::fs::DirEntry>| {
            let name = entry.ok()?.file_name();
            name.to_str()?.strip_suffix(".shard")?.parse().ok().filter(|shard| *shard < self.shards())
        };
        std::fs::read_dir(self.path.join(SHARDS)).map(|all| all.filter_map(number).collect()).unwrap_or_default()
    }

    /// Returns the progress.
    pub fn status(&self) -> Status {
        let done = self.done();
        let open: Vec<usize> = (0..self.shards()).filter(|shard| !done.contains(shard)).collect();
        let failed = open.iter().filter_map(|shard| {
            Some((*shard, std::fs::read_to_string(self.failure_path(*shard)).ok()?.trim().to_owned()))
        });
        let pieces = |shard: &usize| self.round_of(*shard).map_or(0, |(_, round, _)| round.part(*shard).len());
        let left_s = self.plan.seconds_per_piece.map(|each| each * open.iter().map(pieces).sum::<usize>() as f64);
        Status {
            title: self.plan.title.clone(),
            rounds: self.rounds.len(),
            shards: self.shards(),
            done: done.len(),
            failed: failed.collect(),
            open,
            left_s,
            merged: self.result_path().is_dir(),
        }
    }
}
