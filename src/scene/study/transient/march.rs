//! Result of a march: statistics, differences from another march, cost, time series.

use super::data::TransientStudy;
use super::timed_march::Timed;
use crate::scene::names;
use crate::scene::outcome::Findings;
use crate::scene::statistics::{median, percentile};
use crate::scene::table::{Column, Table};
use crate::solver::full::GridCost;
use crate::solver::full::transient::{Frame, Moment, Quantity, Trajectory};
use crate::solver::reduced::tpwl::{TpwlRecord, TpwlStep, Weighting};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Completed march.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct March {
    /// Prefix of its values.
    pub name: String,
    /// Method, and the march that it is compared with.
    pub by: By,
    /// Moments, without fields.
    pub trajectory: Trajectory,
    /// Time of each step, without the start \[s\].
    pub seconds: Vec<f64>,
    /// Relative error of the mass balance between the study's positions.
    pub mass_defect: Option<f64>,
    /// Largest discretisation error of H_c among some moments of a full march, with the time of this moment.
    pub grid_cost: Option<(f64, GridCost)>,
    /// Operating points used by each step of a linearised model.
    pub record: Option<TpwlRecord>,
    /// Warnings that a reduced model left its trained range.
    pub outside: Vec<Warning>,
}

/// Solution method of the steps of a march.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum MarchedBy {
    /// Full solver.
    #[default]
    Full,
    /// Reduced model that was trained before (RNSA).
    Reduced,
    /// Superposition of linearised systems (TPWL) with a weighting.
    Linearised(Weighting),
}

impl MarchedBy {
    /// Returns a description of the march for progress reports.
    pub(super) fn stage(self, frame: Frame) -> String {
        let by = match self {
            Self::Full => "full system",
            Self::Reduced => "reduced model",
            Self::Linearised(_) => "linearised model",
        };
        format!("{by}, {}", frame.name())
    }
}

/// Method of a march, and the march that it is compared with.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum By {
    /// Full solver. Compared with the full march of the same inputs in the first frame, unless it is this march.
    Full {
        /// Name of that march.
        first: Option<String>,
    },
    /// Model. Compared with the full march of the same frame and inputs.
    Model {
        /// Name of the model.
        model: String,
        /// `rnsa` or `tpwl`.
        method: Cow<'static, str>,
        /// Name of the full march.
        full: String,
    },
}

/// Quantities with statistics, and their names.
const QUANTITIES: [(&str, Quantity); 4] = [
    ("H_c", Quantity::CentralFilm),
    ("H_min", Quantity::MinimumFilm),
    ("P_c", Quantity::CentralPressure),
    ("P_max", Quantity::MaximumPressure),
];

const SERIES: [Column<Moment>; 13] = [
    ("T", |m| m.time),
    ("step", |m| m.step),
    ("radius", |m| m.input.radius),
    ("speed", |m| m.input.speed),
    ("load", |m| m.input.load),
    (names::H_C, |m| m.h_c),
    (names::H_MIN, |m| m.h_min),
    ("X_H_min", |m| m.x_h_min),
    ("P_c", |m| m.p_c),
    ("P_max", |m| m.p_max),
    ("X_P_max", |m| m.x_p_max),
    (names::NEWTON_ITERATIONS, |m| m.effort.newton_iterations as f64),
    (names::LINEAR_ITERATIONS, |m| m.effort.linear_iterations as f64),
];

impl March {
    pub(super) fn new(name: &str, by: By, timed: Timed) -> Self {
        let trajectory = Trajectory { states: Vec::new(), ..timed.trajectory };
        Self {
            name: name.to_owned(),
            by,
            trajectory,
            seconds: timed.seconds,
            mass_defect: None,
            grid_cost: None,
            record: None,
            outside: Vec::new(),
        }
    }

    /// Returns the warnings about the march.
    pub fn warnings(&self) -> Vec<Warning> {
        let grid = self.grid_cost.and_then(|(time, cost)| cost.warning_in_time(time));
        self.trajectory.warnings().chain(grid).chain(self.outside.iter().cloned()).collect()
    }

