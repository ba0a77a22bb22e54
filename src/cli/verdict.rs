//! Exit status of a command that ran.

/// Exit status.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Exit code 0.
    Done,
    /// Exit code 1: did not converge, or an expectation was not met.
    FellShort,
}
