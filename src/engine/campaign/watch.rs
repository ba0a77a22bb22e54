//! Watching a campaign: its rows as its shards come, whoever computes them.

use super::error::CampaignError;
use super::folder::{Folder, Status};
use crate::engine::job::{Job, JobError, Wake};
use crate::engine::{EngineError, model_file};
use crate::host::worker::pause;
use crate::scene::StudyRow;
use crate::scene::study::training::Row;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// How long nobody looks into the folder.
const LOOK_EVERY: Duration = Duration::from_millis(500);
/// How long a stop waits at most.
const HEARD_WITHIN: Duration = Duration::from_millis(50);

/// News of a campaign.
#[derive(Clone, Debug)]
pub enum News {
    /// Rows of a shard, by its number.
    Rows(usize, Vec<StudyRow>),
    /// How far it is.
    Status(Box<Status>),
}

/// Watches a folder until everything in it is merged. Rows of shards come in the order in which these are finished.
pub fn watch(path: PathBuf, wake: Wake) -> Job<News> {
    Job::start("Watching the campaign", wake, move |reporter| {
        let (mut read, mut told): (BTreeSet<usize>, Option<Status>) = Default::default();
        let mut there = None;
        loop {
            let folder = Folder::open(&path).map_err(JobError::failed)?;
            let status = folder.status();
            let new: Vec<usize> = folder.done().into_iter().filter(|shard| !read.contains(shard)).collect();
            for shard in new {
                if reporter.cancelled() {
                    return Ok(());
                }
                if folder.holds_rows() {
                    match folder.shard(shard) {
                        Ok(found) => reporter.send(News::Rows(shard, found.rows())),
                        // One that cannot be read now may be replaced.
                        Err(CampaignError::Read { .. }) => continue,
                        Err(refused) => return Err(JobError::failed(refused)),
                    }
                }
                read.insert(shard);
            }
            // Of those that were there before nobody knows how long they took.
            let before = status.done.min(*there.get_or_insert(status.done));
            reporter.stage("new shards", status.done - before, status.shards - before);
            let merged = status.merged && status.open.is_empty();
            if merged && !folder.holds_rows() {
                reporter.send(News::Rows(0, vec![trained(&folder)?]));
            }
            if told.as_ref() != Some(&status) {
                reporter.send(News::Status(Box::new(status.clone())));
                told = Some(status);
            }
            let mut waited = Duration::ZERO;
            while waited < LOOK_EVERY && !merged {
                if reporter.cancelled() {
                    return Ok(());
                }
                pause(HEARD_WITHIN);
                waited += HEARD_WITHIN;
            }
            if merged {
                return Ok(());
            }
        }
    })
}

/// The row of a training that was merged, as one run has it: its model, with the seconds of all shards.
fn trained(folder: &Folder) -> Result<StudyRow, JobError> {
    let path = folder.model_path();
    let model = model_file::read(&path)
        .map_err(|reason| JobError::failed(EngineError::Model { path: path.clone(), reason: reason.into() }))?;
    let seconds = |shard: usize| folder.shard(shard).map(|shard| shard.seconds);
    let wall_s = (0..folder.shards()).map(seconds).sum::<Result<f64, CampaignError>>().map_err(JobError::failed)?;
    Ok(StudyRow::Training(Row { model: Arc::new(model), wall_s }))
}
