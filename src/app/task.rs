//! Studies: long work on a thread of its own, beside the worker of full solves, so that the live picture keeps going meanwhile.
//!
//! A [`Task`] carries messages of whatever kind its owner wants, its progress, and how it ended. Dropping it stops the work.

use super::jobs::guarded;
use super::numbers;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between two repaints on behalf of one task.
const REPAINT_EVERY: Duration = Duration::from_millis(50);

/// How a task ended: with everything, stopped with what there is, or not at all for a reason given as a sentence.
pub type Ending = Result<(), String>;

/// How far a task is, for people.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// What is being done.
    pub stage: String,
    /// Work done.
    pub done: usize,
    /// Work in all of this stage; 0 where that is not known.
    pub total: usize,
    /// Seconds that are left at the present pace.
    pub left_s: Option<f64>,
    /// Seconds since the task began.
    pub since_s: f64,
}

impl Standing {
    /// How much is done and how long the rest takes.
    pub fn describe(&self) -> String {
        let amount = if self.total > 0 { format!("{} of {}", self.done, self.total) } else { String::new() };
        match self.left_s {
            Some(left) if self.total > 0 && left >= 1.0 => format!("{amount}, {} s left", left.round()),
            Some(_) if self.total > 0 => format!("{amount}, less than a second left"),
            _ => numbers::duration(self.since_s),
        }
    }
}

enum Event<M> {
    Message(M),
    Stage(String, usize, usize),
    Ended(Ending),
}

/// Work under way on its own thread.
pub struct Task<M> {
    events: Receiver<Event<M>>,
    cancel: Arc<AtomicBool>,
    begun: Instant,
    stage: (String, usize, usize, Instant),
}

impl<M: Send + 'static> Task<M> {
    /// Starts `work`; `name` is the thread's and the first stage's.
    pub fn start(ctx: &egui::Context, name: &str, work: impl FnOnce(&Reporter<M>) -> Ending + Send + 'static) -> Self {
        let (sender, events) = channel();
        let cancel = Arc::new(AtomicBool::new(false));
        let last = Mutex::new(Instant::now());
        let reporter = Reporter { events: sender, cancel: Arc::clone(&cancel), ctx: ctx.clone(), last };
        let run = move || {
            let ending = guarded(|| work(&reporter)).and_then(|ending| ending);
            // Nobody listens any more where the task was dropped.
            let _gone = reporter.events.send(Event::Ended(ending));
            reporter.ctx.request_repaint();
        };
        // Where no thread can be had, the sender is gone and the next poll says so.
        let _handle = std::thread::Builder::new().name(name.to_owned()).spawn(run);
        let begun = Instant::now();
        Self { events, cancel, begun, stage: (name.to_owned(), 0, 0, begun) }
    }

    /// Hands over what came since the last call; returns how the task ended once it has.
    pub fn poll(&mut self, mut receive: impl FnMut(M)) -> Option<Ending> {
        loop {
            match self.events.try_recv() {
                Ok(Event::Message(message)) => receive(message),
                Ok(Event::Stage(stage, done, total)) => {
                    let since = if stage == self.stage.0 { self.stage.3 } else { Instant::now() };
                    self.stage = (stage, done, total, since);
                }
                Ok(Event::Ended(ending)) => return Some(ending),
                Err(TryRecvError::Empty) => return None,
                Err(TryRecvError::Disconnected) => {
                    return Some(Err("no thread can be started for this work".to_owned()));
                }
            }
        }
    }

    /// How far it is.
    pub fn standing(&self) -> Standing {
        let (stage, done, total, since) = &self.stage;
        let spent = since.elapsed().as_secs_f64();
        let left_s = (*done > 0 && total >= done).then(|| spent * (total - done) as f64 / *done as f64);
        Standing {
            stage: stage.clone(),
            done: *done,
            total: *total,
            left_s,
            since_s: self.begun.elapsed().as_secs_f64(),
        }
    }
}

impl<M> Task<M> {
    /// Asks the work to stop; what it has sent stays.
    pub fn stop(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }
}

