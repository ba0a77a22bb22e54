//! Plans of snapshot selection side by side: where their snapshots lie (Fig. 3.3), how fast their information decays (Fig. 3.4), how
//! often their models fail (Table 3.3), how far they are off, also along the trajectory (3.21) (Figs. 3.5 and 3.7).
//!
//! Sets of different size are compared as the dissertation does, by the loss of information l(k) of (2.90), each normalised by its own
//! singular values: a slow decay means that the snapshots have little in common. `relative_loss_p_40` is l(40) of the pressure over the
//! largest l(40) of all plans, one for the slowest decay; `modes_per_snapshot` is the efficiency of section 3.1.4, information
//! per full solution. l(k) says what a set knows of itself; what it knows of the range is told by the best approximation of
//! pressures it has never seen, with as many modes as the smallest of the bases has (`unseen_…`).

use super::error::EngineError;
use super::outcome::SceneOutcome;
use super::parallel::{Reduced, full_solutions, reduced_solutions};
use super::table::Table;
use super::workbench::Workbench;
use crate::scene::{ComparedPlan, ModelSource, OnlineScheme, QuantityBox, Scene};
use crate::solver::discrete::grid::ContactGridSpec;
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{ErrorMeasures, Norm, PodBasis, ReducedModel, Window};
use crate::solver::training::{Range, TrainingObserver, random_points};
use std::sync::Arc;

/// What is compared on what.
pub(super) struct PlanComparison<'a> {
    pub plans: &'a [ComparedPlan],
    pub range: &'a QuantityBox,
    pub tests: usize,
    pub seed: u64,
    pub compare: usize,
    pub trajectory: usize,
    pub online: OnlineScheme,
}

/// Losses of information at which modes are counted.
const LOSSES: [(f64, &str); 2] = [(1e-4, "1e-4"), (1e-6, "1e-6")];
/// Numbers of modes at which losses of information are compared.
const MODES: [usize; 2] = [40, 60];
/// Snapshots below this M count as lightly loaded; above about 50 solutions hardly differ (section 3.1.4).
const LIGHT_M: f64 = 30.0;

struct Plan<'a> {
    name: &'a str,
    published: Option<f64>,
    model: Arc<ReducedModel>,
}

impl Plan<'_> {
    /// The only window, which the caller has checked.
    fn window(&self) -> &Window {
        &self.model.windows[0]
    }
}

/// Values are named `plan.value`, with the plan's name. `order.as_published` counts pairs of plans whose failure rates differ as the
/// published ones do, `order.against` those that differ the other way; equal rates count as neither.
pub(super) fn run(
    scene: &Scene,
    study: &PlanComparison<'_>,
    workbench: &mut Workbench,
    observer: &dyn TrainingObserver,
    outcome: &mut SceneOutcome,
) -> Result<(), EngineError> {
    let mut plans = Vec::new();
    for ComparedPlan { name, training, published_failure_percent } in study.plans {
        let model = workbench.model(&ModelSource::Trained(training.clone()), scene.contact, observer)?;
        if model.windows.len() != 1 {
            let windows = model.windows.len();
            return Err(EngineError::Study(format!("plans are compared on one window, but `{name}` has {windows}")));
        }
        outcome.warnings.extend(model.log.iter().map(|line| format!("{name}: {line}")));
        plans.push(Plan { name, published: *published_failure_percent, model });
    }
    snapshots(&plans, outcome);
    information(&plans, outcome);
    let points = random_points(&Range::Box(*study.range), scene.contact, study.tests, study.seed);
    let path: Vec<(f64, OperatingPoint)> = (0..study.trajectory)
        .map(|i| 2.0 * i as f64 / (study.trajectory - 1) as f64)
        .map(|c| (c, study.range.trajectory(scene.contact, c)))
        .collect();
    let along: Vec<OperatingPoint> = path.iter().map(|(_, point)| *point).collect();
    let mut truths: Vec<Truth> = Vec::new();
    let common = plans.iter().map(|plan| plan.window().pressure.modes.ncols()).min().unwrap_or(0);
    outcome.push("common_modes", None, common as f64);
    let mut rates = Vec::new();
    let mut trajectory = Trajectory::new(&path);
    for plan in &plans {
        let grid = &plan.window().grid;
        let k = match truths.iter().position(|truth| truth.grid == grid.spec()) {
            Some(k) => k,
            None => {
                let solve =
                    |points: &[OperatingPoint]| full_solutions(|_| grid.clone(), points, scene.lubricant, observer);
                let (random, along) = (solve(&points[..study.compare.min(points.len())])?, solve(&along)?);
                truths.push(Truth { grid: grid.spec(), random, along });
                truths.len() - 1
            }
        };
        let truth = &truths[k];
        let options = study.online.options();
        let wanted = |i: usize| i < study.compare;
        let tested = reduced_solutions(&plan.model, options, &points, scene.lubricant, wanted, observer)?;
        let failures = tested.iter().filter(|solved| solved.is_none()).count();
        let percent = 100.0 * failures as f64 / points.len() as f64;
        rates.push(percent);
        let name = plan.name;
        outcome.push(format!("{name}.failures"), None, failures as f64);
        outcome.push(format!("{name}.failure_percent"), None, percent);
        if let Some(published) = plan.published {
            outcome.push(format!("{name}.failure_percent_published"), None, published);
        }
        films(name, &tested, &truth.random, outcome);
        outcome.push_spread(&format!("{name}.unseen"), &unseen(plan.window(), common, &truth.random));
        let followed = reduced_solutions(&plan.model, options, &along, scene.lubricant, |_| true, observer)?;
        let measures = ErrorMeasures::new(plan.window(), &options, Norm::Euclidean);
        trajectory.add(name, &measures, &followed, &truth.along, outcome);
    }
    let full_failures = truths.iter().flat_map(|t| t.random.iter().chain(&t.along)).filter(|f| f.is_none()).count();
    outcome.push("tests", None, points.len() as f64);
    outcome.push("full_failures", None, full_failures as f64);
    order(&plans, &rates, outcome);
    outcome.tables.push(trajectory.table);
    Ok(())
}

