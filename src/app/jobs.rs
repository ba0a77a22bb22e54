//! Work that takes longer than a frame: one worker thread, newest request first, cancellable, and unable to take the window down.

use super::solvers::Solvers;
use crate::solver::contact::{ContactKind, Moes, OperatingPoint};
use crate::solver::full::{Solution, Start};
use crate::solver::grid::{ContactGrid, ContactGridSpec, GridSpec, PointGridSpec};
use crate::solver::lubricant::{Lubricant, ShearLaw};
use crate::solver::observer::{NewtonStep, Observer};
use crate::solver::reduced::ReducedModel;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// What a result belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// The operating point.
    pub point: OperatingPoint,
    /// The laws.
    pub lubricant: Lubricant,
}

impl Key {
    /// Whether pressure and film are the same: a limiting stress cuts traction only, and a film that does not thin under shear does not feel
    /// the sliding.
    pub fn has_film_of(&self, other: &Self) -> bool {
        let film = |key: &Self| {
            let (mut point, law) = (key.point, key.lubricant.shear);
            let plateau = point.sliding.newtonian_plateau_ratio.unwrap_or(law.plateau());
            if law == ShearLaw::Newtonian || plateau == 1.0 {
                point.sliding.slide_to_roll_ratio = 0.0;
            }
            (point, key.lubricant.of_the_film())
        };
        film(self) == film(other)
    }
}

/// What a full solve is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JobKind {
    /// The live picture where no reduced model serves.
    Live,
    /// The same contact on the grid that was chosen, after a live picture on a quick one.
    Refine,
    /// The check of a picture.
    Verify,
    /// The same contact on a second grid, to estimate what the first one costs.
    Estimate,
}

impl JobKind {
    /// For people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Live => "Full solve for the picture",
            Self::Refine => "Full solve on the chosen grid",
            Self::Verify => "Verification by a full solve",
            Self::Estimate => "Full solve on a second grid",
        }
    }
}

/// The grid of a solve: one that exists, or one to build.
#[derive(Clone, Debug)]
pub enum GridChoice {
    /// A reduced model's own grid.
    Existing(ContactGrid),
    /// A specification.
    Spec(ContactGridSpec),
}

impl GridChoice {
    /// The grid of the window of a model that serves a contact; without a model the chosen one of a point contact, or the explorer's.
    pub fn of(model: Option<&ReducedModel>, plane: Option<PointGridSpec>, moes: Moes) -> Self {
        match (model.and_then(|model| model.windows.get(model.window_for(moes))), plane) {
            (Some(window), _) => Self::Existing(window.grid.clone()),
            (None, None) => Self::Spec(ContactGridSpec::Line(GridSpec::EXPLORER)),
            (None, Some(plane)) => Self::Spec(ContactGridSpec::Point(plane)),
        }
    }
}

/// A full solve that is wanted.
#[derive(Clone)]
pub struct Request {
    /// What for.
    pub kind: JobKind,
    /// What to solve.
    pub key: Key,
    /// On which grid.
    pub grid: GridChoice,
    /// A solution to start from.
    pub start: Option<Arc<Solution>>,
}

/// What comes back.
pub enum Outcome {
    /// A solution (it says itself whether it converged) and the seconds of the solve alone.
    Solved(Box<Solution>, f64),
    /// A sentence why there is none.
    Failed(String),
}

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

struct Job {
    id: u64,
    request: Request,
    cancel: Arc<AtomicBool>,
    ctx: egui::Context,
}

enum Event {
    Step(u64, NewtonStep),
    Krylov(u64, usize),
    Finished(u64, Outcome),
}

/// What waits, one job of each kind at most, the most urgent first.
#[derive(Default)]
struct Queue {
    waiting: [Option<Job>; 4],
    closed: bool,
}

#[derive(Default)]
struct Shared {
    queue: Mutex<Queue>,
    wake: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Queue> {
        // A poisoned queue still holds whole jobs: every change to it is one assignment.
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
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

/// The worker's loop: the live picture goes before all else.
fn work(shared: &Shared, events: &Sender<Event>) {
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
pub(super) fn guarded<T>(run: impl FnOnce() -> T) -> Result<T, String> {
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
    let mut observer = Reporter { job, events, last_repaint: Instant::now() };
    let prepared = match solvers.of(&request.grid) {
        Ok(solver) => solver,
        Err(error) => return Outcome::Failed(error.to_string()),
    };
    let start = request.start.as_deref().map_or(Start::Cold, Start::From);
    let begin = Instant::now();
    match prepared.solve(&request.key.point, request.key.lubricant, start, &mut observer) {
        Ok(solution) => Outcome::Solved(Box::new(solution), begin.elapsed().as_secs_f64()),
        Err(error) => Outcome::Failed(error.to_string()),
    }
}

/// Passes Newton steps and Krylov iterations on, repainting at most every 50 ms.
struct Reporter<'a> {
    job: &'a Job,
    events: &'a Sender<Event>,
    last_repaint: Instant,
}

impl Reporter<'_> {
    fn send(&mut self, event: Event) {
        if self.events.send(event).is_ok() && self.last_repaint.elapsed() > Duration::from_millis(50) {
            self.last_repaint = Instant::now();
            self.job.ctx.request_repaint();
        }
    }
}

impl Observer for Reporter<'_> {
    fn newton_step(&mut self, step: &NewtonStep) {
        self.send(Event::Step(self.job.id, *step));
    }

    fn krylov_iteration(&mut self, count: usize) {
        self.send(Event::Krylov(self.job.id, count));
    }

    fn cancelled(&self) -> bool {
        self.job.cancel.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::named_lubricant::SQUALANE_PIP;
    use crate::solver::lubricant::{LimitingStress, Sliding};

    #[test]
    fn a_panic_becomes_a_sentence() {
        let message = guarded(|| -> i32 { panic!("index 7") }).unwrap_err();
        assert!(message.contains("index 7"), "{message}");
    }

    #[test]
    fn sliding_changes_the_film_only_where_it_thins() {
        let slid = |lubricant, srr, npr| {
            let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr };
            Key { point: OperatingPoint { sliding, ..OperatingPoint::TABLE_2_1 }, lubricant }
        };
        let oil = Lubricant::default();
        assert!(slid(oil, 0.0, None).has_film_of(&slid(oil, 0.7, None)));
        assert!(!slid(SQUALANE_PIP, 0.0, None).has_film_of(&slid(SQUALANE_PIP, 0.7, None)));
        assert!(slid(SQUALANE_PIP, 0.0, Some(1.0)).has_film_of(&slid(SQUALANE_PIP, 0.7, Some(1.0))));
        let limited = Lubricant { limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.0 }), ..SQUALANE_PIP };
        assert!(slid(limited, 0.7, None).has_film_of(&slid(SQUALANE_PIP, 0.7, None)));
        assert!(!slid(oil, 0.0, None).has_film_of(&slid(SQUALANE_PIP, 0.0, None)));
    }

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
