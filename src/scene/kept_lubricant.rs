//! Lubricant that a scene keeps under a name, such as a fitted one.

use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use serde::{Deserialize, Serialize};

/// Lubricant kept under a name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeptLubricant {
    /// Name.
    pub name: String,
    /// Laws and constants, without cavitation, heat and roughness, which belong to the contact.
    pub laws: Lubricant,
    /// Viscosity η₀ \[Pa·s\].
    pub viscosity_pa_s: f64,
    /// Pressure–viscosity coefficient α \[1/Pa\].
    pub alpha_per_pa: f64,
}

impl KeptLubricant {
    /// Largest number of letters of a name.
    pub const LONGEST: usize = 60;
    /// Largest number of lubricants of a scene.
    pub const MOST: usize = 100;

    /// Returns the lubricant of a contact.
    pub fn of(name: &str, point: &OperatingPoint, lubricant: &Lubricant) -> Self {
        Self {
            name: name.to_owned(),
            laws: of_contact(lubricant, &Lubricant::default()),
            viscosity_pa_s: point.viscosity_pa_s,
            alpha_per_pa: point.alpha_per_pa,
        }
    }

    /// Returns a contact and its laws with this lubricant. Cavitation, heat and roughness stay.
    pub fn in_place(&self, point: &OperatingPoint, present: &Lubricant) -> (OperatingPoint, Lubricant) {
        let Self { viscosity_pa_s, alpha_per_pa, laws, .. } = self;
        let point = OperatingPoint { viscosity_pa_s: *viscosity_pa_s, alpha_per_pa: *alpha_per_pa, ..*point };
        (point, of_contact(laws, present))
    }

    /// Returns true if a contact has this lubricant.
    pub fn is_of(&self, point: &OperatingPoint, lubricant: &Lubricant) -> bool {
        self.in_place(point, lubricant) == (*point, *lubricant)
    }
}

/// Returns the laws with cavitation, heat and roughness of others.
fn of_contact(laws: &Lubricant, others: &Lubricant) -> Lubricant {
    let Lubricant { cavitation, heat, roughness, .. } = *others;
    Lubricant { cavitation, heat, roughness, ..*laws }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::lubricant::{Cavitation, Heat};

    #[test]
    fn a_kept_lubricant_changes_neither_bodies_nor_heat() {
        let (point, laws) = (OperatingPoint::TABLE_2_1, Lubricant::default());
        let warm = Lubricant { heat: Some(Heat::default()), cavitation: Cavitation::Complementarity, ..laws };
        let other = OperatingPoint { viscosity_pa_s: 0.1, alpha_per_pa: 1e-8, speed_m_per_s: 1.0, ..point };
        let kept = KeptLubricant::of("oil", &other, &warm);
        assert_eq!((kept.laws.heat, kept.laws.cavitation), (None, Cavitation::default()));
        let (placed, with) = kept.in_place(&point, &warm);
        assert_eq!((placed.viscosity_pa_s, placed.speed_m_per_s, with), (0.1, point.speed_m_per_s, warm));
        assert!(kept.is_of(&placed, &with) && !kept.is_of(&point, &warm));
    }
}
