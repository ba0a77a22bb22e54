//! Results of a contact with rough surfaces: film ratio, share of the load that asperities carry, parts of the friction.

use super::problem::Problem;
use super::solution::{Scalars, Solution};
use crate::solver::physics::surfaces::{ScaledRoughness, mean_gap};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Asperity pressure next to an end of the domain, in units of p_H, that is too large to be neglected beyond it.
const AT_ENDS: f64 = 1e-4;

/// Share of the load carried by asperities below which the film is full, and above which the lubrication is by boundary
/// films.
const FULL_FILM: f64 = 0.01;
const BOUNDARY: f64 = 0.9;

/// Lubrication of rough surfaces by the share of the load that asperities carry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lubrication {
    /// Asperities carry more than 90 % of the load.
    Boundary,
    /// Asperities and film carry the load together.
    Mixed,
    /// Asperities carry less than 1 % of the load.
    FullFilm,
}

impl Lubrication {
    /// Returns the lubrication at a load share of the asperities, 0…1.
    pub fn of(asperity_load_share: f64) -> Self {
        match asperity_load_share {
            share if share < FULL_FILM => Self::FullFilm,
            share if share > BOUNDARY => Self::Boundary,
            _ => Self::Mixed,
        }
    }

    /// Returns the name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Boundary => "boundary",
            Self::Mixed => "mixed",
            Self::FullFilm => "full film",
        }
    }
}

/// Results of a contact with rough surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mixed {
    /// h_c/σ of the central film thickness, the distance of the mean planes; may be negative.
    pub film_ratio_c: f64,
    /// h_min/σ of the minimum film thickness; may be negative.
    pub film_ratio_min: f64,
    /// Mean gap at the centre in units of σ; positive.
    pub mean_gap_c: f64,
    /// Share of the load that asperities carry, 0…1.
    pub asperity_load_share: f64,
    /// Asperity pressure P_a at the centre, in units of p_H.
    pub p_a_c: f64,
    /// Part of the traction coefficient due to asperities, μ_b times their share of the load.
    pub boundary_traction: f64,
    /// Part of the traction coefficient due to the film.
    pub fluid_traction: f64,
    /// Real contact area of the asperities over the Hertzian contact area; `None` if the law does not define it.
    pub real_contact_area: Option<f64>,
    /// Largest rate of wear \[m/s\] by Archard's law, k p_a |u₂ − u₁|; `None` without a specific wear rate.
    pub wear_m_per_s: Option<f64>,
}

impl Mixed {
    /// Returns a warning if the film ratio is so small that the closure of the flow factors decides.
    pub fn warning(&self) -> Option<Warning> {
        Warning::of_film_ratio(self.film_ratio_c)
    }
}

/// Fields of the film between the surfaces.
pub(super) struct FilmFields<'a> {
    /// Film pressure P_h, node array.
    pub pressure: Cow<'a, [f64]>,
    /// Film thickness H, node array: the mean gap of rough surfaces.
    pub thickness: Cow<'a, [f64]>,
}

