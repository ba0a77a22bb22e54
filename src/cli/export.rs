//! `export`: a reduced model as other programs take it.

use super::failure::Failure;
use super::output;
use super::verdict::Verdict;
use crate::engine::coupled::{Pressed, fmu};
use crate::engine::{EngineError, SavedModel};
use crate::scene::atomic_file;
use crate::scene::named_lubricant::{NamedLubricant, by_name};
use crate::solver::physics::lubricant::Lubricant;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};

/// What is exported.
#[derive(Debug, Subcommand)]
pub enum ExportCommand {
    /// A Functional Mock-up Unit for co-simulation (FMI 2.0): inputs radius, speed, sliding and load, or what a model in
    /// time lets vary
    Fmu(FmuArgs),
}

/// Options of `export fmu`.
#[derive(Debug, Args)]
pub struct FmuArgs {
    /// The reduced model
    #[arg(value_name = "MODEL.rom")]
    model: PathBuf,
    /// Write the unit here
    #[arg(long, value_name = "FILE.fmu")]
    out: PathBuf,
    /// The load is given (default)
    #[arg(long, conflicts_with = "approach")]
    load: bool,
    /// The approach of the bodies is given, and the load follows (point contacts)
    #[arg(long)]
    approach: bool,
    /// The lubricant that the simulation means; refused where the model was trained with another one
    #[arg(long, value_name = "NAME", value_parser = by_name)]
    lubricant: Option<NamedLubricant>,
    /// The library that solves it (default: beside this program)
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,
}

/// Runs the command.
pub fn run(command: &ExportCommand) -> Result<Verdict, Failure> {
    let ExportCommand::Fmu(args) = command;
    let refused = |reason| EngineError::Model { path: args.model.clone(), reason };
    let (model, content) = SavedModel::read_with_content(&args.model).map_err(|reason| refused(reason.into()))?;
    let same = |laws: Lubricant| match &model {
        SavedModel::Stationary(model) => laws == model.domain.lubricant,
        // It says itself how its films rupture.
        SavedModel::InTime(model) => laws.of_the_liquid() == model.domain.reference.lubricant.of_the_liquid(),
    };
    if let Some(named) = args.lubricant
        && !same(named.laws)
    {
        return Err(Failure::Request(format!(
            "the reduced model {} was trained with another lubricant than {}; train one with it, or leave out --lubricant",
            args.model.display(),
            named.name
        )));
    }
    let library = library(args.library.as_deref())?;
    let pressed = if args.approach { Pressed::Approach } else { Pressed::Load };
    let archive =
        fmu::archive(&model, content, pressed, library).map_err(|refused| Failure::Request(refused.to_string()))?;
    atomic_file::replace(&args.out, &archive)?;
    let megabytes = archive.len() as f64 / 1e6;
    output::print(&format!("{}: {megabytes:.1} MB, for {}\n", args.out.display(), fmu::library_place()))?;
    Ok(Verdict::Done)
}

/// The content of the library.
fn library(given: Option<&Path>) -> Result<Vec<u8>, Failure> {
    let beside = || std::env::current_exe().ok()?.parent().map(|folder| folder.join(fmu::library_file()));
    let path = given.map(Path::to_owned).or_else(beside).unwrap_or_else(|| PathBuf::from(fmu::library_file()));
    std::fs::read(&path).map_err(|error| {
        Failure::Request(format!(
            "cannot read the library of the unit {}: {}; build it with `cargo build --release --manifest-path \
             bindings/c/Cargo.toml --target-dir target`, or name it with --library",
            path.display(),
            atomic_file::said(&error)
        ))
    })
}
