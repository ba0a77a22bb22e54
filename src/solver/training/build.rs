//! From a specification to a model: snapshots, bases, row snapshots, sampled rows.

use super::plan::{farthest_points, grid_points};
use super::rows::sample_rows;
use super::{Plan, Progress, Range, TrainingError, TrainingObserver, TrainingSpec, WindowSpec};
use crate::solver::contact::OperatingPoint;
use crate::solver::full::{FullSolver, Solution, Start};
use crate::solver::grid::ReferenceGrid;
use crate::solver::observer::Observer;
use crate::solver::reduced::{
    Domain, PodBasis, ReducedModel, Sampling, Snapshot, Window, all_rows, deformation_weights, flex,
};
use faer::Mat;
use fastrand::Rng;
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Training reaches beyond a window's ends by this factor in M, so that its edge is not a corner.
const OVERLAP: f64 = 1.221_402_758_160_17;

struct Cancel<'a>(&'a dyn TrainingObserver);

impl Observer for Cancel<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// Trains a model: full solutions on all cores, then bases, sampling and operators.
///
/// # Errors
/// When the specification is refused, a full solve fails, or the observer cancels.
pub fn train(spec: &TrainingSpec, observer: &dyn TrainingObserver) -> Result<ReducedModel, TrainingError> {
    check(spec)?;
    let mut rng = Rng::with_seed(spec.seed);
    let mut windows = Vec::with_capacity(spec.windows.len());
    let mut log = Vec::new();
    for window in &spec.windows {
        let trained = train_window(spec, window, &mut rng, observer)?;
        log.push(format!(
            "M {}…{}: {} full solutions, {} pressure and {} deformation modes, {} of {} rows",
            window.m.0,
            window.m.1,
            trained.snapshots.len(),
            trained.pressure.modes.ncols(),
            trained.deformation.modes.ncols(),
            trained.sampled_rows.len(),
            trained.grid.xi.len() - 3,
        ));
        windows.push(trained);
    }
    Ok(ReducedModel { title: spec.title.clone(), domain: domain(spec), windows, scene: String::new(), log })
}

fn check(spec: &TrainingSpec) -> Result<(), TrainingError> {
    spec.range.check()?;
    let refuse = |sentence: String| Err(TrainingError::Specification(sentence));
    if spec.windows.is_empty() {
        return refuse("a model needs at least one window".to_owned());
    }
    if !spec.windows.iter().all(|w| w.m.0 > 0.0 && w.m.0 < w.m.1)
        || !spec.windows.windows(2).all(|p| p[0].m.1 <= p[1].m.0)
    {
        return refuse("windows must be non-empty intervals of M in ascending order".to_owned());
    }
    let range = domain(spec).m;
    if let Some(w) = spec.windows.iter().find(|w| w.m.1 < range.0 || w.m.0 > range.1) {
        let (from, to) = w.m;
        return refuse(format!(
            "the window M {from}…{to} lies outside the range, whose M is {:.4}…{:.4}",
            range.0, range.1
        ));
    }
    for (name, loss) in [("pressure_loss", spec.pressure_loss), ("deformation_loss", spec.deformation_loss)] {
        if !(0.0..1.0).contains(&loss) {
            return refuse(format!("{name} is {loss}, but must be at least 0 and below 1"));
        }
    }
    if !(1.0..=20.0).contains(&spec.rows_per_mode) {
        return refuse(format!("rows_per_mode is {}, but must lie between 1 and 20", spec.rows_per_mode));
    }
    match spec.plan {
        Plan::FarthestPoint { snapshots } if !(4..=5000).contains(&snapshots) => {
            refuse(format!("the plan asks for {snapshots} snapshots; between 4 and 5000 are accepted"))
        }
        Plan::Grid { nodes } if nodes.iter().product::<usize>() < 4 || nodes.iter().any(|n| *n > 100) => {
            refuse("the grid plan needs at least 4 points and at most 100 along each quantity".to_owned())
        }
        Plan::Grid { .. } if !matches!(spec.range, Range::Box { .. }) => {
            refuse("the grid plan of Table 3.2 needs a box of SI quantities".to_owned())
        }
        _ => Ok(()),
    }
}

/// What the model declares to be trained for.
fn domain(spec: &TrainingSpec) -> Domain {
    match spec.range {
        Range::Moes { m, l, alpha, max_hertz_pressure, viscosity } => Domain {
            m,
            l,
            alpha_per_pa: alpha,
            max_hertz_pressure_pa: max_hertz_pressure,
            viscosity_pa_s: viscosity,
            lubricant: spec.lubricant,
        },
        Range::Box { alpha, viscosity, .. } => {
            let corners = grid_points(&spec.range, [2, 2, 2, 2]);
            let span = |value: &dyn Fn(&OperatingPoint) -> f64| {
                corners.iter().map(value).fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)))
            };
            Domain {
                m: span(&|p| p.moes().m),
                l: span(&|p| p.moes().l),
                alpha_per_pa: alpha,
                max_hertz_pressure_pa: span(&|p| p.hertz().pressure_pa).1,
                viscosity_pa_s: viscosity,
                lubricant: spec.lubricant,
            }
        }
    }
}

