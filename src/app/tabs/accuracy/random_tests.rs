//! Random tests (3.17) of the reduced model over what it was trained for: the work on its own thread, and what came of
//! it.

use crate::app::answers::jobs::wake;
use crate::app::in_use::{InUse, Solvers};
use crate::engine::Store;
use crate::engine::job::{Background, Ending, Job, Reporter};
use crate::scene::{Scene, Study};
use crate::solver::full::Start;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::ReducedModel;
use crate::solver::training::{Range, random_points};
use egui::Context;
use std::time::{Duration, Instant};

/// Fewest and most tests that can be asked for.
pub const TESTS: std::ops::RangeInclusive<usize> = 200..=10_000;
/// Most comparisons with full solutions.
pub const MOST_COMPARED: usize = 2_000;
/// How often finished tests are handed over.
const BATCH: Duration = Duration::from_millis(40);

/// What is tested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Reduced solves.
    pub tests: usize,
    /// Full solves to compare with, at the first of the points.
    pub compared: usize,
    /// Seed of the points.
    pub seed: u64,
}

impl Default for Plan {
    fn default() -> Self {
        Self { tests: 1000, compared: 200, seed: 1 }
    }
}

/// Relative errors of a reduced solution against the full one on its own grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// |ΔH_c|/H_c.
    pub h_c: f64,
    /// |ΔH_min|/H_min.
    pub h_min: f64,
}

/// What the full solver says of a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Truth {
    /// The errors.
    Known(Errors),
    /// The full solve did not converge.
    NoFullSolution,
}

/// A reduced solution that converged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solved {
    /// Its H_c.
    pub h_c: f64,
    /// Its H_min.
    pub h_min: f64,
    /// The calibrated bound on the relative error of H_c.
    pub bound: Option<f64>,
    /// Newton steps.
    pub iterations: usize,
}

/// One test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Test {
    /// Where.
    pub point: OperatingPoint,
    /// The reduced solution; `None` where Newton failed.
    pub solved: Option<Solved>,
    /// The comparison, where one was made.
    pub truth: Option<Truth>,
}

impl Test {
    /// The true error of H_c, where it is known.
    pub fn true_error(&self) -> Option<f64> {
        match self.truth {
            Some(Truth::Known(errors)) => Some(errors.h_c),
            _ => None,
        }
    }

    /// The calibrated bound on the error of H_c.
    pub fn bound(&self) -> Option<f64> {
        self.solved.and_then(|s| s.bound)
    }
}

enum Message {
    Tested(Vec<Test>),
    Compared(usize, Truth),
}

/// Tests that were made, and of what.
pub struct Results {
    /// The model that was tested.
    pub in_use: InUse,
    /// How it was tested.
    pub plan: Plan,
    /// The tests so far.
    pub tests: Vec<Test>,
    /// Rises with everything that comes in.
    pub revision: usize,
}

impl Results {
    /// Tests in which the reduced model did not converge.
    pub fn failures(&self) -> usize {
        self.tests.iter().filter(|t| t.solved.is_none()).count()
    }

    /// Bound and true error of H_c, where both are known.
    pub fn pairs(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.tests.iter().filter_map(|t| Some((t.bound()?, t.true_error()?)))
    }
}

/// The tests of the tab: those that run and those that ended.
#[derive(Default)]
pub struct RandomTests {
    /// What the next run tests.
    pub plan: Plan,
    /// The present or last run.
    pub results: Option<Results>,
    /// What runs, and why the last run ended early.
    work: Background<Message>,
}

impl RandomTests {
    /// Starts anew.
    pub fn start(&mut self, ctx: &Context, store: &Store, in_use: &InUse) {
        let plan = self.plan;
        self.results = Some(Results { in_use: in_use.clone(), plan, tests: Vec::new(), revision: 0 });
        let (store, in_use) = (store.clone(), in_use.clone());
        self.work.run(Job::start("Random tests", wake(ctx), move |reporter| work(&store, &in_use, plan, reporter)));
    }

    /// Takes in what came.
    pub fn receive(&mut self) {
        let Some(results) = &mut self.results else { return };
        self.work.receive(|message| {
            results.revision += 1;
            match message {
                Message::Tested(batch) => results.tests.extend(batch),
                Message::Compared(at, truth) => {
                    if let Some(test) = results.tests.get_mut(at) {
                        test.truth = Some(truth);
                    }
                }
            }
        });
    }

    /// Why the last run ended early.
    pub fn message(&self) -> Option<&str> {
        self.work.message.as_deref()
    }

    /// The run under way.
    pub fn task(&self) -> Option<&dyn super::Running> {
        self.work.job().map(|job| job as &dyn super::Running)
    }
}

/// What a model was trained for: the range of its training where it knows it, else the intervals it declares.
pub fn trained_range(model: &ReducedModel) -> Range {
    match Scene::from_ron(&model.scene).map(|scene| scene.study) {
        Ok(Study::Training(spec)) => spec.range,
        _ => {
            let d = &model.domain;
            Range::Moes {
                m: d.m,
                l: d.l,
                alpha: d.alpha_per_pa,
                max_hertz_pressure: d.max_hertz_pressure_pa,
                viscosity: d.viscosity_pa_s,
            }
        }
    }
}

/// All reduced solves, then the comparisons, one after the other on one thread: the other cores are the window's.
fn work(store: &Store, in_use: &InUse, plan: Plan, reporter: &Reporter<Message>) -> Ending {
    let lubricant = in_use.model.domain.lubricant;
    let range = trained_range(&in_use.model);
    let (contact, seed) = (in_use.model.contact(), plan.seed);
    let points = random_points(&range, contact, plan.tests, seed);
    if points.is_empty() {
        return Err("the model’s range holds no admissible contact to test".to_owned());
    }
    let mut solvers = Solvers::new(store, in_use);
    let mut films = Vec::with_capacity(points.len());
    let (mut batch, mut handed_over) = (Vec::new(), Instant::now());
    for (i, point) in points.iter().enumerate() {
        if reporter.cancelled() {
            break;
        }
        let solved = solvers.reduced(point, lubricant).ok().map(|(solution, scalars)| Solved {
            h_c: scalars.h_c,
            h_min: scalars.h_min,
            bound: solution.error.map(|e| e.h_c.bound),
            iterations: solution.iterations,
        });
        films.push(solved);
        batch.push(Test { point: *point, solved, truth: None });
        if handed_over.elapsed() > BATCH {
            handed_over = Instant::now();
            reporter.send(Message::Tested(std::mem::take(&mut batch)));
            reporter.stage("Random tests", i + 1, points.len());
        }
    }
    reporter.send(Message::Tested(batch));
    let compared = plan.compared.min(points.len());
    for (i, (point, solved)) in points.iter().zip(&films).take(compared).enumerate() {
        // Cold, so that no reduced solution can lead the full one to its root.
        let full = solvers.full(point, lubricant, Start::Cold, reporter);
        if reporter.cancelled() {
            break;
        }
        let truth = match (full.map_err(|error| error.to_string())?, solved) {
            (Some(full), Some(solved)) => Truth::Known(Errors {
                h_c: (solved.h_c / full.scalars.h_c - 1.0).abs(),
                h_min: (solved.h_min / full.scalars.h_min - 1.0).abs(),
            }),
            (None, _) => Truth::NoFullSolution,
            (Some(_), None) => continue,
        };
        reporter.send(Message::Compared(i, truth));
        reporter.stage("Full solutions to compare with", i + 1, compared);
    }
    Ok(())
}
