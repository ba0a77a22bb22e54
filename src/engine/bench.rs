//! Speed table of full and reduced solves, compared with a dense Newton method measured in the same run.
#![allow(clippy::indexing_slicing, reason = "the table's own sizes and points")]

mod heat;
mod sliding;

pub use heat::HEAT_BASELINE;

use super::model_file::ModelFileError;
use super::store::Store;
use super::{EngineError, median, percentile};
use crate::host::clock::Stopwatch;
use crate::scene::named_lubricant;
use crate::scene::study::transient::{Timed, timed_march};
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::full::dense::{dense_kernel, dense_newton};
use crate::solver::full::transient::{FullMarch, Inputs, Keep, Marching, Signal, Trajectory, Transient};
use crate::solver::full::{FullSolver, PointSolver, Problem, Solution, SolveError, SolveOptions, Start};
use crate::solver::parameters::{ParameterSpace, Quantity, distance};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw, Sliding};
use crate::solver::reduced::tpwl::{Selection, TpwlMarch, TpwlModel, TpwlTraining, Weighting};
use crate::solver::reduced::transient::ReducedMarch;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, traction_curve};
use crate::solver::training::{LocalBases, TrajectoryTraining, random_points, train_trajectories};
use serde::Serialize;
use std::sync::Arc;
use std::time::Duration;

/// Baseline of the rows of line contacts: Newton with a dense LU decomposition per step on the same 1201 nodes, as in
/// the dissertation.
pub const BASELINE: &str = "line/dense-newton";

/// Baseline of the rows of point contacts: the full solve from a cold start. A dense LU decomposition of 11960 unknowns
/// would take minutes.
pub const POINT_BASELINE: &str = "point/full/cold";

/// Baseline of the rows of time steps: the full step on the same 1201 nodes.
pub const TRANSIENT_BASELINE: &str = "line/transient/full-step";

/// Time budget of the dense baseline. At least three runs are made.
const BASELINE_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_secs(2)];
/// Time budget of each other row. At least three points are solved.
const ROW_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_millis(500)];
/// Numbers of points of the full rows, the reduced row and the baseline; normal and quick.
const FULL_POINTS: [usize; 2] = [400, 60];
const REDUCED_POINTS: [usize; 2] = [10_000, 1_000];
const BASELINE_POINTS: [usize; 2] = [40, 6];
/// Numbers of shear-thinning line contacts, of contacts of either kind for their reduced models, and of traction
/// curves.
const SHEAR_POINTS: [usize; 2] = [150, 20];
const REDUCED_SHEAR_POINTS: [usize; 2] = [1000, 150];
const CURVES: [usize; 2] = [50, 8];
/// Number of point contacts, and time after which no further solve is started.
const POINT_POINTS: [usize; 2] = [50, 4];
const POINT_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_millis(700)];
/// Training of the trajectory-piecewise-linear model of the same march.
const TPWL_TRAINING: TpwlTraining = TpwlTraining { modes: 100, selection: Selection::Step { tolerance: 1e-3 } };
/// Local bases for the march: number of bases, and modes per basis.
const LOCAL: LocalBases = LocalBases { clusters: 4, modes: 50 };
/// Number of contacts of a traction curve, SRR 0…1.
const CURVE_POINTS: usize = 41;
const SEED: u64 = 2026;
/// Number of marches of a reduced model. A single march is too short for a reproducible median.
const MARCHES: usize = 10;
/// Duration T of the march whose steps are timed.
const MARCH_DURATION: [f64; 2] = [1.5, 0.5];

/// Row of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Name, such as `line/full/cold`.
    pub name: &'static str,
    /// Median time \[s\].
    pub median_s: f64,
    /// 99th percentile of the time \[s\].
    pub p99_s: f64,
    /// Number of measured solves.
    pub runs: usize,
    /// Name of the baseline.
    pub baseline: &'static str,
    /// Speed-up: median of the baseline over this median.
    pub ratio: f64,
}

