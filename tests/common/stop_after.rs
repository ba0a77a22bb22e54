//! Work that a computation still does after a stop request.

use super::processor_time::{of_this_thread, on_one_thread};
use ehl_explorer::scene::StudyObserver;
use ehl_explorer::solver::observer::{Observer, Progress};
use ehl_explorer::solver::training::TrainingObserver;
use std::sync::Mutex;
use std::thread::{self, ThreadId};
use std::time::Duration;

/// Permitted processor time after a stop request: one or two frames.
pub const PROMISE: Duration = Duration::from_millis(100);

/// Requests a stop some processor time after a stage has begun. Only one thread is observed: waiting for another one
/// takes no processor time and ends with the next check.
pub struct StopAfter {
    stage: &'static str,
    after: Duration,
    thread: ThreadId,
    begun: Mutex<Option<Duration>>,
}

impl StopAfter {
    fn new(stage: &'static str, after: Duration) -> Self {
        let begun = stage.is_empty().then(of_this_thread);
        Self { stage, after, thread: thread::current().id(), begun: Mutex::new(begun) }
    }

    fn here(&self) -> bool {
        thread::current().id() == self.thread
    }
}

impl Observer for StopAfter {
    fn progress(&self, progress: Progress) {
        let mut begun = self.begun.lock().unwrap();
        if self.here() && begun.is_none() && progress.stage.starts_with(self.stage) {
            *begun = Some(of_this_thread());
        }
    }

    fn cancelled(&self) -> bool {
        self.here() && self.begun.lock().unwrap().is_some_and(|begun| of_this_thread() >= begun + self.after)
    }
}

impl TrainingObserver for StopAfter {}

impl StudyObserver for StopAfter {}

/// Asserts that work on one thread ends within the permitted processor time after stop requests at several moments of a
/// stage (of any stage, if `stage` is empty). `work` returns whether it was cancelled.
pub fn assert_stops(name: &str, stage: &'static str, moments: &[u64], mut work: impl FnMut(&StopAfter) -> bool + Send) {
    for &after in moments {
        let wish = Duration::from_millis(after);
        let late = on_one_thread(|| {
            let observer = StopAfter::new(stage, wish);
            assert!(work(&observer), "{name}: it ended before it was cancelled, {after} ms after {stage:?}");
            let begun = observer.begun.into_inner().unwrap().unwrap();
            of_this_thread().saturating_sub(begun + wish)
        });
        println!("{name}, {after} ms after its stage began: {late:.1?} more");
        assert!(late < PROMISE, "{name}, {after} ms after its stage began: {late:?} more");
    }
}
