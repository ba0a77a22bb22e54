//! Full solves for the picture. They run in one thread, the newest request first. They can be cancelled, and a
//! panic does not end the program.

use super::request::{FullSolve, JobKind, Outcome};
use crate::app::document::Key;
use crate::app::wake::wake;
use crate::engine::job::{Ending, Job, Queue, Reporter, Task};
use crate::engine::{Answer, Solver, Store, answer};
use crate::host::clock::Stopwatch;
use crate::scene::Method;
use crate::solver::full::{ContactSolver, Start};
use crate::solver::observer::{NewtonStep, Observer, WalkStep};
use crate::solver::physics::contact::ContactKind;
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// Messages of a running solve.
#[derive(Serialize, Deserialize)]
pub enum News {
    Step(NewtonStep),
    Krylov(usize),
    Walk(WalkStep),
    Solved(Box<Answer>),
}

/// Job as the status strip at the bottom shows it.
pub struct Running {
    /// Purpose of the solve.
    pub kind: JobKind,
    /// Parameters of the solve.
    pub key: Key,
    /// Newton steps so far.
    pub steps: Vec<NewtonStep>,
    /// Krylov iterations of the present Newton step. Zero if they are not counted.
    pub krylov: usize,
    /// Position of a continuation from an easier contact.
    pub walk: Option<WalkStep>,
    /// Time since the job was submitted.
    pub since: Stopwatch,
    solved: Option<Box<Answer>>,
    job: Job<News>,
}

impl Running {
    /// Receives the messages of the solve. Returns the outcome once the solve has ended.
    fn receive(&mut self) -> Option<Outcome> {
        let Self { job, steps, krylov, walk, solved, .. } = self;
        let ending = job.poll(|news| match news {
            News::Step(step) => {
                steps.push(step);
                *krylov = 0;
            }
            News::Krylov(count) => *krylov = count,
            News::Walk(step) => *walk = Some(step),
            News::Solved(answer) => *solved = Some(answer),
        })?;
        Some(match (ending, solved.take()) {
            (Ok(()), Some(answer)) => Outcome::Solved(answer),
            (Ok(()), None) => Outcome::Failed("the solve ended without a result".to_owned()),
            (Err(why), _) => Outcome::Failed(why.to_string()),
        })
    }
}

/// Full solves for the picture that wait or run.
pub struct Jobs {
    queue: Queue<FullSolve, News>,
    running: Vec<Running>,
}

/// Run time after which a newer request ends a live solve. The limit is longer for a point contact: if every slider
/// movement ended its solve, the picture would never change.
fn live_patience(kind: ContactKind) -> Duration {
    if kind.is_line() { Duration::from_millis(80) } else { Duration::from_millis(800) }
}

impl Jobs {
    /// Creates an empty queue that uses the grids and solvers of a store.
    pub fn new(store: &Store) -> Self {
        Self { queue: Queue::of_tasks("solver", JobKind::COUNT, store), running: Vec::new() }
    }

    /// Submits a solve. It replaces a solve of the same kind that has not started. Running solves of other
    /// parameters stop, except live solves.
    pub fn submit(&mut self, ctx: &egui::Context, request: FullSolve) {
        let (kind, key) = (request.kind, request.key);
        for running in &self.running {
            match running.kind {
                JobKind::Live if running.key != key => running.job.give_up_after(live_patience(running.key.point.kind)),
                JobKind::Live => {}
                other if running.key != key || other == kind => running.job.stop(),
                _ => {}
            }
        }
        let job = self.queue.submit(kind as usize, kind.name(), wake(ctx), request);
        self.running.retain(|running| running.kind != kind || running.job.begun());
        let since = job.since();
        self.running.push(Running { kind, key, steps: Vec::new(), krylov: 0, walk: None, since, solved: None, job });
    }

    /// Returns the jobs that have finished since the last call, with their outcomes.
    pub fn poll(&mut self) -> Vec<(Running, Outcome)> {
        let mut finished = Vec::new();
        let mut place = 0;
        while let Some(running) = self.running.get_mut(place) {
            match running.receive() {
                Some(outcome) => finished.push((self.running.remove(place), outcome)),
                None => place += 1,
            }
        }
        finished
    }

    /// Returns all jobs that wait or run.
    pub fn running(&self) -> &[Running] {
        &self.running
    }

    /// Returns true if a job of a kind waits or runs.
    pub fn busy(&self, kind: JobKind) -> bool {
        self.running.iter().any(|r| r.kind == kind)
    }

    /// Stops all jobs.
    pub fn cancel_all(&self) {
        for running in &self.running {
            running.job.stop();
        }
    }
}

impl Task for FullSolve {
    const KIND: &'static str = "full solve";
    const LANE: usize = 0;
    type Message = News;

    fn run(self, store: &Store, reporter: &Reporter<News>) -> Ending {
        let grid = self.grid.with(store).map_err(|refused| refused.to_string())?;
        let start = self.start.as_deref().map_or(Start::Cold, Start::From);
        let asked = self.key.request(self.grid.stated(), Method::Full);
        let solved = |solver: &mut ContactSolver| answer(&asked, Solver::Full(solver, start), &Steps(reporter));
        let answer = store.with_full_solver(&grid, solved).map_err(|refused| refused.to_string())?;
        reporter.send(News::Solved(Box::new(answer)));
        Ok(())
    }
}

/// Reports Newton steps and Krylov iterations.
struct Steps<'a>(&'a Reporter<News>);

impl Observer for Steps<'_> {
    fn newton_step(&self, step: &NewtonStep) {
        self.0.send(News::Step(*step));
    }

    fn walk_step(&self, step: &WalkStep) {
        self.0.send(News::Walk(*step));
    }

    fn krylov_iteration(&self, count: usize) {
        self.0.send(News::Krylov(count));
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::answers::jobs::GridChoice;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::Lubricant;

    #[test]
    fn a_job_comes_back_with_what_it_was_for() {
        let mut jobs = Jobs::new(&Store::default());
        let key = Key { point: OperatingPoint::TABLE_2_1, lubricant: Lubricant::default() };
        let grid = GridChoice::Spec(GridSpec::EXPLORER);
        jobs.submit(&egui::Context::default(), FullSolve { kind: JobKind::Verify, key, grid, start: None });
        let begin = Stopwatch::start();
        loop {
            if let Some((job, outcome)) = jobs.poll().pop() {
                assert_eq!(job.key, key);
                assert!(!job.steps.is_empty());
                assert!(matches!(outcome, Outcome::Solved(answer) if answer.result.converged));
                break;
            }
            assert!(begin.elapsed() < Duration::from_secs(300));
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(jobs.running().is_empty());
    }
}
