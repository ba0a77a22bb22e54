//! Contact of a machine element at one position of its path.

use crate::solver::physics::bodies::{Bodies, BodyError};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};

/// Surface of one body at the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface {
    /// Curvature along the rolling direction \[1/m\], negative for a concave surface, 0 for a plane.
    pub along: f64,
    /// Curvature across the rolling direction \[1/m\].
    pub across: f64,
    /// Speed relative to the contact \[m/s\].
    pub speed_m_per_s: f64,
}

/// Contact of a machine element at one position of its path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MachineContact {
    /// Line or point contact.
    pub kind: ContactKind,
    /// Position on the path: orbit angle of the rolling element \[rad\], distance from the pitch point \[m\], or cam
    /// angle \[rad\].
    pub position: f64,
    /// Time at which the contact passes the position \[s\], from position 0.
    pub time_s: f64,
    /// Surfaces of body 1 and body 2.
    pub surfaces: [Surface; 2],
    /// Load: \[N/m\] for a line contact, \[N\] for a point contact.
    pub load: f64,
    /// Length of a line contact \[m\]; `None` for a point contact.
    pub length_m: Option<f64>,
}

impl MachineContact {
    /// Returns the mean entrainment speed \[m/s\]. It is negative if the lubricant enters from the other side.
    pub fn mean_speed(&self) -> f64 {
        let [first, second] = self.surfaces;
        0.5 * (first.speed_m_per_s + second.speed_m_per_s)
    }

    /// Returns the reduced radius R along the rolling direction \[m\].
    pub fn radius_m(&self) -> f64 {
        let [first, second] = self.surfaces;
        1.0 / (first.along + second.along)
    }

    /// Returns the two bodies with these radii and speeds, and with materials and roughness of `base`. X points in the
    /// direction of entrainment, so that the mean speed is not negative.
    pub fn bodies(&self, base: Bodies) -> Bodies {
        let sign = if self.mean_speed() < 0.0 { -1.0 } else { 1.0 };
        let radius = |curvature: f64| Some(curvature.recip()).filter(|radius| radius.is_finite());
        let mut bodies = base;
        for (body, surface) in bodies.0.iter_mut().zip(self.surfaces) {
            body.radius_m = radius(surface.along);
            body.speed_m_per_s = sign * surface.speed_m_per_s;
            *body = body.with_transverse_radius_m(radius(surface.across));
        }
        bodies
    }

    /// Returns the operating point of this contact: R, R_y, E′, u_m, SRR and load of the machine, the lubricant of
    /// `point`.
    ///
    /// # Errors
    /// If the bodies do not form a contact, or entrain no lubricant.
    pub fn operating_point(&self, base: Bodies, point: OperatingPoint) -> Result<OperatingPoint, BodyError> {
        let point = OperatingPoint { kind: self.kind, load: self.load, radius_y_m: None, ..point };
        self.bodies(base).contact(point)
    }
}
