//! Command `export`: writes a reduced model for other programs.

use super::failure::Failure;
use super::model_argument::model_of;
use super::output;
use super::verdict::Verdict;
use crate::engine::SavedModel;
use crate::engine::coupled::fmu::FmiVersion;
use crate::engine::coupled::{Pressed, fmu};
use crate::scene::atomic_file;
use crate::scene::named_lubricant::{NamedLubricant, by_name};
use crate::solver::physics::lubricant::Lubricant;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Subcommands of `export`.
#[derive(Debug, Subcommand)]
pub enum ExportCommand {
    /// Functional Mock-up Unit for co-simulation (FMI 2.0 or 3.0); inputs are radius, speed, sliding and load, or the inputs
    /// that vary in a transient model
    Fmu(FmuArgs),
}

/// Options of `export fmu`.
#[derive(Debug, Args)]
pub struct FmuArgs {
    /// Reduced model: a file, or the name of an embedded model, such as line or point
    #[arg(value_name = "MODEL.rom")]
    model: PathBuf,
    /// Output file
    #[arg(long, value_name = "FILE.fmu")]
    out: PathBuf,
    /// Version of the FMI standard: 2 (FMI 2.0) or 3 (FMI 3.0)
    #[arg(long = "fmi", value_name = "VERSION", default_value = "2", value_parser = FmiVersion::from_str)]
    version: FmiVersion,
    /// Load as input (default)
    #[arg(long, conflicts_with = "approach")]
    load: bool,
    /// Approach of the bodies as input and load as output
    #[arg(long)]
    approach: bool,
    /// Lubricant of the simulation; refused if the model was trained with another one
    #[arg(long, value_name = "NAME", value_parser = by_name)]
    lubricant: Option<NamedLubricant>,
    /// Solver library of the unit (default: next to this program, or in ../lib/ehl-explorer from there)
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,
}

/// Runs the command.
pub fn run(command: &ExportCommand) -> Result<Verdict, Failure> {
    let ExportCommand::Fmu(args) = command;
    let (model, content) = model_of(&args.model)?;
    let same = |laws: Lubricant| match &model {
        SavedModel::Stationary(model) => laws == model.domain.lubricant,
        // A transient model determines the cavitation model itself.
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
    let archive = fmu::archive(&model, content, pressed, args.version, library)
        .map_err(|refused| Failure::Request(refused.to_string()))?;
    atomic_file::replace(&args.out, &archive)?;
    let megabytes = archive.len() as f64 / 1e6;
    output::print(&format!("{}: {megabytes:.1} MB, for {}\n", args.out.display(), fmu::library_place(args.version)))?;
    Ok(Verdict::Done)
}

/// Returns the paths where the solver library is searched: next to the program, and where packages install it.
fn places() -> Vec<PathBuf> {
    let program = std::env::current_exe().and_then(std::fs::canonicalize);
    let folder = program.ok().and_then(|program| Some(program.parent()?.to_owned())).unwrap_or_default();
    let installed = folder.parent().map(|prefix| prefix.join("lib").join(env!("CARGO_PKG_NAME")));
    [Some(folder), installed].into_iter().flatten().map(|folder| folder.join(fmu::library_file())).collect()
}

/// Reads the solver library.
fn library(given: Option<&Path>) -> Result<Vec<u8>, Failure> {
    if let Some(path) = given {
        let unreadable = |error: std::io::Error| {
            let reason = atomic_file::said(&error);
            Failure::Request(format!("cannot read the library of the unit {}: {reason}", path.display()))
        };
        return std::fs::read(path).map_err(unreadable);
    }
    let places = places();
    if let Some(library) = places.iter().find_map(|path| std::fs::read(path).ok()) {
        return Ok(library);
    }
    let searched: Vec<_> = places.iter().map(|path| path.display().to_string()).collect();
    Err(Failure::Request(format!(
        "a unit needs the library {}, which is neither {}: install the Debian package, which brings it, or build it in the \
         source tree with `cargo build --release --manifest-path bindings/c/Cargo.toml --target-dir target` and copy it to \
         one of these places, or name it with --library",
        fmu::library_file(),
        searched.join(" nor "),
    )))
}
