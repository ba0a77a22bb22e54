//! Selects the sampled equations (rows) of a local model, for hyper-reduction. The local model with all rows is solved
//! at random contacts; for a cubature or around an anchor also at its training points. Rows are selected such that they
//! reproduce the iterates of these solves.

use super::cell::Cell;
use super::error::TrainingError;
use super::observer::TrainingObserver;
use super::one_thread::{in_parallel, on_one_thread};
use super::plan::Within;
use super::spec::TrainingSpec;
use crate::solver::observer::Progress;
use crate::solver::parameters::separation;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{
    GoalEquations, Iterate, Online, ReducedModel, ReducedOptions, RowSnapshots, SampledRows, Sampling, Scheme,
    Snapshot, TestSpace, Window, all_rows, cubature, dense, greedy, is_finite, minimised_rows, q_deim,
};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use fastrand::Rng;
use std::f64::consts::PI;
use std::sync::Arc;

/// Number of random contacts at which iterates are collected by reduced solves.
const ROW_SNAPSHOT_SOLVES: usize = 160;
/// The same for thermal point contacts, and their largest number of training points. A solve with all rows takes a
/// second.
const ROW_SNAPSHOT_SOLVES_OF_WARM_PLANES: usize = 60;
/// Smallest relative step by which goal equations of the residual are divided. The equations thus reproduce larger
/// steps in relative terms and smaller ones in absolute terms.
const STEP_FLOOR: f64 = 0.03;
/// Number of random functionals of the step Δp̃ of the pressure coefficients per iterate, for few and for many
/// candidate rows. One functional for the step ΔH_c of the central film thickness is added.
const RANDOM_FUNCTIONALS: [usize; 2] = [6, 2];
/// Largest accepted relative error of H_c by sampling, for nine contacts in ten: a fifth of the error accepted for a
/// model of line contacts. Slightly more rows reduce this error by orders of magnitude. With a tenth of the rows
/// missing, iterations may end with an error of a third.
const MISSED_BY_ROWS: f64 = 2e-4;
/// Factors on the requested number of rows, tried in this order until the error is small enough.
const MORE_ROWS: [f64; 4] = [1.1, 1.2, 1.35, 1.5];
/// Number of random contacts at which this error is measured.
const CONTACTS_OF_TRIAL: usize = 100;
/// Number of candidate rows above which they count as many, see [`RANDOM_FUNCTIONALS`].
const MANY_ROWS: usize = 3000;

/// Reduced solve whose iterates are collected.
struct Task<'a> {
    point: OperatingPoint,
    lubricant: Lubricant,
    /// Initial guess: for a training point its nearest other solution; `None` for a random point, which uses the
    /// guesses of the online phase.
    from: Option<&'a Snapshot>,
}

impl<'a> Task<'a> {
    /// Returns the task of solving training point `k` of a local model from its nearest other training point; `None` if
    /// there is no other one.
    fn beside(window: &'a Window, k: usize, lubricant: Lubricant) -> Option<Self> {
        let point = window.snapshots[k].point;
        let far = |other: &Snapshot| separation(&point, &other.point);
        let others = window.snapshots.iter().enumerate().filter(|(other, _)| *other != k).map(|(_, other)| other);
        others.min_by(|a, b| far(a).total_cmp(&far(b))).map(|nearest| Self { point, lubricant, from: Some(nearest) })
    }

