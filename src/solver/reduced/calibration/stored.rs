//! A calibration without sliding as model files keep it.

use super::Calibration;
use super::features::{FEATURES, SIGNS};
use super::quantity::Quantity;
use serde::{Deserialize, Serialize};

/// A calibration without sliding as model files keep it beside a window.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RollingCalibration {
    ranges: [(f64, f64); FEATURES],
    laws: [Vec<f64>; 3],
    mean_square: [f64; 3],
    quantile: [f64; 3],
    points: Vec<RollingCase>,
}

/// One case of its evidence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct RollingCase {
    place: [f32; FEATURES - SIGNS.end + SIGNS.start],
    surplus: [f32; 3],
    squares: [f32; 3],
}

impl From<RollingCalibration> for Calibration {
    fn from(kept: RollingCalibration) -> Self {
        let RollingCalibration { ranges, laws, mean_square, quantile, points } = kept;
        let quantity = |(q, law): (usize, Vec<f64>)| Quantity {
            law,
            mean_square: mean_square[q],
            quantile: quantile[q],
            surplus: points.iter().map(|case| case.surplus[q]).collect(),
            squares: points.iter().map(|case| case.squares[q]).collect(),
        };
        Self {
            ranges: ranges.to_vec(),
            places: points.iter().flat_map(|case| case.place).collect(),
            quantities: laws.into_iter().enumerate().map(quantity).collect(),
        }
    }
}

impl TryFrom<&Calibration> for RollingCalibration {
    type Error = std::array::TryFromSliceError;

    /// Fails for the calibration of a model that knows sliding.
    fn try_from(calibration: &Calibration) -> Result<Self, Self::Error> {
        let Calibration { ranges, places, quantities } = calibration;
        let ranges = <[(f64, f64); FEATURES]>::try_from(ranges.as_slice())?;
        let each = |number: fn(&Quantity) -> f64| std::array::from_fn(|q| number(&quantities[q]));
        let case = |(i, place): (usize, &[f32])| -> Result<RollingCase, Self::Error> {
            Ok(RollingCase {
                place: place.try_into()?,
                surplus: std::array::from_fn(|q| quantities[q].surplus[i]),
                squares: std::array::from_fn(|q| quantities[q].squares[i]),
            })
        };
        Ok(Self {
            ranges,
            laws: std::array::from_fn(|q| quantities[q].law.clone()),
            mean_square: each(|quantity| quantity.mean_square),
            quantile: each(|quantity| quantity.quantile),
            points: places.chunks_exact(ranges.len() - SIGNS.len()).enumerate().map(case).collect::<Result<_, _>>()?,
        })
    }
}
