//! Command `solve`: one operating point.

use super::described;
use super::failure::Failure;
use super::options::PointOptions;
use super::output;
use super::verdict::Verdict;
use crate::engine::{GridAccuracy, Table, Workbench, film_shear_table, profile_table};
use crate::host::clock::Stopwatch;
use crate::scene::{
    ContactDynamics, Method, Paper, Report, ReportFormat, Request, ResultJson, Stated, Subsurface, answer_or_full,
    atomic_file, stress_table,
};
use crate::solver::full::Solution;
use crate::solver::full::response::check_lubricant;
use crate::solver::observer::{NewtonStep, Observer, WalkStep};
use crate::solver::physics::bodies::Material;
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::training::TrainingObserver;
use clap::Args;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Poisson's ratio of body 1 if it is not given.
const STEEL_POISSON: f64 = Material::STEEL.poisson;

/// Options of `solve`.
#[derive(Debug, Args)]
pub struct SolveArgs {
    #[command(flatten)]
    point: PointOptions,
    /// Write the profiles as CSV: X, Y, P, H, and the same in SI units
    #[arg(long, value_name = "FILE.csv")]
    profiles: Option<PathBuf>,
    /// Write the shear across the film in the plane Y = 0 as CSV: X, Z = z/h, shear stress in Pa, shear rate in 1/s
    #[arg(long, value_name = "FILE.csv")]
    film_shear: Option<PathBuf>,
    /// Write the stress below the surface of body 1 in the plane Y = 0 as CSV, and report its maxima: X, depth Z, the
    /// same in m, stresses in Pa
    #[arg(long, value_name = "FILE.csv")]
    stress: Option<PathBuf>,
    /// Write a report of one page with inputs, results, how they were checked, and figures; the extension selects HTML
    /// (html) or PDF (pdf)
    #[arg(long, value_name = "FILE.pdf")]
    report: Option<PathBuf>,
    /// Title of the report (default: the kind of contact)
    #[arg(long, requires = "report", value_name = "TEXT")]
    title: Option<String>,
    /// Author of the report
    #[arg(long, requires = "report", value_name = "TEXT", default_value = "", hide_default_value = true)]
    author: String,
    /// Company of the report
    #[arg(long, requires = "report", value_name = "TEXT", default_value = "", hide_default_value = true)]
    company: String,
    /// Paper of the report
    #[arg(long, requires = "report", default_value = "a4", value_parser = ["a4", "letter"])]
    paper: String,
    /// System of units of the report
    #[arg(long, requires = "report", default_value = "engineering", value_parser = UnitSystem::ALL.map(UnitSystem::word))]
    units: String,
    /// Estimate the discretisation error of H_c and H_min of a point contact by a second solve on another grid
    #[arg(long)]
    accuracy: bool,
    /// Compute stiffness and damping of the film at these frequencies in Hz, and fit a Maxwell element from three on
    #[arg(long, value_name = "F1,F2", value_delimiter = ',', value_parser = frequency)]
    dynamics: Vec<f64>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Highest accepted frequency \[Hz\], and the largest number of frequencies.
const HIGHEST_HZ: f64 = 1e9;
const MOST_FREQUENCIES: usize = 1000;

fn frequency(text: &str) -> Result<f64, String> {
    let accepted = || format!("frequencies must be numbers between 0 and {HIGHEST_HZ:e} Hz");
    text.parse().ok().filter(|hz| (0.0..=HIGHEST_HZ).contains(hz)).ok_or_else(accepted)
}

/// Checks that the dynamics of the requested contact can be computed.
fn check_dynamics(request: &Request, frequencies: &[f64]) -> Result<(), Failure> {
    if frequencies.is_empty() {
        return Ok(());
    }
    let refused = |problem: &str| Err(Failure::Request(format!("--dynamics {problem}")));
    if frequencies.len() > MOST_FREQUENCIES {
        return refused(&format!("has {} frequencies; accepted are at most {MOST_FREQUENCIES}", frequencies.len()));
    }
    if request.method != Method::Full {
        return refused("belongs to full solutions; leave out --method reduced, or leave out --dynamics");
    }
    check_lubricant(&request.lubricant).or_else(|problem| refused(&format!("is refused: {problem}")))
}

impl SolveArgs {
    /// Returns what the report contains in addition to the answer.
    fn stated(&self, request: &Request) -> Stated {
        let title = || {
            let kind = request.point.kind.name();
            format!("{}{} contact", kind.get(..1).unwrap_or("").to_uppercase(), kind.get(1..).unwrap_or(""))
        };
        let units = UnitSystem::of_word(&self.units).unwrap_or_default();
        let stated = Stated::of_spec(self.title.clone().unwrap_or_else(title), &self.point.0, units);
        Stated { author: self.author.clone(), company: self.company.clone(), ..stated }
    }
}

/// Runs the command.
pub fn run(args: &SolveArgs) -> Result<Verdict, Failure> {
    let request = args.point.0.request()?;
    if args.accuracy && (request.point.kind.is_line() || request.method != Method::Full) {
        return Err(Failure::Request(
            "--accuracy belongs to full solutions of point contacts; add --contact point, or leave it out".to_owned(),
        ));
    }
    check_dynamics(&request, &args.dynamics)?;
    let report_format = args.report.as_ref().map(|path| {
        let refused = || {
            let accepted = "has an unsupported file extension; accepted are html, pdf";
            Failure::Request(format!("--report {} {accepted}", path.display()))
        };
        ReportFormat::of(path).map(|format| (path, format)).ok_or_else(refused)
    });
    let report_format = report_format.transpose()?;
    let mut workbench = Workbench::new("");
    let progress = Progress { begin: Stopwatch::start(), next: AtomicUsize::new(2) };
    let answer = answer_or_full(&mut workbench, &request, &progress)?;
    type Fields = fn(&Solution) -> Table;
    let files: [(&Option<PathBuf>, Fields); 2] = [
        (&args.profiles, |solution| profile_table("profiles", solution)),
        (&args.film_shear, |solution| film_shear_table("film_shear", solution)),
    ];
    for (path, fields) in files.into_iter().filter_map(|(path, fields)| Some((path.as_ref()?, fields))) {
        match answer.fields() {
            Some(solution) => atomic_file::replace(path, fields(solution).to_csv().as_bytes())?,
            None => output::complain(&format!("{} is not written: the solve did not converge", path.display())),
        }
    }
    let mut report = Printed { result: answer.result.json(), accuracy: None, dynamics: None, subsurface: None };
    if let Some(solution) = answer.fields().filter(|_| !args.dynamics.is_empty()) {
        let dynamics = ContactDynamics::of(solution, &args.dynamics, &progress);
        report.dynamics = Some(dynamics.map_err(|problem| Failure::Request(problem.to_string()))?);
    }
    if let (Some(path), Some(solution)) = (&args.stress, answer.fields()) {
        let field = solution.subsurface_stress(args.point.0.nu1.unwrap_or(STEEL_POISSON));
        let field = field.map_err(|error| Failure::Request(error.to_string()))?;
        atomic_file::replace(path, stress_table("stress", &field, &request.point).to_csv().as_bytes())?;
        report.subsurface = Some(Subsurface::of(&field, &request.point));
    } else if let Some(path) = &args.stress {
        output::complain(&format!("{} is not written: the solve did not converge", path.display()));
    }
    if args.accuracy && answer.result.converged {
        report.accuracy = Some(workbench.grid_accuracy(&answer, &progress)?);
    }
    if let Some((path, format)) = report_format {
        let stated = args.stated(&request);
        let paper = if args.paper == "letter" { Paper::Letter } else { Paper::A4 };
        let file = Report::new(&stated, std::slice::from_ref(&answer), paper).file(format);
        atomic_file::replace(path, &file)?;
    }
    if args.json {
        output::print_json(&report)?;
    } else {
        let dynamics = report.dynamics.as_ref().map(described::dynamics);
        let described = described::result(&answer.result, report.accuracy.as_ref(), report.subsurface.as_ref());
        output::print(&(described + &dynamics.unwrap_or_default()))?;
    }
    Ok(if answer.result.converged { Verdict::Done } else { Verdict::FellShort })
}

/// Observer that reports progress on standard error after the first second.
struct Progress {
    begin: Stopwatch,
    /// Time of the next message \[s\].
    next: AtomicUsize,
}

impl Observer for Progress {
    fn newton_step(&self, step: &NewtonStep) {
        let NewtonStep { iteration, step, .. } = step;
        let seconds = self.begin.seconds();
        if seconds >= self.next.load(Ordering::Relaxed) as f64 {
            self.next.store((1.3 * seconds) as usize + 2, Ordering::Relaxed);
            output::complain(&format!("{seconds:.0} s: Newton step {iteration}, the last of size {step:.1e}"));
        }
    }

    fn walk_step(&self, step: &WalkStep) {
        output::complain(&format!("{:.0} s: {step}", self.begin.seconds()));
    }
}

impl TrainingObserver for Progress {}

/// Result, with the stress below the surface and the discretisation error of a point contact if requested.
#[derive(Serialize)]
struct Printed<'a> {
    #[serde(flatten)]
    result: ResultJson<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    accuracy: Option<GridAccuracy>,
    #[serde(flatten)]
    dynamics: Option<ContactDynamics>,
    #[serde(skip_serializing_if = "Option::is_none")]
    subsurface: Option<Subsurface>,
}
