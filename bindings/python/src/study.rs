//! Sweeps, random validations, transient contacts, scenes.

use crate::contact::Contact;
use crate::model::{Model, scene_of};
use crate::tables::array_of;
use crate::work::{long, march_stopped, refused, stated, warn};
use ehl_explorer::engine::{EngineError, SceneOutcome, Table, Workbench, run_scene};
use ehl_explorer::scene::study::random_test::RandomTest;
use ehl_explorer::scene::study::transient::{check_request, series};
use ehl_explorer::scene::{
    At, Bench, ContactSweep, Grid, Method, ModelSource, Notice, Request, Scene, Steps, Study, TransientStudy, Varied,
    VariedError, Words,
};
use ehl_explorer::solver::full::transient::{Inputs, MarchProgress, Signal, TimeStep, Transient, march};
use ehl_explorer::solver::observer::Observer;
use ehl_explorer::solver::parameters::{Axis, ParameterSpace, Quantity};
use ehl_explorer::solver::physics::contact::ContactKind;
use ehl_explorer::solver::reduced::transient::ReducedMarch;
use ehl_explorer::solver::warning::Warning;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// Solves a contact with one or two options varied, each from its neighbour, as ``ehl-explorer sweep`` does.
///
/// ``varied`` is a list of texts as on the command line (``"moes-m=10:160:5:log"``) or of pairs of a name and its
/// values; the last one varies fastest. Returns a structured array of the table that the command writes. An invalid
/// contact is refused in its own row only.
#[pyfunction]
#[pyo3(signature = (contact, varied, method=None, model=None, progress=None))]
pub fn sweep<'py>(
    py: Python<'py>,
    contact: &Contact,
    varied: Vec<Bound<'py, PyAny>>,
    method: Option<&str>,
    model: Option<&Bound<'py, PyAny>>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let asked = contact.asked(method, model)?;
    let varied = varied.iter().map(axis).collect::<PyResult<Vec<Varied>>>()?;
    let swept = long(py, progress, |watch| {
        let sweep = ContactSweep::new(&varied, &asked.spec, Words::Keywords).map_err(stated)?;
        sweep.solve(&mut asked.bench(), watch, |_| Ok(()))
    })?;
    array_of(py, swept.table)
}

fn axis(given: &Bound<'_, PyAny>) -> PyResult<Varied> {
    if let Ok(text) = given.extract::<String>() {
        return text.parse().map_err(|why: VariedError| refused(why));
    }
    let (name, values): (String, Vec<f64>) = given.extract()?;
    Varied::new(&name.replace('_', "-"), Steps::List(values)).map_err(refused)
}

/// Solves random contacts of a range, each from a cold start, and compares the first ``compare`` of them with full
/// solutions: the study ``RandomTest`` of scenes. The same seed gives the same contacts everywhere.
///
/// ``m`` and ``l`` are (from, to); ``max_hertz_pressure`` is in Pa. Returns a structured array of the study's table.
#[pyfunction]
#[pyo3(signature = (m, l, tests, seed=1, max_hertz_pressure=3.2e9, contact="line", method="reduced", compare=0, model=None, progress=None))]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
pub fn random_test<'py>(
    py: Python<'py>,
    m: (f64, f64),
    l: (f64, f64),
    tests: usize,
    seed: u64,
    max_hertz_pressure: f64,
    contact: &str,
    method: &str,
    compare: usize,
    model: Option<&Bound<'py, PyAny>>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let kind = ContactKind::from_name(contact)
        .ok_or_else(|| refused(format!("`{contact}` is no contact; accepted are line, point")))?;
    let method = match method {
        "full" => Method::Full,
        "reduced" => Method::EMBEDDED,
        _ => return Err(refused(format!("`{method}` is no method; accepted are full, reduced"))),
    };
    let range = ParameterSpace::of([Axis::new(Quantity::M, m), Axis::new(Quantity::L, l)])
        .limited([(Quantity::HertzPressure, (0.0, max_hertz_pressure))]);
    let study = Study::RandomTest(RandomTest { range, tests, seed, method, compare, worst: 0 });
    let scene = Scene { contact: kind, study, grid: Grid::Usual, ..Scene::at_moes(40.0, 10.0) };
    let outcome = outcome(py, &scene, bench_of(model, PathBuf::new())?, progress)?;
    warn(py, outcome.found.warnings.iter().map(ToString::to_string))?;
    array_of(py, first_table(outcome.tables)?)
}

