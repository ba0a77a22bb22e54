//! Observed order of H_c on ever finer uniform grids, and the value they tend to.

use super::answer::Request;
use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::run::{request_of, step};
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{Grid, Method, Scene};
use crate::solver::full::Solution;
use crate::solver::training::TrainingObserver;

/// Runs the study. Values: `H_c.1`, … (coarsest first), `order` (of the three finest grids), `order.1`, … (of each three neighbours, coarsest first),
/// `H_c_extrapolated` (Richardson, from the two finest), `H_c_error` (relative, of the finest).
pub(super) fn run(
    scene: &Scene,
    spacings: &[f64],
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let template = request_of(scene)?;
    let of = Some(&Method::Full);
    let mut table = Table::new("grids", &["dx", "nodes", "H_c", "H_min", "P_c", "newton_iterations", "wall_s"]);
    let mut former: Option<Solution> = None;
    for (i, &dx) in spacings.iter().enumerate() {
        step(observer, "grids", i, spacings.len())?;
        let grid = match scene.grid {
            Grid::Uniform { domain, .. } => Grid::Uniform { dx, domain },
            Grid::Plane { dy, domain, refinement, .. } => Grid::Plane { dx, dy, domain, refinement },
            _ => return Err(EngineError::Study("a grid study needs a Uniform or Plane `grid`".to_owned())),
        };
        let request = Request { grid, ..template.clone() };
        let answer = workbench.answer(&request, &Method::Full, former.as_ref(), observer)?;
        outcome.warnings.extend(answer.warnings.iter().map(|warning| format!("dx {dx}: {warning}")));
        outcome.converged &= answer.converged;
        let scalars = answer.result().map(|solution| solution.scalars);
        let [h_c, h_min, p_c] = scalars.map_or([f64::NAN; 3], |s| [s.h_c, s.h_min, s.p_c]);
        table.rows.push(vec![
            dx,
            (answer.nodes * answer.nodes_across) as f64,
            h_c,
            h_min,
            p_c,
            answer.newton_iterations as f64,
            answer.wall_s,
        ]);
        former = answer.solution.filter(|_| answer.converged);
    }
    for (i, row) in table.rows.iter().enumerate() {
        outcome.push(format!("H_c.{}", i + 1), of, row[2]);
    }
    let films: Vec<f64> = table.rows.iter().map(|row| row[2]).collect();
    let ratio = spacings[0] / spacings[1];
    let mut order = f64::NAN;
    for (i, h) in films.windows(3).enumerate() {
        order = ((h[0] - h[1]) / (h[1] - h[2])).ln() / ratio.ln();
        outcome.push(format!("order.{}", i + 1), of, order);
    }
    outcome.push("order", of, order);
    if let [.., coarse, fine] = films[..] {
        let limit = fine + (fine - coarse) / (ratio * ratio - 1.0);
        outcome.push("H_c_extrapolated", of, limit);
        outcome.push("H_c_error", of, (fine / limit - 1.0).abs());
    }
    outcome.tables.push(table);
    Ok(())
}
