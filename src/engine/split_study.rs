//! Where the error of a reduced model comes from, at one contact or along the test trajectory.

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::run::step;
use super::statistics::{median, percentile};
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{Contacts, Method, Scene};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{ErrorSplit, ErrorSplitter, Parts, ReducedOptions, SplitError};
use crate::solver::training::TrainingObserver;

/// Columns of one scalar's parts.
const PARTS: [&str; 6] = ["basis", "projection", "sampling", "reduction", "discretisation", "whole"];
/// Columns of the pressure's parts, lengths in the weighted norm.
const PRESSURE: [&str; 4] = ["e_P.basis", "e_P.projection", "e_P.sampling", "e_P.reduction"];

/// Runs the study. Values: `failures`; for `H_c` and `H_min` and each part `H_c.basis_median`, `H_c.basis_max` and so on (sizes,
/// relative to the full film), `e_P.basis_median` likewise; at a single contact also the signed `H_c.basis` and `e_P.basis`.
pub(super) fn run(
    scene: &Scene,
    contacts: &Contacts,
    method: &Method,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let Some(source) = method.model() else {
        return Err(EngineError::Study("an error split needs a Reduced `method`".to_owned()));
    };
    let model = workbench.model(source, scene.contact, observer)?;
    let points = points_of(scene, contacts)?;
    let mut splitter = ErrorSplitter::new(model, ReducedOptions::default());
    let films = ["H_c", "H_min"].iter().flat_map(|film| PARTS.map(|part| format!("{film}.{part}")));
    let mut columns: Vec<String> = ["c", "M", "L", "alpha", "H_c", "H_min"].map(str::to_owned).to_vec();
    let first = columns.len();
    columns.extend(films.chain(PRESSURE.map(str::to_owned)));
    let mut table =
        Table { name: "error_split".to_owned(), columns, rows: Vec::with_capacity(points.len()), labels: Vec::new() };
    let mut failures = 0;
    for (i, (c, point)) in points.iter().enumerate() {
        step(observer, "error splits", i, points.len())?;
        let moes = point.moes();
        match splitter.split(point, scene.lubricant, observer) {
            Ok(split) => {
                let mut row = vec![*c, moes.m, moes.l, point.alpha_per_pa, split.full.h_c, split.full.h_min];
                row.extend(numbers(&split));
                table.rows.push(row);
            }
            Err(SplitError::Cancelled) => return Err(EngineError::Cancelled),
            Err(SplitError::Problem(refused)) => return Err(refused.into()),
            Err(error) => {
                failures += 1;
                outcome.warnings.push(format!("M = {:.4}, L = {:.4}: {error}", moes.m, moes.l));
            }
        }
    }
    let of = Some(method);
    outcome.converged &= failures == 0;
    outcome.push("points", None, points.len() as f64);
    outcome.push("failures", of, f64::from(failures));
    for (k, name) in table.columns.iter().enumerate().skip(first) {
        let sizes: Vec<f64> = table.rows.iter().map(|row| row[k].abs()).collect();
        outcome.push(format!("{name}_median"), of, median(&sizes));
        outcome.push(format!("{name}_max"), of, percentile(&sizes, 1.0));
        if let ([row], 1) = (&table.rows[..], points.len()) {
            outcome.push(name.as_str(), of, row[k]);
        }
    }
    outcome.tables.push(table);
    Ok(())
}

/// The contacts with their running parameter c; NaN where there is none.
fn points_of(scene: &Scene, contacts: &Contacts) -> Result<Vec<(f64, OperatingPoint)>, EngineError> {
    match contacts {
        Contacts::Here => Ok(vec![(f64::NAN, scene.point()?)]),
        Contacts::Trajectory { range, points } => (0..*points)
            .map(|i| {
                let c = 2.0 * i as f64 / (points - 1) as f64;
                let point = range.trajectory(scene.contact, c);
                point.check()?;
                Ok((c, point))
            })
            .collect(),
    }
}

/// The numbers of a split in the order of the columns.
fn numbers(split: &ErrorSplit) -> impl Iterator<Item = f64> {
    let of = |p: &Parts| [p.basis, p.projection, p.sampling, p.reduction(), p.discretisation, p.whole()];
    let p = split.pressure;
    let pressure = [p.basis, p.projection, p.sampling, p.reduction];
    of(&split.h_c).into_iter().chain(of(&split.h_min)).chain(pressure)
}
