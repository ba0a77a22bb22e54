//! Computes a campaign on all cores of this machine, with one process per shard, so that a crash affects only one
//! shard.

use super::CampaignError;
use super::folder::Folder;
use super::merge::{Merged, Whole, merge};
use crate::host::worker::pause;
use crate::solver::observer::{Observer, Progress};
use std::collections::VecDeque;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Number of attempts per shard.
const ATTEMPTS: usize = 3;
/// Interval of checks whether a process has ended.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// Process that computes a shard.
struct Worker {
    shard: usize,
    attempt: usize,
    process: Child,
}

/// Computes the open shards with this number of processes, merges, and repeats this until the campaign is complete.
///
/// # Errors
/// If a shard cannot be computed, or if merging is refused. Finished shards are kept.
pub fn run(path: &Path, program: &Path, workers: usize, observer: &dyn Observer) -> Result<Whole, CampaignError> {
    loop {
        let folder = Folder::open(path)?;
        folder.check_program()?;
        compute_open(&folder, program, workers, observer)?;
        if let Merged::Result(whole) = merge(&folder, observer)? {
            return Ok(*whole);
        }
    }
}

fn compute_open(folder: &Folder, program: &Path, workers: usize, observer: &dyn Observer) -> Result<(), CampaignError> {
    let mut open: VecDeque<(usize, usize)> = folder.status().open.into_iter().map(|shard| (shard, 1)).collect();
    let total = folder.shards();
    let mut at_work: Vec<Worker> = Vec::new();
    let mut given_up = None;
    loop {
        let stage = format!("shards on {workers} processes");
        observer.progress(Progress { stage, done: total - open.len() - at_work.len(), total });
        while at_work.len() < workers && given_up.is_none() {
            let Some((shard, attempt)) = open.pop_front() else { break };
            at_work.push(start(folder, program, shard, attempt)?);
        }
        if at_work.is_empty() {
            return given_up.map_or(Ok(()), Err);
        }
        if observer.cancelled() {
            for worker in &mut at_work {
                // Fails if the process has already ended.
                let _ended = worker.process.kill();
            }
            return Err(crate::engine::EngineError::Cancelled.into());
        }
        let mut still = Vec::new();
        for mut worker in at_work {
            let ended = match worker.process.try_wait() {
                Ok(None) => {
                    still.push(worker);
                    continue;
                }
                Ok(Some(status)) if status.success() => continue,
                Ok(Some(status)) => status.to_string(),
                Err(reason) => reason.to_string(),
            };
            let Worker { shard, attempt, .. } = worker;
            let reason = std::fs::read_to_string(folder.failure_path(shard)).unwrap_or(ended);
            if attempt < ATTEMPTS {
                open.push_back((shard, attempt + 1));
            } else {
                given_up = given_up.or(Some(CampaignError::GivenUp { shard, attempts: attempt, reason }));
            }
        }
        at_work = still;
        pause(LOOK_EVERY);
    }
}

fn start(folder: &Folder, program: &Path, shard: usize, attempt: usize) -> Result<Worker, CampaignError> {
    let mut command = Command::new(program);
    command.args(["campaign", "shard"]).arg(&folder.path).arg(shard.to_string());
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let process = command.spawn().map_err(|reason| CampaignError::Start { program: program.to_owned(), reason })?;
    Ok(Worker { shard, attempt, process })
}