/// Speed table with notes.
#[derive(Clone, Debug, PartialEq, Serialize, Default)]
pub struct Bench {
    /// Rows.
    pub rows: Vec<Row>,
    /// Missing rows with the reason, and solves that did not converge.
    #[serde(skip)]
    pub notes: Vec<String>,
}

/// Measures the table at random points: in the range of Table 3.1 for line contacts, of Table 3.4 for point contacts,
/// and of Table 3.6 for shear-thinning contacts. All rows of a kind use the same points.
///
/// `quick` uses fewer points and ends within 20 s.
///
/// # Errors
/// If a solver refuses a point of the range.
pub fn run(quick: bool) -> Result<Bench, EngineError> {
    let size = usize::from(quick);
    let points = random_points(&ParameterSpace::table_3_1(), ContactKind::Line, REDUCED_POINTS[size], SEED);
    let lubricant = Lubricant::default();
    let mut solver = FullSolver::new(GridSpec::DISSERTATION)?;
    let mut bench = Bench::default();

    let kernel = dense_kernel(&solver.grid().scaled(1.0));
    let options = SolveOptions::default();
    let dense = timed(BASELINE, BASELINE_BUDGET[size], 3, &points[..BASELINE_POINTS[size]], |point| {
        let (mut system, problem) = solver.cold_system(point, lubricant)?;
        Ok(dense_newton(&mut system, &problem, &options, &kernel) < options.max_newton)
    })?;
    let mut rows = vec![dense];
    let newtonian = |point: &OperatingPoint| Problem::new(point, lubricant);
    let problems = points[..FULL_POINTS[size]].iter().map(newtonian).collect::<Result<Vec<_>, _>>()?;
    rows.extend(cold_and_warm(["line/full/cold", "line/full/warm"], ROW_BUDGET[size], &problems, |problem, start| {
        solver.solve_problem(problem, start, &())
    })?);
    let shear = shear_problems(ContactKind::Line, SHEAR_POINTS[size])?;
    let names = ["line/shear/full/cold", "line/shear/full/warm"];
    rows.extend(cold_and_warm(names, ROW_BUDGET[size], &shear, |problem, start| {
        solver.solve_problem(problem, start, &())
    })?);
    if let Some(mut online) = bench.online("line/reduced", ContactKind::Line, ShearLaw::Newtonian) {
        rows.push(reduced_row("line/reduced", &mut online, (&points, lubricant), true, ROW_BUDGET[size])?);
    }
    let names = ["line/shear/reduced", "line/shear/traction-curve"];
    rows.extend(bench.reduced_shear_rows(names, ContactKind::Line, size)?);
    let names = ["line/sliding/reduced", "line/sliding/reduced/fields", "line/sliding/reduced/1e-3"];
    rows.extend(sliding::rows(&mut bench, ContactKind::Line, names, size)?);
    bench.add(rows, BASELINE);
    bench.add(transient_rows(size)?, TRANSIENT_BASELINE);
    let rows = heat::rows(&mut bench, size)?;
    bench.add(rows, HEAT_BASELINE);
    let shear = shear_problems(ContactKind::Point, POINT_POINTS[size])?;
    let mut rows = point_rows(size, &shear)?;
    if let Some(mut online) = bench.online("point/reduced", ContactKind::Point, ShearLaw::Newtonian) {
        let range = ParameterSpace::table_3_4();
        let points = random_points(&range, ContactKind::Point, REDUCED_POINTS[size], SEED);
        let names = ["point/reduced", "point/reduced/fields", "point/reduced/1e-3"];
        rows.extend(reduced_rows(names, &mut online, (&points, lubricant), POINT_BUDGET[size])?);
    }
    let names = ["point/shear/reduced", "point/shear/traction-curve"];
    rows.extend(bench.reduced_shear_rows(names, ContactKind::Point, size)?);
    let names = ["point/sliding/reduced", "point/sliding/reduced/fields", "point/sliding/reduced/1e-3"];
    rows.extend(sliding::rows(&mut bench, ContactKind::Point, names, size)?);
    rows.extend(heat::balls(&mut bench, size)?);
    bench.add(rows, POINT_BASELINE);
    Ok(bench)
}