    /// Solves and passes every iterate to `keep`; returns false if the solve fails.
    fn solve(&self, online: &mut Online, keep: &mut dyn FnMut(&Iterate<'_>)) -> bool {
        let Self { point, lubricant, from } = self;
        online.forget();
        match from {
            None => online.solve_observed(point, *lubricant, keep).is_ok(),
            Some(snapshot) => online.solve_from(snapshot, point, *lubricant, keep).is_ok(),
        }
    }
}

/// Data from one reduced solve.
enum Evidence {
    /// Residuals and Jacobian products of the iterates.
    Snapshots(RowSnapshots),
    /// Equations of the iterates that a cubature should satisfy.
    Goals(GoalEquations),
}

/// Selects the rows of a local model. `exact` contains this local model only, with all rows; `served` are the contacts
/// for which it is used. Around an anchor, more rows than requested are selected if the error by sampling is too large.
/// `None` if the linear algebra fails.
///
/// # Errors
/// [`TrainingError`] if the observer cancels.
pub(super) fn sample_rows(
    spec: &TrainingSpec,
    exact: &Arc<ReducedModel>,
    served: &Within,
    rng: &mut Rng,
    observer: &dyn TrainingObserver,
) -> Result<Option<SampledRows>, TrainingError> {
    let Some(data) = RowData::collect(spec, exact, served, rng, observer)? else { return Ok(None) };
    let data = Arc::new(data);
    let rows = |share: f64| {
        let (data, per_mode) = (Arc::clone(&data), share * spec.rows_per_mode);
        on_one_thread(observer, move || data.rows(&[per_mode]).pop().flatten())
    };
    let mut sampled = rows(1.0)?;
    let anchored = exact.windows.first().is_some_and(|window| window.anchor.is_some());
    if !anchored || spec.sampling != Sampling::QDeim || spec.scheme != Scheme::Galerkin {
        return Ok(sampled);
    }
    let trial = Trial::of_rows(spec, exact, served.random_points(CONTACTS_OF_TRIAL, rng), observer)?;
    for more in MORE_ROWS {
        let Some(fewer) = &sampled else { break };
        if trial.missed_by(spec, exact, fewer, observer)? <= MISSED_BY_ROWS {
            break;
        }
        let Some(further) = rows(more)? else { break };
        sampled = Some(further);
    }
    Ok(sampled)
}

/// Contacts that were not used for sampling, each with its H_c computed with all rows.
struct Trial(Vec<(OperatingPoint, f64)>);

impl Trial {
    /// Solves the contacts by a local model with all its rows; contacts without a solution are omitted.
    fn of_rows(
        spec: &TrainingSpec,
        exact: &Arc<ReducedModel>,
        points: Vec<OperatingPoint>,
        observer: &dyn TrainingObserver,
    ) -> Result<Self, TrainingError> {
        let films = films(spec, exact, &points, observer)?;
        Ok(Self(points.into_iter().zip(films).filter_map(|(point, film)| Some((point, film?))).collect()))
    }

