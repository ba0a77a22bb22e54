//! Standard output and standard error without panics. If the reader closes standard output, the program ends without a
//! message.

use super::failure::Failure;
use crate::host::clock::Stopwatch;
use crate::scene::StudyObserver;
use crate::solver::observer::{Observer, Progress};
use crate::solver::training::TrainingObserver;
use serde::Serialize;
use std::io::{self, IsTerminal, Write};
use std::sync::Mutex;
use std::time::Duration;

/// Prints text unchanged.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    Ok(out.flush()?)
}

/// Prints one JSON object on one line.
pub fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let mut text = serde_json::to_string(value).map_err(io::Error::from)?;
    text.push('\n');
    print(&text)
}

/// Prints one sentence on standard error.
pub fn complain(sentence: &str) {
    let line: Vec<&str> = sentence.split_whitespace().collect();
    // If standard error is closed too, no message can be shown.
    let _ = writeln!(io::stderr(), "ehl-explorer: {}", line.join(" "));
}

/// Shows progress on standard error: on a terminal one changing line, otherwise, if requested, one line per stage.
pub struct ProgressLine {
    terminal: bool,
    stages: bool,
    /// Last stage shown, with the time.
    state: Mutex<(String, Option<Stopwatch>)>,
}

impl ProgressLine {
    /// Returns a progress display. With `stages`, it prints one line per stage if standard error is not a terminal.
    pub fn new(stages: bool) -> Self {
        Self { terminal: io::stderr().is_terminal(), stages, state: Mutex::default() }
    }

    /// Clears the line.
    pub fn finish(&self) {
        if self.terminal {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}

impl TrainingObserver for ProgressLine {}

impl StudyObserver for ProgressLine {}

impl Observer for ProgressLine {
    fn progress(&self, progress: Progress) {
        let Ok(mut state) = self.state.lock() else { return };
        let new_stage = state.0 != progress.stage;
        if !new_stage && state.1.is_some_and(|shown| shown.elapsed() < Duration::from_millis(100)) {
            return;
        }
        let Progress { stage, done, total } = progress;
        if self.terminal {
            let _ = write!(io::stderr(), "\r\x1b[K{stage}: {done} of {total}");
        } else if new_stage && self.stages {
            let _ = writeln!(io::stderr(), "{stage} ({total})");
        }
        *state = (stage, Some(Stopwatch::start()));
    }
}
