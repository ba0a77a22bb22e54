//! Density and viscosity laws with their exact derivatives, sources and ranges of validity.
//!
//! A [`Lubricant`] names the laws; [`Lubricant::scaled`] fixes their constants at one operating point and evaluates in
//! the solver's variable P = p/p_H. Slightly negative pressures (the penalty lets them reach about −1e-5 p_H) use the
//! analytic laws; below [`CAVITATION_FLOOR_PA`] the laws are held constant so that no Newton iterate can leave their
//! domain.

mod cavitation;
mod elementary;
mod free_volume;
mod heat;
mod heat_reduction;
mod pressure_coefficient;
mod shear_thinning;
mod warm;
mod words;

pub use super::contact::Sliding;
pub use cavitation::Cavitation;
pub use free_volume::{Doolittle, Tait};
pub use heat::{BodyHeat, FreeVolumeHeat, Heat, LARGEST_HEATED_SRR, OilHeat, ScaledHeat};
pub use heat_reduction::HeatReduction;
pub use pressure_coefficient::GAUSS_6;
pub use shear_thinning::{Fluidity, LimitingStress, ScaledShear, ShearLaw};
pub use warm::{Across, WarmFluid};

use super::contact::OperatingPoint;
use crate::solver::limits::Number;
use pulp::{Arch, Simd, WithSimd};
use serde::{Deserialize, Serialize};

/// Pressure \[Pa\] under which laws are frozen: no physical state, only passing Newton iterates, gets there.
pub const CAVITATION_FLOOR_PA: f64 = -1e7;

/// Roelands' reference pressure p_Roe \[Pa\], (2.12).
pub const ROELANDS_PRESSURE_PA: f64 = 1.96e8;

/// Largest ln(η/η₀) that is evaluated: beyond it the fluid is a solid for every purpose of the discretisation, and exp
/// would overflow.
const LOG_VISCOSITY_CEILING: f64 = 250.0;

/// How density depends on pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum DensityLaw {
    /// ρ = ρ₀.
    Incompressible,
    /// (2.10), Dowson & Higginson 1966; mineral oils to about 1 GPa, saturates at 1.34 ρ₀.
    #[default]
    DowsonHigginson,
    /// (3.37), (3.38).
    Tait(Tait),
}

/// How viscosity depends on pressure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub enum ViscosityLaw {
    /// (2.11), Barus 1893: η = η₀ exp(αp); overestimates above some 0.5 GPa.
    Barus,
    /// (2.12), Roelands 1966, with p_Roe = 0.196 GPa and ln η₀ + 9.67 > 0.
    #[default]
    Roelands,
    /// (3.39); its α is no free constant but follows from it.
    Doolittle(Doolittle),
}

/// The laws of a lubricant; its constants η₀ and α belong to the operating point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub struct Lubricant {
    /// Density law.
    #[serde(default)]
    pub density: DensityLaw,
    /// Viscosity law.
    #[serde(default)]
    pub viscosity: ViscosityLaw,
    /// How viscosity falls with shear stress.
    #[serde(default)]
    pub shear: ShearLaw,
    /// The stress that limits traction, where one is known.
    #[serde(default)]
    pub limiting_stress: Option<LimitingStress>,
    /// How its film ruptures. Scenes say it in a field of their own, and models answer for what they were trained with.
    #[serde(skip)]
    pub cavitation: Cavitation,
    /// How its film warms itself; none where everything has the inlet's temperature. Scenes say it in a field of their
    /// own.
    #[serde(skip)]
    pub heat: Option<Heat>,
}

/// A lubricant with all its fields, as models are stored: `#[serde(with = "WholeLubricant")]`.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Lubricant", deny_unknown_fields)]
pub(crate) struct WholeLubricant {
    density: DensityLaw,
    viscosity: ViscosityLaw,
    shear: ShearLaw,
    limiting_stress: Option<LimitingStress>,
    cavitation: Cavitation,
    heat: Option<Heat>,
}

/// Why a lubricant cannot be used at an operating point: a sentence.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct LubricantError(String);

/// Refuses a constant that is not finite or outside its range.
fn check_constant(constant: &str, value: f64, min: f64, max: f64) -> Result<(), LubricantError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    let value = Number(value);
    Err(LubricantError(format!("{constant} is {value}, but must be a finite number between {min:e} and {max:e}")))
}

/// Density and viscosity at one pressure with their derivatives with respect to P.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidState {
    /// ρ̄ = ρ/ρ₀.
    pub density: f64,
    /// dρ̄/dP.
    pub density_slope: f64,
    /// η̄ = η/η₀.
    pub viscosity: f64,
    /// d ln η̄/dP.
    pub log_viscosity_slope: f64,
}

