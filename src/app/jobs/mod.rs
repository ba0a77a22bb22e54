//! Work that takes longer than a frame: one worker thread, newest request first, cancellable, and unable to take the window down.

mod request;
mod worker;

pub use request::{GridChoice, JobKind, Key, Outcome, Request};
pub use worker::guarded;

use crate::solver::observer::NewtonStep;
use crate::solver::physics::contact::ContactKind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use worker::{Event, Job, Shared, work};

/// A job as the strip at the bottom shows it.
pub struct Running {
    /// Its number.
    pub id: u64,
    /// What it was asked for.
    pub kind: JobKind,
    /// The parameters it is for.
    pub key: Key,
    /// Newton steps so far.
    pub steps: Vec<NewtonStep>,
    /// Krylov iterations of the present Newton step, where they are counted.
    pub krylov: usize,
    /// When it was handed over.
    pub since: Instant,
    cancel: Arc<AtomicBool>,
}

impl Running {
    /// Asks the job to stop.
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}

/// The worker and what it has to do.
pub struct Jobs {
    shared: Arc<Shared>,
    events: Receiver<Event>,
    running: Vec<Running>,
    next_id: u64,
}

impl Default for Jobs {
    fn default() -> Self {
        let shared = Arc::new(Shared::default());
        let (sender, events) = channel();
        let theirs = Arc::clone(&shared);
        // Where no thread can be had, jobs stay queued and the window says that they wait.
        let _handle = std::thread::Builder::new().name("solver".into()).spawn(move || work(&theirs, &sender));
        Self { shared, events, running: Vec::new(), next_id: 1 }
    }
}

impl Drop for Jobs {
    fn drop(&mut self) {
        self.cancel_all();
        self.shared.lock().closed = true;
        self.shared.wake.notify_all();
    }
}

/// A live solve that ran longer than this is given up for a newer one. A point contact's takes longer: were it given up at every
/// movement of the hand, the picture would stand still.
fn live_patience(kind: ContactKind) -> Duration {
    match kind {
        ContactKind::Line => Duration::from_millis(80),
        ContactKind::Point => Duration::from_millis(800),
    }
}

impl Jobs {
    /// Hands a solve over. It replaces one of the same kind that has not started; all but live solves of other parameters stop.
    pub fn submit(&mut self, ctx: &egui::Context, request: Request) {
        for job in &self.running {
            let obsolete = match job.kind {
                JobKind::Live => job.key != request.key && job.since.elapsed() > live_patience(job.key.point.kind),
                kind => job.key != request.key || request.kind == kind,
            };
            if obsolete {
                job.cancel();
            }
        }
        let (id, cancel) = (self.next_id, Arc::new(AtomicBool::new(false)));
        self.next_id += 1;
        let (kind, key) = (request.kind, request.key);
        let job = Job { id, request, cancel: Arc::clone(&cancel), ctx: ctx.clone() };
        let replaced = {
            let mut queue = self.shared.lock();
            queue.waiting.get_mut(kind as usize).and_then(|place| place.replace(job))
        };
        if let Some(old) = replaced {
            self.running.retain(|r| r.id != old.id);
        }
        self.running.push(Running { id, kind, key, steps: Vec::new(), krylov: 0, since: Instant::now(), cancel });
        self.shared.wake.notify_one();
    }

    /// What has finished since the last call, with what it was for.
    pub fn poll(&mut self) -> Vec<(Running, Outcome)> {
        let mut finished = Vec::new();
        while let Ok(event) = self.events.try_recv() {
            match event {
                Event::Step(id, step) => {
                    if let Some(job) = self.running.iter_mut().find(|r| r.id == id) {
                        job.steps.push(step);
                        job.krylov = 0;
                    }
                }
                Event::Krylov(id, count) => {
                    if let Some(job) = self.running.iter_mut().find(|r| r.id == id) {
                        job.krylov = count;
                    }
                }
                Event::Finished(id, outcome) => {
                    if let Some(at) = self.running.iter().position(|r| r.id == id) {
                        finished.push((self.running.remove(at), outcome));
                    }
                }
            }
        }
        finished
    }

    /// Everything that waits or runs.
    pub fn running(&self) -> &[Running] {
        &self.running
    }

    /// Whether a job of a kind waits or runs.
    pub fn busy(&self, kind: JobKind) -> bool {
        self.running.iter().any(|r| r.kind == kind)
    }

    /// Stops everything.
    pub fn cancel_all(&self) {
        for job in &self.running {
            job.cancel();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::{ContactGridSpec, GridSpec};
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::Lubricant;

    #[test]
    fn a_job_comes_back_with_what_it_was_for() {
        let mut jobs = Jobs::default();
        let key = Key { point: OperatingPoint::TABLE_2_1, lubricant: Lubricant::default() };
        let grid = GridChoice::Spec(ContactGridSpec::Line(GridSpec::EXPLORER));
        jobs.submit(&egui::Context::default(), Request { kind: JobKind::Verify, key, grid, start: None });
        let begin = Instant::now();
        loop {
            if let Some((job, outcome)) = jobs.poll().pop() {
                assert_eq!(job.key, key);
                assert!(!job.steps.is_empty());
                assert!(matches!(outcome, Outcome::Solved(solution, _) if solution.converged()));
                break;
            }
            assert!(begin.elapsed() < Duration::from_secs(20));
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(jobs.running().is_empty());
    }
}
