//! Checks of a transient simulation before it starts.

use super::frame::Frame;
use super::march::{MOST_STEPS, Transient, TransientError};
use super::pace::{ROUNDING, TimeStep};
use super::signal::Signal;
use super::surface::{Scheme, SurfaceError};
use super::unsupported::Unsupported;
use crate::solver::full::Problem;
use crate::solver::full::response::{is_uniform, widest_spacing};
use crate::solver::limits::Number;

/// Number of times at which the speed of a point contact is checked.
const WATCHED: usize = 10_000;
/// Range of the tolerances, relative to the central film thickness H_c, of controlled steps. Below it, rounding and
/// Newton's tolerance dominate.
const FINEST_CONTROL: f64 = 1e-5;
const COARSEST_CONTROL: f64 = 0.3;

impl Transient {
    /// Checks inputs, duration and time step.
    ///
    /// # Errors
    /// [`TransientError`] that states what is wrong and what is accepted.
    pub fn check(&self) -> Result<(), TransientError> {
        let refuse = |quantity: &str, value: f64, accepted: &str| {
            let value = Number(value);
            Err(TransientError::Time(format!("the {quantity} is {value}, but must be {accepted}")))
        };
        let positive = |quantity, value: f64| {
            let fine = value.is_finite() && value > 0.0;
            if fine { Ok(()) } else { refuse(quantity, value, "a finite number above zero") }
        };
        positive("duration", self.duration)?;
        match self.time_step {
            TimeStep::Fixed(_) => {}
            TimeStep::Adaptive { tolerance, .. } => positive("tolerance of the time step", tolerance)?,
            TimeStep::Controlled(tolerance) if (FINEST_CONTROL..=COARSEST_CONTROL).contains(&tolerance) => {}
            TimeStep::Controlled(tolerance) => {
                let accepted = format!("between {FINEST_CONTROL:e} and {COARSEST_CONTROL}");
                return refuse("tolerance of controlled time steps", tolerance, &accepted);
            }
        }
        let longest = self.time_step.longest(self.duration);
        positive("time step", longest)?;
        if longest > self.duration || self.duration / longest > MOST_STEPS {
            let accepted = format!("between {:e} and the duration {}", self.duration / MOST_STEPS, self.duration);
            return refuse("time step", longest, &accepted);
        }
        self.inputs.check(self.duration)?;
        if let Some(separation) = &self.separation {
            separation.check("separation", self.duration)?;
            if self.frame != Frame::Fixed {
                return Err(SurfaceError("a prescribed separation needs the fixed frame".to_owned()).into());
            }
        }
        if self.point.kind.is_point() {
            self.check_point()?;
        }
        self.check_surfaces()
    }

    /// Checks that frame, inputs and steps suit the features and the scheme.
    fn check_surfaces(&self) -> Result<(), TransientError> {
        let refuse = |sentence: &str| Err(SurfaceError(sentence.to_owned()).into());
        let steady = self.inputs.speed == Signal::Constant && self.inputs.radius == Signal::Constant;
        if !(self.surfaces.is_empty() || self.frame == Frame::Fixed && steady) {
            return refuse("surfaces need the fixed frame, and a speed and a radius that are constant");
        }
        if self.scheme == Scheme::Characteristic {
            let unequal = self.lubricant.roughness.is_some_and(|roughness| roughness.shear_flow != 0.0);
            if unequal && self.lubricant.is_rough() {
                return refuse(
                    "the scheme Characteristic needs the same roughness of both surfaces, without shear flow",
                );
            }
            let equal = matches!(self.time_step, TimeStep::Fixed(_));
            if !(self.frame == Frame::Fixed && steady && equal) {
                return refuse(
                    "the scheme Characteristic needs the fixed frame, a constant speed and radius, and fixed steps",
                );
            }
        }
        Ok(())
    }

    /// Checks that frame, scheme and inputs suit a point contact.
    fn check_point(&self) -> Result<(), TransientError> {
        let steps = (0..=WATCHED).map(|k| self.duration * k as f64 / WATCHED as f64);
        let reverses = steps.map(|time| self.inputs.speed.at(time)).any(|speed| speed < 0.0);
        if self.frame != Frame::Fixed || self.scheme == Scheme::Characteristic {
            return Err(Unsupported::PointFrame.into());
        }
        if self.inputs.radius != Signal::Constant || reverses {
            return Err(Unsupported::PointInputs.into());
        }
        Ok(())
    }

    /// Checks the features and the scheme on a grid with the abscissae `x`.
    ///
    /// # Errors
    /// [`TransientError`] if the grid or the steps do not resolve a feature, or do not suit the scheme.
    pub fn check_on(&self, x: &[f64]) -> Result<(), TransientError> {
        let (spacing, step) = (widest_spacing(x), self.time_step.longest(self.duration));
        self.surfaces.iter().try_for_each(|surface| surface.check(spacing, step))?;
        if self.scheme == Scheme::Characteristic && !(is_uniform(x) && (step / spacing - 1.0).abs() < ROUNDING) {
            let sentence = format!(
                "the scheme Characteristic needs a uniform grid and time steps equal to its spacing; the spacing is \
                 {spacing}, the step {step}"
            );
            return Err(SurfaceError(sentence).into());
        }
        Ok(())
    }

    /// Returns the reference problem.
    ///
    /// # Errors
    /// [`TransientError`] if the contact, the inputs, the times or the lubricant are refused.
    pub fn problem(&self) -> Result<Problem, TransientError> {
        self.check()?;
        Unsupported::check_lubricant(&self.lubricant)?;
        Ok(Problem::new(&self.point, self.lubricant)?)
    }
}
