//! Cam with a translating follower, flat or with a roller, on a line through the axis of the cam.
//!
//! Flat follower: R = r_b + s + s″, u₁ = ω R, u₂ = ω s″. Roller follower: the roller centre moves on the pitch curve
//! r = r_b + r_r + s of curvature κ; then R = r_r (1 − r_r κ), and both surfaces move with
//! ω √(r² + s′²) (1 − r_r κ) if the roller does not slide. Angles are in rad, dashes are derivatives with respect to the
//! cam angle. Sources: Dowson, Taylor and Zhu 1986 (flat followers); Norton, Cam Design and Manufacturing Handbook,
//! chapter 7 (curvature).

use super::contact::{MachineContact, Surface};
use super::error::{MachineError, check};
use super::lift::{Lift, LiftCurve};
use super::machine::positions;
use crate::solver::physics::contact::ContactKind;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Smallest radius of curvature of a cam \[m\].
const SHARPEST_M: f64 = 1e-5;

/// Cam with its follower, spring and mass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CamFollower {
    /// Flat or roller follower.
    pub follower: Follower,
    /// Lift over the cam angle.
    pub lift: Lift,
    /// Radius r_b of the base circle \[m\].
    pub base_radius_m: f64,
    /// Width of the contact \[m\].
    pub width_m: f64,
    /// Speed of the cam \[1/min\].
    pub rpm: f64,
    /// Force of the spring at zero lift \[N\].
    pub preload_n: f64,
    /// Spring rate \[N/m\].
    #[serde(default)]
    pub spring_n_per_m: f64,
    /// Moving mass \[kg\].
    #[serde(default)]
    pub mass_kg: f64,
    /// Cam angle \[°\].
    #[serde(default)]
    pub angle_deg: f64,
}

/// Form of the follower.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Follower {
    /// Flat face.
    Flat,
    /// Roller.
    Roller {
        /// Radius \[m\].
        radius_m: f64,
    },
}

/// State of the follower at its cam angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamState {
    /// Lift \[m\].
    pub lift_m: f64,
    /// Acceleration \[m/s²\].
    pub acceleration: f64,
    /// Pressure angle \[rad\]; 0 for a flat follower.
    pub pressure_angle: f64,
    /// Force normal to the surfaces \[N\].
    pub force_n: f64,
}

impl Default for CamFollower {
    /// Valve train with a flat follower.
    fn default() -> Self {
        Self {
            follower: Follower::Flat,
            lift: Lift::Polynomial { lift_m: 7e-3, half_event_deg: 75.0 },
            base_radius_m: 0.02,
            width_m: 0.012,
            rpm: 1500.0,
            preload_n: 250.0,
            spring_n_per_m: 25e3,
            mass_kg: 0.1,
            angle_deg: 0.0,
        }
    }
}

impl CamFollower {
    fn check(&self) -> Result<LiftCurve, MachineError> {
        let mm = (" mm", 1e-3);
        check("radius of the base circle", self.base_radius_m, mm, (0.1, 1e4))?;
        if let Follower::Roller { radius_m } = self.follower {
            check("radius of the roller", radius_m, mm, (0.1, 1e4))?;
        }
        check("width", self.width_m, mm, (0.1, 1e4))?;
        check("speed of the cam", self.rpm, (" rpm", 1.0), (1e-6, 1e6))?;
        check("preload", self.preload_n, (" N", 1.0), (0.0, 1e8))?;
        check("spring rate", self.spring_n_per_m, (" N/mm", 1e3), (0.0, 1e6))?;
        check("moving mass", self.mass_kg, (" kg", 1.0), (0.0, 1e4))?;
        check("cam angle", self.angle_deg, ("°", 1.0), (-720.0, 720.0))?;
        let curve = self.lift.curve()?;
        self.check_revolution(&curve)?;
        Ok(curve)
    }

    /// Refuses a cam that is pointed or loses its follower anywhere in a revolution. Names the worst angle.
    fn check_revolution(&self, curve: &LiftCurve) -> Result<(), MachineError> {
        let steps = (0..1440).map(|k| TAU * f64::from(k) / 1440.0 - 0.5 * TAU);
        let angles: Vec<f64> = steps.chain(curve.knots().iter().copied()).collect();
        let worst = |value: &dyn Fn(f64) -> f64| {
            let all = angles.iter().map(|angle| (*angle, value(*angle)));
            all.min_by(|one, other| one.1.total_cmp(&other.1)).unwrap_or((0.0, f64::INFINITY))
        };
        // For a roller R/r_r = 1 − r_r κ becomes zero where the cam is as sharp as it can be.
        let (angle, smallest) = worst(&|angle| self.radius(curve.at(angle)));
        if smallest.is_nan() || smallest <= SHARPEST_M {
            let (angle, radius) = (angle.to_degrees(), 1e3 * self.cam_radius(curve.at(angle)));
            let remedy = match self.follower {
                Follower::Flat => {
                    "a flat follower needs a convex cam: a larger base circle, less lift or a longer event"
                }
                Follower::Roller { .. } => {
                    "the roller undercuts it: a smaller roller or a larger base circle is needed"
                }
            };
            return Err(MachineError::Profile { angle, radius, remedy });
        }
        let (angle, least) = worst(&|angle| self.forces(curve.at(angle)).into_iter().sum());
        if least.is_nan() || least <= 0.0 {
            let [spring, inertia] = self.forces(curve.at(angle));
            return Err(MachineError::Separation { angle: angle.to_degrees(), spring, inertia: -inertia });
        }
        Ok(())
    }

