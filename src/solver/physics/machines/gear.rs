//! Pair of external involute gears, spur or helical: geometry without backlash, and the contact of a pair of flanks
//! along the path of contact.
//!
//! Sources: Niemann and Winter, Maschinenelemente II, chapter 21, and DIN 3960 (geometry); ISO 6336-2 (length of the
//! lines of contact). A pair of spur teeth carries ⅓ of the load where it enters, rising linearly to ⅔, all of it
//! while it is the only one, and ⅔ falling to ⅓ where it leaves. Helical teeth with an overlap ratio of 1 or more
//! spread the load evenly over the mean length of the lines of contact. Between both the share is linear in the
//! overlap ratio, as in the factor Z_ε of ISO 6336-2.

use super::contact::{MachineContact, Surface};
use super::error::{MachineError, check};
use super::machine::positions;
use crate::solver::physics::contact::ContactKind;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Addendum of the basic rack over the module; also that of the tool without its tip rounding.
const ADDENDUM: f64 = 1.0;
/// Names of both gears in sentences.
const NAMES: [&str; 2] = ["pinion", "wheel"];

/// Pair of external involute gears. Body 1 is the pinion, which drives.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GearPair {
    /// Numbers of teeth of pinion and wheel.
    pub teeth: (u32, u32),
    /// Normal module m_n \[m\].
    pub module_m: f64,
    /// Normal pressure angle α_n \[°\].
    #[serde(default = "twenty")]
    pub pressure_angle_deg: f64,
    /// Helix angle β \[°\]; 0 for spur gears.
    #[serde(default)]
    pub helix_angle_deg: f64,
    /// Profile shift coefficients x₁ and x₂.
    #[serde(default)]
    pub shifts: (f64, f64),
    /// Common face width b \[m\].
    pub face_width_m: f64,
    /// Speed of the pinion \[1/min\].
    pub pinion_rpm: f64,
    /// Torque on the pinion \[N m\].
    pub torque_n_m: f64,
    /// Distance of the contact from the pitch point along the path of contact \[m\], negative where the teeth approach.
    #[serde(default)]
    pub position_m: f64,
}

fn twenty() -> f64 {
    20.0
}

/// Geometry of a gear pair that meshes without backlash, in the transverse plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GearGeometry {
    /// Centre distance a \[m\].
    pub centre_distance_m: f64,
    /// Working pressure angle α_wt \[rad\].
    pub working_angle: f64,
    /// Base radii \[m\].
    pub base_radii_m: [f64; 2],
    /// Tip radii \[m\], shortened so that the tip clearance is kept.
    pub tip_radii_m: [f64; 2],
    /// Radii of curvature of both flanks at the pitch point \[m\].
    pub pitch_curvature_m: [f64; 2],
    /// First and last contact \[m\], measured from the pitch point.
    pub path: (f64, f64),
    /// Transverse base pitch p_bt \[m\].
    pub base_pitch_m: f64,
    /// Transverse contact ratio ε_α.
    pub contact_ratio: f64,
    /// Overlap ratio ε_β.
    pub overlap_ratio: f64,
    /// Base helix angle β_b \[rad\].
    pub base_helix: f64,
}

impl Default for GearPair {
    /// FZG test gears of type C at 200 N m and 1500 rpm.
    fn default() -> Self {
        Self {
            teeth: (16, 24),
            module_m: 4.5e-3,
            pressure_angle_deg: 20.0,
            helix_angle_deg: 0.0,
            shifts: (0.1817, 0.1715),
            face_width_m: 0.014,
            pinion_rpm: 1500.0,
            torque_n_m: 200.0,
            position_m: 0.0,
        }
    }
}

fn involute(angle: f64) -> f64 {
    angle.tan() - angle
}