impl Bench {
    /// Times reduced solves of shear-thinning contacts of one kind (H_c and traction without fields) and whole traction
    /// curves. Adds a note if there is no model.
    fn reduced_shear_rows(
        &mut self,
        [solve, curve]: [&'static str; 2],
        kind: ContactKind,
        size: usize,
    ) -> Result<Vec<Timing>, EngineError> {
        let Some(mut online) = self.online(solve, kind, named_lubricant::SQUALANE_PIP.shear) else {
            return Ok(Vec::new());
        };
        let problems = shear_problems(kind, REDUCED_SHEAR_POINTS[size])?;
        let points: Vec<OperatingPoint> = problems.iter().map(|problem| problem.point).collect();
        let lubricant = named_lubricant::SQUALANE_PIP;
        let solves = reduced_row(solve, &mut online, (&points, lubricant), false, POINT_BUDGET[size])?;
        let curves = (&points[..CURVES[size]], lubricant);
        Ok(vec![solves, curve_row(curve, &mut online, curves, POINT_BUDGET[size])?])
    }

    /// Returns the online solver with the embedded model of a row. Adds a note if there is none.
    fn online(&mut self, row: &str, kind: ContactKind, shear: ShearLaw) -> Option<Online> {
        let name = match shear {
            ShearLaw::Newtonian => kind.name().to_owned(),
            ShearLaw::Eyring { .. } => format!("{}_sliding", kind.name()),
            _ => format!("{}_shear", kind.name()),
        };
        let model = self.model(row, &name);
        model.map(|model| Online::new(model, ReducedOptions::default()))
    }

    /// Returns the embedded model of a row. Adds a note if there is none.
    fn model(&mut self, row: &str, name: &str) -> Option<Arc<ReducedModel>> {
        let missing = |reason: &ModelFileError| self.notes.push(format!("{row} is missing: {reason}"));
        Store::default().embedded(name).inspect_err(missing).ok()
    }

    /// Adds rows that are compared with the first of them.
    fn add(&mut self, rows: Vec<Timing>, baseline: &'static str) {
        let reference = rows.first().map_or(f64::NAN, |first| median(&first.seconds));
        for timing in rows {
            if timing.failures > 0 {
                self.notes.push(format!("{}: {} solves did not converge", timing.name, timing.failures));
            }
            let median_s = median(&timing.seconds);
            self.rows.push(Row {
                name: timing.name,
                median_s,
                p99_s: percentile(&timing.seconds, 0.99),
                runs: timing.seconds.len(),
                baseline,
                ratio: reference / median_s,
            });
        }
    }
}

/// Times full solves of point contacts on 301×41 nodes, cold and from the nearest other solution.
fn point_rows(size: usize, shear: &[Problem]) -> Result<Vec<Timing>, EngineError> {
    let range = ParameterSpace::table_3_4();
    let points = random_points(&range, ContactKind::Point, POINT_POINTS[size], SEED);
    let newtonian = |point: &OperatingPoint| Problem::new(point, Lubricant::default());
    let newtonian = points.iter().map(newtonian).collect::<Result<Vec<_>, _>>()?;
    let mut solver = PointSolver::new(PointGridSpec::DISSERTATION)?;
    let mut rows = Vec::new();
    for (names, problems) in [
        ([POINT_BASELINE, "point/full/warm"], newtonian.as_slice()),
        (["point/shear/full/cold", "point/shear/full/warm"], shear),
    ] {
        let solve = |problem, start: Start<'_>| solver.solve_problem(problem, start, &());
        rows.extend(cold_and_warm(names, POINT_BUDGET[size], problems, solve)?);
    }
    Ok(rows)
}

/// Returns random contacts of Table 3.5 in the ranges of Table 3.6. The distribution is uniform in ln u_m, SRR and NPR.
fn shear_problems(kind: ContactKind, count: usize) -> Result<Vec<Problem>, EngineError> {
    let lubricant = named_lubricant::SQUALANE_PIP;
    let mut random = fastrand::Rng::with_seed(SEED);
    let problem = |_| {
        let point = OperatingPoint {
            kind,
            radius_m: 12.7e-3,
            speed_m_per_s: 0.1 * 50f64.powf(random.f64()),
            // The load of the line contact gives the same Hertzian pressure as 23 N on the point contact.
            load: if kind.is_line() { 144e3 } else { 23.0 },
            modulus_pa: 1.2388e11,
            viscosity_pa_s: 0.0705,
            alpha_per_pa: 2e-8,
            sliding: Sliding {
                slide_to_roll_ratio: random.f64(),
                newtonian_plateau_ratio: Some(0.2 + 0.8 * random.f64()),
            },
            radius_y_m: None,
        };
        Ok(Problem::new(&point, lubricant)?)
    };
    (0..count).map(problem).collect()
}

/// Solves cold, then each contact again from the nearest other solution.
fn cold_and_warm(
    names: [&'static str; 2],
    budget: Duration,
    problems: &[Problem],
    mut solve: impl FnMut(Problem, Start<'_>) -> Result<Solution, SolveError>,
) -> Result<[Timing; 2], EngineError> {
    let mut solutions: Vec<Solution> = Vec::new();
    let cold = timed(names[0], budget, 4, problems, |&problem| {
        let solution = solve(problem, Start::Cold)?;
        let converged = solution.converged();
        solutions.extend(Some(solution).filter(Solution::converged));
        Ok(converged)
    })?;
    let starts = solutions.iter().enumerate().filter_map(|(k, own)| Some((own, nearest_other(&solutions, k)?)));
    let warm =
        timed(names[1], budget, 4, starts, |(own, start)| Ok(solve(own.problem, Start::From(start))?.converged()))?;
    Ok([cold, warm])
}

/// Times steps of the full solver and of transient reduced models: the load of case 1 of Table 4.1 on the contact of
/// Table 4.2, in the fixed frame.
fn transient_rows(size: usize) -> Result<Vec<Timing>, EngineError> {
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 1.0 / 3.0 });
    let transient = Transient::new(OperatingPoint::TABLE_4_2, load, MARCH_DURATION[size], 2.5e-3);
    let transient = Transient { keep: Keep::Every(1), ..transient };
    let grid = GridSpec::DISSERTATION.line().map_err(SolveError::from)?;
    let mut full = Timing::new(TRANSIENT_BASELINE);
    let trajectory = full.add_steps(&mut FullMarch::new(Arc::clone(&grid), &transient)?, &transient)?;
    let settings = TrajectoryTraining { loss: 1e-5, ..TrajectoryTraining::default() };
    let linearised = TpwlModel::train(&[&trajectory], TPWL_TRAINING)?;
    let trained = |settings: &TrajectoryTraining| {
        train_trajectories(&grid, std::slice::from_ref(&trajectory), settings, &()).map(Arc::new)
    };
    let local = TrajectoryTraining { local: Some(LOCAL), rows_per_mode: 3.0, ..settings };
    let (model, local) = (trained(&settings)?, trained(&local)?);
    // The marches of models store no fields, as in typical use.
    let transient = Transient { keep: Keep::Scalars, ..transient };
    let names = ["line/transient/rnsa-step", "line/transient/local-step", "line/transient/tpwl-step"];
    let [mut reduced, mut nearest, mut superposed] = names.map(Timing::new);
    for _ in 0..MARCHES {
        reduced.add_steps(&mut ReducedMarch::new(&model, &transient)?, &transient)?;
        nearest.add_steps(&mut ReducedMarch::new(&local, &transient)?, &transient)?;
        superposed.add_steps(&mut TpwlMarch::new(&linearised, &transient, Weighting::DualTaylor)?, &transient)?;
    }
    Ok(vec![full, reduced, nearest, superposed])
}

/// Times reduced solves one after the other, with the reconstruction of all fields and their scalars if `fields` is
/// true.
fn reduced_row(
    name: &'static str,
    online: &mut Online,
    (points, lubricant): (&[OperatingPoint], Lubricant),
    fields: bool,
    budget: Duration,
) -> Result<Timing, EngineError> {
    if let Some(first) = points.first() {
        // Building the operators of the model is not part of a solve.
        online.prepare(first);
    }
    timed(name, budget, 3, points, |point| {
        Ok(match online.solve(point, lubricant) {
            Ok(solution) if fields => online.scalars(&solution).is_ok(),
            solved => solved.is_ok(),
        })
    })
}

/// Times reduced solves with their scalars, with all fields, and with a relative step tolerance of 1e-3 and without
/// fields. The latter does not increase the error against the full solution.
fn reduced_rows(
    [scalars, fields, swift]: [&'static str; 3],
    online: &mut Online,
    contacts: (&[OperatingPoint], Lubricant),
    budget: Duration,
) -> Result<[Timing; 3], EngineError> {
    let options = ReducedOptions { tolerance: 1e-3, ..ReducedOptions::default() };
    let mut ended_early = Online::new(Arc::clone(&online.model), options);
    Ok([
        reduced_row(scalars, online, contacts, false, budget)?,
        reduced_row(fields, online, contacts, true, budget)?,
        reduced_row(swift, &mut ended_early, contacts, false, budget)?,
    ])
}

/// Times whole traction curves over SRR by a reduced model, one for the speed, load and plateau ratio of each point.
fn curve_row(
    name: &'static str,
    online: &mut Online,
    (points, lubricant): (&[OperatingPoint], Lubricant),
    budget: Duration,
) -> Result<Timing, EngineError> {
    let values: Vec<f64> = (0..CURVE_POINTS).map(|k| k as f64 / (CURVE_POINTS - 1) as f64).collect();
    points.iter().for_each(|point| online.prepare(point));
    timed(name, budget, 3, points, |point| {
        let curve = traction_curve(online, point, lubricant, Quantity::SlideToRollRatio, &values);
        let converged = curve.filter(|place| place.solution.as_ref().is_ok_and(|solved| solved.traction.is_some()));
        Ok(converged.count() == values.len())
    })
}

/// Returns the solution nearest to number `k` by (3.20) and in SRR and NPR, other than itself.
fn nearest_other(solutions: &[Solution], k: usize) -> Option<&Solution> {
    let far = |other: &Solution| {
        let (a, b) = (&solutions[k].problem, &other.problem);
        distance(a.moes, b.moes) + a.point.sliding.distance(b.point.sliding)
    };
    let others = solutions.iter().enumerate().filter(|&(i, _)| i != k).map(|(_, solution)| solution);
    others.min_by(|a, b| far(a).total_cmp(&far(b)))
}

struct Timing {
    name: &'static str,
    seconds: Vec<f64>,
    failures: usize,
}

/// Times `solve`, which returns whether it converged, for one item after the other until the budget is used up, and for
/// at least `least` items.
fn timed<T>(
    name: &'static str,
    budget: Duration,
    least: usize,
    items: impl IntoIterator<Item = T>,
    mut solve: impl FnMut(T) -> Result<bool, EngineError>,
) -> Result<Timing, EngineError> {
    let (begun, mut timing) = (Stopwatch::start(), Timing::new(name));
    for item in items {
        if begun.elapsed() > budget && timing.seconds.len() >= least {
            break;
        }
        let clock = Stopwatch::start();
        let converged = solve(item)?;
        timing.seconds.push(clock.seconds());
        timing.failures += usize::from(!converged);
    }
    Ok(timing)
}

impl Timing {
    fn new(name: &'static str) -> Self {
        Self { name, seconds: Vec::new(), failures: 0 }
    }

    /// Marches and records the time of every step.
    fn add_steps(&mut self, model: &mut dyn Marching, transient: &Transient) -> Result<Trajectory, EngineError> {
        let Timed { trajectory, seconds } = timed_march(model, transient, String::new(), &(), None)?;
        self.seconds.extend(seconds);
        self.failures += usize::from(!trajectory.finished());
        Ok(trajectory)
    }
}
