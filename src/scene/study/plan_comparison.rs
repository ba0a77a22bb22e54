//! Comparison of plans of snapshot selection: positions of their snapshots (Fig. 3.3), decay of the loss of information
//! (Fig. 3.4), failure rates of their models (Table 3.3), and errors, also along the trajectory (3.21) (Figs. 3.5 and
//! 3.7).
//!
//! Sets of different size are compared as in the dissertation, by the loss of information l(k) of (2.90), each
//! normalised by its own singular values. A slow decay means that the snapshots have little in common.
//! `relative_loss_p_40` is l(40) of the pressure over the largest l(40) of all plans, so that it is 1 for the slowest
//! decay. `modes_per_snapshot` is the efficiency of section 3.1.4, information per full solution. l(k) measures only
//! the set itself. How well a set represents the range is measured by the best approximation of pressures that are not
//! in the set, with as many modes as the smallest of the bases has (`unseen_…`).

use super::error_measures::OnlineScheme;
use super::path::trajectory_points;
use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Notice, Question, RunError, Setting, Table, Tell,
};
use crate::scene::check::{self, MAX_COMPARED, MAX_TESTS, count, number};
use crate::scene::method::ModelSource;
use crate::scene::names;
use crate::scene::parallel::{Reduced, film_errors, full_solutions, reduced_solutions};
use crate::scene::random_points::all_random_points;
use crate::scene::statistics::mean;
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::Solution;
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::{Moes, OperatingPoint};
use crate::solver::reduced::{ErrorMeasures, ModelSize, Norm, PodBasis, ReducedModel, Window};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// Comparison of plans of snapshot selection (Tables 3.2 and 3.3, Figs. 3.3 to 3.5 and 3.7).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlanComparison {
    /// The plans.
    pub plans: Vec<ComparedPlan>,
    /// Range of the random tests (3.17) and of the trajectory (3.21).
    pub range: ParameterSpace,
    /// Number of random tests per plan.
    pub tests: usize,
    /// Seed of the random tests.
    pub seed: u64,
    /// Number of tests that are compared with full solutions.
    pub compare: usize,
    /// Number of points along the trajectory.
    pub trajectory: usize,
    /// Online scheme of all models.
    #[serde(default)]
    pub online: OnlineScheme,
}

/// Plan to compare.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ComparedPlan {
    /// Name in results.
    pub name: String,
    /// Scene of the training; relative paths refer to this scene's folder.
    pub training: PathBuf,
    /// Published failure rate \[%\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub published_failure_percent: Option<f64>,
}

/// Row: first the models of all plans, then their tests, both in the order of the plans.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Row {
    /// Model of a plan.
    Trained(Trained),
    /// Test result of a plan.
    Tested(Tested),
}

/// Model of a plan.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trained {
    /// The plan.
    pub plan: ComparedPlan,
    /// The model, which has a single local model.
    pub model: Arc<ReducedModel>,
}

/// Test result of a plan's model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tested {
    /// The plan.
    pub plan: ComparedPlan,
    /// Number of random tests that failed.
    pub failures: usize,
    /// Relative errors of H_c and of H_min at the compared tests.
    pub errors: [Vec<f64>; 2],
    /// Errors of the best approximations of compared pressures, with as many modes as the smallest basis has.
    pub unseen: Vec<f64>,
    /// Results along the trajectory.
    pub along: Vec<Followed>,
    /// Number of failed full solutions, if they were computed for this plan first.
    pub full_failures: usize,
}

/// Contact of the trajectory, with full and reduced solution if available.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Followed {
    /// Position c on the trajectory.
    pub c: f64,
    /// Moes numbers of the contact.
    pub moes: Moes,
    /// H_c and P_c of the full solution.
    pub full: Option<(f64, f64)>,
    /// H_c, P_c and e_f^I of the reduced solution.
    pub reduced: Option<(f64, f64, f64)>,
    /// State error e_z.
    pub state_error: Option<f64>,
}

