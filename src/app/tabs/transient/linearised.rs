//! The linearised model of a contact in time as it is looked into: its operating points, what the other rule would choose, and the study of
//! how many points it takes.

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

/// A linearised model with what is shown of it.
pub struct Linearised {
    pub model: Arc<TpwlModel>,
    /// Scalars of its training trajectories.
    pub trainings: Vec<Vec<Moment>>,
    /// Whether it was trained by the run that it is compared with.
    pub own: bool,
    /// What the other rule chooses when it is to choose as many points, once that is known.
    pub other: Option<OtherRule>,
}

/// A rule, and the moments it chooses of each training trajectory.
#[derive(Clone, Serialize, Deserialize)]
pub struct OtherRule {
    /// The rule.
    pub selection: Selection,
    /// Indices of moments, by trajectory.
    pub chosen: Vec<Vec<usize>>,
}

/// An operating point at a moment of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointNow {
    /// Which, among all of the model.
    pub point: usize,
    /// Its weights by [`WEIGHTINGS`]; 0 where that weighting was not run.
    pub weights: [f64; 2],
    /// ‖y − y_i‖/‖y‖ of the state reached, by the first weighting that was run.
    pub distance: f64,
}

impl OtherRule {
    /// The rule that a model was not made by.
    pub fn of(model: &TpwlModel) -> Self {
        let by_distance = matches!(model.training.selection, Selection::Distance { .. });
        let selection = model.selection_of(RULES[usize::from(by_distance)], model.points.len());
        Self { selection, chosen: model.selected(selection) }
    }
}

impl Linearised {
    /// A quantity of a training trajectory at T.
    pub fn value(&self, trajectory: usize, quantity: Quantity, time: f64) -> Option<f64> {
        let moments = self.trainings.get(trajectory)?;
        // A state is that of a moment.
        let at = moments.partition_point(|moment| moment.time < time - 1e-9 * time.abs());
        moments.get(at).map(|moment| moment.value(quantity))
    }

    /// All operating points as the runs draw on them at T, in their order.
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

    /// The moment of the runs that a point stands for: its own T where the model was trained by the run, else when it weighed most.
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

/// A model of one number of points on the run's inputs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NumberRow {
    /// Rule and tolerance.
    pub selection: Selection,
    /// Operating points it chose.
    pub points: usize,
    pub weighting: Weighting,
    /// Relative L2 difference of H_c from the full run; none where the march ended early.
    pub difference: Option<f64>,
    /// Median of the seconds per step.
    pub step_s: f64,
}

/// How many operating points it takes: both rules on a ladder of tolerances, by both weightings, against the full run.
#[derive(Default)]
pub struct NumberStudy {
    /// What has come of it.
    pub rows: Vec<NumberRow>,
    pub work: Background<NumberRow>,
    of: Option<Arc<TpwlModel>>,
}

/// The study of the numbers of operating points on the inputs of a full run.
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

/// The rule that a model was not made by: what it would choose takes longer than a frame.
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
/// Most operating points that are tried.
const MOST_POINTS: usize = 160;
/// Fewest that are.
const LEAST_POINTS: usize = 4;
/// Tolerances of the first rung, by [`RULES`].
const COARSEST: [f64; 2] = [0.5, 0.25];
/// Rungs of the ladder at most, each half of the one before.
const RUNGS: usize = 24;

impl NumberStudy {
    /// Starts it anew on the inputs of a full run.
    pub fn start(&mut self, ctx: &Context, model: Arc<TpwlModel>, full: Trajectory) {
        self.rows.clear();
        self.of = Some(Arc::clone(&model));
        self.work.run(Job::of(STAGE, wake(ctx), &Store::default(), NumberTask { model, full }));
    }

    /// Whether it was begun for a model.
    pub fn is_of(&self, model: &Arc<TpwlModel>) -> bool {
        self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, model))
    }

    /// Takes in what came.
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

/// One model by one weighting.
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
