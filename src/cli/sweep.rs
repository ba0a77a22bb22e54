//! `sweep`: the same along one or two varied options.

use super::Verdict;
use super::failure::Failure;
use super::options::PointOptions;
use super::output::{self, ProgressLine};
use crate::engine::{CONTACT_COLUMNS, ContactResult, RESULT_COLUMNS, Request, Table, Workbench};
use crate::scene::check::MAX_POINTS;
use crate::scene::{Bench, Method, Steps, atomic_file};
use crate::solver::full::Solution;
use crate::solver::observer::{Observer, Progress};
use clap::Args;
use std::path::PathBuf;

/// Options of `sweep`.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// What is varied, once or twice; NAME is a numeric option, as moes-m or speed. With :log for a constant ratio, with
    /// :graded:HALF for half of the values up to HALF and ever wider steps, as srr=0:1:41:graded:0.05
    #[arg(value_name = "NAME=FROM:TO:N[:log|:graded:HALF]", required = true, num_args = 1..=2, value_parser = varied)]
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

/// One varied option.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    name: String,
    steps: Steps,
}

fn varied(text: &str) -> Result<Varied, String> {
    let shape = "write NAME=FROM:TO:N, as in moes-m=10:100:19, with :log for a constant ratio or :graded:HALF for half \
                 of the values up to HALF";
    let (name, range) = text.split_once('=').ok_or(shape)?;
    let parts: Vec<&str> = range.split(':').collect();
    let (ends, log, half) = match parts.as_slice() {
        [from, to, n] => ((*from, *to, *n), false, None),
        [from, to, n, "log"] => ((*from, *to, *n), true, None),
        [from, to, n, "graded", half] => ((*from, *to, *n), false, Some(*half)),
        _ => return Err(shape.to_owned()),
    };
    let number = |text: &str| text.parse::<f64>().map_err(|_| format!("`{text}` is no number; {shape}"));
    let (from, to) = (number(ends.0)?, number(ends.1)?);
    let n: usize = ends.2.parse().map_err(|_| format!("`{}` is no count; {shape}", ends.2))?;
    if !(from.is_finite() && to.is_finite()) {
        return Err(format!("{from} to {to} is no finite range; {shape}"));
    }
    if !(1..=MAX_POINTS).contains(&n) {
        return Err(format!("{n} values are asked for; between 1 and {MAX_POINTS} are accepted"));
    }
    if log && !(from > 0.0 && to > 0.0) {
        return Err("a constant ratio needs positive ends; leave out :log".to_owned());
    }
    let steps = match half.map(number).transpose()? {
        Some(half) => {
            Steps::check_grading(from, half, to)?;
            Steps::Graded { from, half, to, n }
        }
        None if log => Steps::Log { from, to, n },
        None => Steps::Linear { from, to, n },
    };
    Ok(Varied { name: name.to_owned(), steps })
}

/// Runs the command: all requests are checked before the first is solved.
pub fn run(args: &SweepArgs) -> Result<Verdict, Failure> {
    let requests = requests(args)?;
    let names: Vec<&str> = args.varied.iter().map(|v| v.name.as_str()).collect();
    let columns = [&CONTACT_COLUMNS[..], &RESULT_COLUMNS].concat();
    let mut table = Table::new("sweep", &[&names[..], &columns].concat());
    let mut workbench = Workbench::new("");
    let progress = ProgressLine::new(false);
    let (mut former, mut failures, mut doubtful, mut worst) = (None, 0, 0, String::new());
    let total = requests.len();
    for (i, (values, request, method)) in requests.into_iter().enumerate() {
        progress.progress(Progress { stage: "sweep".to_owned(), done: i, total });
        let answer = workbench.answer(&request, &method, former.as_ref(), &())?;
        let report = ContactResult::from(&answer);
        if args.json {
            output::print_json(&report)?;
        }
        table.rows.push(values.into_iter().chain(report.row(&columns)).collect());
        if answer.converged {
            if let Some(warning) = answer.solution.as_ref().and_then(Solution::grid_warning) {
                doubtful += 1;
                worst = warning;
            }
            former = answer.solution;
        } else {
            failures += 1;
        }
    }
    progress.finish();
    match &args.csv {
        Some(path) => atomic_file::replace(path, table.to_csv().as_bytes())?,
        None if !args.json => output::print(&table.to_csv())?,
        None => {}
    }
    if doubtful > 0 {
        output::complain(&format!("the grid does not do for {doubtful} of {total} points; the last of them: {worst}"));
    }
    if failures > 0 {
        output::complain(&format!("{failures} of {total} points did not converge; their scalars are left empty"));
        return Ok(Verdict::FellShort);
    }
    Ok(Verdict::Done)
}

type Point = (Vec<f64>, Request, Method);

fn requests(args: &SweepArgs) -> Result<Vec<Point>, Failure> {
    let product = args.varied.iter().try_fold(1usize, |product, v| product.checked_mul(v.steps.len()));
    if product.is_none_or(|points| points > MAX_POINTS) {
        return Err(Failure::Request(format!("the sweep has too many points; at most {MAX_POINTS} are accepted")));
    }
    let tuples = Steps::combinations(args.varied.iter().map(|axis| &axis.steps));
    let point = |values: Vec<f64>| {
        let mut options = args.point.clone();
        for (axis, &value) in args.varied.iter().zip(&values) {
            options.set(&axis.name, value)?;
        }
        let (request, method) = options.request()?;
        Ok((values, request, method))
    };
    tuples.into_iter().map(point).collect()
}
