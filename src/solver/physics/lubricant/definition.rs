//! Definition of a lubricant by its laws of density, viscosity, shear and cavitation, with heat and roughness. Checks
//! the constants and scales the laws to an operating point.

use super::cavitation::Cavitation;
use super::error::LubricantError;
use super::heat::{Heat, ScaledHeat};
use super::laws::{DensityLaw, ViscosityLaw};
use super::scaled::{ScaledFluid, roelands_exponent, roelands_log};
use super::shear_thinning::{LimitingStress, ShearLaw};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::surfaces::Roughness;
use serde::{Deserialize, Serialize};

/// Laws of a lubricant. The constants η₀ and α belong to the operating point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct Lubricant {
    /// Density law.
    #[serde(default)]
    pub density: DensityLaw,
    /// Viscosity law.
    #[serde(default)]
    pub viscosity: ViscosityLaw,
    /// Shear law: dependence of the viscosity on the shear stress.
    #[serde(default)]
    pub shear: ShearLaw,
    /// Limiting shear stress of the traction, or `None`.
    #[serde(default)]
    pub limiting_stress: Option<LimitingStress>,
    /// Cavitation model. Scenes give it in a separate field. A reduced model has that of its training.
    #[serde(skip)]
    pub cavitation: Cavitation,
    /// Thermal properties; `None` for an isothermal film at the inlet temperature. Scenes give them in a separate
    /// field.
    #[serde(skip)]
    pub heat: Option<Heat>,
    /// Roughness of both surfaces; `None` for smooth surfaces. Scenes give it in a separate field.
    #[serde(skip)]
    pub roughness: Option<Roughness>,
}

/// Serialised form of a lubricant that includes cavitation, heat and roughness, which scenes give in separate fields:
/// `#[serde(with = "WholeLubricant")]`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Lubricant", deny_unknown_fields)]
pub(crate) struct WholeLubricant {
    density: DensityLaw,
    viscosity: ViscosityLaw,
    shear: ShearLaw,
    limiting_stress: Option<LimitingStress>,
    cavitation: Cavitation,
    heat: Option<Heat>,
    roughness: Option<Roughness>,
}

/// Serialised form of the lubricant of a reduced model: `#[serde(with = "LubricantOfModel")]`. It has the field
/// `roughness` only if there is one, and therefore needs a self-describing format such as JSON.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Lubricant", deny_unknown_fields)]
pub(crate) struct LubricantOfModel {
    density: DensityLaw,
    viscosity: ViscosityLaw,
    shear: ShearLaw,
    limiting_stress: Option<LimitingStress>,
    cavitation: Cavitation,
    heat: Option<Heat>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    roughness: Option<Roughness>,
}

impl Lubricant {
    /// Computes the constants of the laws at an operating point.
    ///
    /// # Errors
    /// If a law is not defined for the constants of the point.
    pub fn scaled(self, point: &OperatingPoint) -> Result<ScaledFluid, LubricantError> {
        let roelands_log = roelands_log(point.viscosity_pa_s);
        let minimum = ViscosityLaw::thinnest_of_roelands();
        if self.viscosity == ViscosityLaw::Roelands && point.viscosity_pa_s <= minimum {
            let viscosity = point.viscosity_pa_s;
            return Err(LubricantError(format!(
                "Roelands' law needs an ambient viscosity above {minimum:.3e} Pa·s, but it is {viscosity:.3e} Pa·s; use \
                 Barus' law or a larger viscosity"
            )));
        }
        self.check()?;
        let pressure = point.hertz().pressure_pa;
        self.check_pressure(pressure)?;
        Ok(ScaledFluid {
            density: self.density,
            viscosity: self.viscosity,
            hertz_pressure_pa: pressure,
            alpha_hertz: point.alpha_hertz(),
            roelands_log,
            roelands_exponent: roelands_exponent(point),
        })
    }

    /// Refuses a Hertzian pressure \[Pa\] beyond the range of a law.
    pub(crate) fn check_pressure(&self, pressure: f64) -> Result<(), LubricantError> {
        match self.viscosity {
            ViscosityLaw::Doolittle(law) if pressure >= law.largest_pressure() => {
                let (pressure, largest) = (pressure / 1e9, law.largest_pressure() / 1e9);
                Err(LubricantError(format!(
                    "at the Hertzian pressure of {pressure:.3} GPa the lubricant's relative volume falls under its \
                     occupied volume, where Doolittle's law ends ({largest:.3} GPa); use a smaller load or another \
                     lubricant"
                )))
            }
            _ => Ok(()),
        }
    }

