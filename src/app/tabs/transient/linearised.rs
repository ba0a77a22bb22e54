//! Linearised model of a transient contact for display: its operating points, the choice of the other rule, and the
//! study of the number of points.

use crate::app::refusal::Refusal;
use crate::app::tabs::transient::Run;
use crate::app::tabs::transient::method::{RULES, WEIGHTINGS, rule_name};
use crate::app::wake::wake;
use crate::engine::job::{Background, Ending, Job, Reporter, Task};
use crate::engine::{Store, median};
use crate::scene::study::transient::{Timed, timed_march};
use crate::solver::full::transient::{Keep, Moment, Quantity, Trajectory, Transient};
use crate::solver::reduced::tpwl::{Selection, TpwlMarch, TpwlModel, Weight, Weighting};
use crate::solver::training::on_one_thread;
use egui::Context;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Linearised model with its data for display.
pub struct Linearised {
    pub model: Arc<TpwlModel>,
    /// Scalars of its training trajectories.
    pub trainings: Vec<Vec<Moment>>,
    /// True if it was trained by the run that it is compared with.
    pub own: bool,
    /// Points that the other rule chooses for the same number of points. `None` until it has been computed.
    pub other: Option<OtherRule>,
}

/// Rule with the time steps that it chooses from each training trajectory.
#[derive(Clone, Serialize, Deserialize)]
pub struct OtherRule {
    /// Rule.
    pub selection: Selection,
    /// Indices of time steps, by trajectory.
    pub chosen: Vec<Vec<usize>>,
}

/// Operating point at a time of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointNow {
    /// Index among all points of the model.
    pub point: usize,
    /// Weights in the order of [`WEIGHTINGS`]. 0 if that weighting was not run.
    pub weights: [f64; 2],
    /// ‖y − y_i‖/‖y‖ of the present state, by the first weighting that was run.
    pub distance: f64,
}

impl OtherRule {
    /// Returns the rule that a model was not made by.
    pub fn of(model: &TpwlModel) -> Self {
        let by_distance = matches!(model.training.selection, Selection::Distance { .. });
        let selection = model.selection_of(RULES[usize::from(by_distance)], model.points.len());
        Self { selection, chosen: model.selected(selection) }
    }
}

impl Linearised {
    /// Returns a quantity of a training trajectory at T.
    pub fn value(&self, trajectory: usize, quantity: Quantity, time: f64) -> Option<f64> {
        let moments = self.trainings.get(trajectory)?;
        // A state belongs to a time step.
        let at = moments.partition_point(|moment| moment.time < time - 1e-9 * time.abs());
        moments.get(at).map(|moment| moment.value(quantity))
    }

    /// Returns all operating points in their order, with their weights at T in the runs.
    pub fn points_at<'a>(&self, runs: &[(Weighting, &'a Run)], time: f64) -> Vec<PointNow> {
        let record =
            |(weighting, run): &(Weighting, &'a Run)| Some((*weighting, (run.record.as_ref()?, run.step_at(time)?)));
        let recorded: Vec<_> = runs.iter().filter_map(record).collect();
        let state = recorded.first().map_or(&[][..], |(_, (record, step))| record.state(*step));
        let norm = state.iter().map(|y| y * y).sum::<f64>().sqrt();
        let points = self.model.points.iter().enumerate();
        points
            .map(|(point, trained)| {
                let weight = |weighting: Weighting| -> f64 {
                    let of = recorded.iter().find(|(own, _)| *own == weighting);
                    let weights = of.map_or(&[][..], |(_, (record, step))| record.weights(*step));
                    weights.iter().filter(|w: &&Weight| w.point == point).map(|w| w.weight).sum()
                };
                let square: f64 = state.iter().zip(&trained.moment.state).map(|(a, b)| (a - b) * (a - b)).sum();
                PointNow { point, weights: WEIGHTINGS.map(weight), distance: square.sqrt() / norm }
            })
            .collect()
    }

    /// Returns the time of the runs that belongs to a point: its own T if the run trained the model, otherwise the
    /// time of its largest weight.
    pub fn moment_of(&self, point: usize, runs: &[(Weighting, &Run)]) -> Option<f64> {
        let trained = self.model.points.get(point)?;
        if self.own {
            return Some(trained.moment.time);
        }
        let record = runs.iter().find_map(|(_, run)| run.record.as_ref())?;
        let weight =
            |step: usize| -> f64 { record.weights(step).iter().filter(|w| w.point == point).map(|w| w.weight).sum() };
        let steps = record.steps().iter().enumerate().map(|(k, step)| (step.time, weight(k)));
        steps.filter(|(_, weight)| *weight > 0.0).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(time, _)| time)
    }
}

