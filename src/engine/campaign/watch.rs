//! Watches a campaign: reports the rows of shards as soon as they are finished, on any machine.

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

/// Interval of checks of the folder.
const LOOK_EVERY: Duration = Duration::from_millis(500);
/// Longest delay of a stop request.
const HEARD_WITHIN: Duration = Duration::from_millis(50);

/// Report about a campaign.
#[derive(Clone, Debug)]
pub enum News {
    /// Rows of a shard, by its number.
    Rows(usize, Vec<StudyRow>),
    /// Progress.
    Status(Box<Status>),
}

/// Watches a folder until everything in it is merged. Rows of shards are reported in the order in which the shards are
/// finished.
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
                        // A shard that cannot be read now may be replaced later.
                        Err(CampaignError::Read { .. }) => continue,
                        Err(refused) => return Err(JobError::failed(refused)),
                    }
                }
                read.insert(shard);
            }
            // Shards that were finished before watching started give no time per shard.
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

/// Returns the row of a merged training, as a single run would: the model, with the total time of all shards.
fn trained(folder: &Folder) -> Result<StudyRow, JobError> {
    let path = folder.model_path();
    let model = model_file::read(&path)
        .map_err(|reason| JobError::failed(EngineError::Model { path: path.clone(), reason: reason.into() }))?;
    let seconds = |shard: usize| folder.shard(shard).map(|shard| shard.seconds);
    let wall_s = (0..folder.shards()).map(seconds).sum::<Result<f64, CampaignError>>().map_err(JobError::failed)?;
    Ok(StudyRow::Training(Row { model: Arc::new(model), wall_s }))
}
