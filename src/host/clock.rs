//! Monotonic time and today's date.

use std::time::Duration;
use time::{Date, OffsetDateTime};
use web_time::Instant;

/// Time of the last change of a file.
pub type FileTime = std::time::SystemTime;

/// Measures the time since it was started.
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch(Instant);

impl Stopwatch {
    /// Starts the measurement.
    pub fn start() -> Self {
        Self(Instant::now())
    }

    /// Returns the time since the start.
    pub fn elapsed(&self) -> Duration {
        self.0.elapsed()
    }

    /// Returns the time since the start \[s\].
    pub fn seconds(&self) -> f64 {
        self.elapsed().as_secs_f64()
    }
}

/// Returns today's date (UTC).
pub fn today() -> Date {
    OffsetDateTime::now_utc().date()
}