    /// Returns the scaled thermal properties at an operating point that the laws accept, or `None` for an isothermal
    /// film.
    ///
    /// # Errors
    /// If a body is stationary or runs backwards.
    pub fn scaled_heat(
        self,
        fluid: &ScaledFluid,
        point: &OperatingPoint,
    ) -> Result<Option<ScaledHeat>, LubricantError> {
        let Some(heat) = self.heat else { return Ok(None) };
        Heat::check_sliding(point.sliding.slide_to_roll_ratio)?;
        Ok(Some(ScaledHeat::new(heat, fluid, point)))
    }

    /// Refuses constants for which a law is not defined.
    ///
    /// # Errors
    /// If there is such a constant; the error names the first one.
    pub fn check(&self) -> Result<(), LubricantError> {
        if let DensityLaw::Tait(tait) = self.density {
            tait.check()?;
        }
        if let ViscosityLaw::Doolittle(doolittle) = self.viscosity {
            doolittle.check()?;
        }
        self.shear.check()?;
        self.cavitation.check()?;
        if let Some(roughness) = self.roughness {
            roughness.check()?;
            self.check_with_roughness()?;
        }
        if let Some(heat) = self.heat {
            heat.check(self.viscosity, matches!(self.density, DensityLaw::Tait(_)))?;
        }
        if self.shear != ShearLaw::Newtonian && self.limiting_stress.is_some_and(|limit| limit.eyring.is_some()) {
            let refusal = "the shear-thinning law of the film determines the traction too, so an Eyring stress in \
                         addition is refused; leave one of the two out";
            return Err(LubricantError(refusal.to_owned()));
        }
        self.limiting_stress.iter().try_for_each(LimitingStress::check)
    }

    /// Refuses cavitation models that are not supported together with rough surfaces.
    fn check_with_roughness(&self) -> Result<(), LubricantError> {
        let refused = match self.cavitation {
            _ if !self.lacks_complementarity() => return Ok(()),
            Cavitation::Penalty => "rough surfaces need the cavitation model complementarity, not penalty",
            _ => {
                "rough surfaces need a flooded inlet and cavitation by complementarity; mass-conserving cavitation \
                 supports smooth surfaces only"
            }
        };
        Err(LubricantError(refused.to_owned()))
    }

    /// Returns true for rough surfaces with another cavitation model than complementarity.
    pub(crate) fn lacks_complementarity(&self) -> bool {
        self.is_rough() && self.cavitation != Cavitation::Complementarity
    }

    /// Returns true if the surfaces are rough.
    pub fn is_rough(&self) -> bool {
        self.roughness.is_some_and(|roughness| roughness.sigma > 0.0)
    }

    /// Returns the same laws for rough surfaces, for which the penalty is replaced by complementarity.
    pub fn on_rough_surfaces(self, roughness: Option<Roughness>) -> Self {
        let rough = Self { roughness, ..self };
        match self.cavitation {
            Cavitation::Penalty if rough.is_rough() => Self { cavitation: Cavitation::Complementarity, ..rough },
            _ => rough,
        }
    }

    /// Returns the contact that a grid for `point` must resolve. For rough surfaces it has at least the film thickness
    /// σ/2, half the composite roughness, because a thinner film does not make the pressure steeper.
    pub fn grid_contact(&self, point: &OperatingPoint) -> OperatingPoint {
        let least_film_m = self.roughness.filter(|_| self.is_rough()).map(|roughness| 0.5 * roughness.sigma);
        match least_film_m {
            Some(least) if point.formula_film_m() < least => point.at_film_m(least),
            _ => *point,
        }
    }

    /// Returns the laws that affect pressure and film thickness: all but the limiting stress, which limits traction
    /// only.
    pub fn of_the_film(self) -> Self {
        Self { limiting_stress: None, ..self }
    }

    /// Returns the laws without the limiting stress and with the penalty as cavitation model, for comparisons.
    /// The cavitation model hardly affects the central film thickness H_c.
    pub fn of_the_liquid(self) -> Self {
        Self { limiting_stress: None, cavitation: Cavitation::Penalty, ..self }
    }