impl<M> Drop for Task<M> {
    fn drop(&mut self) {
        self.stop();
    }
}

/// A task that can be started ever anew, and why the last one ended early.
pub struct Background<M> {
    /// Why there is nothing, or no more.
    pub message: Option<String>,
    task: Option<Task<M>>,
}

impl<M> Default for Background<M> {
    fn default() -> Self {
        Self { message: None, task: None }
    }
}

impl<M: Send + 'static> Background<M> {
    /// Lets a task run in the place of the former one, which stops.
    pub fn run(&mut self, task: Task<M>) {
        self.message = None;
        self.task = Some(task);
    }

    /// Hands over what came since the last call.
    pub fn receive(&mut self, receive: impl FnMut(M)) {
        let Some(task) = &mut self.task else { return };
        if let Some(ending) = task.poll(receive) {
            if let Err(why) = ending {
                self.message = Some(why);
            }
            self.task = None;
        }
    }

    /// What runs.
    pub fn task(&self) -> Option<&Task<M>> {
        self.task.as_ref()
    }

    /// How far it is.
    pub fn standing(&self) -> Option<Standing> {
        self.task.as_ref().map(Task::standing)
    }
}

impl<M> Background<M> {
    /// Asks it to stop; what it has sent stays.
    pub fn stop(&self) {
        if let Some(task) = &self.task {
            task.stop();
        }
    }
}

/// The work's line to its task.
pub struct Reporter<M> {
    events: Sender<Event<M>>,
    cancel: Arc<AtomicBool>,
    ctx: egui::Context,
    last: Mutex<Instant>,
}

impl<M> Reporter<M> {
    /// Sends a message, and has it shown soon.
    pub fn send(&self, message: M) {
        if self.events.send(Event::Message(message)).is_ok() {
            self.show();
        }
    }

    /// Says how far a stage is.
    pub fn stage(&self, stage: &str, done: usize, total: usize) {
        if self.events.send(Event::Stage(stage.to_owned(), done, total)).is_ok() {
            self.show();
        }
    }

    /// Whether the work is to stop.
    pub fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// What stops a full solve along with the work.
    pub fn observer(&self) -> &AtomicBool {
        &self.cancel
    }

    fn show(&self) {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        if last.elapsed() > REPAINT_EVERY {
            *last = Instant::now();
            self.ctx.request_repaint();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ended<M: Send + 'static>(task: &mut Task<M>, mut receive: impl FnMut(M)) -> Ending {
        let begin = Instant::now();
        loop {
            if let Some(ending) = task.poll(&mut receive) {
                return ending;
            }
            assert!(begin.elapsed() < Duration::from_secs(20));
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    #[test]
    fn messages_arrive_in_order_and_the_standing_counts() {
        let mut task = Task::start(&egui::Context::default(), "count", |reporter| {
            for k in 0..5 {
                reporter.stage("counting", k + 1, 5);
                reporter.send(k);
            }
            Ok(())
        });
        let mut seen = Vec::new();
        assert_eq!(ended(&mut task, |k: usize| seen.push(k)), Ok(()));
        assert_eq!(seen, [0, 1, 2, 3, 4]);
        let standing = task.standing();
        assert_eq!((standing.stage.as_str(), standing.done, standing.total), ("counting", 5, 5));
    }

    #[test]
    fn a_task_stops_within_a_tenth_of_a_second_and_a_panic_becomes_a_sentence() {
        let mut endless = Task::<()>::start(&egui::Context::default(), "endless", |reporter| {
            while !reporter.cancelled() {
                std::thread::sleep(Duration::from_millis(1));
            }
            Ok(())
        });
        let begin = Instant::now();
        endless.stop();
        assert_eq!(ended(&mut endless, |()| ()), Ok(()));
        assert!(begin.elapsed() < Duration::from_millis(100));
        let mut broken = Task::<()>::start(&egui::Context::default(), "broken", |_| panic!("index 7"));
        assert!(ended(&mut broken, |()| ()).unwrap_err().contains("index 7"));
    }
}
