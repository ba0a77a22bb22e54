//! Command `sweep`: contacts along one or two varied options.

use super::failure::Failure;
use super::options::PointOptions;
use super::output::{self, ProgressLine};
use super::verdict::Verdict;
use crate::engine::Workbench;
use crate::scene::{ContactSweep, Swept, SweptContact, Varied, Words, atomic_file};
use clap::Args;
use serde_json::{Map, Value, json};
use std::path::PathBuf;

/// Options of `sweep`.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// One or two varied options; NAME is a numeric option such as moes-m or speed. Add :log for a constant ratio, or
    /// :graded:HALF for steps that grow, with half of the values up to HALF, as in srr=0:1:41:graded:0.05
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

/// Runs the command. Refused contacts are reported, all others are solved.
pub fn run(args: &SweepArgs) -> Result<Verdict, Failure> {
    let sweep = ContactSweep::new(&args.varied, &args.point.0, Words::Flags)?;
    let progress = ProgressLine::new(false);
    let tell = |contact: SweptContact<'_>| if args.json { print(&contact) } else { Ok(()) };
    let Swept { table, failures, refused, warnings } = sweep.solve(&mut Workbench::new(""), &progress, tell)?;
    progress.finish();
    match &args.csv {
        Some(path) => atomic_file::replace(path, table.to_csv().as_bytes())?,
        None if !args.json => output::print(&table.to_csv())?,
        None => {}
    }
    warnings.iter().for_each(|warning| output::complain(&warning.to_string()));
    let total = table.rows.len();
    if failures > 0 {
        output::complain(&format!("{failures} of {total} points did not converge; their scalars are left empty"));
    }
    if let Some((count, first)) = &refused {
        output::complain(&format!("{count} of {total} points are refused, the first of them: {first}"));
    }
    Ok(if failures == 0 && refused.is_none() { Verdict::Done } else { Verdict::FellShort })
}

/// Prints a contact as JSON: its result, or its varied options and the reason why it is refused.
fn print(contact: &SweptContact<'_>) -> Result<(), Failure> {
    let SweptContact { names, values, row } = contact;
    match &row.answer {
        Some(answer) => output::print_json(&answer.result.json()),
        None => {
            let varied = names.iter().zip(*values).map(|(name, value)| (name.clone(), json!(value)));
            let refused = [("refused".to_owned(), json!(row.reason))];
            output::print_json(&varied.chain(refused).collect::<Map<String, Value>>())
        }
    }
}
