//! The speed table: full and reduced side by side, against a dense Newton measured in the same run.

use super::error::HarnessError;
use super::sampling::random_points;
use super::statistics::{median, percentile};
use super::transient_study::timed_march;
use crate::scene::{QuantityBox, TestRange};
use crate::solver::contact::ContactKind;
use crate::solver::contact::OperatingPoint;
use crate::solver::full::dense::{dense_kernel, dense_newton};
use crate::solver::full::transient::{
    Frame, FullMarch, Inputs, Keep, Marching, Signal, TimeStep, Trajectory, Transient,
};
use crate::solver::full::{FullSolver, PointSolver, Solution, SolveError, SolveOptions, Start};
use crate::solver::grid::{GridSpec, PointGridSpec};
use crate::solver::lubricant::Lubricant;
use crate::solver::reduced::tpwl::{Selection, TpwlMarch, TpwlModel, TpwlTraining, Weighting};
use crate::solver::reduced::transient::ReducedMarch;
use crate::solver::reduced::{Online, ReducedOptions, distance};
use crate::solver::training::{TrajectoryTraining, train_trajectories};
use serde::Serialize;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What all rows of line contacts are compared with: Newton with a dense LU per step on the same 1201 nodes, as the dissertation has it.
pub const BASELINE: &str = "line/dense-newton";

/// What all rows of point contacts are compared with: the cold full solve. A dense LU of 11960 unknowns would take minutes.
pub const POINT_BASELINE: &str = "point/full/cold";

/// What all rows of steps in time are compared with: the full step on the same 1201 nodes.
pub const TRANSIENT_BASELINE: &str = "line/transient/full-step";

/// The dense baseline may take this long; at least three runs are made whatever they take.
const BASELINE_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_secs(10)];
/// Each other row stops drawing further points after this.
const ROW_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_secs(8)];
/// Points of the full rows and of the reduced row.
const FULL_POINTS: [usize; 2] = [400, 120];
const REDUCED_POINTS: [usize; 2] = [10_000, 2_000];
const BASELINE_POINTS: [usize; 2] = [40, 12];
/// Point contacts: solves, and the time after which no further ones are begun.
const POINT_POINTS: [usize; 2] = [50, 8];
const POINT_BUDGET: [Duration; 2] = [Duration::from_secs(60), Duration::from_secs(5)];
/// The trajectory-piecewise-linear model of the same march.
const TPWL_TRAINING: TpwlTraining = TpwlTraining { modes: 100, selection: Selection::Step { tolerance: 1e-3 } };
const SEED: u64 = 2026;
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

/// Measures the table over random points of Table 3.1's box for line and of Table 3.4's for point contacts, the same points for every row.
///
/// `quick` takes fewer points and ends within 40 s.
///
/// # Errors
/// When a solver refuses a point of the box, which it never should.
pub fn run(quick: bool) -> Result<Bench, HarnessError> {
    let size = usize::from(quick);
    let points = random_points(&TestRange::Box(QuantityBox::TABLE_3_1), ContactKind::Line, REDUCED_POINTS[size], SEED);
    let lubricant = Lubricant::default();
    let mut solver = FullSolver::new(GridSpec::DISSERTATION)?;
    let mut bench = Bench::default();

    let mut dense = Timing::new(BASELINE, BASELINE_BUDGET[size]);
    let kernel = dense_kernel(&solver.reference().scaled(1.0));
    let options = SolveOptions::default();
    for point in &points[..BASELINE_POINTS[size]] {
        if dense.spent() && dense.seconds.len() >= 3 {
            break;
        }
        let clock = Instant::now();
        let (mut system, problem) = solver.cold_system(point, lubricant)?;
        let steps = dense_newton(&mut system, &problem, &options, &kernel);
        dense.record(clock, steps < options.max_newton);
    }

    let mut cold = Timing::new("line/full/cold", ROW_BUDGET[size]);
    let mut solutions: Vec<Solution> = Vec::new();
    for point in &points[..FULL_POINTS[size]] {
        if cold.spent() {
            break;
        }
        let clock = Instant::now();
        let solution = solver.solve(point, lubricant, Start::Cold, &mut ())?;
        cold.record(clock, solution.converged());
        if solution.converged() {
            solutions.push(solution);
        }
    }

    let mut warm = Timing::new("line/full/warm", ROW_BUDGET[size]);
    for (k, own) in solutions.iter().enumerate() {
        let Some(start) = nearest_other(&solutions, k) else { break };
        if warm.spent() {
            break;
        }
        let clock = Instant::now();
        let solution = solver.solve(&own.problem.point, lubricant, Start::From(start), &mut ())?;
        warm.record(clock, solution.converged());
    }

    let mut rows = vec![dense, cold, warm];
    match super::embedded_model(ContactKind::Line) {
        Ok(model) => {
            rows.push(reduced_row(&mut Online::new(model, ReducedOptions::default()), &points, ROW_BUDGET[size]));
        }
        Err(reason) => bench.notes.push(format!("line/reduced is missing: {reason}")),
    }
    bench.add(rows, BASELINE);
    bench.add(transient_rows(size)?, TRANSIENT_BASELINE);
    bench.add(point_rows(size)?, POINT_BASELINE);
    Ok(bench)
}

