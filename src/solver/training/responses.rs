//! Training of a transient reduced model of a circular contact in the frequency domain, with one full march.
//!
//! 1. Steady contacts at loads and speeds across the range, and their linear responses to both at some frequencies.
//!    Their decomposition gives the basis.
//! 2. Test functions: the solutions of the adjoint of the steady reference contact for each mode. With them a step
//!    hardly depends on parts of the residual that the basis cannot represent.
//! 3. Sampled equations: a cubature of the steps that the model with all rows takes along loads and speeds that sweep
//!    the range.

use super::error::TrainingError;
use super::one_thread::{in_parallel, on_one_thread};
use super::rows::add_goals;
use crate::solver::discrete::grid::{ContactGrid, PointGrid};
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::Problem;
use crate::solver::full::transient::{
    Conditions, Ended, Frame, FullMarch, Input, Inputs, Keep, MarchProgress, Marching, Moment, Signal, Trajectory,
    Transient, TransientError, march,
};
use crate::solver::limits::Number;
use crate::solver::observer::{Observer, Progress};
use crate::solver::parameters::{Axis, ParameterSpace, Quantity};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::tpwl::{Plane, ReducedSpace, Selection, SpaceGrid, TpwlError, TpwlModel, TpwlTraining};
use crate::solver::reduced::transient::{Reach, ReducedMarch, TrajectoryDomain, TrajectoryModel, TrajectoryStart};
use crate::solver::reduced::{
    Domain, GoalEquations, Iterate, PodBasis, PressureModes, SampledRows, Sampling, TestSpace, Trust, Window, all_rows,
    cubature, deformation_weights, is_finite,
};
use faer::Mat;
use fastrand::Rng;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Settings of the training of a circular contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ResponseTraining {
    /// Range of the load, relative to the reference contact.
    pub load: (f64, f64),
    /// Range of the speed, relative to the reference contact.
    pub speed: (f64, f64),
    /// Shortest period of load and speed \[T\].
    pub shortest_period: f64,
    /// Number of pressure modes.
    pub modes: usize,
    /// Number of sampled equations per pressure mode.
    pub rows_per_mode: f64,
    /// Length of the time steps \[T\].
    pub step: f64,
    /// Seed of the cubature's random functionals.
    pub seed: u64,
}

impl Default for ResponseTraining {
    fn default() -> Self {
        Self {
            load: (0.88, 1.12),
            speed: (0.85, 1.15),
            shortest_period: 0.5,
            modes: 80,
            rows_per_mode: 3.5,
            step: 0.01,
            seed: 1,
        }
    }
}

/// Longest period of the responses \[T\]. Slower changes are steady ones.
const LONGEST_PERIOD: f64 = 3.0;
/// Number of frequencies, and of loads and speeds of the steady contacts.
const FREQUENCIES: usize = 7;
const STATES: usize = 3;
/// Penalty factor γ̄ in the test functions and online. The rows around the cavitation boundary need a soft one.
const PENALTY: f64 = 1e5;
/// Number of iterates for the cubature, and of time steps from which they are taken.
const ITERATES: usize = 600;
const STEPS: usize = 400;

/// Relative tolerance of the reference contact, because of rounding errors.
const ROUNDING: f64 = 1e-6;

/// Message: a matrix of the test functions is singular, or too few rows satisfy the equations of the cubature.
const DEGENERATE: &str = "the responses could not be decomposed, or their steps need too many sampled equations; try \
                          fewer modes or more rows per mode";

/// Message: contacts that are covered.
const COVERED: &str = "a transient reduced model covers circular contacts whose pressure ends within the domain; choose \
                       equal radii and a refinement of the grid of at least 1";

/// Steady contact with its share of the snapshots, one per column.
struct Steady {
    input: Input,
    pressure: Vec<f64>,
    h_0: f64,
    responses: Vec<Vec<f64>>,
}

/// Basis and test functions of a circular contact, with the march that sweeps the range. Reduced and linearised models
/// are built from it.
pub struct ResponseBasis {
    own: Transient,
    training: ResponseTraining,
    exact: Arc<TrajectoryModel>,
    swept: Trajectory,
}

