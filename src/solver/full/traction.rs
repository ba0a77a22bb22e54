//! Shear across the film of a line contact, and the traction (3.41) it adds up to; the Newtonian traction of a point contact.

use super::solution::Solution;
use crate::solver::contact::ContactKind;
use crate::solver::lubricant::{Fluidity, ScaledShear};
use crate::solver::reynolds::film_integrals::{FilmLoad, PRODUCTION_RULE, film_integrals};
use crate::solver::reynolds::generalized::NodalGradient;

/// α* p_H beyond which an isothermal traction without a limiting stress is no physics: viscosity then outgrows every stress a
/// lubricant can carry.
pub const PLAUSIBLE_EXPONENT: f64 = 12.0;

/// Shear at one place of the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// τ_zx \[Pa\].
    pub stress_pa: f64,
    /// Shear rate \[1/s\].
    pub rate_per_s: f64,
}

impl Solution {
    /// Shear at height z = Z h above the lower surface, 0 ≤ Z ≤ 1, at all entries of the node arrays. A limiting stress, where the lubricant has one,
    /// cuts the stress; the rate is the one of the film without it.
    pub fn shear_at_height(&self, height: f64) -> Vec<Shear> {
        let problem = &self.problem;
        let (point, fluid) = (&problem.point, &problem.fluid);
        let hertz = point.hertz();
        let gradient = NodalGradient::new(&self.x);
        // Newtonian scales: κ₁ and κ₂ of (3.27).
        let kappa_1 = hertz.pressure_pa * hertz.half_width_m / point.radius_m;
        let slip = point.speed_m_per_s * problem.sliding.slide_to_roll_ratio;
        let kappa_2 = point.viscosity_pa_s * slip / point.film_scale_m();
        let zeta = height - 0.5;
        let at = |i: usize| {
            let (pressure, film) = (self.pressure[i], self.film[i]);
            let relative_viscosity = fluid.at(pressure.max(0.0)).viscosity;
            let (across, sliding) =
                (kappa_1 * film * gradient.at(&self.pressure, i), kappa_2 * relative_viscosity / film);
            let (stress, fluidity) = match &problem.shear {
                None => (sliding + across * zeta, 1.0),
                Some(ScaledShear { fluidity, stress_scale_pa: scale, .. }) => {
                    let load = FilmLoad { a: across / scale, b: 0.0, sliding: sliding / scale };
                    let stress = mid_stress(fluidity, load) + load.a * zeta;
                    (stress * scale, fluidity.at(stress.abs()).0)
                }
            };
            let rate_per_s = stress * fluidity / (point.viscosity_pa_s * relative_viscosity);
            let limit = problem.lubricant.limiting_stress.map_or(f64::INFINITY, |l| l.at(pressure * hertz.pressure_pa));
            Shear { stress_pa: stress.clamp(-limit, limit), rate_per_s }
        };
        (0..self.x.len()).map(at).collect()
    }

    /// Traction coefficient (3.41): the shear stress at mid-film over the whole domain, by the trapezoidal rule, over the load. Positive for
    /// SRR > 0. Over the area with P > 0 alone it is some 0.1 to 2 % smaller.
    pub fn traction_coefficient(&self) -> f64 {
        if self.problem.sliding.slide_to_roll_ratio == 0.0 {
            return 0.0;
        }
        let point = &self.problem.point;
        if point.kind == ContactKind::Point {
            return self.traction().per_srr * self.problem.sliding.slide_to_roll_ratio;
        }
        let stress = self.shear_at_height(0.5);
        let cells = self.x.windows(2).zip(stress.windows(2)).skip(1);
        let integral: f64 = cells.map(|(x, s)| 0.5 * (s[0].stress_pa + s[1].stress_pa) * (x[1] - x[0])).sum();
        integral * point.hertz().half_width_m / point.load
    }

    /// A sentence where the traction is no physics: at great α* p_H without a limiting stress.
    pub fn traction_warning(&self) -> Option<String> {
        let slides = self.problem.sliding.slide_to_roll_ratio != 0.0;
        let unlimited = self.problem.lubricant.limiting_stress.is_none();
        let exponent = self.problem.fluid.reciprocal_asymptotic_exponent();
        (slides && unlimited && exponent > PLAUSIBLE_EXPONENT).then(|| {
            format!(
                "α* p_H is {exponent:.1}: beyond {PLAUSIBLE_EXPONENT} an isothermal traction without a limiting shear stress is unphysical"
            )
        })
    }
}

fn mid_stress(law: &Fluidity, load: FilmLoad) -> f64 {
    film_integrals(law, &PRODUCTION_RULE, load).mid_stress[0]
}
