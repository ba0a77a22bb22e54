//! The numbers that a calibration is made of, as files store them.

use super::Calibration;
use super::quantity::Quantity;

/// Everything from which a calibration can be made again.
#[derive(Clone, Debug, PartialEq)]
pub struct CalibrationParts {
    /// Smallest and largest value of each feature in the evidence.
    pub ranges: Vec<(f64, f64)>,
    /// Places of the evidence, each coordinate in −1…1, one after the other.
    pub places: Vec<f32>,
    /// Coefficients of the law of each quantity, then its mean square and its quantile.
    pub laws: Vec<Vec<f64>>,
    /// By how much the logarithm of each error of the evidence exceeds the law of each quantity; NaN if the error was not
    /// measured.
    pub surplus: Vec<Vec<f32>>,
}

impl Calibration {
    /// Its numbers.
    pub fn parts(&self) -> CalibrationParts {
        let law = |own: &Quantity| own.law.iter().copied().chain([own.mean_square, own.quantile]).collect();
        CalibrationParts {
            ranges: self.ranges.clone(),
            places: self.places.clone(),
            laws: self.quantities.iter().map(law).collect(),
            surplus: self.quantities.iter().map(|own| own.surplus.clone()).collect(),
        }
    }

    /// The calibration of some numbers; `None` if they make no sense.
    pub fn from_parts(parts: CalibrationParts) -> Option<Self> {
        let CalibrationParts { ranges, places, laws, surplus } = parts;
        if laws.len() != surplus.len() {
            return None;
        }
        let quantity = |(mut law, surplus): (Vec<f64>, Vec<f32>)| {
            let (quantile, mean_square) = (law.pop()?, law.pop()?);
            Some(Quantity { law, mean_square, quantile, ..Quantity::of_surplus(surplus) })
        };
        let quantities = laws.into_iter().zip(surplus).map(quantity).collect::<Option<_>>()?;
        Some(Self { ranges, places, quantities }).filter(Self::sound)
    }
}
