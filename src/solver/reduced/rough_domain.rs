//! Rough surfaces that a reduced model covers. The reduced equations contain the laws of the contact, but the modes are
//! those of the training: surfaces much stiffer or softer, or with much more or less flow between them, have pressures
//! that the modes do not represent.

use super::domain::Domain;
use crate::solver::full::Problem;
use crate::solver::parameters::{Outside, Quantity};
use crate::solver::physics::contact::DEFAULT_MODULUS_PA;

/// Separations l at which asperity pressures are compared.
const SEPARATIONS: [f64; 3] = [0.0, 1.0, 2.0];
/// Asperity pressures relative to those of the training.
const PRESSURES: (f64, f64) = (0.5, 1.2);
/// Peklenik numbers relative to that of the training. Ridges across the flow are closer to the training than those
/// along it, for which errors exceed their bounds.
const PEKLENIKS: (f64, f64) = (1.0 / 3.0, 1.0);
/// The same for circular contacts, whose reduced equations have the same flow along X and across.
const PEKLENIKS_OF_CIRCLES: (f64, f64) = (1.0, 1.0);
/// Largest factor ½ |SRR (σ₁² − σ₂²)|/σ² of the shear flow.
const SHEAR_FLOW: f64 = 0.05;

impl Domain {
    /// Returns the reason why the rough surfaces of a problem are not covered; `None` for smooth ones.
    pub(super) fn other_surfaces(&self, problem: &Problem) -> Option<Outside> {
        let (own, asked) = self.lubricant.roughness.zip(problem.lubricant.roughness)?;
        let outside = |text: String| Some(Outside::Other(text));
        let modulus_pa = self.interval(Quantity::Modulus).map_or(DEFAULT_MODULUS_PA, |(low, high)| (low * high).sqrt());
        let (same, given_pa) = (asked.asperities == own.asperities, problem.point.modulus_pa);
        let ratio = |l: f64| asked.asperities.pressure(given_pa, l).0 / own.asperities.pressure(modulus_pa, l).0;
        let far = |ratio: &f64| !within(*ratio, PRESSURES);
        if let Some(ratio) = SEPARATIONS.map(ratio).iter().find(|ratio| !(same && given_pa == modulus_pa) && far(ratio))
        {
            let (low, high) = PRESSURES;
            return outside(format!(
                "asperities carry {ratio:.2} times the pressure of those of the training ({low}…{high})"
            ));
        }
        let pekleniks = if self.contact.is_line() { PEKLENIKS } else { PEKLENIKS_OF_CIRCLES };
        if !within(asked.peklenik / own.peklenik, pekleniks) {
            let [low, high] = [pekleniks.0, pekleniks.1].map(|factor| factor * own.peklenik);
            return outside(match low == high {
                true => format!("the Peklenik number {:.2} is not that of the training, {low:.2}", asked.peklenik),
                false => format!("the Peklenik number {:.2} lies outside {low:.2}…{high:.2}", asked.peklenik),
            });
        }
        let shear = 0.5 * (problem.point.sliding.slide_to_roll_ratio * asked.shear_flow).abs();
        if !within(shear, (0.0, SHEAR_FLOW)) {
            return outside(format!(
                "the shear flow ½ |SRR (σ₁² − σ₂²)|/σ² = {shear:.2} exceeds {SHEAR_FLOW} of the training"
            ));
        }
        None
    }
}

fn within(value: f64, (low, high): (f64, f64)) -> bool {
    const ROUNDING: f64 = 1e-9;
    (low * (1.0 - ROUNDING)..=high * (1.0 + ROUNDING)).contains(&value)
}