/// Solves a transient contact in full: the study ``Transient`` of scenes, with inputs R, u_m and load that vary around
/// those of the contact. With ``model``, the ``.rom`` file of a transient reduced model, solves by this model alone; a
/// contact with ``method="reduced"`` is solved by the embedded model. Leaving the trained range gives a warning. Point
/// contacts are solved in full only, with a constant radius.
///
/// Times are in units of a/u_m. ``radius``, ``speed`` and ``load`` are pairs (T, values) of times and multiples of the
/// contact's own value; quantities that are not given are constant. The time step is ``step``, or is adapted so that
/// the estimated error of H_c is at most ``tolerance``. Returns a structured array of the march: T, inputs, film
/// thicknesses, pressures, and ``step_error``, the estimated largest relative error of H_c due to the time step. Other
/// remarks are given as warnings. If a step fails or the contact becomes invalid, :class:`MarchStopped` is raised.
#[pyfunction]
#[pyo3(signature = (
    contact, duration, step=None, radius=None, speed=None, load=None, model=None, progress=None, tolerance=None,
))]
#[expect(clippy::too_many_arguments, reason = "they have names in Python")]
pub fn transient<'py>(
    py: Python<'py>,
    contact: &Contact,
    duration: f64,
    step: Option<f64>,
    radius: Option<(Vec<f64>, Vec<f64>)>,
    speed: Option<(Vec<f64>, Vec<f64>)>,
    load: Option<(Vec<f64>, Vec<f64>)>,
    model: Option<PathBuf>,
    progress: Option<&Bound<'py, PyAny>>,
    tolerance: Option<f64>,
) -> PyResult<Bound<'py, PyAny>> {
    let time_step = match (step, tolerance) {
        (Some(step), None) => TimeStep::Fixed(step),
        (None, Some(tolerance)) => TimeStep::Controlled(tolerance),
        _ => return Err(refused("give either step= or tolerance=")),
    };
    let signal = |given: Option<(Vec<f64>, Vec<f64>)>| {
        given.map_or(Signal::Constant, |(times, values)| Signal::Sampled { times, values })
    };
    let inputs = Inputs { radius: signal(radius), speed: signal(speed), load: signal(load) };
    let request = &contact.request;
    let source = model.map(ModelSource::File).or_else(|| request.method.model().cloned());
    let asked = source
        .iter()
        .fold(request.clone(), |asked, source| Request { method: Method::reduced(source.clone()), ..asked });
    check_request(&asked).map_err(|refusal| refused(stated(refusal)))?;
    let own = Transient { time_step, ..Transient::new(request.point, inputs.clone(), duration, duration) };
    let own = Transient { lubricant: request.lubricant, ..own };
    own.check().map_err(refused)?;
    if let Some(source) = source {
        return by_model(py, &source, own, progress);
    }
    let study = TransientStudy::new(inputs, duration, time_step);
    let mut scene = Scene {
        contact: request.point.kind,
        at: At::from(request.point),
        srr: request.point.sliding.slide_to_roll_ratio,
        npr: request.point.sliding.newtonian_plateau_ratio,
        grid: request.grid,
        study: Study::Transient(study),
        ..Scene::at_moes(40.0, 10.0)
    };
    scene.set_laws(request.lubricant);
    let SceneOutcome { found, tables, .. } = outcome(py, &scene, bench_of(None, PathBuf::new())?, progress)?;
    // There is only one march, so that its name is left out of warnings.
    let sentences = found.warnings.iter().filter(|notice| notice.warning().is_none()).map(ToString::to_string);
    warn(py, sentences)?;
    marched(py, found.warnings.iter().filter_map(Notice::warning), first_table(tables)?)
}

