//! Types of the solver as the former files have them.

use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, Sliding};
use crate::solver::reduced::{CIRCLES, Domain, HeatDomain, OilDomain, SlidingDomain, Snapshot};
use serde::{Deserialize, Serialize};

#[derive(Serialize, Deserialize)]
pub(super) struct FormerDomain {
    m: (f64, f64),
    l: (f64, f64),
    alpha_per_pa: (f64, f64),
    max_hertz_pressure_pa: f64,
    viscosity_pa_s: f64,
    lubricant: Lubricant,
    sliding: Option<SlidingDomain>,
}

impl From<FormerDomain> for Domain {
    fn from(former: FormerDomain) -> Self {
        let FormerDomain { m, l, alpha_per_pa, max_hertz_pressure_pa, viscosity_pa_s, lubricant, sliding } = former;
        let (radius_ratio, oils, heat, eyring) = (CIRCLES, None, None, None);
        Self {
            m,
            l,
            alpha_per_pa,
            max_hertz_pressure_pa,
            viscosity_pa_s,
            lubricant,
            sliding,
            radius_ratio,
            oils,
            heat,
            eyring,
        }
    }
}

#[derive(Serialize, Deserialize)]
pub(super) struct FormerHeatDomain {
    srr: (f64, f64),
    radius_m: (f64, f64),
    modulus_pa: (f64, f64),
    speed_m_per_s: (f64, f64),
    fastest_sliding_m_per_s: f64,
}

impl From<FormerHeatDomain> for HeatDomain {
    fn from(former: FormerHeatDomain) -> Self {
        let FormerHeatDomain { srr, radius_m, modulus_pa, speed_m_per_s, fastest_sliding_m_per_s } = former;
        Self { srr, radius_m, modulus_pa, speed_m_per_s, fastest_sliding_m_per_s, thermal: None }
    }
}

#[derive(Clone, Copy, Serialize, Deserialize)]
pub(super) struct FormerOilDomain {
    viscosity_pa_s: (f64, f64),
    exponent: (f64, f64),
    lowest_hertz_pressure_pa: f64,
}

impl FormerOilDomain {
    pub fn with(self, thinnest_film: f64) -> OilDomain {
        let Self { viscosity_pa_s, exponent, lowest_hertz_pressure_pa } = self;
        OilDomain { viscosity_pa_s, exponent, lowest_hertz_pressure_pa, thinnest_film }
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
