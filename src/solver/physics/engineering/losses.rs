//! Friction forces, torques and power loss of a whole contact.
//!
//! F is the friction force, the traction coefficient times the load, and F_r the rolling resistance of each body,
//! ½∫h dp. The shear stresses at the surfaces are those at mid-film ∓ ½ h dp/dx. Along the direction of motion the film
//! therefore acts on body 1 with F − F_r and on body 2 with −F − F_r. With the surface speeds u₁ = u_m (1 − SRR/2) and
//! u₂ = u_m (1 + SRR/2) the power loss is F SRR u_m + 2 F_r u_m.

use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// Dimensions of the bodies that do not enter the solution: length of a line contact, radii of the bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Extent {
    /// Length of a line contact \[m\]; `None` if only values per length are wanted.
    pub length_m: Option<f64>,
    /// Radii of body 1 and body 2 along the rolling direction \[m\], negative for a concave surface; `None` for a plane
    /// or if they are not given.
    pub radii_m: [Option<f64>; 2],
}

impl Extent {
    /// Accepted lengths \[m\].
    pub const LENGTHS_M: (f64, f64) = (1e-6, 100.0);

    /// True if nothing is given.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Forces, torques and power loss of a whole contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// Load \[N\].
    pub load_n: f64,
    /// Friction force F \[N\]; positive for SRR > 0.
    pub friction_n: f64,
    /// Rolling resistance F_r of each body \[N\].
    pub rolling_n: f64,
    /// Torque about the axis of each body that resists its rotation \[N m\]; negative where the other body drives it.
    /// `None` without a radius.
    pub torques_nm: [Option<f64>; 2],
    /// Power loss \[W\], from sliding and rolling.
    pub power_w: f64,
}

impl Losses {
    /// Returns the losses of a contact with this traction coefficient and rolling resistance (\[N/m\] for a line
    /// contact, \[N\] for a point contact). `None` for a line contact without a length.
    pub fn of(point: &OperatingPoint, traction: f64, rolling_resistance: f64, extent: &Extent) -> Option<Self> {
        let length = if point.kind.is_line() { extent.length_m? } else { 1.0 };
        let load_n = point.load * length;
        let (friction_n, rolling_n) = (traction * load_n, rolling_resistance * length);
        let resisting = [rolling_n - friction_n, rolling_n + friction_n];
        let torque = |body: usize| Some(resisting.get(body)? * extent.radii_m.get(body).copied().flatten()?.abs());
        let sliding = point.sliding.slide_to_roll_ratio;
        let power_w = point.speed_m_per_s * (friction_n * sliding + 2.0 * rolling_n);
        Some(Self { load_n, friction_n, rolling_n, torques_nm: [torque(0), torque(1)], power_w })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::contact::Sliding;

    #[test]
    fn the_power_of_both_torques_is_the_power_loss() {
        for srr in [0.0, 0.3, -0.8] {
            let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
            let point = OperatingPoint { sliding, ..OperatingPoint::TABLE_2_1 };
            let extent = Extent { length_m: Some(0.01), radii_m: [Some(0.03), Some(-0.05)] };
            let losses = Losses::of(&point, 0.05 * srr.signum() * f64::from(srr != 0.0), 12.0, &extent).unwrap();
            let [first, second] = losses.torques_nm.map(Option::unwrap);
            let [u1, u2] = point.surface_speeds();
            let power = first * u1 / 0.03 + second * u2 / 0.05;
            assert!((power / losses.power_w - 1.0).abs() < 1e-12, "{srr}: {power} {losses:?}");
            assert!((losses.rolling_n - 0.12).abs() < 1e-15 && losses.load_n == 6461.1);
            assert!(losses.power_w > 0.0 && (srr <= 0.0 || first < 0.0 && second > 0.0));
        }
        assert_eq!(Losses::of(&OperatingPoint::TABLE_2_1, 0.0, 1.0, &Extent::default()), None);
    }
}
