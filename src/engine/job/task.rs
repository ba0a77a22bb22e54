//! Tasks: work as a serialisable value, which another instance of the program can do on systems without threads.

use super::{Ending, Event, Job, JobError, Line, Reporter, Wake, Wish};
use crate::engine::Store;
use crate::host::clock::Stopwatch;
use crate::host::{remote, worker};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::sync::atomic::{AtomicU8, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Shortest interval between two checks for stop requests.
const ASK_EVERY: Duration = Duration::from_millis(25);

/// Work as a serialisable value.
pub trait Task: Serialize + DeserializeOwned + Send + 'static {
    /// Name of the kind of task.
    const KIND: &'static str;
    /// Tasks of one lane run one after the other, those of different lanes in parallel.
    const LANE: usize;
    /// Message, such as a row or an answer.
    type Message: Serialize + DeserializeOwned + Send + 'static;

    /// Does the work.
    ///
    /// # Errors
    /// If there is no result.
    fn run(self, store: &Store, reporter: &Reporter<Self::Message>) -> Ending;
}

impl<M: Serialize + DeserializeOwned + Send + 'static> Job<M> {
    /// Starts a task on a thread, or in another instance of the program.
    pub fn of<T: Task<Message = M>>(name: &str, wake: Wake, store: &Store, task: T) -> Self {
        if worker::THREADS {
            let store = store.clone();
            return Self::start(name, wake, move |reporter| task.run(&store, reporter));
        }
        let (job, reporter) = Self::waiting(name, wake);
        reporter.post(store, task, || ());
        job
    }
}

impl<M: Serialize + DeserializeOwned + Send + 'static> Reporter<M> {
    /// Sends a task to another instance and forwards its events. `ended` is called at its end. If there is no other
    /// instance, the task is done here, and `false` is returned.
    pub(super) fn post<T: Task<Message = M>>(self, store: &Store, task: T, mut ended: impl FnMut() + 'static) -> bool {
        let content = match encoded(&task) {
            Ok(content) => content,
            Err(why) => {
                self.end(Err(why));
                return false;
            }
        };
        let own = Arc::new(self);
        let reporter = Arc::clone(&own);
        let receive = move |event: Option<Vec<u8>>| {
            reporter.begin();
            let event = event.map_or(Ok(Event::Ended(Err(JobError::Lost))), |event| decoded(&event));
            match event.unwrap_or_else(|why| Event::Ended(Err(why))) {
                Event::Ended(ending) => {
                    reporter.end(ending);
                    ended();
                    false
                }
                event => {
                    reporter.tell(event);
                    true
                }
            }
        };
        match remote::post(T::LANE, T::KIND, &content, receive) {
            Some(posted) => {
                // Each task is posted only once.
                let _ = own.wish.posted.set(posted);
                let stops = own.wish.stops();
                if stops > 0 {
                    own.wish.pass_on(stops);
                }
                true
            }
            None => {
                own.run(|reporter| task.run(store, reporter));
                false
            }
        }
    }
}

/// Encodes a value for another instance. As a trait object it shares its code with that of other formats.
fn encoded(value: &dyn erased_serde::Serialize) -> Result<Vec<u8>, JobError> {
    rmp_serde::to_vec_named(value).map_err(JobError::failed)
}

fn decoded<T: DeserializeOwned>(bytes: &[u8]) -> Result<T, JobError> {
    rmp_serde::from_slice(bytes).map_err(JobError::failed)
}

/// Link from a task to its owner in another instance.
pub(super) struct Owner {
    ask: Box<dyn Fn() -> u8 + Send + Sync>,
    stops: AtomicU8,
    asked: Mutex<Stopwatch>,
}

impl Owner {
    fn new(ask: impl Fn() -> u8 + Send + Sync + 'static) -> Self {
        Self { ask: Box::new(ask), stops: AtomicU8::new(0), asked: Mutex::new(Stopwatch::start()) }
    }

    /// Returns the number of stop requests.
    pub(super) fn stops(&self) -> u8 {
        let mut asked = self.asked.lock().unwrap_or_else(PoisonError::into_inner);
        if asked.elapsed() > ASK_EVERY {
            *asked = Stopwatch::start();
            self.stops.store((self.ask)(), Ordering::Relaxed);
        }
        self.stops.load(Ordering::Relaxed)
    }
}

/// Functions that link a task to its owner in another instance.
pub struct Performer {
    /// Sends an event.
    pub send: Box<dyn Fn(Vec<u8>) + Send + Sync>,
    /// Returns the number of stop requests.
    pub stops: Box<dyn Fn() -> u8 + Send + Sync>,
}

/// Does a task of another instance.
pub fn perform<T: Task>(task: &[u8], store: &Store, performer: Performer) {
    let Performer { send, stops } = performer;
    let line = Line::Away(Box::new(move |event| {
        let ended = |why| encoded(&Event::<()>::Ended(Err(why)));
        match encoded(&event).or_else(ended) {
            Ok(bytes) => send(bytes),
            Err(_) => return false,
        }
        true
    }));
    let wish = Wish { owner: Some(Owner::new(stops)), ..Wish::default() };
    let woken = Mutex::new(Stopwatch::start());
    let reporter = Reporter { line, wish: Arc::new(wish), wake: Wake::default(), woken };
    match decoded::<T>(task) {
        Ok(task) => reporter.run(|reporter| task.run(store, reporter)),
        Err(why) => reporter.end(Err(why)),
    }
}