/// Losses of information at which modes are counted.
const LOSSES: [(f64, &str); 2] = [(1e-4, "1e-4"), (1e-6, "1e-6")];
/// Numbers of modes at which losses of information are compared.
const MODES: [usize; 2] = [40, 60];
/// Snapshots below this M count as lightly loaded. Above about 50, solutions hardly differ (section 3.1.4).
const LIGHT_M: f64 = 30.0;

/// Name and value, which may be missing at a contact.
type Known = (&'static str, fn(&Followed) -> Option<f64>);

/// Columns of the trajectory table for each plan.
const ALONG: [Known; 8] = [
    ("full.H_c", |f| Some(f.full?.0)),
    ("full.P_c", |f| Some(f.full?.1)),
    (names::H_C, |f| Some(f.reduced?.0)),
    (names::P_C, |f| Some(f.reduced?.1)),
    ("H_c_error", Followed::h_c_error),
    ("P_c_error", |f| Some((f.reduced?.1 / f.full?.1 - 1.0).abs())),
    ("e_z", |f| f.state_error),
    ("e_f_I", |f| Some(f.reduced?.2)),
];

impl Followed {
    fn h_c_error(&self) -> Option<f64> {
        Some((self.reduced?.0 / self.full?.0 - 1.0).abs())
    }
}

impl Trained {
    /// Returns the only local model; checked before.
    fn window(&self) -> &Window {
        &self.model.windows[0]
    }

    fn bases(&self) -> [(&'static str, &PodBasis); 2] {
        [("p", self.window().pressure.basis()), ("delta", &self.window().deformation)]
    }
}

/// Returns the losses l(k) of a basis, (2.90).
fn losses(basis: &PodBasis) -> Vec<f64> {
    (0..=basis.singular_values.len()).map(|k| basis.loss(k).max(0.0)).collect()
}

/// Full solutions on one grid.
struct Truth {
    grid: GridSpec,
    random: Vec<Option<Solution>>,
    along: Vec<Option<Solution>>,
}

/// Returns the number of modes of the smallest pressure basis.
fn common_modes(plans: &[&Trained]) -> usize {
    plans.iter().map(|plan| plan.window().pressure.count()).min().unwrap_or(0)
}

impl PlanComparison {
    fn train(&self, setting: &mut Setting<'_>) -> Result<Vec<Trained>, RunError> {
        let mut plans = Vec::new();
        for plan in &self.plans {
            let Setting { experiment, observer, .. } = *setting;
            let source = ModelSource::Trained(plan.training.clone());
            let model =
                setting.bench.model_for(&source, &experiment.request()?.point, &experiment.lubricant, observer)?;
            if model.windows.len() != 1 {
                let (name, windows) = (&plan.name, model.windows.len());
                return Err(RunError::Study(format!("plans are compared on one window, but `{name}` has {windows}")));
            }
            plans.push(Trained { plan: plan.clone(), model });
        }
        Ok(plans)
    }
}

impl Question for PlanComparison {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.plans (how many)", self.plans.len(), 1, 16)?;
        count("study.tests", self.tests, 1, MAX_TESTS)?;
        count("study.compare", self.compare, 0, self.tests.min(MAX_COMPARED))?;
        count("study.trajectory", self.trajectory, 2, MAX_COMPARED)?;
        check::names("study.plans.name", self.plans.iter().map(|plan| plan.name.as_str()))?;
        let published = self.plans.iter().filter_map(|plan| plan.published_failure_percent);
        published.into_iter().try_for_each(|p| number("study.plans.published_failure_percent", p, 0.0, 100.0))?;
        check::space("study.range", &self.range)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let lubricant = experiment.lubricant;
        let plans = self.train(setting)?;
        plans.iter().for_each(|plan| tell(Row::Trained(plan.clone())));
        let common = common_modes(&plans.iter().collect::<Vec<_>>());
        let points = all_random_points(&self.range, experiment.contact, self.tests, self.seed, observer)?;
        let path = trajectory_points(&self.range, experiment, self.trajectory);
        let along: Vec<OperatingPoint> = path.iter().map(|(_, point)| *point).collect();
        let options = self.online.options();
        let mut truths: Vec<Truth> = Vec::new();
        for plan in &plans {
            let (grid, mut full_failures) = (&plan.window().grid, 0);
            let k = match truths.iter().position(|truth| truth.grid == grid.spec()) {
                Some(k) => k,
                None => {
                    let solve =
                        |points: &[OperatingPoint]| full_solutions(|_| grid.clone(), points, lubricant, observer);
                    let (random, along) = (solve(&points[..self.compare])?, solve(&along)?);
                    full_failures = random.iter().chain(&along).filter(|full| full.is_none()).count();
                    truths.push(Truth { grid: grid.spec(), random, along });
                    truths.len() - 1
                }
            };
            let truth = &truths[k];
            let wanted = |i: usize| i < self.compare;
            let tested = reduced_solutions(&plan.model, options, &points, lubricant, wanted, observer)?;
            let followed = reduced_solutions(&plan.model, options, &along, lubricant, |_| true, observer)?;
            let measures = ErrorMeasures::new(plan.window(), &options, Norm::Euclidean);
            let follow = |(((c, point), reduced), full): (((f64, OperatingPoint), &Option<_>), &Option<Solution>)| {
                let reduced: Option<&Reduced> = Option::as_ref(reduced);
                let own = reduced.and_then(|reduced| Some((reduced, reduced.fields.as_ref()?)));
                let residual = |(reduced, fields): (&Reduced, _)| {
                    measures.residuals(&reduced.solved.coefficients, fields).sampled_rows
                };
                Followed {
                    c,
                    moes: point.moes(),
                    full: full.as_ref().map(|full| (full.scalars.h_c, full.scalars.p_c)),
                    reduced: own.map(|own| (own.1.scalars.h_c, own.1.scalars.p_c, residual(own))),
                    state_error: own.zip(full.as_ref()).map(|((_, fields), full)| measures.state_error(fields, full)),
                }
            };
            tell(Row::Tested(Tested {
                plan: plan.plan.clone(),
                failures: tested.iter().filter(|solved| solved.is_none()).count(),
                errors: film_errors(&tested, &truth.random),
                unseen: unseen(plan.window(), common, &truth.random),
                along: path.iter().copied().zip(&followed).zip(&truth.along).map(follow).collect(),
                full_failures,
            }));
        }
        Ok(())
    }

    /// Values are named `plan.value`, with the plan's name. `order.as_published` is the number of pairs of plans whose
    /// failure rates are in the published order, `order.against` the number of pairs in the opposite order. Pairs with
    /// equal rates are not counted.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let (plans, tested) = (only!(rows, Row::Trained), only!(rows, Row::Tested));
        for Trained { plan, model } in &plans {
            let sentence = |line: &String| Notice::Sentence(format!("{}: {line}", plan.name));
            found.warnings.extend(model.log.iter().map(sentence));
        }
        plans.iter().for_each(|plan| snapshots(plan, found));
        plans.iter().for_each(|plan| information(plan, found));
        relative_losses(&plans, found);
        found.push("common_modes", None, common_modes(&plans) as f64);
        let percent = |tested: &Tested| 100.0 * tested.failures as f64 / self.tests as f64;
        for one in &tested {
            let name = &one.plan.name;
            found.push(format!("{name}.failures"), None, one.failures as f64);
            found.push(format!("{name}.failure_percent"), None, percent(one));
            if let Some(published) = one.plan.published_failure_percent {
                found.push(format!("{name}.failure_percent_published"), None, published);
            }
            found.push_spread(&format!("{name}.H_c_error"), None, &one.errors[0]);
            found.push_spread(&format!("{name}.H_min_error"), None, &one.errors[1]);
            found.push_spread(&format!("{name}.unseen"), None, &one.unseen);
            let column = |get: fn(&Followed) -> Option<f64>| one.along.iter().filter_map(get).collect::<Vec<f64>>();
            let residuals = column(|followed| Some(followed.reduced?.2));
            found.push(format!("{name}.trajectory_failures"), None, (one.along.len() - residuals.len()) as f64);
            found.push_spread(&format!("{name}.trajectory_H_c_error"), None, &column(Followed::h_c_error));
            found.push(format!("{name}.trajectory_e_z_mean"), None, mean(&column(|followed| followed.state_error)));
            found.push(format!("{name}.trajectory_e_f_I_mean"), None, mean(&residuals));
        }
        found.push("tests", None, self.tests as f64);
        found.push("full_failures", None, tested.iter().map(|tested| tested.full_failures).sum::<usize>() as f64);
        let rated = tested.iter().filter_map(|one| Some((one.plan.published_failure_percent?, percent(one))));
        let rated: Vec<(f64, f64)> = rated.collect();
        let pairs = || rated.iter().flat_map(|a| rated.iter().map(move |b| (a, b))).filter(|(a, b)| a.0 < b.0);
        found.push("order.as_published", None, pairs().filter(|(a, b)| a.1 < b.1).count() as f64);
        found.push("order.against", None, pairs().filter(|(a, b)| a.1 > b.1).count() as f64);
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let plans = only!(rows, Row::Trained);
        vec![snapshot_table(&plans), loss_table(&plans), trajectory_table(&only!(rows, Row::Tested))]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let (plans, tested) = (only!(rows, Row::Trained), only!(rows, Row::Tested));
        let (m, l) = (ChartAxis::log("Load number M"), ChartAxis::linear("Lubricant number L"));
        let mut places = Chart::new("Snapshots", m, l);
        let k = ChartAxis::linear("Modes k");
        let mut decay = Chart::new("Loss of information of the pressure", k, ChartAxis::log("l(k)"));
        for plan in &plans {
            let points = plan.window().snapshots.iter().map(|s| s.point.moes()).map(|moes| [moes.m, moes.l]);
            places.add(plan.plan.name.as_str(), Marks::Dots, points);
            let losses = losses(plan.window().pressure.basis()).into_iter().enumerate();
            decay.add(plan.plan.name.as_str(), Marks::Line, losses.map(|(k, loss)| [k as f64, loss]));
        }
        let y = ChartAxis::log("Relative error of H_c");
        let mut errors = Chart::new("Along the trajectory", ChartAxis::linear("c"), y);
        for one in &tested {
            let points = one.along.iter().filter_map(|followed| Some([followed.c, followed.h_c_error()?]));
            errors.add(one.plan.name.as_str(), Marks::Line, points);
        }
        vec![places, decay, errors]
    }
}

