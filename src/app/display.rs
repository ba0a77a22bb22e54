//! Display settings of the window. They are stored with the session and are not part of the document.

use super::answers::picture::Cuts;
use super::numbers;
use super::units::Units;
use crate::app::panels::sliders::ChosenSliders;
use crate::app::refusal::Refusal;
use crate::solver::physics::engineering::UnitSystem;
use serde::{Deserialize, Serialize};

/// Relative errors of the film thickness at which the badge changes its title.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Thresholds {
    /// Errors up to this value are called verified.
    pub verified: f64,
    /// Errors above this value are called far off.
    pub far_off: f64,
}

impl Thresholds {
    /// Smallest and largest permitted threshold.
    pub const RANGE: (f64, f64) = (1e-6, 0.5);

    /// Checks that both thresholds are permitted and in order.
    ///
    /// # Errors
    /// A sentence.
    pub fn check(&self) -> Result<(), Refusal> {
        let (least, most) = Self::RANGE;
        let Self { verified, far_off } = *self;
        if least <= verified && verified < far_off && far_off <= most {
            return Ok(());
        }
        let percent = |share: f64| numbers::quantity(100.0 * share, "%");
        Err(Refusal::new(format!(
            "“Verified” up to {} and “Far off” from {}: the first must be smaller than the second, and both between {} \
             and {}",
            percent(verified),
            percent(far_off),
            percent(least),
            percent(most)
        )))
    }
}

impl Default for Thresholds {
    fn default() -> Self {
        Self { verified: 2e-3, far_off: 1e-2 }
    }
}

/// Display settings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Display {
    /// Position of the cuts through a point contact.
    pub cuts: Cuts,
    /// Chosen theme.
    pub theme: egui::ThemePreference,
    /// Zoom factor of the window.
    pub zoom: f32,
    /// Error limits of the badge.
    pub thresholds: Thresholds,
    /// True if tabs show explanations for teaching.
    pub why: bool,
    /// True if presentations use light colours in any theme, because a projector cannot show black.
    pub light_presentation: bool,
    /// Units of plots and exports.
    pub units: Units,
    /// System of units of panels, axes, tables and reports.
    pub system: UnitSystem,
    /// Sliders of presentations.
    pub sliders: ChosenSliders,
}

impl Display {
    /// Smallest and largest zoom factor.
    pub const ZOOMS: (f32, f32) = (0.6, 3.0);
}

impl Default for Display {
    fn default() -> Self {
        let (cuts, thresholds) = (Cuts::default(), Thresholds::default());
        Self {
            cuts,
            theme: egui::ThemePreference::System,
            zoom: 1.0,
            thresholds,
            why: false,
            light_presentation: true,
            units: Units::default(),
            system: UnitSystem::default(),
            sliders: ChosenSliders::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thresholds_are_in_order_and_within_their_range() {
        let both = |verified, far_off| Thresholds { verified, far_off };
        assert!(Thresholds::default().check().is_ok() && both(1e-6, 0.5).check().is_ok());
        for wrong in [both(0.01, 0.01), both(0.02, 0.01), both(0.0, 0.01), both(0.01, 0.6), both(f64::NAN, 0.1)] {
            assert!(wrong.check().unwrap_err().contains("smaller than the second"), "{wrong:?}");
        }
    }
}
