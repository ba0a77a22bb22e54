//! Jobs: work on a separate thread, with messages, progress, remaining time and an immediate stop. A panic in a job
//! does not affect the rest of the program.
//!
//! The owner holds a [`Job`]; the work reports through a [`Reporter`]. Dropping the job stops the work. A [`Queue`]
//! runs jobs on one thread and keeps only the newest request of each urgency. It is used for the live picture.

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

/// Shortest interval between two wake calls of one job.
const WAKE_EVERY: Duration = Duration::from_millis(50);

/// End of a job: complete or stopped, or an error.
pub type Ending = Result<(), JobError>;

/// Wakes the owner when a job has news. Called from the job's thread.
#[derive(Clone)]
pub struct Wake(Arc<dyn Fn() + Send + Sync>);

impl Wake {
    /// Returns a wake with this function.
    pub fn new(call: impl Fn() + Send + Sync + 'static) -> Self {
        Self(Arc::new(call))
    }
}

impl Default for Wake {
    /// Returns a wake without effect, for owners that poll.
    fn default() -> Self {
        Self::new(|| ())
    }
}

/// Progress of a job, for display.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Standing {
    /// Current stage.
    pub stage: String,
    /// Number of completed units.
    pub done: usize,
    /// Number of all units of the stage; 0 if unknown.
    pub total: usize,
    /// Estimated remaining time \[s\].
    pub left_s: Option<f64>,
    /// Time since the request \[s\].
    pub since_s: f64,
}

/// Report of a job to its owner. It is a plain value, so that a job may run in another thread or process.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Event<M> {
    /// Result, such as a row or an answer.
    Message(M),
    /// Progress.
    Stage(Progress),
    /// End of the job.
    Ended(Ending),
}

/// State shared between the owner and the work.
#[derive(Default)]
struct Wish {
    /// Number of stop requests.
    stops: AtomicU8,
    begun: OnceLock<Stopwatch>,
    /// Time limit that applies once a newer request is waiting.
    patience: OnceLock<Duration>,
    /// Handle of the work in another instance of the program.
    posted: OnceLock<remote::Posted>,
    /// Link to the owner, if this is the other instance.
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

    /// Forwards a stop request to another instance.
    fn pass_on(&self, times: u8) {
        if let Some(posted) = self.posted.get() {
            posted.stop(times);
        }
    }
}

/// Job, running or waiting.
pub struct Job<M> {
    events: Receiver<Event<M>>,
    wish: Arc<Wish>,
    since: Stopwatch,
    stage: Progress,
    stage_since: Stopwatch,
}

