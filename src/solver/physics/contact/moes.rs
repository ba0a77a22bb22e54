//! Conversion from Moes numbers to SI quantities.

use super::{ContactError, ContactKind, Moes, OperatingPoint, Sliding};

/// Moes numbers M and L with any fixed SI quantities. The other quantities follow or have the values of the default
/// realisation.
///
/// Default realisation of a line contact: R 3 mm, E′ 231 GPa, η₀ 0.01 Pa·s, α = 5/GPa · L^0.463, u_m from L, w from
/// M. Point contact: R 10 mm and α = 5/GPa · (L/1.7)^0.655.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct MoesRequest {
    /// Line or point contact.
    pub kind: ContactKind,
    /// Load number M.
    pub m: f64,
    /// Lubricant number L.
    pub l: f64,
    /// Fixed radius \[m\].
    pub radius_m: Option<f64>,
    /// Radius across \[m\]; `None` if it equals the radius along.
    pub radius_y_m: Option<f64>,
    /// Fixed speed \[m/s\].
    pub speed_m_per_s: Option<f64>,
    /// Fixed load \[N/m\] or \[N\].
    pub load: Option<f64>,
    /// Fixed reduced modulus \[Pa\].
    pub modulus_pa: Option<f64>,
    /// Fixed ambient viscosity \[Pa·s\].
    pub viscosity_pa_s: Option<f64>,
    /// Fixed pressure–viscosity coefficient \[1/Pa\].
    pub alpha_per_pa: Option<f64>,
}

/// Reduced modulus E′ of the default realisation \[Pa\].
pub const DEFAULT_MODULUS_PA: f64 = 231e9;
/// Viscosity η₀ of the default realisation \[Pa·s\].
pub const DEFAULT_VISCOSITY_PA_S: f64 = 0.01;
/// Speed u_m of the default realisation at L = 0, where it does not follow from L \[m/s\].
const DEFAULT_SPEED_M_PER_S: f64 = 1.0;

impl MoesRequest {
    /// Creates a request for M and L in the default realisation.
    pub fn new(kind: ContactKind, m: f64, l: f64) -> Self {
        Self { kind, m, l, ..Self::default() }
    }

    fn default_radius(&self) -> f64 {
        if self.kind.is_line() { 3e-3 } else { 10e-3 }
    }

    /// Returns α of the default realisation \[1/Pa\].
    pub fn default_alpha(&self) -> f64 {
        if self.kind.is_line() { 5e-9 * self.l.powf(0.463) } else { 5e-9 * (self.l / 1.7).powf(0.655) }
    }
}

/// Returns the operating point with the requested Moes numbers (inverse of (3.19), (3.22)).
///
/// The dependent quantities follow from the fixed ones:
///
/// - none of speed, load, radius: speed from L, load from M;
/// - speed: α from L;
/// - load: radius from M;
/// - load and speed: radius from M, α from L;
/// - load and radius: speed from M, α from L.
///
/// At L = 0, α is zero, and the speed is free as well: 1 m/s unless it, or radius and load, are fixed.
///
/// # Errors
/// If more quantities are fixed than M and L leave free, or if the result is outside the accepted range.
pub fn si_from_moes(request: &MoesRequest) -> Result<OperatingPoint, ContactError> {
    let MoesRequest { m, l, .. } = *request;
    Moes { m, l }.check()?;
    let overdetermined = |given: &'static str| Err(ContactError::Overdetermined { given });
    if let Some(alpha) = request.alpha_per_pa
        && (alpha == 0.0) != (l == 0.0)
    {
        return Err(ContactError::Isoviscous { alpha, l });
    }
    if l == 0.0 {
        let speed = match (request.radius_m, request.load, request.speed_m_per_s) {
            (Some(_), Some(_), Some(_)) => return overdetermined("radius, speed and load"),
            (Some(_), Some(_), None) => None,
            (_, _, speed) => speed.or(Some(DEFAULT_SPEED_M_PER_S)),
        };
        // α follows from L below, as 0.
        return si_from_moes_with(&MoesRequest { speed_m_per_s: speed, alpha_per_pa: None, ..*request });
    }
    si_from_moes_with(request)
}

