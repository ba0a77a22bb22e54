//! Command `bench`: speed table.

use super::failure::Failure;
use super::output;
use super::verdict::Verdict;
use crate::engine::bench::{self, Bench};
use crate::engine::speed::{self, SpeedPageError};
use crate::scene::atomic_file;
use clap::Args;
use std::fmt::{Display, Write};
use std::path::{Path, PathBuf};

/// Options of `bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Fewer points; finishes within 20 s
    #[arg(long)]
    quick: bool,
    /// Also write the times into the tables of the page of the manual
    #[arg(long, value_name = "SPEED.md", conflicts_with = "quick")]
    page: Option<PathBuf>,
}

/// Runs the command.
pub fn run(args: &BenchArgs) -> Result<Verdict, Failure> {
    // Read before the measurement, which takes minutes.
    let page = args.page.as_deref().map(|path| Ok::<_, Failure>((path, read(path)?))).transpose()?;
    let table = bench::run(args.quick)?;
    print(args, &table)?;
    if let Some((path, text)) = page {
        let text = speed::updated(&text, &table).map_err(|why| refused(path, &why))?;
        atomic_file::replace(path, text.as_bytes())?;
    }
    Ok(Verdict::Done)
}

/// Reads a page with tables of times.
fn read(path: &Path) -> Result<String, Failure> {
    let text = std::fs::read_to_string(path).map_err(|why| refused(path, &why))?;
    speed::measured_on(&text).ok_or_else(|| refused(path, &SpeedPageError::NoDay))?;
    Ok(text)
}

fn refused(path: &Path, why: &dyn Display) -> Failure {
    Failure::Request(format!("{}: {why}", path.display()))
}

fn print(args: &BenchArgs, table: &Bench) -> Result<(), Failure> {
    if args.json {
        output::print_json(table)?;
        for note in &table.notes {
            output::complain(note);
        }
        return Ok(());
    }
    let mut text = format!("{:<22} {:>12} {:>12} {:>7} {:>9}\n", "", "median", "99 %", "runs", "ratio");
    for row in &table.rows {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<22} {:>9.3} ms {:>9.3} ms {:>7} {:>9.1}",
            row.name,
            row.median_s * 1e3,
            row.p99_s * 1e3,
            row.runs,
            row.ratio
        );
    }
    let _ = writeln!(
        text,
        "Random points of Table 3.1's box (line), of Table 3.4's (point, 301×41 nodes) and of Table 3.6's ranges (shear), the same for\nall rows of a kind. The ratio is the median of {} (dense LU per Newton step, 1201 nodes, cold start, this run),\n{} or {} over the row's median. Warm starts come from the nearest other solution.",
        bench::BASELINE,
        bench::POINT_BASELINE,
        bench::HEAT_BASELINE
    );
    for note in &table.notes {
        let _ = writeln!(text, "{note}");
    }
    output::print(&text)
}
