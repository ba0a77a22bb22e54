//! Shear stress in the film, and the traction (3.41) that results from it.

use super::mixed::FilmFields;
use super::problem::Problem;
use super::solution::{Scalars, Solution};
use crate::host::pool;
use crate::solver::discrete::heat::interpolated_across;
use crate::solver::discrete::reynolds::film_integrals::{PRODUCTION_RULE, film_integrals};
use crate::solver::discrete::reynolds::generalized::{NodeState, PlaneGradient};
use crate::solver::physics::lubricant::{LimitingStress, ScaledShear};
use crate::solver::warning::{PLAUSIBLE_EXPONENT, PLAUSIBLE_TRACTION, Warning};
use std::fmt::{Display, Formatter};

/// Shear stress \[Pa\] that every lubricant can carry. Under pressure it can carry more.
const CARRIED_PA: f64 = 5e6;

/// Reason why a traction is unphysical.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TractionDoubt {
    /// α* p_H, which exceeds [`PLAUSIBLE_EXPONENT`] without a limiting stress. α* is the reciprocal asymptotic
    /// isoviscous pressure coefficient, p_H the Hertzian pressure.
    Exponent(f64),
    /// Traction coefficient, which exceeds [`PLAUSIBLE_TRACTION`].
    Coefficient(f64),
    /// Shear stress at the maximum pressure, which exceeds the stress that a lubricant can carry there.
    Stress {
        /// Shear stress at mid-film \[Pa\].
        stress_pa: f64,
        /// Maximum pressure \[Pa\].
        pressure_pa: f64,
    },
}

impl TractionDoubt {
    /// Returns a short mark for the number.
    pub fn mark(self) -> &'static str {
        match self {
            Self::Exponent(_) | Self::Coefficient(_) => "unphysical",
            Self::Stress { .. } => "shear stress above the limit",
        }
    }
}

impl From<TractionDoubt> for Warning {
    fn from(doubt: TractionDoubt) -> Self {
        match doubt {
            TractionDoubt::Exponent(exponent) => Self::UnphysicalExponent { exponent },
            TractionDoubt::Coefficient(traction) => Self::UnphysicalTraction { traction },
            TractionDoubt::Stress { stress_pa, pressure_pa } => Self::ShearStressAboveLimit { stress_pa, pressure_pa },
        }
    }
}

impl Display for TractionDoubt {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        Warning::from(*self).fmt(f)
    }
}

/// Shear along X at one point of the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shear {
    /// Shear stress τ_zx \[Pa\].
    pub stress_pa: f64,
    /// Shear rate ∂u/∂z \[1/s\].
    pub rate_per_s: f64,
}

/// Shear stress across a film. It varies linearly from body 1 at Z = 0 to body 2 at Z = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
struct FilmStress {
    /// (τ_zx, τ_zy) at mid-film \[Pa\].
    mid_pa: [f64; 2],
    /// Differences of the stresses between the surfaces \[Pa\].
    across_pa: [f64; 2],
    /// μ, the viscosity at low shear stress \[Pa·s\].
    viscosity_pa_s: f64,
    /// Limiting stress and the pressure at the node \[Pa\].
    limit: Option<(LimitingStress, f64)>,
}

impl Solution {
    /// Thermal version of [`Self::shear_field`]; `None` for an isothermal solution.
    fn warm_shear_field(&self, heights: &[f64]) -> Option<Vec<Shear>> {
        let (heat, laws) = (self.heat.as_ref()?, self.problem.warm_laws()?);
        let (gradient, fields) = (self.gradient(), self.film_fields());
        let scale = laws.heat.stress_scale_pa;
        let mut field = Vec::new();
        let axis = self.y.len() - 1;
        for (i, rise_k) in (self.first()..self.x.len()).zip(heat.along_axis()) {
            let (state, k) = (self.state(&fields, &gradient, i, axis), i * self.y.len() + axis);
            for &height in heights {
                let stress =
                    heat.shear_stress[k] + laws.heat.gradient * state.film * state.gradient[0] * (height - 0.5);
                let theta = interpolated_across(rise_k, height) / heat.inlet_k;
                let fluidity = laws.fluidity(state.pressure, theta, stress);
                let (felt, rate) = (stress * scale, stress * fluidity * scale / self.problem.point.viscosity_pa_s);
                let limit = self.problem.lubricant.limiting_stress;
                let pressure_pa = state.pressure * self.problem.point.hertz().pressure_pa;
                let carried = limit.map_or(f64::INFINITY, |limit| limit.carried(felt.abs(), pressure_pa));
                field.push(Shear { stress_pa: carried.min(felt.abs()).copysign(felt), rate_per_s: rate });
            }
        }
        Some(field)
    }