/// Returns the operating point for a request in which L and α are consistent.
fn si_from_moes_with(request: &MoesRequest) -> Result<OperatingPoint, ContactError> {
    let MoesRequest { kind, m, l, .. } = *request;
    let e = request.modulus_pa.unwrap_or(DEFAULT_MODULUS_PA);
    let eta = request.viscosity_pa_s.unwrap_or(DEFAULT_VISCOSITY_PA_S);
    let radius_default = request.default_radius();
    // The load is E′ R^d u^q M with the speed group u = 2 η₀ u_m / (E′ R).
    let (d, q) = (f64::from(kind.radius_power()), kind.speed_power());
    let group_of_alpha = |alpha: f64| (l / (alpha * e)).powi(4);
    let alpha_of_group = |group: f64| l / (e * group.powf(0.25));
    let overdetermined = |given: &'static str| Err(ContactError::Overdetermined { given });
    let (radius, group, alpha) = match (request.radius_m, request.speed_m_per_s, request.load, request.alpha_per_pa) {
        (radius, None, None, alpha) => {
            let alpha = alpha.unwrap_or_else(|| request.default_alpha());
            (radius.unwrap_or(radius_default), group_of_alpha(alpha), alpha)
        }
        (radius, Some(speed), None, None) => {
            let radius = radius.unwrap_or(radius_default);
            let group = 2.0 * eta * speed / (e * radius);
            (radius, group, alpha_of_group(group))
        }
        (None, Some(speed), None, Some(alpha)) => {
            let group = group_of_alpha(alpha);
            (2.0 * eta * speed / (e * group), group, alpha)
        }
        (None, None, Some(load), alpha) => {
            let alpha = alpha.unwrap_or_else(|| request.default_alpha());
            let group = group_of_alpha(alpha);
            ((load / (e * m * group.powf(q))).powf(1.0 / d), group, alpha)
        }
        (Some(radius), None, Some(load), None) => {
            let group = (load / (e * radius.powf(d) * m)).powf(1.0 / q);
            (radius, group, alpha_of_group(group))
        }
        (None, Some(speed), Some(load), None) => {
            // w = E′ R^(d−q) (2 η₀ u / E′)^q M
            let radius = (load / (e * m * (2.0 * eta * speed / e).powf(q))).powf(1.0 / (d - q));
            let group = 2.0 * eta * speed / (e * radius);
            (radius, group, alpha_of_group(group))
        }
        (Some(_), Some(_), Some(_), _) => return overdetermined("radius, speed and load"),
        (Some(_), Some(_), None, Some(_)) => return overdetermined("radius, speed and alpha"),
        (Some(_), None, Some(_), Some(_)) => return overdetermined("radius, load and alpha"),
        (None, Some(_), Some(_), Some(_)) => return overdetermined("speed, load and alpha"),
    };
    let point = OperatingPoint {
        kind,
        radius_m: radius,
        speed_m_per_s: group * e * radius / (2.0 * eta),
        load: request.load.unwrap_or(e * radius.powf(d) * group.powf(q) * m),
        modulus_pa: e,
        viscosity_pa_s: eta,
        alpha_per_pa: alpha,
        sliding: Sliding::NONE,
        radius_y_m: request.radius_y_m,
    };
    point.check()?;
    Ok(point)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_choice_of_followers_returns_the_requested_numbers() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let (load, m) = if kind == ContactKind::Line { (2e5, 40.0) } else { (60.0, 200.0) };
            let base = MoesRequest::new(kind, m, 8.0);
            for request in [
                base,
                MoesRequest { radius_m: Some(0.02), ..base },
                MoesRequest { speed_m_per_s: Some(2.0), ..base },
                MoesRequest { alpha_per_pa: Some(2e-8), ..base },
                MoesRequest { load: Some(load), ..base },
                MoesRequest { load: Some(load), speed_m_per_s: Some(1.0), ..base },
                MoesRequest { load: Some(load), radius_m: Some(0.01), ..base },
                MoesRequest { speed_m_per_s: Some(1.5), alpha_per_pa: Some(1e-8), ..base },
                MoesRequest { modulus_pa: Some(1e11), viscosity_pa_s: Some(0.04), ..base },
            ] {
                let point = si_from_moes(&request).unwrap();
                let moes = point.moes();
                assert!((moes.m / request.m - 1.0).abs() < 1e-10, "{request:?}");
                assert!((moes.l / request.l - 1.0).abs() < 1e-10, "{request:?}");
                for (given, got) in [
                    (request.radius_m, point.radius_m),
                    (request.speed_m_per_s, point.speed_m_per_s),
                    (request.load, point.load),
                    (request.alpha_per_pa, point.alpha_per_pa),
                ] {
                    assert!(given.is_none_or(|g| (g / got - 1.0).abs() < 1e-10), "{request:?}");
                }
            }
        }
    }

    #[test]
    fn the_default_realisation_is_the_one_of_the_design() {
        let point = si_from_moes(&MoesRequest::new(ContactKind::Line, 40.0, 10.0)).unwrap();
        assert_eq!((point.radius_m, point.modulus_pa, point.viscosity_pa_s), (3e-3, 231e9, 0.01));
        assert!((point.alpha_per_pa - 5e-9 * 10f64.powf(0.463)).abs() < 1e-20);
    }

    #[test]
    fn isoviscous_contacts_have_no_alpha_and_a_free_speed() {
        for kind in [ContactKind::Line, ContactKind::Point] {
            let base = MoesRequest::new(kind, 30.0, 0.0);
            let load = Some(if kind == ContactKind::Line { 5e4 } else { 5.0 });
            for request in [
                base,
                MoesRequest { alpha_per_pa: Some(0.0), ..base },
                MoesRequest { speed_m_per_s: Some(0.2), modulus_pa: Some(1e7), ..base },
                MoesRequest { load, ..base },
                MoesRequest { load, radius_m: Some(0.02), ..base },
            ] {
                let point = si_from_moes(&request).unwrap();
                assert!((point.moes().m / 30.0 - 1.0).abs() < 1e-10, "{request:?}");
                assert_eq!((point.alpha_per_pa, point.moes().l), (0.0, 0.0), "{request:?}");
            }
            for wrong in [
                MoesRequest { alpha_per_pa: Some(1e-8), ..base },
                MoesRequest { alpha_per_pa: Some(0.0), l: 5.0, ..base },
            ] {
                assert!(si_from_moes(&wrong).unwrap_err().to_string().contains("proportional"), "{wrong:?}");
            }
        }
    }

    #[test]
    fn fixing_too_much_is_refused() {
        let request = MoesRequest {
            radius_m: Some(0.01),
            speed_m_per_s: Some(1.0),
            load: Some(1e5),
            ..MoesRequest::new(ContactKind::Line, 40.0, 10.0)
        };
        assert!(si_from_moes(&request).unwrap_err().to_string().contains("radius, speed and load"));
        assert!(si_from_moes(&MoesRequest::new(ContactKind::Line, f64::NAN, 10.0)).is_err());
    }
}
