//! Thermal constants and limiting stresses that a model of contacts with heat knows beside those of its own lubricant.
//!
//! Temperatures have no basis: they are marched with the constants of the contact that is asked for. What pressures look like
//! hangs on them little, so that a basis knows all by a few of them; errors are measured over the whole range.

use super::Bounded;
use crate::solver::limits::{Refused, interval};
use crate::solver::physics::bodies::BodyHeat;
use crate::solver::physics::lubricant::{Heat, LimitingStress, Lubricant, OilHeat};
use fastrand::Rng;
use serde::{Deserialize, Serialize};

/// Smallest and largest of each constant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ThermalDomain {
    /// Temperature T₀ in front of the contact \[K\].
    pub inlet_temperature: (f64, f64),
    /// β of the oil \[1/K\].
    pub viscosity_temperature: (f64, f64),
    /// β_ρ of the oil \[1/K\].
    pub density_temperature: (f64, f64),
    /// k of the oil \[W/(m K)\].
    pub conductivity: (f64, f64),
    /// ρ₀c of the oil \[J/(m³ K)\].
    pub heat_capacity: (f64, f64),
    /// √(kρc) of either body \[J/(m² K √s)\].
    pub effusivity: (f64, f64),
    /// τ_L0 of the limiting stress \[Pa\].
    pub limit_ambient: (f64, f64),
    /// Its slope Λ.
    pub limit_slope: (f64, f64),
    /// Its τ_E \[Pa\].
    pub limit_eyring: (f64, f64),
}

impl ThermalDomain {
    /// Refuses what is empty, inverted or beyond any sense.
    ///
    /// # Errors
    /// Naming the interval.
    pub fn check(&self) -> Result<(), Refused> {
        let intervals = [
            ("inlet_temperature", self.inlet_temperature, (200.0, 600.0)),
            ("viscosity_temperature", self.viscosity_temperature, (0.0, 0.2)),
            ("density_temperature", self.density_temperature, (0.0, 0.01)),
            ("conductivity", self.conductivity, (1e-3, 100.0)),
            ("heat_capacity", self.heat_capacity, (1e4, 1e8)),
            ("effusivity", self.effusivity, (10.0, 1e6)),
            ("limit_ambient", self.limit_ambient, (0.0, 1e9)),
            ("limit_slope", self.limit_slope, (1e-3, 1.0)),
            ("limit_eyring", self.limit_eyring, (1e4, 1e9)),
        ];
        intervals.into_iter().try_for_each(|(name, own, (low, high))| interval(name, own, low, high))
    }

    /// A sentence that says in what a lubricant and its bodies lie outside.
    pub fn outside(&self, lubricant: &Lubricant) -> Option<String> {
        let heat = lubricant.heat?;
        let Heat { inlet_temperature, oil, bodies } = heat;
        let Some(LimitingStress { ambient, slope, eyring: Some(eyring) }) = lubricant.limiting_stress else {
            return Some(
                "the model was trained with limiting stresses that have a τ_E, which with heat change the film".into(),
            );
        };
        if oil.free_volume.is_some() {
            return Some("the model was trained with oils whose α does not change with temperature".into());
        }
        let bounded = |name, value, range, (scale, unit)| Bounded { name, value, range, scale, unit };
        let plain = |unit| (1.0, unit);
        let [body_1, body_2] = bodies.map(|body| body.effusivity());
        [
            bounded("the inlet’s temperature", inlet_temperature, self.inlet_temperature, plain(" K")),
            bounded("β", oil.viscosity_temperature, self.viscosity_temperature, plain("/K")),
            bounded("β_ρ", oil.density_temperature, self.density_temperature, (1e3, " ‰/K")),
            bounded("the oil’s thermal conductivity", oil.conductivity, self.conductivity, plain(" W/(m K)")),
            bounded("ρ₀c of the oil", oil.density * oil.heat_capacity, self.heat_capacity, (1e-6, " MJ/(m³ K)")),
            bounded("√(kρc) of body 1", body_1, self.effusivity, plain(" J/(m² K √s)")),
            bounded("√(kρc) of body 2", body_2, self.effusivity, plain(" J/(m² K √s)")),
            bounded("τ_L0 of the limiting stress", ambient, self.limit_ambient, (1e-6, " MPa")),
            bounded("Λ of the limiting stress", slope, self.limit_slope, plain("")),
            bounded("τ_E of the limiting stress", eyring, self.limit_eyring, (1e-6, " MPa")),
        ]
        .iter()
        .find_map(Bounded::outside)
    }