impl Solution {
    /// Returns pressure and thickness of the film. For smooth surfaces these are P and H.
    pub(super) fn film_fields(&self) -> FilmFields<'_> {
        let Some(rough) = self.problem.rough else {
            return FilmFields { pressure: Cow::Borrowed(&self.pressure), thickness: Cow::Borrowed(&self.film) };
        };
        let thickness = self.film.iter().map(|film| rough.mean_gap(*film).0).collect();
        FilmFields { pressure: Cow::Owned(self.film_pressure()), thickness: Cow::Owned(thickness) }
    }

    /// Returns the film pressure P_h = P − P_a ≥ 0 at the nodes; P for smooth surfaces.
    pub fn film_pressure(&self) -> Vec<f64> {
        if self.asperity_pressure.is_empty() {
            return self.pressure.clone();
        }
        self.pressure.iter().zip(&self.asperity_pressure).map(|(total, carried)| (total - carried).max(0.0)).collect()
    }

    /// Returns P_a at the nodes of [`nodes`](Self::nodes); empty for smooth surfaces.
    pub fn asperity_pressures(&self) -> impl Iterator<Item = f64> + '_ {
        self.asperity_pressure.iter().skip(self.first() * self.y.len()).copied()
    }

    /// Returns the share of the load that asperities carry; 0 for smooth surfaces.
    pub fn asperity_load_share(&self) -> f64 {
        let hertz_pressure = self.problem.point.hertz().pressure_pa;
        self.force_per_load(|k| self.asperity_pressure.get(k).map_or(0.0, |carried| carried * hertz_pressure))
    }

    /// Returns the part of the traction coefficient due to asperities: μ_b times their share of the load, with the sign
    /// of SRR.
    pub fn boundary_traction(&self) -> f64 {
        self.boundary_traction_of(self.asperity_load_share())
    }

    /// Returns the part of the traction coefficient due to asperities that carry a share of the load, 0…1.
    fn boundary_traction_of(&self, share: f64) -> f64 {
        let sliding = self.problem.point.sliding.slide_to_roll_ratio;
        match self.problem.rough {
            Some(ScaledRoughness { roughness, .. }) if sliding != 0.0 => {
                roughness.boundary_friction * share * sliding.signum()
            }
            _ => 0.0,
        }
    }

    /// Returns the real contact area of the asperities over the Hertzian contact area; `None` for smooth surfaces and if
    /// the law does not define it.
    fn real_contact_area(&self) -> Option<f64> {
        let rough = self.problem.rough?;
        let point = &self.problem.point;
        let touched = |k: usize| {
            let separation = self.film.get(k)? / rough.sigma;
            rough.roughness.asperities.contact_area(point.modulus_pa, separation)
        };
        touched(0)?;
        Some(self.force_per_load(|k| touched(k).unwrap_or(0.0)) / (point.area_per_load() * point.kind.hertz_area()))
    }

    /// Returns the rate of wear \[m/s\] by Archard's law, k p_a |u₂ − u₁|, at the nodes of [`nodes`](Self::nodes); `None`
    /// without a specific wear rate.
    pub fn wear_rates(&self) -> Option<impl Iterator<Item = f64> + '_> {
        let rate = self.problem.rough?.roughness.wear_rate;
        let point = &self.problem.point;
        let sliding = point.speed_m_per_s * point.sliding.slide_to_roll_ratio.abs();
        let per_pressure = rate * point.hertz().pressure_pa * sliding;
        (rate > 0.0).then(|| self.asperity_pressures().map(move |carried| per_pressure * carried))
    }

    /// Returns the results of rough surfaces; `None` for smooth ones.
    pub fn mixed(&self) -> Option<Mixed> {
        let rough = self.problem.rough?;
        let Scalars { h_c, h_min, .. } = self.scalars;
        let film_ratio_c = h_c / rough.sigma;
        let asperity_load_share = self.asperity_load_share();
        Some(Mixed {
            film_ratio_c,
            film_ratio_min: h_min / rough.sigma,
            mean_gap_c: mean_gap(film_ratio_c).0,
            asperity_load_share,
            p_a_c: self.problem.asperity_pressure(h_c),
            boundary_traction: self.boundary_traction_of(asperity_load_share),
            fluid_traction: self.fluid_traction(),
            real_contact_area: self.real_contact_area(),
            wear_m_per_s: self.largest_wear_rate(),
        })
    }

    /// Returns results of rough surfaces with friction and wear of this solution's sliding; the others do not depend on
    /// it.
    pub fn mixed_at_sliding(&self, mixed: Mixed) -> Mixed {
        Mixed {
            boundary_traction: self.boundary_traction_of(mixed.asperity_load_share),
            fluid_traction: self.fluid_traction(),
            wear_m_per_s: self.largest_wear_rate(),
            ..mixed
        }
    }

    fn largest_wear_rate(&self) -> Option<f64> {
        self.wear_rates().map(|rates| rates.fold(0.0, f64::max))
    }

    /// Returns a warning if asperities touch at the ends of the domain.
    pub fn warning_of_ends(&self) -> Option<Warning> {
        let ny = self.y.len();
        let (first, last) = (self.first() + 1, self.x.len() - 2);
        let at_end = |k: usize| k / ny == first || k / ny == last || ny > 1 && k % ny == 1;
        let carried =
            self.asperity_pressure.iter().enumerate().filter(|(k, _)| at_end(*k)).map(|(_, carried)| *carried);
        let largest = carried.fold(0.0, f64::max);
        (largest > AT_ENDS).then_some(Warning::AsperitiesAtEnds { pressure: largest })
    }
}

impl Problem {
    /// Returns the film thickness to which errors of thinner films are relative: σ/2 for rough surfaces, whose mean
    /// planes may pass each other, and 0 for smooth ones.
    pub fn least_film(&self) -> f64 {
        self.rough.map_or(0.0, |rough| 0.5 * rough.sigma)
    }

    /// Returns the relative difference of a film thickness from that of the full solution.
    pub fn film_difference(&self, own: f64, full: f64) -> f64 {
        let least = self.least_film();
        if full.abs() < least { (own - full) / least } else { own / full - 1.0 }
    }

    /// Returns the asperity pressure P_a at a film thickness H; 0 for smooth surfaces.
    pub fn asperity_pressure(&self, film: f64) -> f64 {
        let Some(rough) = self.rough else { return 0.0 };
        let law = rough.roughness.asperities;
        law.pressure(self.point.modulus_pa, film / rough.sigma).0 / self.point.hertz().pressure_pa
    }
}
