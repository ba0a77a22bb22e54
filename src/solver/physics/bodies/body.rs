//! One of the two bodies.

use super::material::{BodyHeat, MATERIALS, Material};
use serde::{Deserialize, Serialize};

/// Radius of a body across the rolling direction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum Transverse {
    /// Same radius as along the rolling direction: a ball, or a plane.
    #[default]
    AsAlong,
    /// No curvature across: a cylinder.
    Plane,
    /// Radius \[m\], negative for a groove.
    Radius(f64),
}

/// One of the two bodies.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Young's modulus E \[Pa\].
    pub modulus_pa: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Thermal constants.
    #[serde(default)]
    pub heat: BodyHeat,
    /// Radius along the rolling direction \[m\], negative for a concave surface; `None` for a plane.
    #[serde(default)]
    pub radius_m: Option<f64>,
    /// Radius across the rolling direction, used for point contacts only.
    #[serde(default)]
    pub transverse: Transverse,
    /// Speed of its surface \[m/s\].
    pub speed_m_per_s: f64,
    /// Root-mean-square roughness Rq \[m\].
    #[serde(default)]
    pub roughness_m: f64,
}

impl Body {
    /// Returns the named material with its constants, or `None`.
    pub fn material(&self) -> Option<Material> {
        MATERIALS.into_iter().find(|material| self.of(*material) == *self)
    }

    /// Returns the same body of another material.
    pub fn of(self, Material { modulus_pa, poisson, heat, .. }: Material) -> Self {
        Self { modulus_pa, poisson, heat, ..self }
    }

    /// Returns the same body with these thermal constants. If they are those of a named material, the elastic
    /// constants are set as well.
    pub fn conducting(self, heat: BodyHeat) -> Self {
        heat.material().map_or(Self { heat, ..self }, |material| self.of(material))
    }

    /// Returns the radius across the rolling direction \[m\]; `None` for a plane.
    pub fn transverse_radius_m(&self) -> Option<f64> {
        match self.transverse {
            Transverse::AsAlong => self.radius_m,
            Transverse::Plane => None,
            Transverse::Radius(radius) => Some(radius),
        }
    }

    /// Returns the same body with a radius across the rolling direction \[m\]; `None` for a plane.
    pub fn with_transverse_radius_m(self, radius_m: Option<f64>) -> Self {
        let transverse = match radius_m {
            radius if radius == self.radius_m => Transverse::AsAlong,
            None => Transverse::Plane,
            Some(radius) => Transverse::Radius(radius),
        };
        Self { transverse, ..self }
    }
}
