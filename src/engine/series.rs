//! Contacts along a path: sweeps and the test trajectory (3.21), each solve from its neighbour.

use super::answer::Request;
use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::report::{PointReport, RESULT_COLUMNS};
use super::run::{request_of, step};
use super::statistics::{median, percentile};
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{At, Axis, Grid, Method, QuantityBox, Scene, Steps, Variable};
use crate::solver::full::Solution;
use crate::solver::physics::contact::{OperatingPoint, PLAUSIBLE_HERTZ_PRESSURE_PA};
use crate::solver::physics::lubricant::Sliding;
use crate::solver::training::TrainingObserver;

/// What a reduced method's errors against the first full one are stated of.
const COMPARED: [&str; 3] = ["H_c", "H_min", "traction"];

/// Errors of smaller tractions are relative to this.
const LEAST_TRACTION: f64 = 0.005;

/// Contacts one after the other: the name of the table, what is varied, the contacts, whether full solves start cold, and whether reduced ones
/// are compared with full ones on their model's grid.
struct Path<'a> {
    name: &'a str,
    varied: &'a [&'a str],
    contacts: &'a [Contact],
    cold: bool,
    on_model_grid: bool,
}

/// One contact of a path with the varied values.
pub(super) struct Contact {
    values: Vec<f64>,
    pub point: OperatingPoint,
}

/// Runs a scene's sweep.
pub(super) fn sweep(
    scene: &Scene,
    (over, methods, (cold, on_model_grid)): (&[Axis], &[Method], (bool, bool)),
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let contacts = contacts_of(scene, over)?;
    let varied: Vec<&str> = over.iter().map(|axis| axis.vary.name()).collect();
    let path = Path { name: "sweep", varied: &varied, contacts: &contacts, cold, on_model_grid };
    along(&path, scene, methods, workbench, observer, outcome)
}

/// All combinations of the values of the axes, the last one fastest.
pub(super) fn contacts_of(scene: &Scene, over: &[Axis]) -> Result<Vec<Contact>, EngineError> {
    let mut contacts = Vec::new();
    for values in Steps::combinations(over.iter().map(|axis| &axis.values)) {
        let (mut at, mut sliding) = (scene.at, scene.sliding());
        for (axis, &value) in over.iter().zip(&values) {
            set(&mut at, &mut sliding, axis.vary, value)?;
        }
        let point = at.with_alpha_of(&scene.lubricant).point(scene.contact)?;
        contacts.push(Contact { values, point: OperatingPoint { sliding, ..point } });
    }
    Ok(contacts)
}

/// Runs the test trajectory.
pub(super) fn trajectory(
    scene: &Scene,
    range: &QuantityBox,
    count: usize,
    methods: &[Method],
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let mut contacts = Vec::with_capacity(count);
    for i in 0..count {
        let c = 2.0 * i as f64 / (count - 1) as f64;
        let point = range.trajectory(scene.contact, c);
        point.check()?;
        contacts.push(Contact { values: vec![c], point: OperatingPoint { sliding: scene.sliding(), ..point } });
    }
    let path = Path { name: "trajectory", varied: &["c"], contacts: &contacts, cold: false, on_model_grid: false };
    along(&path, scene, methods, workbench, observer, outcome)
}

/// Sets one quantity of an operating point or its sliding.
fn set(at: &mut At, sliding: &mut Sliding, variable: Variable, value: f64) -> Result<(), EngineError> {
    match (variable, at) {
        (Variable::M | Variable::L, At::Si { .. }) => {
            return Err(EngineError::Study(format!(
                "{} can only be varied where `at` is Moes(…), which says what follows",
                variable.name()
            )));
        }
        (Variable::M, At::Moes { m, .. }) => *m = value,
        (Variable::L, At::Moes { l, .. }) => *l = value,
        (Variable::Radius, At::Si { radius, .. }) => *radius = value,
        (Variable::Radius, At::Moes { radius, .. }) => *radius = Some(value),
        (Variable::Speed, At::Si { speed, .. }) => *speed = value,
        (Variable::Speed, At::Moes { speed, .. }) => *speed = Some(value),
        (Variable::Load, At::Si { load, .. }) => *load = value,
        (Variable::Load, At::Moes { load, .. }) => *load = Some(value),
        (Variable::Modulus, At::Si { modulus, .. }) => *modulus = value,
        (Variable::Modulus, At::Moes { modulus, .. }) => *modulus = Some(value),
        (Variable::Viscosity, At::Si { viscosity, .. }) => *viscosity = value,
        (Variable::Viscosity, At::Moes { viscosity, .. }) => *viscosity = Some(value),
        (Variable::Alpha, At::Si { alpha, .. }) => *alpha = value,
        (Variable::Alpha, At::Moes { alpha, .. }) => *alpha = Some(value),
        (Variable::SlideToRollRatio, _) => sliding.slide_to_roll_ratio = value,
        (Variable::NewtonianPlateauRatio, _) => sliding.newtonian_plateau_ratio = Some(value),
    }
    Ok(())
}

