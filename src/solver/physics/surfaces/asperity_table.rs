//! Tabulated asperity law. Interpolation is much faster than the law's integrals.

use super::asperity_laws::AsperityLaw;

/// Range of the tabulated separation l, in units of σ, and number of points per unit.
const RANGE: (f64, f64) = (-12.0, 14.0);
const PER_UNIT: f64 = 64.0;

/// Asperity law at one reduced modulus, tabulated as a cubic Hermite spline of ln p_a. Its relative error is 1e-10 for
/// the pressure and 1e-7 for the derivative, which is exactly that of the spline. Below the table ln p_a is linear. Above
/// it the pressure is set to zero; it would be less than e^(−70) times the pressure at l = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct AsperityTable {
    law: AsperityLaw,
    modulus_pa: f64,
    /// ln p_a \[Pa\] and its derivative times the spacing of the table, from the lower end of the range; empty for the
    /// exponential law, which needs no table.
    logarithms: Vec<[f64; 2]>,
}

impl AsperityTable {
    /// Tabulates a law. `modulus_pa` is the reduced modulus E′.
    pub fn new(law: AsperityLaw, modulus_pa: f64) -> Self {
        let count = match law {
            AsperityLaw::Exponential { .. } => 0,
            AsperityLaw::GreenwoodTripp { .. } | AsperityLaw::ZhaoMaiettaChang { .. } => {
                ((RANGE.1 - RANGE.0) * PER_UNIT) as u32 + 1
            }
        };
        let entry = |k: u32| {
            let (pressure, slope) = law.pressure(modulus_pa, RANGE.0 + f64::from(k) / PER_UNIT);
            [pressure.ln(), slope / pressure / PER_UNIT]
        };
        Self { law, modulus_pa, logarithms: (0..count).map(entry).collect() }
    }

    /// Returns true if this is the table of a law and modulus.
    pub fn is_of(&self, law: AsperityLaw, modulus_pa: f64) -> bool {
        self.law == law && self.modulus_pa == modulus_pa
    }

    /// Returns the mean pressure p_a \[Pa\] and its derivative with respect to l at a separation l.
    #[inline]
    pub fn pressure(&self, separation: f64) -> (f64, f64) {
        let at = (separation - RANGE.0) * PER_UNIT;
        let cell = at.max(0.0) as usize;
        let Some([[left, left_slope], [right, right_slope]]) =
            self.logarithms.get(cell..cell + 2).and_then(|cell| <[[f64; 2]; 2]>::try_from(cell).ok())
        else {
            return if self.logarithms.is_empty() {
                self.law.pressure(self.modulus_pa, separation)
            } else {
                (0.0, 0.0)
            };
        };
        let (logarithm, slope) = if at < 0.0 {
            (left + at * left_slope, left_slope)
        } else {
            let t = at - cell as f64;
            let (rise, bend) = (right - left, left_slope + right_slope - 2.0 * (right - left));
            let turn = rise - left_slope - bend;
            (left + t * (left_slope + t * (turn + t * bend)), left_slope + t * (2.0 * turn + 3.0 * t * bend))
        };
        let pressure = logarithm.exp();
        (pressure, pressure * slope * PER_UNIT)
    }

    /// Returns the separation at which the pressure equals a value \[Pa\], by bisection. The pressure falls with the
    /// separation.
    pub fn separation_at(&self, pressure_pa: f64) -> f64 {
        let (mut low, mut high) = (-2.0 * RANGE.1, RANGE.1);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.pressure(middle).0 > pressure_pa { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}
