//! Key of a result.

use crate::scene::{Grid, Method, ModelSource, Request};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::engineering::Extent;
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use serde::{Deserialize, Serialize};

/// Key of a result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Key {
    /// Operating point.
    pub point: OperatingPoint,
    /// Laws of the lubricant.
    pub lubricant: Lubricant,
}

impl Key {
    /// Returns the same contact with exchanged bodies and the opposite sign of SRR.
    pub fn exchanged(mut self) -> Self {
        self.point.sliding.slide_to_roll_ratio *= -1.0;
        self.lubricant.heat.iter_mut().for_each(|heat| heat.bodies.reverse());
        self.lubricant.roughness.iter_mut().for_each(|roughness| roughness.shear_flow *= -1.0);
        self
    }

    /// Returns a request for the contact on a grid.
    pub fn request(&self, grid: Grid, method: Method) -> Request {
        let Self { point, lubricant } = *self;
        Request { point, lubricant, grid, grid_model: ModelSource::Embedded, method, extent: Extent::default() }
    }

    /// Returns true if pressure and film thickness are the same. In an isothermal contact a limiting stress changes
    /// only the traction, and the film thickness of a Newtonian lubricant does not depend on the sliding.
    pub fn has_film_of(&self, other: &Self) -> bool {
        let film = |key: &Self| {
            let (mut point, law) = (key.point, key.lubricant.shear);
            let plateau = point.sliding.newtonian_plateau_ratio.unwrap_or(law.plateau());
            let slides = key.lubricant.roughness.is_some_and(|roughness| roughness.shear_flow != 0.0);
            if (law == ShearLaw::Newtonian || plateau == 1.0) && key.lubricant.heat.is_none() && !slides {
                point.sliding.slide_to_roll_ratio = 0.0;
            }
            // In a thermal contact a limiting stress reduces the shear heating and thereby changes the film
            // thickness.
            let laws = if key.lubricant.heat.is_some() { key.lubricant } else { key.lubricant.of_the_film() };
            (point, laws)
        };
        film(self) == film(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::named_lubricant::SQUALANE_PIP;
    use crate::solver::full::Problem;
    use crate::solver::physics::bodies::Material;
    use crate::solver::physics::contact::Sliding;
    use crate::solver::physics::lubricant::{Heat, LimitingStress};

    #[test]
    fn an_exchanged_contact_has_the_same_body_at_the_same_speed() {
        let bodies = [Material::GLASS.heat, Material::STEEL.heat];
        let sliding = Sliding { slide_to_roll_ratio: -0.4, newtonian_plateau_ratio: None };
        let lubricant = Lubricant { heat: Some(Heat { bodies, ..Heat::default() }), ..Lubricant::default() };
        let key = Key { point: OperatingPoint { sliding, ..OperatingPoint::TABLE_2_1 }, lubricant };
        let heat = |key: Key| Problem::new(&key.point, key.lubricant).unwrap().heat.unwrap();
        let (own, other) = (heat(key), heat(key.exchanged()));
        assert_eq!((own.speeds, own.heat.bodies), ([1.2, 0.8], bodies));
        assert_eq!((other.speeds, other.heat.bodies), ([0.8, 1.2], [bodies[1], bodies[0]]));
        assert_eq!(key.exchanged().exchanged(), key);
    }

    #[test]
    fn sliding_changes_the_film_only_where_it_thins() {
        let slid = |lubricant, srr, npr| {
            let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: npr };
            Key { point: OperatingPoint { sliding, ..OperatingPoint::TABLE_2_1 }, lubricant }
        };
        let oil = Lubricant::default();
        assert!(slid(oil, 0.0, None).has_film_of(&slid(oil, 0.7, None)));
        assert!(!slid(SQUALANE_PIP, 0.0, None).has_film_of(&slid(SQUALANE_PIP, 0.7, None)));
        assert!(slid(SQUALANE_PIP, 0.0, Some(1.0)).has_film_of(&slid(SQUALANE_PIP, 0.7, Some(1.0))));
        let limited = Lubricant {
            limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.0, eyring: None }),
            ..SQUALANE_PIP
        };
        assert!(slid(limited, 0.7, None).has_film_of(&slid(SQUALANE_PIP, 0.7, None)));
        assert!(!slid(oil, 0.0, None).has_film_of(&slid(SQUALANE_PIP, 0.0, None)));
    }
}
