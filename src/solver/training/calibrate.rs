//! Measurement of the errors of a finished local model.
//!
//! At random points (3.17) of its own range, the reduced solution is continued by three full Newton steps. For
//! shear-thinning and lubricant-parameterised models the full solver iterates until convergence. The resulting change
//! is the error. It serves only as evidence for the [`Calibration`]: no basis contains these points.
//!
//! Contacts with rough surfaces slide here, with a limiting stress, so that errors of friction can be measured. Their
//! film does not depend on either.

use super::cell::Cell;
use super::error::TrainingError;
use super::indicator::Corrector;
use super::observer::TrainingObserver;
use super::one_thread::{in_parallel, on_one_thread};
use super::spec::TrainingSpec;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{LimitingStress, Lubricant};
use crate::solver::reduced::{
    Calibration, Evidence, FeatureSet, Features, Online, ReducedModel, ReducedOptions, Window,
};
use fastrand::Rng;
use std::sync::Arc;

/// Smallest and largest SRR of contacts with rough surfaces, and their limiting stress.
const SLIDING: (f64, f64) = (1e-3, 2.0);
const LIMIT: LimitingStress = LimitingStress { ambient: 0.0, slope: 0.08, eyring: Some(5e6) };

/// Measures the errors of local model `k`; `model` contains this one only. Points at which the reduced model fails
/// are omitted, since no error is shown for them.
///
/// # Errors
/// [`TrainingError`] if the observer cancels.
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
    let mut contacts: Vec<_> = points.into_iter().map(|point| (point, spec.random_lubricant(&mut rng))).collect();
    if model.domain.is_rough() {
        contacts.iter_mut().for_each(|contact| slide(contact, &mut rng));
    }
    let set = FeatureSet::of(&model.domain);
    let stage = format!("Measuring errors, M {}…{}", window.m.0, window.m.1);
    let solvers = || (Online::new(Arc::clone(model), ReducedOptions::default()), Corrector::of(window));
    let measured = in_parallel(observer, &stage, &contacts, solvers, |(online, corrector), _, (point, lubricant)| {
        online.forget();
        let solved = online.solve(point, *lubricant).ok()?;
        // No error estimate for a film too hot for any lubricant.
        if solved.is_too_hot() {
            return None;
        }
        let errors = corrector.errors(online, &solved)?;
        Some(Evidence { features: Features::of(&solved, point, &set), errors })
    })?;
    Ok(measured.into_iter().flatten().collect())
}

/// Gives a contact with rough surfaces a random SRR, and its lubricant the limiting stress.
fn slide((point, lubricant): &mut (OperatingPoint, Lubricant), rng: &mut Rng) {
    let (least, most) = SLIDING;
    point.sliding.slide_to_roll_ratio = least * (most / least).powf(rng.f64());
    lubricant.limiting_stress = Some(LIMIT);
}

/// Calibrates the local models with the evidence of each; those around anchors together.
///
/// # Errors
/// [`TrainingError`] if the observer cancels.
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

/// Returns the interval of M in which a local model is used. The first and the last one are also used beyond their
/// ends.
fn served((first, last): (bool, bool), window: &Window) -> (f64, f64) {
    let (low, high) = window.m;
    (if first { 0.0 } else { low }, if last { f64::INFINITY } else { high })
}