/// A lubricant at one operating point, evaluated in P = p/p_H.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledFluid {
    laws: Lubricant,
    hertz_pressure_pa: f64,
    /// α p_H.
    alpha_hertz: f64,
    /// ln η₀ + 9.67.
    roelands_log: f64,
    roelands_exponent: f64,
}

/// ln η₀ + 9.67 of (2.12).
fn roelands_log(viscosity_pa_s: f64) -> f64 {
    viscosity_pa_s.ln() + 9.67
}

/// Roelands' exponent z of (2.12), which makes α the slope of ln η at ambient pressure; of mineral oils 0.4…0.8.
pub fn roelands_exponent(point: &OperatingPoint) -> f64 {
    point.alpha_per_pa * ROELANDS_PRESSURE_PA / roelands_log(point.viscosity_pa_s)
}

impl Lubricant {
    /// Fixes the laws' constants at an operating point.
    ///
    /// # Errors
    /// When a law is not defined for the point's constants.
    pub fn scaled(self, point: &OperatingPoint) -> Result<ScaledFluid, LubricantError> {
        let roelands_log = roelands_log(point.viscosity_pa_s);
        if self.viscosity == ViscosityLaw::Roelands && roelands_log <= 0.05 {
            let (viscosity, minimum) = (point.viscosity_pa_s, (0.05f64 - 9.67).exp());
            return Err(LubricantError(format!(
                "Roelands' law needs an ambient viscosity above {minimum:.3e} Pa·s, but it is {viscosity:.3e} Pa·s; use \
                 Barus' law or a larger viscosity"
            )));
        }
        self.check()?;
        let pressure = point.hertz().pressure_pa;
        self.check_pressure(pressure)?;
        Ok(ScaledFluid {
            laws: self,
            hertz_pressure_pa: pressure,
            alpha_hertz: point.alpha_hertz(),
            roelands_log,
            roelands_exponent: roelands_exponent(point),
        })
    }

    /// Refuses a Hertzian pressure \[Pa\] under which a law has ended.
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

    /// What heat adds at an operating point that the laws accept; none without heat.
    ///
    /// # Errors
    /// When its contact is no line contact, or a body stands still or runs backwards.
    pub fn scaled_heat(
        self,
        fluid: &ScaledFluid,
        point: &OperatingPoint,
    ) -> Result<Option<ScaledHeat>, LubricantError> {
        let Some(heat) = self.heat else { return Ok(None) };
        Heat::check_sliding(point.sliding.slide_to_roll_ratio)?;
        Ok(Some(ScaledHeat::new(heat, fluid, point)))
    }

    /// Refuses constants for which a law is not defined, naming them.
    ///
    /// # Errors
    /// With the first such constant.
    pub fn check(&self) -> Result<(), LubricantError> {
        if let DensityLaw::Tait(tait) = self.density {
            tait.check()?;
        }
        if let ViscosityLaw::Doolittle(doolittle) = self.viscosity {
            doolittle.check()?;
        }
        self.shear.check()?;
        self.cavitation.check()?;
        if let Some(heat) = self.heat {
            heat.check(self.viscosity, matches!(self.density, DensityLaw::Tait(_)))?;
        }
        if self.shear != ShearLaw::Newtonian && self.limiting_stress.is_some_and(|limit| limit.eyring.is_some()) {
            let twice = "the film thins under shear by its own law, so its traction takes no Eyring stress beside; leave one of \
                both out";
            return Err(LubricantError(twice.to_owned()));
        }
        self.limiting_stress.iter().try_for_each(LimitingStress::check)
    }

    /// The laws that pressure and film answer to: all but the limiting stress, which cuts traction only.
    pub fn of_the_film(self) -> Self {
        Self { limiting_stress: None, ..self }
    }

    /// The laws of the liquid that make its film: all but the limiting stress and the way it ruptures, which moves H_c by
    /// a few parts in ten million.
    pub fn of_the_liquid(self) -> Self {
        Self { limiting_stress: None, cavitation: Cavitation::Penalty, ..self }
    }

    /// The pressure–viscosity coefficient that follows from the viscosity law itself, α* \[1/Pa\]; `None` where it is a
    /// free constant.
    pub fn own_coefficient(&self) -> Option<f64> {
        match self.viscosity {
            ViscosityLaw::Doolittle(doolittle) => Some(doolittle.reciprocal_asymptotic_coefficient()),
            ViscosityLaw::Barus | ViscosityLaw::Roelands => None,
        }
    }
}

impl ScaledFluid {
    /// p_H \[Pa\].
    pub fn hertz_pressure_pa(&self) -> f64 {
        self.hertz_pressure_pa
    }

    /// The pressure P at which a law ends; infinite where none does.
    pub fn largest_pressure(&self) -> f64 {
        match self.laws.viscosity {
            ViscosityLaw::Doolittle(doolittle) => doolittle.largest_pressure() / self.hertz_pressure_pa,
            ViscosityLaw::Barus | ViscosityLaw::Roelands => f64::INFINITY,
        }
    }

