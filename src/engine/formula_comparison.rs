//! Full solutions against a published film formula.

use super::answer::Request;
use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::run::{request_of, step};
use super::statistics::median;
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{At, Formula, Method, Scene};
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::TrainingObserver;

/// Runs the comparison. Values: `failures`, `deviation_median`, `deviation_max` (relative, of full against formula).
pub(super) fn run(
    scene: &Scene,
    formula: Formula,
    m: &[f64],
    l: &[f64],
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let template = request_of(scene)?;
    let formula = formula.film_formula();
    let mut table = Table::new("formula", &["M", "L", "h_full_m", "h_formula_m", "deviation", "in_range"]);
    let mut failures = 0;
    let mut former: Option<Solution> = None;
    for &l in l {
        for &m in m {
            step(observer, "formula comparison", table.rows.len(), table.rows.len() + 1)?;
            let point = At::moes(m, l).point(scene.contact)?;
            let request = Request { point: OperatingPoint { sliding: scene.sliding(), ..point }, ..template.clone() };
            let answer = workbench.answer(&request, &Method::Full, former.as_ref(), observer)?;
            let film = answer.result().map_or(f64::NAN, |solution| {
                let s = &solution.scalars;
                point.film_scale_m() * if formula.predicts_minimum() { s.h_min } else { s.h_c }
            });
            let predicted = formula.predict(&point);
            failures += usize::from(!answer.converged);
            let in_range = f64::from(u8::from(predicted.in_range));
            table.rows.push(vec![m, l, film, predicted.film_m, film / predicted.film_m - 1.0, in_range]);
            former = answer.solution.filter(|_| answer.converged).or(former);
        }
    }
    let deviations: Vec<f64> = table.rows.iter().map(|row| row[4].abs()).filter(|d| d.is_finite()).collect();
    let of = Some(&Method::Full);
    outcome.converged &= failures == 0;
    outcome.push("failures", of, failures as f64);
    outcome.push("deviation_median", of, median(&deviations));
    outcome.push("deviation_max", of, deviations.iter().copied().fold(f64::NAN, f64::max));
    outcome.tables.push(table);
    Ok(())
}