/// Adds values about the snapshots (Fig. 3.3).
fn snapshots(trained: &Trained, found: &mut Findings) {
    let (name, window) = (&trained.plan.name, trained.window());
    let count = window.snapshots.len();
    let light = window.snapshots.iter().filter(|snapshot| snapshot.point.moes().m < LIGHT_M).count();
    found.push(format!("{name}.snapshots"), None, count as f64);
    found.push(format!("{name}.share_below_m_30"), None, light as f64 / count as f64);
    let ModelSize { pressure, deformation, rows } = window.size();
    for (what, size) in [("basis_p", pressure), ("basis_delta", deformation), ("sampled_rows", rows)] {
        found.push(format!("{name}.{what}"), None, size as f64);
    }
}

/// Adds the numbers of modes needed for losses of information.
fn information(trained: &Trained, found: &mut Findings) {
    let (name, snapshots) = (&trained.plan.name, trained.window().snapshots.len() as f64);
    for (field, basis) in trained.bases() {
        let losses = losses(basis);
        for (loss, label) in LOSSES {
            let modes = losses.iter().position(|l| *l <= loss).unwrap_or(losses.len() - 1) as f64;
            found.push(format!("{name}.modes_{field}_{label}"), None, modes);
            found.push(format!("{name}.modes_per_snapshot_{field}_{label}"), None, modes / snapshots);
        }
    }
}

