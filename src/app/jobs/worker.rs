//! The thread that solves: one job after the other, the most urgent first, and a panic becomes a sentence.

use super::request::{Outcome, Request};
use crate::app::solvers::Solvers;
use crate::solver::full::Start;
use crate::solver::observer::{NewtonStep, Observer};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// A solve that waits or is at work.
pub(super) struct Job {
    pub id: u64,
    pub request: Request,
    pub cancel: Arc<AtomicBool>,
    pub ctx: egui::Context,
}

/// News of a job.
pub(super) enum Event {
    Step(u64, NewtonStep),
    Krylov(u64, usize),
    Finished(u64, Outcome),
}

/// What waits, one job of each kind at most, the most urgent first.
#[derive(Default)]
pub(super) struct Queue {
    pub waiting: [Option<Job>; 4],
    pub closed: bool,
}

/// The queue between the window and the worker.
#[derive(Default)]
pub(super) struct Shared {
    queue: Mutex<Queue>,
    pub wake: Condvar,
}

impl Shared {
    pub fn lock(&self) -> MutexGuard<'_, Queue> {
        // A poisoned queue still holds whole jobs: every change to it is one assignment.
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The worker's loop: the live picture goes before all else.
pub(super) fn work(shared: &Shared, events: &Sender<Event>) {
    let mut solvers = Solvers::default();
    loop {
        let job = {
            let mut queue = shared.lock();
            loop {
                if queue.closed {
                    return;
                }
                if let Some(job) = queue.waiting.iter_mut().find_map(Option::take) {
                    break job;
                }
                queue = shared.wake.wait(queue).unwrap_or_else(PoisonError::into_inner);
            }
        };
        let outcome = match guarded(|| solve(&mut solvers, &job, events)) {
            Ok(outcome) => outcome,
            Err(message) => {
                // A solver that panicked may hold half a state.
                solvers = Solvers::default();
                Outcome::Failed(message)
            }
        };
        if events.send(Event::Finished(job.id, outcome)).is_err() {
            return;
        }
        job.ctx.request_repaint();
    }
}

/// Runs something that may panic and turns the panic into a sentence.
pub fn guarded<T>(run: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(run)).map_err(|payload| {
        format!(
            "the solver stopped unexpectedly ({}); the window and your work are not affected",
            panic_text(&*payload)
        )
    })
}

fn panic_text(payload: &(dyn Any + Send)) -> String {
    payload
        .downcast_ref::<&str>()
        .map(|s| (*s).to_owned())
        .or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no reason given".to_owned())
}

fn solve(solvers: &mut Solvers, job: &Job, events: &Sender<Event>) -> Outcome {
    let request = &job.request;
    let observer = Reporter { job, events, last_repaint: Mutex::new(Instant::now()) };
    let prepared = match solvers.of(&request.grid) {
        Ok(solver) => solver,
        Err(error) => return Outcome::Failed(error.to_string()),
    };
    let start = request.start.as_deref().map_or(Start::Cold, Start::From);
    let begin = Instant::now();
    match prepared.solve(&request.key.point, request.key.lubricant, start, &observer) {
        Ok(solution) => Outcome::Solved(Box::new(solution), begin.elapsed().as_secs_f64()),
        Err(error) => Outcome::Failed(error.to_string()),
    }
}

/// Passes Newton steps and Krylov iterations on, repainting at most every 50 ms.
struct Reporter<'a> {
    job: &'a Job,
    events: &'a Sender<Event>,
    last_repaint: Mutex<Instant>,
}

impl Reporter<'_> {
    fn send(&self, event: Event) {
        let mut last = self.last_repaint.lock().unwrap_or_else(PoisonError::into_inner);
        if self.events.send(event).is_ok() && last.elapsed() > Duration::from_millis(50) {
            *last = Instant::now();
            self.job.ctx.request_repaint();
        }
    }
}

impl Observer for Reporter<'_> {
    fn newton_step(&self, step: &NewtonStep) {
        self.send(Event::Step(self.job.id, *step));
    }

    fn krylov_iteration(&self, count: usize) {
        self.send(Event::Krylov(self.job.id, count));
    }

    fn cancelled(&self) -> bool {
        self.job.cancel.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_sentence() {
        let message = guarded(|| -> i32 { panic!("index 7") }).unwrap_err();
        assert!(message.contains("index 7"), "{message}");
    }
}