impl<M: Send + 'static> Job<M> {
    /// Starts `work` on a new thread. `name` is the name of the thread and of the first stage.
    pub fn start(name: &str, wake: Wake, work: impl FnOnce(&Reporter<M>) -> Ending + Send + 'static) -> Self {
        let (job, reporter) = Self::waiting(name, wake);
        if worker::THREADS {
            // If no thread can be started, the reporter is dropped and the next poll returns an error.
            let _handle = worker::spawn(name, move || reporter.run(work));
        } else {
            reporter.run(work);
        }
        job
    }

    /// Returns a job whose `work` starts when `when` calls the function it is given, on the calling thread.
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

    /// Returns a job that has not started, and its reporter.
    fn waiting(name: &str, wake: Wake) -> (Self, Reporter<M>) {
        let (sender, events) = channel();
        let (wish, since) = (Arc::new(Wish::default()), Stopwatch::start());
        let stage = Progress { stage: name.to_owned(), done: 0, total: 0 };
        let reporter = Reporter { line: Line::Here(sender), wish: Arc::clone(&wish), wake, woken: Mutex::new(since) };
        (Self { events, wish, since, stage, stage_since: since }, reporter)
    }

    /// Passes on the messages since the last call. Returns the ending once the job has ended.
    pub fn poll(&mut self, receive: impl FnMut(M)) -> Option<Ending> {
        self.poll_within(Duration::ZERO, receive)
    }

    /// As [`Job::poll`], but waits for the end up to a time limit.
    pub fn poll_within(&mut self, patience: Duration, mut receive: impl FnMut(M)) -> Option<Ending> {
        let begin = Stopwatch::start();
        if self.wish.posted.get().is_some() && self.wish.stops() == 0 && self.wish.stopped() {
            // No other code enforces the time limit in this case.
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

    /// Returns the progress.
    pub fn standing(&self) -> Standing {
        let Progress { stage, done, total } = self.stage.clone();
        let spent = self.stage_since.seconds();
        let left_s = (done > 0 && total >= done).then(|| spent * (total - done) as f64 / done as f64);
        Standing { stage, done, total, left_s, since_s: self.since.seconds() }
    }
}

impl<M> Job<M> {
    /// Requests a stop. Messages sent before are kept. A second request also cancels finishing work on partial results.
    pub fn stop(&self) {
        let _ = self.wish.stops.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |stops| stops.checked_add(1));
        self.wish.pass_on(self.wish.stops());
    }

    /// Returns true after a stop request.
    pub fn stopping(&self) -> bool {
        self.wish.stops.load(Ordering::Relaxed) > 0
    }

    /// Stops the work once it has run for this time, because a newer request is waiting.
    pub fn give_up_after(&self, patience: Duration) {
        // Only the first limit counts.
        let _ = self.wish.patience.set(patience);
    }

    /// Returns true if the work has started.
    pub fn begun(&self) -> bool {
        self.wish.begun.get().is_some()
    }

    /// Returns the time of the request.
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

/// Destination of events.
enum Line<M> {
    /// Job in this program.
    Here(Sender<Event<M>>),
    /// Job in another instance. The function returns true if the job still exists.
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

/// Connection from the work to its job. May be used from several threads.
pub struct Reporter<M> {
    line: Line<M>,
    wish: Arc<Wish>,
    wake: Wake,
    woken: Mutex<Stopwatch>,
}

impl<M: Send> Reporter<M> {
    /// Sends a message and wakes the owner.
    pub fn send(&self, message: M) {
        self.tell(Event::Message(message));
    }

    /// Reports the progress of a stage.
    pub fn stage(&self, stage: &str, done: usize, total: usize) {
        self.tell(Event::Stage(Progress { stage: stage.to_owned(), done, total }));
    }

    /// Returns true if the work should stop.
    pub fn cancelled(&self) -> bool {
        self.wish.stopped()
    }

    /// Returns an observer that cancels only after a second stop request or when the job has been dropped. It is for
    /// finishing work on partial results.
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
        // Only the first start counts.
        let _ = self.wish.begun.set(Stopwatch::start());
    }

    /// Runs the work and reports how it ended.
    fn run(&self, work: impl FnOnce(&Self) -> Ending) {
        self.begin();
        let ending = guarded(|| work(self)).unwrap_or_else(|panicked| Err(panicked.into()));
        self.end(ending);
    }

    fn end(&self, ending: Ending) {
        // The event is lost if the job was dropped.
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

/// Observer returned by [`Reporter::abandoned`].
pub struct Abandoned<'a>(&'a Wish);

impl Observer for Abandoned<'_> {
    fn cancelled(&self) -> bool {
        self.0.stops() > 1
    }
}

impl TrainingObserver for Abandoned<'_> {}

/// Slot for one job at a time, with the error of the last one.
pub struct Background<M> {
    /// Reason why there is no result or only part of it.
    pub message: Option<String>,
    job: Option<Job<M>>,
}

impl<M> Default for Background<M> {
    fn default() -> Self {
        Self { message: None, job: None }
    }
}

impl<M: Send + 'static> Background<M> {
    /// Starts a job in place of the previous one, which is stopped.
    pub fn run(&mut self, job: Job<M>) {
        self.message = None;
        self.job = Some(job);
    }

    /// As [`Background::run`], or stores the reason why there is no job.
    pub fn start(&mut self, job: Result<Job<M>, impl ToString>) {
        match job {
            Ok(job) => self.run(job),
            Err(why) => *self = Self { message: Some(why.to_string()), job: None },
        }
    }

    /// Passes on the messages since the last call.
    pub fn receive(&mut self, receive: impl FnMut(M)) {
        let Some(job) = &mut self.job else { return };
        if let Some(ending) = job.poll(receive) {
            if let Err(why) = ending {
                self.message = Some(why.to_string());
            }
            self.job = None;
        }
    }

    /// Returns the running job.
    pub fn job(&self) -> Option<&Job<M>> {
        self.job.as_ref()
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.job.as_ref().map(Job::standing)
    }
}

impl<M> Background<M> {
    /// Requests a stop. Messages sent before are kept.
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
    fn jobs_stop_when_cancelled_and_report_panics() {
        // Counts calls instead of time, so that the load of the machine does not matter.
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
    fn waiting_callers_are_woken_and_a_second_cancel_abandons() {
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
