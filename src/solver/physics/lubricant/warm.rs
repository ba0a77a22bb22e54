//! Density and viscosity of a lubricant, with derivatives, at one pressure and several temperatures across the film.
//!
//! Sources: Roelands 1966 for the viscosity, with S₀ = β (T₀ − 138)/(ln η₀ + 9.67); Dowson & Higginson's density
//! times 1 − β_ρ ΔT; Tait's and Doolittle's laws with temperature-dependent volumes as in Bair 2007.

use super::elementary;
use super::free_volume::{Doolittle, Tait};
use super::heat::Heat;
use super::laws::{CAVITATION_FLOOR_PA, DensityLaw, LOG_VISCOSITY_CEILING, ROELANDS_PRESSURE_PA, ViscosityLaw};
use super::scaled::ScaledFluid;

/// Temperature \[K\] at which Roelands' viscosity is infinite.
const ROELANDS_TEMPERATURE_K: f64 = 138.0;

/// Range of temperatures over T₀ in which the laws are evaluated. Only intermediate iterates leave it.
const EVALUATED: (f64, f64) = (0.75, 6.0);

/// Lower limits of the density over ρ₀, and of the free volume over the volume.
const LEAST: f64 = 1e-3;

/// Laws at given pressures and temperatures in one contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WarmFluid {
    fluid: ScaledFluid,
    heat: Heat,
    /// S₀ of Roelands' law.
    slope: f64,
}

/// Density and viscosity at N temperatures with their derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across<const N: usize> {
    /// ρ̄ = ρ/ρ₀.
    pub density: [f64; N],
    /// ∂ρ̄/∂P.
    pub density_p: [f64; N],
    /// ∂ρ̄/∂θ.
    pub density_t: [f64; N],
    /// Fluidity η₀/η at zero shear stress.
    pub fluidity: [f64; N],
    /// ∂ ln η/∂P.
    pub log_viscosity_p: [f64; N],
    /// ∂ ln η/∂θ.
    pub log_viscosity_t: [f64; N],
}

impl<const N: usize> Default for Across<N> {
    fn default() -> Self {
        let zero = [0.0; N];
        Self {
            density: zero,
            density_p: zero,
            density_t: zero,
            fluidity: zero,
            log_viscosity_p: zero,
            log_viscosity_t: zero,
        }
    }
}

impl WarmFluid {
    /// Creates the laws with their thermal constants.
    pub(super) fn new(fluid: &ScaledFluid, heat: Heat) -> Self {
        let slope =
            heat.oil.viscosity_temperature * (heat.inlet_temperature - ROELANDS_TEMPERATURE_K) / fluid.roelands_log;
        Self { fluid: *fluid, heat, slope }
    }

