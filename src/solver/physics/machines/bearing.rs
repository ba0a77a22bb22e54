//! Rolling bearing: geometry, kinematics at pure rolling, and the contact of one element with a ring.
//!
//! Sources: Harris, Rolling Bearing Analysis, 4th ed., chapters 2 (geometry), 6 (deformation), 7 (load distribution)
//! and 8 (speeds); Hamrock and Dowson, Ball Bearing Lubrication, chapter 2.

use super::contact::{MachineContact, Surface};
use super::error::{MachineError, check};
use super::load_distribution::{Displacement, Springs};
use super::machine::positions;
use crate::solver::physics::contact::{ContactKind, Ellipse};
use ellip::elliprf;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Share of the largest load at which the path over the orbit angle begins and ends.
const EDGE: f64 = 0.05;
/// E′ \[Pa\] of Palmgren's formula for steel rollers.
const STEEL_PA: f64 = 2.264e11;

/// Rolling bearing with loads and speeds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bearing {
    /// Balls or rollers.
    pub element: Element,
    /// Pitch diameter d_m \[m\].
    pub pitch_diameter_m: f64,
    /// Diameter D of the elements \[m\].
    pub element_diameter_m: f64,
    /// Number Z of elements.
    pub elements: u32,
    /// Diametral clearance P_d \[m\]; negative for a radial preload.
    #[serde(default)]
    pub clearance_m: f64,
    /// Speed of the inner ring \[1/min\].
    pub inner_rpm: f64,
    /// Speed of the outer ring \[1/min\].
    #[serde(default)]
    pub outer_rpm: f64,
    /// Radial load F_r \[N\].
    pub radial_n: f64,
    /// Axial load F_a \[N\].
    #[serde(default)]
    pub axial_n: f64,
    /// Ring of the contact.
    #[serde(default)]
    pub race: Race,
    /// Angle of the element from the direction of the radial load \[°\].
    #[serde(default)]
    pub orbit_deg: f64,
}

/// Rolling elements and what belongs to their form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Element {
    /// Balls in grooves.
    Ball {
        /// Groove radius of the inner ring over D, f_i.
        inner_conformity: f64,
        /// Groove radius of the outer ring over D, f_o.
        outer_conformity: f64,
        /// Contact angle α of the unloaded bearing without clearance \[°\]; 0 for a deep-groove bearing.
        #[serde(default)]
        contact_angle_deg: f64,
    },
    /// Cylindrical rollers.
    Roller {
        /// Effective length \[m\].
        length_m: f64,
        /// Radius of the crown \[m\]. The contact is then elliptical. If absent, it is a line contact.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        crown_radius_m: Option<f64>,
    },
}

/// Ring of a bearing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Race {
    /// Inner ring.
    #[default]
    Inner,
    /// Outer ring.
    Outer,
}

/// Loaded state of a bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BearingState {
    /// Largest load of an element \[N\].
    pub largest_load_n: f64,
    /// Contact angle of that element \[rad\].
    pub contact_angle: f64,
    /// Half of the loaded zone \[rad\], π if all elements are loaded.
    pub loaded_zone: f64,
    /// Radial displacement of the inner ring \[m\].
    pub radial_displacement_m: f64,
    /// Axial displacement of the inner ring \[m\].
    pub axial_displacement_m: f64,
    /// Speed of the cage \[rad/s\].
    pub cage_speed: f64,
    springs: Springs,
}

impl Default for Bearing {
    /// Deep-groove ball bearing 6206: 9 balls of 9.525 mm on a pitch diameter of 46 mm, in grooves of 52 %.
    fn default() -> Self {
        Self {
            element: Element::BALL,
            pitch_diameter_m: 0.046,
            element_diameter_m: 0.009_525,
            elements: 9,
            clearance_m: 1e-5,
            inner_rpm: 1500.0,
            outer_rpm: 0.0,
            radial_n: 2000.0,
            axial_n: 0.0,
            race: Race::Inner,
            orbit_deg: 0.0,
        }
    }
}

