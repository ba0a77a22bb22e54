//! The two bodies: materials, radii, surface speeds and roughness, and what they amount to together.

/// An elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Its name for people.
    pub name: &'static str,
    /// Young's modulus E \[Pa\].
    pub modulus_pa: f64,
    /// Poisson's ratio ν.
    pub poisson: f64,
}

/// Materials by name, with usual values of handbooks. Two bodies of this steel have E′ = 230.8 GPa, the program's
/// default.
pub const MATERIALS: [Material; 6] = [
    Material { name: "Steel", modulus_pa: 210e9, poisson: 0.3 },
    Material { name: "Silicon nitride", modulus_pa: 310e9, poisson: 0.27 },
    Material { name: "Bronze", modulus_pa: 110e9, poisson: 0.34 },
    Material { name: "Cast iron", modulus_pa: 120e9, poisson: 0.26 },
    Material { name: "Glass", modulus_pa: 81e9, poisson: 0.21 },
    Material { name: "Tungsten carbide", modulus_pa: 630e9, poisson: 0.22 },
];

/// Why two bodies make no contact.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum BodyError {
    /// A radius is zero or no number.
    #[error("a radius is {0} m; it must be a finite number other than 0, negative for a concave surface")]
    Radius(f64),
    /// The surfaces do not touch in one spot.
    #[error(
        "the radii {0} m and {1} m lie closer than any contact: a concave surface must be flatter than the convex one in it"
    )]
    Conforming(f64, f64),
    /// A modulus or Poisson's ratio outside what solids have.
    #[error(
        "a Young’s modulus of {0} Pa with a Poisson’s ratio of {1} is no solid: 1e5 to 1e14 Pa and −1 to 0.5 are accepted"
    )]
    Material(f64, f64),
    /// Neither surface carries oil into the contact.
    #[error("surface speeds of {0} m/s and {1} m/s carry no oil into the contact: their mean must be above zero")]
    Entrainment(f64, f64),
    /// A roughness below zero, or both zero.
    #[error("a roughness of {0} m and {1} m gives no film ratio: both must be at least 0 and one above")]
    Roughness(f64, f64),
}

/// Two bodies in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Materials of body 1 and 2.
    pub materials: [Material; 2],
    /// Radii R₁ and R₂ \[m\]; negative for a concave surface, infinite for a plane.
    pub radii_m: [f64; 2],
    /// Surface speeds u₁ and u₂ \[m/s\].
    pub speeds_m_per_s: [f64; 2],
}

impl Pair {
    /// Reduced radius R \[m\], 1/R = 1/R₁ + 1/R₂ (2.3).
    ///
    /// # Errors
    /// A radius of zero, or a concave surface that is not flatter than the convex one in it.
    pub fn reduced_radius_m(&self) -> Result<f64, BodyError> {
        let [first, second] = self.radii_m;
        if let Some(bad) = self.radii_m.into_iter().find(|radius| radius.is_nan() || *radius == 0.0) {
            return Err(BodyError::Radius(bad));
        }
        let radius = 1.0 / (1.0 / first + 1.0 / second);
        if radius > 0.0 && radius.is_finite() { Ok(radius) } else { Err(BodyError::Conforming(first, second)) }
    }

    /// Reduced modulus E′ \[Pa\], 2/E′ = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ (2.5).
    ///
    /// # Errors
    /// Constants that no solid has.
    pub fn reduced_modulus_pa(&self) -> Result<f64, BodyError> {
        let mut compliance = 0.0;
        for Material { modulus_pa, poisson, .. } in self.materials {
            if !((1e5..=1e14).contains(&modulus_pa) && (-1.0..=0.5).contains(&poisson)) {
                return Err(BodyError::Material(modulus_pa, poisson));
            }
            compliance += (1.0 - poisson * poisson) / modulus_pa;
        }
        // Poisson's ratio −1 on both sides gives rigid bodies.
        if compliance > 0.0 {
            Ok(2.0 / compliance)
        } else {
            let [Material { modulus_pa, poisson, .. }, _] = self.materials;
            Err(BodyError::Material(modulus_pa, poisson))
        }
    }

    /// Mean entrainment speed u_m \[m/s\] (2.1) and slide-to-roll ratio SRR = (u₂ − u₁)/u_m (3.25).
    ///
    /// # Errors
    /// Speeds whose mean is not above zero.
    pub fn entrainment(&self) -> Result<(f64, f64), BodyError> {
        let [first, second] = self.speeds_m_per_s;
        let mean = 0.5 * (first + second);
        let inside = mean > 0.0 && mean.is_finite();
        if inside { Ok((mean, (second - first) / mean)) } else { Err(BodyError::Entrainment(first, second)) }
    }
}

