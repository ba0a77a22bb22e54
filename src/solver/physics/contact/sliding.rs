//! Sliding of a contact.

use serde::{Deserialize, Serialize};

/// Sliding conditions. They affect the film of a shear-thinning lubricant, and the traction of any lubricant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub struct Sliding {
    /// Slide-to-roll ratio SRR = (u₂ − u₁)/u_m, (3.25).
    pub slide_to_roll_ratio: f64,
    /// Newtonian plateau ratio NPR of (3.40); `None` for that of the lubricant.
    pub newtonian_plateau_ratio: Option<f64>,
}

impl Sliding {
    /// Pure rolling with the lubricant's plateau ratio.
    pub const NONE: Self = Self { slide_to_roll_ratio: 0.0, newtonian_plateau_ratio: None };

    /// Returns the contribution of SRR and NPR to the distance (3.20) between two contacts. Film thicknesses are even
    /// in SRR. They change by about 4 % up to SRR = 1 and by about 40 % from NPR 0.2 to 1; the weights reflect this.
    pub fn distance(self, other: Self) -> f64 {
        let plateau = |sliding: Self| sliding.newtonian_plateau_ratio.unwrap_or(1.0);
        let srr = self.slide_to_roll_ratio.abs() - other.slide_to_roll_ratio.abs();
        0.03 * srr.powi(2) + 0.3 * (plateau(self) - plateau(other)).powi(2)
    }

    /// Returns the sliding at 0 ≤ t ≤ 1 between this one and another one.
    pub fn towards(self, other: Self, t: f64) -> Self {
        let between = |from: f64, to: f64| from + (to - from) * t;
        let plateaus = self.newtonian_plateau_ratio.zip(other.newtonian_plateau_ratio);
        Self {
            slide_to_roll_ratio: between(self.slide_to_roll_ratio, other.slide_to_roll_ratio),
            newtonian_plateau_ratio: plateaus
                .map_or(other.newtonian_plateau_ratio, |(from, to)| Some(between(from, to))),
        }
    }
}
