//! Features of the surfaces that move through a contact: bumps, dents, waves and measured profiles.

use crate::solver::limits::Number;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Feature on the surface of one body, in the units of the reference contact: heights in a²/R, lengths in a. Positive
/// heights are bumps, which make the gap smaller.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MovingSurface {
    /// Speed s of the surface over the entrainment speed u_m.
    pub speed: f64,
    /// X of the feature at T = 0. It is at X + sT later.
    pub at: f64,
    /// Shape of the feature.
    pub shape: Shape,
}

/// Shape of a feature, with the distance y from its place along X.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Shape {
    /// A exp(−y²/W²).
    Gauss {
        /// Height A; negative for a dent.
        height: f64,
        /// Width W.
        width: f64,
    },
    /// A 10^(−10 (y/W)²) cos(2π y/W): the wave packet of Venner and Lubrecht.
    Venner {
        /// Height A.
        height: f64,
        /// Wavelength and width W.
        width: f64,
    },
    /// A cos(2π (X − sT)/W) behind a front at y = 0, over whose length it grows smoothly. Ahead of it the surface is
    /// smooth.
    Wave {
        /// Amplitude A.
        height: f64,
        /// Wavelength W.
        wavelength: f64,
        /// Length of the front.
        front: f64,
    },
    /// −d cos(½π r/(1.2 r₀)) exp(−2 (r/(1.2 r₀))²) with r = |y|: the dent of a ball (Mourier, Mazuyer, Lubrecht and
    /// Donnet 2006).
    Dent {
        /// Depth d.
        depth: f64,
        /// Radius r₀.
        radius: f64,
    },
    /// Given heights, interpolated linearly; zero beyond both ends.
    Profile {
        /// Distances y, increasing.
        places: Vec<f64>,
        /// Height at each of them.
        heights: Vec<f64>,
    },
}

/// Time scheme of the mass flow ρ̄H.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scheme {
    /// [`Scheme::Bdf2`].
    #[default]
    Default,
    /// Upwind quotient along X, and backward difference (2.34) in time.
    Bdf2,
    /// Backward difference along the characteristics X − T = const, in place of both. Features lose five times less of
    /// their height. Requires a uniform grid, steps ΔT = ΔX and a constant speed.
    Characteristic,
}

/// Refusal of a feature or of a scheme: a sentence.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct SurfaceError(pub(super) String);

/// Largest height or depth: flattening of the Hertzian contact between its middle and its edge, a²/(2R).
const HIGHEST: f64 = 0.5;
/// Number of spacings, and of time steps, in the length of a feature.
const FEWEST: f64 = 4.0;
/// Rounding of lengths that are given in metres.
const ROUNDING: f64 = 1e-6;

impl MovingSurface {
    /// Returns the speed of body 1 or 2 over u_m for a slide-to-roll ratio.
    pub fn speed_of(body: u8, slide_to_roll_ratio: f64) -> f64 {
        if body == 1 { 1.0 - 0.5 * slide_to_roll_ratio } else { 1.0 + 0.5 * slide_to_roll_ratio }
    }

    /// Returns the height at (X, Y) in units of a, and T. Gaussian features and dents of a ball are round and lie on the
    /// axis Y = 0; all others are ridges across it.
    pub fn height(&self, x: f64, across: f64, time: f64) -> f64 {
        let along = x - self.at - self.speed * time;
        let distance = match self.shape {
            Shape::Gauss { .. } | Shape::Dent { .. } => along.hypot(across),
            Shape::Venner { .. } | Shape::Wave { .. } | Shape::Profile { .. } => along,
        };
        self.shape.height(distance, self.at)
    }

    /// Checks the feature for a grid with the given widest spacing in the contact and for the longest time step.
    ///
    /// # Errors
    /// [`SurfaceError`] that names what is too high, too short or too fast.
    pub fn check(&self, spacing: f64, step: f64) -> Result<(), SurfaceError> {
        let refuse = |sentence: String| Err(SurfaceError(sentence));
        let (height, length) = (self.shape.greatest(), self.shape.length());
        if height.is_nan() || height > HIGHEST {
            return refuse(format!(
                "a feature is {} a²/R high or deep; accepted is at most the flattening of the Hertzian contact, {HIGHEST} \
                 a²/R",
                Number(height)
            ));
        }
        if length.is_nan() || length < FEWEST * spacing * (1.0 - ROUNDING) {
            return refuse(format!(
                "a feature is {length:.4} a long, but the grid needs {FEWEST} spacings of {spacing:.4} a for it; use a \
                 finer grid or a longer feature"
            ));
        }
        let travelled = self.speed.abs() * step;
        if travelled.is_nan() || FEWEST * travelled > length * (1.0 + ROUNDING) {
            let longest = length / (FEWEST * self.speed.abs());
            return refuse(format!(
                "a time step of {step:.4} moves a feature by {travelled:.4} a, more than a quarter of its length \
                 {length:.4} a; accepted are steps up to {longest:.4}"
            ));
        }
        Ok(())
    }
}

