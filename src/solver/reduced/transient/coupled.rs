//! March with inputs that are given step by step: a contact as a component of a larger simulation.

use super::model::TrajectoryModel;
use super::steps::{ReducedMarch, StepState};
use crate::solver::full::transient::{
    Conditions, Effort, Ended, Frame, GREATEST_RATIO, Input, MOST_PARTS, Marching, Moment, ROUNDING, State, Step,
};
use crate::solver::full::{Problem, SolveError, Termination};
use crate::solver::reduced::ReducedError;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Maximum length of one advance, in steps of the model's own length.
pub const MOST_PARTS_AT_ONCE: f64 = 1e5;

/// Reduced model that is advanced from one time to the next.
///
/// Between two times the inputs vary linearly. The interval is divided evenly into steps that are no longer than the
/// model's own, and not much longer than the previous one. A failed step is divided, down to a 64th of the model's
/// own. So inputs given at every step of a march along sampled inputs reproduce that march.
pub struct CoupledMarch {
    march: ReducedMarch<'static>,
    frame: Frame,
    reference: Problem,
    longest: f64,
    at: Conditions,
    /// Equations one step before.
    former: Conditions,
    now: MarchState,
}

/// Complete state of a march, from which it can be continued.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MarchState {
    moment: Moment,
    /// Inputs one step before.
    former: Input,
    /// Length of the previous step; infinite after a steady start.
    before: f64,
    kept: StepState,
}

/// Error of an advance; the march keeps its previous state.
#[derive(Debug, thiserror::Error)]
pub enum CoupledError {
    /// The model is refused.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// The march cannot start or continue.
    #[error("the march {}", .0.describe())]
    Ended(Ended),
    /// The interval to the next time is not positive, or too long.
    #[error(
        "a step over T = {span} cannot be taken: it must be above zero and at most {most}, {MOST_PARTS_AT_ONCE} steps of \
         the model's own"
    )]
    Span {
        /// Requested interval.
        span: f64,
        /// Largest accepted interval.
        most: f64,
    },
    /// The state does not belong to this model.
    #[error("this is not a state of this model")]
    Foreign,
}

impl CoupledMarch {
    /// Starts from the steady state of the reference contact under the given inputs.
    ///
    /// # Errors
    /// [`CoupledError`] if the model is refused, or if it finds no steady state.
    pub fn begin(model: &Arc<TrajectoryModel>, reference: Problem, input: Input) -> Result<Self, CoupledError> {
        let (mut march, frame) = (ReducedMarch::on(model), model.frame);
        let at = conditions(frame, &reference, 0.0, input)?;
        let refused = |termination: Termination| Ended::StepRefused { time: 0.0, step: 0.0, termination };
        let effort = march.rest(&at, &()).map_err(|why| CoupledError::Ended(refused(why)))?;
        let now = MarchState {
            moment: march.moment(&at, 0.0, effort),
            former: input,
            before: f64::INFINITY,
            kept: StepState::default(),
        };
        let mut begun = Self { march, frame, reference, longest: model.domain.step, at, former: at, now };
        begun.march.keep(&mut begun.now.kept);
        Ok(begun)
    }

    /// Returns the scalars at the current time.
    pub fn moment(&self) -> &Moment {
        &self.now.moment
    }

    /// Returns the reference problem.
    pub fn reference(&self) -> &Problem {
        &self.reference
    }

    /// Returns the equations at the current time.
    pub fn conditions(&self) -> &Conditions {
        &self.at
    }

    /// Returns the fields of the current state.
    pub fn fields(&self) -> State {
        self.march.state(&self.at)
    }

    /// Returns the abscissae of the fields, in units of the frame's half-width.
    pub fn abscissae(&self) -> &[f64] {
        self.march.abscissae()
    }

    /// Returns the rigid-body separation H₀ with the kernel of (2.27) in the lengths of the frame, in the film scale
    /// of the reference contact.
    pub fn separation(&self) -> f64 {
        self.at.scales.film * self.march.h_0()
    }

    /// Returns the pressure coefficients p̃ of the current state.
    pub fn coefficients(&self) -> &[f64] {
        self.now.kept.history.nearer().0
    }

    /// Returns the complete state, from which the march can be continued.
    pub fn state(&self) -> &MarchState {
        &self.now
    }

    /// Continues from a state, for a reference contact.
    ///
    /// # Errors
    /// [`CoupledError`] if the model is refused, or if the state belongs to another model.
    pub fn resume(model: &Arc<TrajectoryModel>, reference: Problem, state: &MarchState) -> Result<Self, CoupledError> {
        let (march, frame) = (ReducedMarch::on(model), model.frame);
        let at = conditions(frame, &reference, state.moment.time, state.moment.input)?;
        let longest = model.domain.step;
        let mut resumed = Self { march, frame, reference, longest, at, former: at, now: state.clone() };
        resumed.restore(reference, state)?;
        Ok(resumed)
    }

