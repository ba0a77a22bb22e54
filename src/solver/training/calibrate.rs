//! What a finished window finds out about its own errors.
//!
//! At random points (3.17) of the window's own range the reduced solution is carried on by three full Newton steps,
//! under shear-thinning and of many oils until they converge; what they change is its error. That is evidence for [`Calibration`], and
//! nothing else: no basis sees these points.

use super::cell::Cell;
use super::error::TrainingError;
use super::indicator::Corrector;
use super::observer::TrainingObserver;
use super::one_thread::{in_parallel, on_one_thread};
use super::spec::TrainingSpec;
use crate::solver::reduced::{
    Calibration, Evidence, FeatureSet, Features, Online, ReducedModel, ReducedOptions, Window,
};
use fastrand::Rng;
use std::sync::Arc;

/// Measures the errors of window `k`, `model` being the model of it alone. Points where the reduced model fails are no
/// evidence: there nothing is shown.
///
/// # Errors
/// When the observer cancels.
pub(super) fn measured(
    spec: &TrainingSpec,
    model: &Arc<ReducedModel>,
    (k, ends, cell): (usize, (bool, bool), Option<Cell>),
    observer: &dyn TrainingObserver,
) -> Result<Vec<Evidence>, TrainingError> {
    let Some(window) = model.windows.first() else { return Ok(Vec::new()) };
    let seed = spec.seed ^ 0x9E37_79B9_7F4A_7C15_u64.wrapping_mul(k as u64 + 1);
    let m = if cell.is_some() { (0.0, f64::INFINITY) } else { served(ends, window) };
    let served = spec.within(m).served_by(window, cell);
    let mut rng = Rng::with_seed(seed);
    let points = served.random_points(spec.evidence, &mut rng);
    let contacts: Vec<_> = points.into_iter().map(|point| (point, spec.random_lubricant(&mut rng))).collect();
    let set = FeatureSet::of(&model.domain);
    let stage = format!("Measuring errors, M {}…{}", window.m.0, window.m.1);
    let solvers = || (Online::new(Arc::clone(model), ReducedOptions::default()), Corrector::of(window));
    let measured = in_parallel(observer, &stage, &contacts, solvers, |(online, corrector), _, (point, lubricant)| {
        online.forget();
        let solved = online.solve(point, *lubricant).ok()?;
        // Of a film too hot for any lubricant nothing is promised.
        if solved.is_too_hot() {
            return None;
        }
        let errors = corrector.errors(online, &solved)?;
        Some(Evidence { features: Features::of(&solved, point, &set), errors })
    })?;
    Ok(measured.into_iter().flatten().collect())
}

/// Tells the windows of a model their errors by the evidence of each: windows around anchors learn together.
///
/// # Errors
/// When the observer cancels.
pub(super) fn calibrate(
    windows: &mut [Window],
    evidence: Vec<Vec<Evidence>>,
    observer: &dyn TrainingObserver,
) -> Result<(), TrainingError> {
    let together = windows.iter().all(|window| window.anchor.is_some());
    let calibrations = on_one_thread(observer, move || {
        let evidence: Vec<&[Evidence]> = evidence.iter().map(Vec::as_slice).collect();
        let alone = |own: &[Evidence]| Calibration::fit(own);
        if together { Calibration::fit_together(&evidence) } else { evidence.into_iter().map(alone).collect() }
    })?;
    windows.iter_mut().zip(calibrations).for_each(|(window, calibration)| window.calibration = calibration);
    Ok(())
}

/// The range of M in which a window serves: the first and the last one also serve what lies beyond.
fn served((first, last): (bool, bool), window: &Window) -> (f64, f64) {
    let (low, high) = window.m;
    (if first { 0.0 } else { low }, if last { f64::INFINITY } else { high })
}