impl Shape {
    /// Returns the height at the distance `y`. `at` is the place of the feature at T = 0, from which the phase of a wave
    /// follows.
    fn height(&self, y: f64, at: f64) -> f64 {
        match self {
            Self::Gauss { height, width } => height * (-(y / width).powi(2)).exp(),
            Self::Venner { height, width } => {
                let ratio = y / width;
                height * 10f64.powf(-10.0 * ratio * ratio) * (TAU * ratio).cos()
            }
            Self::Wave { height, wavelength, front } => {
                let rise = (-y / front).clamp(0.0, 1.0);
                height * (TAU * (y + at) / wavelength).cos() * rise * rise * (3.0 - 2.0 * rise)
            }
            Self::Dent { depth, radius } => {
                let ratio = y / (1.2 * radius);
                -depth * (FRAC_PI_2 * ratio).cos() * (-2.0 * ratio * ratio).exp()
            }
            Self::Profile { places, heights } => {
                let next = places.partition_point(|place| *place <= y);
                let ends = |k: usize| Some((*places.get(k)?, *heights.get(k)?));
                let (Some((x_0, h_0)), Some((x_1, h_1))) = (next.checked_sub(1).and_then(ends), ends(next)) else {
                    return if places.last() == Some(&y) { heights.last().copied().unwrap_or(0.0) } else { 0.0 };
                };
                h_0 + (h_1 - h_0) * (y - x_0) / (x_1 - x_0)
            }
        }
    }

    /// Returns the largest height or depth.
    pub fn greatest(&self) -> f64 {
        match self {
            Self::Gauss { height, .. } | Self::Venner { height, .. } | Self::Wave { height, .. } => height.abs(),
            Self::Dent { depth, .. } => depth.abs(),
            Self::Profile { heights, .. } => heights.iter().fold(0.0, |greatest, h| greatest.max(h.abs())),
        }
    }

    /// Returns the length over which the height changes: a wavelength, or the width of a single feature.
    fn length(&self) -> f64 {
        match self {
            Self::Gauss { width, .. } => 2.0 * width,
            Self::Venner { width, .. } => *width,
            Self::Wave { wavelength, front, .. } => wavelength.min(2.0 * front),
            Self::Dent { radius, .. } => 2.0 * radius,
            Self::Profile { places, .. } => match places[..] {
                [first, .., last] => last - first,
                _ => 0.0,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moving(shape: Shape) -> MovingSurface {
        MovingSurface { speed: 0.75, at: -2.5, shape }
    }

    #[test]
    fn features_keep_their_shape_and_move_with_their_surface() {
        let profile = Shape::Profile { places: vec![-0.3, 0.0, 0.2], heights: vec![0.0, 0.02, -0.01] };
        for shape in [
            Shape::Gauss { height: 0.02, width: 0.3 },
            Shape::Venner { height: -0.05, width: 1.0 },
            Shape::Wave { height: 0.005, wavelength: 0.5, front: 0.5 },
            Shape::Dent { depth: 0.1, radius: 0.4 },
            profile,
        ] {
            let feature = moving(shape);
            for y in [-0.31, -0.2, -0.07, 0.0, 0.11, 0.2] {
                let (early, late) =
                    (feature.height(-2.5 + y, 0.1, 0.0), feature.height(-2.5 + y + 0.75 * 1.6, 0.1, 1.6));
                assert!((early - late).abs() < 1e-14, "{:?} at {y}", feature.shape);
            }
        }
    }

    #[test]
    fn heights_are_those_of_their_formulas() {
        let at = |shape: Shape, y: f64| moving(shape).height(-2.5 + y, 0.0, 0.0);
        assert!((at(Shape::Gauss { height: 0.02, width: 0.3 }, 0.3) - 0.02 / 1f64.exp()).abs() < 1e-15);
        let packet = at(Shape::Venner { height: 0.02, width: 1.0 }, 0.5);
        assert!((packet + 0.02 * 10f64.powf(-2.5)).abs() < 1e-15);
        let wave = Shape::Wave { height: 0.005, wavelength: 0.5, front: 0.5 };
        assert_eq!(at(wave.clone(), 0.1), 0.0);
        assert!((at(wave.clone(), -0.25) + 0.0025).abs() < 1e-15, "half of the front, half a wavelength from X = 0");
        assert!((at(wave, -1.0) - 0.005).abs() < 1e-15);
        // The depth at 1.2 r₀ is zero, where the cosine ends.
        let dent = Shape::Dent { depth: 0.1, radius: 0.5 };
        assert!(at(dent.clone(), 0.6).abs() < 1e-15 && (at(dent, 0.0) + 0.1).abs() < 1e-15);
        let profile = Shape::Profile { places: vec![0.0, 0.2], heights: vec![0.1, 0.3] };
        assert!((at(profile.clone(), 0.05) - 0.15).abs() < 1e-12);
        assert_eq!((at(profile.clone(), -0.01), at(profile, 0.21)), (0.0, 0.0));
    }

    #[test]
    fn features_that_cannot_be_computed_are_refused_with_the_reason() {
        let gauss = |height: f64, width: f64| moving(Shape::Gauss { height, width });
        assert_eq!(gauss(0.1, 0.1).check(0.01, 0.01), Ok(()));
        for (feature, spacing, step, part) in [
            (gauss(0.6, 0.1), 0.01, 0.01, "at most the flattening"),
            (gauss(f64::NAN, 0.1), 0.01, 0.01, "at most the flattening"),
            (gauss(0.1, 0.01), 0.01, 0.001, "finer grid"),
            (gauss(0.1, 0.1), 0.01, 0.1, "steps up to 0.0667"),
        ] {
            let sentence = feature.check(spacing, step).unwrap_err().to_string();
            assert!(sentence.contains(part), "{sentence}");
        }
        // A feature at rest is not skipped by any step.
        assert_eq!(MovingSurface { speed: 0.0, ..gauss(0.1, 0.1) }.check(0.01, 10.0), Ok(()));
    }
}
