//! Work that takes longer than a frame: on a thread of its own, with messages, progress, time left, a stop that is
//! heard at once, and unable to take anything else down.
//!
//! A [`Job`] is what its owner holds, a [`Reporter`] what the work tells it by. Dropping the job stops the work. A
//! [`Queue`] gives jobs to one thread that keeps only the newest request of each urgency: the live picture.

mod error;
mod queue;
mod study;
mod task;

pub use error::{JobError, Panicked, guarded};
pub use queue::Queue;
pub use study::{Asked, Given, Replayed};
pub use task::{Performer, Task, perform};

use crate::host::clock::Stopwatch;
use crate::host::{remote, worker};
use crate::solver::observer::{Observer, Progress};
use crate::solver::training::TrainingObserver;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Shortest time between two calls of the owner on behalf of one job.
const WAKE_EVERY: Duration = Duration::from_millis(50);

/// How a job ended: with everything, stopped with what there is, or not at all.
pub type Ending = Result<(), JobError>;

/// Calls whoever waits for news of a job; called from the job's thread.
#[derive(Clone)]
pub struct Wake(Arc<dyn Fn() + Send + Sync>);

impl Wake {
    /// A call.
    pub fn new(call: impl Fn() + Send + Sync + 'static) -> Self {
        Self(Arc::new(call))
    }
}

impl Default for Wake {
    /// Calls nobody: the owner looks by itself.
    fn default() -> Self {
        Self::new(|| ())
    }
}

/// How far a job is, for people.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// What is being done.
    pub stage: String,
    /// Work done.
    pub done: usize,
    /// Work in all of this stage; 0 where that is not known.
    pub total: usize,
    /// Seconds that are left at the present pace.
    pub left_s: Option<f64>,
    /// Seconds since the job was asked for.
    pub since_s: f64,
}

/// What a job reports to its owner; a value, so that a job may run in another thread or process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Event<M> {
    /// A row, an answer or whatever else it finishes on its way.
    Message(M),
    /// How far it is.
    Stage(Progress),
    /// It ended, or failed with a sentence.
    Ended(Ending),
}

/// What the owner wants of the work, seen from its threads.
#[derive(Default)]
struct Wish {
    /// How often it was asked to stop.
    stops: AtomicU8,
    begun: OnceLock<Stopwatch>,
    /// How long it may work, once something newer waits.
    patience: OnceLock<Duration>,
    /// The work, where another instance of the program does it.
    posted: OnceLock<remote::Posted>,
    /// In that other instance: what its owner wants.
    owner: Option<task::Owner>,
}

impl Wish {
    fn stopped(&self) -> bool {
        let overdue = || Some(self.begun.get()?.elapsed() > *self.patience.get()?);
        self.stops() > 0 || overdue().unwrap_or(false)
    }

    fn stops(&self) -> u8 {
        self.owner.as_ref().map_or_else(|| self.stops.load(Ordering::Relaxed), task::Owner::stops)
    }

    /// Passes a wish on to another instance.
    fn pass_on(&self, times: u8) {
        if let Some(posted) = self.posted.get() {
            posted.stop(times);
        }
    }
}

/// Work under way, or waiting for its thread.
pub struct Job<M> {
    events: Receiver<Event<M>>,
    wish: Arc<Wish>,
    since: Stopwatch,
    stage: Progress,
    stage_since: Stopwatch,
}

impl<M: Send + 'static> Job<M> {
    /// Starts `work`; `name` is the thread's and the first stage's.
    pub fn start(name: &str, wake: Wake, work: impl FnOnce(&Reporter<M>) -> Ending + Send + 'static) -> Self {
        let (job, reporter) = Self::waiting(name, wake);
        if worker::THREADS {
            // Where no thread can be had, the reporter is gone and the next poll says so.
            let _handle = worker::spawn(name, move || reporter.run(work));
        } else {
            reporter.run(work);
        }
        job
    }

    /// A job whose `work` begins when `when` calls what it is given: on the thread that calls.
    pub fn once(
        name: &str,
        wake: Wake,
        when: impl FnOnce(Box<dyn FnOnce() + Send>),
        work: impl FnOnce(&Reporter<M>) -> Ending + Send + 'static,
    ) -> Self {
        let (job, reporter) = Self::waiting(name, wake);
        when(Box::new(move || reporter.run(work)));
        job
    }

    /// A job that has not begun, and what its work will tell it by.
    fn waiting(name: &str, wake: Wake) -> (Self, Reporter<M>) {
        let (sender, events) = channel();
        let (wish, since) = (Arc::new(Wish::default()), Stopwatch::start());
        let stage = Progress { stage: name.to_owned(), done: 0, total: 0 };
        let reporter = Reporter { line: Line::Here(sender), wish: Arc::clone(&wish), wake, woken: Mutex::new(since) };
        (Self { events, wish, since, stage, stage_since: since }, reporter)
    }

    /// Hands over what came since the last call; returns how the job ended once it has.
    pub fn poll(&mut self, receive: impl FnMut(M)) -> Option<Ending> {
        self.poll_within(Duration::ZERO, receive)
    }

    /// The same, waiting for the end for at most a while.
    pub fn poll_within(&mut self, patience: Duration, mut receive: impl FnMut(M)) -> Option<Ending> {
        let begin = Stopwatch::start();
        if self.wish.posted.get().is_some() && self.wish.stops() == 0 && self.wish.stopped() {
            // Nobody else watches how long it takes.
            self.stop();
        }
        loop {
            match worker::receive(&self.events, patience.saturating_sub(begin.elapsed())) {
                Ok(Event::Message(message)) => receive(message),
                Ok(Event::Stage(progress)) => {
                    if progress.stage != self.stage.stage {
                        self.stage_since = Stopwatch::start();
                    }
                    self.stage = progress;
                }
                Ok(Event::Ended(ending)) => return Some(ending),
                Err(RecvTimeoutError::Timeout) => return None,
                Err(RecvTimeoutError::Disconnected) => return Some(Err(JobError::NoThread)),
            }
        }
    }

    /// How far it is.
    pub fn standing(&self) -> Standing {
        let Progress { stage, done, total } = self.stage.clone();
        let spent = self.stage_since.seconds();
        let left_s = (done > 0 && total >= done).then(|| spent * (total - done) as f64 / done as f64);
        Standing { stage, done, total, left_s, since_s: self.since.seconds() }
    }
}

