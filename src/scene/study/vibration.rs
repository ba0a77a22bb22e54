//! Vibration study: stiffness and damping of the film over frequency and speed, for rotor and multibody programs.

use super::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::Request;
use crate::scene::axis::Steps;
use crate::scene::check::{count, number, refuse};
use crate::scene::dynamics::ContactDynamics;
use crate::scene::method::Method;
use crate::scene::names;
use crate::scene::written::is_default;
use crate::solver::full::response::{Dynamics, Maxwell, check_lubricant};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Stiffness and damping of the film at some frequencies and speeds, and an element of springs and dashpots fitted at
/// each speed. Each frequency is one complex linear solve at the steady contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vibration {
    /// Frequencies \[Hz\].
    pub frequencies_hz: Steps,
    /// Entrainment speeds \[m/s\]; the scene's speed if absent.
    #[serde(default, skip_serializing_if = "is_default")]
    pub speeds: Option<Steps>,
}

/// Largest numbers of frequencies and of speeds.
const MOST_FREQUENCIES: usize = 1000;
const MOST_SPEEDS: usize = 100;
/// Ranges of the frequency \[Hz\] and of the speed \[m/s\].
const FREQUENCY: (f64, f64) = (0.0, 1e9);
const SPEED: (f64, f64) = (1e-9, 1e6);

/// Columns of the table over frequency and speed, and of the table of fitted elements. SI units; per metre of length for
/// a line contact.
const COLUMNS: [&str; 4] = [names::SPEED, "frequency_hz", "stiffness", "damping"];
const ELEMENT: [&str; 6] =
    [names::SPEED, "static_stiffness", "series_stiffness", "relaxation_s", "parallel_damping", "deviation"];

/// Result at one speed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Entrainment speed \[m/s\].
    pub speed_m_per_s: f64,
    /// Stiffness and damping at the frequencies of the study. Per metre of length for a line contact.
    pub values: Vec<Dynamics>,
    /// Fitted element; `None` for fewer than three different frequencies above zero.
    pub maxwell: Option<Maxwell>,
    /// Warnings about the steady contact.
    pub warnings: Vec<Warning>,
}

fn check_steps(field: &str, steps: &Steps, most: usize, (low, high): (f64, f64)) -> Checked {
    count(&format!("{field} (how many)"), steps.len(), 1, most)?;
    let ends = match steps {
        Steps::Linear { from, to, .. } | Steps::Graded { from, to, .. } => vec![*from, *to],
        Steps::Log { from, to, .. } => {
            [from, to].into_iter().try_for_each(|end| number(field, *end, low.max(f64::MIN_POSITIVE), high))?;
            Vec::new()
        }
        Steps::List(values) => values.clone(),
    };
    ends.into_iter().try_for_each(|value| number(field, value, low, high))?;
    if let Steps::Graded { from, half, to, .. } = steps {
        Steps::check_grading(*from, *half, *to).map_err(|why| refuse(field, why.to_string()))?;
    }
    Ok(())
}

impl Vibration {
    fn speeds(&self, point: &OperatingPoint) -> Vec<f64> {
        self.speeds.as_ref().map_or_else(|| vec![point.speed_m_per_s], Steps::values)
    }
}

impl Question for Vibration {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        check_lubricant(&experiment.lubricant).map_err(|problem| refuse("study", format!("is refused: {problem}")))?;
        check_steps("study.frequencies_hz", &self.frequencies_hz, MOST_FREQUENCIES, FREQUENCY)?;
        self.speeds.iter().try_for_each(|speeds| check_steps("study.speeds", speeds, MOST_SPEEDS, SPEED))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let request = setting.experiment.request()?;
        let (frequencies, speeds) = (self.frequencies_hz.values(), self.speeds(&request.point));
        for (k, &speed_m_per_s) in speeds.iter().enumerate() {
            setting.step("speeds", k, speeds.len())?;
            let point = OperatingPoint { speed_m_per_s, ..request.point };
            let answer = setting.bench.answer(&Request { point, ..request.clone() }, None, setting.observer)?;
            let Some(solution) = answer.fields() else { continue };
            let dynamics = ContactDynamics::of(solution, &frequencies, setting.observer);
            let dynamics = dynamics.map_err(|problem| RunError::Study(problem.to_string()))?;
            if dynamics.values.len() < frequencies.len() {
                // The observer cancelled.
                return setting.step("speeds", k, speeds.len());
            }
            let ContactDynamics { values, maxwell, .. } = dynamics;
            tell(Row { speed_m_per_s, values, maxwell, warnings: answer.result.warnings.clone() });
        }
        Ok(())
    }

    /// Values, numbered from 0 by speed and then by frequency: `stiffness_0_0` and `damping_0_0`, in SI units and per
    /// metre of length for a line contact. The fitted element has `maxwell.static_stiffness_0`,
    /// `maxwell.series_stiffness_0`, `maxwell.relaxation_s_0`, `maxwell.parallel_damping_0` and `maxwell.deviation_0`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let of = Some(&Method::Full);
        let speeds = self.speeds.as_ref().map_or(1, Steps::len);
        found.converged &= rows.len() == speeds;
        found.warn("", rows.iter().flat_map(|row| row.warnings.iter().cloned()));
        for (i, row) in rows.iter().enumerate() {
            for (j, value) in row.values.iter().enumerate() {
                found.push(format!("stiffness_{i}_{j}"), of, value.stiffness);
                found.push(format!("damping_{i}_{j}"), of, value.damping);
            }
            for (name, value) in ELEMENT.iter().zip(element(row)).skip(1) {
                found.push(format!("maxwell.{name}_{i}"), of, value);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let (mut table, mut elements) = (Table::new("vibration", &COLUMNS), Table::new("maxwell", &ELEMENT));
        for row in rows {
            let of = |value: &Dynamics| vec![row.speed_m_per_s, value.frequency_hz, value.stiffness, value.damping];
            table.rows.extend(row.values.iter().map(of));
            let element = element(row);
            if !element.is_empty() {
                elements.rows.push(element);
            }
        }
        if elements.rows.is_empty() { vec![table] } else { vec![table, elements] }
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let quantities: [Column<Dynamics>; 2] =
            [("Stiffness k [SI]", |value| value.stiffness), ("Damping c [SI]", |value| value.damping)];
        let chart = |(title, get): Column<Dynamics>| {
            let mut chart = Chart::new(title, ChartAxis::log("Frequency [Hz]"), ChartAxis::linear(title));
            for row in rows {
                let points = row.values.iter().filter(|value| value.frequency_hz > 0.0);
                let points = points.map(|value| [value.frequency_hz, get(value)]);
                chart.add(format!("{} m/s", row.speed_m_per_s), Marks::Line, points);
            }
            chart
        };
        quantities.map(chart).into()
    }
}

/// Returns the fitted element in the order of [`ELEMENT`]; empty if there is none.
fn element(row: &Row) -> Vec<f64> {
    row.maxwell
        .iter()
        .flat_map(|fitted| {
            [
                row.speed_m_per_s,
                fitted.static_stiffness,
                fitted.series_stiffness,
                fitted.relaxation_s,
                fitted.parallel_damping,
                fitted.deviation,
            ]
        })
        .collect()
}
