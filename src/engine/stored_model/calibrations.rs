//! What windows know about their errors, on its way to or from a file: small whole numbers, packed together.

use super::window::StoredWindow;
use crate::engine::packed::Small;
use crate::solver::reduced::{Calibration, Laws, ReducedModel};
use serde::{Deserialize, Serialize};

/// So many packed numbers take a byte at most.
const MOST_PACKED: usize = 8;

/// The calibrations of all windows.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredCalibrations {
    /// Of every window its laws and how much evidence it has; none where nothing was measured.
    windows: Vec<Option<(Laws, usize)>>,
    /// How many numbers all of them have.
    count: usize,
    numbers: Small,
}

impl StoredCalibrations {
    /// Those of a model; none where there are none, or not in steps: its windows keep them as they are.
    pub fn of(model: &ReducedModel) -> Option<Self> {
        let mut all = Vec::new();
        let mut windows = Vec::with_capacity(model.windows.len());
        for window in &model.windows {
            let Some(calibration) = &window.calibration else {
                windows.push(None);
                continue;
            };
            let (laws, numbers) = calibration.in_steps()?;
            windows.push(Some((laws, calibration.evidence())));
            all.extend(numbers);
        }
        let count = all.len();
        let known = windows.iter().any(Option::is_some);
        known.then(|| Self { windows, count, numbers: Small::of(all, MOST_PACKED) })
    }
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
            window.calibration = Some(Calibration::from_steps(laws, evidence, &mut numbers)?);
        }
    }
    (numbers.len() == 0).then_some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::embedded;

    #[test]
    fn numbers_that_are_fewer_or_more_than_they_say_are_refused() {
        let model = embedded("line").unwrap();
        let windows = || -> Vec<StoredWindow> {
            let own = model.windows.iter().enumerate();
            own.map(|(k, window)| StoredWindow::of(&model, k, window)).collect()
        };
        let given = |change: &dyn Fn(&mut StoredCalibrations)| {
            let (mut windows, mut stored) = (windows(), StoredCalibrations::of(&model).unwrap());
            change(&mut stored);
            give_calibrations(&mut windows, stored).map(|()| windows)
        };
        let whole = given(&|_| {}).unwrap();
        assert!(whole.iter().zip(&model.windows).all(|(stored, window)| stored.calibration == window.calibration));
        for (what, change) in [
            ("fewer", &(|stored: &mut StoredCalibrations| stored.count -= 1) as &dyn Fn(&mut StoredCalibrations)),
            ("more", &|stored| stored.count += 1),
            ("very many", &|stored| stored.count = usize::MAX),
            ("a window more", &|stored| stored.windows.push(None)),
            ("less evidence", &|stored| stored.windows[0].as_mut().unwrap().1 -= 1),
            ("cut", &|stored| {
                if let Small::Packed(packed) = &mut stored.numbers {
                    packed.truncate(packed.len() / 2);
                }
            }),
        ] {
            assert!(given(change).is_none(), "{what}");
        }
    }
}
