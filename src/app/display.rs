//! How the window shows things: kept with the session, not part of the document.

use super::answers::picture::Cuts;
use super::numbers;
use super::units::Units;
use crate::app::refusal::Refusal;
use serde::{Deserialize, Serialize};

/// Relative errors of a film from which on the badge uses another word.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Thresholds {
    /// Films that are off by less are verified.
    pub verified: f64,
    /// Those that are off by more are far off.
    pub far_off: f64,
}

impl Thresholds {
    /// Smallest and largest error that a threshold can be.
    pub const RANGE: (f64, f64) = (1e-6, 0.5);

    /// Whether both make sense, and in this order.
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

/// How things are shown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Display {
    /// Where a point contact is cut.
    pub cuts: Cuts,
    /// Theme wanted.
    pub theme: egui::ThemePreference,
    /// Size of everything.
    pub zoom: f32,
    /// From where on the badge uses another word.
    pub thresholds: Thresholds,
    /// Whether tabs say why, for teaching.
    pub why: bool,
    /// Whether a presentation is light whatever the theme: a projector shows no black.
    pub light_presentation: bool,
    /// The units of plots and exports.
    pub units: Units,
}

impl Display {
    /// Smallest and largest size of everything.
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
