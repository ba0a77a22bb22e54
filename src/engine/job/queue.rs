//! Queue with one thread that keeps only the newest request of each urgency.

use super::{Ending, Job, Reporter, Task, Wake};
use crate::engine::Store;
use crate::host::worker;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// Thread that handles requests, the most urgent first. At most one request of each urgency waits: a newer one replaces
/// it.
pub struct Queue<R, M> {
    shared: Arc<Shared<R, M>>,
    /// Function that handles requests without a thread.
    answer: Option<Answer<R, M>>,
}

type Answer<R, M> = Box<dyn Fn(&Arc<Shared<R, M>>)>;

struct Shared<R, M> {
    mail: Mutex<Mail<R, M>>,
    bell: Condvar,
}

struct Mail<R, M> {
    /// Waiting requests by urgency.
    waiting: Vec<Option<(R, Reporter<M>)>>,
    /// True while another instance of the program handles a request.
    away: bool,
    closed: bool,
}

impl<R, M> Shared<R, M> {
    fn lock(&self) -> MutexGuard<'_, Mail<R, M>> {
        // Each change is a single assignment, so that a panic does not leave an invalid state.
        self.mail.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<R, M: Send> Shared<R, M> {
    /// Takes the next waiting request; `None` if there is none.
    fn waiting(mail: &mut Mail<R, M>) -> Option<(R, Reporter<M>)> {
        let (request, reporter) = mail.waiting.iter_mut().find_map(Option::take)?;
        // From here on, it is not replaced.
        reporter.begin();
        Some((request, reporter))
    }

    /// Waits for the next request; `None` if the queue was closed.
    fn next(&self) -> Option<(R, Reporter<M>)> {
        let mut mail = self.lock();
        loop {
            if mail.closed {
                return None;
            }
            if let Some(next) = Self::waiting(&mut mail) {
                return Some(next);
            }
            mail = self.bell.wait(mail).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

impl<M: Serialize + DeserializeOwned + Send + 'static, R: Task<Message = M>> Shared<R, M> {
    /// Sends the next request to another instance, if that is idle.
    fn send_next(shared: &Arc<Self>, store: &Store) {
        let mut mail = shared.lock();
        if mail.away || mail.closed {
            return;
        }
        let Some((request, reporter)) = Self::waiting(&mut mail) else { return };
        mail.away = true;
        drop(mail);
        let (theirs, own) = (Arc::clone(shared), store.clone());
        let ended = move || {
            theirs.lock().away = false;
            Self::send_next(&theirs, &own);
        };
        if !reporter.post(store, request, ended) {
            shared.lock().away = false;
        }
    }
}

impl<R: Send + 'static, M: Send + 'static> Queue<R, M> {
    /// Starts a thread for requests with this number of urgencies. On systems without threads, each request is handled
    /// in [`Queue::submit`].
    pub fn new(name: &str, urgencies: usize, work: impl Fn(R, &Reporter<M>) -> Ending + Send + 'static) -> Self {
        let shared = Self::shared(urgencies);
        if !worker::THREADS {
            let answer = move |shared: &Arc<Shared<R, M>>| {
                let next = Shared::waiting(&mut shared.lock());
                if let Some((request, reporter)) = next {
                    reporter.run(|reporter| work(request, reporter));
                }
            };
            return Self { shared, answer: Some(Box::new(answer)) };
        }
        let theirs = Arc::clone(&shared);
        let answer = move || {
            while let Some((request, reporter)) = theirs.next() {
                reporter.run(|reporter| work(request, reporter));
            }
        };
        // If no thread can be started, requests stay in the queue and the window shows that they are waiting.
        let _handle = worker::spawn(name, answer);
        Self { shared, answer: None }
    }

    fn shared(urgencies: usize) -> Arc<Shared<R, M>> {
        let mail = Mail { waiting: (0..urgencies).map(|_| None).collect(), away: false, closed: false };
        Arc::new(Shared { mail: Mutex::new(mail), bell: Condvar::new() })
    }

    /// Submits a request. Urgency 0 has the highest priority. A request that is replaced never starts ([`Job::begun`]).
    pub fn submit(&self, urgency: usize, name: &str, wake: Wake, request: R) -> Job<M> {
        let (job, reporter) = Job::waiting(name, wake);
        if let Some(place) = self.shared.lock().waiting.get_mut(urgency) {
            *place = Some((request, reporter));
        }
        match &self.answer {
            Some(answer) => answer(&self.shared),
            None => self.shared.bell.notify_one(),
        }
        job
    }
}

impl<M: Serialize + DeserializeOwned + Send + 'static, R: Task<Message = M>> Queue<R, M> {
    /// Starts a thread for tasks with this number of urgencies, or uses another instance of the program on systems
    /// without threads.
    pub fn of_tasks(name: &str, urgencies: usize, store: &Store) -> Self {
        let store = store.clone();
        if worker::THREADS {
            return Self::new(name, urgencies, move |task, reporter| task.run(&store, reporter));
        }
        let answer = move |shared: &Arc<Shared<R, M>>| Shared::send_next(shared, &store);
        Self { shared: Self::shared(urgencies), answer: Some(Box::new(answer)) }
    }
}

impl<R, M> Drop for Queue<R, M> {
    fn drop(&mut self) {
        self.shared.lock().closed = true;
        self.shared.bell.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::job::JobError;
    use crate::host::clock::Stopwatch;
    use crate::host::worker::pause;
    use std::sync::mpsc::channel;
    use std::time::Duration;

    #[test]
    fn new_requests_replace_waiting_ones_and_urgent_ones_come_first() {
        let (release, gate) = channel();
        let queue = Queue::new("test", 2, move |request: u32, reporter: &Reporter<u32>| {
            gate.recv().map_err(JobError::failed)?;
            reporter.send(request);
            if request == 9 { panic!("nine") } else { Ok(()) }
        });
        let submit = |urgency, request| queue.submit(urgency, "ask", Wake::default(), request);
        let first = submit(1, 1);
        // The thread has taken it once its slot is empty.
        while queue.shared.lock().waiting[1].is_some() {
            pause(Duration::from_millis(1));
        }
        let jobs = [first, submit(1, 2), submit(1, 3), submit(0, 9)];
        (0..3).for_each(|_| release.send(()).unwrap());
        let begun = Stopwatch::start();
        let mut answers = Vec::new();
        let mut endings: [Option<Ending>; 4] = Default::default();
        for (mut job, ending) in jobs.into_iter().zip(&mut endings) {
            while ending.is_none() && begun.elapsed() < Duration::from_secs(300) {
                *ending = job.poll(|answer| answers.push(answer));
            }
        }
        assert_eq!(answers, [1, 3, 9]);
        assert!(
            matches!(&endings, [Some(Ok(())), Some(Err(_)), Some(Ok(())), Some(Err(nine))] if nine.to_string().contains("nine"))
        );
    }

    #[test]
    fn a_job_is_given_up_after_its_patience() {
        let queue = Queue::new("patience", 1, |(), reporter: &Reporter<()>| {
            while !reporter.cancelled() {
                pause(Duration::from_millis(1));
            }
            Ok(())
        });
        let mut job = queue.submit(0, "ask", Wake::default(), ());
        job.give_up_after(Duration::from_millis(5));
        let begun = Stopwatch::start();
        while job.poll(|()| ()).is_none() {
            assert!(begun.elapsed() < Duration::from_secs(300));
        }
        assert!(!job.stopping());
    }
}
