//! What comes of a march: a value that knows its inputs, its frame and how it ended.

use super::frame::{Conditions, Scales, point_at};
use super::march::Transient;
use super::pace::Rule;
use super::signal::Input;
use crate::solver::discrete::grid::LineGrid;
use crate::solver::full::{Mesh, Problem, Scalars, Termination, scalars_of};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Work of one step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Effort {
    /// Newton steps.
    pub newton_iterations: usize,
    /// Krylov iterations of a full model.
    pub linear_iterations: usize,
}

impl Effort {
    /// The work of this and another step.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            newton_iterations: self.newton_iterations + other.newton_iterations,
            linear_iterations: self.linear_iterations + other.linear_iterations,
        }
    }
}

/// The contact at one time: scalars in the scales of the reference contact, (2.22).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// T.
    pub time: f64,
    /// Length of the step that led here; 0 at the start.
    pub step: f64,
    /// R̄, ū, w̄.
    pub input: Input,
    /// The frame's scales, which its fields are in.
    pub scales: Scales,
    /// Film at X = 0.
    pub h_c: f64,
    /// Smallest nodal film under the contact.
    pub h_min: f64,
    /// Its position.
    pub x_h_min: f64,
    /// Pressure at X = 0.
    pub p_c: f64,
    /// Largest nodal pressure.
    pub p_max: f64,
    /// Its position.
    pub x_p_max: f64,
    /// What it cost.
    pub effort: Effort,
}

/// Fields at one time in the frame's own scales; node arrays as everywhere, the first entry lies outside the inlet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// T.
    pub time: f64,
    /// The frame's scales.
    pub scales: Scales,
    /// P.
    pub pressure: Vec<f64>,
    /// H.
    pub film: Vec<f64>,
    /// λ, zero where the film is whole; empty where a penalty ruptures it, and of reduced models.
    pub multiplier: Vec<f64>,
    /// θ, the share of the gap that is filled; empty where rupture does not conserve mass.
    pub fraction: Vec<f64>,
    /// H₀ with the kernel of (2.27).
    pub h_0: f64,
}

/// How a march ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Ended {
    /// At the end of its duration.
    Finished,
    /// The observer asked to stop.
    Cancelled {
        /// The last time reached.
        time: f64,
    },
    /// A step could not be taken.
    StepRefused {
        /// Where it was to lead.
        time: f64,
        /// Its length.
        step: f64,
        /// Why its Newton iteration stopped.
        termination: Termination,
    },
    /// The inputs led to a contact outside any sense.
    ContactRefused {
        /// When.
        time: f64,
        /// What is wrong with it, a sentence.
        reason: String,
    },
}

/// A quantity of a [`Moment`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// H_c.
    CentralFilm,
    /// H_min.
    MinimumFilm,
    /// P_c.
    CentralPressure,
    /// P_max.
    MaximumPressure,
}

/// A contact taken through time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trajectory {
    /// What was asked.
    pub transient: Transient,
    /// Rule by which its steps were taken.
    pub(crate) rule: Rule,
    /// The reference problem.
    pub problem: Problem,
    /// Grid of the fields.
    pub mesh: Mesh,
    /// Abscissae X of the fields, in units of the frame's half width.
    pub x: Vec<f64>,
    /// All times from the stationary start on; empty where even that failed.
    pub moments: Vec<Moment>,
    /// Fields, where they were to be kept.
    pub states: Vec<State>,
    /// Steps that were begun and discarded.
    pub rejected_steps: usize,
    /// Greatest relative error that the lengths of the steps leave in H_c, where it was estimated.
    pub step_error: Option<f64>,
    /// How it ended.
    pub ended: Ended,
}

