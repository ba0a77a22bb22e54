//! Thermal contacts in the speed table.

use super::{Bench, CURVES, EngineError, POINT_BUDGET, ROW_BUDGET, Timing, cold_and_warm, curve_row, reduced_row};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::{FullSolver, Problem};
use crate::solver::parameters::{Axis, ParameterSpace, Quantity};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::reduced::{Online, ReducedOptions};
use crate::solver::training::random_points;

/// Baseline of the rows of thermal contacts: the full solve from a cold start on the graded grid of their model.
pub const HEAT_BASELINE: &str = "line/heat/full/cold";

/// Numbers of contacts for full solves (cold and warm) and for reduced solves; normal and quick.
const FULL_POINTS: [usize; 2] = [150, 12];
const REDUCED_POINTS: [usize; 2] = [1000, 60];
const SEED: u64 = 2027;

/// Grid of the thermal models, also used for reference solutions.
const GRID: GridSpec = GridSpec::Graded { nodes: 695, domain: (-10.0, 2.0), registered: false };

/// Returns the range of thermal contacts of one lubricant between steel bodies.
fn range(m: (f64, f64), highest_pressure_pa: f64) -> ParameterSpace {
    ParameterSpace::of([
        Axis::new(Quantity::M, m),
        Axis::new(Quantity::L, (2.5, 11.0)),
        Axis::new(Quantity::SlideToRollRatio, (0.0, 0.8)),
    ])
    .limited([(Quantity::HertzPressure, (0.0, highest_pressure_pa))])
    .fixing([
        (Quantity::Radius, 0.01),
        (Quantity::Modulus, 231e9),
        (Quantity::Viscosity, 0.02),
        (Quantity::Alpha, 1.8e-8),
    ])
}

/// Times full solves of line contacts (cold and from the nearest other solution), reduced solves with H_c, traction and
/// temperatures, and whole traction curves. Adds a note if there is no model.
pub(super) fn rows(bench: &mut Bench, size: usize) -> Result<Vec<Timing>, EngineError> {
    let Some(model) = bench.model(HEAT_BASELINE, "line_heat") else { return Ok(Vec::new()) };
    let (lubricant, spec) = (model.domain.lubricant, GRID);
    let mut solver = FullSolver::new(spec)?;
    let points = random_points(&range((5.0, 100.0), 1.4e9), ContactKind::Line, REDUCED_POINTS[size], SEED);
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

/// Times reduced solves of circular contacts with H_c, traction and temperatures. Adds a note if there is no model.
pub(super) fn balls(bench: &mut Bench, size: usize) -> Result<Vec<Timing>, EngineError> {
    const NAME: &str = "point/heat/reduced";
    let Some(model) = bench.model(NAME, "point_heat") else { return Ok(Vec::new()) };
    let lubricant = model.domain.lubricant;
    let points = random_points(&range((15.0, 120.0), 1.8e9), ContactKind::Point, REDUCED_POINTS[size], SEED);
    let mut online = Online::new(model, ReducedOptions::default());
    Ok(vec![reduced_row(NAME, &mut online, (&points, lubricant), false, POINT_BUDGET[size])?])
}
