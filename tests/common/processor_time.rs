//! Processor time of a thread: the cost of its work, independent of other load on the machine.

use std::collections::HashMap;
use std::time::{Duration, Instant};

/// Returns the processor time of this thread, to about a millisecond; wall time if the system does not report it.
pub fn of_this_thread() -> Duration {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat");
    match told.ok().and_then(|text| text.split_whitespace().next()?.parse().ok()) {
        Some(nanoseconds) => Duration::from_nanos(nanoseconds),
        None => {
            thread_local!(static BEGIN: Instant = Instant::now());
            BEGIN.with(Instant::elapsed)
        }
    }
}

/// Runs work on one thread, so that this thread's processor time is that of all of it.
pub fn on_one_thread<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work)
}

/// Does work similar to drawing a frame: writes numbers, stores them by name, finds them and adds them up.
pub fn fixed_work() -> usize {
    let names: Vec<String> = (0..1000_u32).map(|k| format!("{:.4}", f64::from(k).sqrt())).collect();
    let kept: HashMap<&str, usize> = names.iter().enumerate().map(|(k, name)| (name.as_str(), k)).collect();
    names.iter().rev().filter_map(|name| kept.get(name.as_str())).sum()
}
