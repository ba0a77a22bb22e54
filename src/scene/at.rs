//! Operating point in the form that a scene file uses.

use crate::solver::physics::contact::{ContactError, ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::{Lubricant, Sliding};
use serde::{Deserialize, Serialize};

/// Operating point, in SI units or by its Moes numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum At {
    /// All six quantities in SI units.
    Si {
        /// Reduced radius R \[m\].
        radius: f64,
        /// Reduced radius R_y across the direction of entrainment \[m\], for an elliptical contact. If absent, equal to
        /// the radius.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_y: Option<f64>,
        /// Mean entrainment speed u_m \[m/s\].
        speed: f64,
        /// Load \[N/m\] (line) or \[N\] (point).
        load: f64,
        /// Reduced modulus E′ \[Pa\].
        modulus: f64,
        /// Viscosity at ambient pressure η₀ \[Pa·s\].
        viscosity: f64,
        /// Pressure–viscosity coefficient α \[1/Pa\]. If the viscosity law determines its own coefficient α*
        /// (Doolittle), α* is used instead.
        alpha: f64,
    },
    /// Moes numbers. Quantities that are given keep their values; the others follow from M and L or from the default
    /// realisation.
    Moes {
        /// Load number M.
        m: f64,
        /// Lubricant number L.
        l: f64,
        /// Fixed radius \[m\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius: Option<f64>,
        /// Reduced radius across \[m\], for an elliptical contact. If absent, equal to the radius.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_y: Option<f64>,
        /// Fixed speed \[m/s\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        speed: Option<f64>,
        /// Fixed load \[N/m\] or \[N\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        load: Option<f64>,
        /// Fixed reduced modulus \[Pa\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        modulus: Option<f64>,
        /// Fixed viscosity \[Pa·s\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        viscosity: Option<f64>,
        /// Fixed pressure–viscosity coefficient \[1/Pa\].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        alpha: Option<f64>,
    },
}

impl Default for At {
    /// M = 40, L = 10 in the default realisation.
    fn default() -> Self {
        Self::moes(40.0, 10.0)
    }
}

impl At {
    /// Returns a contact given by Moes numbers, in the default realisation.
    pub fn moes(m: f64, l: f64) -> Self {
        Self::Moes {
            m,
            l,
            radius: None,
            radius_y: None,
            speed: None,
            load: None,
            modulus: None,
            viscosity: None,
            alpha: None,
        }
    }

    /// Replaces α by the α* of the lubricant if its viscosity law determines one. Otherwise unchanged.
    pub fn with_alpha_of(mut self, lubricant: &Lubricant) -> Self {
        if let Some(own) = lubricant.own_coefficient() {
            match &mut self {
                Self::Si { alpha, .. } => *alpha = own,
                Self::Moes { alpha, .. } => *alpha = Some(own),
            }
        }
        self
    }

    /// Returns the operating point in SI units, checked.
    ///
    /// # Errors
    /// If a quantity is out of range, or if more quantities are fixed than M and L leave free.
    pub fn point(&self, kind: ContactKind) -> Result<OperatingPoint, ContactError> {
        match *self {
            Self::Si { radius, radius_y, speed, load, modulus, viscosity, alpha } => {
                let point = OperatingPoint {
                    kind,
                    radius_m: radius,
                    speed_m_per_s: speed,
                    load,
                    modulus_pa: modulus,
                    viscosity_pa_s: viscosity,
                    alpha_per_pa: alpha,
                    sliding: Sliding::NONE,
                    radius_y_m: radius_y,
                };
                point.check()?;
                Ok(point)
            }
            Self::Moes { m, l, radius, radius_y, speed, load, modulus, viscosity, alpha } => {
                check_given(kind, [radius, speed, load, modulus, viscosity, alpha])?;
                let request = MoesRequest {
                    kind,
                    m,
                    l,
                    radius_m: radius,
                    radius_y_m: radius_y,
                    speed_m_per_s: speed,
                    load,
                    modulus_pa: modulus,
                    viscosity_pa_s: viscosity,
                    alpha_per_pa: alpha,
                };
                si_from_moes(&request)
            }
        }
    }
}

/// Checks the given quantities first, so that a refusal names a given quantity and not one that follows from it.
fn check_given(kind: ContactKind, given: [Option<f64>; 6]) -> Result<(), ContactError> {
    let mut quantities = OperatingPoint::TABLE_2_1.quantities();
    for (quantity, given) in quantities.iter_mut().zip(given) {
        *quantity = given.unwrap_or(*quantity);
    }
    let [radius, speed, load, modulus, viscosity, alpha] = quantities;
    match (At::Si { radius, radius_y: None, speed, load, modulus, viscosity, alpha }).point(kind) {
        // Given quantities mixed with the defaults may have Moes numbers out of range. That is not an error here.
        Err(ContactError::OutOfRange { quantity, .. }) if quantity.starts_with("Moes") => Ok(()),
        result => result.map(|_| ()),
    }
}

impl From<OperatingPoint> for At {
    fn from(point: OperatingPoint) -> Self {
        let [radius, speed, load, modulus, viscosity, alpha] = point.quantities();
        Self::Si { radius, radius_y: point.radius_y_m, speed, load, modulus, viscosity, alpha }
    }
}
