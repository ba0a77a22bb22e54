//! Command `bench`: speed table.

use super::failure::Failure;
use super::output;
use super::verdict::Verdict;
use crate::engine::bench;
use clap::Args;
use std::fmt::Write;

/// Options of `bench`.
#[derive(Debug, Args)]
pub struct BenchArgs {
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Fewer points; finishes within 20 s
    #[arg(long)]
    quick: bool,
}

/// Runs the command.
pub fn run(args: &BenchArgs) -> Result<Verdict, Failure> {
    let table = bench::run(args.quick)?;
    if args.json {
        output::print_json(&table)?;
        for note in &table.notes {
            output::complain(note);
        }
        return Ok(Verdict::Done);
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
    output::print(&text)?;
    Ok(Verdict::Done)
}
