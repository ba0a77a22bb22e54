//! Types of the solver as the former files have them.

use crate::solver::parameters::{Axis, CIRCLES, ParameterSpace, Quantity};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw, Sliding};
use crate::solver::reduced::Snapshot;
use serde::{Deserialize, Serialize};

#[derive(Clone, Serialize, Deserialize)]
pub(in crate::engine) struct FormerDomain {
    pub m: (f64, f64),
    pub l: (f64, f64),
    pub alpha_per_pa: (f64, f64),
    pub max_hertz_pressure_pa: f64,
    pub viscosity_pa_s: f64,
    pub lubricant: Lubricant,
    pub sliding: Option<FormerSliding>,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
pub(in crate::engine) struct FormerSliding {
    pub srr: (f64, f64),
    pub npr: (f64, f64),
    pub modulus_pa: f64,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
pub(in crate::engine) struct FormerHeat {
    pub srr: (f64, f64),
    pub radius_m: (f64, f64),
    pub modulus_pa: (f64, f64),
    pub speed_m_per_s: (f64, f64),
    pub fastest_sliding_m_per_s: f64,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
pub(in crate::engine) struct FormerOils {
    pub viscosity_pa_s: (f64, f64),
    pub exponent: (f64, f64),
    pub lowest_hertz_pressure_pa: f64,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
pub(in crate::engine) struct FormerEyring {
    pub srr: (f64, f64),
    pub modulus_pa: (f64, f64),
    pub limit_slope: (f64, f64),
    pub gradient_stress_pa: f64,
}

/// Inlet temperature, β, β_ρ, k, ρc, effusivity, and the limiting stress at ambient pressure, its slope and τ_E.
pub(in crate::engine) type FormerThermal = [(f64, f64); 9];

/// What a domain has beside [`FormerDomain`].
#[derive(Clone, Copy, Default)]
pub(in crate::engine) struct Further {
    pub oils: Option<(FormerOils, f64)>,
    pub heat: Option<FormerHeat>,
    pub eyring: Option<FormerEyring>,
    pub thermal: Option<FormerThermal>,
    pub radius_ratio: Option<(f64, f64)>,
}

impl FormerDomain {
    /// The space that it declares.
    pub fn space(&self, further: Further) -> ParameterSpace {
        let Further { oils, heat, eyring, thermal, radius_ratio } = further;
        let lowest = oils.map_or(0.0, |(oils, _)| oils.lowest_hertz_pressure_pa);
        let mut space = ParameterSpace::of([Axis::new(Quantity::M, self.m), Axis::new(Quantity::L, self.l)])
            .limited([(Quantity::HertzPressure, (lowest, self.max_hertz_pressure_pa))]);
        let axis = |space: &mut ParameterSpace, quantity, ends| space.axes.push(Axis::new(quantity, ends));
        match (oils, self.sliding.is_some() || heat.is_some()) {
            (Some((oils, film)), _) => {
                space.axes[1] = Axis::logarithmic(Quantity::L, self.l);
                axis(&mut space, Quantity::Alpha, self.alpha_per_pa);
                axis(&mut space, Quantity::Viscosity, oils.viscosity_pa_s);
                space.limits.push((Quantity::RoelandsExponent, oils.exponent));
                space.limits.extend((film > 0.0).then_some((Quantity::FilmThickness, (film, 1e6))));
            }
            (None, true) => {
                space
                    .fixed
                    .extend([(Quantity::Viscosity, self.viscosity_pa_s), (Quantity::Alpha, self.alpha_per_pa.0)]);
            }
            (None, false) if radius_ratio.is_none_or(|ratio| ratio == CIRCLES) => {
                axis(&mut space, Quantity::Alpha, self.alpha_per_pa);
                space.fixed.push((Quantity::Viscosity, self.viscosity_pa_s));
            }
            (None, false) => {}
        }
        if let Some(FormerSliding { srr, npr, modulus_pa }) = self.sliding {
            axis(&mut space, Quantity::SlideToRollRatio, srr);
            axis(&mut space, Quantity::NewtonianPlateauRatio, npr);
            space.fixed.push((Quantity::Modulus, modulus_pa));
        }
        if let Some(FormerEyring { srr, modulus_pa, limit_slope, gradient_stress_pa }) = eyring {
            axis(&mut space, Quantity::SlideToRollRatio, srr);
            axis(&mut space, Quantity::Modulus, modulus_pa);
            space.limits.push((Quantity::GradientStress, (0.0, gradient_stress_pa)));
            let stress = match self.lubricant.shear {
                ShearLaw::Eyring { critical_stress, .. } => critical_stress,
                _ => 0.0,
            };
            space.constants = vec![
                Axis::new(Quantity::LimitAmbient, (0.0, 2.0 * stress)),
                Axis::logarithmic(Quantity::LimitSlope, limit_slope),
            ];
        }
        if let Some(heat) = heat {
            axis(&mut space, Quantity::Radius, heat.radius_m);
            axis(&mut space, Quantity::SlideToRollRatio, heat.srr);
            axis(&mut space, Quantity::Modulus, heat.modulus_pa);
            space.limits.push((Quantity::Speed, heat.speed_m_per_s));
            space.limits.push((Quantity::SlidingSpeed, (0.0, heat.fastest_sliding_m_per_s)));
        }
        if let Some([inlet, beta, beta_rho, k, capacity, effusivity, ambient, slope, eyring]) = thermal {
            let constants = [
                (Quantity::InletTemperature, inlet),
                (Quantity::ViscosityTemperature, beta),
                (Quantity::DensityTemperature, beta_rho),
                (Quantity::Conductivity, k),
                (Quantity::HeatCapacity, capacity),
                (Quantity::LimitAmbient, ambient),
                (Quantity::LimitSlope, slope),
                (Quantity::LimitEyring, eyring),
                (Quantity::Effusivity2, effusivity),
                (Quantity::Effusivity1, effusivity),
            ];
            space.constants = constants.map(|(quantity, ends)| Axis::new(quantity, ends)).to_vec();
        }
        if let Some(ratio) = radius_ratio.filter(|ratio| *ratio != CIRCLES) {
            axis(&mut space, Quantity::RadiusRatio, ratio);
        }
        space
    }
}

#[derive(Serialize, Deserialize)]
pub(super) struct FormerSnapshot {
    point: (ContactKind, [f64; 6], Sliding),
    coefficients: Vec<f64>,
    h_0: f64,
    h_c: f64,
}

impl From<FormerSnapshot> for Snapshot {
    fn from(FormerSnapshot { point: (kind, quantities, sliding), coefficients, h_0, h_c }: FormerSnapshot) -> Self {
        let point = OperatingPoint::from_quantities(kind, quantities, sliding);
        Self { point, coefficients, h_0, h_c, fronts: Vec::new(), grid_cost: None }
    }
}
