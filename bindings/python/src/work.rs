//! Long computations: without Python's global lock, with progress, and stopped by Ctrl-C.

use ehl_explorer::engine::EngineError;
use ehl_explorer::engine::job::guarded;
use ehl_explorer::scene::{Refusal, StudyObserver, Words};
use ehl_explorer::solver::observer::{Observer, Progress};
use ehl_explorer::solver::training::TrainingObserver;
use ehl_explorer::solver::warning::Warning;
use pyo3::exceptions::{PyKeyboardInterrupt, PyValueError};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

pyo3::create_exception!(ehl_explorer, EhlError, PyValueError, "A refused request, with the reason in one sentence.");
pyo3::create_exception!(
    ehl_explorer,
    MarchStopped,
    EhlError,
    "A march that did not reach its end. ``reached`` is the structured array of the march so far. ``warning`` describes \
     how it ended: ``kind``, ``ended``, ``reached``, ``text``."
);

/// Interval of signal checks and progress reports.
const LOOK_EVERY: Duration = Duration::from_millis(50);

/// Returns the error for a refused contact, with fields named as Python keywords.
pub fn stated(refusal: Refusal) -> EngineError {
    EngineError::Study(refusal.in_words(Words::Keywords))
}

/// Returns the exception with this message.
pub fn refused(sentence: impl ToString) -> PyErr {
    EhlError::new_err(sentence.to_string())
}

/// Returns the exception of a march that stopped, with the rows computed so far.
pub fn march_stopped(py: Python<'_>, warning: &Warning, reached: Bound<'_, PyAny>) -> PyErr {
    let stopped = MarchStopped::new_err(warning.to_string());
    let told = || {
        let ended = py.import("json")?.call_method1("loads", (warning.to_json().to_string(),))?;
        stopped.value(py).setattr("reached", reached)?;
        stopped.value(py).setattr("warning", ended)
    };
    match told() {
        Ok(()) => stopped,
        Err(error) => error,
    }
}

/// Shows messages as Python warnings.
pub fn warn(py: Python<'_>, sentences: impl IntoIterator<Item = String>) -> PyResult<()> {
    let warn = py.import("warnings")?.getattr("warn")?;
    sentences.into_iter().try_for_each(|sentence| warn.call1((sentence,)).map(drop))
}

/// State shared between a computation and its caller.
#[derive(Default)]
pub struct Watch {
    stop: AtomicBool,
    latest: Mutex<Option<Progress>>,
}

impl Watch {
    fn news(&self) -> Option<Progress> {
        self.latest.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl Observer for Watch {
    fn progress(&self, progress: Progress) {
        *self.latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(progress);
    }

    fn cancelled(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

impl TrainingObserver for Watch {}

impl StudyObserver for Watch {}

/// Runs work on a separate thread, and meanwhile calls `progress(stage, done, total)` and checks signals. An exception
/// of either stops the work and is passed on.
pub fn long<T: Send>(
    py: Python<'_>,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&Watch) -> Result<T, EngineError> + Send,
) -> PyResult<T> {
    let watch = Watch::default();
    let (sender, receiver) = channel();
    // A receiver alone cannot be shared while the lock is released.
    let receiver = Mutex::new(receiver);
    let (result, raised) = std::thread::scope(|scope| {
        let watch = &watch;
        scope.spawn(move || {
            // Only this function receives, and it waits for the result in any case.
            let _ = sender.send(guarded(|| work(watch)));
        });
        let mut raised = None;
        loop {
            let heard = py.detach(|| receiver.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(LOOK_EVERY));
            match heard {
                Ok(result) => return (Some(result), raised),
                Err(RecvTimeoutError::Disconnected) => return (None, raised),
                Err(RecvTimeoutError::Timeout) => {}
            }
            if raised.is_none() {
                raised = py.check_signals().and_then(|()| tell(progress, watch.news())).err();
                watch.stop.store(raised.is_some(), Ordering::Relaxed);
            }
        }
    });
    if let Some(raised) = raised {
        return Err(raised);
    }
    tell(progress, watch.news())?;
    match result {
        Some(Ok(Ok(value))) => Ok(value),
        Some(Ok(Err(error))) if error.cancelled() => {
            Err(PyKeyboardInterrupt::new_err("the run was stopped before it was done"))
        }
        Some(Ok(Err(error))) => Err(refused(error)),
        Some(Err(broken)) => Err(refused(broken)),
        None => Err(refused("the computation ended without a result")),
    }
}

fn tell(progress: Option<&Bound<'_, PyAny>>, news: Option<Progress>) -> PyResult<()> {
    if let (Some(progress), Some(Progress { stage, done, total })) = (progress, news) {
        progress.call1((stage, done, total))?;
    }
    Ok(())
}
