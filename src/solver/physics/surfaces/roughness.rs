//! Composite roughness of both surfaces, as it is stated.

use super::asperity_laws::AsperityLaw;
use super::flow_factors::PEKLENIK;
use crate::solver::limits::Number;
use serde::{Deserialize, Serialize};

/// Roughness of both surfaces together. `sigma` = 0 means smooth surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Roughness {
    /// Composite rms roughness σ = √(σ₁² + σ₂²) \[m\], 0…1e-3.
    pub sigma: f64,
    /// Law of the asperity pressure.
    #[serde(default)]
    pub asperities: AsperityLaw,
    /// Peklenik number γ \[-\], 1/9…9: 1 for an isotropic roughness, above 1 for ridges along the flow.
    #[serde(default = "Roughness::isotropic")]
    pub peklenik: f64,
    /// (σ₁² − σ₂²)/σ² \[-\], −1…1: how much rougher the one surface is than the other. It is multiplied by SRR/2, so that
    /// σ₁ belongs to the surface that is faster for SRR > 0.
    #[serde(default)]
    pub shear_flow: f64,
    /// Friction coefficient μ_b of touching asperities \[-\], 0…2.
    #[serde(default = "Roughness::usual_friction")]
    pub boundary_friction: f64,
    /// Specific wear rate k of Archard's law \[m²/N\], 0…1e-9: worn volume per load and sliding distance.
    #[serde(default, skip_serializing_if = "not_worn")]
    pub wear_rate: f64,
}

/// Returns true for surfaces without a wear rate.
fn not_worn(wear_rate: &f64) -> bool {
    *wear_rate == 0.0
}

/// Constant of rough surfaces. `Display` writes its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SurfaceConstant {
    /// σ.
    #[error("the roughness in m")]
    Roughness,
    /// Constant of an asperity law, with its name.
    #[error("{0}")]
    Asperities(&'static str),
    /// γ.
    #[error("the Peklenik number")]
    Peklenik,
    /// (σ₁² − σ₂²)/σ².
    #[error("the relative difference of both variances")]
    ShearFlow,
    /// μ_b.
    #[error("the boundary friction coefficient")]
    BoundaryFriction,
    /// k.
    #[error("the specific wear rate in m²/N")]
    WearRate,
}

/// Reason for refusing a roughness: a constant that is not finite or outside its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{constant} is {}, but must be a finite number between {} and {}", Number(*value), Number(range.0), Number(range.1))]
pub struct SurfaceError {
    /// The constant.
    pub constant: SurfaceConstant,
    value: f64,
    range: (f64, f64),
}

impl SurfaceError {
    /// Refuses a constant outside its range.
    pub(super) fn check(constant: SurfaceConstant, value: f64, range: (f64, f64)) -> Result<(), Self> {
        if (range.0..=range.1).contains(&value) { Ok(()) } else { Err(Self { constant, value, range }) }
    }
}

/// Largest rms roughness \[m\].
pub const LARGEST_RMS: f64 = 1e-3;
/// Relative error up to which an end of the Peklenik numbers counts as rounded, as 0.1111 for 1/9.
const ROUNDED: f64 = 1e-3;

impl Roughness {
    /// Returns isotropic surfaces of equal roughness with the default asperities and a composite rms roughness \[m\].
    pub fn new(sigma: f64) -> Self {
        Self {
            sigma,
            asperities: AsperityLaw::default(),
            peklenik: Self::isotropic(),
            shear_flow: 0.0,
            boundary_friction: Self::usual_friction(),
            wear_rate: 0.0,
        }
    }

    /// Returns the same surfaces with other rms roughness Rq \[m\] of body 1 and body 2. Body 2 is the faster one for
    /// SRR > 0.
    pub fn with_surfaces(self, [first, second]: [f64; 2]) -> Self {
        let sigma = first.hypot(second);
        let shear_flow = if sigma > 0.0 { (second - first) * (second + first) / (sigma * sigma) } else { 0.0 };
        Self { sigma, shear_flow, ..self }
    }

    /// Returns the rms roughness Rq \[m\] of body 1 and body 2.
    pub fn surfaces(&self) -> [f64; 2] {
        [1.0 - self.shear_flow, 1.0 + self.shear_flow].map(|share| self.sigma * (0.5 * share).max(0.0).sqrt())
    }

    /// Default of the Peklenik number: 1, isotropic.
    pub const fn isotropic() -> f64 {
        1.0
    }

    /// Default of the friction coefficient of touching asperities.
    pub const fn usual_friction() -> f64 {
        0.12
    }

    /// Refuses constants out of range.
    ///
    /// # Errors
    /// With the name of the first such constant and its range.
    pub fn check(&self) -> Result<(), SurfaceError> {
        use SurfaceConstant::{BoundaryFriction, Peklenik, ShearFlow, WearRate};
        SurfaceError::check(SurfaceConstant::Roughness, self.sigma, (0.0, LARGEST_RMS))?;
        self.asperities.check()?;
        if !((1.0 - ROUNDED) * PEKLENIK.0..=(1.0 + ROUNDED) * PEKLENIK.1).contains(&self.peklenik) {
            return SurfaceError::check(Peklenik, self.peklenik, PEKLENIK);
        }
        SurfaceError::check(ShearFlow, self.shear_flow, (-1.0, 1.0))?;
        SurfaceError::check(BoundaryFriction, self.boundary_friction, (0.0, 2.0))?;
        SurfaceError::check(WearRate, self.wear_rate, (0.0, 1e-9))
    }

    /// Returns all constants in SI units as text.
    pub fn describe(&self) -> String {
        let Self { sigma, asperities, peklenik, shear_flow, boundary_friction, wear_rate } = self;
        let law = match asperities {
            AsperityLaw::GreenwoodTripp { eta_beta_sigma, sigma_over_beta } => {
                format!("{eta_beta_sigma:e}, {sigma_over_beta:e}")
            }
            AsperityLaw::ZhaoMaiettaChang { n_beta_sigma, sigma_over_beta, hardness } => {
                format!("{n_beta_sigma:e}, {sigma_over_beta:e}, {hardness:e} Pa")
            }
            AsperityLaw::Exponential { pressure, decay } => format!("{pressure:e} Pa, {decay:e}"),
        };
        let wear = if *wear_rate > 0.0 { format!(", specific wear rate {wear_rate:e} m²/N") } else { String::new() };
        format!(
            "roughness {sigma:e} m ({} {law}; Peklenik number {peklenik:e}, shear flow {shear_flow:e}, boundary friction \
             {boundary_friction:e}{wear})",
            asperities.name()
        )
    }
}