fn train_window(
    spec: &TrainingSpec,
    window: &WindowSpec,
    rng: &mut Rng,
    observer: &dyn TrainingObserver,
) -> Result<Window, TrainingError> {
    let grid = window.grid.build().map_err(crate::solver::full::SolveError::from)?;
    let first = spec.windows.first().is_some_and(|w| w.m == window.m);
    let last = spec.windows.last().is_some_and(|w| w.m == window.m);
    let reach =
        (if first { 0.0 } else { window.m.0 / OVERLAP }, if last { f64::INFINITY } else { window.m.1 * OVERLAP });
    let points = match spec.plan {
        Plan::FarthestPoint { snapshots } => farthest_points(&spec.range, reach, snapshots, rng),
        Plan::Grid { nodes } => {
            let mut points = grid_points(&spec.range, nodes);
            points.retain(|p| (reach.0..=reach.1).contains(&p.moes().m));
            points
        }
    };
    if points.len() < 4 {
        return Err(TrainingError::Specification(format!(
            "the window M {}…{} holds {} training points of the range; it needs at least 4",
            window.m.0,
            window.m.1,
            points.len()
        )));
    }
    let stage = format!("Full solutions, M {}…{}", window.m.0, window.m.1);
    let solutions = solve_all(spec, &grid, &points, &stage, observer)?;
    observer.progress(Progress { stage: format!("Bases, M {}…{}", window.m.0, window.m.1), done: 0, total: 1 });
    let failed = || TrainingError::Decomposition { from: window.m.0, to: window.m.1 };
    let (pressure, deformation, snapshots) = bases(spec, &grid, &solutions).ok_or_else(failed)?;
    let rows = all_rows(&pressure, &grid.weights);
    let mut model = Window::new(window.m, grid, pressure, deformation, snapshots, Sampling::All, rows);
    if spec.sampling != Sampling::All {
        let exact = Arc::new(ReducedModel {
            title: String::new(),
            domain: domain(spec),
            windows: vec![model.clone()],
            scene: String::new(),
            log: Vec::new(),
        });
        let sampled = sample_rows(spec, &exact, reach, rng, observer)?.ok_or_else(failed)?;
        model.set_rows(spec.sampling, sampled);
    }
    Ok(model)
}

/// Full solutions at all points, in parallel, in order.
fn solve_all(
    spec: &TrainingSpec,
    grid: &Arc<ReferenceGrid>,
    points: &[OperatingPoint],
    stage: &str,
    observer: &dyn TrainingObserver,
) -> Result<Vec<Solution>, TrainingError> {
    let done = AtomicUsize::new(0);
    points
        .par_iter()
        .map_init(
            || FullSolver::on(Arc::clone(grid)),
            |solver, point| {
                if observer.cancelled() {
                    return Err(TrainingError::Cancelled);
                }
                let solution = solver.solve(point, spec.lubricant, Start::Cold, &mut Cancel(observer))?;
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                observer.progress(Progress { stage: stage.to_owned(), done, total: points.len() });
                if solution.converged() {
                    Ok(solution)
                } else if observer.cancelled() {
                    Err(TrainingError::Cancelled)
                } else {
                    let moes = point.moes();
                    Err(TrainingError::NotConverged { m: moes.m, l: moes.l })
                }
            },
        )
        .collect()
}

/// POD of pressures and deformations, and the snapshots in the pressure basis.
fn bases(
    spec: &TrainingSpec,
    grid: &ReferenceGrid,
    solutions: &[Solution],
) -> Option<(PodBasis, PodBasis, Vec<Snapshot>)> {
    let nodes = grid.xi.len();
    let pressures = Mat::from_fn(nodes, solutions.len(), |i, j| solutions[j].pressure[i]);
    let pressure = PodBasis::new(pressures.as_ref(), &grid.weights, spec.pressure_loss)?;
    let deformation =
        PodBasis::new(flex(grid, &pressures).as_ref(), &deformation_weights(grid), spec.deformation_loss)?;
    let snapshots = solutions
        .iter()
        .map(|s| Snapshot {
            point: s.problem.point,
            coefficients: (0..pressure.modes.ncols())
                .map(|k| (0..nodes).map(|i| grid.weights[i] * pressure.modes[(i, k)] * s.pressure[i]).sum())
                .collect(),
            h_0: s.scalars.h_0,
            h_c: s.scalars.h_c,
        })
        .collect();
    Some((pressure, deformation, snapshots))
}
