//! Sliding contacts of many oils that thin under shear by Eyring's law.
//!
//! Films answer to N = p_H (a/R)/τ₀ and SRR beside M, L, p_H and z: of E′ and τ₀ the product alone counts.

use super::{Bounded, Domain, digits};
use crate::solver::full::Problem;
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{LimitingStress, Lubricant, ShearLaw};
use crate::solver::reduced::oils::expected_film;
use serde::{Deserialize, Serialize};

/// What a model of many oils that thin under shear by Eyring's law is trained for beside these.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EyringDomain {
    /// |SRR|.
    pub srr: (f64, f64),
    /// E′ \[Pa\] at the τ₀ of the model's lubricant; of another τ₀ it is the product with that which counts.
    pub modulus_pa: (f64, f64),
    /// Λ \[-\] of the limiting stresses that its traction knows, at that τ₀; of another it is Λ over that which counts.
    pub limit_slope: (f64, f64),
    /// Largest stress that the pressure's gradient makes across a film \[Pa\], by [`gradient_stress`], at that τ₀.
    pub gradient_stress_pa: f64,
}

/// The difference of stress \[Pa\] that a gradient of p_H over the half-width makes across a film of the thickness that
/// Moes' formula expects.
pub fn gradient_stress(point: &OperatingPoint) -> f64 {
    point.gradient_stress_pa() * expected_film(point.kind, point.moes())
}

/// The Eyring stress of a law \[Pa\]; none of another one.
pub(super) fn eyring_stress(law: ShearLaw) -> Option<f64> {
    match law {
        ShearLaw::Eyring { critical_stress, .. } => Some(critical_stress),
        ShearLaw::Newtonian | ShearLaw::Carreau { .. } | ShearLaw::Ellis { .. } => None,
    }
}

impl EyringDomain {
    /// A sentence that says in what a problem lies outside, whose lubricant has so many times the trained τ₀.
    pub(super) fn outside(&self, problem: &Problem, stresses: f64) -> Option<String> {
        let (point, plateau) = (&problem.point, problem.lubricant.shear.plateau());
        let given = point.sliding.newtonian_plateau_ratio.unwrap_or(plateau);
        if given != plateau {
            return Some(format!("the model was trained with an NPR of {plateau}, not {given}"));
        }
        let srr = point.sliding.slide_to_roll_ratio.abs();
        let srr = Bounded { name: "SRR", value: srr, range: self.srr, scale: 1.0, unit: "" };
        srr.outside().or_else(|| self.other_stress(problem, stresses))
    }

    /// A sentence where the gradient of the pressure shears a film by more than was trained.
    fn sheared_film(&self, point: &OperatingPoint, stresses: f64) -> Option<String> {
        let (made, most) = (gradient_stress(point), self.gradient_stress_pa * stresses);
        (made > most * (1.0 + 1e-6)).then(|| {
            let [made, most] = [made, most].map(|stress| digits(1e-6 * stress));
            format!(
                "its film is so thick that the pressure’s gradient shears it by {made} MPa, more than the {most} MPa that \
                 were trained for this τ₀"
            )
        })
    }

    /// A sentence where E′ τ₀ lies outside.
    fn other_stress(&self, problem: &Problem, stresses: f64) -> Option<String> {
        let (modulus, (low, high)) = (problem.point.modulus_pa, self.modulus_pa);
        let product = modulus * stresses;
        let inside = product >= low * (1.0 - 1e-6) && product <= high * (1.0 + 1e-6);
        (!inside).then(|| {
            let stress = eyring_stress(problem.lubricant.shear).unwrap_or_default();
            let at = |own: f64| digits(1e-6 * stress * own / product);
            let [stress, low, high, modulus] = [digits(1e-6 * stress), at(low), at(high), digits(1e-9 * modulus)];
            format!(
                "the Eyring stress τ₀ = {stress} MPa lies outside the range {low}…{high} MPa trained for E' = {modulus} GPa"
            )
        })
    }
}

impl Domain {
    /// How many times the τ₀ of a model of many oils that thin by Eyring's law a lubricant has; none of other models and
    /// laws.
    pub(super) fn stresses(&self, lubricant: &Lubricant) -> Option<f64> {
        self.eyring?;
        Some(eyring_stress(lubricant.shear)? / eyring_stress(self.lubricant.shear)?)
    }

    /// A sentence where a film is so thick that its pressure shears it by more than was trained.
    pub(super) fn sheared_film(&self, problem: &Problem) -> Option<String> {
        self.eyring?.sheared_film(&problem.point, self.stresses(&problem.lubricant)?)
    }

    /// The contact that has the film of another one and the model's own τ₀: of equal M, L, p_H, oil and SRR, with E′ τ₀ as
    /// it was. The contact itself where the model has no such τ₀.
    pub(crate) fn as_trained(&self, point: &OperatingPoint, lubricant: &Lubricant) -> OperatingPoint {
        let Some(stresses) = self.stresses(lubricant) else { return *point };
        // 2U goes with E′⁻⁴ at a given L; then the speed follows from 2U E′ R, and the load from M.
        let load = match point.kind {
            ContactKind::Line => stresses.recip(),
            ContactKind::Point => stresses.powi(-2),
        };
        OperatingPoint {
            modulus_pa: point.modulus_pa * stresses,
            speed_m_per_s: point.speed_m_per_s * stresses.powi(-3),
            load: point.load * load,
            ..*point
        }
    }

    /// Whether the rules for the traction were fitted to stresses like those of a problem: to such that nothing cuts, of
    /// oils that thin by Eyring's law to some that are cut as well; with heat to those of the model's own limit.
    pub(crate) fn knows_traction(&self, problem: &Problem) -> bool {
        let Some(limit) = problem.lubricant.limiting_stress else { return true };
        match self.eyring.zip(self.stresses(&problem.lubricant)) {
            Some((eyring, stresses)) => eyring.knows_limit(limit, stresses),
            None => problem.heat.is_some(),
        }
    }
}

impl EyringDomain {
    fn knows_limit(&self, LimitingStress { slope, .. }: LimitingStress, stresses: f64) -> bool {
        let (low, high) = self.limit_slope;
        let own = slope / stresses;
        own >= low * (1.0 - 1e-6) && own <= high * (1.0 + 1e-6)
    }
}
