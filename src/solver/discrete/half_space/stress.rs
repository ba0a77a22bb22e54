//! Stress at a point below the surface, and measures of it.

use serde::{Deserialize, Serialize};

/// Stress in the plane Y = 0. Tension is positive. σ_xy and σ_yz vanish there by symmetry, so that σ_y is principal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stress {
    /// σ_x, along the direction of motion.
    pub x: f64,
    /// σ_y, across.
    pub y: f64,
    /// σ_z, downwards.
    pub z: f64,
    /// τ_xz, the orthogonal shear stress.
    pub xz: f64,
}

/// Scalar measure of a stress.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum StressMeasure {
    /// Equivalent stress of von Mises.
    #[default]
    VonMises,
    /// Maximum shear stress: half the difference between the largest and the smallest principal stress.
    MaximumShear,
    /// Orthogonal shear stress τ_xz with its sign.
    OrthogonalShear,
}

impl StressMeasure {
    /// All measures.
    pub const ALL: [Self; 3] = [Self::VonMises, Self::MaximumShear, Self::OrthogonalShear];

    /// Returns the name with its symbol.
    pub const fn name(self) -> &'static str {
        match self {
            Self::VonMises => "von Mises stress",
            Self::MaximumShear => "maximum shear stress",
            Self::OrthogonalShear => "orthogonal shear stress",
        }
    }
}

impl Stress {
    /// Returns the measure of this stress.
    pub fn measure(self, measure: StressMeasure) -> f64 {
        match measure {
            StressMeasure::VonMises => self.von_mises(),
            StressMeasure::MaximumShear => self.maximum_shear(),
            StressMeasure::OrthogonalShear => self.xz,
        }
    }

    /// Returns the equivalent stress of von Mises.
    pub fn von_mises(self) -> f64 {
        let Self { x, y, z, xz } = self;
        (0.5 * ((x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2)) + 3.0 * xz * xz).sqrt()
    }

    /// Returns half the difference between the largest and the smallest principal stress.
    pub fn maximum_shear(self) -> f64 {
        let (mean, radius) = (0.5 * (self.x + self.z), (0.5 * (self.x - self.z)).hypot(self.xz));
        0.5 * ((mean + radius).max(self.y) - (mean - radius).min(self.y))
    }

    /// Returns the stress scaled by a factor.
    pub fn scaled(self, factor: f64) -> Self {
        Self { x: factor * self.x, y: factor * self.y, z: factor * self.z, xz: factor * self.xz }
    }
}
