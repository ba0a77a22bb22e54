//! Command `campaign`: the work of a scene, divided into shards.

use super::failure::Failure;
use super::output::{self, ProgressLine};
use super::run::describe;
use super::verdict::Verdict;
use crate::engine::campaign::compute::{Done, compute};
use crate::engine::campaign::merge::{Merged, Whole, merge};
use crate::engine::campaign::plan::plan;
use crate::engine::campaign::{CampaignError, Folder, local};
use crate::host::pool::cores;
use clap::{Args, Subcommand, ValueEnum};
use serde::Serialize;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// Subcommands of `campaign`.
#[derive(Debug, Subcommand)]
pub enum CampaignCommand {
    /// Plan a campaign in a folder: its scene, its shards, hashes of all files they depend on, and a script for Slurm
    Plan(PlanArgs),
    /// Compute one shard, unless it already exists
    Shard(ShardArgs),
    /// Merge all shards, or open the next round; refuses missing shards and those computed by another program
    Merge(Where),
    /// Compute all open shards on this machine, and merge
    Run(RunArgs),
    /// Show the progress
    Status(StatusArgs),
}

/// Options of `campaign plan`.
#[derive(Debug, Args)]
pub struct PlanArgs {
    /// Campaign file: the scene, and the size of a shard
    #[arg(value_name = "CAMPAIGN.ron")]
    campaign: PathBuf,
    /// Folder of the campaign
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Location of a campaign.
#[derive(Debug, Args)]
pub struct Where {
    /// Folder of the campaign
    #[arg(value_name = "DIR")]
    folder: PathBuf,
}

/// Options of `campaign shard`.
#[derive(Debug, Args)]
pub struct ShardArgs {
    #[command(flatten)]
    campaign: Where,
    /// Number of the shard, from 0
    #[arg(value_name = "K")]
    shard: usize,
    /// Number of threads; keep 1 if a scheduler gives each shard one processor
    #[arg(long, value_name = "N", default_value = "1")]
    threads: NonZero<u16>,
}

/// Place where `campaign run` computes shards.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Place {
    /// This machine.
    Local,
}

/// Options of `campaign run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    #[command(flatten)]
    campaign: Where,
    /// Machine that computes the shards; for clusters see slurm.sh in the folder, and the Python package for Dask
    #[arg(long, value_enum)]
    on: Place,
    /// Number of parallel processes (default: one per processor)
    #[arg(long, value_name = "N")]
    workers: Option<NonZero<u16>>,
}

/// Options of `campaign status`.
#[derive(Debug, Args)]
pub struct StatusArgs {
    #[command(flatten)]
    campaign: Where,
    /// Print only the numbers of the open shards
    #[arg(long)]
    open: bool,
    /// Print one JSON object
    #[arg(long, conflicts_with = "open")]
    json: bool,
}

impl From<CampaignError> for Failure {
    fn from(error: CampaignError) -> Self {
        match error {
            CampaignError::Run(reason) => reason.into(),
            CampaignError::Write(reason) => reason.into(),
            other => Self::Request(other.to_string()),
        }
    }
}

/// Runs the command.
pub fn run(command: &CampaignCommand) -> Result<Verdict, Failure> {
    match command {
        CampaignCommand::Plan(args) => planned(args),
        CampaignCommand::Shard(args) => computed(args),
        CampaignCommand::Merge(args) => merged(&args.folder),
        CampaignCommand::Run(args) => run_here(args),
        CampaignCommand::Status(args) => status(args),
    }
}

fn planned(args: &PlanArgs) -> Result<Verdict, Failure> {
    let progress = ProgressLine::new(true);
    let folder = plan(&args.campaign, &args.out, &progress);
    progress.finish();
    let folder = folder?;
    let pieces = folder.rounds.iter().map(|(round, _)| round.pieces.len()).sum::<usize>();
    let each = folder
        .plan
        .seconds_per_piece
        .map(|each| format!(" of about {:.0} s each ({:.2} s a piece)", each * folder.plan.per_shard as f64, each));
    let (title, shards) = (&folder.plan.title, folder.shards());
    output::print(&format!("{title}: {pieces} pieces in {shards} shards{}\n", each.unwrap_or_default()))?;
    Ok(Verdict::Done)
}

