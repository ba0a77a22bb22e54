//! Stiffness and damping of the film between two bodies that vibrate along the normal.

use super::derivative::TimeDerivative;
use super::linear::{LinearResponse, ResponseError, ResponseSpace};
use crate::solver::physics::contact::OperatingPoint;
use realfft::num_complex::Complex64;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Stiffness and damping at one frequency, dimensionless. H₀ → H₀ + ε e^(iΩT) changes the load W = w/w₀ by −K* ε
/// e^(iΩT), with K* = K + iΩC.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stiffness {
    /// Angular frequency Ω = ω a/u_m.
    pub omega: f64,
    /// K.
    pub stiffness: f64,
    /// C.
    pub damping: f64,
}

/// Stiffness and damping at one frequency in SI units: the force changes by −(k + iωc) times the change of the
/// approach. For a line contact, force, stiffness and damping are per metre of its length.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dynamics {
    /// Frequency \[Hz\].
    pub frequency_hz: f64,
    /// Stiffness k \[N/m\]; per metre of length for a line contact \[N/m²\].
    pub stiffness: f64,
    /// Damping c \[N s/m\]; per metre of length for a line contact \[N s/m²\].
    pub damping: f64,
}

/// Smallest Ω at which the system is solved. Below it the damping is that of Ω = 0, whose limit is not a quotient of
/// two small numbers.
const SMALLEST_OMEGA: f64 = 1e-4;

impl<S: ResponseSpace> LinearResponse<S> {
    /// Computes stiffness and damping at the frequency Ω ≥ 0. At Ω = 0, the damping is its limit.
    ///
    /// # Errors
    /// If the linear solve stalls.
    pub fn stiffness(&mut self, omega: f64) -> Result<Stiffness, ResponseError> {
        let solved = omega.max(SMALLEST_OMEGA);
        self.set_frequency(solved, TimeDerivative::Exact);
        // The equations are linear: the separation under a load that changes by all of w₀.
        let load = self.problem().load;
        let separation = self.solve(solved, |_| Complex64::ZERO, load)?.h_0;
        let complex = -separation.inv();
        Ok(Stiffness { omega, stiffness: complex.re, damping: complex.im / solved })
    }

    /// Computes stiffness and damping at a frequency in Hz.
    ///
    /// # Errors
    /// If the linear solve stalls.
    pub fn dynamics(&mut self, frequency_hz: f64) -> Result<Dynamics, ResponseError> {
        let point = self.problem().point;
        let omega = TAU * frequency_hz * point.hertz().half_width_m / point.speed_m_per_s;
        Ok(self.stiffness(omega)?.at(&point, frequency_hz))
    }
}

impl Stiffness {
    /// Returns the values in SI units: k = K w R/a², c = C w R/(a u_m).
    fn at(self, point: &OperatingPoint, frequency_hz: f64) -> Dynamics {
        let a = point.hertz().half_width_m;
        let stiffness = point.load / point.film_scale_m();
        let damping = stiffness * a / point.speed_m_per_s;
        Dynamics { frequency_hz, stiffness: self.stiffness * stiffness, damping: self.damping * damping }
    }
}