    /// Returns the shear along the axis Y = 0 at heights z = Z h above body 1, 0 ≤ Z ≤ 1. The values are in the order
    /// of [`Solution::profile`], all heights of a node one after the other. They are positive if body 2 is faster. A
    /// limiting stress limits the stress; the rate is that without this limit.
    pub fn shear_field(&self, heights: &[f64]) -> Vec<Shear> {
        if let Some(field) = self.warm_shear_field(heights) {
            return field;
        }
        let (gradient, fields) = (self.gradient(), self.film_fields());
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
        let films = (self.first()..self.x.len())
            .map(|i| FilmStress::new(&self.problem, self.state(&fields, &gradient, i, axis)));
        films.flat_map(|film| heights.iter().map(move |height| shear(&film, *height))).collect()
    }

    /// Returns the traction coefficient (3.41): the integral of the mid-film shear stress over the whole domain,
    /// divided by the load. It uses the trapezoidal rule and includes both halves of a point contact. Positive for
    /// SRR > 0. An integral over the area with P > 0 alone would be about 0.1 to 2 % smaller. The friction of touching
    /// asperities is included.
    pub fn traction_coefficient(&self) -> f64 {
        self.fluid_traction() + self.boundary_traction()
    }

    /// Returns the part of the traction coefficient due to the film.
    pub fn fluid_traction(&self) -> f64 {
        if self.problem.point.sliding.slide_to_roll_ratio == 0.0 {
            return 0.0;
        }
        let stress = self.mid_film_stress();
        self.force_per_load(|k| stress[k])
    }

    /// Returns τ_zx \[Pa\] at mid-film at every node of the arrays, limited by the limiting stress if there is one.
    /// In a thermal solution it is zero at nodes without pressure.
    pub fn mid_film_stress(&self) -> Vec<f64> {
        if let Some(heat) = &self.heat {
            return heat.mid_stress_pa.clone();
        }
        let (gradient, fields) = (self.gradient(), self.film_fields());
        let ny = self.y.len();
        let mut stress = vec![0.0; self.pressure.len()];
        // Shear-thinning takes an iteration per node; other stresses are faster than a change of threads.
        let least = if self.problem.shear.is_some() { 256 } else { 4096 };
        pool::each(&mut stress, least, |k, stress| {
            *stress = mid_film_stress(&self.problem, self.state(&fields, &gradient, k / ny, k % ny));
        });
        stress
    }

    /// Returns the pressure, its gradient and the thickness of the film at node (i, j).
    fn state(&self, fields: &FilmFields<'_>, gradient: &PlaneGradient, i: usize, j: usize) -> NodeState {
        let (k, FilmFields { pressure, thickness }) = (i * self.y.len() + j, fields);
        NodeState { pressure: pressure[k], gradient: gradient.at(pressure, i, j), film: thickness[k] }
    }

    /// Returns a message if every traction of its problem is unphysical. `None` in pure rolling, where there is no
    /// traction.
    pub fn traction_warning(&self) -> Option<String> {
        let slides = self.problem.point.sliding.slide_to_roll_ratio != 0.0;
        slides.then(|| self.problem.traction_warning()).flatten()
    }
}

impl Problem {
    /// Returns the reason why the traction coefficient of a solution with these scalars is unphysical. The reasons
    /// are: every traction of this problem is unphysical; the coefficient is larger than any measured one; or the
    /// shear stress is larger than a lubricant can carry. `None` without traction.
    pub fn doubts_traction(&self, traction: f64, scalars: &Scalars) -> Option<TractionDoubt> {
        if traction == 0.0 {
            return None;
        }
        // In a thermal solution the viscosity falls before the stress becomes unphysical.
        let isothermal = self.heat.is_none();
        let too_large = || (traction.abs() > PLAUSIBLE_TRACTION).then_some(TractionDoubt::Coefficient(traction));
        self.doubts_every_traction().or_else(too_large).or_else(|| self.doubts_stress(scalars).filter(|_| isothermal))
    }

    /// Returns the reason why every traction is unphysical: a large α* p_H without a limiting stress.
    pub fn doubts_every_traction(&self) -> Option<TractionDoubt> {
        let exponent = self.fluid.reciprocal_asymptotic_exponent();
        (self.is_unlimited() && self.heat.is_none() && exponent > PLAUSIBLE_EXPONENT)
            .then_some(TractionDoubt::Exponent(exponent))
    }