    /// A lubricant of its range with bodies of two materials, or in every second case of one.
    pub fn drawn(&self, own: Lubricant, rng: &mut Rng) -> Lubricant {
        let mut between = |(low, high): (f64, f64)| low + (high - low) * rng.f64();
        let inlet_temperature = between(self.inlet_temperature);
        let oil = OilHeat {
            viscosity_temperature: between(self.viscosity_temperature),
            density_temperature: between(self.density_temperature),
            conductivity: between(self.conductivity),
            ..own.heat.unwrap_or_default().oil
        };
        let oil = OilHeat { heat_capacity: between(self.heat_capacity) / oil.density, ..oil };
        let limit = LimitingStress {
            ambient: between(self.limit_ambient),
            slope: between(self.limit_slope),
            eyring: Some(between(self.limit_eyring)),
        };
        let alike = between((0.0, 1.0)) < 0.5;
        let (low, high) = self.effusivity;
        let mut body = || {
            let wanted = low * (high / low).powf(between((0.0, 1.0)));
            let steel = BodyHeat::default();
            BodyHeat { conductivity: steel.conductivity * (wanted / steel.effusivity()).powi(2), ..steel }
        };
        let faster = body();
        let bodies = [if alike { faster } else { body() }, faster];
        let heat = Heat { inlet_temperature, oil, bodies };
        Lubricant { heat: Some(heat), limiting_stress: Some(limit), ..own }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RANGE: ThermalDomain = ThermalDomain {
        inlet_temperature: (283.0, 393.0),
        viscosity_temperature: (0.02, 0.06),
        density_temperature: (0.0, 1e-3),
        conductivity: (0.1, 0.18),
        heat_capacity: (1.4e6, 2.1e6),
        effusivity: (2500.0, 20e3),
        limit_ambient: (0.0, 10e6),
        limit_slope: (0.03, 0.12),
        limit_eyring: (2e6, 12e6),
    };

    fn own() -> Lubricant {
        let limit = LimitingStress { ambient: 5e6, slope: 0.05, eyring: Some(5e6) };
        Lubricant { heat: Some(Heat::default()), limiting_stress: Some(limit), ..Lubricant::default() }
    }

    #[test]
    fn what_is_drawn_lies_inside_and_reaches_the_ends() {
        let mut rng = Rng::with_seed(3);
        let all: Vec<Lubricant> = (0..400).map(|_| RANGE.drawn(own(), &mut rng)).collect();
        assert!(all.iter().all(|lubricant| RANGE.outside(lubricant).is_none() && lubricant.check().is_ok()));
        let heats = || all.iter().filter_map(|lubricant| lubricant.heat);
        let alike = heats().filter(|heat| heat.bodies[0] == heat.bodies[1]).count();
        assert!((150..250).contains(&alike), "{alike}");
        let coldest = heats().map(|heat| heat.inlet_temperature).fold(f64::INFINITY, f64::min);
        let slowest = heats().map(|heat| heat.bodies[0].effusivity()).fold(f64::INFINITY, f64::min);
        assert!(coldest < 284.0 && slowest < 2700.0, "{coldest} {slowest}");
        assert!(RANGE.check().is_ok() && RANGE.outside(&own()).is_none());
    }

    #[test]
    fn what_lies_outside_is_named() {
        let changed = |change: &dyn Fn(&mut Lubricant)| {
            let mut lubricant = own();
            change(&mut lubricant);
            RANGE.outside(&lubricant).unwrap_or_default()
        };
        let heat = |change: &dyn Fn(&mut Heat)| changed(&|lubricant| lubricant.heat.iter_mut().for_each(change));
        assert!(heat(&|heat| heat.inlet_temperature = 420.0).contains("the inlet’s temperature = 420 K lies outside"));
        assert!(heat(&|heat| heat.oil.heat_capacity *= 2.0).contains("ρ₀c of the oil"));
        assert!(heat(&|heat| heat.bodies[1].conductivity = 0.2).contains("body 2"));
        let limit = |slope, eyring| {
            changed(&|lubricant| lubricant.limiting_stress = Some(LimitingStress { ambient: 5e6, slope, eyring }))
        };
        assert!(
            limit(0.2, Some(5e6)).contains("Λ of the limiting stress = 0.2 lies outside the trained range 0.03…0.12")
        );
        assert!(limit(0.05, None).contains("τ_E"));
        assert!(changed(&|lubricant| lubricant.limiting_stress = None).contains("limiting stresses"));
        let spoiled = ThermalDomain { conductivity: (0.2, 0.1), ..RANGE };
        assert!(spoiled.check().unwrap_err().to_string().contains("conductivity"));
    }
}
