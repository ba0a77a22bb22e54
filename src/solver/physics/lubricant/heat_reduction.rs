//! Published thermal reduction factors of the film thickness, for shear heating in the inlet.

use super::ScaledHeat;
use crate::solver::physics::contact::OperatingPoint;

/// Published thermal reduction factor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeatReduction {
    /// Murch & Wilson, pure rolling.
    MurchWilson,
    /// Gupta, Cheng, Zhu, Forster & Schrand.
    Gupta,
}

/// Largest |SRR| that counts as pure rolling.
const ROLLING_SRR: f64 = 0.02;

impl HeatReduction {
    /// All factors.
    pub const ALL: [Self; 2] = [Self::MurchWilson, Self::Gupta];

    /// Returns its short name.
    pub fn name(self) -> &'static str {
        match self {
            Self::MurchWilson => "Murch–Wilson",
            Self::Gupta => "Gupta",
        }
    }

    /// Returns source and range of validity in one sentence.
    pub fn source(self) -> &'static str {
        match self {
            Self::MurchWilson => {
                "Murch & Wilson 1975, A thermal elastohydrodynamic inlet zone analysis, ASME J. Lubr. Technol. 97, \
                 3.94/(3.94 + Λ^0.62) with Λ = η₀βu_m²/k; pure rolling"
            }
            Self::Gupta => {
                "Gupta, Cheng, Zhu, Forster & Schrand 1992, Viscoelastic effects in MIL-L-7808-type lubricant, Tribology \
                 Transactions 35, (1 − 13.2 (p_H/E') Λ^0.42)/(1 + 0.213 (1 + 2.23 SRR^0.83) Λ^0.64) with Λ = η₀βu_m²/k"
            }
        }
    }

    /// Returns the factor for an isothermal film, between 0 and 1, and whether the contact lies in its range. The
    /// constants are quoted from later literature, not from the original papers.
    pub fn factor(self, point: &OperatingPoint, heat: &ScaledHeat) -> (f64, bool) {
        let per_kelvin = -heat.fluid.at(0.0, &[0.0]).log_viscosity_t[0] / heat.heat.inlet_temperature;
        let square = point.speed_m_per_s * point.speed_m_per_s;
        let loading = (point.viscosity_pa_s * per_kelvin * square / heat.heat.oil.conductivity).max(0.0);
        let srr = point.sliding.slide_to_roll_ratio.abs();
        let (factor, in_range) = match self {
            Self::MurchWilson => (3.94 / (3.94 + loading.powf(0.62)), srr <= ROLLING_SRR),
            Self::Gupta => {
                let pressed = 1.0 - 13.2 * (point.hertz().pressure_pa / point.modulus_pa) * loading.powf(0.42);
                let factor = pressed / (1.0 + 0.213 * (1.0 + 2.23 * srr.powf(0.83)) * loading.powf(0.64));
                (factor, factor > 0.0)
            }
        };
        (factor.clamp(0.0, 1.0), in_range)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Heat, Lubricant};
    use super::*;
    use crate::solver::full::Problem;
    use crate::solver::physics::contact::{ContactKind, Sliding};

    #[test]
    fn factors_are_those_of_their_formulas() {
        let lubricant = Lubricant { heat: Some(Heat::default()), ..Lubricant::default() };
        // η₀βu²/k, by hand.
        for (speed, srr, loading) in [(1.0, 0.0, 0.02 * 0.045 / 0.14), (10.0, 0.3, 2.0 * 0.045 / 0.14)] {
            let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
            let quantities = [0.02, speed, 5e5, 231e9, 0.02, 1.5e-8];
            let point = OperatingPoint::from_quantities(ContactKind::Line, quantities, sliding);
            let problem = Problem::new(&point, lubricant).unwrap();
            let heat = problem.heat.as_ref().unwrap();
            let [(murch, rolls), (gupta, known)] = HeatReduction::ALL.map(|by| by.factor(&point, heat));
            let wanted = 3.94 / (3.94 + f64::powf(loading, 0.62));
            assert!((murch / wanted - 1.0).abs() < 1e-3 && rolls == (srr == 0.0) && known, "{murch} {wanted}");
            assert!(gupta > 0.5 * murch && gupta < murch + 0.02, "{gupta} {murch}");
        }
    }
}
