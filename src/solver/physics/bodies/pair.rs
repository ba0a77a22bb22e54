//! Quantities of both bodies together: reduced radii and modulus, entrainment and sliding, film ratio.
//!
//! SRR = (u₂ − u₁)/u_m (3.25): body 1 moves with u_m (1 − SRR/2), body 2 with u_m (1 + SRR/2).

use super::body::{Body, Transverse};
use super::material::{BodyHeat, Material};
use crate::solver::physics::contact::{ContactError, ContactKind, OperatingPoint, Sliding, reduced_modulus};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Reason why two bodies do not form a contact.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BodyError {
    /// A radius is zero or not a number.
    #[error("a radius is {0} m; it must be a finite number other than 0, negative for a concave surface")]
    Radius(f64),
    /// The sum of curvatures is not positive, so that the surfaces do not touch in one point or line.
    #[error(
        "these surfaces do not touch in one point or line: a concave surface must be flatter than the convex one in it, and one surface must be curved"
    )]
    Conforming,
    /// The sum of curvatures across the rolling direction is not positive. Contains the radii \[m\], infinite for a
    /// plane.
    #[error(
        "across the rolling direction the radii of {} and {} leave no positive sum of curvatures: {}",
        Across(*.0), Across(*.1), accepted_across(*.0, *.1)
    )]
    ConformingAcross(f64, f64),
    /// Elastic constants outside the accepted range.
    #[error(transparent)]
    Material(#[from] ContactError),
    /// Neither surface carries lubricant into the contact.
    #[error("surface speeds of {0} m/s and {1} m/s carry no oil into the contact: their mean must be above zero")]
    Entrainment(f64, f64),
    /// A roughness is negative, or both are zero.
    #[error("a roughness of {0} m and {1} m gives no film ratio: both must be at least 0 and one above")]
    Roughness(f64, f64),
}

/// Radius across the rolling direction \[m\], displayed as part of a message.
struct Across(f64);

impl fmt::Display for Across {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_infinite() { f.write_str("a plane") } else { write!(f, "{} m", self.0) }
    }
}

/// Returns which radii would be accepted instead of these two \[m\], for [`BodyError::ConformingAcross`].
fn accepted_across(first: f64, second: f64) -> String {
    let convex = first.max(second);
    if convex.is_finite() && convex > 0.0 {
        format!("a groove must be flatter than what runs in it, here beyond {} m", -convex)
    } else {
        "one of them must be convex, with a radius above 0, and a groove flatter than that".to_owned()
    }
}

/// Body 1 and body 2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Bodies(pub [Body; 2]);

/// Returns the sum of curvatures \[1/m\] of two surfaces with the given radii \[m\], `None` for a plane.
fn curvatures(radii_m: [Option<f64>; 2]) -> Result<f64, BodyError> {
    let curvature = |radius: f64| {
        if radius.is_finite() && radius != 0.0 { Ok(1.0 / radius) } else { Err(BodyError::Radius(radius)) }
    };
    let [first, second] = radii_m.map(|radius| radius.map_or(Ok(0.0), curvature));
    Ok(first? + second?)
}

/// Returns the reduced radius R \[m\] of two surfaces, 1/R = 1/R₁ + 1/R₂ (2.3). `radii_m` are R₁ and R₂ \[m\], `None`
/// for a plane.
///
/// # Errors
/// If a radius is zero, a concave surface is not flatter than the convex one, or both surfaces are planes.
pub fn reduced_radius_m(radii_m: [Option<f64>; 2]) -> Result<f64, BodyError> {
    let radius = 1.0 / curvatures(radii_m)?;
    if radius > 0.0 && radius.is_finite() { Ok(radius) } else { Err(BodyError::Conforming) }
}

