//! Transition study: pressure and film thickness of a contact for increasing load number, from rigid bodies to the dry
//! contact (Fig. 2.2).

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::At;
use crate::scene::check::{count, number};
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Pressure and film thickness along the entrainment axis for several load numbers, in the default realisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transition {
    /// Load numbers M.
    pub m: Vec<f64>,
    /// Lubricant number L.
    pub l: f64,
}

/// Result for one load number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Load number M.
    pub m: f64,
    /// X, P and H; empty if the solve failed.
    pub profile: Vec<(f64, f64, f64)>,
    /// Flattening: deformation at X = 0 minus that at X = −1, over the undeformed gap of ½ between them. 0 for a rigid
    /// body, 1 for a flat one.
    pub flattening: f64,
    /// Warnings.
    pub warnings: Vec<Warning>,
}

/// Range of X shown in charts.
const SHOWN: (f64, f64) = (-3.0, 2.0);

impl Question for Transition {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        count("study.m (how many)", self.m.len(), 1, 20)?;
        self.m.iter().try_for_each(|&m| number("study.m", m, 0.05, 1e4))?;
        number("study.l", self.l, 1e-3, 1e3)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        for (i, &m) in self.m.iter().enumerate() {
            setting.step("load numbers", i, self.m.len())?;
            let experiment = setting.experiment;
            let point = At::moes(m, self.l).point(experiment.contact)?;
            let request = experiment.request_at(OperatingPoint { sliding: experiment.sliding, ..point });
            let answer = setting.bench.answer(&request, None, setting.observer)?;
            let profile = |solution: &Solution| solution.profile().collect::<Vec<_>>();
            let profile = answer.fields().map(profile).unwrap_or_default();
            let warnings = answer.result.warnings.clone();
            tell(Row { m, flattening: flattening(&profile), profile, warnings });
        }
        Ok(())
    }

    /// Values: `failures`, and for each load number, numbered from 0, `P_max_0` … and `flattening_0` ….
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let of = Some(&Method::Full);
        let failures = rows.iter().filter(|row| row.profile.is_empty()).count();
        found.converged &= failures == 0;
        found.push("failures", of, failures as f64);
        found.warn_repeated("", Warning::summary(rows.iter().map(|row| &row.warnings[..])));
        for (k, row) in rows.iter().enumerate() {
            let largest = row.profile.iter().map(|(_, p, _)| *p).fold(f64::NAN, f64::max);
            found.push(format!("P_max_{k}"), of, largest);
            found.push(format!("flattening_{k}"), of, row.flattening);
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("transition", &[names::M, "X", "P", "H"]);
        for row in rows {
            table.rows.extend(row.profile.iter().map(|&(x, p, h)| vec![row.m, x, p, h]));
        }
        vec![table]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let x = || ChartAxis::linear("X = x/a");
        let mut pressures = Chart::new("Pressure", x(), ChartAxis::linear("P = p/p_H"));
        let mut films = Chart::new("Film", x(), ChartAxis::log("H = h R/a²"));
        let hertz = (-100..=100).map(|k| 0.01 * f64::from(k)).map(|x| [x, (1.0 - x * x).max(0.0).sqrt()]);
        for row in rows {
            let shown = || row.profile.iter().filter(|(x, ..)| (SHOWN.0..=SHOWN.1).contains(x));
            pressures.add(format!("M {}", row.m), Marks::Line, shown().map(|&(x, p, _)| [x, p]));
            films.add(format!("M {}", row.m), Marks::Line, shown().map(|&(x, _, h)| [x, h]));
        }
        pressures.add("dry contact", Marks::Line, hertz);
        vec![pressures, films]
    }
}

/// Returns the part of the gap between X = −1 and X = 0 of the undeformed bodies that the deformation removes.
fn flattening(profile: &[(f64, f64, f64)]) -> f64 {
    let at = |wanted: f64| {
        let near = profile.iter().min_by(|a, b| (a.0 - wanted).abs().total_cmp(&(b.0 - wanted).abs()));
        near.map_or(f64::NAN, |&(x, _, h)| h - 0.5 * x * x)
    };
    2.0 * (at(0.0) - at(-1.0))
}
