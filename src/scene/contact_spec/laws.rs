//! Lubricant laws of a contact specification: density, viscosity, shear thinning, cavitation, heat, roughness.

use super::fields::{ContactSpec, Field};
use super::given::ShearName;
use super::refusal::{Refusal, refuse};
use crate::solver::limits::Number;
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant, OilHeat, ShearLaw, ViscosityLaw};

/// Fields that have no effect without heat.
const THERMAL: [Field; 6] = [
    Field::InletTemperature,
    Field::OilThermal,
    Field::ViscosityTemperature,
    Field::DensityTemperature,
    Field::Body1,
    Field::Body2,
];

impl ContactSpec {
    /// Returns the laws of the named lubricant or of the scene, to which stated fields are applied.
    pub(super) fn named_laws(&self) -> Lubricant {
        self.lubricant.map(|named| named.laws).or(self.laws).unwrap_or_default()
    }

    /// Returns all laws with the stated fields applied.
    pub(super) fn lubricant(&self) -> Result<Lubricant, Refusal> {
        let mut lubricant = self.sheared(self.named_laws())?;
        lubricant.heat = self.heated()?;
        if let Some(npr) = self.npr.filter(|npr| *npr < 1.0 && lubricant.shear == ShearLaw::Newtonian) {
            let constants = "the lubricant has no shear constants; only 1 (Newtonian) is accepted";
            return refuse(Field::Npr, format!("<npr> is {}, but {constants}", Number(npr)));
        }
        lubricant.density = self.density.unwrap_or(lubricant.density);
        lubricant.viscosity = self.pressure_viscosity.unwrap_or_else(|| self.usual_viscosity_law(lubricant.viscosity));
        lubricant.roughness = self.stated_roughness()?;
        let usual = if lubricant.is_rough() { Cavitation::Complementarity } else { Cavitation::default() };
        lubricant.cavitation = match (self.cavitation.unwrap_or(usual), self.supply_film) {
            (Cavitation::MassConserving { .. }, Some(film)) => Cavitation::MassConserving { supply_film_m: Some(film) },
            (cavitation, None) => cavitation,
            (_, Some(_)) => {
                return refuse(
                    Field::SupplyFilm,
                    "<supply-film> needs <cavitation=mass-conserving>: only this cavitation model allows a partially filled \
                     gap",
                );
            }
        };
        self.check_with_roughness(&lubricant)?;
        Ok(lubricant)
    }

    /// The law of a viscosity whose law is not stated: Barus' where Roelands' is not defined.
    fn usual_viscosity_law(&self, own: ViscosityLaw) -> ViscosityLaw {
        let free = self.lubricant.is_none() && self.laws.is_none();
        let thin = self.viscosity.is_some_and(|viscosity| viscosity <= ViscosityLaw::thinnest_of_roelands());
        if free && thin { ViscosityLaw::Barus } else { own }
    }

    /// Applies the stated shear thinning and limiting stress.
    fn sheared(&self, lubricant: Lubricant) -> Result<Lubricant, Refusal> {
        let stress = |law: &str| {
            let needed = "needs <shear-stress> in Pa; 5e6 is customary for mineral oils";
            self.shear_stress.ok_or_else(|| Refusal::new(Field::ShearStress, format!("<shear={law}> {needed}")))
        };
        let carreau = self.shear == Some(ShearName::Carreau);
        if let Some(field) = [Field::ShearBeta, Field::ShearN].into_iter().find(|field| self.states(*field) && !carreau)
        {
            return refuse(field, "<shear-beta> and <shear-n> belong to <shear=carreau>; leave them out or add it");
        }
        let npr = 0.0;
        let shear = match self.shear {
            None | Some(ShearName::Newtonian) if self.shear_stress.is_some() => {
                let sentence = "<shear-stress> belongs to <shear=eyring> or carreau; leave it out or add one";
                return refuse(Field::ShearStress, sentence);
            }
            None => lubricant.shear,
            Some(ShearName::Newtonian) => ShearLaw::Newtonian,
            Some(ShearName::Eyring) => ShearLaw::Eyring { critical_stress: stress("eyring")?, npr },
            Some(ShearName::Carreau) => {
                let critical_stress = stress("carreau")?;
                let Some(n) = self.shear_n else {
                    let sentence = "<shear=carreau> needs <shear-n>, its power-law exponent between 0.05 and 1";
                    return refuse(Field::ShearN, sentence);
                };
                ShearLaw::Carreau { critical_stress, beta: self.shear_beta.unwrap_or(2.0), n, npr }
            }
        };
        // If a shear-thinning law is stated, it replaces a limiting stress of the lubricant, which affected only the
        // traction.
        let own_limit = lubricant.limiting_stress.filter(|_| self.shear.is_none() || shear == ShearLaw::Newtonian);
        Ok(Lubricant { shear, limiting_stress: self.limiting_stress.or(own_limit), ..lubricant })
    }

    /// Returns the thermal constants; `None` for an isothermal contact.
    fn heated(&self) -> Result<Option<Heat>, Refusal> {
        if self.heat != Some(true) {
            let without = |field: Field| format!("<{}> has no effect without <heat>; add it", field.facts().name);
            let useless = THERMAL.into_iter().find(|field| self.states(*field));
            return useless.map_or(Ok(None), |field| refuse(field, without(field)));
        }
        let constants = self.thermal.unwrap_or_default();
        // An oil of a grade brings its thermal constants, and its temperature is that of the inlet.
        let graded = self.oil_state()?.map(|state| state.heat);
        let mut oil = graded.or(self.lubricant.map(|named| named.heat)).unwrap_or(constants.oil);
        let inlet_temperature = graded.and(self.temperature).unwrap_or(constants.inlet_temperature);
        if graded.is_some() && self.inlet_temperature.is_some_and(|stated| stated != inlet_temperature) {
            let sentence = "<temperature> of the oil is that of the inlet; leave out <inlet-temperature>";
            return refuse(Field::InletTemperature, sentence);
        }
        if let Some([heat_capacity, conductivity, density]) = self.oil_thermal {
            oil = OilHeat { heat_capacity, conductivity, density, ..oil };
        }
        oil.viscosity_temperature = self.viscosity_temperature.unwrap_or(oil.viscosity_temperature);
        oil.density_temperature = self.density_temperature.unwrap_or(oil.density_temperature);
        let [first, second] = constants.bodies;
        Ok(Some(Heat {
            inlet_temperature: self.inlet_temperature.unwrap_or(inlet_temperature),
            oil,
            bodies: [self.body1.unwrap_or(first), self.body2.unwrap_or(second)],
        }))
    }
}
