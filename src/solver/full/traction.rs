//! Shear across the film, and the traction (3.41) it adds up to.

use super::solution::{Problem, Solution};
use crate::solver::discrete::reynolds::film_integrals::{PRODUCTION_RULE, film_integrals};
use crate::solver::discrete::reynolds::generalized::{NodeState, PlaneGradient};
use crate::solver::physics::lubricant::{LimitingStress, ScaledShear};
use rayon::prelude::*;

/// α* p_H beyond which an isothermal traction without a limiting stress is no physics: viscosity then outgrows every
/// stress a lubricant can carry.
pub const PLAUSIBLE_EXPONENT: f64 = 12.0;

/// A traction coefficient beyond which no lubricant was ever measured: it would have thinned under shear or yielded.
pub const PLAUSIBLE_TRACTION: f64 = 0.15;

/// Shear along X at one place of the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// τ_zx \[Pa\].
    pub stress_pa: f64,
    /// Shear rate ∂u/∂z \[1/s\].
    pub rate_per_s: f64,
}

/// The shear stress of a film: linear across it, from the lower surface Z = 0 to the upper one Z = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FilmStress {
    /// (τ_zx, τ_zy) at mid-film \[Pa\].
    mid_pa: [f64; 2],
    /// Their differences between the surfaces \[Pa\].
    across_pa: [f64; 2],
    /// μ, the viscosity at rest \[Pa·s\].
    viscosity_pa_s: f64,
    /// What bends and cuts it, and the pressure there \[Pa\].
    limit: Option<(LimitingStress, f64)>,
}

impl Solution {
    /// Shear along the axis Y = 0 at heights z = Z h above the lower surface, 0 ≤ Z ≤ 1, in the order of
    /// [`Solution::profile`], the heights of a node one after the other. A limiting stress, where the lubricant has one,
    /// cuts the stress; the rate is the one of the film without it.
    pub fn shear_field(&self, heights: &[f64]) -> Vec<Shear> {
        let gradient = PlaneGradient::new(&self.x, &self.y);
        let axis = self.y.len() - 1;
        let shear = |film: &FilmStress, height: f64| {
            let stress = film.at(height);
            let fluidity = self
                .problem
                .shear
                .map_or(1.0, |law| law.fluidity.at(stress[0].hypot(stress[1]) / law.stress_scale_pa).0);
            let rate_per_s = stress[0] * fluidity / film.viscosity_pa_s;
            Shear { stress_pa: film.limited(stress)[0], rate_per_s }
        };
        let films =
            (self.first()..self.x.len()).map(|i| FilmStress::new(&self.problem, self.state(&gradient, i, axis)));
        films.flat_map(|film| heights.iter().map(move |height| shear(&film, *height))).collect()
    }

    /// Traction coefficient (3.41): the shear stress at mid-film over the whole domain, both halves of a point
    /// contact's, by the trapezoidal rule, over the load. Positive for SRR > 0. Over the area with P > 0 alone it is
    /// some 0.1 to 2 % smaller.
    pub fn traction_coefficient(&self) -> f64 {
        if self.problem.point.sliding.slide_to_roll_ratio == 0.0 {
            return 0.0;
        }
        let stress = self.mid_film_stress();
        self.force_per_load(|k| stress[k])
    }

    /// τ_zx \[Pa\] at mid-film, cut to the limiting stress where the lubricant has one, at every node of the arrays.
    pub fn mid_film_stress(&self) -> Vec<f64> {
        let gradient = PlaneGradient::new(&self.x, &self.y);
        let ny = self.y.len();
        let mut stress = vec![0.0; self.pressure.len()];
        stress.par_iter_mut().enumerate().with_min_len(256).for_each(|(k, stress)| {
            *stress = mid_film_stress(&self.problem, self.state(&gradient, k / ny, k % ny));
        });
        stress
    }