impl ResponseBasis {
    /// Computes the basis of loads and speeds around a circular contact, in the fixed frame.
    ///
    /// # Errors
    /// [`TrainingError`] if the contact or a setting is refused, a steady contact is not solved, the linear algebra
    /// fails, or the observer cancels.
    pub fn new(
        grid: &Arc<PointGrid>,
        point: OperatingPoint,
        lubricant: Lubricant,
        training: &ResponseTraining,
        observer: &dyn Observer,
    ) -> Result<Self, TrainingError> {
        training.check()?;
        if point.is_elliptic() || grid.spec.continues() {
            return Err(TrainingError::Specification(COVERED.to_owned()));
        }
        let own = Transient { lubricant, ..Transient::new(point, Inputs::default(), 1.0, training.step) };
        let problem = own.problem()?;
        let steady = steady(grid, &own, &problem, training, observer)?;
        let swept = swept(grid, &own, training, observer)?;
        let exact = Arc::new(exact(grid, &own, &problem, (&steady, &swept), training, observer)?);
        Ok(Self { own, training: *training, exact, swept })
    }

    /// Recovers the basis of a reduced model that responses trained, for a contact in its range. The model itself marches
    /// along the sweep, which takes a small part of the time of the training.
    ///
    /// # Errors
    /// [`TrainingError`] if the model is not one of a circular contact, if the contact is outside its range, if it or the
    /// sweep is not solved, or if the observer cancels.
    pub fn of_model(
        model: &Arc<TrajectoryModel>,
        (point, lubricant): (OperatingPoint, Lubricant),
        observer: &dyn Observer,
    ) -> Result<Self, TrainingError> {
        let refused = || TrainingError::Specification(COVERED.to_owned());
        let grid = model.window.grid.point().ok_or_else(refused)?;
        let training = ResponseTraining::of_model(model);
        training.check()?;
        let own = Transient { lubricant, ..Transient::new(point, Inputs::default(), 1.0, training.step) };
        let problem = own.problem()?;
        if let Trust::Outside(why) = model.domain.reference.trust(&problem) {
            return Err(TrainingError::Specification(format!("the reduced model does not cover this contact: {why}")));
        }
        let test = test_space(grid, &own, &problem, model.window.pressure.basis(), observer)?;
        let mut exact = TrajectoryModel::clone(model);
        exact.window.set_rows(Sampling::All, all_rows(&test));
        let transient = Transient { keep: Keep::Every(1), ..training.swept(&own) };
        let stage = "March of the reduced model along a sweep of loads and speeds".to_owned();
        let progress = MarchProgress { observer, stage, duration: transient.duration };
        let swept = finished(march(&mut ReducedMarch::new(model, &transient)?, &transient, &progress)?)?;
        Ok(Self { own, training, exact: Arc::new(exact), swept })
    }

    /// Returns the moments of the march that sweeps the range.
    pub fn swept(&self) -> &[Moment] {
        &self.swept.moments
    }

    /// Samples the equations of the reduced model.
    ///
    /// # Errors
    /// [`TrainingError`] if too few equations represent the steps, or if the observer cancels.
    pub fn reduced(&self, observer: &dyn Observer) -> Result<TrajectoryModel, TrainingError> {
        let rows = sampled(&self.exact, &self.own, &self.training, observer)?;
        let mut model = TrajectoryModel::clone(&self.exact);
        model.window.set_rows(Sampling::Cubature, rows);
        Ok(model)
    }

