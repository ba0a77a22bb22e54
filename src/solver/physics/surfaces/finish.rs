//! Measures of the height of a rough surface, and usual roughness of finished surfaces.

use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_2_PI;

/// Measure of the height of a rough surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum HeightMeasure {
    /// Root mean square of the heights along a profile.
    #[default]
    Rq,
    /// Mean magnitude of the heights along a profile.
    Ra,
    /// Root mean square of the heights over an area.
    Sq,
    /// Mean magnitude of the heights over an area.
    Sa,
}

impl HeightMeasure {
    /// All measures.
    pub const ALL: [Self; 4] = [Self::Rq, Self::Ra, Self::Sq, Self::Sa];

    /// Returns the symbol.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rq => "Rq",
            Self::Ra => "Ra",
            Self::Sq => "Sq",
            Self::Sa => "Sa",
        }
    }

    /// Returns the definition.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Rq => "Root mean square of the heights along a profile",
            Self::Ra => "Mean height along a profile; Rq = 1.253 Ra for Gaussian heights",
            Self::Sq => "Root mean square of the heights over an area; equals Rq of an isotropic surface",
            Self::Sa => "Mean height over an area; Sq = 1.253 Sa for Gaussian heights",
        }
    }

    /// Returns its value for a surface of rms roughness 1 with Gaussian heights: √(2/π) for a mean magnitude.
    pub fn of_rms(self) -> f64 {
        match self {
            Self::Rq | Self::Sq => 1.0,
            Self::Ra | Self::Sa => FRAC_2_PI.sqrt(),
        }
    }
}

/// Finish of a surface with its usual roughness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Finish {
    /// Name.
    pub name: &'static str,
    /// Usual range of Ra \[m\].
    pub mean_height_m: (f64, f64),
    /// Source of the range, and to what it applies.
    pub source: &'static str,
}

/// Source of the ranges of processes.
const PROCESS: &str = "average application of the process; ASME B46.1, Machinery’s Handbook";

/// Finishes of steel surfaces, from smooth to rough.
pub const FINISHES: [Finish; 7] = [
    Finish {
        name: "Rolling element",
        mean_height_m: (1.5e-8, 1.2e-7),
        source: "balls and rollers of bearings; Hamrock, Fundamentals of Fluid Film Lubrication",
    },
    Finish { name: "Superfinished", mean_height_m: (5e-8, 2e-7), source: PROCESS },
    Finish { name: "Lapped", mean_height_m: (5e-8, 4e-7), source: PROCESS },
    Finish { name: "Polished", mean_height_m: (1e-7, 4e-7), source: PROCESS },
    Finish { name: "Honed", mean_height_m: (1e-7, 8e-7), source: PROCESS },
    Finish { name: "Ground", mean_height_m: (1e-7, 1.6e-6), source: PROCESS },
    Finish {
        name: "Shot-peened",
        mean_height_m: (8e-7, 3e-6),
        source: "representative, it depends on shot and intensity; measure it",
    },
];

impl Finish {
    /// Returns the rms roughness Rq \[m\] at the geometric mean of the range, to two digits in µm.
    pub fn rms_m(&self) -> f64 {
        let (least, most) = self.mean_height_m;
        (1e8 * (least * most).sqrt() / HeightMeasure::Ra.of_rms()).round() / 1e8
    }

    /// Returns the finish of a surface with this rms roughness \[m\]; `None` if it is that of no finish.
    pub fn of_rms(rms_m: f64) -> Option<Self> {
        FINISHES.into_iter().find(|finish| (rms_m / finish.rms_m() - 1.0).abs() < 1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::surfaces::Roughness;

    #[test]
    fn mean_height_of_gaussian_surfaces_is_their_integral() {
        // ∫ |z| φ(z) dz by the trapezoidal rule.
        let step = 1e-3;
        let density = |z: f64| (-0.5 * z * z).exp() / (2.0 * std::f64::consts::PI).sqrt();
        let mean: f64 = (-8000..=8000).map(|k| step * f64::from(k)).map(|z| step * z.abs() * density(z)).sum();
        assert!((HeightMeasure::Ra.of_rms() - mean).abs() < 1e-6, "{mean}");
        assert_eq!(HeightMeasure::Sa.of_rms(), HeightMeasure::Ra.of_rms());
    }

    #[test]
    fn finishes_are_found_by_their_roughness() {
        for finish in FINISHES {
            let (least, most) = finish.mean_height_m;
            let mean = finish.rms_m() * HeightMeasure::Ra.of_rms();
            assert!((least..=most).contains(&mean), "{}: {mean}", finish.name);
            assert_eq!(Finish::of_rms(finish.rms_m()), Some(finish));
        }
        assert_eq!(Finish::of_rms(0.123e-6), None);
    }

    #[test]
    fn both_surfaces_follow_from_the_composite_roughness() {
        let rough = Roughness::new(1.0).with_surfaces([0.3e-6, 0.4e-6]);
        assert!((rough.sigma - 0.5e-6).abs() < 1e-20 && (rough.shear_flow - 0.28).abs() < 1e-14, "{rough:?}");
        let [first, second] = rough.surfaces();
        assert!((first - 0.3e-6).abs() < 1e-20 && (second - 0.4e-6).abs() < 1e-20);
        assert_eq!(Roughness::new(1.0).with_surfaces([0.0; 2]).surfaces(), [0.0; 2]);
    }
}