    /// α* p_H \[-\] with the reciprocal asymptotic isoviscous pressure coefficient of the law in use.
    pub fn reciprocal_asymptotic_exponent(&self) -> f64 {
        pressure_coefficient::reciprocal_asymptotic(self.at(0.0).log_viscosity_slope, |p| self.at(p).viscosity.ln())
    }

    /// Density and viscosity at P.
    #[inline]
    pub fn at(&self, pressure: f64) -> FluidState {
        let (ph, p) = (self.hertz_pressure_pa, self.counted(pressure));
        let (log_viscosity, slope) = match self.laws.viscosity {
            ViscosityLaw::Barus => (self.alpha_hertz * p / ph, self.alpha_hertz),
            ViscosityLaw::Roelands => self.roelands(p, roelands_base(p).powf(self.roelands_exponent)),
            ViscosityLaw::Doolittle(doolittle) => {
                let (log_viscosity, slope) = doolittle.log_viscosity(p);
                (log_viscosity, slope * ph)
            }
        };
        self.state(pressure, (log_viscosity, slope), log_viscosity.min(LOG_VISCOSITY_CEILING).exp())
    }

    /// The same at several P at once: Roelands' law runs in vector registers.
    pub fn at_all<const N: usize>(&self, pressures: &[f64; N]) -> [FluidState; N] {
        match self.laws.viscosity {
            ViscosityLaw::Roelands => Arch::new().dispatch(RoelandsStates { fluid: self, pressures }),
            ViscosityLaw::Barus | ViscosityLaw::Doolittle(_) => pressures.map(|pressure| self.at(pressure)),
        }
    }

    /// The pressure \[Pa\] that counts: below a floor nothing follows it.
    #[inline(always)]
    fn counted(&self, pressure: f64) -> f64 {
        (pressure * self.hertz_pressure_pa).max(CAVITATION_FLOOR_PA)
    }

    /// ln η̄ and its slope by P of Roelands' law at a pressure \[Pa\], by the power z of 1 + p/p_Roe.
    #[inline(always)]
    fn roelands(&self, p: f64, power: f64) -> (f64, f64) {
        let per_pressure = self.hertz_pressure_pa / ROELANDS_PRESSURE_PA;
        let slope = self.roelands_log * self.roelands_exponent * power / roelands_base(p) * per_pressure;
        (self.roelands_log * (power - 1.0), slope)
    }

    /// The state at P, with ln η̄ and its slope, and η̄.
    #[inline(always)]
    fn state(&self, pressure: f64, (log_viscosity, slope): (f64, f64), viscosity: f64) -> FluidState {
        let (ph, p) = (self.hertz_pressure_pa, self.counted(pressure));
        let frozen = pressure * ph < CAVITATION_FLOOR_PA;
        let (density, density_slope) = match self.laws.density {
            DensityLaw::Incompressible => (1.0, 0.0),
            DensityLaw::DowsonHigginson => {
                let denominator = 5.9e8 + p;
                ((5.9e8 + 1.34 * p) / denominator, 0.34 * 5.9e8 * ph / (denominator * denominator))
            }
            DensityLaw::Tait(tait) => {
                let (density, slope) = tait.density(p);
                (density, slope * ph)
            }
        };
        let capped = log_viscosity > LOG_VISCOSITY_CEILING;
        FluidState {
            density,
            density_slope: if frozen { 0.0 } else { density_slope },
            viscosity,
            log_viscosity_slope: if frozen || capped { 0.0 } else { slope },
        }
    }
}

/// States by Roelands' law at several P.
struct RoelandsStates<'a, const N: usize> {
    fluid: &'a ScaledFluid,
    pressures: &'a [f64; N],
}

#[allow(clippy::needless_range_loop, reason = "a closure would not run in the wide registers")]
impl<const N: usize> WithSimd for RoelandsStates<'_, N> {
    type Output = [FluidState; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> [FluidState; N] {
        let Self { fluid, pressures } = self;
        let (mut logs, mut viscosities) = ([(0.0, 0.0); N], [0.0; N]);
        for k in 0..N {
            let p = fluid.counted(pressures[k]);
            let power = elementary::exp(fluid.roelands_exponent * elementary::ln(roelands_base(p)));
            logs[k] = fluid.roelands(p, power);
        }
        for k in 0..N {
            viscosities[k] = elementary::exp(logs[k].0.min(LOG_VISCOSITY_CEILING));
        }
        let mut states = [FluidState::default(); N];
        for k in 0..N {
            states[k] = fluid.state(pressures[k], logs[k], viscosities[k]);
        }
        states
    }
}

/// 1 + p/p_Roe.
#[inline(always)]
fn roelands_base(p: f64) -> f64 {
    1.0 + p / ROELANDS_PRESSURE_PA
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