impl<M> Job<M> {
    /// Asks the work to stop; what it has sent stays. Asked again, it is not even to make something of what there is.
    pub fn stop(&self) {
        let _ = self.wish.stops.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |stops| stops.checked_add(1));
        self.wish.pass_on(self.wish.stops());
    }

    /// Whether it was asked to stop.
    pub fn stopping(&self) -> bool {
        self.wish.stops.load(Ordering::Relaxed) > 0
    }

    /// Stops the work once it has been at it for so long: something newer waits.
    pub fn give_up_after(&self, patience: Duration) {
        // The first wish counts.
        let _ = self.wish.patience.set(patience);
    }

    /// Whether its work has begun.
    pub fn begun(&self) -> bool {
        self.wish.begun.get().is_some()
    }

    /// When it was asked for.
    pub fn since(&self) -> Stopwatch {
        self.since
    }
}

impl<M> Drop for Job<M> {
    fn drop(&mut self) {
        self.wish.stops.store(u8::MAX, Ordering::Relaxed);
        self.wish.pass_on(u8::MAX);
    }
}

/// Where events go.
enum Line<M> {
    /// To a job of this program.
    Here(Sender<Event<M>>),
    /// To one of another instance; returns whether somebody listens.
    Away(Box<dyn Fn(Event<M>) -> bool + Send + Sync>),
}

impl<M> Line<M> {
    fn send(&self, event: Event<M>) -> bool {
        match self {
            Self::Here(events) => events.send(event).is_ok(),
            Self::Away(send) => send(event),
        }
    }
}

/// The work's line to its job; may be used from all of its threads.
pub struct Reporter<M> {
    line: Line<M>,
    wish: Arc<Wish>,
    wake: Wake,
    woken: Mutex<Stopwatch>,
}

impl<M: Send> Reporter<M> {
    /// Sends a message, and has it shown soon.
    pub fn send(&self, message: M) {
        self.tell(Event::Message(message));
    }

    /// Says how far a stage is.
    pub fn stage(&self, stage: &str, done: usize, total: usize) {
        self.tell(Event::Stage(Progress { stage: stage.to_owned(), done, total }));
    }

    /// Whether the work is to stop.
    pub fn cancelled(&self) -> bool {
        self.wish.stopped()
    }

    /// What stops only where nothing is to be made even of what there is: after a second wish, or when nobody waits any
    /// more.
    pub fn abandoned(&self) -> Abandoned<'_> {
        Abandoned(&self.wish)
    }

    fn tell(&self, event: Event<M>) {
        if self.line.send(event) {
            let mut woken = self.woken.lock().unwrap_or_else(PoisonError::into_inner);
            if woken.elapsed() > WAKE_EVERY {
                *woken = Stopwatch::start();
                (self.wake.0)();
            }
        }
    }

    fn begin(&self) {
        // The first time counts.
        let _ = self.wish.begun.set(Stopwatch::start());
    }

    /// Does the work and says how it ended.
    fn run(&self, work: impl FnOnce(&Self) -> Ending) {
        self.begin();
        let ending = guarded(|| work(self)).unwrap_or_else(|panicked| Err(panicked.into()));
        self.end(ending);
    }

    fn end(&self, ending: Ending) {
        // Nobody listens any more where the job was dropped.
        let _gone = self.line.send(Event::Ended(ending));
        (self.wake.0)();
    }
}

impl<M: Send> Observer for Reporter<M> {
    fn progress(&self, progress: Progress) {
        self.tell(Event::Stage(progress));
    }

