//! Contacts with heat in the speed table.

use super::{Bench, CURVES, EngineError, POINT_BUDGET, ROW_BUDGET, Timing, cold_and_warm, curve_row, reduced_row};
use crate::engine::Embedded;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{FullSolver, Problem};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::reduced::{Online, ReducedOptions};
use crate::solver::training::{HeatedRange, Range, random_points};

/// What all rows of contacts with heat are compared with: the cold full solve on the graded grid of their model.
pub const HEAT_BASELINE: &str = "line/heat/full/cold";

/// Contacts in full, of either start, and by the model.
const FULL_POINTS: [usize; 2] = [150, 12];
const REDUCED_POINTS: [usize; 2] = [1000, 60];
const SEED: u64 = 2027;

/// The grid of the models with heat, of public reference solutions too.
const GRID: GridSpec = GridSpec::Graded { nodes: 695, domain: (-10.0, 2.0), registered: false };

/// One oil between steel bodies, up to 6 m/s.
const RANGE: HeatedRange = HeatedRange {
    m: (5.0, 100.0),
    l: (2.5, 11.0),
    srr: (0.0, 0.8),
    radius: 0.01,
    modulus: 231e9,
    viscosity: 0.02,
    alpha: 1.8e-8,
    max_hertz_pressure: 1.4e9,
};

/// Steel balls in one oil, up to 3 m/s of sliding.
const BALLS: HeatedRange = HeatedRange { m: (15.0, 120.0), max_hertz_pressure: 1.8e9, ..RANGE };

/// Solves of lines in full, cold and from the nearest other solution, reduced ones with H_c, traction and temperatures, and
/// whole traction curves; a note where there is no model.
pub(super) fn rows(bench: &mut Bench, size: usize) -> Result<Vec<Timing>, EngineError> {
    let Some(model) = bench.model(HEAT_BASELINE, Embedded::HeatedLine) else { return Ok(Vec::new()) };
    let (lubricant, spec) = (model.domain.lubricant, GRID);
    let mut solver = FullSolver::new(spec)?;
    let points = random_points(&Range::Heated(RANGE), ContactKind::Line, REDUCED_POINTS[size], SEED);
    let problem = |point: &OperatingPoint| Problem::new(point, lubricant);
    let problems = points.iter().take(FULL_POINTS[size]).map(problem).collect::<Result<Vec<_>, _>>()?;
    let names = [HEAT_BASELINE, "line/heat/full/warm"];
    let mut rows: Vec<Timing> =
        cold_and_warm(names, ROW_BUDGET[size], &problems, |problem, start| solver.solve_problem(problem, start, &()))?
            .into();
    let mut online = Online::new(model, ReducedOptions::default());
    rows.push(reduced_row("line/heat/reduced", &mut online, (&points, lubricant), false, ROW_BUDGET[size])?);
    let curves = (points.get(..CURVES[size]).unwrap_or(&points), lubricant);
    rows.push(curve_row("line/heat/traction-curve", &mut online, curves, ROW_BUDGET[size])?);
    Ok(rows)
}

/// Reduced solves of balls with H_c, traction and temperatures; a note where there is no model.
pub(super) fn balls(bench: &mut Bench, size: usize) -> Result<Vec<Timing>, EngineError> {
    const NAME: &str = "point/heat/reduced";
    let Some(model) = bench.model(NAME, Embedded::HeatedCircle) else { return Ok(Vec::new()) };
    let lubricant = model.domain.lubricant;
    let points = random_points(&Range::Heated(BALLS), ContactKind::Point, REDUCED_POINTS[size], SEED);
    let mut online = Online::new(model, ReducedOptions::default());
    Ok(vec![reduced_row(NAME, &mut online, (&points, lubricant), false, POINT_BUDGET[size])?])
}
