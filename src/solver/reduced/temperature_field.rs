//! Temperatures of a reduced solution.

use crate::solver::discrete::heat::Profile;
use crate::solver::full::heat::Rises;
use serde::{Deserialize, Serialize};

/// Temperatures of a reduced solution.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TemperatureField {
    /// θ = (T − T₀)/T₀ (temperature T, inlet temperature T₀) at the stations of the march, line by line, from body 1
    /// to body 2.
    pub theta: Vec<Profile>,
    /// Rises above T₀ at X = 0 (and Y = 0).
    pub central: Rises,
}

impl TemperatureField {
    /// Returns the highest temperature of the film \[K\] for the given inlet temperature \[K\].
    pub fn hottest_k(&self, inlet_k: f64) -> f64 {
        inlet_k * (1.0 + self.theta.iter().flatten().fold(0.0, |hottest: f64, theta| hottest.max(*theta)))
    }
}
