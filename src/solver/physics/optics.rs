//! Interferograms of a point contact, as seen in a film-thickness rig: two-beam interference between the coated glass
//! disc and the ball.
//!
//! The intensity is I = ½ (1 + V cos(4π n h/λ + φ)), with the film thickness h, the refractive index n, the
//! wavelength λ and the visibility V. The beam through the film travels 2 n h further than the one reflected at the
//! coating, and φ is the phase added by both reflections. Equal colours are therefore lines of equal film thickness,
//! and adjacent fringes differ by λ/(2n). The refractive index is that of the oil at ambient pressure. Under 1 GPa it
//! is some per cent higher; real measurements correct for this.
//!
//! Cameron & Gohar 1966, Theoretical and experimental studies of the oil film in lubricated point contact, Proc. R.
//! Soc. A 291; Wedeven, Evans & Cameron 1971, Optical analysis of ball bearing starvation, ASME J. Lubr. Technol. 93.

use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Wavelengths \[m\] of the red, green and blue light of a three-colour camera's channels; the green one is that of a
/// frequency-doubled Nd:YAG laser.
pub const RGB_WAVELENGTHS_M: [f64; 3] = [630e-9, 532e-9, 460e-9];

/// Optical parameters of a rig.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Interferometer {
    /// Wavelength of monochromatic light in vacuum \[m\].
    pub wavelength_m: f64,
    /// Refractive index n of the oil \[-\].
    pub refractive_index: f64,
    /// Phase φ added by the two reflections \[rad\]; π makes touching surfaces dark.
    pub phase: f64,
    /// Visibility V of the fringes \[-\]; 1 if both beams are equally strong.
    pub visibility: f64,
}

impl Default for Interferometer {
    /// Green light, a mineral oil, dark at touching surfaces.
    fn default() -> Self {
        let [_, green, _] = RGB_WAVELENGTHS_M;
        Self { wavelength_m: green, refractive_index: 1.5, phase: PI, visibility: 0.9 }
    }
}

impl Interferometer {
    /// Returns the film thickness \[m\] from one fringe to the next of the same brightness, λ/(2n).
    pub fn fringe_spacing_m(&self, wavelength_m: f64) -> f64 {
        wavelength_m / (2.0 * self.refractive_index)
    }

    /// Returns the interference order 2 n h/λ + φ/2π of a film. Integers are bright, half-integers dark.
    pub fn order(&self, film_m: f64, wavelength_m: f64) -> f64 {
        film_m / self.fringe_spacing_m(wavelength_m) + self.phase / TAU
    }

    /// Returns the intensity, 0…1, of a film thickness \[m\] in light of a wavelength \[m\].
    pub fn intensity(&self, film_m: f64, wavelength_m: f64) -> f64 {
        self.intensity_of_order(self.order(film_m, wavelength_m))
    }

    /// Returns the intensity, 0…1, at an interference order.
    pub fn intensity_of_order(&self, order: f64) -> f64 {
        0.5 * (1.0 + self.visibility * (TAU * order).cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fringes_repeat_every_half_wavelength_in_the_oil() {
        let rig = Interferometer::default();
        for wavelength in RGB_WAVELENGTHS_M {
            let spacing = rig.fringe_spacing_m(wavelength);
            assert!((spacing - wavelength / 3.0).abs() < 1e-15);
            for film in [0.0, 37e-9, 612e-9] {
                let [here, next] = [film, film + spacing].map(|h| rig.intensity(h, wavelength));
                let between = rig.intensity(film + 0.5 * spacing, wavelength);
                assert!((here - next).abs() < 1e-9 && (here + between - 1.0).abs() < 1e-9);
                assert!((rig.order(film + spacing, wavelength) - rig.order(film, wavelength) - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn phase_moves_fringes_and_visibility_sets_their_contrast() {
        let rig = Interferometer { visibility: 1.0, ..Interferometer::default() };
        assert!(rig.intensity(0.0, rig.wavelength_m) < 1e-12, "touching surfaces are dark");
        let bright = Interferometer { phase: 0.0, ..rig };
        assert!((bright.intensity(0.0, rig.wavelength_m) - 1.0).abs() < 1e-12);
        let shifted = rig.intensity(0.25 * rig.fringe_spacing_m(rig.wavelength_m), rig.wavelength_m);
        assert!((shifted - 0.5).abs() < 1e-12);
        let faint = Interferometer { visibility: 0.2, ..bright };
        assert!((faint.intensity(0.0, rig.wavelength_m) - 0.6).abs() < 1e-12);
    }
}