    /// Linearises the contact about states of the march with the first `modes` modes. A rule selects the states, or
    /// about `points` of them if a number is given.
    ///
    /// # Errors
    /// [`TpwlError`] if a setting is refused.
    pub fn linearised(
        &self,
        modes: usize,
        selection: Selection,
        points: Option<usize>,
    ) -> Result<TpwlModel, TpwlError> {
        let window = &self.exact.window;
        let Some(grid) = window.grid.point() else { return Err(TpwlError::NoTraining) };
        let modes = modes.min(window.reconstruction.nrows());
        let test = Mat::from_fn(window.reconstruction.ncols(), modes, |row, k| window.reconstruction[(k, row)]);
        let grid = SpaceGrid::Plane(Plane(Arc::clone(grid)));
        let space = ReducedSpace::new(grid, window.pressure.basis(), test, [PENALTY; 2]);
        let (values, training) = (window.pressure.singular_values().to_vec(), TpwlTraining { modes, selection });
        TpwlModel::train_in(space, values, &[&self.swept], training, points)
    }
}

impl ResponseTraining {
    /// Returns the settings of a model that responses trained.
    pub fn of_model(model: &TrajectoryModel) -> Self {
        let TrajectoryDomain { load, speed, step, .. } = &model.domain;
        let modes = model.window.pressure.count();
        Self {
            load: load.range,
            speed: speed.range,
            shortest_period: shortest_period(load),
            modes,
            rows_per_mode: model.rows() as f64 / modes.max(1) as f64,
            step: *step,
            ..Self::default()
        }
    }

    /// Checks the settings.
    ///
    /// # Errors
    /// [`TrainingError::Specification`] with the first setting that is refused.
    pub fn check(&self) -> Result<(), TrainingError> {
        let refuse = |name: &str, value: f64, accepted: &str| {
            let value = Number(value);
            Err(TrainingError::Specification(format!("the {name} is {value}, but must be {accepted}")))
        };
        for (name, (low, high)) in [("load", self.load), ("speed", self.speed)] {
            if !(0.1..1.0).contains(&low) {
                return refuse(&format!("smallest {name}"), low, "at least 0.1 and below 1, relative to the contact");
            }
            if !(high > 1.0 && high <= 3.0) {
                return refuse(&format!("largest {name}"), high, "above 1 and at most 3, relative to the contact");
            }
        }
        if !(0.1..=LONGEST_PERIOD).contains(&self.shortest_period) {
            return refuse("shortest period", self.shortest_period, "between 0.1 and 3");
        }
        if !(5..=300).contains(&self.modes) {
            return refuse("number of modes", self.modes as f64, "between 5 and 300");
        }
        if !(1.2..=20.0).contains(&self.rows_per_mode) {
            return refuse("number of rows per mode", self.rows_per_mode, "between 1.2 and 20");
        }
        if !(1e-4..=0.1).contains(&self.step) {
            return refuse("time step", self.step, "between 0.0001 and 0.1");
        }
        Ok(())
    }

    /// Returns the loads and speeds of the steady contacts; the reference contact is the first.
    fn inputs(&self) -> Vec<Input> {
        let share = |(low, high): (f64, f64), k: usize| low + (high - low) * k as f64 / (STATES - 1) as f64;
        let loads = (0..STATES).map(|k| Input { load: share(self.load, k), ..Input::REFERENCE });
        let speeds = (0..STATES).map(|k| Input { speed: share(self.speed, k), ..Input::REFERENCE });
        let all = std::iter::once(Input::REFERENCE).chain(loads).chain(speeds);
        let mut inputs: Vec<Input> = Vec::new();
        all.for_each(|input| {
            if !inputs.contains(&input) {
                inputs.push(input)
            }
        });
        inputs
    }