/// Returns the rows of a march and shows its warnings, or returns the exception of a march that stopped.
fn marched<'py, 'a>(
    py: Python<'py>,
    warnings: impl IntoIterator<Item = &'a Warning>,
    rows: Table,
) -> PyResult<Bound<'py, PyAny>> {
    let is_stopped = |warning: &&Warning| matches!(warning, Warning::MarchStopped { .. });
    let (stopped, others): (Vec<&Warning>, Vec<&Warning>) = warnings.into_iter().partition(is_stopped);
    warn(py, others.into_iter().map(ToString::to_string))?;
    let rows = array_of(py, rows)?;
    match stopped.first() {
        Some(stopped) => Err(march_stopped(py, stopped, rows)),
        None => Ok(rows),
    }
}

/// Computes the march by a transient reduced model.
fn by_model<'py>(
    py: Python<'py>,
    source: &ModelSource,
    asked: Transient,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let (trajectory, warnings) = long(py, progress, |watch| {
        let model = Workbench::on(&crate::STORE, PathBuf::new()).trajectory_model(source, asked.point.kind, watch)?;
        let asked = Transient { frame: model.frame, ..asked };
        let observer = MarchProgress { observer: watch, stage: "reduced model".to_owned(), duration: asked.duration };
        let mut reduced = ReducedMarch::new(&model, &asked).map_err(EngineError::from)?;
        let mut trajectory = march(&mut reduced, &asked, &observer).map_err(EngineError::from)?;
        trajectory.estimate_step_error(&mut reduced, watch);
        if watch.cancelled() {
            return Err(EngineError::Cancelled);
        }
        let warnings: Vec<Warning> = trajectory.warnings().chain(model.domain.left_by(&trajectory)).collect();
        Ok((trajectory, warnings))
    })?;
    marched(py, &warnings, series("reduced", &trajectory))
}

/// Runs a scene, given by its text or its file, and checks its expectations. Returns an :class:`Outcome`.
///
/// ``model`` replaces the embedded models. Paths in a scene are relative to its file's folder.
#[pyfunction]
#[pyo3(signature = (scene, model=None, progress=None))]
pub fn run<'py>(
    py: Python<'py>,
    scene: &Bound<'py, PyAny>,
    model: Option<&Bound<'py, PyAny>>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyDict>)> {
    let (scene, base) = scene_of(scene)?;
    let bench = bench_of(model, base)?;
    bench.check_models(&scene).map_err(refused)?;
    let mut outcome = outcome(py, &scene, bench, progress)?;
    let tables = PyDict::new(py);
    for table in std::mem::take(&mut outcome.tables) {
        let (name, labels) = (table.name.clone(), table.labels.clone());
        tables.set_item(name, (array_of(py, table)?, labels))?;
    }
    let text = outcome.to_json().to_string();
    Ok((py.import("json")?.call_method1("loads", (text,))?, tables))
}

/// Returns the workbench of a study, with a model in place of the embedded ones if given, and paths relative to the
/// folder `base`.
fn bench_of(model: Option<&Bound<'_, PyAny>>, base: PathBuf) -> PyResult<Workbench> {
    let bench = Workbench::on(&crate::STORE, base);
    let Some(model) = model else { return Ok(bench) };
    Ok(bench.with_model(&match model.cast::<Model>() {
        Ok(model) => Arc::clone(&model.get().model),
        Err(_) => crate::STORE.model_of_file(&model.extract::<PathBuf>()?).map_err(refused)?,
    }))
}

fn outcome(
    py: Python<'_>,
    scene: &Scene,
    mut bench: Workbench,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<SceneOutcome> {
    long(py, progress, |watch| run_scene(scene, &mut bench, watch))
}

fn first_table(tables: Vec<Table>) -> PyResult<Table> {
    tables.into_iter().next().ok_or_else(|| refused("the study returned no table"))
}
