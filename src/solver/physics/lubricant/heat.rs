//! Thermal constants of a lubricant and of both bodies, their ranges, and the thermal parameters of one contact.

use super::error::{LubricantError, check_constant};
use super::laws::ViscosityLaw;
use super::scaled::ScaledFluid;
use super::warm::WarmFluid;
use crate::solver::limits::Number;
use crate::solver::physics::bodies::{BodyHeat, surface_speeds};
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Thermal constants of a lubricant. The defaults are those of a mineral oil.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct OilHeat {
    /// Specific heat capacity c_p \[J/(kg K)\].
    pub heat_capacity: f64,
    /// Thermal conductivity k \[W/(m K)\].
    pub conductivity: f64,
    /// Density ρ₀ at ambient pressure and the inlet's temperature \[kg/m³\].
    pub density: f64,
    /// β = −d ln η/dT at ambient pressure \[1/K\], for Roelands' and Barus' laws. Doolittle's law has separate
    /// constants.
    pub viscosity_temperature: f64,
    /// β_ρ = −d ln ρ/dT at ambient pressure \[1/K\]. Tait's law has separate constants.
    pub density_temperature: f64,
    /// Thermal constants of Tait's and Doolittle's laws.
    pub free_volume: Option<FreeVolumeHeat>,
}

/// Temperature dependence of the volumes in Tait's and Doolittle's laws; Bair 2007.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FreeVolumeHeat {
    /// β_K \[1/K\]: the bulk modulus is K₀ exp(−β_K ΔT).
    pub bulk_modulus_temperature: f64,
    /// a_V \[1/K\]: the volume at ambient pressure is that at the inlet times 1 + a_V ΔT.
    pub expansion: f64,
    /// ε \[1/K\]: the occupied volume is that at the inlet times 1 + ε ΔT.
    pub occupied_expansion: f64,
}

/// Input data of a thermal film. η₀ and α are those at the inlet temperature.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Heat {
    /// Temperature T₀ of the lubricant and of both bodies in front of the contact \[K\].
    pub inlet_temperature: f64,
    /// Thermal constants of the lubricant.
    pub oil: OilHeat,
    /// Thermal constants of body 1, which moves with u_m (1 − SRR/2), and of body 2, which moves with u_m (1 +
    /// SRR/2).
    pub bodies: [BodyHeat; 2],
}

impl OilHeat {
    /// Typical mineral oil.
    pub const MINERAL: Self = Self {
        heat_capacity: 2000.0,
        conductivity: 0.14,
        density: 870.0,
        viscosity_temperature: 0.045,
        density_temperature: 6.5e-4,
        free_volume: None,
    };
}

impl Default for OilHeat {
    fn default() -> Self {
        Self::MINERAL
    }
}

impl Default for Heat {
    fn default() -> Self {
        Self { inlet_temperature: 313.15, oil: OilHeat::default(), bodies: [BodyHeat::default(); 2] }
    }
}

/// Largest |SRR| of a thermal contact. Beyond it one surface is nearly stationary, and heat leaves the contact
/// through it in ways that the theory of moving heat sources does not cover.
pub const LARGEST_HEATED_SRR: f64 = 1.95;

