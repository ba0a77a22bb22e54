//! Command line of the program: its commands, how they are parsed, and its exit codes.

use super::failure::{Failure, usage};
use super::verdict::Verdict;
use super::{bench, campaign, cases, export, info, output, run, solve, sweep, train};
use crate::engine::campaign::Folder;
use clap::error::ErrorKind;
use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// Elastohydrodynamic contacts: full solutions and reduced models, in a window or on the command line.
#[derive(Debug, Parser)]
#[command(name = "ehl-explorer", version, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    /// Scene or campaign to open in the explorer (default: the last session)
    #[arg(value_name = "SCENE.ron")]
    scene: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve one operating point
    Solve(solve::SolveArgs),
    /// Solve along one or two varied options; each point starts from its neighbour
    Sweep(sweep::SweepArgs),
    /// Solve a table of load cases (CSV) with one contact per line; refused lines are reported, the others solved
    Cases(cases::CasesArgs),
    /// Run scenes and check their expectations; exit code 1 if one is not met
    Run(run::RunArgs),
    /// Divide the work of a scene into shards for many processes and machines, and merge their results
    #[command(subcommand)]
    Campaign(campaign::CampaignCommand),
    /// Train the reduced model that a scene describes
    Train(train::TrainArgs),
    /// Measure the speed of full and reduced solves
    Bench(bench::BenchArgs),
    /// Show the contents of a reduced model
    Info(info::InfoArgs),
    /// Write a reduced model for other programs
    #[command(subcommand)]
    Export(export::ExportCommand),
}

/// Error: the window cannot be opened.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct NoWindow(pub String);

/// Function that opens the explorer on a scene, if given. It returns when the window is closed.
pub type Explorer = fn(Option<PathBuf>) -> Result<(), NoWindow>;

/// Parses the command line, runs the command, and returns the exit code.
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

/// Opens the explorer. A scene is read here first, so that an invalid one is refused before a window opens.
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

/// Refuses values such as `-inf`, which would be parsed as an option, with a message that names the option.
fn negative_infinity() -> Option<Failure> {
    let words: Vec<String> = std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
    words.windows(2).find_map(|pair| match pair {
        [option, value] if ["-inf", "-infinity", "-nan"].contains(&value.to_lowercase().as_str()) => {
            Some(Failure::Request(format!("{option} is {value}, but must be a finite number")))
        }
        _ => None,
    })
}