    fn cancelled(&self) -> bool {
        self.wish.stopped()
    }
}

impl<M: Send> TrainingObserver for Reporter<M> {}

/// See [`Reporter::abandoned`].
pub struct Abandoned<'a>(&'a Wish);

impl Observer for Abandoned<'_> {
    fn cancelled(&self) -> bool {
        self.0.stops() > 1
    }
}

impl TrainingObserver for Abandoned<'_> {}

/// A job that can be started ever anew, and why the last one ended early.
pub struct Background<M> {
    /// Why there is nothing, or no more.
    pub message: Option<String>,
    job: Option<Job<M>>,
}

impl<M> Default for Background<M> {
    fn default() -> Self {
        Self { message: None, job: None }
    }
}

impl<M: Send + 'static> Background<M> {
    /// Lets a job run in the place of the former one, which stops.
    pub fn run(&mut self, job: Job<M>) {
        self.message = None;
        self.job = Some(job);
    }

    /// The same where there may be a sentence why there is no job.
    pub fn start(&mut self, job: Result<Job<M>, impl ToString>) {
        match job {
            Ok(job) => self.run(job),
            Err(why) => *self = Self { message: Some(why.to_string()), job: None },
        }
    }

    /// Hands over what came since the last call.
    pub fn receive(&mut self, receive: impl FnMut(M)) {
        let Some(job) = &mut self.job else { return };
        if let Some(ending) = job.poll(receive) {
            if let Err(why) = ending {
                self.message = Some(why.to_string());
            }
            self.job = None;
        }
    }

    /// What runs.
    pub fn job(&self) -> Option<&Job<M>> {
        self.job.as_ref()
    }

    /// How far it is.
    pub fn standing(&self) -> Option<Standing> {
        self.job.as_ref().map(Job::standing)
    }
}

impl<M> Background<M> {
    /// Asks it to stop; what it has sent stays.
    pub fn stop(&self) {
        if let Some(job) = &self.job {
            job.stop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::host::worker::pause;
    use std::sync::atomic::AtomicUsize;

    fn ended<M: Send + 'static>(job: &mut Job<M>, mut receive: impl FnMut(M)) -> Ending {
        let begin = Stopwatch::start();
        loop {
            if let Some(ending) = job.poll(&mut receive) {
                return ending;
            }
            assert!(begin.elapsed() < Duration::from_secs(300));
            pause(Duration::from_millis(2));
        }
    }

    fn endless(reporter: &Reporter<()>) -> Ending {
        while !reporter.cancelled() {
            pause(Duration::from_millis(1));
        }
        Ok(())
    }

    #[test]
    fn messages_arrive_in_order_and_the_standing_counts() {
        let mut job = Job::start("count", Wake::default(), |reporter| {
            for k in 0..5 {
                reporter.stage("counting", k + 1, 5);
                reporter.send(k);
            }
            Ok(())
        });
        let mut seen = Vec::new();
        ended(&mut job, |k: usize| seen.push(k)).unwrap();
        assert_eq!(seen, [0, 1, 2, 3, 4]);
        let standing = job.standing();
        assert_eq!((standing.stage.as_str(), standing.done, standing.total), ("counting", 5, 5));
    }

    #[test]
    fn a_job_stops_at_its_next_question_and_a_panic_becomes_a_sentence() {
        // Counted in questions, so that other work on the machine does not matter.
        let asked = Arc::new(AtomicUsize::new(0));
        let asking = Arc::clone(&asked);
        let mut job = Job::start("endless", Wake::default(), move |reporter: &Reporter<()>| {
            while !reporter.cancelled() {
                asking.fetch_add(1, Ordering::Relaxed);
                pause(Duration::from_millis(1));
            }
            Ok(())
        });
        while asked.load(Ordering::Relaxed) == 0 {
            pause(Duration::from_millis(1));
        }
        job.stop();
        let before = asked.load(Ordering::Relaxed);
        ended(&mut job, |()| ()).unwrap();
        let after = asked.load(Ordering::Relaxed);
        assert!(after <= before + 1, "{before} questions before the wish, {after} in all");
        let mut broken = Job::<()>::start("broken", Wake::default(), |_| panic!("index 7"));
        assert!(ended(&mut broken, |()| ()).unwrap_err().to_string().contains("index 7"));
    }

    #[test]
    fn whoever_waits_is_called_at_the_end_and_a_second_wish_abandons() {
        let (calls, called) = channel();
        let mut job = Job::start("called", Wake::new(move || calls.send(()).unwrap()), |reporter| {
            endless(reporter)?;
            while !reporter.abandoned().cancelled() {
                pause(Duration::from_millis(1));
            }
            Ok(())
        });
        job.stop();
        assert!(job.stopping() && job.poll(|()| ()).is_none());
        job.stop();
        called.recv_timeout(Duration::from_secs(300)).unwrap();
        assert!(matches!(job.poll(|()| ()), Some(Ok(()))));
    }
}