    /// What the film at node (i, j) depends on.
    fn state(&self, gradient: &PlaneGradient, i: usize, j: usize) -> NodeState {
        let k = i * self.y.len() + j;
        NodeState { pressure: self.pressure[k], gradient: gradient.at(&self.pressure, i, j), film: self.film[k] }
    }

    /// A sentence where its traction is no physics; none in pure rolling, where there is no traction.
    pub fn traction_warning(&self) -> Option<String> {
        let slides = self.problem.point.sliding.slide_to_roll_ratio != 0.0;
        slides.then(|| self.problem.traction_warning()).flatten()
    }
}

impl Problem {
    /// A sentence where a traction coefficient is no physics: wherever every one is, and where it is larger than any that
    /// was measured. None of no traction at all.
    pub fn doubts_traction(&self, traction: f64) -> Option<String> {
        let too_large = || {
            (traction.abs() > PLAUSIBLE_TRACTION).then(|| {
                format!(
                    "a traction coefficient of {traction:.3} is unphysical: beyond {PLAUSIBLE_TRACTION} the lubricant thins \
                     under shear or yields"
                )
            })
        };
        if traction == 0.0 { None } else { self.traction_warning().or_else(too_large) }
    }

    /// A sentence where every traction is no physics: at great α* p_H without a limiting stress.
    pub fn traction_warning(&self) -> Option<String> {
        let unlimited = self.lubricant.limiting_stress.is_none();
        let exponent = self.fluid.reciprocal_asymptotic_exponent();
        (unlimited && exponent > PLAUSIBLE_EXPONENT).then(|| {
            format!(
                "α* p_H is {exponent:.1}: beyond {PLAUSIBLE_EXPONENT} an isothermal traction without a limiting shear stress is unphysical"
            )
        })
    }
}

/// τ_zx \[Pa\] at mid-film of one node, cut to the limiting stress where the lubricant has one.
pub(crate) fn mid_film_stress(problem: &Problem, state: NodeState) -> f64 {
    let film = FilmStress::new(problem, state);
    film.limited(film.mid_pa)[0]
}

impl FilmStress {
    /// The shear stress of a node's film.
    fn new(problem: &Problem, NodeState { pressure, gradient, film }: NodeState) -> Self {
        let (point, hertz) = (&problem.point, problem.point.hertz());
        let viscosity = problem.fluid.at(pressure.max(0.0)).viscosity;
        let (across_pa, mid_pa) = match &problem.shear {
            None => {
                // κ₁ and κ₂ of (3.27).
                let kappa_1 = hertz.pressure_pa * hertz.half_width_m / point.radius_m;
                let slip = point.speed_m_per_s * point.sliding.slide_to_roll_ratio;
                let kappa_2 = point.viscosity_pa_s * slip / point.film_scale_m();
                (gradient.map(|p| kappa_1 * film * p), [kappa_2 * viscosity / film, 0.0])
            }
            Some(law @ ScaledShear { fluidity, stress_scale_pa: scale, .. }) => {
                let load = law.film_load(gradient, film, viscosity);
                let mid = film_integrals(fluidity, &PRODUCTION_RULE, load).mid_stress;
                ([load.a * scale, load.b * scale], mid.map(|stress| stress * scale))
            }
        };
        let limit = problem.lubricant.limiting_stress;
        Self {
            mid_pa,
            across_pa,
            viscosity_pa_s: point.viscosity_pa_s * viscosity,
            limit: limit.map(|limit| (limit, pressure * hertz.pressure_pa)),
        }
    }

    /// (τ_zx, τ_zy) at height Z.
    fn at(&self, height: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.mid_pa[axis] + (height - 0.5) * self.across_pa[axis])
    }

    /// A stress bent and cut to what the lubricant carries, in its own direction.
    fn limited(&self, stress: [f64; 2]) -> [f64; 2] {
        let Some((limit, pressure_pa)) = self.limit else { return stress };
        let size = stress[0].hypot(stress[1]);
        let carried = limit.carried(size, pressure_pa);
        if carried < size { stress.map(|part| part * carried / size) } else { stress }
    }
}
