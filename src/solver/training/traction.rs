//! Fit of the traction quadrature of a finished local model.

use super::error::TrainingError;
use super::observer::TrainingObserver;
use super::one_thread::{in_parallel, on_one_thread};
use super::plan::Within;
use super::spec::TrainingSpec;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::{Online, ReducedModel, ReducedOptions, TractionRule};
use fastrand::Rng;
use std::sync::Arc;

/// Number of reduced solutions for the fit, several per node.
const SOLUTIONS: usize = 1000;
/// Every second solution slides more slowly, down to this share of its SRR. The stress is then concentrated in the
/// middle of the contact.
const SLOWEST: f64 = 1e-3;

/// Fits the quadrature of a local model to reduced solutions of contacts that it covers; `model` contains this local
/// model only. `None` if the fit fails. For isothermal line contacts it is the whole grid's trapezoidal rule.
///
/// # Errors
/// [`TrainingError`] if the observer cancels.
pub(super) fn traction_rule(
    spec: &TrainingSpec,
    model: &Arc<ReducedModel>,
    served: Within,
    seed: u64,
    observer: &dyn TrainingObserver,
) -> Result<Option<TractionRule>, TrainingError> {
    if spec.contact().is_line() && !spec.warms_a_line() {
        return Ok(Some(TractionRule::whole()));
    }
    let mut rng = Rng::with_seed(seed ^ 0x7AC7_1041);
    let mut points: Vec<OperatingPoint> = served.random_points(SOLUTIONS, &mut rng);
    for point in points.iter_mut().step_by(2) {
        point.sliding.slide_to_roll_ratio *= SLOWEST.powf(rng.f64());
    }
    let contacts: Vec<(OperatingPoint, Lubricant)> =
        points.into_iter().map(|point| (point, spec.random_lubricant(&mut rng))).collect();
    let online = || Online::new(Arc::clone(model), ReducedOptions::default());
    let stresses = in_parallel(observer, "Traction", &contacts, online, |online, _, (point, lubricant)| {
        online.forget();
        let fields = online.solve(point, *lubricant).and_then(|solved| online.reconstruct(&solved));
        fields.ok().map(|fields| fields.mid_film_stress())
    })?;
    let stresses: Vec<Vec<f64>> = stresses.into_iter().flatten().collect();
    let model = Arc::clone(model);
    on_one_thread(observer, move || {
        let window = model.windows.first()?;
        TractionRule::fit(&window.grid, &window.sampled_rows, &stresses)
    })
}
