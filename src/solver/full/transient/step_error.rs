//! Time-step error of a march, which is one solution of a transient contact by time steps. The error is estimated by a
//! second march with other steps, and controlled by repeated marches.

use super::march::{Keep, MarchProgress, Marching, Transient, TransientError, TransientObserver, march_once};
use super::pace::{Rule, TimeStep};
use super::signal::Input;
use super::surface::Scheme;
use super::trajectory::{Ended, Quantity, Trajectory};
use crate::solver::observer::Observer;
use crate::solver::warning::Warning;

/// Inputs whose deviation from a straight line over two steps exceeds this share of their range are not resolved by
/// steps twice as long.
const CURVED: f64 = 0.05;
/// Inputs whose deviation exceeds this share are not resolved by the steps themselves.
const TOO_CURVED: f64 = 0.2;
/// Error of a march, relative to its difference from one with steps twice as long. Second order would give a third, but
/// inputs with kinks give more.
const OF_DOUBLED: f64 = 0.5;
/// Error of a march of second order, relative to its difference from one with steps half as long.
const OF_HALVED: f64 = 4.0 / 3.0;
/// Factor by which [`controlled`] shortens the steps from one march to the next.
const SHORTER: f64 = 2.0;
/// Maximum number of marches that [`controlled`] compares.
const MOST_MARCHES: usize = 8;

impl Trajectory {
    /// Estimates the largest relative time-step error of the central film thickness H_c and stores it in `step_error`.
    /// Another march of the same model has steps twice as long if these still resolve the inputs, otherwise half as
    /// long. It overwrites the state of the model. An existing estimate is kept.
    pub fn estimate_step_error(&mut self, model: &mut dyn Marching, observer: &dyn Observer) {
        // Along the characteristics, the spacing sets the time step.
        let set_by_grid = self.transient.scheme == Scheme::Characteristic;
        if set_by_grid || self.step_error.is_some() || self.moments.len() < 2 || observer.cancelled() {
            return;
        }
        if self.resolves_inputs_to(CURVED) {
            self.step_error = self.marched_again(0.5, model, observer).map(|greatest| OF_DOUBLED * greatest);
        }
        if self.step_error.is_none() {
            self.step_error = self.marched_again(2.0, model, observer).map(|greatest| OF_HALVED * greatest);
        }
    }

    /// Returns a warning if the estimated time-step error is too large.
    pub fn step_warning(&self) -> Option<Warning> {
        let tolerance = match self.transient.time_step {
            TimeStep::Controlled(tolerance) => Some(tolerance),
            TimeStep::Fixed(_) | TimeStep::Adaptive { .. } => None,
        };
        Warning::of_time_step(self.step_error?, tolerance)
    }

    /// Returns the largest relative difference of H_c from a march whose steps are shorter by `factor`. `None` if that
    /// march does not reach the end of this one.
    fn marched_again(&self, factor: f64, model: &mut dyn Marching, observer: &dyn Observer) -> Option<f64> {
        let mut transient = Transient { keep: Keep::Scalars, ..self.transient.clone() };
        transient.duration = self.reached();
        if let (Rule::Fixed(step), true) = (self.rule, factor < 1.0) {
            // Both marches then have common times.
            let steps = (transient.duration / step).round();
            transient.duration = (2.0 * (0.5 * steps).floor() * step).min(transient.duration);
        }
        let stage = "error of the time step".to_owned();
        let progress = MarchProgress { observer, stage, duration: transient.duration };
        let other = march_once(model, &transient, self.rule.shorter(factor), &progress).ok().filter(Self::finished)?;
        let (coarse, fine) = if factor < 1.0 { (&other, self) } else { (self, &other) };
        Some(coarse.difference(fine, Quantity::CentralFilm, (0.0, transient.duration))?.0)
    }

    /// Returns true if every input deviates from a straight line over each pair of steps by at most `share` of its
    /// range.
    fn resolves_inputs_to(&self, share: f64) -> bool {
        let Transient { inputs, separation, .. } = &self.transient;
        let values = |time: f64| {
            let Input { radius, speed, load } = inputs.at(time);
            [radius, speed, load, separation.as_ref().map_or(1.0, |separation| separation.at(time))]
        };
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        let mut deviation = [0.0f64; 4];
        for pair in self.moments.windows(3).step_by(2) {
            let [from, _, to] = pair else { continue };
            let ends = [values(from.time), values(to.time)];
            for part in [0.25, 0.5, 0.75] {
                let between = values(from.time + part * (to.time - from.time));
                for k in 0..between.len() {
                    low[k] = low[k].min(between[k]).min(ends[0][k]);
                    high[k] = high[k].max(between[k]).max(ends[0][k]);
                    deviation[k] = deviation[k].max((between[k] - (1.0 - part) * ends[0][k] - part * ends[1][k]).abs());
                }
            }
        }
        (0..deviation.len()).all(|k| deviation[k] <= share * (high[k] - low[k]).max(0.0) + f64::EPSILON)
    }
}

/// Repeats an adaptive march with shorter steps until H_c differs from the previous march by at most `tolerance`,
/// relative. The final march reports its moments to the observer.
pub(super) fn controlled(
    model: &mut dyn Marching,
    transient: &Transient,
    tolerance: f64,
    observer: &dyn TransientObserver,
) -> Result<Trajectory, TransientError> {
    transient.check()?;
    let mut rule = transient.time_step.rule(transient.duration);
    let mut previous: Option<Trajectory> = None;
    let mut step_error = None;
    // The moments of these marches are not reported, only their progress.
    let stage = "lengths of the time steps".to_owned();
    let progress = MarchProgress { observer, stage, duration: transient.duration };
    for count in 1..=MOST_MARCHES {
        let scalars_only = Transient { keep: Keep::Scalars, ..transient.clone() };
        let marched = march_once(model, &scalars_only, rule, &progress)?;
        let both = previous.as_ref().filter(|previous| previous.finished() && marched.finished());
        let difference = |previous: &Trajectory| {
            Some(previous.difference(&marched, Quantity::CentralFilm, (0.0, transient.duration))?.0)
        };
        step_error = both.and_then(difference);
        // Marches may agree with each other only because both miss a part of the inputs.
        let met = step_error.is_some_and(|error| error <= tolerance) && marched.resolves_inputs_to(TOO_CURVED);
        if met || count == MOST_MARCHES || matches!(marched.ended, Ended::Cancelled { .. }) {
            break;
        }
        previous = Some(marched);
        rule = rule.shorter(SHORTER);
    }
    let trajectory = march_once(model, transient, rule, observer)?;
    Ok(Trajectory { step_error, ..trajectory })
}