impl Bodies {
    /// Returns two steel bodies that form a contact: a roller or ball on a plane with the given reduced radius \[m\],
    /// mean speed \[m/s\] and slide-to-roll ratio. Both have a roughness of 50 nm, as in good bearings.
    pub fn on_plane(radius_m: f64, mean_m_per_s: f64, slide_to_roll: f64) -> Self {
        let [first, second] = surface_speeds(mean_m_per_s, slide_to_roll);
        let Material { modulus_pa, poisson, heat, .. } = Material::STEEL;
        let transverse = Transverse::AsAlong;
        let body = |radius_m, speed_m_per_s| Body {
            modulus_pa,
            poisson,
            heat,
            radius_m,
            transverse,
            speed_m_per_s,
            roughness_m: 5e-8,
        };
        Self([body(Some(radius_m), first), body(None, second)])
    }

    /// Returns the reduced radius R along the rolling direction \[m\], 1/R = 1/R₁ + 1/R₂ (2.3).
    ///
    /// # Errors
    /// As the function [`reduced_radius_m`].
    pub fn reduced_radius_m(&self) -> Result<f64, BodyError> {
        reduced_radius_m(self.0.map(|body| body.radius_m))
    }

    /// Returns the reduced radius R_y across the rolling direction \[m\], also by (2.3).
    ///
    /// # Errors
    /// If a radius is zero, a groove is not flatter than the body in it, or both surfaces are flat across.
    pub fn reduced_transverse_radius_m(&self) -> Result<f64, BodyError> {
        let radii = self.0.map(|body| body.transverse_radius_m());
        let radius = 1.0 / curvatures(radii)?;
        if radius > 0.0 && radius.is_finite() {
            return Ok(radius);
        }
        let [first, second] = radii.map(|radius| radius.unwrap_or(f64::INFINITY));
        Err(BodyError::ConformingAcross(first, second))
    }

    /// Returns the reduced modulus E′ \[Pa\], 2/E′ = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂ (2.5).
    ///
    /// # Errors
    /// If an elastic constant is outside the accepted range.
    pub fn reduced_modulus_pa(&self) -> Result<f64, BodyError> {
        let Self([first, second]) = self;
        Ok(reduced_modulus(first.modulus_pa, first.poisson, second.modulus_pa, second.poisson)?)
    }

    /// Returns the thermal constants of body 1 and of body 2.
    pub fn heat(&self) -> [BodyHeat; 2] {
        self.0.map(|body| body.heat)
    }

    /// Returns the mean entrainment speed u_m \[m/s\] (2.1) and the slide-to-roll ratio SRR = (u₂ − u₁)/u_m (3.25).
    ///
    /// # Errors
    /// If the mean speed is not positive.
    pub fn entrainment(&self) -> Result<(f64, f64), BodyError> {
        let [first, second] = self.0.map(|body| body.speed_m_per_s);
        let mean = 0.5 * (first + second);
        let inside = mean > 0.0 && mean.is_finite();
        if inside { Ok((mean, (second - first) / mean)) } else { Err(BodyError::Entrainment(first, second)) }
    }

    /// Returns `point` with R, R_y, E′, u_m and SRR of these bodies. Its other quantities are unchanged. A point
    /// contact becomes elliptical if R and R_y differ. An elliptical contact remains elliptical also if they are equal.
    ///
    /// # Errors
    /// If the bodies do not form a contact.
    pub fn contact(&self, point: OperatingPoint) -> Result<OperatingPoint, BodyError> {
        let (speed_m_per_s, slide_to_roll_ratio) = self.entrainment()?;
        let (radius_m, modulus_pa) = (self.reduced_radius_m()?, self.reduced_modulus_pa()?);
        let radius_y_m = match point.kind {
            ContactKind::Line => None,
            ContactKind::Point => Some(self.reduced_transverse_radius_m()?)
                .filter(|radius_y| *radius_y != radius_m || point.radius_y_m.is_some()),
        };
        let sliding = Sliding { slide_to_roll_ratio, ..point.sliding };
        Ok(OperatingPoint { radius_m, radius_y_m, modulus_pa, speed_m_per_s, sliding, ..point })
    }