    /// Returns density and viscosity at P and θ = (T − T₀)/T₀. For θ = 0 they equal those of [`ScaledFluid::at`].
    pub fn at<const N: usize>(&self, pressure: f64, theta: &[f64; N]) -> Across<N> {
        let fluid = &self.fluid;
        let ph = fluid.hertz_pressure_pa;
        let frozen = pressure * ph < CAVITATION_FLOOR_PA;
        let p = (pressure * ph).max(CAVITATION_FLOOR_PA);
        let t0 = self.heat.inlet_temperature;
        // 1 + θ, and ΔT.
        let warm = theta.map(|theta| (1.0 + theta).clamp(EVALUATED.0, EVALUATED.1));
        let rise = warm.map(|warm| t0 * (warm - 1.0));
        let zero = [0.0; N];
        let mut out = Across::default();
        match fluid.density {
            DensityLaw::Tait(tait) => {
                for (i, &rise) in rise.iter().enumerate() {
                    let [volume, volume_p, volume_t] = self.volume(tait, p, rise);
                    let density = 1.0 / volume;
                    let square = density * density;
                    out.density[i] = density;
                    out.density_p[i] = -volume_p * square * ph;
                    out.density_t[i] = -volume_t * square * t0;
                }
            }
            law => {
                let (density, slope) = match law {
                    DensityLaw::DowsonHigginson => {
                        let denominator = 5.9e8 + p;
                        ((5.9e8 + 1.34 * p) / denominator, 0.34 * 5.9e8 * ph / (denominator * denominator))
                    }
                    _ => (1.0, 0.0),
                };
                let expansion = self.heat.oil.density_temperature;
                for (i, rise) in rise.iter().enumerate() {
                    let factor = (1.0 - expansion * rise).max(LEAST);
                    out.density[i] = density * factor;
                    out.density_p[i] = slope * factor;
                    out.density_t[i] = -density * expansion * t0;
                }
            }
        }
        // ln(η/η₀), from which the fluidity is computed at the end.
        let mut log_viscosity = zero;
        match fluid.viscosity {
            ViscosityLaw::Barus => {
                for i in 0..N {
                    log_viscosity[i] = fluid.alpha_hertz * p / ph - self.heat.oil.viscosity_temperature * rise[i];
                    out.log_viscosity_p[i] = fluid.alpha_hertz;
                    out.log_viscosity_t[i] = -self.heat.oil.viscosity_temperature * t0;
                }
            }
            ViscosityLaw::Roelands => {
                let base = 1.0 + p / ROELANDS_PRESSURE_PA;
                let power = base.powf(fluid.roelands_exponent);
                let power_p = fluid.roelands_exponent * power / base * (ph / ROELANDS_PRESSURE_PA);
                let above = 1.0 / (t0 - ROELANDS_TEMPERATURE_K);
                let mut factor = warm.map(|warm| (warm * t0 - ROELANDS_TEMPERATURE_K) * above);
                let per = factor.map(|ratio| -self.slope * t0 * above / ratio);
                elementary::raise(&mut factor, -self.slope);
                for i in 0..N {
                    let own = fluid.roelands_log * power * factor[i];
                    log_viscosity[i] = own - fluid.roelands_log;
                    out.log_viscosity_p[i] = fluid.roelands_log * power_p * factor[i];
                    out.log_viscosity_t[i] = own * per[i];
                }
            }
            ViscosityLaw::Doolittle(law) => {
                for i in 0..N {
                    let [log, by_p, by_t] = self.doolittle(law, p, rise[i]);
                    log_viscosity[i] = log;
                    out.log_viscosity_p[i] = by_p * ph;
                    out.log_viscosity_t[i] = by_t * t0;
                }
            }
        }
        for (i, log_viscosity) in log_viscosity.into_iter().enumerate() {
            if log_viscosity > LOG_VISCOSITY_CEILING {
                (out.log_viscosity_p[i], out.log_viscosity_t[i]) = (0.0, 0.0);
            }
            out.fluidity[i] = -log_viscosity.min(LOG_VISCOSITY_CEILING);
        }
        elementary::exponentials(&mut out.fluidity);
        if frozen {
            (out.density_p, out.log_viscosity_p) = (zero, zero);
        }
        out
    }

    /// Returns V/V₀ at p \[Pa\] and ΔT \[K\] with its derivatives by both.
    fn volume(&self, tait: Tait, p: f64, rise: f64) -> [f64; 3] {
        let (softening, expansion) =
            self.heat.oil.free_volume.map_or((0.0, 0.0), |volume| (volume.bulk_modulus_temperature, volume.expansion));
        let modulus = tait.k_0 * (-softening * rise).exp();
        let compressed = 1.0 + tait.k_0_prime;
        let argument = (1.0 + p * compressed / modulus).max(LEAST);
        let share = 1.0 - argument.ln() / compressed;
        let swollen = (1.0 + expansion * rise).max(LEAST);
        // A decrease of the modulus has the effect of a pressure rise.
        let by_p = -1.0 / (modulus * argument);
        let volume = swollen * share;
        if volume < 0.1 {
            return [0.1, 0.0, 0.0];
        }
        [volume, swollen * by_p, expansion * share + swollen * by_p * p * softening]
    }

