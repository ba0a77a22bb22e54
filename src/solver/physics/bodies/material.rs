//! Elastic and thermal constants of materials. This is the only definition of each named material's constants.

use serde::{Deserialize, Serialize};

/// Thermal constants of a body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BodyHeat {
    /// Thermal conductivity k \[W/(m K)\].
    pub conductivity: f64,
    /// Specific heat capacity c \[J/(kg K)\].
    pub heat_capacity: f64,
    /// Density ρ \[kg/m³\].
    pub density: f64,
}

/// Named material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Display name.
    pub name: &'static str,
    /// Young's modulus E \[Pa\].
    pub modulus_pa: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
    /// Thermal constants.
    pub heat: BodyHeat,
    /// Typical use and source of the constants.
    pub source: &'static str,
}

/// All named materials. Two bodies of this steel have E′ = 230.8 GPa, the program's default.
pub const MATERIALS: [Material; 6] = [
    Material::STEEL,
    material("Silicon nitride", (310e9, 0.27), (25.0, 700.0, 3230.0), "Bearing balls; data sheets of makers"),
    material("Bronze", (110e9, 0.34), (60.0, 377.0, 8800.0), "Tin bronze; usual values of handbooks"),
    material("Cast iron", (120e9, 0.26), (50.0, 500.0, 7200.0), "Grey cast iron; usual values of handbooks"),
    Material::GLASS,
    material("Tungsten carbide", (630e9, 0.22), (85.0, 210.0, 14900.0), "With 6 % cobalt; data sheets of makers"),
];

/// Creates a material from E \[Pa\] and ν, and from k \[W/(m K)\], c \[J/(kg K)\] and ρ \[kg/m³\].
const fn material(
    name: &'static str,
    (modulus_pa, poisson): (f64, f64),
    (conductivity, heat_capacity, density): (f64, f64, f64),
    source: &'static str,
) -> Material {
    Material { name, modulus_pa, poisson, heat: BodyHeat { conductivity, heat_capacity, density }, source }
}

impl Material {
    /// Bearing steel.
    pub const STEEL: Self = material(
        "Steel",
        (210e9, 0.3),
        (47.0, 460.0, 7850.0),
        "Bearing steel; usual values of handbooks. Through-hardened it conducts 21 W/(m K) (Reddyhoff and others 2019)",
    );
    /// Crown glass, the usual material of discs in optical rigs.
    pub const GLASS: Self =
        material("Glass", (81e9, 0.21), (1.1, 840.0, 2500.0), "Crown glass, near N-BK7 of SCHOTT’s data sheet");

    /// Returns its name as one word, as used in options.
    pub fn word(&self) -> String {
        self.name.to_lowercase().replace(' ', "-")
    }

    /// Returns the material with that word, or `None`.
    pub fn named(word: &str) -> Option<Self> {
        MATERIALS.into_iter().find(|material| material.word() == word.to_lowercase().replace(' ', "-"))
    }

    /// Returns its constants and their source as text.
    pub fn describe(&self) -> String {
        let Self { modulus_pa, poisson, heat: BodyHeat { conductivity, heat_capacity, density }, source, .. } = self;
        format!(
            "E {:.0} GPa, ν {poisson}, k {conductivity} W/(m K), c {heat_capacity} J/(kg K), ρ {density} kg/m³. {source}",
            1e-9 * modulus_pa
        )
    }
}

impl BodyHeat {
    /// Returns the effusivity √(kρc) \[J/(m² K √s)\]. The temperature rise of a surface under a moving source depends
    /// on it only.
    pub fn effusivity(&self) -> f64 {
        (self.conductivity * self.density * self.heat_capacity).sqrt()
    }

    /// Returns the named material with these constants, or `None`.
    pub fn material(&self) -> Option<Material> {
        MATERIALS.into_iter().find(|material| material.heat == *self)
    }
}

impl Default for BodyHeat {
    fn default() -> Self {
        Material::STEEL.heat
    }
}
