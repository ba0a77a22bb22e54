//! Error-split study: sources of a reduced model's error, at one contact or along the test trajectory.

use super::path::trajectory_points;
use super::question::{
    Chart, ChartAxis, Checked, Column, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::check::{self, MAX_POINTS, refuse};
use crate::scene::method::Method;
use crate::scene::names;
use crate::scene::statistics::{median, percentile};
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{ErrorSplit, ErrorSplitter, Parts, PressureParts, SplitError};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Error of a reduced model split by source: basis, Galerkin projection, sampled equations, grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ErrorSplitStudy {
    /// Contacts at which the error is split.
    pub contacts: Contacts,
    /// The reduced model.
    pub method: Method,
}

/// Contacts that a study uses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Contacts {
    /// The scene's own operating point.
    Here,
    /// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
    Trajectory {
        /// The box.
        range: ParameterSpace,
        /// Number of equidistant values of c, including both ends.
        points: usize,
    },
}

/// Split error at one contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Position c on the trajectory; NaN for the scene's own contact.
    pub c: f64,
    /// The contact.
    pub point: OperatingPoint,
    /// Parts of the error, or the reason why there are none.
    pub split: Result<Arc<ErrorSplit>, String>,
}

/// Parts of the error of a film thickness, relative to the full solution.
const FILM_PARTS: [Column<Parts>; 6] = [
    ("basis", |parts| parts.basis),
    ("projection", |parts| parts.projection),
    ("sampling", |parts| parts.sampling),
    ("reduction", Parts::reduction),
    ("discretisation", |parts| parts.discretisation),
    ("whole", Parts::whole),
];

/// Returns all parts with their names: of both film thicknesses, and of the pressure as lengths in the weighted norm.
fn parts(h_c: &Parts, h_min: &Parts, p: &PressureParts) -> Vec<(String, f64)> {
    let films = [("H_c", h_c), ("H_min", h_min)];
    let of_films =
        films.iter().flat_map(|(film, of)| FILM_PARTS.map(|(part, get)| (format!("{film}.{part}"), get(of))));
    let pressure =
        [("basis", p.basis), ("projection", p.projection), ("sampling", p.sampling), ("reduction", p.reduction)];
    of_films.chain(pressure.map(|(part, value)| (format!("e_P.{part}"), value))).collect()
}

/// Returns the names of all parts.
fn names() -> Vec<String> {
    parts(&Parts::default(), &Parts::default(), &PressureParts::default()).into_iter().map(|(name, _)| name).collect()
}

fn values(split: &ErrorSplit) -> Vec<f64> {
    parts(&split.h_c, &split.h_min, &split.pressure).into_iter().map(|(_, value)| value).collect()
}

impl Question for ErrorSplitStudy {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        if self.method.model().is_none() {
            return Err(refuse("study.method", "must be Reduced(…): a full solution has no such parts"));
        }
        match &self.contacts {
            Contacts::Here => Ok(()),
            Contacts::Trajectory { range, points } => {
                check::count("study.contacts.points", *points, 2, MAX_POINTS)?;
                check::space("study.contacts.range", range)
            }
        }
    }

    fn methods(&self) -> &[Method] {
        std::slice::from_ref(&self.method)
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let Some(source) = self.method.model() else {
            return Err(RunError::Study("an error split needs a Reduced `method`".to_owned()));
        };
        let points = match &self.contacts {
            Contacts::Here => vec![(f64::NAN, experiment.request()?.point)],
            Contacts::Trajectory { range, points } => trajectory_points(range, experiment, *points),
        };
        let Some((_, first)) = points.first() else { return Ok(()) };
        let model = setting.bench.model_for(source, first, &experiment.lubricant, observer)?;
        // With a truncation, the number of modes differs between local models.
        let mut splitters: Vec<Option<ErrorSplitter>> = model.windows.iter().map(|_| None).collect();
        for (i, (c, point)) in points.iter().enumerate() {
            setting.step("error splits", i, points.len())?;
            let k = model.window_for(point);
            let (Some(place), Some(window)) = (splitters.get_mut(k), model.windows.get(k)) else {
                return Err(RunError::Study("the reduced model contains no local model".to_owned()));
            };
            let splitter =
                place.get_or_insert_with(|| ErrorSplitter::new(Arc::clone(&model), self.method.options(window)));
            let split = match splitter.split(point, experiment.lubricant, observer) {
                Ok(split) => Ok(Arc::new(split)),
                Err(SplitError::Cancelled) => return Err(RunError::Cancelled),
                Err(SplitError::Problem(refused)) => return Err(refused.into()),
                Err(error) => Err(error.to_string()),
            };
            tell(Row { c: *c, point: *point, split });
        }
        Ok(())
    }

    /// Values: `failures`; for `H_c` and `H_min` and each part `H_c.basis_median`, `H_c.basis_max` and so on (absolute
    /// values, relative to the full film thickness), `e_P.basis_median` likewise. For a single contact also the signed
    /// `H_c.basis` and `e_P.basis`.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            if let Err(error) = &row.split {
                let moes = row.point.moes();
                found.warnings.push(format!("M = {:.4}, L = {:.4}: {error}", moes.m, moes.l).into());
            }
        }
        let of = Some(&self.method);
        let split: Vec<Vec<f64>> =
            rows.iter().filter_map(|row| row.split.as_ref().ok()).map(|split| values(split)).collect();
        let failures = rows.len() - split.len();
        found.converged &= failures == 0;
        found.push("points", None, rows.len() as f64);
        found.push("failures", of, failures as f64);
        for (k, name) in names().into_iter().enumerate() {
            let sizes: Vec<f64> = split.iter().map(|parts| parts[k].abs()).collect();
            found.push(format!("{name}_median"), of, median(&sizes));
            found.push(format!("{name}_max"), of, percentile(&sizes, 1.0));
            if let ([parts], 1) = (&split[..], rows.len()) {
                found.push(name, of, parts[k]);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let contact = ["c", names::M, names::L, names::ALPHA, names::H_C, names::H_MIN].map(str::to_owned);
        let columns = contact.into_iter().chain(names()).collect();
        let row = |row: &&Row| {
            let (split, moes) = (row.split.as_ref().ok()?, row.point.moes());
            let contact = [row.c, moes.m, moes.l, row.point.alpha_per_pa, split.full.h_c, split.full.h_min];
            Some(contact.into_iter().chain(values(split)).collect())
        };
        let rows = rows.iter().filter_map(row).collect();
        vec![Table { name: "error_split".to_owned(), columns, rows, ..Table::default() }]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let along = matches!(self.contacts, Contacts::Trajectory { .. });
        let of = |film: &str, split: &ErrorSplit| if film == "H_c" { split.h_c } else { split.h_min };
        let chart = |film: &'static str| {
            let (x, marks) = if along { ("c", Marks::Line) } else { ("Load number M", Marks::Dots) };
            let y = ChartAxis::log(format!("Part of the error of {film}, relative"));
            let mut chart = Chart::new(format!("Error of {film}"), ChartAxis::linear(x), y);
            for (part, get) in FILM_PARTS {
                let point = |row: &&Row| {
                    let split = row.split.as_ref().ok()?;
                    Some([if along { row.c } else { row.point.moes().m }, get(&of(film, split)).abs()])
                };
                chart.add(part, marks, rows.iter().filter_map(point));
            }
            chart
        };
        ["H_c", "H_min"].map(chart).into()
    }
}
