//! `solve`: one operating point.

use super::failure::Failure;
use super::options::PointOptions;
use super::{Verdict, output};
use crate::engine::{PointReport, Table, Workbench, film_shear_table, profile_table};
use crate::scene::{Method, atomic_file};
use crate::solver::full::Solution;
use crate::solver::physics::contact::ContactKind;
use clap::Args;
use std::fmt::Write;
use std::path::PathBuf;

/// Options of `solve`.
#[derive(Debug, Args)]
pub struct SolveArgs {
    #[command(flatten)]
    point: PointOptions,
    /// Write the profiles as CSV: X, Y, P, H and their SI twins
    #[arg(long, value_name = "FILE.csv")]
    profiles: Option<PathBuf>,
    /// Write the shear across the film in the plane Y = 0 as CSV: X, Z = z/h, stress in Pa, rate in 1/s
    #[arg(long, value_name = "FILE.csv")]
    film_shear: Option<PathBuf>,
    /// Estimate what a point contact's grid costs H_c and H_min, by a second solve on another grid
    #[arg(long)]
    accuracy: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub fn run(args: &SolveArgs) -> Result<Verdict, Failure> {
    let (request, method) = args.point.request()?;
    if args.accuracy && (request.point.kind == ContactKind::Line || method != Method::Full) {
        return Err(Failure::Request(
            "--accuracy belongs to full solutions of point contacts; add --contact point, or leave it out".to_owned(),
        ));
    }
    let mut workbench = Workbench::new("");
    let answer = workbench.answer(&request, &method, None, &())?;
    type Fields = fn(&Solution) -> Table;
    let files: [(&Option<PathBuf>, Fields); 2] = [
        (&args.profiles, |solution| profile_table("profiles", solution)),
        (&args.film_shear, |solution| film_shear_table("film_shear", solution)),
    ];
    for (path, fields) in files.into_iter().filter_map(|(path, fields)| Some((path.as_ref()?, fields))) {
        match answer.result() {
            Some(solution) => atomic_file::replace(path, fields(solution).to_csv().as_bytes())?,
            None => output::complain(&format!("{} is not written: the solve did not converge", path.display())),
        }
    }
    let mut report = PointReport::from(&answer);
    if args.accuracy && answer.converged {
        report.accuracy = Some(workbench.grid_accuracy(&answer, &())?);
    }
    if args.json {
        output::print_json(&report)?;
    } else {
        output::print(&describe(&report))?;
    }
    Ok(if answer.converged { Verdict::Done } else { Verdict::FellShort })
}

/// The report for people.
fn describe(report: &PointReport) -> String {
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name:<18} {value}");
    };
    let (si, grid) = (&report.si, &report.grid);
    line("method", format!("{}, {} contact", report.method, report.contact));
    line("converged", if report.converged { "yes" } else { "no" }.to_owned());
    if let Some(warning) = &report.warning {
        line("warning", warning.clone());
    }
    line("R", format!("{:.6e} m", si.radius));
    line("u_m", format!("{:.6e} m/s", si.speed));
    let unit = if report.contact == "line" { "N/m" } else { "N" };
    line("w", format!("{:.6e} {unit}", si.load));
    line("E′", format!("{:.6e} Pa", si.modulus));
    line("η₀", format!("{:.6e} Pa·s", si.viscosity));
    line("α", format!("{:.6e} 1/Pa", si.alpha));
    line("M, L", format!("{:.6}, {:.6}", report.moes.m, report.moes.l));
    line("Hertz", format!("a {:.6e} m, p_H {:.6e} Pa", report.hertz.a_m, report.hertz.p_h_pa));
    let nodes = if grid.ny == 1 { grid.nx.to_string() } else { format!("{}×{}", grid.nx, grid.ny) };
    line("grid", format!("{}, {nodes} nodes, {} unknowns", grid.kind, grid.dofs));
    let s = &report.scalars;
    let numbers = [
        ("H_c", s.h_c),
        ("H_min", s.h_min),
        ("X of H_min", s.x_h_min),
        ("Y of H_min", s.y_h_min),
        ("P_c", s.p_c),
        ("P_max", s.p_max),
        ("X of P_max", s.x_p_max),
        ("H_0", s.h_0),
    ];
    for (name, value) in numbers {
        if let Some(value) = value {
            line(name, format!("{value:.9}"));
        }
    }
    let small = [
        ("h_c [m]", s.h_c_m),
        ("h_min [m]", s.h_min_m),
        ("traction", s.traction),
        ("load residual", s.load_residual),
        ("residual norm", report.residual_norm),
    ];
    for (name, value) in small {
        if let Some(value) = value {
            line(name, format!("{value:.6e}"));
        }
    }
    let linear = report.linear_iterations.map_or(String::new(), |n| format!(", {n} linear"));
    line("iterations", format!("{} Newton{linear}", report.newton_iterations));
    if let Some(reduced) = &report.reduced {
        let (p, delta, rows) = (reduced.basis_p, reduced.basis_delta, reduced.sampled_rows);
        line("reduced", format!("{p} pressure modes, {delta} deformation modes, {rows} sampled rows"));
        line("trained here", if reduced.trained { "yes" } else { "no" }.to_owned());
        if let Some(estimate) = reduced.residual_estimate {
            line("estimate e_f", format!("{estimate:.3e}"));
        }
        let bounds = [
            ("H_c", reduced.h_c_error_bound),
            ("H_min", reduced.h_min_error_bound),
            ("traction", reduced.traction_error_bound),
        ];
        for (name, bound) in bounds {
            if let Some(bound) = bound {
                line(&format!("error of {name}"), format!("below {:.2e} (99 of 100)", bound));
            }
        }
    }
    if let Some(accuracy) = &report.accuracy {
        let second = format!("by a second solve on {}×{} nodes", accuracy.nx, accuracy.ny);
        let off = |error: f64, limit: f64| format!("{:.2} %; {limit:.6} in the limit, {second}", 100.0 * error);
        line("grid error of H_c", off(accuracy.h_c_error, accuracy.h_c_limit));
        line("grid error of H_min", off(accuracy.h_min_error, accuracy.h_min_limit));
        if !accuracy.resolved {
            line("", "one of both grids does not resolve the side lobes: the error of H_min may be larger".to_owned());
        }
    }
    line("time", format!("{:.3} ms", report.wall_s * 1e3));
    text
}
