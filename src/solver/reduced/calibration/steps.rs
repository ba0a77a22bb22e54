//! A calibration in small whole numbers, as files keep it: where its evidence lies, and by how much the errors there exceed
//! the law, need no more than two digits.

use super::quantity::Quantity;
use super::{Calibration, SIGNS};
use serde::{Deserialize, Serialize};

/// Steps of the coordinates of places in −1…1.
const PLACE: f64 = 1.0 / 256.0;
/// Steps of the logarithms of errors.
const SURPLUS: f64 = 1.0 / 64.0;
/// Of an error that was not measured.
const UNKNOWN: i16 = i16::MIN;

/// What a calibration is made of but for its evidence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Laws {
    ranges: Vec<(f64, f64)>,
    /// Of each quantity the coefficients, the mean square and the quantile.
    laws: Vec<(Vec<f64>, f64, f64)>,
}

/// A coordinate of a place as it is kept.
pub(super) fn kept_place(value: f32) -> f32 {
    kept(f64::from(value), PLACE)
}

/// A surplus as it is kept.
pub(super) fn kept_surplus(value: f64) -> f32 {
    kept(value, SURPLUS)
}

/// The nearest of so wide steps; one zero only, and one that is no number.
fn kept(value: f64, step: f64) -> f32 {
    if value.is_nan() { f32::NAN } else { ((value / step).round() * step + 0.0) as f32 }
}

fn steps(value: f32, step: f64) -> Option<i16> {
    if value.is_nan() {
        return Some(UNKNOWN);
    }
    let steps = f64::from(value) / step;
    let whole = steps.fract() == 0.0 && steps.abs() <= f64::from(i16::MAX);
    whole.then_some(steps as i16)
}

fn value(steps: i16, step: f64) -> f32 {
    if steps == UNKNOWN { f32::NAN } else { (f64::from(steps) * step) as f32 }
}

impl Calibration {
    /// Its laws, and the steps of its places, then of each quantity; `None` where these are no whole ones, as of models that
    /// were trained before they were kept so.
    pub fn in_steps(&self) -> Option<(Laws, Vec<i16>)> {
        let places = self.places.iter().map(|place| steps(*place, PLACE));
        let surplus = self.quantities.iter().flat_map(|quantity| &quantity.surplus);
        let numbers = places.chain(surplus.map(|surplus| steps(*surplus, SURPLUS))).collect::<Option<_>>()?;
        let law = |quantity: &Quantity| (quantity.law.clone(), quantity.mean_square, quantity.quantile);
        Some((Laws { ranges: self.ranges.clone(), laws: self.quantities.iter().map(law).collect() }, numbers))
    }

    /// Takes what [`Self::in_steps`] gave from the beginning of such numbers, for so many pieces of evidence; `None` where
    /// there are not as many.
    pub fn from_steps(laws: Laws, evidence: usize, numbers: &mut std::vec::IntoIter<i16>) -> Option<Self> {
        let Laws { ranges, laws } = laws;
        let mut next = |count: usize, step: f64| {
            let some = count <= numbers.len();
            some.then(|| numbers.by_ref().take(count).map(|steps| value(steps, step)).collect::<Vec<f32>>())
        };
        let places = next(evidence.checked_mul(ranges.len().checked_sub(SIGNS.len())?)?, PLACE)?;
        let quantity = |(law, mean_square, quantile)| {
            Some(Quantity { law, mean_square, quantile, ..Quantity::of_surplus(next(evidence, SURPLUS)?) })
        };
        let quantities = laws.into_iter().map(quantity).collect::<Option<_>>()?;
        Some(Self { ranges, places, quantities })
    }
}