/// Full solutions on one grid.
struct Truth {
    grid: ContactGridSpec,
    random: Vec<Option<Solution>>,
    along: Vec<Option<Solution>>,
}

/// Fig. 3.3: where the snapshots lie. The column `plan` counts the plans from 1.
fn snapshots(plans: &[Plan<'_>], outcome: &mut SceneOutcome) {
    let mut table = Table::new("snapshots", &["plan", "M", "L", "radius", "speed", "load", "alpha"]);
    for (k, plan) in plans.iter().enumerate() {
        let (name, window) = (plan.name, plan.window());
        let mut light = 0;
        for snapshot in &window.snapshots {
            let (point, moes) = (&snapshot.point, snapshot.point.moes());
            light += usize::from(moes.m < LIGHT_M);
            let place = [point.radius_m, point.speed_m_per_s, point.load, point.alpha_per_pa];
            table.rows.push([(k + 1) as f64, moes.m, moes.l].into_iter().chain(place).collect());
        }
        let count = window.snapshots.len();
        outcome.push(format!("{name}.snapshots"), None, count as f64);
        outcome.push(format!("{name}.share_below_m_30"), None, light as f64 / count as f64);
        outcome.push(format!("{name}.basis_p"), None, window.pressure.modes.ncols() as f64);
        outcome.push(format!("{name}.basis_delta"), None, window.deformation.modes.ncols() as f64);
        outcome.push(format!("{name}.sampled_rows"), None, window.sampled_rows.len() as f64);
    }
    outcome.tables.push(table);
}

/// Fig. 3.4: the loss of information l(k) of pressure and deformation, one pair of columns per plan.
fn information(plans: &[Plan<'_>], outcome: &mut SceneOutcome) {
    let bases = |plan: &Plan<'_>| -> [(String, Vec<f64>); 2] {
        let losses = |basis: &PodBasis| (0..=basis.singular_values.len()).map(|k| basis.loss(k).max(0.0)).collect();
        let window = plan.window();
        [("p".to_owned(), losses(&window.pressure)), ("delta".to_owned(), losses(&window.deformation))]
    };
    let mut columns = vec!["k".to_owned()];
    let mut all: Vec<Vec<f64>> = Vec::new();
    for plan in plans {
        for (field, losses) in bases(plan) {
            for (loss, label) in LOSSES {
                let modes = losses.iter().position(|l| *l <= loss).unwrap_or(losses.len() - 1) as f64;
                outcome.push(format!("{}.modes_{field}_{label}", plan.name), None, modes);
                let per_snapshot = modes / plan.window().snapshots.len() as f64;
                outcome.push(format!("{}.modes_per_snapshot_{field}_{label}", plan.name), None, per_snapshot);
            }
            columns.push(format!("{}.{field}", plan.name));
            all.push(losses);
        }
    }
    for modes in MODES {
        for (f, field) in ["p", "delta"].iter().enumerate() {
            let losses: Vec<f64> =
                all.iter().skip(f).step_by(2).map(|l| l.get(modes).copied().unwrap_or(0.0)).collect();
            let slowest = losses.iter().copied().fold(0.0, f64::max);
            for (plan, loss) in plans.iter().zip(&losses) {
                outcome.push(format!("{}.loss_{field}_{modes}", plan.name), None, *loss);
                // Where all sets are smaller than that, none of them loses anything.
                if slowest > 0.0 {
                    outcome.push(format!("{}.relative_loss_{field}_{modes}", plan.name), None, loss / slowest);
                }
            }
        }
    }
    let longest = all.iter().map(Vec::len).max().unwrap_or(0);
    let rows = (0..longest)
        .map(|k| {
            let losses = all.iter().map(|losses| losses.get(k).copied().unwrap_or(f64::NAN));
            std::iter::once(k as f64).chain(losses).collect()
        })
        .collect();
    outcome.tables.push(Table { name: "loss_of_information".to_owned(), columns, rows, labels: Vec::new() });
}

/// Relative film errors against full solutions.
fn films(name: &str, tested: &[Option<Reduced>], truth: &[Option<Solution>], outcome: &mut SceneOutcome) {
    let mut errors: [Vec<f64>; 2] = Default::default();
    for (reduced, full) in tested.iter().zip(truth) {
        if let (Some(fields), Some(full)) = (reduced.as_ref().and_then(|r| r.fields.as_ref()), full) {
            errors[0].push((fields.scalars.h_c / full.scalars.h_c - 1.0).abs());
            errors[1].push((fields.scalars.h_min / full.scalars.h_min - 1.0).abs());
        }
    }
    outcome.push_spread(&format!("{name}.H_c_error"), &errors[0]);
    outcome.push_spread(&format!("{name}.H_min_error"), &errors[1]);
}

/// ‖P − V_k V_kᵀ W P‖/‖P‖ of full pressures under the grid's weights, with the first k modes.
fn unseen(window: &Window, modes: usize, truth: &[Option<Solution>]) -> Vec<f64> {
    let (basis, weights) = (&window.pressure.modes, window.grid.weights());
    let size = |p: &[f64]| weights.iter().zip(p).map(|(w, p)| w * p * p).sum::<f64>();
    truth
        .iter()
        .flatten()
        .map(|full| {
            let mut rest = full.pressure.clone();
            for k in 0..modes {
                let share: f64 = rest.iter().enumerate().map(|(i, p)| weights[i] * basis[(i, k)] * p).sum();
                rest.iter_mut().enumerate().for_each(|(i, p)| *p -= share * basis[(i, k)]);
            }
            (size(&rest) / size(&full.pressure)).sqrt()
        })
        .collect()
}

/// Figs. 3.5 and 3.7: the path through the M–L plane, and what full and reduced models say along it.
struct Trajectory {
    table: Table,
}

impl Trajectory {
    fn new(path: &[(f64, OperatingPoint)]) -> Self {
        let mut table = Table::new("trajectory", &["c", "M", "L"]);
        table.rows = path.iter().map(|(c, point)| vec![*c, point.moes().m, point.moes().l]).collect();
        Self { table }
    }

    fn add(
        &mut self,
        name: &str,
        measures: &ErrorMeasures,
        followed: &[Option<Reduced>],
        truth: &[Option<Solution>],
        outcome: &mut SceneOutcome,
    ) {
        let columns = ["H_c_full", "P_c_full", "H_c", "P_c", "H_c_error", "P_c_error", "e_z", "e_f_I"];
        self.table.columns.extend(columns.map(|column| format!("{name}.{column}")));
        let (mut films, mut states, mut residuals, mut failures) = (Vec::new(), Vec::new(), Vec::new(), 0);
        for ((row, reduced), full) in self.table.rows.iter_mut().zip(followed).zip(truth) {
            let full_scalars = full.as_ref().map(|full| full.scalars);
            let own = reduced.as_ref().and_then(|r| r.fields.as_ref().map(|fields| (r, fields)));
            failures += usize::from(reduced.is_none());
            let mut values = [f64::NAN; 8];
            if let Some(full) = full_scalars {
                (values[0], values[1]) = (full.h_c, full.p_c);
            }
            if let Some((reduced, fields)) = own {
                (values[2], values[3]) = (fields.scalars.h_c, fields.scalars.p_c);
                values[7] = measures.residuals(&reduced.solved.coefficients, fields).sampled_rows;
                residuals.push(values[7]);
                if let Some(full) = full {
                    values[4] = (values[2] / values[0] - 1.0).abs();
                    values[5] = (values[3] / values[1] - 1.0).abs();
                    values[6] = measures.state_error(fields, full);
                    films.push(values[4]);
                    states.push(values[6]);
                }
            }
            row.extend(values);
        }
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        outcome.push(format!("{name}.trajectory_failures"), None, failures as f64);
        outcome.push_spread(&format!("{name}.trajectory_H_c_error"), &films);
        outcome.push(format!("{name}.trajectory_e_z_mean"), None, mean(&states));
        outcome.push(format!("{name}.trajectory_e_f_I_mean"), None, mean(&residuals));
    }
}

/// Pairs of plans whose failure rates differ as the published ones, and the other way.
fn order(plans: &[Plan<'_>], rates: &[f64], outcome: &mut SceneOutcome) {
    let (mut as_published, mut against) = (0, 0);
    for (i, a) in plans.iter().enumerate() {
        for (j, b) in plans.iter().enumerate() {
            if let (Some(published_a), Some(published_b)) = (a.published, b.published)
                && published_a < published_b
            {
                as_published += usize::from(rates[i] < rates[j]);
                against += usize::from(rates[i] > rates[j]);
            }
        }
    }
    outcome.push("order.as_published", None, as_published as f64);
    outcome.push("order.against", None, against as f64);
}