impl Bench {
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
fn point_rows(size: usize) -> Result<Vec<Timing>, HarnessError> {
    let lubricant = Lubricant::default();
    let range = TestRange::Box(QuantityBox::TABLE_3_4);
    let mut solver = PointSolver::new(PointGridSpec::DISSERTATION)?;
    let mut cold = Timing::new(POINT_BASELINE, POINT_BUDGET[size]);
    let mut solutions: Vec<Solution> = Vec::new();
    for point in random_points(&range, ContactKind::Point, POINT_POINTS[size], SEED) {
        if cold.spent() && cold.seconds.len() >= 4 {
            break;
        }
        let clock = Instant::now();
        let solution = solver.solve(&point, lubricant, Start::Cold, &mut ())?;
        cold.record(clock, solution.converged());
        solutions.extend(Some(solution).filter(Solution::converged));
    }
    let mut warm = Timing::new("point/full/warm", POINT_BUDGET[size]);
    for (k, own) in solutions.iter().enumerate() {
        let Some(start) = nearest_other(&solutions, k) else { break };
        if warm.spent() && warm.seconds.len() >= 4 {
            break;
        }
        let clock = Instant::now();
        let solution = solver.solve(&own.problem.point, lubricant, Start::From(start), &mut ())?;
        warm.record(clock, solution.converged());
    }
    Ok(vec![cold, warm])
}

/// Steps in time, of the full system and of the reduced models that reproduce them: the load of case 1 of Table 4.1 on the contact of Table
/// 4.2, fixed frame.
fn transient_rows(size: usize) -> Result<Vec<Timing>, HarnessError> {
    let [radius_m, speed_m_per_s, load] = [2e-3, 5.0, 2e5];
    let [modulus_pa, viscosity_pa_s, alpha_per_pa] = [231e9, 0.01, 1e-8];
    let kind = ContactKind::Line;
    let transient = Transient {
        point: OperatingPoint { kind, radius_m, speed_m_per_s, load, modulus_pa, viscosity_pa_s, alpha_per_pa },
        lubricant: Lubricant::default(),
        inputs: Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 1.0 / 3.0 }),
        frame: Frame::Fixed,
        duration: MARCH_DURATION[size],
        time_step: TimeStep::Fixed(2.5e-3),
        keep: Keep::Every(1),
    };
    let grid = GridSpec::DISSERTATION.build().map_err(SolveError::from)?;
    let timed = |name, model: &mut dyn Marching| -> Result<(Timing, Trajectory), HarnessError> {
        let mut timing = Timing::new(name, ROW_BUDGET[size]);
        let (trajectory, seconds) = timed_march(model, &transient, String::new(), &())?;
        (timing.seconds, timing.failures) = (seconds, usize::from(!trajectory.finished()));
        Ok((timing, trajectory))
    };
    let (full, trajectory) = timed(TRANSIENT_BASELINE, &mut FullMarch::new(Arc::clone(&grid), &transient)?)?;
    let settings = TrajectoryTraining { loss: 1e-5, ..TrajectoryTraining::default() };
    let linearised = TpwlModel::train(&[&trajectory], TPWL_TRAINING)?;
    let model = train_trajectories(&grid, &[trajectory], &settings, &())?;
    let (reduced, _) = timed("line/transient/rnsa-step", &mut ReducedMarch::new(&model)?)?;
    let mut march = TpwlMarch::new(&linearised, &transient, Weighting::DualTaylor)?;
    let (superposed, _) = timed("line/transient/tpwl-step", &mut march)?;
    Ok(vec![full, reduced, superposed])
}

fn reduced_row(online: &mut Online, points: &[OperatingPoint], budget: Duration) -> Timing {
    let mut timing = Timing::new("line/reduced", budget);
    for point in points {
        if timing.spent() {
            break;
        }
        let clock = Instant::now();
        let solved = online.solve(point, Lubricant::default()).and_then(|solution| online.scalars(&solution));
        timing.record(clock, solved.is_ok());
    }
    timing
}

/// The solution nearest to number `k` by (3.20), other than itself.
fn nearest_other(solutions: &[Solution], k: usize) -> Option<&Solution> {
    let here = solutions[k].problem.moes;
    let others = solutions.iter().enumerate().filter(|&(i, _)| i != k).map(|(_, solution)| solution);
    others.min_by(|a, b| distance(here, a.problem.moes).total_cmp(&distance(here, b.problem.moes)))
}

struct Timing {
    name: &'static str,
    begun: Instant,
    budget: Duration,
    seconds: Vec<f64>,
    failures: usize,
}

impl Timing {
    fn new(name: &'static str, budget: Duration) -> Self {
        Self { name, begun: Instant::now(), budget, seconds: Vec::new(), failures: 0 }
    }

    fn spent(&self) -> bool {
        self.begun.elapsed() > self.budget
    }

    fn record(&mut self, clock: Instant, converged: bool) {
        self.seconds.push(clock.elapsed().as_secs_f64());
        self.failures += usize::from(!converged);
    }
}