    /// Returns the march that this one is compared with. `None` for a model that ended early.
    pub fn reference<'a>(&self, marches: &[&'a Self]) -> Option<&'a Self> {
        let name = match &self.by {
            By::Full { first } => first.as_ref()?,
            By::Model { full, .. } => Some(full).filter(|_| self.trajectory.finished())?,
        };
        marches.iter().copied().find(|march| march.name == *name)
    }

    /// Returns the largest and the L2 relative difference of a quantity from the compared march.
    pub fn difference(&self, quantity: Quantity, study: &TransientStudy, marches: &[&Self]) -> Option<(f64, f64)> {
        let window = study.window(self.trajectory.transient.duration);
        self.trajectory.difference(&self.reference(marches)?.trajectory, quantity, window)
    }

    /// Returns the full march of the same frame and inputs.
    pub(super) fn full<'a>(&'a self, marches: &[&'a Self]) -> Option<&'a Self> {
        match &self.by {
            By::Full { .. } => Some(self),
            By::Model { full, .. } => marches.iter().copied().find(|march| march.name == *full),
        }
    }

    /// Returns the median time per step \[s\].
    pub fn step_s(&self) -> f64 {
        median(&self.seconds)
    }

    /// Returns the time of all steps \[s\].
    pub fn march_s(&self) -> f64 {
        self.seconds.iter().sum()
    }

    /// Returns the moments after the start.
    pub fn steps(&self) -> &[Moment] {
        self.trajectory.moments.get(1..).unwrap_or(&[])
    }

    pub(super) fn findings(&self, study: &TransientStudy, marches: &[&Self], found: &mut Findings) {
        if matches!(self.by, By::Full { .. }) {
            self.statistics(study.window(self.trajectory.transient.duration), found);
        }
        self.costs(found);
        if let (By::Model { .. }, Some(full)) = (&self.by, self.full(marches)) {
            found.push(format!("{}.speed_up", self.name), None, full.step_s() / self.step_s());
        }
        if let Some(defect) = self.mass_defect {
            found.push(format!("{}.mass_defect", self.name), None, defect);
        }
        if let Some((_, cost)) = self.grid_cost {
            found.push(format!("{}.grid_error", self.name), None, cost.total());
        }
        if let Some(error) = self.trajectory.step_error {
            found.push(format!("{}.step_error", self.name), None, error);
        }
        found.converged &= self.trajectory.finished();
        found.warn(&self.name, self.warnings());
        for (quantity_name, quantity) in QUANTITIES {
            if let Some((greatest, l2)) = self.difference(quantity, study, marches) {
                found.push(format!("{}.{quantity_name}.difference", self.name), None, greatest);
                found.push(format!("{}.{quantity_name}.difference_l2", self.name), None, l2);
            }
        }
        if matches!(&self.by, By::Model { method, .. } if method == "rnsa") {
            found.push(format!("{}.trained", self.name), None, f64::from(u8::from(self.outside.is_empty())));
        }
        if let Some(record) = &self.record {
            let mut reach: Vec<f64> = record.steps().iter().map(TpwlStep::reach).collect();
            reach.retain(|reach| reach.is_finite());
            found.push(format!("{}.reach_median", self.name), None, median(&reach));
            found.push(format!("{}.reach_max", self.name), None, percentile(&reach, 1.0));
            if record.too_steep() {
                found.warn(&self.name, [Warning::TooSteep { advice: self.advice(study, marches) }]);
            }
        }
    }

    /// Recommends an alternative to a linearised march, based on the measured errors of H_c.
    fn advice(&self, study: &TransientStudy, marches: &[&Self]) -> String {
        let error = |march: &Self| Some(march.difference(Quantity::CentralFilm, study, marches)?.0);
        let full = self.reference(marches).map(|full| full.name.as_str());
        let same_inputs = |march: &&&Self| march.reference(marches).map(|full| full.name.as_str()) == full;
        let reduced = marches.iter().filter(|march| matches!(&march.by, By::Model { method, .. } if method == "rnsa"));
        let reduced = reduced.filter(same_inputs).filter_map(|march| Some((&march.name, error(march)?)));
        match (reduced.min_by(|a, b| a.1.total_cmp(&b.1)), error(self)) {
            (Some((name, reduced)), Some(own)) if reduced < own => {
                format!("{name} has a smaller error of H_c: {reduced:.1e} instead of {own:.1e}")
            }
            (Some((name, reduced)), Some(own)) => {
                format!(
                    "train on inputs like these; {name} has no smaller error of H_c: {reduced:.1e} instead of {own:.1e}"
                )
            }
            _ => "train on inputs like these, or march with a reduced model as well to compare both".to_owned(),
        }
    }

    /// Adds start, mean, offset and amplitude of each quantity within a time interval.
    fn statistics(&self, window: (f64, f64), found: &mut Findings) {
        let trajectory = &self.trajectory;
        let Some(start) = trajectory.moments.first() else { return };
        let load = trajectory.transient.separation.as_ref().map(|_| ("load", Quantity::Load));
        let share = trajectory.problem.rough.map(|_| ("asperity_load_share", Quantity::AsperityLoadShare));
        for (quantity_name, quantity) in QUANTITIES.into_iter().chain(load).chain(share) {
            let mut push = |what: &str, value| found.push(format!("{}.{quantity_name}.{what}", self.name), None, value);
            push("start", start.value(quantity));
            if let (Some(mean), Some(amplitude)) =
                (trajectory.mean(quantity, window), trajectory.amplitude(quantity, window))
            {
                push("mean", mean);
                push("offset", mean / start.value(quantity) - 1.0);
                push("amplitude", amplitude);
            }
            if let Some((low, high)) = trajectory.range(quantity, window) {
                push("min", low);
                push("max", high);
            }
        }
    }

    /// Adds numbers of steps and times.
    fn costs(&self, found: &mut Findings) {
        let steps = self.steps();
        let per_step = |count: fn(&Moment) -> usize| steps.iter().map(count).sum::<usize>() as f64 / steps.len() as f64;
        for (what, value) in [
            ("steps", steps.len() as f64),
            ("rejected_steps", self.trajectory.rejected_steps as f64),
            ("newton_per_step", per_step(|moment| moment.effort.newton_iterations)),
            ("krylov_per_step", per_step(|moment| moment.effort.linear_iterations)),
            ("step_s_median", self.step_s()),
            ("step_s_p99", percentile(&self.seconds, 0.99)),
            ("march_s", self.march_s()),
        ] {
            found.push(format!("{}.{what}", self.name), None, value);
        }
    }

    /// Returns the time series.
    pub(super) fn series(&self) -> Table {
        series(&self.name, &self.trajectory)
    }
}

/// Returns the time series of a named march. The last column is the estimated largest relative error of H_c due to the
/// time step, the same in every row.
pub fn series(name: &str, trajectory: &Trajectory) -> Table {
    let mut table = Table::of(format!("transient_{}", name.replace('.', "_")), &SERIES, &trajectory.moments);
    table.columns.push("step_error".to_owned());
    let error = trajectory.step_error.unwrap_or(f64::NAN);
    table.rows.iter_mut().for_each(|row| row.push(error));
    if trajectory.problem.rough.is_some() {
        table.columns.push("asperity_load_share".to_owned());
        let rows = table.rows.iter_mut().zip(&trajectory.moments);
        rows.for_each(|(row, moment)| row.push(moment.asperity_load_share));
    }
    table
}