    /// Returns the relative error of H_c with the given rows that nine contacts in ten do not exceed. A contact without
    /// a solution has an infinite error.
    fn missed_by(
        &self,
        spec: &TrainingSpec,
        exact: &Arc<ReducedModel>,
        rows: &SampledRows,
        observer: &dyn TrainingObserver,
    ) -> Result<f64, TrainingError> {
        let mut sampled = ReducedModel::clone(exact);
        sampled.windows.iter_mut().for_each(|window| window.set_rows(spec.sampling, rows.clone()));
        let points: Vec<OperatingPoint> = self.0.iter().map(|(point, _)| *point).collect();
        let films = films(spec, &Arc::new(sampled), &points, observer)?;
        let error =
            |(film, (_, exact)): (Option<f64>, &(_, f64))| film.map_or(f64::INFINITY, |h_c| (h_c / exact - 1.0).abs());
        let mut errors: Vec<f64> = films.into_iter().zip(&self.0).map(error).collect();
        errors.sort_by(f64::total_cmp);
        Ok(errors.get(errors.len() * 9 / 10).copied().unwrap_or(0.0))
    }
}

/// Solves contacts by a model with one local model. Returns the central film thickness H_c of each; `None` for a
/// contact without a solution.
fn films(
    spec: &TrainingSpec,
    model: &Arc<ReducedModel>,
    points: &[OperatingPoint],
    observer: &dyn TrainingObserver,
) -> Result<Vec<Option<f64>>, TrainingError> {
    let m = model.windows.first().map_or((0.0, 0.0), |window| window.m);
    let stage = format!("Trying rows, M {}…{}", m.0, m.1);
    let online = || Online::new(Arc::clone(model), ReducedOptions::default());
    in_parallel(observer, &stage, points, online, |online, _, point| {
        online.forget();
        online.solve(point, spec.lubricant).ok().map(|solved| solved.h_c)
    })
}

/// Selects the rows of one local model again, for each number of rows per mode. Returns copies of the model with these
/// rows. An entry is `None` if the linear algebra fails. Empty if there is no local model with this index. `spec` is
/// the training specification of the model.
///
/// # Errors
/// [`TrainingError`] if the observer cancels.
pub fn with_rows(
    spec: &TrainingSpec,
    model: &ReducedModel,
    window: usize,
    rows_per_mode: &[f64],
    observer: &dyn TrainingObserver,
) -> Result<Vec<Option<ReducedModel>>, TrainingError> {
    let Some(own) = model.windows.get(window) else { return Ok(Vec::new()) };
    let mut exact = own.clone();
    exact.set_rows(Sampling::All, all_rows(&TestSpace::new(own.pressure.basis(), &own.grid)));
    let exact = Arc::new(spec.model_of(&exact));
    let mut rng = Rng::with_seed(spec.seed);
    let cell = Cell::of_model(model, window);
    let m = if cell.is_some() { (0.0, f64::INFINITY) } else { own.m };
    let served = spec.within(m).served_by(own, cell);
    let Some(data) = RowData::collect(spec, &exact, &served, &mut rng, observer)? else { return Ok(Vec::new()) };
    let rows_per_mode = rows_per_mode.to_vec();
    let sampled = on_one_thread(observer, move || data.rows(&rows_per_mode))?;
    let with = |rows: SampledRows| {
        let mut other = model.clone();
        if let Some(place) = other.windows.get_mut(window) {
            place.set_rows(spec.sampling, rows);
        }
        other.title = format!("{}, equations sampled again", model.title);
        other
    };
    Ok(sampled.into_iter().map(|rows| rows.map(with)).collect())
}

/// Data from all reduced solves of a local model with all rows, by which rows are selected.
struct RowData {
    test: Arc<TestSpace>,
    /// Methods by which rows are selected.
    of: (Scheme, Sampling),
    /// Empty for a cubature.
    rows: RowSnapshots,
    /// Empty except for a cubature.
    equations: GoalEquations,
}

impl RowData {
    /// Solves random contacts by `exact` and, for a cubature or around an anchor, its training points. `None` for a
    /// model without a local model.
    fn collect(
        spec: &TrainingSpec,
        exact: &Arc<ReducedModel>,
        served: &Within,
        rng: &mut Rng,
        observer: &dyn TrainingObserver,
    ) -> Result<Option<Self>, TrainingError> {
        let Some(window) = exact.windows.first() else { return Ok(None) };
        let (solves, trainings) = match spec.warms_a_plane() {
            true => (ROW_SNAPSHOT_SOLVES_OF_WARM_PLANES, ROW_SNAPSHOT_SOLVES_OF_WARM_PLANES),
            false => (ROW_SNAPSHOT_SOLVES, usize::MAX),
        };
        let points = served.random_points(solves, rng);
        // Every second thermal line contact has random thermal constants from the range, because the model is used with
        // any of these.
        let mut constants = Rng::with_seed(spec.seed);
        let at = |(k, point): (usize, OperatingPoint)| {
            let varied = spec.warms_a_line() && k % 2 == 1;
            let lubricant =
                if varied { spec.range.with_random_heat(spec.lubricant, &mut constants) } else { spec.lubricant };
            Task { point, lubricant, from: None }
        };
        let mut tasks: Vec<Task<'_>> = points.into_iter().enumerate().map(at).collect();
        // Local models around anchors are used up to the borders of their cells, where few random contacts lie.
        if spec.sampling == Sampling::Cubature || window.anchor.is_some() {
            let every = window.snapshots.len().div_ceil(trainings).max(1);
            let beside = |k| Task::beside(window, k, spec.lubricant);
            tasks.extend((0..window.snapshots.len()).step_by(every).filter_map(beside));
        }
        let test = Arc::new(TestSpace::new(window.pressure.basis(), &window.grid));
        let empty = GoalEquations::over(&test);
        let stage = format!("Row snapshots, M {}…{}", window.m.0, window.m.1);
        let online = || Online::new(Arc::clone(exact), ReducedOptions::default());
        let collected = in_parallel(observer, &stage, &tasks, online, |online, index, task| match spec.sampling {
            Sampling::Cubature => {
                let mut rng = Rng::with_seed(spec.seed.wrapping_add(index as u64));
                Evidence::Goals(goals(online, &test, empty.clone(), task, &mut rng))
            }
            _ => Evidence::Snapshots(snapshots(spec, online, &test, task)),
        })?;
        observer.progress(Progress { stage: "Row sampling".to_owned(), done: 0, total: 1 });
        let of = (spec.scheme, spec.sampling);
        let all = Self { test, of, rows: RowSnapshots::default(), equations: empty };
        Ok(Some(on_one_thread(observer, move || all.with(collected))?))
    }

    /// Adds the data of further solves.
    fn with(mut self, collected: Vec<Evidence>) -> Self {
        for part in collected {
            match part {
                Evidence::Snapshots(part) => {
                    self.rows.residual.extend(part.residual);
                    self.rows.jacobian.extend(part.jacobian);
                }
                Evidence::Goals(part) => self.equations.merge(&part),
            }
        }
        self
    }