/// Result of a model with one number of points for the inputs of the run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NumberRow {
    /// Rule and tolerance.
    pub selection: Selection,
    /// Number of operating points that it chose.
    pub points: usize,
    pub weighting: Weighting,
    /// Relative L2 difference of H_c from the full run. `None` if the run ended early.
    pub difference: Option<f64>,
    /// Median time per step \[s\].
    pub step_s: f64,
}

/// Study of the number of operating points: both rules with a sequence of tolerances, both weightings, against the
/// full run.
#[derive(Default)]
pub struct NumberStudy {
    /// Results so far.
    pub rows: Vec<NumberRow>,
    pub work: Background<NumberRow>,
    of: Option<Arc<TpwlModel>>,
}

/// Study of the numbers of operating points for the inputs of a full run.
#[derive(Serialize, Deserialize)]
pub struct NumberTask {
    model: Arc<TpwlModel>,
    full: Trajectory,
}

impl Task for NumberTask {
    const KIND: &'static str = "operating points";
    const LANE: usize = 1;
    type Message = NumberRow;

    fn run(self, _store: &Store, reporter: &Reporter<NumberRow>) -> Ending {
        work(&self.model, &self.full, reporter)
    }
}

/// Computation of the rule that a model was not made by. It takes longer than a frame.
#[derive(Serialize, Deserialize)]
pub struct OtherRuleTask(pub Arc<TpwlModel>);

impl Task for OtherRuleTask {
    const KIND: &'static str = "other rule";
    const LANE: usize = 1;
    type Message = OtherRule;

    fn run(self, _store: &Store, reporter: &Reporter<OtherRule>) -> Ending {
        reporter.send(OtherRule::of(&self.0));
        Ok(())
    }
}

const STAGE: &str = "Number of operating points";
/// Maximum number of operating points in the study.
const MOST_POINTS: usize = 160;
/// Minimum number of operating points in the study.
const LEAST_POINTS: usize = 4;
/// First tolerances, in the order of [`RULES`].
const COARSEST: [f64; 2] = [0.5, 0.25];
/// Maximum number of tolerances, each half of the previous one.
const RUNGS: usize = 24;

impl NumberStudy {
    /// Starts the study for the inputs of a full run.
    pub fn start(&mut self, ctx: &Context, model: Arc<TpwlModel>, full: Trajectory) {
        self.rows.clear();
        self.of = Some(Arc::clone(&model));
        self.work.run(Job::of(STAGE, wake(ctx), &Store::default(), NumberTask { model, full }));
    }

    /// Returns true if it was started for a model.
    pub fn is_of(&self, model: &Arc<TpwlModel>) -> bool {
        self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, model))
    }

    /// Receives results.
    pub fn receive(&mut self) {
        self.work.receive(|row| self.rows.push(row));
    }
}

fn stage(rule: Selection) -> String {
    format!("{STAGE}, {}", rule_name(rule).0)
}

fn work(model: &Arc<TpwlModel>, full: &Trajectory, reporter: &Reporter<NumberRow>) -> Ending {
    let transient = Transient { keep: Keep::Scalars, ..full.transient.clone() };
    let moments: usize = model.trajectories.iter().map(Vec::len).sum();
    let most = MOST_POINTS.min(moments);
    for (rule, coarsest) in RULES.into_iter().zip(COARSEST) {
        let mut last = 0;
        for rung in 0..RUNGS {
            let selection = rule.with_tolerance(coarsest * 0.5f64.powi(rung as i32));
            reporter.stage(&stage(rule), last, most);
            let shared = Arc::clone(model);
            let Ok(made) = on_one_thread(reporter, move || shared.reselected(selection)) else { return Ok(()) };
            let made = made.map_err(|error| error.to_string())?;
            let points = made.points.len();
            if points >= LEAST_POINTS && points > last {
                for weighting in WEIGHTINGS {
                    let row = tried(&made, &transient, full, weighting, reporter);
                    if reporter.cancelled() {
                        return Ok(());
                    }
                    reporter.send(row.map_err(|why| why.to_string())?);
                }
            }
            last = last.max(points);
            if points >= most {
                break;
            }
        }
    }
    Ok(())
}

/// Returns the result of one model with one weighting.
fn tried(
    model: &TpwlModel,
    transient: &Transient,
    full: &Trajectory,
    weighting: Weighting,
    reporter: &Reporter<NumberRow>,
) -> Result<NumberRow, Refusal> {
    let mut marching = TpwlMarch::new(model, transient, weighting)?;
    let marched = timed_march(&mut marching, transient, stage(model.training.selection), reporter, None);
    let Timed { trajectory, seconds } = marched?;
    let difference = trajectory.difference(full, Quantity::CentralFilm, (0.0, transient.duration));
    Ok(NumberRow {
        selection: model.training.selection,
        points: model.points.len(),
        weighting,
        difference: difference.filter(|_| trajectory.finished()).map(|(_, l2)| l2),
        step_s: median(&seconds),
    })
}