    /// Returns the film ratio λ = h_min/√(Rq₁² + Rq₂²) for the minimum film thickness h_min \[m\]. Rq are the
    /// roughnesses.
    ///
    /// # Errors
    /// If a roughness is negative, or both are zero.
    pub fn film_ratio(&self, h_min_m: f64) -> Result<f64, BodyError> {
        let [first, second] = self.0.map(|body| body.roughness_m);
        let composite = first.hypot(second);
        if first >= 0.0 && second >= 0.0 && composite > 0.0 && composite.is_finite() {
            Ok(h_min_m / composite)
        } else {
            Err(BodyError::Roughness(first, second))
        }
    }
}

/// Returns the speeds of body 1 and of body 2 \[m/s\] at a mean speed \[m/s\] and a slide-to-roll ratio (3.25).
pub fn surface_speeds(mean_m_per_s: f64, slide_to_roll: f64) -> [f64; 2] {
    [mean_m_per_s * (1.0 - 0.5 * slide_to_roll), mean_m_per_s * (1.0 + 0.5 * slide_to_roll)]
}

/// Returns the lubrication regime for a film ratio λ. The limits 3 and 1 are those of handbooks.
pub fn film_regime(lambda: f64) -> &'static str {
    match lambda {
        l if l >= 3.0 => "full film",
        l if l >= 1.0 => "mixed",
        _ => "mixed to boundary",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bodies(radii_m: [f64; 2], speeds: [f64; 2]) -> Bodies {
        let Bodies([first, second]) = Bodies::on_plane(0.01, 1.0, 0.0);
        let radius = |radius: f64| Some(radius).filter(|radius| radius.is_finite());
        Bodies([
            Body { radius_m: radius(radii_m[0]), speed_m_per_s: speeds[0], ..first },
            Body { radius_m: radius(radii_m[1]), speed_m_per_s: speeds[1], ..second },
        ])
    }

    #[test]
    fn a_roller_in_a_raceway_is_a_larger_roller_on_a_plane() {
        for (radii, reduced) in [
            ([0.012, f64::INFINITY], 0.012),
            ([0.01, -0.05], 0.0125),
            ([0.01, 0.05], 0.01 / 1.2),
            ([-0.05, 0.01], 0.0125),
        ] {
            let radius = bodies(radii, [1.0; 2]).reduced_radius_m().unwrap();
            assert!((radius - reduced).abs() < 1e-15, "{radii:?}: {radius}");
        }
    }

    #[test]
    fn balls_in_grooves_are_ellipses_across_rolling() {
        // Ball of a 6206 bearing, 9.525 mm on a pitch diameter of 46 mm, on its inner race of 36.475 mm in a groove of
        // 4.953 mm (52 %).
        let Bodies([ball, race]) = bodies([4.7625e-3, 18.2375e-3], [1.0; 2]);
        let race = race.with_transverse_radius_m(Some(-4.953e-3));
        let pair = Bodies([ball, race]);
        assert!((pair.reduced_radius_m().unwrap() - 3.776352e-3).abs() < 1e-9);
        assert!((pair.reduced_transverse_radius_m().unwrap() - 123.83e-3).abs() < 1e-5);
        // A body without a transverse radius is as round across as along.
        let round = bodies([0.01, -0.05], [1.0; 2]);
        assert_eq!(round.reduced_radius_m(), round.reduced_transverse_radius_m());
        assert_eq!(race.with_transverse_radius_m(race.radius_m).transverse, Transverse::AsAlong);
        let across = |first, second| {
            Bodies([ball.with_transverse_radius_m(first), race.with_transverse_radius_m(second)])
                .reduced_transverse_radius_m()
                .unwrap_err()
                .to_string()
        };
        for (first, second, said) in [
            (Some(4.7625e-3), Some(-4.7625e-3), "beyond -0.0047625 m"),
            (Some(4.7625e-3), Some(-4e-3), "radii of 0.0047625 m and -0.004 m leave no positive sum of curvatures"),
            (None, None, "radii of a plane and a plane"),
            (None, Some(-0.01), "one of them must be convex"),
            (Some(0.0), None, "other than 0"),
            (Some(f64::NAN), None, "other than 0"),
        ] {
            let sentence = across(first, second);
            assert!(sentence.contains(said), "{sentence}");
        }
    }

    #[test]
    fn a_rigid_partner_doubles_the_modulus_of_steel_on_steel() {
        let Bodies([first, second]) = bodies([0.01; 2], [1.0; 2]);
        let both = Bodies([first, second]).reduced_modulus_pa().unwrap();
        assert!((both - 230.77e9).abs() < 0.01e9, "{both}");
        let one = Bodies([first, Body { modulus_pa: 1e14, ..second }]).reduced_modulus_pa().unwrap();
        assert!((one / both - 2.0).abs() < 5e-3, "{one}");
        assert_eq!(first.material(), Some(Material::STEEL));
        let glass = first.of(Material::GLASS);
        assert_eq!((glass.material(), glass.heat.material()), (Some(Material::GLASS), Some(Material::GLASS)));
        assert_eq!(Body { heat: first.heat, ..glass }.material(), None, "glass that conducts like steel");
    }

    #[test]
    fn speeds_and_sliding_are_each_others_inverse() {
        let (mean, sliding) = Bodies::on_plane(0.01, 3.0, 0.05).entrainment().unwrap();
        assert!((mean - 3.0).abs() < 1e-14 && (sliding - 0.05).abs() < 1e-14);
        assert_eq!(surface_speeds(1.0, 2.0), [0.0, 2.0]);
    }

    #[test]
    fn what_is_no_contact_is_refused() {
        let rough = |first: f64, second: f64| {
            let Bodies([a, b]) = Bodies::on_plane(0.01, 1.0, 0.0);
            Bodies([Body { roughness_m: first, ..a }, Body { roughness_m: second, ..b }]).film_ratio(1e-7)
        };
        let of = |modulus_pa, poisson| {
            let Bodies([a, b]) = Bodies::on_plane(0.01, 1.0, 0.0);
            Bodies([Body { modulus_pa, poisson, ..a }, b]).reduced_modulus_pa()
        };
        for (bad, said) in [
            (bodies([0.0, 1.0], [1.0; 2]).reduced_radius_m(), "other than 0"),
            (bodies([0.05, -0.05], [1.0; 2]).reduced_radius_m(), "flatter"),
            (bodies([0.05, -0.01], [1.0; 2]).reduced_radius_m(), "flatter"),
            (bodies([f64::INFINITY; 2], [1.0; 2]).reduced_radius_m(), "one surface must be curved"),
            (bodies([0.01; 2], [1.0, -1.0]).entrainment().map(|e| e.0), "carry no oil"),
            (rough(0.0, 0.0), "one above"),
            (rough(-1e-8, 1e-8), "at least 0"),
            (rough(f64::NAN, 1e-8), "at least 0"),
            (of(210e9, 0.6), "Poisson ratio"),
            (of(f64::INFINITY, 0.3), "Young's modulus"),
        ] {
            assert!(bad.unwrap_err().to_string().contains(said), "{said}");
        }
    }

    #[test]
    fn the_film_ratio_is_named() {
        let Bodies([a, b]) = Bodies::on_plane(0.01, 1.0, 0.0);
        let pair = Bodies([Body { roughness_m: 0.3e-6, ..a }, Body { roughness_m: 0.4e-6, ..b }]);
        assert!((pair.film_ratio(0.5e-6).unwrap() - 1.0).abs() < 1e-12);
        assert_eq!([0.5, 2.0, 3.5].map(film_regime), ["mixed to boundary", "mixed", "full film"]);
    }
}