/// Returns the angle \[rad\] of an involute function, which must be positive.
fn angle_of_involute(value: f64) -> f64 {
    // The function is convex, so that Newton's method converges monotonically from a larger angle.
    let mut angle = (3.0 * value).cbrt().min(1.5);
    for _ in 0..60 {
        let step = (involute(angle) - value) / angle.tan().powi(2);
        angle -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    angle
}

impl GearPair {
    fn check(&self) -> Result<(), MachineError> {
        for (name, teeth) in
            ["number of teeth of the pinion", "number of teeth of the wheel"].into_iter().zip(self.pair())
        {
            check(name, f64::from(teeth), ("", 1.0), (5.0, 1000.0))?;
        }
        check("module", self.module_m, (" mm", 1e-3), (0.05, 100.0))?;
        check("pressure angle", self.pressure_angle_deg, ("°", 1.0), (10.0, 35.0))?;
        check("helix angle", self.helix_angle_deg, ("°", 1.0), (0.0, 45.0))?;
        for (name, shift) in ["profile shift of the pinion", "profile shift of the wheel"].into_iter().zip(self.shift())
        {
            check(name, shift, ("", 1.0), (-2.0, 2.0))?;
        }
        check("face width", self.face_width_m, (" mm", 1e-3), (0.1, 1e4))?;
        check("speed of the pinion", self.pinion_rpm, (" rpm", 1.0), (1e-6, 1e6))?;
        check("torque on the pinion", self.torque_n_m, (" N m", 1.0), (1e-9, 1e9))
    }

    fn pair(&self) -> [u32; 2] {
        [self.teeth.0, self.teeth.1]
    }

    fn shift(&self) -> [f64; 2] {
        [self.shifts.0, self.shifts.1]
    }

    /// Returns the geometry of the pair.
    ///
    /// # Errors
    /// A sentence if a value is out of range, a gear is undercut or pointed, or the teeth do not mesh continuously.
    pub fn geometry(&self) -> Result<GearGeometry, MachineError> {
        self.check()?;
        let (normal, helix) = (self.pressure_angle_deg.to_radians(), self.helix_angle_deg.to_radians());
        let transverse = (normal.tan() / helix.cos()).atan();
        let teeth = self.pair().map(f64::from);
        for ((gear, teeth), shift) in NAMES.into_iter().zip(self.pair()).zip(self.shift()) {
            let least = ADDENDUM - f64::from(teeth) * transverse.sin().powi(2) / (2.0 * helix.cos());
            if shift < least {
                return Err(MachineError::Undercut { gear, teeth, shift, least });
            }
        }
        let transverse_module = self.module_m / helix.cos();
        let pitch_radii = teeth.map(|teeth| 0.5 * teeth * transverse_module);
        let base_radii_m = pitch_radii.map(|radius| radius * transverse.cos());
        let (shifts, both) = (self.shifts.0 + self.shifts.1, teeth[0] + teeth[1]);
        let working = involute(transverse) + 2.0 * shifts / both * normal.tan();
        if working <= 0.0 {
            return Err(MachineError::NoMesh(self.shifts.0, self.shifts.1));
        }
        let working_angle = angle_of_involute(working);
        let centre_distance_m = (base_radii_m[0] + base_radii_m[1]) / working_angle.cos();
        let moved = (centre_distance_m - pitch_radii[0] - pitch_radii[1]) / self.module_m;
        let shortening = shifts - moved;
        let tip = |k: usize| pitch_radii[k] + self.module_m * (ADDENDUM + self.shift()[k] - shortening);
        let tip_radii_m = [tip(0), tip(1)];
        for k in 0..2 {
            let at_tip = (base_radii_m[k] / tip_radii_m[k]).min(1.0).acos();
            let half = (0.5 * PI + 2.0 * self.shift()[k] * normal.tan()) / teeth[k] + involute(transverse);
            if half <= involute(at_tip) {
                return Err(MachineError::Pointed { gear: NAMES[k], shift: self.shift()[k] });
            }
        }
        // Lengths of the involutes up to the tip, and of the line between both base circles.
        let reach = [0, 1].map(|k| (tip_radii_m[k].powi(2) - base_radii_m[k].powi(2)).max(0.0).sqrt());
        let pitch_curvature_m = base_radii_m.map(|radius| radius * working_angle.tan());
        let line = pitch_curvature_m[0] + pitch_curvature_m[1];
        for k in 0..2 {
            if reach[k] >= line {
                return Err(MachineError::Interference { gear: NAMES[k] });
            }
        }
        let path = (pitch_curvature_m[1] - reach[1], reach[0] - pitch_curvature_m[0]);
        let base_pitch_m = PI * transverse_module * transverse.cos();
        let contact_ratio = (path.1 - path.0) / base_pitch_m;
        if !(1.0..2.0).contains(&contact_ratio) {
            return Err(MachineError::ContactRatio(contact_ratio));
        }
        Ok(GearGeometry {
            centre_distance_m,
            working_angle,
            base_radii_m,
            tip_radii_m,
            pitch_curvature_m,
            path,
            base_pitch_m,
            contact_ratio,
            overlap_ratio: self.face_width_m * helix.sin() / (PI * self.module_m),
            base_helix: (helix.sin() * normal.cos()).asin(),
        })
    }

    /// Returns the contact of the flanks at its position.
    ///
    /// # Errors
    /// A sentence if the pair does not exist, or if the position lies beyond the path of contact.
    pub fn contact(&self) -> Result<MachineContact, MachineError> {
        self.at(&self.geometry()?, self.position_m)
    }

    /// Returns contacts along the path of contact.
    ///
    /// # Errors
    /// A sentence if the pair does not exist.
    pub fn path(&self, count: usize) -> Result<Vec<MachineContact>, MachineError> {
        let geometry = self.geometry()?;
        positions(geometry.path, count).map(|position| self.at(&geometry, position)).collect()
    }

    fn at(&self, geometry: &GearGeometry, position: f64) -> Result<MachineContact, MachineError> {
        let (from, to) = geometry.path;
        // The last position of a path may miss its end by rounding.
        let slack = 1e-9 * (to - from);
        if !(from - slack..=to + slack).contains(&position) {
            let [position, from, to] = [position, from, to].map(|length| 1e3 * length);
            return Err(MachineError::OffThePath { position, from, to });
        }
        let pinion = self.pinion_rpm * TAU / 60.0;
        let wheel = pinion * f64::from(self.teeth.0) / f64::from(self.teeth.1);
        let [first, second] = geometry.pitch_curvature_m;
        let surface = |radius: f64, turning: f64| Surface {
            along: geometry.base_helix.cos() / radius,
            across: 0.0,
            speed_m_per_s: turning * radius,
        };
        let force = self.torque_n_m / geometry.base_radii_m[0];
        Ok(MachineContact {
            kind: ContactKind::Line,
            position,
            time_s: position / (geometry.base_radii_m[0] * pinion),
            surfaces: [surface(first + position, pinion), surface(second - position, wheel)],
            load: geometry.share(position) * force / self.face_width_m,
            length_m: Some(self.face_width_m / geometry.base_helix.cos()),
        })
    }
}

impl GearGeometry {
    /// Returns the load per length of the contact over that of a single pair of spur teeth, at a position \[m\].
    pub fn share(&self, position: f64) -> f64 {
        let even = 1.0 / self.contact_ratio;
        let overlap = self.overlap_ratio.min(1.0);
        (1.0 - overlap) * self.spur_share(position) + overlap * even
    }

    fn spur_share(&self, position: f64) -> f64 {
        let (from, to) = self.path;
        let double = to - from - self.base_pitch_m;
        let (after, before) = (position - from, to - position);
        let nearest = after.min(before).max(0.0);
        if nearest < double { (1.0 + nearest / double) / 3.0 } else { 1.0 }
    }
}

#[cfg(test)]
#[path = "gear_tests.rs"]
mod tests;