    /// Sets the march to a state, for a reference contact.
    ///
    /// # Errors
    /// [`CoupledError`] if the state belongs to another model; nothing is changed then.
    pub fn restore(&mut self, reference: Problem, state: &MarchState) -> Result<(), CoupledError> {
        let Moment { time, input, .. } = state.moment;
        if !(self.march.knows(&state.kept) && state.is_sound()) {
            return Err(CoupledError::Foreign);
        }
        let at = conditions(self.frame, &reference, time, input)?;
        self.former = conditions(self.frame, &reference, time, state.former)?;
        (self.at, self.reference) = (at, reference);
        self.now.copy_from(state);
        self.march.restore(&self.now.kept, [self.at, self.former]);
        Ok(())
    }

    /// Advances by `span` of T to the inputs `to`. After the first call nothing is allocated.
    ///
    /// # Errors
    /// [`CoupledError`] if the interval is not accepted, the inputs lead to a contact outside the accepted ranges, or
    /// a step fails. The march then keeps its previous state.
    pub fn advance(&mut self, span: f64, to: Input) -> Result<&Moment, CoupledError> {
        let most = MOST_PARTS_AT_ONCE * self.longest;
        if !(span > 0.0 && span <= most) {
            return Err(CoupledError::Span { span, most });
        }
        match self.walk(span, to) {
            Ok(()) => Ok(&self.now.moment),
            Err(ended) => {
                self.march.restore(&self.now.kept, [self.at, self.former]);
                Err(ended)
            }
        }
    }

    fn walk(&mut self, span: f64, to: Input) -> Result<(), CoupledError> {
        let (begun, from) = (self.at.time, self.at.input);
        let end = begun + span;
        let (mut at, mut former, mut before) = (self.at, self.former, self.now.before);
        let (mut longest, mut effort) = (self.longest, Effort::default());
        // Lengths are computed from the span: late in a march differences of T have rounding errors.
        let mut gone = 0.0;
        loop {
            let left = span - gone;
            let parts = (left / longest.min(GREATEST_RATIO * before) - ROUNDING).ceil();
            let (last, length) = if parts > 1.0 { (false, left / parts) } else { (true, left) };
            let (time, share) = if last { (end, 1.0) } else { (begun + gone + length, (gone + length) / span) };
            let now = conditions(self.frame, &self.reference, time, from.towards(to, share))?;
            let step = Step::new(
                self.frame,
                now,
                [at.scales, former.scales],
                length,
                if before.is_finite() { before } else { length },
            );
            match self.march.step(&step, &()) {
                Ok(own) => {
                    effort = effort.and(own);
                    self.march.accept(&now);
                    (former, at, before, gone) = (at, now, length, gone + length);
                    longest = (2.0 * longest).min(self.longest);
                    if last {
                        break;
                    }
                }
                Err(termination) if length * MOST_PARTS <= self.longest * (1.0 + ROUNDING) => {
                    return Err(CoupledError::Ended(Ended::StepRefused { time, step: length, termination }));
                }
                Err(_) => longest = 0.5 * length,
            }
        }
        (self.at, self.former) = (at, former);
        (self.now.former, self.now.before) = (former.input, before);
        self.now.moment = self.march.moment(&at, span, effort);
        self.march.keep(&mut self.now.kept);
        Ok(())
    }
}

impl MarchState {
    /// Returns the time T.
    pub fn time(&self) -> f64 {
        self.moment.time
    }

    fn copy_from(&mut self, other: &Self) {
        (self.moment, self.former, self.before) = (other.moment, other.former, other.before);
        self.kept.copy_from(&other.kept);
    }

    /// Returns true if all numbers are valid.
    fn is_sound(&self) -> bool {
        let Moment { time, input, h_c, h_min, x_h_min, p_c, p_max, x_p_max, .. } = self.moment;
        let scalars = [time, h_c, h_min, x_h_min, p_c, p_max, x_p_max];
        let inputs = [input, self.former].into_iter().flat_map(|own| [own.radius, own.speed, own.load]);
        scalars.into_iter().chain(inputs).all(f64::is_finite) && self.before > 0.0
    }
}

fn conditions(frame: Frame, reference: &Problem, time: f64, input: Input) -> Result<Conditions, CoupledError> {
    let refused = |why: SolveError| CoupledError::Ended(Ended::ContactRefused { time, reason: why.to_string() });
    frame.conditions(reference, time, input).map_err(refused)
}