/// Adds losses of information at the same numbers of modes, each over the largest of all plans.
fn relative_losses(plans: &[&Trained], found: &mut Findings) {
    for modes in MODES {
        for f in 0..2 {
            let loss = |plan: &&Trained| losses(plan.bases()[f].1).get(modes).copied().unwrap_or(0.0);
            let losses: Vec<f64> = plans.iter().map(loss).collect();
            let slowest = losses.iter().copied().fold(0.0, f64::max);
            for (plan, loss) in plans.iter().zip(losses) {
                let (name, (field, _)) = (&plan.plan.name, plan.bases()[f]);
                found.push(format!("{name}.loss_{field}_{modes}"), None, loss);
                // If all sets are smaller than this, no information is lost.
                if slowest > 0.0 {
                    found.push(format!("{name}.relative_loss_{field}_{modes}"), None, loss / slowest);
                }
            }
        }
    }
}

/// Returns the positions of the snapshots (Fig. 3.3). The column `plan` numbers the plans from 1.
fn snapshot_table(plans: &[&Trained]) -> Table {
    let mut table =
        Table::new("snapshots", &["plan", names::M, names::L, names::RADIUS, names::SPEED, names::LOAD, names::ALPHA]);
    for (k, plan) in plans.iter().enumerate() {
        table.rows.extend(plan.window().snapshots.iter().map(|snapshot| {
            let (point, moes) = (&snapshot.point, snapshot.point.moes());
            let place = [point.radius_m, point.speed_m_per_s, point.load, point.alpha_per_pa];
            [(k + 1) as f64, moes.m, moes.l].into_iter().chain(place).collect()
        }));
    }
    table
}

