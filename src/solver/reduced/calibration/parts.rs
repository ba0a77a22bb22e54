//! Numbers of a calibration, as stored in files.

use super::Calibration;
use super::quantity::Quantity;

/// All numbers needed to rebuild a calibration.
#[derive(Clone, Debug, PartialEq)]
pub struct CalibrationParts {
    /// Smallest and largest value of each feature in the evidence.
    pub ranges: Vec<(f64, f64)>,
    /// Positions of the evidence, one after the other; each coordinate is scaled to −1…1.
    pub places: Vec<f32>,
    /// Coefficients of the law of each quantity, followed by its mean square and its quantile.
    pub laws: Vec<Vec<f64>>,
    /// Difference between the logarithm of each error of the evidence and the law of each quantity; NaN if the error
    /// was not measured.
    pub surplus: Vec<Vec<f32>>,
}

impl Calibration {
    /// Returns the numbers of the calibration.
    pub fn parts(&self) -> CalibrationParts {
        let law = |own: &Quantity| own.law.iter().copied().chain([own.mean_square, own.quantile]).collect();
        CalibrationParts {
            ranges: self.ranges.clone(),
            places: self.places.clone(),
            laws: self.quantities.iter().map(law).collect(),
            surplus: self.quantities.iter().map(|own| own.surplus.clone()).collect(),
        }
    }

    /// Builds a calibration from its numbers; `None` if they are invalid.
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