impl Element {
    /// Balls in grooves of 52 %.
    pub const BALL: Self = Self::Ball { inner_conformity: 0.52, outer_conformity: 0.52, contact_angle_deg: 0.0 };
    /// Cylindrical rollers of a small bearing.
    pub const ROLLER: Self = Self::Roller { length_m: 0.0096, crown_radius_m: None };
}

impl Bearing {
    /// Refuses values out of range and bearings that do not exist.
    ///
    /// # Errors
    /// A sentence with the value and what is accepted.
    pub fn check(&self) -> Result<(), MachineError> {
        let mm = (" mm", 1e-3);
        check("pitch diameter", self.pitch_diameter_m, mm, (1.0, 2e4))?;
        check("diameter of the elements", self.element_diameter_m, mm, (0.1, 5e3))?;
        check("number of elements", f64::from(self.elements), ("", 1.0), (3.0, 500.0))?;
        let ratio = self.element_diameter_m / self.pitch_diameter_m;
        let most = if ratio < 1.0 { (PI / ratio.asin()).floor() } else { 0.0 };
        if f64::from(self.elements) > most {
            return Err(MachineError::Crowded {
                elements: self.elements,
                diameter: 1e3 * self.element_diameter_m,
                pitch: 1e3 * self.pitch_diameter_m,
                most: most as u32,
            });
        }
        check("clearance", self.clearance_m, mm, (-0.5, 5.0))?;
        check("inner speed", self.inner_rpm, (" rpm", 1.0), (-1e6, 1e6))?;
        check("outer speed", self.outer_rpm, (" rpm", 1.0), (-1e6, 1e6))?;
        check("radial load", self.radial_n, (" N", 1.0), (0.0, 1e9))?;
        check("axial load", self.axial_n, (" N", 1.0), (0.0, 1e9))?;
        check("orbit angle", self.orbit_deg, ("°", 1.0), (-180.0, 180.0))?;
        if self.inner_rpm == self.outer_rpm {
            return Err(MachineError::NothingRolls(self.inner_rpm));
        }
        if self.radial_n == 0.0 && self.axial_n == 0.0 {
            return Err(MachineError::NoLoad);
        }
        self.check_element()
    }

    fn check_element(&self) -> Result<(), MachineError> {
        match self.element {
            Element::Ball { inner_conformity, outer_conformity, contact_angle_deg } => {
                check("conformity of the inner ring", inner_conformity, ("", 1.0), (0.501, 1.0))?;
                check("conformity of the outer ring", outer_conformity, ("", 1.0), (0.501, 1.0))?;
                check("contact angle", contact_angle_deg, ("°", 1.0), (0.0, 75.0))?;
                // A groove centre must not move past the other one.
                let distance = (inner_conformity + outer_conformity - 1.0) * self.element_diameter_m;
                let most = 2e3 * distance * contact_angle_deg.to_radians().cos();
                check("clearance", self.clearance_m, (" mm", 1e-3), (-0.5, 0.99 * most))?;
                if contact_angle_deg > 0.0 && self.axial_n == 0.0 {
                    return Err(MachineError::NoAxialLoad);
                }
                Ok(())
            }
            Element::Roller { length_m, crown_radius_m } => {
                check("length of the rollers", length_m, (" mm", 1e-3), (0.1, 5e3))?;
                if let Some(crown) = crown_radius_m {
                    check("radius of the crown", crown, (" mm", 1e-3), (1.0, 1e7))?;
                }
                if self.axial_n > 0.0 { Err(MachineError::AxialOnRollers) } else { Ok(()) }
            }
        }
    }

    /// Returns D cos α/d_m at a contact angle \[rad\].
    fn ratio(&self, contact_angle: f64) -> f64 {
        self.element_diameter_m * contact_angle.cos() / self.pitch_diameter_m
    }

