//! Result of a march: a value with its inputs, its frame and the reason why it ended.

use super::frame::{Conditions, Scales, point_at};
use super::march::Transient;
use super::pace::Rule;
use super::signal::Input;
use crate::solver::discrete::space::Grid;
use crate::solver::full::{Mesh, Problem, Scalars, Termination, scalars_of};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Work of one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Effort {
    /// Number of Newton steps.
    pub newton_iterations: usize,
    /// Number of Krylov iterations of a full model.
    pub linear_iterations: usize,
}

impl Effort {
    /// Returns the sum of two efforts.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            newton_iterations: self.newton_iterations + other.newton_iterations,
            linear_iterations: self.linear_iterations + other.linear_iterations,
        }
    }
}

/// Contact at one time: scalars in the scales of the reference contact, (2.22).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Dimensionless time T.
    pub time: f64,
    /// Length of the step that led here; 0 at the start.
    pub step: f64,
    /// Inputs R̄, ū, w̄.
    pub input: Input,
    /// Scales of the frame, used by its fields.
    pub scales: Scales,
    /// Central film thickness H_c, at X = 0.
    pub h_c: f64,
    /// Minimum nodal film thickness H_min in the contact.
    pub h_min: f64,
    /// Position of H_min.
    pub x_h_min: f64,
    /// Pressure P_c at X = 0.
    pub p_c: f64,
    /// Largest nodal pressure P_max.
    pub p_max: f64,
    /// Position of P_max.
    pub x_p_max: f64,
    /// Share of the load that asperities carry; 0 for smooth surfaces.
    pub asperity_load_share: f64,
    /// Work of the step.
    pub effort: Effort,
}

/// Fields at one time in the frame's own scales. Node arrays; the first entry lies outside the inlet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Dimensionless time T.
    pub time: f64,
    /// Scales of the frame.
    pub scales: Scales,
    /// Pressure P.
    pub pressure: Vec<f64>,
    /// Film thickness H.
    pub film: Vec<f64>,
    /// Cavitation multiplier λ, zero in the full film; empty for cavitation by the penalty and for reduced models.
    pub multiplier: Vec<f64>,
    /// Fill fraction θ of the gap; empty if cavitation does not conserve mass.
    pub fraction: Vec<f64>,
    /// Rigid-body separation H₀ with the kernel of (2.27).
    pub h_0: f64,
}

/// Reason why a march ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// It reached the end of its duration.
    Finished,
    /// The observer stopped it.
    Cancelled {
        /// Last time reached.
        time: f64,
    },
    /// A step failed.
    StepRefused {
        /// Time at the end of the step.
        time: f64,
        /// Length of the step.
        step: f64,
        /// Reason why its Newton iteration stopped.
        termination: Termination,
    },
    /// The inputs led to a contact outside the accepted ranges.
    ContactRefused {
        /// Time of that contact.
        time: f64,
        /// What is wrong with the contact, as a sentence.
        reason: String,
    },
}

/// Quantity of a [`Moment`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Central film thickness H_c.
    CentralFilm,
    /// Minimum film thickness H_min.
    MinimumFilm,
    /// Central pressure P_c.
    CentralPressure,
    /// Maximum pressure P_max.
    MaximumPressure,
    /// Load w̄ relative to the reference contact.
    Load,
    /// Share of the load that asperities carry.
    AsperityLoadShare,
}

/// Result of a transient simulation.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trajectory {
    /// Definition of the simulation.
    pub transient: Transient,
    /// Rule of its step lengths.
    pub(crate) rule: Rule,
    /// Reference problem.
    pub problem: Problem,
    /// Grid of the fields.
    pub mesh: Mesh,
    /// Abscissae X of the fields, in units of the frame's half-width.
    pub x: Vec<f64>,
    /// Scalars at all times from the steady start on; empty if the start failed.
    pub moments: Vec<Moment>,
    /// Kept fields.
    pub states: Vec<State>,
    /// Number of rejected steps.
    pub rejected_steps: usize,
    /// Largest relative time-step error of H_c, if estimated.
    pub step_error: Option<f64>,
    /// Reason why the march ended.
    pub ended: Ended,
}

impl Ended {
    /// Returns one sentence for display.
    pub fn describe(&self) -> String {
        match self {
            Self::Finished => "finished".to_owned(),
            Self::Cancelled { time } => format!("was cancelled at T = {time:.4}"),
            Self::StepRefused { time, step, termination } => {
                let iteration = match termination {
                    Termination::IterationLimit => "did not converge",
                    Termination::Effort => "exceeded the effort of the march",
                    _ => "diverged",
                };
                if *step == 0.0 {
                    return format!(
                        "could not begin: the iteration for the steady contact at T = {time:.4} {iteration}"
                    );
                }
                format!(
                    "could not take the step of {step:.1e} to T = {time:.4}, whose iteration {iteration}; previous steps \
                     are kept"
                )
            }
            Self::ContactRefused { time, reason } => {
                format!("stopped at T = {time:.4}: {reason}; previous steps are kept")
            }
        }
    }
}

impl Moment {
    /// Computes the scalars from fields in the frame's scales.
    pub fn of_fields(
        at: &Conditions,
        step: f64,
        grid: &impl Grid,
        pressure: &[f64],
        film: &[f64],
        effort: Effort,
    ) -> Self {
        Self::of_scalars(at, step, &scalars_of(grid, &at.problem, pressure, film, 0.0), effort)
    }