impl Ended {
    /// One sentence for people.
    pub fn describe(&self) -> String {
        match self {
            Self::Finished => "finished".to_owned(),
            Self::Cancelled { time } => format!("was cancelled at T = {time:.4}"),
            Self::StepRefused { time, step, termination } => {
                let iteration = match termination {
                    Termination::IterationLimit => "did not end",
                    Termination::Effort => "would have been one of too many",
                    _ => "diverged",
                };
                if *step == 0.0 {
                    return format!(
                        "could not begin: the iteration for the steady contact at T = {time:.4} {iteration}"
                    );
                }
                format!(
                    "could not take the step of {step:.1e} to T = {time:.4}, whose iteration {iteration}; what was computed \
                     before is kept"
                )
            }
            Self::ContactRefused { time, reason } => {
                format!("stopped at T = {time:.4}: {reason}; what was computed before is kept")
            }
        }
    }
}

impl Moment {
    /// The scalars of fields in the frame's scales.
    pub fn of_fields(
        at: &Conditions,
        step: f64,
        grid: &LineGrid,
        pressure: &[f64],
        film: &[f64],
        effort: Effort,
    ) -> Self {
        Self::of_scalars(at, step, &scalars_of(grid, &at.problem, pressure, film, 0.0), effort)
    }

    /// Scalars in the frame's scales, in those of the reference contact.
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
            effort,
        }
    }

    /// One of its quantities.
    pub fn value(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::CentralFilm => self.h_c,
            Quantity::MinimumFilm => self.h_min,
            Quantity::CentralPressure => self.p_c,
            Quantity::MaximumPressure => self.p_max,
        }
    }
}

impl Trajectory {
    /// Whether it reached the end.
    pub fn finished(&self) -> bool {
        self.ended == Ended::Finished
    }

    /// Returns the warning of a march that did not reach its end.
    pub fn stopped(&self) -> Option<Warning> {
        (!self.finished()).then(|| Warning::MarchStopped { reached: self.reached(), ended: self.ended.clone() })
    }

    /// Returns the warning of its largest Hertzian pressure.
    fn hertz_warning(&self) -> Option<Warning> {
        let inputs = self.moments.iter().map(|moment| moment.input).chain([self.transient.inputs.at(0.0)]);
        let pressures = inputs.map(|input| point_at(&self.problem.point, input).hertz().pressure_pa);
        Warning::of_hertz_pressure(pressures.fold(0.0, f64::max))
    }

    /// Returns what a reader must know of it: that it stopped early, the error of its steps, its Hertzian pressure.
    pub fn warnings(&self) -> impl Iterator<Item = Warning> {
        self.stopped().into_iter().chain(self.step_warning()).chain(self.hertz_warning())
    }

    /// The last T reached; 0 where not even the start was found.
    pub fn reached(&self) -> f64 {
        self.moments.last().map_or(0.0, |moment| moment.time)
    }

    /// A quantity at T, on the straight line between the neighbouring times; `None` outside what was computed.
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

    /// Mean of a quantity over a window of time, by the trapezoidal rule; `None` where the window was not reached.
    pub fn mean(&self, quantity: Quantity, (from, to): (f64, f64)) -> Option<f64> {
        let inside = self.moments.iter().filter(|moment| moment.time > from && moment.time < to);
        let mut points = vec![(from, self.at(quantity, from)?)];
        points.extend(inside.map(|moment| (moment.time, moment.value(quantity))));
        points.push((to, self.at(quantity, to)?));
        let area: f64 = points.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum();
        (to > from).then(|| area / (to - from))
    }

    /// Half the distance between largest and smallest value over a window of time; `None` where the window was not
    /// reached.
    pub fn amplitude(&self, quantity: Quantity, (from, to): (f64, f64)) -> Option<f64> {
        let ends = [self.at(quantity, from)?, self.at(quantity, to)?];
        let inside = self.moments.iter().filter(|moment| moment.time > from && moment.time < to);
        let values = ends.into_iter().chain(inside.map(|moment| moment.value(quantity)));
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
        Some(0.5 * (high - low))
    }

    /// Greatest relative difference and relative L2 difference of a quantity from another trajectory, at the times of
    /// this one in a window, as far as both have come.
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