    /// Returns the angular frequencies of the responses.
    fn frequencies(&self) -> impl Iterator<Item = f64> + '_ {
        let ratio = self.shortest_period / LONGEST_PERIOD;
        (0..FREQUENCIES).map(move |k| TAU / (LONGEST_PERIOD * ratio.powf(k as f64 / (FREQUENCIES - 1) as f64)))
    }

    /// Returns loads and speeds that sweep the range with falling periods, and the duration.
    pub fn sweep(&self) -> (Inputs, f64) {
        let times: Vec<f64> = (0..=STEPS).map(|k| k as f64 * self.step).collect();
        let duration = STEPS as f64 * self.step;
        // The period falls exponentially from the longest to the shortest: φ = ∫ 2π/period dT.
        let rate = (2.0 / self.shortest_period).ln() / duration;
        let phase = |time: f64| TAU / 2.0 * ((rate * time).exp() - 1.0) / rate;
        let swept = |(low, high): (f64, f64), wave: &dyn Fn(f64) -> f64| {
            // The march starts at the reference contact.
            let values = times.iter().map(|time| {
                let wave = wave(*time);
                1.0 + if wave > 0.0 { (high - 1.0) * wave } else { (1.0 - low) * wave }
            });
            Signal::Sampled { times: times.clone(), values: values.collect() }
        };
        let inputs = Inputs {
            load: swept(self.load, &|time| phase(time).sin()),
            speed: swept(self.speed, &|time| -phase(0.618 * time).sin()),
            ..Inputs::default()
        };
        (inputs, duration)
    }

    /// Returns the march along the sweep.
    fn swept(&self, own: &Transient) -> Transient {
        let (inputs, duration) = self.sweep();
        Transient { inputs, duration, ..own.clone() }
    }
}

fn conditions(problem: &Problem, input: Input) -> Result<Conditions, TrainingError> {
    Ok(Frame::Fixed.conditions(problem, 0.0, input)?)
}

/// Solves the steady contacts and their responses, each scaled by half the range of its input.
fn steady(
    grid: &Arc<PointGrid>,
    own: &Transient,
    problem: &Problem,
    training: &ResponseTraining,
    observer: &dyn Observer,
) -> Result<Vec<Steady>, TrainingError> {
    let inputs = training.inputs();
    let amplitudes = [training.load, training.speed].map(|(low, high)| 0.25 * (high - low));
    let solve = |full: &mut Result<FullMarch<PlaneSpace>, TransientError>, _: usize, input: &Input| {
        let full = full.as_mut().map_err(|refused| refused.clone())?;
        let at = conditions(problem, *input)?;
        let failed = || TrainingError::NotConverged { m: at.problem.moes.m, l: at.problem.moes.l };
        full.rest(&at, observer).map_err(|_| failed())?;
        let mut response = full.response(&at);
        let mut responses = Vec::with_capacity(4 * FREQUENCIES);
        for omega in training.frequencies() {
            if observer.cancelled() {
                return Err(TrainingError::Cancelled);
            }
            let of_both = response.to_load_and_speed(omega, at.speed).map_err(|_| failed())?;
            for ((amplitudes, reference), share) in of_both.iter().zip([problem.load, 1.0]).zip(amplitudes) {
                let scaled =
                    |part: fn(&_) -> f64| amplitudes.pressure.iter().map(|p| share * reference * part(p)).collect();
                responses.extend([scaled(|p: &realfft::num_complex::Complex64| p.re), scaled(|p| p.im)]);
            }
        }
        let (pressure, h_0) = full.pressure();
        Ok(Steady { input: *input, pressure: pressure.to_vec(), h_0, responses })
    };
    let tool = || FullMarch::<PlaneSpace>::on(Arc::clone(grid), own);
    in_parallel(observer, "Steady contacts and their responses", &inputs, tool, solve)?.into_iter().collect()
}

/// Marches the full system along loads and speeds that sweep the range.
fn swept(
    grid: &Arc<PointGrid>,
    own: &Transient,
    training: &ResponseTraining,
    observer: &dyn Observer,
) -> Result<Trajectory, TrainingError> {
    let transient = Transient { keep: Keep::Every(1), ..training.swept(own) };
    let mut full = FullMarch::<PlaneSpace>::on(Arc::clone(grid), &transient)?;
    let stage = "Full march along a sweep of loads and speeds".to_owned();
    let trajectory = march(&mut full, &transient, &MarchProgress { observer, stage, duration: transient.duration })?;
    finished(trajectory)
}

fn finished(trajectory: Trajectory) -> Result<Trajectory, TrainingError> {
    match trajectory.ended {
        Ended::Finished => Ok(trajectory),
        Ended::Cancelled { .. } => Err(TrainingError::Cancelled),
        Ended::StepRefused { .. } | Ended::ContactRefused { .. } => Err(TrainingError::Trajectories(DEGENERATE)),
    }
}