    /// Returns the curvatures \[1/m\] along and across of an element and of a ring at a contact angle \[rad\].
    fn curvatures(&self, race: Race, contact_angle: f64) -> [[f64; 2]; 2] {
        let element = 2.0 / self.element_diameter_m;
        let ratio = self.ratio(contact_angle);
        let along = match race {
            Race::Inner => element * ratio / (1.0 - ratio),
            Race::Outer => -element * ratio / (1.0 + ratio),
        };
        match (self.element, race) {
            (Element::Ball { inner_conformity: f, .. }, Race::Inner)
            | (Element::Ball { outer_conformity: f, .. }, Race::Outer) => {
                [[element; 2], [along, -1.0 / (f * self.element_diameter_m)]]
            }
            (Element::Roller { crown_radius_m, .. }, _) => {
                [[element, crown_radius_m.map_or(0.0, f64::recip)], [along, 0.0]]
            }
        }
    }

    /// Returns δ/Q^⅔ \[m/N^⅔\] of a ball on a ring, by Hertz's theory.
    fn compliance(&self, race: Race, contact_angle: f64, modulus_pa: f64) -> f64 {
        let [ball, ring] = self.curvatures(race, contact_angle);
        let [radius, radius_y] = [0, 1].map(|k| 1.0 / (ball[k] + ring[k]));
        let Ellipse { kappa, integral, .. } = Ellipse::of_ratio(radius_y / radius).unwrap_or(Ellipse::CIRCLE);
        let centre = elliprf(0.0, 1.0, kappa * kappa).unwrap_or(f64::NAN) / integral;
        (3.0 * radius * integral / (PI * modulus_pa)).powf(2.0 / 3.0) / radius * centre
    }

    fn springs(&self, modulus_pa: f64) -> Springs {
        let elements = self.elements;
        match self.element {
            Element::Ball { inner_conformity, outer_conformity, contact_angle_deg } => {
                let free_m = (inner_conformity + outer_conformity - 1.0) * self.element_diameter_m;
                let (sine, cosine) = contact_angle_deg.to_radians().sin_cos();
                let radial_m = free_m * cosine - 0.5 * self.clearance_m;
                // Angle at which the balls first touch both rings.
                let touching = (radial_m / free_m).clamp(-1.0, 1.0).acos();
                let compliance = [Race::Inner, Race::Outer].map(|race| self.compliance(race, touching, modulus_pa));
                let stiffness = (compliance[0] + compliance[1]).powf(-1.5);
                let axial_m = free_m * sine;
                Springs { elements, stiffness, exponent: 1.5, radial_m, axial_m, free_m, carries_axial: true }
            }
            Element::Roller { length_m, .. } => {
                // Palmgren: δ = 3.84e-5 Q^0.9/l^0.8 for each contact, δ and l in mm, Q in N, steel on steel.
                let each = 3.84e-5 * (STEEL_PA / modulus_pa).powf(0.9) / (1e3 * length_m).powf(0.8) * 1e-3;
                let stiffness = (2.0 * each).powf(-10.0 / 9.0);
                let radial_m = -0.5 * self.clearance_m;
                let exponent = 10.0 / 9.0;
                Springs { elements, stiffness, exponent, radial_m, axial_m: 0.0, free_m: 0.0, carries_axial: false }
            }
        }
    }

    /// Returns load distribution and speed of the cage. `modulus_pa` is E′ of elements and rings.
    ///
    /// # Errors
    /// A sentence if the bearing does not exist.
    pub fn state(&self, modulus_pa: f64) -> Result<BearingState, MachineError> {
        self.check()?;
        check("reduced modulus", modulus_pa, (" Pa", 1.0), (1e5, 1e14))?;
        let springs = self.springs(modulus_pa);
        let ring = springs.equilibrium([self.radial_n, self.axial_n])?;
        let (largest_load_n, contact_angle) = springs.element(0.0, ring);
        let ratio = self.ratio(contact_angle);
        let cage_rpm = 0.5 * (self.inner_rpm * (1.0 - ratio) + self.outer_rpm * (1.0 + ratio));
        Ok(BearingState {
            largest_load_n,
            contact_angle,
            loaded_zone: zone(&springs, ring, 0.0),
            radial_displacement_m: ring.radial_m,
            axial_displacement_m: ring.axial_m,
            cage_speed: cage_rpm * TAU / 60.0,
            springs,
        })
    }

