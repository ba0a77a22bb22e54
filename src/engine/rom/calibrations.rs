//! Calibrations of error bounds in a model file: four arrays for all calibrated local models.

use super::container::{Contents, Writer};
use crate::solver::reduced::{Calibration, CalibrationParts, Window};

const RANGES: &str = "calibration/ranges";
const LAWS: &str = "calibration/laws";
const PLACES: &str = "calibration/places";
const SURPLUS: &str = "calibration/surplus";

/// Adds the calibrations of local models. Returns `None` if they cannot be encoded, or if their sizes differ.
pub(super) fn write(writer: &mut Writer, windows: &[&Window]) -> Option<()> {
    let calibrated = windows.iter().filter_map(|window| window.calibration.as_ref());
    let parts: Vec<CalibrationParts> = calibrated.map(Calibration::parts).collect();
    let Some(first) = parts.first() else { return Some(()) };
    let (features, quantities) = (first.ranges.len(), first.laws.len());
    let terms = first.laws.first()?.len();
    let alike = |own: &CalibrationParts| (own.ranges.len(), own.laws.len(), own.surplus.len());
    if parts.iter().any(|own| alike(own) != alike(first) || own.laws.iter().any(|law| law.len() != terms)) {
        return None;
    }
    let ranges: Vec<f64> = parts.iter().flat_map(|own| &own.ranges).flat_map(|(low, high)| [*low, *high]).collect();
    let laws: Vec<f64> = parts.iter().flat_map(|own| own.laws.iter().flatten()).copied().collect();
    let places: Vec<f32> = parts.iter().flat_map(|own| &own.places).copied().collect();
    let of_quantity = |q: usize| parts.iter().filter_map(move |own| own.surplus.get(q)).flatten().copied();
    let surplus: Vec<f32> = (0..quantities).flat_map(of_quantity).collect();
    let evidence = surplus.len() / quantities.max(1);
    writer.table(RANGES, &[parts.len(), features, 2], &ranges)?;
    writer.table(LAWS, &[parts.len(), quantities, terms], &laws)?;
    writer.table(PLACES, &[evidence, places.len() / evidence.max(1)], &places)?;
    writer.table(SURPLUS, &[quantities, evidence], &surplus)
}

/// Reads the calibrations of local models, given the number of measured errors of each; 0 means no calibration. Returns
/// `None` if the arrays are inconsistent or invalid.
pub(super) fn read(contents: &Contents<'_>, evidence: &[usize]) -> Option<Vec<Option<Calibration>>> {
    let all = evidence.iter().try_fold(0usize, |sum, own| sum.checked_add(*own))?;
    if all == 0 {
        return Some(vec![None; evidence.len()]);
    }
    let shape = |name| contents.shape(name);
    let (&[windows, features, 2], &[_, quantities, terms], &[_, coordinates]) =
        (shape(RANGES)?, shape(LAWS)?, shape(PLACES)?)
    else {
        return None;
    };
    let calibrated = evidence.iter().filter(|own| **own > 0).count();
    let fits = windows == calibrated
        && shape(LAWS)? == [windows, quantities, terms]
        && shape(PLACES)? == [all, coordinates]
        && shape(SURPLUS)? == [quantities, all]
        && [features, quantities, terms, coordinates].iter().all(|length| *length > 0);
    let ranges: Vec<f64> = contents.list(RANGES).filter(|_| fits)?;
    let (laws, places): (Vec<f64>, Vec<f32>) = (contents.list(LAWS)?, contents.list(PLACES)?);
    let surplus: Vec<f32> = contents.list(SURPLUS)?;
    let mut ranges = ranges.chunks_exact(2 * features);
    let mut laws = laws.chunks_exact(quantities * terms);
    let mut before = 0;
    let calibration = |own: &usize| {
        if *own == 0 {
            return Some(None);
        }
        let pairs = ranges.next()?.chunks_exact(2);
        let of_quantity = |all: &[f32]| Some(all.get(before..)?.get(..*own)?.to_vec());
        let parts = CalibrationParts {
            ranges: pairs
                .map(|pair| <[f64; 2]>::try_from(pair).map(|[low, high]| (low, high)))
                .collect::<Result<_, _>>()
                .ok()?,
            places: places.get(before * coordinates..)?.get(..own * coordinates)?.to_vec(),
            laws: laws.next()?.chunks_exact(terms).map(<[f64]>::to_vec).collect(),
            surplus: surplus.chunks_exact(all).map(of_quantity).collect::<Option<_>>()?,
        };
        before += own;
        Calibration::from_parts(parts).map(Some)
    };
    evidence.iter().map(calibration).collect()
}