/// Builds the model with all rows.
fn exact(
    grid: &Arc<PointGrid>,
    own: &Transient,
    problem: &Problem,
    (steady, swept): (&[Steady], &Trajectory),
    training: &ResponseTraining,
    observer: &dyn Observer,
) -> Result<TrajectoryModel, TrainingError> {
    observer.progress(Progress { stage: "Basis and test functions".to_owned(), done: 0, total: 1 });
    let contact = ContactGrid::Point(Arc::clone(grid));
    let columns: Vec<&Vec<f64>> =
        steady.iter().flat_map(|own| std::iter::once(&own.pressure).chain(&own.responses)).collect();
    let columns: Vec<&Vec<f64>> = columns.into_iter().chain(swept.states.iter().map(|state| &state.pressure)).collect();
    let snapshots = Mat::from_fn(grid.len(), columns.len(), |i, j| columns[j][i]);
    let decompose = {
        let (contact, modes) = (contact.clone(), training.modes);
        move || {
            let pressure = PodBasis::new(snapshots.as_ref(), contact.weights(), 0.0)?.cut(modes);
            let deformations = contact.flex(&pressure.modes);
            let deformation = PodBasis::new(deformations.as_ref(), &deformation_weights(&contact), 0.0)?;
            Some((pressure, deformation))
        }
    };
    let bases = on_one_thread(observer, decompose)?;
    let (pressure, deformation) = bases.ok_or(TrainingError::Trajectories(DEGENERATE))?;
    let test = test_space(grid, own, problem, &pressure, observer)?;
    let starts = steady.iter().map(|steady| TrajectoryStart {
        point: own.point,
        inputs: constant(steady.input),
        duration: STEPS as f64 * training.step,
        coefficients: pressure.coefficients(&grid.weights, |i| steady.pressure[i]),
        h_0: steady.h_0,
        fronts: Vec::new(),
    });
    let starts = starts.collect();
    let pressure = PressureModes::own(pressure, &contact);
    let rows = all_rows(&test);
    let mut window = Window::new((0.0, f64::INFINITY), contact, pressure, deformation, Vec::new(), Sampling::All, rows);
    window.penalty = PENALTY;
    let domain = domain(own, problem, training);
    let (title, scene, locals) = (String::new(), String::new(), Vec::new());
    let log = vec![format!(
        "{} steady contacts, each with its responses to load and speed at {FREQUENCIES} frequencies; a full march of {STEPS} \
         steps along a sweep of loads and speeds",
        steady.len()
    )];
    Ok(TrajectoryModel { title, frame: Frame::Fixed, window, locals, starts, domain, scene, log })
}

fn constant(input: Input) -> Inputs {
    let signal = |value: f64| Signal::Sampled { times: vec![0.0], values: vec![value] };
    Inputs { load: signal(input.load), speed: signal(input.speed), ..Inputs::default() }
}

/// Returns the largest rate of an input that oscillates over its range.
fn fastest((low, high): (f64, f64), period: f64) -> f64 {
    0.5 * (high - low) * TAU / period
}

/// Returns the shortest period of an input, the inverse of [`fastest`].
fn shortest_period(reach: &Reach) -> f64 {
    fastest(reach.range, 1.0) / reach.rate
}

/// Returns the trained range.
fn domain(own: &Transient, problem: &Problem, training: &ResponseTraining) -> TrajectoryDomain {
    let reach = |range| Reach { range, rate: fastest(range, training.shortest_period) };
    let at = |value: f64| (value * (1.0 - ROUNDING), value * (1.0 + ROUNDING));
    let pressure = at(problem.point.hertz().pressure_pa).1;
    TrajectoryDomain {
        reference: Domain {
            contact: own.point.kind,
            space: ParameterSpace::of([
                Axis::new(Quantity::M, at(problem.moes.m)),
                Axis::new(Quantity::L, at(problem.moes.l)),
                Axis::new(Quantity::Alpha, at(problem.point.alpha_per_pa)),
            ])
            .limited([(Quantity::HertzPressure, (0.0, pressure))])
            .fixing([(Quantity::Viscosity, problem.point.viscosity_pa_s)]),
            lubricant: problem.lubricant,
        },
        radius: Reach { range: (1.0, 1.0), rate: 0.0 },
        speed: reach(training.speed),
        load: reach(training.load),
        only: None,
        step: training.step,
    }
}