    /// Returns the same reason as a message.
    pub fn traction_warning(&self) -> Option<String> {
        self.doubts_every_traction().map(|doubt| doubt.to_string())
    }

    fn is_unlimited(&self) -> bool {
        self.lubricant.limiting_stress.is_none()
    }

    /// Checks the shear stress at the maximum pressure, where the film is nearly parallel.
    fn doubts_stress(&self, scalars: &Scalars) -> Option<TractionDoubt> {
        let film = self.rough.map_or(scalars.h_c, |rough| rough.mean_gap(scalars.h_c).0);
        let state = NodeState { pressure: scalars.p_max, gradient: [0.0; 2], film };
        let pressure_pa = scalars.p_max * self.point.hertz().pressure_pa;
        let stress_pa = mid_film_stress(self, state).abs();
        let above = stress_pa > CARRIED_PA + PLAUSIBLE_TRACTION * pressure_pa;
        (self.is_unlimited() && above).then_some(TractionDoubt::Stress { stress_pa, pressure_pa })
    }
}

/// Returns τ_zx \[Pa\] at mid-film of one node, limited by the limiting stress if there is one.
fn mid_film_stress(problem: &Problem, state: NodeState) -> f64 {
    mid_film_stresses(problem, state).0
}

/// Returns [`mid_film_stress`] and its value without a limit.
pub(crate) fn mid_film_stresses(problem: &Problem, state: NodeState) -> (f64, f64) {
    let film = FilmStress::new(problem, state);
    (film.limited(film.mid_pa)[0], film.mid_pa[0])
}

impl FilmStress {
    /// Computes the shear stress of a node's film.
    fn new(problem: &Problem, NodeState { pressure, gradient, film }: NodeState) -> Self {
        let (point, hertz) = (&problem.point, problem.point.hertz());
        let viscosity = problem.fluid.at(pressure.max(0.0)).viscosity;
        let (across_pa, mid_pa) = match &problem.shear {
            None => {
                // κ₁ and κ₂ of (3.27).
                let kappa_1 = point.gradient_stress_pa();
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

    /// Returns (τ_zx, τ_zy) at height Z.
    fn at(&self, height: f64) -> [f64; 2] {
        [0, 1].map(|axis| self.mid_pa[axis] + (height - 0.5) * self.across_pa[axis])
    }

    /// Limits a stress to the one that the lubricant can carry and keeps its direction.
    fn limited(&self, stress: [f64; 2]) -> [f64; 2] {
        let Some((limit, pressure_pa)) = self.limit else { return stress };
        let size = stress[0].hypot(stress[1]);
        let carried = limit.carried(size, pressure_pa);
        if carried < size { stress.map(|part| part * carried / size) } else { stress }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::contact::{OperatingPoint, Sliding};
    use crate::solver::physics::lubricant::{LimitingStress, Lubricant};

    #[test]
    fn what_no_lubricant_carries_is_doubted_for_the_reason_it_has() {
        let soft = OperatingPoint { alpha_per_pa: 1e-8, ..OperatingPoint::TABLE_2_1 };
        let limited = Lubricant {
            limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: None }),
            ..Lubricant::default()
        };
        let scalars = Scalars { p_max: 1.0, h_c: 0.01, ..Scalars::default() };
        let cases = [
            (soft, Lubricant::default(), 1e-3, 1e-3, None),
            (soft, Lubricant::default(), 1e-3, 0.2, Some("unphysical")),
            (soft, Lubricant::default(), 1.9, 0.1, Some("shear stress above the limit")),
            (soft, limited, 1.9, 0.1, None),
            (soft, Lubricant::default(), 1.9, 0.0, None),
            (OperatingPoint::TABLE_2_1, Lubricant::default(), 1e-3, 1e-3, Some("unphysical")),
        ];
        for (point, lubricant, srr, traction, wanted) in cases {
            let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
            let problem = Problem::new(&OperatingPoint { sliding, ..point }, lubricant).unwrap();
            let doubt = problem.doubts_traction(traction, &scalars);
            assert_eq!(doubt.map(TractionDoubt::mark), wanted, "SRR {srr}, µ {traction}: {doubt:?}");
            assert!(doubt.is_none_or(|doubt| doubt.to_string().contains(['u', 'l'])));
        }
    }
}
