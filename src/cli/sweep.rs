//! `sweep`: the same along one or two varied options.

use super::Verdict;
use super::failure::Failure;
use super::options::PointOptions;
use super::output::{self, ProgressLine};
use crate::engine::{CONTACT_COLUMNS, ContactResult, Request, Table, Warning, Workbench, result_columns};
use crate::scene::check::MAX_POINTS;
use crate::scene::{Bench, Steps, atomic_file};
use crate::solver::observer::Progress;
use crate::solver::training::TrainingObserver;
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

/// One varied option and the values it takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Varied {
    /// Its name without the leading dashes, as [`PointOptions::set`] knows it.
    pub name: String,
    /// Its values.
    pub steps: Steps,
}

impl std::str::FromStr for Varied {
    type Err = Failure;

    /// Reads `NAME=FROM:TO:N[:log|:graded:HALF]`.
    fn from_str(text: &str) -> Result<Self, Failure> {
        varied(text)
    }
}

fn refuse<T>(sentence: String) -> Result<T, Failure> {
    Err(Failure::Request(sentence))
}

fn varied(text: &str) -> Result<Varied, Failure> {
    let shape = "write NAME=FROM:TO:N, as in moes-m=10:100:19, with :log for a constant ratio or :graded:HALF for half \
                 of the values up to HALF";
    let (name, range) = text.split_once('=').ok_or_else(|| Failure::Request(shape.to_owned()))?;
    let parts: Vec<&str> = range.split(':').collect();
    let (ends, log, half) = match parts.as_slice() {
        [from, to, n] => ((*from, *to, *n), false, None),
        [from, to, n, "log"] => ((*from, *to, *n), true, None),
        [from, to, n, "graded", half] => ((*from, *to, *n), false, Some(*half)),
        _ => return refuse(shape.to_owned()),
    };
    let number = |text: &str| text.parse::<f64>().or_else(|_| refuse(format!("`{text}` is no number; {shape}")));
    let (from, to) = (number(ends.0)?, number(ends.1)?);
    let n: usize = ends.2.parse().or_else(|_| refuse(format!("`{}` is no count; {shape}", ends.2)))?;
    if !(from.is_finite() && to.is_finite()) {
        return refuse(format!("{from} to {to} is no finite range; {shape}"));
    }
    if !(1..=MAX_POINTS).contains(&n) {
        return refuse(format!("{n} values are asked for; between 1 and {MAX_POINTS} are accepted"));
    }
    if log && !(from > 0.0 && to > 0.0) {
        return refuse("a constant ratio needs positive ends; leave out :log".to_owned());
    }
    let steps = match half.map(number).transpose()? {
        Some(half) => {
            Steps::check_grading(from, half, to).or_else(|why| refuse(why.to_string()))?;
            Steps::Graded { from, half, to, n }
        }
        None if log => Steps::Log { from, to, n },
        None => Steps::Linear { from, to, n },
    };
    Ok(Varied { name: name.to_owned(), steps })
}

/// Runs the command: all requests are checked before the first is solved.
pub fn run(args: &SweepArgs) -> Result<Verdict, Failure> {
    let sweep = Sweep::new(&args.varied, &args.point)?;
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

/// Contacts along one or two varied options, checked and not yet solved.
pub struct Sweep {
    names: Vec<String>,
    points: Vec<Point>,
}

/// The varied values of a contact, and the contact.
type Point = (Vec<f64>, Request);

/// What a sweep gave.
pub struct Swept {
    /// A row for each contact: varied values, the contact, its result (NaN if it did not converge), its warnings.
    pub table: Table,
    /// How many did not converge.
    pub failures: usize,
    /// How many carry each kind of warning.
    pub warnings: Vec<String>,
}

impl Sweep {
    /// The contacts that options describe when some of them are varied, the last one fastest.
    ///
    /// # Errors
    /// When one of them is refused, or there are too many.
    pub fn new(varied: &[Varied], options: &PointOptions) -> Result<Self, Failure> {
        let product = varied.iter().try_fold(1usize, |product, v| product.checked_mul(v.steps.len()));
        if product.is_none_or(|points| points > MAX_POINTS) {
            return Err(Failure::Request(format!("the sweep has too many points; at most {MAX_POINTS} are accepted")));
        }
        let point = |values: Vec<f64>| {
            let mut options = options.clone();
            for (axis, &value) in varied.iter().zip(&values) {
                options.set(&axis.name, value)?;
            }
            Ok((values, options.request()?))
        };
        let tuples = Steps::combinations(varied.iter().map(|axis| &axis.steps));
        let points = tuples.into_iter().map(point).collect::<Result<_, Failure>>()?;
        Ok(Self { names: varied.iter().map(|v| v.name.clone()).collect(), points })
    }

    /// Solves them, each from its neighbour; `tell` is shown each result.
    ///
    /// # Errors
    /// When one is refused, the observer cancels, or `tell` refuses to hear more.
    pub fn solve(
        self,
        bench: &mut dyn Bench,
        observer: &dyn TrainingObserver,
        mut tell: impl FnMut(&ContactResult) -> Result<(), Failure>,
    ) -> Result<Swept, Failure> {
        let heat = self.points.iter().any(|(_, request)| request.lubricant.heat.is_some());
        let columns = [&CONTACT_COLUMNS[..], &result_columns(heat)].concat();
        let titles: Vec<&str> = self.names.iter().map(String::as_str).chain(columns.iter().copied()).collect();
        let mut table = Table { remarks_title: "warning", ..Table::new("sweep", &titles) };
        let (mut former, mut results, total) = (None, Vec::new(), self.points.len());
        for (i, (values, request)) in self.points.into_iter().enumerate() {
            observer.progress(Progress { stage: "sweep".to_owned(), done: i, total });
            let answer = bench.answer(&request, former.as_ref(), observer)?;
            let result = answer.result.clone();
            tell(&result)?;
            table.rows.push(values.into_iter().chain(result.row(&columns)).collect());
            table.remarks.push(result.warning());
            results.push(result);
            former = answer.into_fields().or(former);
        }
        let failures = results.iter().filter(|result| !result.converged).count();
        let warnings = Warning::summary(results.iter().map(|result| &result.warnings[..]));
        Ok(Swept { table, failures, warnings })
    }
}
