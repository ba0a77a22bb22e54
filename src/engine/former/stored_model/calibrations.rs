//! What windows know about their errors, on its way to or from a file: small whole numbers, packed together.

use super::window::StoredWindow;
use crate::engine::former::packed::Small;
use crate::solver::reduced::{Calibration, CalibrationParts};
use serde::{Deserialize, Serialize};

/// So many packed numbers take a byte at most.
const MOST_PACKED: usize = 8;

#[derive(Serialize, Deserialize)]
pub(super) struct Laws {
    ranges: Vec<(f64, f64)>,
    laws: Vec<(Vec<f64>, f64, f64)>,
}

fn value(steps: i16, step: f64) -> f32 {
    if steps == i16::MIN { f32::NAN } else { (f64::from(steps) * step) as f32 }
}

fn from_steps(laws: Laws, evidence: usize, numbers: &mut std::vec::IntoIter<i16>) -> Option<Calibration> {
    let Laws { ranges, laws } = laws;
    let mut next = |count: usize, step: f64| {
        let some = count <= numbers.len();
        some.then(|| numbers.by_ref().take(count).map(|steps| value(steps, step)).collect::<Vec<f32>>())
    };
    let places = next(evidence.checked_mul(ranges.len().checked_sub(2)?)?, 1.0 / 256.0)?;
    let surplus = laws.iter().map(|_| next(evidence, 1.0 / 64.0)).collect::<Option<_>>()?;
    let law = |(law, square, quantile): (Vec<f64>, f64, f64)| law.into_iter().chain([square, quantile]).collect();
    Calibration::from_parts(CalibrationParts { ranges, places, laws: laws.into_iter().map(law).collect(), surplus })
}

/// The calibrations of all windows.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredCalibrations {
    /// Of every window its laws and how much evidence it has; none where nothing was measured.
    windows: Vec<Option<(Laws, usize)>>,
    /// How many numbers all of them have.
    count: usize,
    numbers: Small,
}

/// Gives the windows of a model their calibrations; `None` where these do not fit.
pub(super) fn give_calibrations(windows: &mut [StoredWindow], stored: StoredCalibrations) -> Option<()> {
    let StoredCalibrations { windows: laws, count, numbers } = stored;
    let numbers = numbers.into_numbers(count, MOST_PACKED)?;
    if laws.len() != windows.len() || windows.iter().any(|window| window.calibration.is_some()) {
        return None;
    }
    let mut numbers = numbers.into_iter();
    for (window, laws) in windows.iter_mut().zip(laws) {
        if let Some((laws, evidence)) = laws {
            window.calibration = Some(from_steps(laws, evidence, &mut numbers)?);
        }
    }
    (numbers.len() == 0).then_some(())
}
