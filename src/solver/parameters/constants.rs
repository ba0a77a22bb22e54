//! Lubricants with random constants of a space.

use super::quantity::Quantity;
use super::space::ParameterSpace;
use crate::solver::physics::lubricant::Lubricant;
use fastrand::Rng;

/// Share of contacts whose bodies have the same material.
const ALIKE: f64 = 0.5;

impl ParameterSpace {
    /// Returns a lubricant with random values of the varied constants, or the lubricant itself if none varies. In
    /// half of all cases both bodies have the same material.
    pub fn with_random_constants(&self, mut lubricant: Lubricant, rng: &mut Rng) -> Lubricant {
        let (mut alike, mut first) = (false, 0.0);
        for axis in &self.constants {
            let value = match axis.quantity {
                Quantity::Effusivity2 => {
                    alike = rng.f64() < ALIKE;
                    first = axis.value(rng.f64());
                    first
                }
                Quantity::Effusivity1 if alike => first,
                _ => axis.value(rng.f64()),
            };
            lubricant = axis.quantity.with_constant(lubricant, value);
        }
        lubricant
    }

    /// Returns a thermal lubricant with random constants, on which its film depends. Any other lubricant is returned
    /// unchanged.
    pub fn with_random_heat(&self, lubricant: Lubricant, rng: &mut Rng) -> Lubricant {
        if lubricant.heat.is_some() { self.with_random_constants(lubricant, rng) } else { lubricant }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::parameters::Axis;
    use crate::solver::physics::lubricant::{Heat, LimitingStress};

    #[test]
    fn random_constants_lie_inside_and_reach_the_ends() {
        let axes = [
            (Quantity::InletTemperature, (283.0, 393.0)),
            (Quantity::ViscosityTemperature, (0.02, 0.06)),
            (Quantity::Conductivity, (0.1, 0.18)),
            (Quantity::HeatCapacity, (1.4e6, 2.1e6)),
            (Quantity::LimitAmbient, (0.0, 10e6)),
            (Quantity::LimitSlope, (0.03, 0.12)),
            (Quantity::LimitEyring, (2e6, 12e6)),
            (Quantity::Effusivity2, (2500.0, 20e3)),
            (Quantity::Effusivity1, (2500.0, 20e3)),
        ];
        let constants = axes.map(|(quantity, ends)| Axis::new(quantity, ends)).to_vec();
        let space = ParameterSpace { constants, ..ParameterSpace::table_3_1() };
        let limit = LimitingStress { ambient: 5e6, slope: 0.05, eyring: Some(5e6) };
        let own = Lubricant { heat: Some(Heat::default()), limiting_stress: Some(limit), ..Lubricant::default() };
        let mut rng = Rng::with_seed(3);
        let all: Vec<Lubricant> = (0..400).map(|_| space.with_random_constants(own, &mut rng)).collect();
        assert!(all.iter().all(|lubricant| lubricant.check().is_ok()));
        let point = crate::solver::physics::contact::OperatingPoint::TABLE_2_1;
        for (quantity, (low, high)) in axes {
            let values = || all.iter().map(|lubricant| quantity.of_contact(&point, lubricant).unwrap());
            let (least, most) = values().fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
            let width = high - low;
            assert!(least >= low - 1e-9 * width && least < low + 0.1 * width, "{quantity:?} from {least}");
            assert!(most <= high + 1e-9 * width && most > high - 0.1 * width, "{quantity:?} to {most}");
        }
        let heats = || all.iter().filter_map(|lubricant| lubricant.heat);
        let alike = heats().filter(|heat| heat.bodies[0] == heat.bodies[1]).count();
        assert!((150..250).contains(&alike), "{alike}");
    }
}
