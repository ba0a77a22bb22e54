//! Roughness of a contact in the solver's variables: H in units of a²/R, P in units of p_H.

use super::asperity_table::AsperityTable;
use super::flow_factors::FlowFactors;
use super::mean_gap::mean_gap;
use super::roughness::Roughness;
use crate::solver::physics::contact::OperatingPoint;

/// Roughness at one operating point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaledRoughness {
    /// Roughness as stated.
    pub roughness: Roughness,
    /// S = σR/a²: σ in units of the film thickness.
    pub sigma: f64,
    /// p_H \[Pa\].
    hertz_pressure_pa: f64,
    /// E′ \[Pa\].
    modulus_pa: f64,
    /// Flow along X.
    along: FlowFactors,
    /// Flow along Y, which sees the reciprocal Peklenik number. `None` if it equals that along X, and for a line contact.
    across: Option<FlowFactors>,
    /// SRR/2 (σ₁² − σ₂²)/σ², the factor of the shear flow.
    shear: f64,
}

impl ScaledRoughness {
    /// Scales the roughness of a contact; `None` for smooth surfaces.
    pub fn new(roughness: Option<Roughness>, point: &OperatingPoint) -> Option<Self> {
        let roughness = roughness.filter(|roughness| roughness.sigma > 0.0)?;
        let Roughness { sigma, peklenik, shear_flow, .. } = roughness;
        let across = point.kind.is_point() && peklenik != 1.0;
        Some(Self {
            roughness,
            sigma: sigma / point.film_scale_m(),
            hertz_pressure_pa: point.hertz().pressure_pa,
            modulus_pa: point.modulus_pa,
            along: FlowFactors::new(peklenik),
            across: across.then(|| FlowFactors::new(1.0 / peklenik)),
            shear: 0.5 * point.sliding.slide_to_roll_ratio * shear_flow,
        })
    }

    /// Tabulates the asperity law.
    pub fn table(&self) -> AsperityTable {
        AsperityTable::new(self.roughness.asperities, self.modulus_pa)
    }

    /// Returns true if a table is that of this contact.
    pub fn fits(&self, table: &AsperityTable) -> bool {
        table.is_of(self.roughness.asperities, self.modulus_pa)
    }

    /// True if the flows along X and Y differ.
    pub fn is_anisotropic(&self) -> bool {
        self.across.is_some()
    }

    /// Returns the asperity pressure P_a and dP_a/dH at the film thickness H.
    #[inline]
    pub fn asperity_pressure(&self, table: &AsperityTable, film: f64) -> (f64, f64) {
        let (pressure, slope) = table.pressure(film / self.sigma);
        (pressure / self.hertz_pressure_pa, slope / (self.hertz_pressure_pa * self.sigma))
    }

    /// Returns the film thickness H at which the asperity pressure is P_a.
    pub fn film_at(&self, table: &AsperityTable, asperity_pressure: f64) -> f64 {
        self.sigma * table.separation_at(asperity_pressure * self.hertz_pressure_pa)
    }

    /// Returns the mean gap in units of a²/R and its derivative by H.
    #[inline]
    pub fn mean_gap(&self, film: f64) -> (f64, f64) {
        let (gap, slope) = mean_gap(film / self.sigma);
        (self.sigma * gap, slope)
    }

    /// Returns the shear flow of unequal roughness, per density, and its derivative by H.
    #[inline]
    pub fn shear_flow(&self, film: f64) -> (f64, f64) {
        if self.shear == 0.0 {
            return (0.0, 0.0);
        }
        let (flow, rate) = self.along.shear(film / self.sigma);
        (self.shear * self.sigma * flow, self.shear * rate)
    }

    /// Returns the cube of the film thickness times the pressure flow factor along X, and its derivative by H.
    #[inline]
    pub fn cube(&self, film: f64) -> (f64, f64) {
        self.cube_by(&self.along, film)
    }

    /// Returns the same across, if it differs.
    pub fn cube_across(&self, film: f64) -> Option<(f64, f64)> {
        Some(self.cube_by(self.across.as_ref()?, film))
    }

    #[inline]
    fn cube_by(&self, factors: &FlowFactors, film: f64) -> (f64, f64) {
        let (cube, slope) = factors.pressure(film / self.sigma);
        let square = self.sigma * self.sigma;
        (square * self.sigma * cube, square * slope)
    }
}