    /// Returns ln(η/η₀) at p \[Pa\] and ΔT \[K\] with its derivatives by both.
    fn doolittle(&self, law: Doolittle, p: f64, rise: f64) -> [f64; 3] {
        let [volume, volume_p, volume_t] = self.volume(law.volume, p, rise);
        let occupied_slope = self.heat.oil.free_volume.map_or(0.0, |volume| volume.occupied_expansion);
        let ratio = 1.0 + occupied_slope * rise;
        let free = volume - law.r_0 * ratio;
        if free.is_nan() || free <= 0.0 {
            return [f64::INFINITY, 0.0, 0.0];
        }
        let strength = law.b * law.r_0;
        let by_volume = -strength * ratio / (free * free);
        // d(r/(V − R₀r)) = (V dr − r dV)/(V − R₀r)².
        [
            strength * (ratio / free - 1.0 / (1.0 - law.r_0)),
            by_volume * volume_p,
            by_volume * volume_t + strength * volume * occupied_slope / (free * free),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::super::heat::FreeVolumeHeat;
    use super::super::{Lubricant, OilHeat};
    use super::*;
    use crate::solver::physics::contact::OperatingPoint;

    const SQUALANE: Tait = Tait { k_0: 1.007837e9, k_0_prime: 11.29 };

    fn all_laws() -> Vec<(Lubricant, WarmFluid)> {
        let doolittle = ViscosityLaw::Doolittle(Doolittle { b: 4.2, r_0: 0.658, volume: SQUALANE });
        let volume = FreeVolumeHeat { bulk_modulus_temperature: 6e-3, expansion: 8e-4, occupied_expansion: -5e-4 };
        let oil = OilHeat { free_volume: Some(volume), ..OilHeat::default() };
        let point = OperatingPoint { load: 1e5, ..OperatingPoint::TABLE_2_1 };
        let pairs = [
            (DensityLaw::Incompressible, ViscosityLaw::Barus),
            (DensityLaw::DowsonHigginson, ViscosityLaw::Roelands),
            (DensityLaw::Tait(SQUALANE), doolittle),
        ];
        let made = pairs.map(|(density, viscosity)| {
            let laws = Lubricant { density, viscosity, ..Lubricant::default() };
            (laws, WarmFluid::new(&laws.scaled(&point).unwrap(), Heat { oil, ..Heat::default() }))
        });
        made.to_vec()
    }

    #[test]
    fn at_the_inlets_temperature_the_laws_are_those_without_heat() {
        for (laws, warm) in all_laws() {
            for p in [-1e-4, 0.0, 0.3, 1.0] {
                let (at, alone) = (warm.at(p, &[0.0; 9]), warm.fluid.at(p));
                for (value, wanted) in [
                    (at.density[4], alone.density),
                    (at.density_p[4], alone.density_slope),
                    (at.fluidity[4] * alone.viscosity, 1.0),
                    (at.log_viscosity_p[4], alone.log_viscosity_slope),
                ] {
                    assert!((value - wanted).abs() <= 3e-14 * wanted.abs().max(1.0), "{laws:?} at {p}");
                }
            }
        }
    }

    #[test]
    fn derivatives_agree_with_finite_differences() {
        for (laws, warm) in all_laws() {
            for (p, theta) in [(0.0, 0.0), (0.2, 0.05), (0.6, 0.2), (1.0, 0.1), (0.4, -0.03)] {
                let at = |p: f64, t: f64| warm.at(p, &[t]);
                let (mid, step) = (at(p, theta), 1e-6);
                let quotient = |a: Across<1>, b: Across<1>, of: fn(&Across<1>) -> f64| (of(&b) - of(&a)) / (2.0 * step);
                let density = |s: &Across<1>| s.density[0];
                let log = |s: &Across<1>| -s.fluidity[0].ln();
                let (west, east) = (at(p - step, theta), at(p + step, theta));
                let (below, above) = (at(p, theta - step), at(p, theta + step));
                for (value, wanted) in [
                    (mid.density_p[0], quotient(west, east, density)),
                    (mid.density_t[0], quotient(below, above, density)),
                    (mid.log_viscosity_p[0], quotient(west, east, log)),
                    (mid.log_viscosity_t[0], quotient(below, above, log)),
                ] {
                    assert!((value - wanted).abs() < 1e-6 * wanted.abs().max(1e-2), "{laws:?}: {value} {wanted}");
                }
            }
        }
    }

    #[test]
    fn roelands_viscosity_falls_by_beta_per_kelvin_at_the_inlet() {
        let (_, warm) = all_laws()[1];
        let slope = warm.at(0.0, &[0.0]).log_viscosity_t[0] / 313.15;
        assert!((slope + 0.045).abs() < 1e-12);
    }

    #[test]
    fn no_passing_iterate_makes_a_law_overflow() {
        for (laws, warm) in all_laws() {
            for (p, theta) in [(-1e6, -5.0), (1e3, 1e3), (1.0, -0.9), (0.5, 1e9)] {
                let at = warm.at(p, &[theta]);
                assert!(at.density[0] > 0.0 && at.fluidity[0].is_finite() && at.fluidity[0] > 0.0, "{laws:?}");
                assert!(at.log_viscosity_t[0].is_finite() && at.density_t[0].is_finite());
            }
        }
    }
}
