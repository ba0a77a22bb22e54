//! Command `solve`: one operating point.

use super::failure::Failure;
use super::options::PointOptions;
use super::output;
use super::verdict::Verdict;
use crate::engine::{ContactResult, GridAccuracy, Table, Workbench, film_shear_table, profile_table};
use crate::host::clock::Stopwatch;
use crate::scene::{
    ContactDynamics, Method, Paper, Report, ReportFormat, Request, ResultJson, Stated, Subsurface, answer_or_full,
    atomic_file, stress_table,
};
use crate::solver::full::Solution;
use crate::solver::full::heat::Rises;
use crate::solver::full::response::{Dynamics, Maxwell, check_lubricant};
use crate::solver::observer::{NewtonStep, Observer, WalkStep};
use crate::solver::physics::bodies::Material;
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::training::TrainingObserver;
use clap::Args;
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Values with nine decimals: their names here and in a result.
const DIMENSIONLESS: [(&str, &str); 8] = [
    ("H_c", "H_c"),
    ("H_min", "H_min"),
    ("X of H_min", "X_H_min"),
    ("Y of H_min", "Y_H_min"),
    ("P_c", "P_c"),
    ("P_max", "P_max"),
    ("X of P_max", "X_P_max"),
    ("H_0", "H_0"),
];

/// Values with an exponent.
const SMALL: [(&str, &str); 5] = [
    ("h_c [m]", "h_c_m"),
    ("h_min [m]", "h_min_m"),
    ("traction", "traction"),
    ("load residual", "load_residual"),
    ("residual norm", "residual_norm"),
];

/// Calibrated error bounds.
const BOUNDS: [(&str, &str); 4] = [
    ("H_c", "reduced.h_c_error_bound"),
    ("H_min", "reduced.h_min_error_bound"),
    ("traction", "reduced.traction_error_bound"),
    ("rise", "reduced.mid_film_rise_error_bound"),
];

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
        let dynamics = report.dynamics.as_ref().map(described_dynamics);
        let described = describe(&answer.result, report.accuracy.as_ref(), report.subsurface.as_ref());
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

/// Describes stiffness and damping for users.
fn described_dynamics(dynamics: &ContactDynamics) -> String {
    let [stiffness, damping] = dynamics.units();
    let mut lines = Vec::new();
    let mut line = |name: &str, value: String| lines.push(format!("{name:<18} {value}\n"));
    for Dynamics { frequency_hz, stiffness: k, damping: c } in &dynamics.values {
        line(&format!("at {frequency_hz} Hz"), format!("k {k:.6e} {stiffness}, c {c:.6e} {damping}"));
    }
    if let Some(maxwell) = &dynamics.maxwell {
        let Maxwell { static_stiffness, series_stiffness, relaxation_s, parallel_damping, deviation } = maxwell;
        let springs = format!("k_0 {static_stiffness:.4e} and k_1 {series_stiffness:.4e} {stiffness}");
        let dashpots = format!("τ {relaxation_s:.3e} s, c {parallel_damping:.3e} {damping}");
        line("Maxwell element", format!("{springs}, {dashpots}, within {:.1} %", 100.0 * deviation));
    }
    lines.concat()
}