    /// Selects rows for each number of rows per mode; `None` if the linear algebra fails.
    fn rows(&self, rows_per_mode: &[f64]) -> Vec<Option<SampledRows>> {
        let Self { test, of, rows, equations } = self;
        let count = |per_mode: &f64| ((test.modes.ncols() as f64 * per_mode).round() as usize).min(test.weights.len());
        let counts: Vec<usize> = rows_per_mode.iter().map(count).collect();
        rows_by(test, *of, (rows, equations), &counts)
    }
}

/// Selects rows from snapshots or, for a cubature, from goal equations, for each number of rows in `counts`; `None` if
/// the linear algebra fails.
pub(super) fn rows_by(
    test: &TestSpace,
    (scheme, sampling): (Scheme, Sampling),
    (rows, equations): (&RowSnapshots, &GoalEquations),
    counts: &[usize],
) -> Vec<Option<SampledRows>> {
    let chosen = match sampling {
        _ if scheme != Scheme::Galerkin => {
            counts.iter().map(|count| minimised_rows(test, (scheme, sampling), rows, *count)).collect()
        }
        Sampling::QDeim => q_deim(test, rows, counts),
        Sampling::Greedy => counts.iter().map(|count| greedy(test, rows, *count)).collect(),
        Sampling::Cubature => counts.iter().map(|count| cubature(test, equations, *count)).collect(),
        Sampling::All => counts.iter().map(|_| Some(all_rows(test))).collect(),
    };
    let finite = |chosen: &SampledRows| is_finite(chosen.reconstruction.as_ref());
    chosen.into_iter().map(|chosen| chosen.filter(finite)).collect()
}

/// Returns the residual and Jacobian snapshots of one solve, multiplied by the factors of the scheme and normalised.
/// Empty if it diverges, since such iterates do not represent a good iteration.
fn snapshots(spec: &TrainingSpec, online: &mut Online, test: &TestSpace, task: &Task<'_>) -> RowSnapshots {
    let factors = spec.scheme.factors(test);
    let scaled = |v: &[f64]| -> Vec<f64> { v.iter().zip(&factors).map(|(v, factor)| v * factor).collect() };
    let mut rows = RowSnapshots::default();
    let mut keep = |iterate: &Iterate<'_>| {
        rows.residual.push(scaled(iterate.residual));
        rows.jacobian.push(scaled(iterate.jacobian_step));
    };
    if !task.solve(online, &mut keep) {
        return RowSnapshots::default();
    }
    normalise(&mut rows.residual);
    normalise(&mut rows.jacobian);
    rows
}

/// Divides the snapshots of one solve by the largest of their norms.
fn normalise(snapshots: &mut [Vec<f64>]) {
    let norm = |v: &Vec<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let largest = snapshots.iter().map(norm).fold(0.0, f64::max);
    if largest > 0.0 {
        for v in snapshots.iter_mut().flatten() {
            *v /= largest;
        }
    }
}

/// Adds the goal equations of every iterate of one solve to the collection `empty` and returns it. If the solve
/// diverges, it remains empty.
fn goals(online: &mut Online, test: &TestSpace, empty: GoalEquations, task: &Task<'_>, rng: &mut Rng) -> GoalEquations {
    let mut equations = empty.clone();
    let mut keep = |iterate: &Iterate<'_>| add_goals(&mut equations, test, iterate, rng);
    if task.solve(online, &mut keep) { equations } else { empty }
}

/// Adds the goal equations of one iterate. Sums over the sampled rows should give the same functionals of the Newton
/// step as sums over all rows, with the residual f and with J V Δz̃ as summand.
pub(super) fn add_goals(equations: &mut GoalEquations, test: &TestSpace, iterate: &Iterate<'_>, rng: &mut Rng) {
    let modes = iterate.coefficients.len();
    let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let size = length(iterate.coefficients);
    let (step, dh_0) = iterate.step.split_at(modes);
    let dh_0: f64 = dh_0.iter().sum();
    let (lift, h_c) = (iterate.lift, iterate.h_c);
    let film_step = (dh_0 + lift.iter().zip(step).map(|(l, d)| l * d).sum::<f64>()) / h_c;
    let change = 5.0 * length(step) / size + film_step.abs();
    if !(h_c > 0.0 && change.is_finite() && change > 0.0) {
        return;
    }
    let mut gauss = || (-2.0 * (1.0 - rng.f64()).ln()).sqrt() * (2.0 * PI * rng.f64()).cos();
    // Lᵀ: one column per random functional of Δp̃, then the one of ΔH_c.
    let random = RANDOM_FUNCTIONALS[usize::from(equations.candidates().len() > MANY_ROWS)];
    let functionals = Mat::from_fn(modes + 1, random + 1, |row, column| match (column < random, row == modes) {
        (false, true) => 1.0 / h_c,
        (false, false) => lift[row] / h_c,
        (true, true) => 0.0,
        (true, false) => 5.0 * gauss() / size,
    });
    let goals = dense::solved(iterate.jacobian.transpose(), functionals);
    let share = 1.0 / ((random + 1) as f64).sqrt();
    let (first, second) = (share / change.max(STEP_FLOOR), share / change);
    // Goals times the test function V_i of every row i. Computed on one thread, so that rounding does not depend on the
    // number of threads.
    let rows = test.weights.len();
    let mut tested = Mat::<f64>::zeros(rows, random + 1);
    matmul(tested.as_mut(), Accum::Replace, test.modes.as_ref(), goals.get(..modes, ..), 1.0, Par::Seq);
    for functional in tested.col_iter() {
        equations.add(|i| first * functional[i] * test.weights[i] * iterate.residual[i], rows);
        equations.add(|i| second * functional[i] * test.weights[i] * iterate.jacobian_step[i], rows);
    }
}