    fn turning(&self) -> f64 {
        self.rpm * TAU / 60.0
    }

    /// Returns the forces of spring and inertia along the axis of the follower \[N\].
    fn forces(&self, [lift, _, second]: [f64; 3]) -> [f64; 2] {
        [self.preload_n + self.spring_n_per_m * lift, self.mass_kg * self.turning().powi(2) * second]
    }

    /// Returns radius vector of the pitch curve, its length per angle, and its curvature.
    fn pitch_curve(&self, roller_m: f64, [lift, slope, second]: [f64; 3]) -> (f64, f64, f64) {
        let radius = self.base_radius_m + roller_m + lift;
        let length = radius.hypot(slope);
        (radius, length, (radius * radius + 2.0 * slope * slope - radius * second) / length.powi(3))
    }

    /// Returns the reduced radius R \[m\].
    fn radius(&self, at: [f64; 3]) -> f64 {
        match self.follower {
            Follower::Flat => self.base_radius_m + at[0] + at[2],
            Follower::Roller { radius_m } => radius_m * (1.0 - radius_m * self.pitch_curve(radius_m, at).2),
        }
    }

    /// Returns the radius of curvature of the cam \[m\], negative for a hollow one.
    fn cam_radius(&self, at: [f64; 3]) -> f64 {
        match self.follower {
            Follower::Flat => self.radius(at),
            Follower::Roller { radius_m } => self.pitch_curve(radius_m, at).2.recip() - radius_m,
        }
    }

    /// Returns the state of the follower at its cam angle.
    ///
    /// # Errors
    /// A sentence if the cam does not exist or loses its follower.
    pub fn state(&self) -> Result<CamState, MachineError> {
        let curve = self.check()?;
        Ok(self.state_at(curve.at(self.angle_deg.to_radians())))
    }

    fn state_at(&self, at: [f64; 3]) -> CamState {
        let axial: f64 = self.forces(at).into_iter().sum();
        let pressure_angle = match self.follower {
            Follower::Flat => 0.0,
            Follower::Roller { radius_m } => at[1].atan2(self.pitch_curve(radius_m, at).0),
        };
        CamState {
            lift_m: at[0],
            acceleration: self.turning().powi(2) * at[2],
            pressure_angle,
            force_n: axial / pressure_angle.cos(),
        }
    }

    /// Returns the contact at the cam angle. Body 1 is the cam.
    ///
    /// # Errors
    /// A sentence if the cam does not exist or loses its follower.
    pub fn contact(&self) -> Result<MachineContact, MachineError> {
        let curve = self.check()?;
        Ok(self.at(&curve, self.angle_deg.to_radians()))
    }

    fn at(&self, curve: &LiftCurve, angle: f64) -> MachineContact {
        let (at, turning) = (curve.at(angle), self.turning());
        let surface = |along, speed_m_per_s| Surface { along, across: 0.0, speed_m_per_s };
        let surfaces = match self.follower {
            Follower::Flat => {
                let radius = self.radius(at);
                [surface(radius.recip(), turning * radius), surface(0.0, turning * at[2])]
            }
            Follower::Roller { radius_m } => {
                let (_, length, curvature) = self.pitch_curve(radius_m, at);
                let rest = 1.0 - radius_m * curvature;
                let speed = turning * length * rest;
                [surface(curvature / rest, speed), surface(radius_m.recip(), speed)]
            }
        };
        MachineContact {
            kind: ContactKind::Line,
            position: angle,
            time_s: angle / turning,
            surfaces,
            load: self.state_at(at).force_n / self.width_m,
            length_m: Some(self.width_m),
        }
    }

    /// Returns the cam angles \[rad\] between which the follower moves.
    ///
    /// # Errors
    /// A sentence if the cam does not exist or loses its follower.
    pub fn extent(&self) -> Result<(f64, f64), MachineError> {
        self.check().map(|_| self.lift.event())
    }

    /// Returns contacts over the cam angles of [`CamFollower::extent`].
    ///
    /// # Errors
    /// A sentence if the cam does not exist or loses its follower.
    pub fn path(&self, count: usize) -> Result<Vec<MachineContact>, MachineError> {
        let curve = self.check()?;
        Ok(positions(self.lift.event(), count).map(|angle| self.at(&curve, angle)).collect())
    }
}

#[cfg(test)]
#[path = "cam_tests.rs"]
mod tests;