impl Heat {
    /// Refuses unphysical constants.
    ///
    /// # Errors
    /// If a constant is out of range; the error names it.
    pub(super) fn check(&self, viscosity: ViscosityLaw, tait: bool) -> Result<(), LubricantError> {
        check_constant("the inlet temperature in kelvin", self.inlet_temperature, 230.0, 500.0)?;
        let oil = &self.oil;
        check_constant("the oil's heat capacity in J/(kg K)", oil.heat_capacity, 100.0, 2e4)?;
        check_constant("the oil's thermal conductivity in W/(m K)", oil.conductivity, 1e-3, 100.0)?;
        check_constant("the oil's density in kg/m³", oil.density, 100.0, 2e4)?;
        check_constant("the viscosity's temperature coefficient in 1/K", oil.viscosity_temperature, 0.0, 0.3)?;
        check_constant("the density's temperature coefficient in 1/K", oil.density_temperature, 0.0, 5e-3)?;
        for (number, body) in (1..).zip(&self.bodies) {
            let own = |constant: &str, value, min, max| {
                check_constant(&format!("body {number}'s {constant}"), value, min, max)
            };
            own("thermal conductivity in W/(m K)", body.conductivity, 0.01, 5000.0)?;
            own("heat capacity in J/(kg K)", body.heat_capacity, 10.0, 2e4)?;
            own("density in kg/m³", body.density, 50.0, 3e4)?;
        }
        match oil.free_volume {
            Some(volume) => volume.check(),
            None if tait || matches!(viscosity, ViscosityLaw::Doolittle(_)) => Err(LubricantError(
                "heat needs to know how Tait's and Doolittle's volumes change with temperature: give the oil's \
                 free_volume; typical are a bulk_modulus_temperature of 6e-3, an expansion of 8e-4 and an \
                 occupied_expansion of -5e-4 per kelvin"
                    .to_owned(),
            )),
            None => Ok(()),
        }
    }

    /// Refuses bodies that are stationary or run backwards, to which the theory of moving heat sources does not
    /// apply.
    pub(super) fn check_sliding(slide_to_roll_ratio: f64) -> Result<(), LubricantError> {
        if slide_to_roll_ratio.abs() <= LARGEST_HEATED_SRR {
            return Ok(());
        }
        Err(LubricantError(format!(
            "at SRR {} a body stands all but still or runs backwards, where the theory of moving heat sources ends; with \
             heat SRR between -{LARGEST_HEATED_SRR} and {LARGEST_HEATED_SRR} is accepted",
            Number(slide_to_roll_ratio)
        )))
    }
}

impl FreeVolumeHeat {
    fn check(&self) -> Result<(), LubricantError> {
        check_constant("bulk_modulus_temperature in 1/K", self.bulk_modulus_temperature, 0.0, 0.05)?;
        check_constant("expansion in 1/K", self.expansion, 0.0, 5e-3)?;
        check_constant("occupied_expansion in 1/K", self.occupied_expansion, -5e-3, 5e-3)
    }
}

/// Thermal parameters of a scaled contact. The variables are θ = (T − T₀)/T₀, ζ = z/h, speeds over u_m and stresses
/// over η₀u_mR/a².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledHeat {
    /// Thermal constants from which it was made.
    pub heat: Heat,
    /// Temperature-dependent laws.
    pub fluid: WarmFluid,
    /// ū_1 and ū_2, the speeds of body 1 and body 2.
    pub speeds: [f64; 2],
    /// κ = 12/λ̄: the pressure gradient in the scale of stresses, τ̄ = τ̄_m + κ H P_X (ζ − ½).
    pub gradient: f64,
    /// C₁ = k R²/(ρ₀ c_p u_m a³), coefficient of conduction across the film.
    pub conduction: f64,
    /// C₂ = η₀ u_m R²/(ρ₀ c_p T₀ a³), coefficient of shear heating.
    pub shear: f64,
    /// C₃ = p_H/(ρ₀ c_p T₀), coefficient of compressive heating.
    pub compression: f64,
    /// D_i = k R a^(−3/2)/√(π ρ_i c_i k_i u_m ū_i): temperature rise of a surface per heat flux into it.
    pub surfaces: [f64; 2],
    /// Stress scale η₀ u_m R/a² \[Pa\].
    pub stress_scale_pa: f64,
}