/// The two surface speeds \[m/s\] of a mean speed \[m/s\] and a slide-to-roll ratio.
pub fn surface_speed(mean_m_per_s: f64, slide_to_roll: f64) -> [f64; 2] {
    [mean_m_per_s * (1.0 - 0.5 * slide_to_roll), mean_m_per_s * (1.0 + 0.5 * slide_to_roll)]
}

/// Film ratio λ = h_min/√(Rq₁² + Rq₂²) of the smallest film and both root-mean-square roughnesses \[m\].
///
/// # Errors
/// A roughness below zero, or none at all.
pub fn lambda_ratio(smallest_film_m: f64, roughness_m: [f64; 2]) -> Result<f64, BodyError> {
    let [first, second] = roughness_m;
    let composite = first.hypot(second);
    if first >= 0.0 && second >= 0.0 && composite > 0.0 && composite.is_finite() {
        Ok(smallest_film_m / composite)
    } else {
        Err(BodyError::Roughness(first, second))
    }
}

/// What a film ratio means, in the limits that handbooks use.
pub fn film_regime(lambda: f64) -> &'static str {
    match lambda {
        l if l >= 3.0 => "full film: the surfaces are apart",
        l if l >= 1.0 => "mixed: the highest asperities touch",
        _ => "boundary: asperities carry the load",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Material = MATERIALS[0];

    fn pair(radii_m: [f64; 2], speeds_m_per_s: [f64; 2]) -> Pair {
        Pair { materials: [STEEL; 2], radii_m, speeds_m_per_s }
    }

    #[test]
    fn a_roller_in_a_raceway_is_a_larger_roller_on_a_plane() {
        let on_plane = pair([0.012, f64::INFINITY], [3.0, 3.0]);
        assert_eq!(on_plane.reduced_radius_m(), Ok(0.012));
        let in_ring = pair([0.01, -0.05], [3.0, 3.0]);
        assert!((in_ring.reduced_radius_m().unwrap() - 0.0125).abs() < 1e-15);
        let on_ring = pair([0.01, 0.05], [3.0, 3.0]);
        assert!((on_ring.reduced_radius_m().unwrap() - 0.01 / 1.2).abs() < 1e-15);
    }

    #[test]
    fn steel_on_steel_is_the_default_modulus_and_a_rigid_partner_doubles_it() {
        let both = pair([0.01; 2], [1.0; 2]).reduced_modulus_pa().unwrap();
        assert!((both - 230.77e9).abs() < 0.01e9, "{both}");
        let hard = Material { name: "rigid", modulus_pa: 1e14, poisson: 0.3 };
        let one = Pair { materials: [STEEL, hard], ..pair([0.01; 2], [1.0; 2]) }.reduced_modulus_pa().unwrap();
        assert!((one / both - 2.0).abs() < 5e-3, "{one}");
    }

    #[test]
    fn speeds_and_sliding_are_each_others_inverse() {
        let (mean, sliding) = pair([0.01; 2], surface_speed(3.0, 0.05)).entrainment().unwrap();
        assert!((mean - 3.0).abs() < 1e-14 && (sliding - 0.05).abs() < 1e-14);
        assert_eq!(surface_speed(1.0, 2.0), [0.0, 2.0]);
    }

    #[test]
    fn what_is_no_contact_is_refused() {
        for (bad, said) in [
            (pair([0.0, 1.0], [1.0; 2]).reduced_radius_m(), "other than 0"),
            (pair([f64::NAN, 1.0], [1.0; 2]).reduced_radius_m(), "other than 0"),
            (pair([0.05, -0.05], [1.0; 2]).reduced_radius_m(), "flatter"),
            (pair([0.05, -0.01], [1.0; 2]).reduced_radius_m(), "flatter"),
            (pair([0.01; 2], [1.0, -1.0]).entrainment().map(|e| e.0), "carry no oil"),
            (lambda_ratio(1e-7, [0.0, 0.0]), "one above"),
            (lambda_ratio(1e-7, [-1e-8, 1e-8]), "at least 0"),
            (lambda_ratio(1e-7, [f64::NAN, 1e-8]), "at least 0"),
        ] {
            assert!(bad.unwrap_err().to_string().contains(said), "{said}");
        }
        let odd = Material { name: "odd", modulus_pa: 210e9, poisson: 0.6 };
        let made_of_it = Pair { materials: [odd, STEEL], ..pair([0.01; 2], [1.0; 2]) };
        assert!(made_of_it.reduced_modulus_pa().unwrap_err().to_string().contains("no solid"));
    }

    #[test]
    fn the_film_ratio_is_named() {
        let lambda = lambda_ratio(0.5e-6, [0.3e-6, 0.4e-6]).unwrap();
        assert!((lambda - 1.0).abs() < 1e-12);
        assert!(film_regime(0.5).starts_with("boundary") && film_regime(2.0).starts_with("mixed"));
        assert!(film_regime(3.5).starts_with("full film"));
    }
}
