//! Stress below one Fourier component of the surface load.
//!
//! With p = p̂ e^{i(k_x x + k_y y)}, κ = k z, c = k_x/k and s = k_y/k the stresses that satisfy equilibrium and
//! compatibility and vanish at great depth are, over e^{−κ} e^{i(k_x x + k_y y)},
//!
//! - σ_x = −p̂ (c² (1 − κ) + 2ν s²) + i q̂ c (c² (2 − κ) + 2s² + 2ν s²)
//! - σ_y = −p̂ (s² (1 − κ) + 2ν c²) + i q̂ c (2ν c² − s² κ)
//! - σ_z = −p̂ (1 + κ) + i q̂ c κ
//! - τ_xz = i p̂ c κ − q̂ (1 − c² κ)
//!
//! At z = 0: σ_z = −p and τ_xz = −q. Their trace is −2(1 + ν)(p̂ − i q̂ c), which is harmonic. Sources: Johnson,
//! Contact Mechanics, sections 2.2 and 3.2; Boussinesq's and Cerruti's solutions transformed.

use super::stress::Stress;

/// Factors of one component: the real ones of p̂ and the imaginary ones of q̂; for τ_xz the other way round.
#[derive(Clone, Copy, Debug)]
pub struct Mode {
    /// σ_x, σ_y, σ_z per p̂, and τ_xz per i p̂.
    pub of_pressure: Stress,
    /// σ_x, σ_y, σ_z per i q̂, and τ_xz per q̂.
    pub of_traction: Stress,
}

impl Mode {
    /// Returns the factors for the wave numbers k_x ≥ 0 and k_y at a depth z, without the decay e^{−κ}.
    pub fn new([k_x, k_y]: [f64; 2], depth: f64, poisson: f64) -> Self {
        let k = k_x.hypot(k_y);
        let (c, s) = if k > 0.0 { (k_x / k, k_y / k) } else { (0.0, 0.0) };
        Self::of_direction([c, c * c, s * s], k * depth, poisson)
    }

    /// Returns the factors of a uniform load, the limit k → 0: along X for a line contact, else the mean over all
    /// directions.
    pub fn uniform(line: bool, poisson: f64) -> Self {
        Self::of_direction(if line { [0.0, 1.0, 0.0] } else { [0.0, 0.5, 0.5] }, 0.0, poisson)
    }

    /// Returns the factors for c, c², s² and κ = k z.
    fn of_direction([c, cc, ss]: [f64; 3], reach: f64, poisson: f64) -> Self {
        let across = 2.0 * poisson;
        Self {
            of_pressure: Stress {
                x: -(cc * (1.0 - reach) + across * ss),
                y: -(ss * (1.0 - reach) + across * cc),
                z: -(1.0 + reach),
                xz: c * reach,
            },
            of_traction: Stress {
                x: c * (cc * (2.0 - reach) + (2.0 + across) * ss),
                y: c * (across * cc - ss * reach),
                z: c * reach,
                xz: -(1.0 - cc * reach),
            },
        }
    }
}
