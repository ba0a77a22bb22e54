//! A march whose inputs are told as it goes, from one time to the next: a contact as a part of something larger.

use super::model::TrajectoryModel;
use super::steps::{Kept, ReducedMarch};
use crate::solver::full::transient::{
    Conditions, Effort, Ended, Frame, GREATEST_RATIO, Input, MOST_PARTS, Marching, Moment, ROUNDING, State, Step,
};
use crate::solver::full::{Problem, SolveError, Termination};
use crate::solver::reduced::ReducedError;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// More steps of the model's own length are not taken at once.
pub const MOST_PARTS_AT_ONCE: f64 = 1e5;

/// A reduced model that is led from one time to the next.
///
/// From one time to the next the inputs go on a straight line. The way there is divided evenly into steps that are no
/// longer than the model's own, nor much longer than the one before; one that cannot be taken is tried in parts, down to
/// a 64th of the model's own. So inputs that are told at every step of a march along sampled ones give that march.
pub struct CoupledMarch {
    march: ReducedMarch<'static>,
    frame: Frame,
    reference: Problem,
    longest: f64,
    at: Conditions,
    /// The equations one step before.
    former: Conditions,
    now: MarchState,
}

/// All that a march needs to go on from a time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct MarchState {
    moment: Moment,
    /// Inputs one step before.
    former: Input,
    /// Length of the former step; infinite where the contact has rested.
    before: f64,
    kept: Kept,
}

/// Why a march does not go on; it stays where it was.
#[derive(Debug, thiserror::Error)]
pub enum CoupledError {
    /// The model is refused.
    #[error(transparent)]
    Reduced(#[from] ReducedError),
    /// It begins or goes on no farther.
    #[error("the march {}", .0.describe())]
    Ended(Ended),
    /// The way to the next time makes no sense, or is too long.
    #[error(
        "a step over T = {span} cannot be taken: it must be above zero and at most {most}, {MOST_PARTS_AT_ONCE} steps of \
         the model's own"
    )]
    Span {
        /// What was asked for.
        span: f64,
        /// What is accepted.
        most: f64,
    },
    /// A state of something else.
    #[error("this is no state of this model")]
    Foreign,
}

impl CoupledMarch {
    /// Begins where the reference contact has rested for ever under some inputs.
    ///
    /// # Errors
    /// When the model is refused, or finds no stationary contact.
    pub fn begin(model: &Arc<TrajectoryModel>, reference: Problem, input: Input) -> Result<Self, CoupledError> {
        let (mut march, frame) = (ReducedMarch::on(model)?, model.frame);
        let at = conditions(frame, &reference, 0.0, input)?;
        let refused = |termination: Termination| Ended::StepRefused { time: 0.0, step: 0.0, termination };
        let effort = march.rest(&at, &()).map_err(|why| CoupledError::Ended(refused(why)))?;
        let now = MarchState {
            moment: march.moment(&at, 0.0, effort),
            former: input,
            before: f64::INFINITY,
            kept: Kept::default(),
        };
        let mut begun = Self { march, frame, reference, longest: model.domain.step, at, former: at, now };
        begun.march.keep(&mut begun.now.kept);
        Ok(begun)
    }

    /// The contact at the present time.
    pub fn moment(&self) -> &Moment {
        &self.now.moment
    }

    /// The reference problem.
    pub fn reference(&self) -> &Problem {
        &self.reference
    }

    /// The equations at the present time.
    pub fn conditions(&self) -> &Conditions {
        &self.at
    }

    /// Fields of the present state.
    pub fn fields(&self) -> State {
        self.march.state(&self.at)
    }

    /// Abscissae of the fields, in units of the frame's half width.
    pub fn abscissae(&self) -> &[f64] {
        &self.march.grid().x
    }

    /// Rigid-body separation H₀ with the kernel of (2.27) in the lengths of the frame, in the film scale of the reference
    /// contact.
    pub fn separation(&self) -> f64 {
        self.at.scales.film * self.march.h_0()
    }

    /// p̃ of the present state.
    pub fn coefficients(&self) -> &[f64] {
        self.now.kept.history.nearer().0
    }

    /// What it needs to go on from here.
    pub fn state(&self) -> &MarchState {
        &self.now
    }

    /// Goes on from a state under a reference contact.
    ///
    /// # Errors
    /// When the model is refused, or the state is one of another model.
    pub fn resume(model: &Arc<TrajectoryModel>, reference: Problem, state: &MarchState) -> Result<Self, CoupledError> {
        let (march, frame) = (ReducedMarch::on(model)?, model.frame);
        let at = conditions(frame, &reference, state.moment.time, state.moment.input)?;
        let longest = model.domain.step;
        let mut resumed = Self { march, frame, reference, longest, at, former: at, now: state.clone() };
        resumed.restore(reference, state)?;
        Ok(resumed)
    }

    /// Goes back, or on, to a state under a reference contact.
    ///
    /// # Errors
    /// When it is one of another model; nothing has changed then.
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

    /// Goes on over `span` of T, at whose end the inputs are `to`. Nothing is allocated once it has gone on before.
    ///
    /// # Errors
    /// When the way makes no sense, the inputs lead to a contact outside any sense, or a step cannot be taken; then it
    /// is where it was.
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
        // Lengths are parts of the span: differences of T, late in a march, are rounded.
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
    /// When it is.
    pub fn time(&self) -> f64 {
        self.moment.time
    }

    fn copy_from(&mut self, other: &Self) {
        (self.moment, self.former, self.before) = (other.moment, other.former, other.before);
        self.kept.copy_from(&other.kept);
    }

    /// Whether its numbers make sense.
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
