//! What a command that ran reports by its exit code.

/// How a command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Exit code 0.
    Done,
    /// Exit code 1: did not converge, or an expectation fell short.
    FellShort,
}