    /// Returns the contact of an element with the ring at its orbit angle. Body 1 is the element. Both surfaces roll
    /// without sliding.
    ///
    /// # Errors
    /// A sentence if the bearing does not exist, or if the element carries no load there.
    pub fn contact(&self, modulus_pa: f64) -> Result<MachineContact, MachineError> {
        let state = self.state(modulus_pa)?;
        self.at(&state, self.orbit_deg.to_radians())
    }

    fn at(&self, state: &BearingState, orbit: f64) -> Result<MachineContact, MachineError> {
        let (force, angle) = state.element(orbit);
        if force <= 0.0 {
            let [angle, zone] = [orbit, state.loaded_zone].map(f64::to_degrees);
            return Err(MachineError::Unloaded { angle, zone });
        }
        let ratio = self.ratio(angle);
        let turning = (self.inner_rpm - self.outer_rpm).abs() * TAU / 60.0;
        let speed_m_per_s = 0.25 * self.pitch_diameter_m * (1.0 - ratio * ratio) * turning;
        let surface = |[along, across]: [f64; 2]| Surface { along, across, speed_m_per_s };
        let (kind, load, length_m) = match self.element {
            Element::Roller { length_m, crown_radius_m: None } => (ContactKind::Line, force / length_m, Some(length_m)),
            _ => (ContactKind::Point, force, None),
        };
        let time_s = orbit / state.cage_speed.abs();
        let surfaces = self.curvatures(self.race, angle).map(surface);
        Ok(MachineContact { kind, position: orbit, time_s, surfaces, load, length_m })
    }

    /// Returns the orbit angles \[rad\] between which an element carries at least 5 % of the largest load.
    ///
    /// # Errors
    /// A sentence if the bearing does not exist.
    pub fn extent(&self, modulus_pa: f64) -> Result<(f64, f64), MachineError> {
        let half = self.state(modulus_pa)?.extent();
        Ok((-half, half))
    }

    /// Returns contacts of an element on its way through [`Bearing::extent`].
    ///
    /// # Errors
    /// A sentence if the bearing does not exist, or if the cage stands still.
    pub fn path(&self, modulus_pa: f64, count: usize) -> Result<Vec<MachineContact>, MachineError> {
        let state = self.state(modulus_pa)?;
        let turning = (self.inner_rpm - self.outer_rpm).abs() * TAU / 60.0;
        if state.cage_speed.abs() < 1e-9 * turning {
            return Err(MachineError::CageStands);
        }
        let half = state.extent();
        positions((-half, half), count).map(|orbit| self.at(&state, orbit)).collect()
    }
}

impl BearingState {
    fn ring(&self) -> Displacement {
        Displacement { radial_m: self.radial_displacement_m, axial_m: self.axial_displacement_m }
    }

    /// Returns load \[N\] and contact angle \[rad\] of an element at an orbit angle \[rad\].
    pub fn element(&self, orbit: f64) -> (f64, f64) {
        self.springs.element(orbit, self.ring())
    }

    fn extent(&self) -> f64 {
        zone(&self.springs, self.ring(), EDGE * self.largest_load_n)
    }
}

/// Returns the orbit angle \[rad\] up to which elements carry more than a load \[N\].
fn zone(springs: &Springs, ring: Displacement, load: f64) -> f64 {
    let carries = |orbit: f64| springs.element(orbit, ring).0 > load;
    if carries(PI) {
        return PI;
    }
    let (mut inside, mut outside) = (0.0, PI);
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if carries(middle) { inside = middle } else { outside = middle }
    }
    inside
}

#[cfg(test)]
#[path = "bearing_tests.rs"]
mod tests;
