//! Amplitude reduction: what remains of a wavy surface in the film of a steady contact.
//!
//! A wave with the amplitude A_i and the wavelength λ moves through the contact with the speed of its body. Elastic
//! bodies flatten it. The film thickness at X = 0 varies with the amplitude A_d.

use super::derivative::TimeDerivative;
use super::linear::{LinearResponse, ResponseError, ResponseSpace};
use crate::solver::discrete::space::Grid;
use crate::solver::physics::contact::{ContactKind, Moes};
use realfft::num_complex::Complex64;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Response of the central film thickness to a wave.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaveResponse {
    /// Wavelength λ/a.
    pub wavelength: f64,
    /// Speed s of the wavy surface over the entrainment speed u_m.
    pub speed: f64,
    /// Real and imaginary part of A_d/A_i at X = 0. It is 1 for a gap whose wave passes undeformed.
    pub amplitude: (f64, f64),
}

impl WaveResponse {
    /// Returns |A_d/A_i|.
    pub fn ratio(&self) -> f64 {
        self.amplitude.0.hypot(self.amplitude.1)
    }
}

impl<S: ResponseSpace> LinearResponse<S> {
    /// Computes the response to a wave cos(2π (X − sT)/λ) with the wavelength λ/a and the speed s = u/u_m of its
    /// surface. The crests lie across the direction of rolling.
    ///
    /// # Errors
    /// If the grid does not resolve the wave, if the derivative does not fit the grid, or if the linear solve stalls.
    pub fn wave(
        &mut self,
        wavelength: f64,
        speed: f64,
        derivative: TimeDerivative,
    ) -> Result<WaveResponse, ResponseError> {
        let wave_number = TAU / wavelength;
        let omega = wave_number * speed;
        let (x, y) = self.grid().abscissae();
        check_wavelength(wavelength, widest_spacing(x))?;
        check_derivative(derivative, x)?;
        let across = y.len();
        // A bump makes the gap smaller.
        let waves: Vec<Complex64> = x.iter().map(|x| -Complex64::cis(-wave_number * x)).collect();
        let gap = |node: usize| waves[node / across];
        self.set_frequency(omega, derivative);
        let film = self.solve(omega, gap, 0.0)?.film;
        let at_zero = self.grid().at_zero();
        let change: Complex64 = at_zero.iter().map(|(node, w)| w * (film[*node] + gap(*node))).sum();
        Ok(WaveResponse { wavelength, speed, amplitude: (-change.re, -change.im) })
    }
}

/// Returns the widest spacing of abscissae between X = −1 and X = 1.
pub fn widest_spacing(x: &[f64]) -> f64 {
    let inside = x.windows(2).filter(|pair| pair[1] > -1.0 && pair[0] < 1.0);
    inside.map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}

/// Returns true if all abscissae have the same distance.
pub fn is_uniform(x: &[f64]) -> bool {
    let spacing = widest_spacing(x);
    x.windows(2).all(|pair| ((pair[1] - pair[0]) / spacing - 1.0).abs() < UNIFORM)
}

/// Number of spacings in the shortest accepted wavelength.
const FEWEST_SPACINGS: f64 = 4.0;
/// Relative difference of spacings that counts as none.
const UNIFORM: f64 = 1e-6;

/// Checks that a grid with the given spacing in the contact resolves a wave.
///
/// # Errors
/// [`ResponseError::ShortWave`].
pub fn check_wavelength(wavelength: f64, spacing: f64) -> Result<(), ResponseError> {
    let shortest = FEWEST_SPACINGS * spacing;
    if wavelength >= shortest * (1.0 - UNIFORM) {
        return Ok(());
    }
    Err(ResponseError::ShortWave { wavelength, shortest })
}

/// Checks that the nodes lie on characteristics, if the derivative follows them.
fn check_derivative(derivative: TimeDerivative, x: &[f64]) -> Result<(), ResponseError> {
    let TimeDerivative::Characteristic { step } = derivative else { return Ok(()) };
    let spacing = widest_spacing(x);
    if is_uniform(x) && (spacing / step - 1.0).abs() < UNIFORM {
        return Ok(());
    }
    Err(ResponseError::NoCharacteristics { step, spacing })
}

/// Returns the parameter of the published curves, with the wavelength λ/a: ∇ = (λ/a) M^(3/4)/L^(1/2) of a line
/// contact (Venner, Couhier, Lubrecht and Greenwood 1997), ∇₂ = (λ/a) (M/L)^(1/2) of a point contact (Venner and
/// Lubrecht 2000).
pub fn reduction_parameter(kind: ContactKind, Moes { m, l }: Moes, wavelength: f64) -> f64 {
    if kind.is_line() { wavelength * m.powf(0.75) / l.sqrt() } else { wavelength * (m / l).sqrt() }
}

/// Published |A_d/A_i| for pure rolling.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PublishedReduction {
    /// Coefficients c₁ and c₂ of 1/(1 + c₁∇ + c₂∇²).
    pub coefficients: [f64; 2],
}

impl PublishedReduction {
    /// Returns |A_d/A_i| at ∇.
    pub fn at(self, parameter: f64) -> f64 {
        let [first, second] = self.coefficients;
        1.0 / (1.0 + first * parameter + second * parameter * parameter)
    }
}

/// Returns the published curve of a kind of contact.
pub fn published_reduction(kind: ContactKind) -> PublishedReduction {
    let coefficients = if kind.is_line() { [0.17, 0.03] } else { [0.15, 0.015] };
    PublishedReduction { coefficients }
}
