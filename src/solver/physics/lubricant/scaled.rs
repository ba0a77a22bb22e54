//! Laws of a lubricant at one operating point, evaluated in P = p/p_H, where p_H is the Hertzian pressure.

use super::elementary;
use super::laws::{CAVITATION_FLOOR_PA, DensityLaw, LOG_VISCOSITY_CEILING, ROELANDS_PRESSURE_PA, ViscosityLaw};
use super::pressure_coefficient;
use crate::solver::physics::contact::OperatingPoint;
use pulp::{Arch, Simd, WithSimd};

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
    pub(super) density: DensityLaw,
    pub(super) viscosity: ViscosityLaw,
    pub(super) hertz_pressure_pa: f64,
    /// α p_H.
    pub(super) alpha_hertz: f64,
    /// ln η₀ + 9.67.
    pub(super) roelands_log: f64,
    pub(super) roelands_exponent: f64,
}

/// ln η₀ + 9.67 of (2.12).
pub(super) fn roelands_log(viscosity_pa_s: f64) -> f64 {
    viscosity_pa_s.ln() + 9.67
}

/// Returns Roelands' exponent z of (2.12), for which α is the slope of ln η at ambient pressure; 0.4…0.8 for mineral
/// oils.
pub fn roelands_exponent(point: &OperatingPoint) -> f64 {
    point.alpha_per_pa * ROELANDS_PRESSURE_PA / roelands_log(point.viscosity_pa_s)
}

impl ScaledFluid {
    /// Returns p_H \[Pa\].
    pub fn hertz_pressure_pa(&self) -> f64 {
        self.hertz_pressure_pa
    }

    /// Returns the pressure P at which the range of a law ends; infinite if it does not end.
    pub fn largest_pressure(&self) -> f64 {
        match self.viscosity {
            ViscosityLaw::Doolittle(doolittle) => doolittle.largest_pressure() / self.hertz_pressure_pa,
            ViscosityLaw::Barus | ViscosityLaw::Roelands => f64::INFINITY,
        }
    }

    /// Returns α* p_H \[-\], where α* is the reciprocal asymptotic isoviscous pressure coefficient of the viscosity
    /// law.
    pub fn reciprocal_asymptotic_exponent(&self) -> f64 {
        pressure_coefficient::reciprocal_asymptotic(self.at(0.0).log_viscosity_slope, |p| self.at(p).viscosity.ln())
    }

    /// Returns density and viscosity at P.
    #[inline]
    pub fn at(&self, pressure: f64) -> FluidState {
        let (ph, p) = (self.hertz_pressure_pa, self.counted(pressure));
        let (log_viscosity, slope) = match self.viscosity {
            ViscosityLaw::Barus => (self.alpha_hertz * p / ph, self.alpha_hertz),
            ViscosityLaw::Roelands => self.roelands(p, roelands_base(p).powf(self.roelands_exponent)),
            ViscosityLaw::Doolittle(doolittle) => {
                let (log_viscosity, slope) = doolittle.log_viscosity(p);
                (log_viscosity, slope * ph)
            }
        };
        self.state(pressure, (log_viscosity, slope), log_viscosity.min(LOG_VISCOSITY_CEILING).exp())
    }

    /// Returns the states at several P at once. Roelands' law runs in vector registers.
    pub fn at_all<const N: usize>(&self, pressures: &[f64; N]) -> [FluidState; N] {
        match self.viscosity {
            ViscosityLaw::Roelands => Arch::new().dispatch(RoelandsStates { fluid: self, pressures }),
            ViscosityLaw::Barus | ViscosityLaw::Doolittle(_) => pressures.map(|pressure| self.at(pressure)),
        }
    }

    /// Returns the pressure \[Pa\] at which the laws are evaluated. Below a floor they are constant.
    #[inline(always)]
    fn counted(&self, pressure: f64) -> f64 {
        (pressure * self.hertz_pressure_pa).max(CAVITATION_FLOOR_PA)
    }

    /// Returns ln η̄ and its slope with respect to P by Roelands' law at a pressure \[Pa\]. `power` is (1 +
    /// p/p_Roe)^z.
    #[inline(always)]
    fn roelands(&self, p: f64, power: f64) -> (f64, f64) {
        let per_pressure = self.hertz_pressure_pa / ROELANDS_PRESSURE_PA;
        let slope = self.roelands_log * self.roelands_exponent * power / roelands_base(p) * per_pressure;
        (self.roelands_log * (power - 1.0), slope)
    }

    /// Returns the state at P from ln η̄ and its slope, and η̄.
    #[inline(always)]
    fn state(&self, pressure: f64, (log_viscosity, slope): (f64, f64), viscosity: f64) -> FluidState {
        let (ph, p) = (self.hertz_pressure_pa, self.counted(pressure));
        let frozen = pressure * ph < CAVITATION_FLOOR_PA;
        let (density, density_slope) = match self.density {
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

/// Returns 1 + p/p_Roe.
#[inline(always)]
fn roelands_base(p: f64) -> f64 {
    1.0 + p / ROELANDS_PRESSURE_PA
}