fn computed(args: &ShardArgs) -> Result<Verdict, Failure> {
    let folder = Folder::open(&args.campaign.folder)?;
    let progress = ProgressLine::new(false);
    let number = args.shard;
    let waiting = || output::complain(&format!("shard {number} is being computed by another process; waiting for it"));
    let done = compute(&folder, number, usize::from(args.threads.get()), &progress, &waiting);
    progress.finish();
    let word = match done? {
        Done::Computed => "done",
        Done::There => "already done",
    };
    output::print(&format!("shard {number}: {word}\n"))?;
    Ok(Verdict::Done)
}

fn merged(path: &Path) -> Result<Verdict, Failure> {
    let folder = Folder::open(path)?;
    let progress = ProgressLine::new(false);
    let merged = merge(&folder, &progress);
    progress.finish();
    match merged? {
        Merged::Result(whole) => tell(&folder, &whole),
        Merged::Round(shards) => {
            let (number, first, last) = (folder.rounds.len() + 1, shards.start, shards.end - 1);
            output::print(&format!(
                "round {number} is open: shards {first} to {last} are to be computed; then merge again\n"
            ))?;
            Ok(Verdict::Done)
        }
    }
}

fn run_here(args: &RunArgs) -> Result<Verdict, Failure> {
    let Place::Local = args.on;
    let workers = args.workers.map_or_else(cores, |workers| usize::from(workers.get()));
    let program = std::env::current_exe()
        .map_err(|reason| Failure::Request(format!("the program's own file cannot be found: {reason}")))?;
    let progress = ProgressLine::new(false);
    let whole = local::run(&args.campaign.folder, &program, workers, &progress);
    progress.finish();
    tell(&Folder::open(&args.campaign.folder)?, &whole?)
}

/// Prints the outcome and the path of the result.
fn tell(folder: &Folder, whole: &Whole) -> Result<Verdict, Failure> {
    output::print(&describe(&whole.outcome))?;
    if whole.processors.len() > 1 {
        let kinds: Vec<&str> = whole.processors.iter().map(String::as_str).collect();
        output::complain(&format!(
            "shards were computed on different types of processors ({}): their sums may differ in the last bits",
            kinds.join("; ")
        ));
    }
    let (seconds, path) = (whole.seconds, folder.result_path());
    output::print(&format!("{seconds:.1} s of processor time in total; the result is in {}\n", path.display()))?;
    Ok(if whole.outcome.passed() { Verdict::Done } else { Verdict::FellShort })
}

/// Progress of a campaign as JSON.
#[derive(Serialize)]
struct StatusJson<'a> {
    #[serde(flatten)]
    status: &'a crate::engine::campaign::Status,
    program: &'a str,
}

fn status(args: &StatusArgs) -> Result<Verdict, Failure> {
    let folder = Folder::open(&args.campaign.folder)?;
    let status = folder.status();
    if args.open {
        let numbers: String = status.open.iter().map(|shard| format!("{shard}\n")).collect();
        output::print(&numbers)?;
    } else if args.json {
        output::print_json(&StatusJson { status: &status, program: &folder.plan.program_hash })?;
    } else {
        let mut text =
            format!("{}: {} of {} shards are done, round {}", status.title, status.done, status.shards, status.rounds);
        if let Some(left) = status.left_s.filter(|_| !status.open.is_empty()) {
            text += &format!("; about {left:.0} s of processor time remain in it");
        }
        text += if status.merged { "; merged\n" } else { "\n" };
        for (shard, reason) in &status.failed {
            text += &format!("  shard {shard} failed: {reason}\n");
        }
        output::print(&text)?;
    }
    Ok(Verdict::Done)
}