/// Solves all points by all methods: table, failures, and the reduced methods' errors against the first full one, or one on the model's grid.
fn along(
    path: &Path<'_>,
    scene: &Scene,
    methods: &[Method],
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let &Path { name, varied, contacts, cold, on_model_grid } = path;
    let template = request_of(scene)?;
    let mut columns: Vec<String> = varied.iter().map(|&v| v.to_owned()).collect();
    columns.extend(["M", "L", "radius", "speed", "load", "alpha", "p_h_pa"].map(str::to_owned));
    let tags: Vec<String> = (0..methods.len()).map(|k| tag(methods, k)).collect();
    columns.extend(tags.iter().flat_map(|tag| RESULT_COLUMNS.iter().map(move |column| format!("{tag}.{column}"))));
    let mut table =
        Table { name: name.to_owned(), columns, rows: Vec::with_capacity(contacts.len()), labels: Vec::new() };
    let mut tallies = vec![Tally::default(); methods.len()];
    let mut former: Vec<Option<Solution>> = vec![None; methods.len()];
    let full = methods.iter().position(|method| *method == Method::Full);
    let mut beside = on_model_grid.then(Beside::default);
    for (i, Contact { values, point }) in contacts.iter().enumerate() {
        step(observer, name, i, contacts.len())?;
        let request = Request { point: *point, ..template.clone() };
        let (moes, p_h) = (point.moes(), point.hertz().pressure_pa);
        let mut row = values.clone();
        row.extend([moes.m, moes.l, point.radius_m, point.speed_m_per_s, point.load, point.alpha_per_pa, p_h]);
        let mut compared = vec![[f64::NAN; 3]; methods.len()];
        for (k, method) in methods.iter().enumerate() {
            let start = former[k].as_ref().filter(|_| !cold);
            let answer = workbench.answer(&request, method, start, observer)?;
            let report = PointReport::from(&answer);
            row.extend(report.row(&RESULT_COLUMNS));
            compared[k].copy_from_slice(&report.row(&COMPARED));
            // Single contacts, for the expectations that ask for them.
            for wanted in scene.expect.iter().filter_map(|e| e.name.strip_suffix(&format!("[{i}]"))) {
                report.row(&[wanted]).into_iter().for_each(|v| outcome.push(format!("{wanted}[{i}]"), Some(method), v));
            }
            let tally = &mut tallies[k];
            if !answer.converged {
                if p_h <= PLAUSIBLE_HERTZ_PRESSURE_PA { tally.failures += 1 } else { tally.failures_beyond += 1 }
            }
            tally.newton.push(answer.newton_iterations as f64);
            tally.seconds.push(answer.wall_s);
            if answer.converged {
                former[k] = answer.solution;
            }
        }
        let truths = match &mut beside {
            Some(beside) => Some(beside.solve(&request, cold, workbench, observer)?),
            None => full.map(|full| compared[full]),
        };
        if let Some(truths) = truths {
            for (tally, own) in tallies.iter_mut().zip(&compared) {
                for (k, errors) in tally.errors.iter_mut().enumerate() {
                    let (value, truth) = (own[k], truths[k]);
                    // Next to nothing has no relative error.
                    let size = if COMPARED[k] == "traction" { truth.abs().max(LEAST_TRACTION) } else { truth };
                    errors.extend(Some(((value - truth) / size).abs()).filter(|error| error.is_finite()));
                }
            }
        }
        table.rows.push(row);
    }
    outcome.push("points", None, contacts.len() as f64);
    if let Some(Beside { failures, .. }) = beside {
        outcome.converged &= failures == 0;
        outcome.push("failures_on_model_grid", None, failures as f64);
    }
    for (method, tally) in methods.iter().zip(&tallies) {
        tally.report(method, full.is_some() || on_model_grid, outcome);
    }
    outcome.tables.push(table);
    Ok(())
}

/// Full solutions on the model's grid, beside the methods of a path.
#[derive(Default)]
struct Beside {
    former: Option<Solution>,
    failures: usize,
}

impl Beside {
    /// What is [`COMPARED`] of the contact of a request; not a number where the solve fails.
    fn solve(
        &mut self,
        request: &Request,
        cold: bool,
        workbench: &mut Workbench,
        observer: &dyn TrainingObserver,
    ) -> Result<[f64; 3], EngineError> {
        let request = Request { grid: Grid::Model, ..request.clone() };
        let start = self.former.as_ref().filter(|_| !cold);
        let answer = workbench.answer(&request, &Method::Full, start, observer)?;
        if !answer.converged {
            self.failures += 1;
            return Ok([f64::NAN; 3]);
        }
        let mut compared = [f64::NAN; 3];
        compared.copy_from_slice(&PointReport::from(&answer).row(&COMPARED));
        self.former = answer.solution;
        Ok(compared)
    }
}

/// `full`, `reduced`, and with a number where a kind occurs again.
fn tag(methods: &[Method], k: usize) -> String {
    let name = methods[k].name();
    match methods[..k].iter().filter(|method| method.name() == name).count() {
        0 => name.to_owned(),
        again => format!("{name}{}", again + 1),
    }
}

#[derive(Clone, Debug, Default)]
struct Tally {
    failures: usize,
    failures_beyond: usize,
    newton: Vec<f64>,
    seconds: Vec<f64>,
    /// Of what is [`COMPARED`].
    errors: [Vec<f64>; 3],
}

impl Tally {
    fn report(&self, method: &Method, compared: bool, outcome: &mut SceneOutcome) {
        let of = Some(method);
        outcome.converged &= self.failures == 0;
        outcome.push("failures", of, self.failures as f64);
        outcome.push("failures_beyond", of, self.failures_beyond as f64);
        outcome.push("newton_median", of, median(&self.newton));
        outcome.push("newton_max", of, percentile(&self.newton, 1.0));
        outcome.push("median_s", of, median(&self.seconds));
        outcome.push("p99_s", of, percentile(&self.seconds, 0.99));
        if compared && *method != Method::Full {
            for (name, errors) in COMPARED.iter().zip(&self.errors) {
                outcome.push(format!("{name}_error_median"), of, median(errors));
                outcome.push(format!("{name}_error_p95"), of, percentile(errors, 0.95));
                outcome.push(format!("{name}_error_max"), of, percentile(errors, 1.0));
            }
        }
    }
}
