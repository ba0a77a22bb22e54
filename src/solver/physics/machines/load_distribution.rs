//! Load distribution among the elements of a rolling bearing: equilibrium of the inner ring under a radial and an
//! axial load. The ring does not tilt; centrifugal forces are neglected.
//!
//! The potential energy of the elements is a convex function of both displacements. Newton's method with a line search
//! therefore finds its minimum from every initial guess. Source: Harris, Rolling Bearing Analysis, chapter 7.

use super::error::MachineError;
use std::f64::consts::TAU;

/// Elements between two rings as springs: an element compressed by δ \[m\] carries the load Q = K δⁿ \[N\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Springs {
    /// Number of elements.
    pub elements: u32,
    /// K \[N/mⁿ\].
    pub stiffness: f64,
    /// Exponent n: 3/2 for balls, 10/9 for rollers.
    pub exponent: f64,
    /// Radial distance of the groove centres \[m\] in the centred position, less half of the clearance.
    pub radial_m: f64,
    /// Axial distance of the groove centres \[m\] in the centred position.
    pub axial_m: f64,
    /// Distance of the groove centres at which an element is just touched \[m\].
    pub free_m: f64,
    /// True if the elements transmit axial forces.
    pub carries_axial: bool,
}

/// Displacement of the inner ring \[m\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Displacement {
    /// In the direction of the radial load.
    pub radial_m: f64,
    /// In the direction of the axial load.
    pub axial_m: f64,
}

/// Compression of one element with its derivatives by the radial displacement r and the axial displacement a.
struct Compression {
    /// Compression δ \[m\]; negative without contact.
    value: f64,
    /// ∂/∂r, ∂/∂a.
    gradient: [f64; 2],
    /// ∂²/∂r², ∂²/∂r∂a, ∂²/∂a².
    curvature: [f64; 3],
}

impl Springs {
    /// Returns the compression of the element at an orbit angle \[rad\], measured from the radial load.
    fn compression(&self, orbit: f64, at: Displacement) -> Compression {
        let cosine = orbit.cos();
        let radial = self.radial_m + at.radial_m * cosine;
        if !self.carries_axial {
            return Compression { value: radial - self.free_m, gradient: [cosine, 0.0], curvature: [0.0; 3] };
        }
        let axial = self.axial_m + at.axial_m;
        let distance = radial.hypot(axial);
        let (r, a) = (radial / distance, axial / distance);
        Compression {
            value: distance - self.free_m,
            gradient: [r * cosine, a],
            curvature: [a * a * cosine * cosine / distance, -a * r * cosine / distance, r * r / distance],
        }
    }

    /// Returns load \[N\] and contact angle \[rad\] of the element at an orbit angle \[rad\], measured from the radial
    /// load.
    pub fn element(&self, orbit: f64, at: Displacement) -> (f64, f64) {
        let Compression { value, .. } = self.compression(orbit, at);
        let angle = if self.carries_axial {
            (self.axial_m + at.axial_m).atan2(self.radial_m + at.radial_m * orbit.cos())
        } else {
            0.0
        };
        (self.stiffness * value.max(0.0).powf(self.exponent), angle)
    }

    /// Returns the potential energy of the elements and of the radial and axial force \[J\].
    fn energy(&self, forces: [f64; 2], at: Displacement) -> f64 {
        let stored: f64 =
            self.orbits().map(|orbit| self.compression(orbit, at).value.max(0.0).powf(self.exponent + 1.0)).sum();
        self.stiffness * stored / (self.exponent + 1.0) - forces[0] * at.radial_m - forces[1] * at.axial_m
    }

    /// Returns the orbit angles of all elements \[rad\].
    fn orbits(&self) -> impl Iterator<Item = f64> {
        let elements = f64::from(self.elements);
        (0..self.elements).map(move |k| TAU * f64::from(k) / elements)
    }

    /// Returns the displacement at which the elements carry the radial and the axial force \[N\]. One element lies in
    /// the direction of the radial load.
    ///
    /// # Errors
    /// If Newton's method does not converge.
    pub fn equilibrium(&self, forces: [f64; 2]) -> Result<Displacement, MachineError> {
        let size = forces[0].hypot(forces[1]);
        let unit = (size / (f64::from(self.elements) * self.stiffness)).powf(self.exponent.recip());
        let mut here = Displacement { radial_m: 0.0, axial_m: 0.0 };
        // Without contact the energy has no curvature. The ring then moves along the force by doubled steps until it
        // touches elements.
        let mut free_step = unit;
        for _ in 0..400 {
            let (mut gradient, mut hessian) = ([-forces[0], -forces[1]], [0.0; 3]);
            for orbit in self.orbits() {
                let Compression { value, gradient: g, curvature } = self.compression(orbit, here);
                if value <= 0.0 {
                    continue;
                }
                let force = self.stiffness * value.powf(self.exponent);
                let slope = self.exponent * force / value;
                gradient[0] += force * g[0];
                gradient[1] += force * g[1];
                hessian[0] += slope * g[0] * g[0] + force * curvature[0];
                hessian[1] += slope * g[0] * g[1] + force * curvature[1];
                hessian[2] += slope * g[1] * g[1] + force * curvature[2];
            }
            if gradient[0].hypot(gradient[1]) <= 1e-11 * size {
                return Ok(here);
            }
            let trace = hessian[0] + hessian[2];
            let shift = 1e-13 * trace;
            let [rr, ra, aa] = [hessian[0] + shift, hessian[1], hessian[2] + shift];
            let determinant = rr * aa - ra * ra;
            let step = if trace > 0.0 && determinant > 0.0 {
                [
                    (ra * gradient[1] - aa * gradient[0]) / determinant,
                    (ra * gradient[0] - rr * gradient[1]) / determinant,
                ]
            } else {
                free_step *= 2.0;
                [forces[0] / size * free_step, forces[1] / size * free_step]
            };
            match self.descend(forces, here, step, gradient) {
                Some(next) => here = next,
                // Rounding prevents a further decrease close to the minimum.
                None if gradient[0].hypot(gradient[1]) <= 1e-6 * size => return Ok(here),
                None => break,
            }
        }
        Err(MachineError::NoEquilibrium)
    }

    /// Returns the first point of a line search along `step` that reduces the energy sufficiently; `None` if there is
    /// none.
    fn descend(
        &self,
        forces: [f64; 2],
        from: Displacement,
        step: [f64; 2],
        gradient: [f64; 2],
    ) -> Option<Displacement> {
        let before = self.energy(forces, from);
        let slope = gradient[0] * step[0] + gradient[1] * step[1];
        // Close to the minimum, rounding hides the decrease.
        let rounding = 1e-13 * (before.abs() + slope.abs());
        let mut share = 1.0;
        for _ in 0..60 {
            let radial_m = from.radial_m + share * step[0];
            let to = Displacement { radial_m, axial_m: from.axial_m + share * step[1] };
            if self.energy(forces, to) <= before + 1e-4 * share * slope + rounding {
                return Some(to);
            }
            share *= 0.5;
        }
        None
    }
}