/// Returns the loss of information l(k) of pressure and deformation (Fig. 3.4), one pair of columns per plan.
fn loss_table(plans: &[&Trained]) -> Table {
    let bases = || plans.iter().flat_map(|plan| plan.bases().map(|(field, basis)| (&plan.plan.name, field, basis)));
    let named = bases().map(|(name, field, _)| format!("{name}.{field}"));
    let all: Vec<Vec<f64>> = bases().map(|(.., basis)| losses(basis)).collect();
    let longest = all.iter().map(Vec::len).max().unwrap_or(0);
    let row = |k: usize| {
        let losses = all.iter().map(|losses| losses.get(k).copied().unwrap_or(f64::NAN));
        std::iter::once(k as f64).chain(losses).collect()
    };
    Table {
        name: "loss_of_information".to_owned(),
        columns: std::iter::once("k".to_owned()).chain(named).collect(),
        rows: (0..longest).map(row).collect(),
        ..Table::default()
    }
}

/// Returns the path through the M–L plane, and full and reduced results along it (Figs. 3.5 and 3.7).
fn trajectory_table(tested: &[&Tested]) -> Table {
    let mut table = Table::new("trajectory", &["c", names::M, names::L]);
    if let Some(first) = tested.first() {
        table.rows = first.along.iter().map(|at| vec![at.c, at.moes.m, at.moes.l]).collect();
    }
    for one in tested {
        table.columns.extend(ALONG.map(|(column, _)| format!("{}.{column}", one.plan.name)));
        for (row, followed) in table.rows.iter_mut().zip(&one.along) {
            row.extend(ALONG.map(|(_, get)| get(followed).unwrap_or(f64::NAN)));
        }
    }
    table
}

/// Returns ‖P − V_k V_kᵀ W P‖/‖P‖ of full pressures P, with the first k modes V_k and the weights W of the grid.
fn unseen(window: &Window, modes: usize, truth: &[Option<Solution>]) -> Vec<f64> {
    let (basis, weights) = (&window.pressure.basis().modes, window.grid.weights());
    let size = |p: &[f64]| weights.iter().zip(p).map(|(w, p)| w * p * p).sum::<f64>();
    let left = |full: &Solution| {
        let mut rest = full.pressure.clone();
        for k in 0..modes {
            let share: f64 = rest.iter().enumerate().map(|(i, p)| weights[i] * basis[(i, k)] * p).sum();
            rest.iter_mut().enumerate().for_each(|(i, p)| *p -= share * basis[(i, k)]);
        }
        (size(&rest) / size(&full.pressure)).sqrt()
    };
    truth.iter().flatten().map(left).collect()
}