/// Describes the result for users.
fn describe(result: &ContactResult, accuracy: Option<&GridAccuracy>, subsurface: Option<&Subsurface>) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<18} {value}");
    };
    let (point, moes, hertz) = (&result.point, result.point.moes(), result.point.hertz());
    line("method", format!("{}, {} contact", result.method, point.kind.name()));
    line("converged", if result.converged { "yes" } else { "no" }.to_owned());
    if !result.warnings.is_empty() {
        line("warning", result.warning());
    }
    line("R", format!("{:.6e} m", point.radius_m));
    if let (Some(radius_y_m), Some(ratio)) = (point.radius_y_m, point.stated_ratio()) {
        line("R_y", format!("{radius_y_m:.6e} m, R_y/R {ratio:.6}"));
    }
    line("u_m", format!("{:.6e} m/s", point.speed_m_per_s));
    line("w", format!("{:.6e} {}", point.load, point.kind.load_unit()));
    line("E′", format!("{:.6e} Pa", point.modulus_pa));
    line("η₀", format!("{:.6e} Pa·s", point.viscosity_pa_s));
    line("α", format!("{:.6e} 1/Pa", point.alpha_per_pa));
    line("M, L", format!("{:.6}, {:.6}", moes.m, moes.l));
    let across = match point.radius_y_m {
        Some(_) => format!(" b {:.6e} m, κ {:.6},", hertz.half_length_m, point.ellipse().kappa),
        None => String::new(),
    };
    line("Hertz", format!("a {:.6e} m,{across} p_H {:.6e} Pa", hertz.half_width_m, hertz.pressure_pa));
    let nodes = match result.nodes {
        (nx, 1) => nx.to_string(),
        (nx, ny) => format!("{nx}×{ny}"),
    };
    line("grid", format!("{}, {nodes} nodes, {} unknowns", result.grid, result.dofs));
    for (title, name) in DIMENSIONLESS {
        if let Some(value) = result.value(name) {
            line(title, format!("{value:.9}"));
        }
    }
    for (title, name) in SMALL {
        if let Some(value) = result.value(name) {
            line(title, format!("{value:.6e}"));
        }
    }
    if let Some(heat) = &result.heat {
        let rises = |name: &str, at: &Rises| {
            let [first, second] = at.surfaces_k;
            (name.to_owned(), format!("mid-film {:.3} K, body 1 {first:.3} K, body 2 {second:.3} K", at.mid_film_k))
        };
        let of_spike = heat.in_spike.map(|spike| rises("in the spike", &spike));
        let of_film = [rises("rise at X = 0", &heat.central), rises("largest in film", &heat.outside_spike)];
        for (name, value) in of_film.into_iter().chain(of_spike) {
            line(&name, value);
        }
        let [first, second] = heat.into_bodies.map(|share| 100.0 * share);
        line("heat", format!("{first:.1} % into body 1, {second:.1} % into body 2, the rest with the lubricant"));
        line("energy balance", format!("{:.2e}", heat.energy_balance));
    }
    let linear = result.linear_iterations.map_or(String::new(), |n| format!(", {n} linear"));
    line("iterations", format!("{} Newton{linear}", result.newton_iterations));
    if let Some(reduced) = &result.reduced {
        line("reduced", reduced.size.to_string());
        line("in trained range", if reduced.trained { "yes" } else { "no" }.to_owned());
        if let Some(estimate) = result.value("reduced.residual_estimate") {
            line("estimate e_f", format!("{estimate:.3e}"));
        }
        for (title, name) in BOUNDS {
            if let Some(bound) = result.value(name) {
                line(&format!("error of {title}"), format!("below {bound:.2e} (99 % of contacts)"));
            }
        }
    }
    if let Some(accuracy) = accuracy {
        let second = format!("by a second solve on {}×{} nodes", accuracy.nx, accuracy.ny);
        let off = |error: f64, limit: f64| format!("{:.2} %; {limit:.6} in the limit, {second}", 100.0 * error);
        line("grid error of H_c", off(accuracy.h_c_error, accuracy.h_c_limit));
        line("grid error of H_min", off(accuracy.h_min_error, accuracy.h_min_limit));
        if !accuracy.resolved {
            line("", "one of both grids does not resolve the side lobes: the error of H_min may be larger".to_owned());
        }
    }
    if let Some(stress) = subsurface {
        for (name, value, depth) in [
            ("von Mises stress", stress.von_mises_max_pa, stress.von_mises_depth_m),
            ("maximum shear", stress.shear_max_pa, stress.shear_depth_m),
            ("orthogonal shear", stress.orthogonal_shear_max_pa, stress.orthogonal_shear_depth_m),
        ] {
            line(name, format!("{value:.6e} Pa at a depth of {depth:.6e} m"));
        }
    }
    line("time", format!("{:.3} ms", result.wall_s * 1e3));
    text
}
