//! Distribution of values over an interval.

use serde::{Deserialize, Serialize};

/// Distribution of values over an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scale {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Log,
}
