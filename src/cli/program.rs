//! The program: its commands, how they are read from the command line, and its exit codes.

use super::failure::{Failure, usage};
use super::verdict::Verdict;
use super::{bench, campaign, cases, export, info, output, run, solve, sweep, train};
use crate::engine::campaign::Folder;
use clap::error::ErrorKind;
use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// Elastohydrodynamic contacts: full solutions and reduced models, on the screen and headless.
#[derive(Debug, Parser)]
#[command(name = "ehl-explorer", version, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Open the explorer on this scene or campaign (default: on the last session)
    #[arg(value_name = "SCENE.ron")]
    scene: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve one operating point
    Solve(solve::SolveArgs),
    /// Solve along one or two varied options, each point starting from its neighbour
    Sweep(sweep::SweepArgs),
    /// Solve a table of load cases (CSV), a contact a line; bad lines are named, the others solved
    Cases(cases::CasesArgs),
    /// Run scenes and hold them against their expectations; exit 1 if any falls short
    Run(run::RunArgs),
    /// Cut a scene's work into shards for many processes and machines, and put together what comes of them
    #[command(subcommand)]
    Campaign(campaign::CampaignCommand),
    /// Train a reduced model as a scene describes
    Train(train::TrainArgs),
    /// Measure the speed table: full and reduced side by side
    Bench(bench::BenchArgs),
    /// Show what a reduced model holds
    Info(info::InfoArgs),
    /// Write a reduced model as other programs take it
    #[command(subcommand)]
    Export(export::ExportCommand),
}

/// No window can be had: a sentence.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct NoWindow(pub String);

/// Opens the explorer on a scene, where there is one; it returns when its window is closed.
pub type Explorer = fn(Option<PathBuf>) -> Result<(), NoWindow>;

/// The program: parses the command line, runs the command, returns its exit code.
pub fn main(explorer: Explorer) -> ExitCode {
    if let Some(failure) = negative_infinity() {
        return finish(Err(failure));
    }
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) => {
            return finish(output::print(&error.render().to_string()).map(|()| Verdict::Done));
        }
        Err(error) => return finish(Err(usage(&error))),
    };
    finish(match cli.command {
        Some(Command::Solve(args)) => solve::run(&args),
        Some(Command::Sweep(args)) => sweep::run(&args),
        Some(Command::Cases(args)) => cases::run(&args),
        Some(Command::Run(args)) => run::run(&args),
        Some(Command::Campaign(command)) => campaign::run(&command),
        Some(Command::Train(args)) => train::run(&args),
        Some(Command::Bench(args)) => bench::run(&args),
        Some(Command::Export(command)) => export::run(&command),
        Some(Command::Info(args)) => info::run(&args),
        None => explore(cli.scene, explorer),
    })
}

fn finish(result: Result<Verdict, Failure>) -> ExitCode {
    match result {
        Ok(Verdict::Done) | Err(Failure::ReaderLeft) => ExitCode::SUCCESS,
        Ok(Verdict::FellShort) => ExitCode::from(1),
        Err(failure) => {
            output::complain(&failure.to_string());
            ExitCode::from(if matches!(failure, Failure::Stopped) { 1 } else { 2 })
        }
    }
}

/// Opens the explorer; a scene is read here first, so that a wrong one is refused before a window opens.
fn explore(scene: Option<PathBuf>, explorer: Explorer) -> Result<Verdict, Failure> {
    if let Some(folder) = scene.as_deref().and_then(Folder::meant) {
        Folder::open(&folder)?;
    } else if let Some(path) = &scene {
        crate::scene::Scene::read(path).map_err(|error| {
            let looks_like_command = path.extension().is_none() && !path.exists();
            let hint = if looks_like_command {
                "; commands are solve, sweep, cases, run, campaign, train, bench, info and export"
            } else {
                ""
            };
            Failure::Request(format!("{error}{hint}"))
        })?;
    }
    Ok(explorer(scene).map(|()| Verdict::Done)?)
}

/// A number that looks like an option: it is refused by its own name.
fn negative_infinity() -> Option<Failure> {
    let words: Vec<String> = std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    words.windows(2).find_map(|pair| match pair {
        [option, value] if ["-inf", "-infinity", "-nan"].contains(&value.to_lowercase().as_str()) => {
            Some(Failure::Request(format!("{option} is {value}, but must be a finite number")))
        }
        _ => None,
    })
}