    /// Converts scalars from the frame's scales to those of the reference contact.
    pub fn of_scalars(at: &Conditions, step: f64, own: &Scalars, effort: Effort) -> Self {
        let Scales { half_width, pressure, film } = at.scales;
        Self {
            time: at.time,
            step,
            input: at.input,
            scales: at.scales,
            h_c: film * own.h_c,
            h_min: film * own.h_min,
            x_h_min: half_width * own.x_h_min,
            p_c: pressure * own.p_c,
            p_max: pressure * own.p_max,
            x_p_max: half_width * own.x_p_max,
            asperity_load_share: 0.0,
            effort,
        }
    }

    /// Returns one of the quantities.
    pub fn value(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::CentralFilm => self.h_c,
            Quantity::MinimumFilm => self.h_min,
            Quantity::CentralPressure => self.p_c,
            Quantity::MaximumPressure => self.p_max,
            Quantity::Load => self.input.load,
            Quantity::AsperityLoadShare => self.asperity_load_share,
        }
    }
}

impl Trajectory {
    /// Returns true if the march reached its end.
    pub fn finished(&self) -> bool {
        self.ended == Ended::Finished
    }

    /// Returns the warning of a march that did not reach its end.
    pub fn stopped(&self) -> Option<Warning> {
        (!self.finished()).then(|| Warning::MarchStopped { reached: self.reached(), ended: self.ended.clone() })
    }

    /// Returns the warning about its largest Hertzian pressure.
    fn hertz_warning(&self) -> Option<Warning> {
        let inputs = self.moments.iter().map(|moment| moment.input).chain([self.transient.inputs.at(0.0)]);
        let pressures = inputs.map(|input| point_at(&self.problem.point, input).hertz().pressure_pa);
        Warning::of_hertz_pressure(pressures.fold(0.0, f64::max))
    }

    /// Returns all warnings: early stop, time-step error, Hertzian pressure.
    pub fn warnings(&self) -> impl Iterator<Item = Warning> {
        self.stopped().into_iter().chain(self.step_warning()).chain(self.hertz_warning())
    }

    /// Returns the last T reached; 0 if the start failed.
    pub fn reached(&self) -> f64 {
        self.moments.last().map_or(0.0, |moment| moment.time)
    }

    /// Returns a quantity at T, interpolated linearly in time; `None` outside the computed range.
    pub fn at(&self, quantity: Quantity, time: f64) -> Option<f64> {
        let next = self.moments.partition_point(|moment| moment.time < time);
        let after = self.moments.get(next)?;
        if after.time == time {
            return Some(after.value(quantity));
        }
        let before = self.moments.get(next.checked_sub(1)?)?;
        let share = (time - before.time) / (after.time - before.time);
        Some((1.0 - share) * before.value(quantity) + share * after.value(quantity))
    }

    /// Returns the mean of a quantity over a time window by the trapezoidal rule; `None` if the march did not cover
    /// the window.
    pub fn mean(&self, quantity: Quantity, (from, to): (f64, f64)) -> Option<f64> {
        let inside = self.moments.iter().filter(|moment| moment.time > from && moment.time < to);
        let mut points = vec![(from, self.at(quantity, from)?)];
        points.extend(inside.map(|moment| (moment.time, moment.value(quantity))));
        points.push((to, self.at(quantity, to)?));
        let area: f64 = points.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum();
        (to > from).then(|| area / (to - from))
    }

    /// Returns half the difference between the largest and the smallest value in a time window; `None` if the march
    /// did not cover the window.
    pub fn amplitude(&self, quantity: Quantity, window: (f64, f64)) -> Option<f64> {
        let (low, high) = self.range(quantity, window)?;
        Some(0.5 * (high - low))
    }

    /// Returns the smallest and the largest value in a time window; `None` if the march did not cover the window.
    pub fn range(&self, quantity: Quantity, (from, to): (f64, f64)) -> Option<(f64, f64)> {
        let ends = [self.at(quantity, from)?, self.at(quantity, to)?];
        let inside = self.moments.iter().filter(|moment| moment.time > from && moment.time < to);
        let values = ends.into_iter().chain(inside.map(|moment| moment.value(quantity)));
        Some(values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v))))
    }

    /// Returns the largest relative difference and the relative L2 difference of a quantity from another trajectory.
    /// Uses the times of this trajectory within the window that both have reached.
    pub fn difference(&self, other: &Self, quantity: Quantity, (from, to): (f64, f64)) -> Option<(f64, f64)> {
        let inside = self.moments.iter().filter(|moment| (from..=to).contains(&moment.time));
        let pairs = inside.filter_map(|moment| {
            let reference = other.at(quantity, moment.time)?;
            Some((moment.value(quantity) - reference, reference))
        });
        let (mut greatest, mut square, mut norm) = (0.0f64, 0.0, 0.0);
        for (difference, reference) in pairs {
            greatest = greatest.max((difference / reference).abs());
            square += difference * difference;
            norm += reference * reference;
        }
        (norm > 0.0).then(|| (greatest, (square / norm).sqrt()))
    }
}