    /// Returns the pressure–viscosity coefficient α* \[1/Pa\] that follows from the viscosity law, or `None` if it is
    /// a free constant.
    pub fn own_coefficient(&self) -> Option<f64> {
        match self.viscosity {
            ViscosityLaw::Doolittle(doolittle) => Some(doolittle.reciprocal_asymptotic_coefficient()),
            ViscosityLaw::Barus | ViscosityLaw::Roelands => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_laws() -> impl Iterator<Item = Lubricant> {
        [DensityLaw::Incompressible, DensityLaw::DowsonHigginson].into_iter().flat_map(|density| {
            [ViscosityLaw::Barus, ViscosityLaw::Roelands].into_iter().map(move |viscosity| Lubricant {
                density,
                viscosity,
                ..Lubricant::default()
            })
        })
    }

    #[test]
    fn several_states_at_once_are_those_of_one_after_the_other() {
        let pressures: [f64; 9] = [-1.0, -1e-4, 0.0, 1e-3, 0.1, 0.7, 1.0, 3.0, 40.0];
        for laws in all_laws() {
            let fluid = laws.scaled(&OperatingPoint::TABLE_2_1).unwrap();
            for (state, pressure) in fluid.at_all(&pressures).into_iter().zip(pressures) {
                let alone = fluid.at(pressure);
                assert!((state.viscosity / alone.viscosity - 1.0).abs() < 1e-12, "{laws:?} at {pressure}");
                let slope = alone.log_viscosity_slope;
                assert!((state.log_viscosity_slope - slope).abs() <= 1e-14 * slope, "{laws:?} at {pressure}");
                assert_eq!((state.density, state.density_slope), (alone.density, alone.density_slope));
            }
        }
    }

    #[test]
    fn slopes_agree_with_finite_differences() {
        for laws in all_laws() {
            let fluid = laws.scaled(&OperatingPoint::TABLE_2_1).unwrap();
            for p in [-1e-4, 0.0, 0.01, 0.2, 0.7, 1.0, 1.3] {
                let step = 1e-5;
                let (a, b, mid) = (fluid.at(p - step), fluid.at(p + step), fluid.at(p));
                let density = (b.density - a.density) / (2.0 * step);
                let log_viscosity = (b.viscosity.ln() - a.viscosity.ln()) / (2.0 * step);
                assert!((density - mid.density_slope).abs() <= 1e-6 * density.abs().max(1e-3), "{laws:?} at {p}");
                assert!((log_viscosity / mid.log_viscosity_slope - 1.0).abs() < 1e-6, "{laws:?} at {p}");
            }
        }
    }

    #[test]
    fn laws_start_at_ambient_values_and_share_the_slope_alpha() {
        for laws in all_laws() {
            let fluid = laws.scaled(&OperatingPoint::TABLE_2_1).unwrap();
            let ambient = fluid.at(0.0);
            assert!((ambient.density - 1.0).abs() < 1e-15 && (ambient.viscosity - 1.0).abs() < 1e-15);
            // By definition α is the slope of ln η at ambient pressure, for every law.
            assert!((ambient.log_viscosity_slope / OperatingPoint::TABLE_2_1.alpha_hertz() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn printed_values_of_the_laws() {
        // (2.10) at p = 0.59 GPa is 2.34/2; (2.12) at p = p_Roe is exp((ln η₀ + 9.67)(2^z − 1)).
        let point = OperatingPoint::TABLE_2_1;
        let fluid = Lubricant::default().scaled(&point).unwrap();
        let ph = point.hertz().pressure_pa;
        assert!((fluid.at(5.9e8 / ph).density - 1.17).abs() < 1e-12);
        let log = point.viscosity_pa_s.ln() + 9.67;
        let z = point.alpha_per_pa * 1.96e8 / log;
        assert!((fluid.at(1.96e8 / ph).viscosity.ln() - log * (2f64.powf(z) - 1.0)).abs() < 1e-11);
    }

    #[test]
    fn no_pressure_makes_a_law_overflow() {
        for laws in all_laws() {
            let fluid = laws.scaled(&OperatingPoint::TABLE_2_1).unwrap();
            for p in [-1e6, -1.0, 10.0, 1e6] {
                let s = fluid.at(p);
                assert!(s.density > 0.0 && s.viscosity.is_finite() && s.viscosity > 0.0, "{laws:?} at {p}");
            }
        }
    }

    #[test]
    fn roelands_refuses_a_viscosity_it_is_not_defined_for() {
        let thin = OperatingPoint { viscosity_pa_s: 5e-5, ..OperatingPoint::TABLE_2_1 };
        assert!(Lubricant::default().scaled(&thin).is_err());
        assert!(Lubricant { viscosity: ViscosityLaw::Barus, ..Lubricant::default() }.scaled(&thin).is_ok());
    }
}