/// Returns the test functions: Z with (A + B K)ᵀ Z = W V at the reference contact, such that the load equation stays
/// exact, divided by the weights W of the rows.
fn test_space(
    grid: &Arc<PointGrid>,
    own: &Transient,
    problem: &Problem,
    basis: &PodBasis,
    observer: &dyn Observer,
) -> Result<TestSpace, TrainingError> {
    let degenerate = TrainingError::Trajectories(DEGENERATE);
    let at = conditions(problem, Input::REFERENCE)?;
    let mut full = FullMarch::<PlaneSpace>::on(Arc::clone(grid), own)?;
    full.rest(&at, observer).map_err(|_| TrainingError::NotConverged { m: problem.moes.m, l: problem.moes.l })?;
    let mut adjoint = full.adjoint(&at, PENALTY).ok_or_else(|| degenerate.clone())?;
    let weights: Vec<f64> = (0..grid.unknowns()).map(|k| grid.weights[grid.node(k)]).collect();
    let (of_load, share_of_load) = adjoint.solve(&vec![0.0; weights.len()], 1.0).ok_or_else(|| degenerate.clone())?;
    let modes = basis.modes.ncols();
    let mut functions = Mat::zeros(weights.len(), modes);
    for mode in 0..modes {
        if observer.cancelled() {
            return Err(TrainingError::Cancelled);
        }
        let v: Vec<f64> = weights.iter().enumerate().map(|(k, w)| w * basis.modes[(grid.node(k), mode)]).collect();
        let (z, zeta) = adjoint.solve(&v, 0.0).ok_or_else(|| degenerate.clone())?;
        let share = zeta / share_of_load;
        for (k, z) in z.iter().enumerate() {
            functions[(k, mode)] = (z - share * of_load[k]) / weights[k];
        }
    }
    Ok(TestSpace { modes: functions, weights })
}

/// Samples the equations by the steps of the model with all rows along swept loads and speeds.
fn sampled(
    exact: &Arc<TrajectoryModel>,
    own: &Transient,
    training: &ResponseTraining,
    observer: &dyn Observer,
) -> Result<SampledRows, TrainingError> {
    let swept = training.swept(own);
    let window = &exact.window;
    let modes = window.reconstruction.nrows();
    let own_space = TestSpace::new(window.pressure.basis(), &window.grid);
    let weights = own_space.weights.clone();
    let functions = Mat::from_fn(weights.len(), modes, |row, mode| window.reconstruction[(mode, row)] / weights[row]);
    let test = TestSpace { modes: functions, weights };
    // Candidates are the rows at whose nodes the modes matter, whatever the size of the test functions there.
    let mut goals = GoalEquations::over(&own_space);
    let every = (3 * STEPS).div_ceil(ITERATES).max(1);
    let mut rng = Rng::with_seed(training.seed);
    let mut seen = 0;
    let mut reduced = ReducedMarch::new(exact, &swept)?;
    reduced.observe(Box::new(|_, iterate: &Iterate<'_>| {
        if seen % every == 0 {
            add_goals(&mut goals, &test, iterate, &mut rng);
        }
        seen += 1;
    }));
    let stage = "Steps with all rows".to_owned();
    finished(march(&mut reduced, &swept, &MarchProgress { observer, stage, duration: swept.duration })?)?;
    drop(reduced);
    observer.progress(Progress { stage: "Row sampling".to_owned(), done: 0, total: 1 });
    let target = (modes as f64 * training.rows_per_mode).round() as usize;
    let rows = on_one_thread(observer, move || cubature(&test, &goals, target))?;
    let rows = rows.filter(|rows| is_finite(rows.reconstruction.as_ref()));
    rows.ok_or(TrainingError::Trajectories(DEGENERATE))
}
