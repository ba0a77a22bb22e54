//! `sweep`: the same along one or two varied options.

use super::failure::Failure;
use super::options::PointOptions;
use super::output::{self, ProgressLine};
use super::verdict::Verdict;
use crate::engine::{ContactResult, Workbench};
use crate::scene::{ContactSweep, Swept, Varied, atomic_file};
use clap::Args;
use std::path::PathBuf;

/// Options of `sweep`.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// What is varied, once or twice; NAME is a numeric option, as moes-m or speed. With :log for a constant ratio, with
    /// :graded:HALF for half of the values up to HALF and ever wider steps, as srr=0:1:41:graded:0.05
    #[arg(value_name = "NAME=FROM:TO:N[:log|:graded:HALF]", required = true, num_args = 1..=2)]
    varied: Vec<Varied>,
    #[command(flatten)]
    point: PointOptions,
    /// Write the table as CSV (default: print it)
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Print one JSON object per point
    #[arg(long)]
    json: bool,
}

/// Runs the command: all requests are checked before the first is solved.
pub fn run(args: &SweepArgs) -> Result<Verdict, Failure> {
    let sweep = ContactSweep::new(&args.varied, &args.point.0)?;
    let (progress, total) = (ProgressLine::new(false), sweep.points.len());
    let tell = |result: &ContactResult| if args.json { output::print_json(&result.json()) } else { Ok(()) };
    let Swept { table, failures, warnings } = sweep.solve(&mut Workbench::new(""), &progress, tell)?;
    progress.finish();
    match &args.csv {
        Some(path) => atomic_file::replace(path, table.to_csv().as_bytes())?,
        None if !args.json => output::print(&table.to_csv())?,
        None => {}
    }
    warnings.iter().for_each(|warning| output::complain(warning));
    if failures > 0 {
        output::complain(&format!("{failures} of {total} points did not converge; their scalars are left empty"));
        return Ok(Verdict::FellShort);
    }
    Ok(Verdict::Done)
}
