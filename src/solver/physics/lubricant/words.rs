//! Description of a lubricant as text.

use super::{Cavitation, DensityLaw, Doolittle, Heat, LimitingStress, Lubricant, ShearLaw, Tait, ViscosityLaw};

impl Lubricant {
    /// Returns all laws with their constants in SI units as text, for table headers.
    pub fn describe(&self) -> String {
        let tait = |volume: &Tait| format!("K_0 {:e} Pa, K_0' {:e}", volume.k_0, volume.k_0_prime);
        let viscosity = match &self.viscosity {
            ViscosityLaw::Barus => "Barus viscosity".to_owned(),
            ViscosityLaw::Roelands => "Roelands viscosity".to_owned(),
            ViscosityLaw::Doolittle(Doolittle { b, r_0, volume }) => {
                format!("Doolittle viscosity (B {b:e}, R_0 {r_0:e}, {})", tait(volume))
            }
        };
        let density = match &self.density {
            DensityLaw::Incompressible => "constant density".to_owned(),
            DensityLaw::DowsonHigginson => "Dowson-Higginson density".to_owned(),
            DensityLaw::Tait(volume) => format!("Tait density ({})", tait(volume)),
        };
        let shear = match self.shear {
            ShearLaw::Newtonian => None,
            ShearLaw::Carreau { critical_stress, beta, n, npr } => {
                Some(format!("Carreau shear (G_c {critical_stress:e} Pa, beta {beta:e}, n {n:e}, NPR {npr:e})"))
            }
            ShearLaw::Ellis { critical_stress, n, npr } => {
                Some(format!("Ellis shear (G {critical_stress:e} Pa, n {n:e}, NPR {npr:e})"))
            }
            ShearLaw::Eyring { critical_stress, npr } => {
                Some(format!("Eyring shear (tau_E {critical_stress:e} Pa, NPR {npr:e})"))
            }
        };
        let limit = self.limiting_stress.map(|LimitingStress { ambient, slope, eyring }| {
            let bent = eyring.map_or_else(String::new, |eyring| format!(", Eyring traction (tau_E {eyring:e} Pa)"));
            format!("limiting stress {ambient:e} Pa + {slope:e} p{bent}")
        });
        let roughness = self.roughness.filter(|_| self.is_rough()).map(|roughness| roughness.describe());
        let laws = [Some(viscosity), Some(density), shear, limit, roughness].into_iter().flatten();
        laws.chain(self.conditions()).collect::<Vec<_>>().join("; ")
    }

    /// Returns cavitation model, oil supply and heat as texts, with constants in SI units; none for the penalty method,
    /// a flooded inlet and an isothermal contact.
    fn conditions(&self) -> impl Iterator<Item = String> {
        let cavitation =
            (self.cavitation != Cavitation::default()).then(|| format!("cavitation {}", self.cavitation.name()));
        let supply = self.cavitation.supply_film_m().map(|film| format!("inlet film thickness {film:e} m"));
        let heat = self.heat.map(|Heat { inlet_temperature, oil, bodies }| {
            let thermal =
                |c: f64, k: f64, density: f64| format!("c {c:e} J/(kg K), k {k:e} W/(m K), rho {density:e} kg/m3");
            let [first, second] = bodies.map(|body| thermal(body.heat_capacity, body.conductivity, body.density));
            format!(
                "heat from {inlet_temperature:e} K (oil {}, beta {:e} 1/K; body 1 {first}; body 2 {second})",
                thermal(oil.heat_capacity, oil.conductivity, oil.density),
                oil.viscosity_temperature
            )
        });
        [cavitation, supply, heat].into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_law_is_said_with_its_constants_and_none_as_code() {
        assert_eq!(Lubricant::default().describe(), "Roelands viscosity; Dowson-Higginson density");
        let volume = Tait { k_0: 1e9, k_0_prime: 11.0 };
        let lubricant = Lubricant {
            density: DensityLaw::Tait(volume),
            viscosity: ViscosityLaw::Doolittle(Doolittle { b: 4.0, r_0: 0.65, volume }),
            shear: ShearLaw::Carreau { critical_stress: 1e4, beta: 2.2, n: 0.8, npr: 0.25 },
            limiting_stress: Some(LimitingStress { ambient: 5e6, slope: 0.05, eyring: None }),
            ..Lubricant::default()
        };
        assert_eq!(
            lubricant.describe(),
            "Doolittle viscosity (B 4e0, R_0 6.5e-1, K_0 1e9 Pa, K_0' 1.1e1); Tait density (K_0 1e9 Pa, K_0' 1.1e1); \
             Carreau shear (G_c 1e4 Pa, beta 2.2e0, n 8e-1, NPR 2.5e-1); limiting stress 5e6 Pa + 5e-2 p"
        );
        let heat = Some(Heat::default());
        let supplied = Cavitation::MassConserving { supply_film_m: Some(2e-7) };
        let said = Lubricant { heat, cavitation: supplied, ..Lubricant::default() }.describe();
        let conditions = "; cavitation mass-conserving; inlet film thickness 2e-7 m; heat from 3.1315e2 K (oil c 2e3 ";
        assert!(said.contains(conditions) && said.contains("body 2 c 4.6e2 J/(kg K), k 4.7e1 W/(m K)"), "{said}");
        let eyring = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
        assert!(!Lubricant { shear: eyring, ..lubricant }.describe().contains('{'));
    }
}
