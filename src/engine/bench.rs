//! The speed table: full and reduced side by side, against a dense Newton measured in the same run.
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

/// What all rows of line contacts are compared with: Newton with a dense LU per step on the same 1201 nodes, as the
/// dissertation has it.
pub const BASELINE: &str = "line/dense-newton";

/// What all rows of point contacts are compared with: the cold full solve. A dense LU of 11960 unknowns would take
/// minutes.
pub const POINT_BASELINE: &str = "point/full/cold";

/// What all rows of steps in time are compared with: the full step on the same 1201 nodes.
pub const TRANSIENT_BASELINE: &str = "line/transient/full-step";

/// The dense baseline may take this long; at least three runs are made whatever they take.
const BASELINE_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_secs(4)];
/// Each other row stops drawing further points after this, and after three of them.
const ROW_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_millis(1500)];
/// Points of the full rows and of the reduced row.
const FULL_POINTS: [usize; 2] = [400, 60];
const REDUCED_POINTS: [usize; 2] = [10_000, 1_000];
const BASELINE_POINTS: [usize; 2] = [40, 6];
/// Shear-thinning line contacts, of either kind for their reduced models, and how many of these have a traction curve.
const SHEAR_POINTS: [usize; 2] = [150, 20];
const REDUCED_SHEAR_POINTS: [usize; 2] = [1000, 150];
const CURVES: [usize; 2] = [50, 8];
/// Point contacts: solves, and the time after which no further ones are begun.
const POINT_POINTS: [usize; 2] = [50, 4];
const POINT_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_millis(700)];
/// The trajectory-piecewise-linear model of the same march.
const TPWL_TRAINING: TpwlTraining = TpwlTraining { modes: 100, selection: Selection::Step { tolerance: 1e-3 } };
/// Modes of local bases along that march, and how many bases.
const LOCAL: LocalBases = LocalBases { clusters: 4, modes: 50 };
/// Contacts of a traction curve, SRR 0…1.
const CURVE_POINTS: usize = 41;
const SEED: u64 = 2026;
/// Marches of a reduced model: one of them is over too soon for a median that can be repeated.
const MARCHES: usize = 10;
/// Duration of the march whose steps are timed.
const MARCH_DURATION: [f64; 2] = [1.5, 0.5];

/// One line of the table.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// `line/full/cold` and so on.
    pub name: &'static str,
    /// Median \[s\].
    pub median_s: f64,
    /// 99th percentile \[s\].
    pub p99_s: f64,
    /// Solves measured.
    pub runs: usize,
    /// What the ratio refers to.
    pub baseline: &'static str,
    /// Median of the baseline over this median: how many times faster.
    pub ratio: f64,
}

/// The table, and what a reader must know about it.
#[derive(Clone, Debug, PartialEq, Serialize, Default)]
pub struct Bench {
    /// The lines.
    pub rows: Vec<Row>,
    /// Lines that are missing and why; solves that did not converge.
    #[serde(skip)]
    pub notes: Vec<String>,
}

/// Measures the table over random points of Table 3.1's box for line and of Table 3.4's for point contacts, and of
/// Table 3.6's ranges for shear-thinning ones: the same points for every row of a kind.
///
/// `quick` takes fewer points and ends within 20 s.
///
/// # Errors
/// When a solver refuses a point of the box, which it never should.
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
    /// Reduced solves of shear-thinning contacts of one kind, H_c and traction without any field, and whole traction
    /// curves; a note where there is no model.
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

    /// What solves with the embedded model of a row; a note where there is none.
    fn online(&mut self, row: &str, kind: ContactKind, shear: ShearLaw) -> Option<Online> {
        let name = match (kind, shear) {
            (ContactKind::Line, ShearLaw::Newtonian) => "line",
            (ContactKind::Line, ShearLaw::Eyring { .. }) => "line_sliding",
            (ContactKind::Line, _) => "line_shear",
            (ContactKind::Point, ShearLaw::Newtonian) => "point",
            (ContactKind::Point, ShearLaw::Eyring { .. }) => "point_sliding",
            (ContactKind::Point, _) => "point_shear",
        };
        let model = self.model(row, name);
        model.map(|model| Online::new(model, ReducedOptions::default()))
    }

    /// The embedded model of a row; a note where there is none.
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

/// Full solves of point contacts on 301×41 nodes, cold and from the nearest other solution.
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

/// Random contacts of Table 3.5 in the ranges of Table 3.6: u_m with a constant ratio, SRR and NPR equidistant.
fn shear_problems(kind: ContactKind, count: usize) -> Result<Vec<Problem>, EngineError> {
    let lubricant = named_lubricant::SQUALANE_PIP;
    let mut random = fastrand::Rng::with_seed(SEED);
    let problem = |_| {
        let point = OperatingPoint {
            kind,
            radius_m: 12.7e-3,
            speed_m_per_s: 0.1 * 50f64.powf(random.f64()),
            // The line's load makes the Hertzian pressure of the point's 23 N.
            load: if kind == ContactKind::Line { 144e3 } else { 23.0 },
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

/// Solves cold, then each again from the nearest other solution.
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

/// Steps in time, of the full system and of the reduced models that reproduce them: the load of case 1 of Table 4.1 on
/// the contact of Table 4.2, fixed frame.
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
    // Models are used for what they cost least: nobody asks for fields at every step.
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

/// Reduced solves one after the other, with all fields and the scalars read off them where `fields` says so.
fn reduced_row(
    name: &'static str,
    online: &mut Online,
    (points, lubricant): (&[OperatingPoint], Lubricant),
    fields: bool,
    budget: Duration,
) -> Result<Timing, EngineError> {
    if let Some(first) = points.first() {
        // Operators belong to the model, not to its solves.
        online.prepare(first);
    }
    timed(name, budget, 3, points, |point| {
        Ok(match online.solve(point, lubricant) {
            Ok(solution) if fields => online.scalars(&solution).is_ok(),
            solved => solved.is_ok(),
        })
    })
}

/// Reduced solves with their scalars, with all fields, and without these ended at a relative step of 1e-3: what stops there
/// is as far from the full solution.
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

/// Whole traction curves over SRR by a reduced model, one for the speed, load and plateau ratio of each point.
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

/// The solution nearest to number `k` by (3.20) and in SRR and NPR, other than itself.
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

/// Times `solve`, which says whether it converged, for one item after the other until the budget is spent, for `least`
/// of them in any case.
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

    /// Marches and records every step.
    fn add_steps(&mut self, model: &mut dyn Marching, transient: &Transient) -> Result<Trajectory, EngineError> {
        let Timed { trajectory, seconds } = timed_march(model, transient, String::new(), &(), None)?;
        self.seconds.extend(seconds);
        self.failures += usize::from(!trajectory.finished());
        Ok(trajectory)
    }
}