impl ScaledHeat {
    /// Computes the thermal parameters of one contact. The SRR of the point must have been accepted.
    pub(super) fn new(heat: Heat, fluid: &ScaledFluid, point: &OperatingPoint) -> Self {
        let (radius, speed, half_width) = (point.radius_m, point.speed_m_per_s, point.hertz().half_width_m);
        let Heat { inlet_temperature, oil, bodies } = heat;
        let speeds = surface_speeds(1.0, point.sliding.slide_to_roll_ratio);
        let stored = oil.density * oil.heat_capacity;
        let cube = half_width.powi(3);
        let flux = oil.conductivity * radius * half_width.powf(-1.5);
        let surface = |body: BodyHeat, own: f64| {
            flux / (PI * body.density * body.heat_capacity * body.conductivity * speed * own).sqrt()
        };
        Self {
            heat,
            fluid: WarmFluid::new(fluid, heat),
            speeds,
            gradient: 12.0 / point.lambda_bar(),
            conduction: oil.conductivity * radius * radius / (stored * speed * cube),
            shear: point.viscosity_pa_s * speed * radius * radius / (stored * inlet_temperature * cube),
            compression: point.hertz().pressure_pa / (stored * inlet_temperature),
            surfaces: [surface(bodies[0], speeds[0]), surface(bodies[1], speeds[1])],
            stress_scale_pa: point.viscosity_pa_s * speed * radius / (half_width * half_width),
        }
    }

    /// Returns the body with the smaller Péclet number, 1 or 2, and that number. Heat conduction upstream within a
    /// body is neglected.
    pub fn smallest_peclet(&self, point: &OperatingPoint) -> (usize, f64) {
        let half_width = point.hertz().half_width_m;
        let peclet = |body: &BodyHeat, speed: f64| {
            let diffusivity = body.conductivity / (body.density * body.heat_capacity);
            point.speed_m_per_s * speed * half_width / (2.0 * diffusivity)
        };
        let [first, second] = [0, 1].map(|i| peclet(&self.heat.bodies[i], self.speeds[i]));
        if first <= second { (1, first) } else { (2, second) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Lubricant;
    use super::*;

    #[test]
    fn a_contact_has_the_numbers_of_its_definition() {
        let point = OperatingPoint { viscosity_pa_s: 0.02, ..OperatingPoint::TABLE_2_1 };
        let fluid = Lubricant::default().scaled(&point).unwrap();
        let heat = ScaledHeat::new(Heat::default(), &fluid, &point);
        let (a, r, u, eta) = (point.hertz().half_width_m, point.radius_m, point.speed_m_per_s, point.viscosity_pa_s);
        let close = |value: f64, wanted: f64| assert!((value / wanted - 1.0).abs() < 1e-12, "{value} {wanted}");
        close(heat.gradient * heat.stress_scale_pa, point.hertz().pressure_pa * a / r);
        close(heat.conduction, 0.14 * r * r / (870.0 * 2000.0 * u * a.powi(3)));
        close(heat.shear, heat.stress_scale_pa.powi(2) / eta * a / (870.0 * 2000.0 * 313.15 * u));
        close(heat.surfaces[0], 0.14 * r * a.powf(-1.5) / (PI * u).sqrt() / BodyHeat::default().effusivity());
    }

    #[test]
    fn constants_outside_their_ranges_are_named() {
        let refused = |heat: Heat| heat.check(ViscosityLaw::Roelands, false).unwrap_err().to_string();
        assert!(refused(Heat { inlet_temperature: 20.0, ..Heat::default() }).contains("inlet temperature"));
        let steel = BodyHeat::default();
        let cold = BodyHeat { conductivity: f64::NAN, ..steel };
        assert!(refused(Heat { bodies: [steel, cold], ..Heat::default() }).contains("body 2's thermal"));
        let missing = Heat::default().check(ViscosityLaw::Roelands, true).unwrap_err().to_string();
        assert!(missing.contains("free_volume") && missing.contains("8e-4"), "{missing}");
        for srr in [2.0, -3.0, f64::NAN] {
            assert!(Heat::check_sliding(srr).unwrap_err().to_string().contains("moving heat sources"));
        }
        assert!(Heat::check_sliding(1.9).is_ok() && Heat::default().check(ViscosityLaw::Barus, false).is_ok());
    }
}
