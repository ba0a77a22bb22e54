//! Contacts along a path, each solved from its neighbour. Shared by the sweep and the test trajectory (3.21).

use super::question::{Chart, ChartAxis, Experiment, Findings, Marks, Notice, RunError, Setting, Table, Tell};
use crate::scene::answer::Request;
use crate::scene::contact_result::{ContactResult, contact_columns_after, result_columns};
use crate::scene::contact_row::{ByMethods, RefusedContact, remarks};
use crate::scene::extras::Extras;
use crate::scene::grid::Grid;
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::full::Solution;
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::{OperatingPoint, PLAUSIBLE_HERTZ_PRESSURE_PA};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Values for which errors of reduced methods relative to the first full method are computed.
const COMPARED: [&str; 3] = [names::H_C, names::H_MIN, names::TRACTION];

/// Lower bound for the reference of relative traction errors.
const LEAST_TRACTION: f64 = 0.005;

/// One contact of a path, solved by all methods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathRow {
    /// Values of the varied quantities.
    pub values: Vec<f64>,
    /// Result by each method, or the reason why the contact is refused.
    pub results: ByMethods,
    /// Full solution on the model's grid, if requested.
    pub on_model_grid: OnModelGrid,
}

/// Full solution on a model's own grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum OnModelGrid {
    /// Not requested.
    NotAsked,
    /// Result.
    Solved(Box<ContactResult>),
}

/// Path to solve: contacts, number of contacts per line (each line begins with a cold start), name of the stage,
/// whether all full solves start cold, and whether full solutions on the model's grid are requested.
pub(super) struct Path<'a> {
    pub name: &'static str,
    pub contacts: Vec<(Vec<f64>, Result<OperatingPoint, RefusedContact>)>,
    pub line: usize,
    pub methods: &'a [Method],
    pub cold: bool,
    pub on_model_grid: bool,
}

/// Returns the contacts of the test trajectory (3.21) at equidistant c, 0 ≤ c ≤ 2, without those that the range
/// excludes.
pub(super) fn trajectory_points(
    range: &ParameterSpace,
    experiment: &Experiment,
    count: usize,
) -> Vec<(f64, OperatingPoint)> {
    places(count).filter_map(|c| Some((c, range.trajectory(experiment.contact, c)?))).collect()
}

/// Returns equidistant c of the test trajectory, including both ends.
pub(super) fn places(count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| 2.0 * i as f64 / (count - 1) as f64)
}

impl PathRow {
    /// Returns the results; empty if the contact is refused.
    pub fn results(&self) -> &[ContactResult] {
        self.results.as_ref().map_or(&[], Vec::as_slice)
    }

    /// Returns the times of its solves \[s\].
    pub(super) fn seconds(&mut self) -> Vec<&mut f64> {
        let on_model_grid = match &mut self.on_model_grid {
            OnModelGrid::Solved(result) => Some(&mut result.wall_s),
            OnModelGrid::NotAsked => None,
        };
        self.results.iter_mut().flatten().map(|result| &mut result.wall_s).chain(on_model_grid).collect()
    }
}

impl Path<'_> {
    /// Solves all contacts by all methods.
    pub fn solve(&self, setting: &mut Setting<'_>, tell: &Tell<'_, PathRow>) -> Result<(), RunError> {
        let mut former: Vec<Option<Solution>> = vec![None; self.methods.len()];
        let mut former_on_model_grid: Option<Solution> = None;
        let (mut first_refused, mut some_solved) = (None, false);
        for (i, (values, point)) in self.contacts.iter().enumerate() {
            setting.step(self.name, i, self.contacts.len())?;
            if i.is_multiple_of(self.line) {
                // A new line starts cold: the last contact is not a neighbour, and the order of lines must not matter.
                former.fill(None);
                former_on_model_grid = None;
                setting.bench.forget();
            }
            let mut on_model_grid = OnModelGrid::NotAsked;
            let results = match point {
                Ok(point) => match self.at(point, setting, (&mut former, &mut former_on_model_grid)) {
                    Ok((results, own)) => {
                        on_model_grid = own;
                        Ok(results)
                    }
                    Err(error) if error.concerns_all_contacts() => return Err(error),
                    Err(error) => Err(RefusedContact::of(&error)),
                },
                Err(why) => Err(why.clone()),
            };
            match &results {
                Err(why) if first_refused.is_none() => first_refused = Some(why.clone()),
                Err(_) => {}
                Ok(_) => some_solved = true,
            }
            tell(PathRow { values: values.clone(), results, on_model_grid });
        }
        match first_refused {
            // If all contacts are refused, the study itself is wrong.
            Some(first) if !some_solved => Err(first.into()),
            _ => Ok(()),
        }
    }

    /// Solves one contact by all methods, each starting from its previous solution.
    fn at(
        &self,
        point: &OperatingPoint,
        setting: &mut Setting<'_>,
        (former, former_on_model_grid): (&mut [Option<Solution>], &mut Option<Solution>),
    ) -> Result<(Vec<ContactResult>, OnModelGrid), RunError> {
        let request = setting.experiment.request_at(*point);
        let mut results = Vec::new();
        for (method, former) in self.methods.iter().zip(former) {
            let start = former.as_ref().filter(|_| !self.cold);
            let request = Request { method: method.clone(), ..request.clone() };
            let answer = setting.bench.answer(&request, start, setting.observer)?;
            results.push(answer.result.clone());
            *former = answer.into_fields().or(former.take());
        }
        if !self.on_model_grid {
            return Ok((results, OnModelGrid::NotAsked));
        }
        let request = Request { grid: Grid::Model, ..request };
        let start = former_on_model_grid.as_ref().filter(|_| !self.cold);
        let answer = setting.bench.answer(&request, start, setting.observer)?;
        let on_model_grid = OnModelGrid::Solved(Box::new(answer.result.clone()));
        *former_on_model_grid = answer.into_fields().or(former_on_model_grid.take());
        Ok((results, on_model_grid))
    }
}

/// Values: expected values of single contacts, as `H_c[3]`; `points`; for each method `failures` (at plausible
/// pressures), `failures_beyond` (at higher pressures), Newton steps and times; for a reduced method also its errors
/// relative to the first full method or to full solutions on the model's grid.
pub(super) fn findings(methods: &[Method], experiment: &Experiment, rows: &[&PathRow], found: &mut Findings) {
    for (i, row) in rows.iter().enumerate() {
        for (method, result) in methods.iter().zip(row.results()) {
            for wanted in experiment.expected.iter().filter_map(|name| name.strip_suffix(&format!("[{i}]"))) {
                let value = result.value(wanted).unwrap_or(f64::NAN);
                found.push(format!("{wanted}[{i}]"), Some(method), value);
            }
        }
    }
    found.push("points", None, rows.len() as f64);
    let refused: Vec<&RefusedContact> = rows.iter().filter_map(|row| row.results.as_ref().err()).collect();
    if let Some(first) = refused.first() {
        found.converged = false;
        found.push("refused", None, refused.len() as f64);
        let (count, all) = (refused.len(), rows.len());
        found
            .warnings
            .push(Notice::Sentence(format!("{count} of {all} contacts are refused, the first of them: {first}")));
    }
    let solved = rows.iter().filter_map(|row| match &row.on_model_grid {
        OnModelGrid::Solved(result) => Some(result.converged),
        OnModelGrid::NotAsked => None,
    });
    let on_model_grid: Vec<bool> = solved.collect();
    if !on_model_grid.is_empty() {
        let failures = on_model_grid.iter().filter(|converged| !**converged).count();
        found.converged &= failures == 0;
        found.push("failures_on_model_grid", None, failures as f64);
    }
    let full = methods.iter().position(|method| *method == Method::Full);
    for (k, method) in methods.iter().enumerate() {
        let of = Some(method);
        let warnings = Warning::summary(rows.iter().filter_map(|row| Some(&row.results().get(k)?.warnings[..])));
        found.warn_repeated(&tag(methods, k), warnings);
        let results = || rows.iter().filter_map(|row| row.results().get(k));
        let plausible = |result: &&ContactResult| result.point.hertz().pressure_pa <= PLAUSIBLE_HERTZ_PRESSURE_PA;
        let failed = || results().filter(|result| !result.converged);
        let failures = failed().filter(plausible).count();
        found.converged &= failures == 0;
        found.push("failures", of, failures as f64);
        found.push("failures_beyond", of, (failed().count() - failures) as f64);
        let newton: Vec<f64> = results().map(|result| result.newton_iterations as f64).collect();
        let seconds: Vec<f64> = results().map(|result| result.wall_s).collect();
        found.push_effort(of, &newton, &seconds);
        if *method == Method::Full || full.is_none() && on_model_grid.is_empty() {
            continue;
        }
        for name in COMPARED {
            let errors: Vec<f64> = rows.iter().filter_map(|row| error_of(name, row, k, full)).collect();
            found.push_spread(&format!("{name}_error"), of, &errors);
        }
    }
}

/// Returns the relative error of a method at one contact, if it can be computed.
fn error_of(name: &str, row: &PathRow, method: usize, full: Option<usize>) -> Option<f64> {
    let truth = match &row.on_model_grid {
        OnModelGrid::Solved(result) => result.value(name)?,
        OnModelGrid::NotAsked => row.results().get(full?)?.value(name)?,
    };
    let value = row.results().get(method)?.value(name)?;
    // The traction has a lower bound, since a relative error of a value near zero is meaningless.
    let size = if name == names::TRACTION { truth.abs().max(LEAST_TRACTION) } else { truth };
    Some(((value - truth) / size).abs()).filter(|error| error.is_finite())
}

/// Returns a table with one row per contact: varied quantities, contact, and result of each method.
pub(super) fn table(name: &str, varied: &[String], methods: &[Method], rows: &[&PathRow]) -> Table {
    let of_contact = contact_columns_after(varied);
    let mut columns: Vec<String> =
        varied.iter().map(String::as_str).chain(of_contact.iter().copied()).map(str::to_owned).collect();
    let of_result = result_columns(Extras::of_results(rows.iter().flat_map(|row| row.results())));
    let tags = (0..methods.len()).map(|k| tag(methods, k));
    columns.extend(tags.flat_map(|tag| of_result.iter().map(move |column| names::by(&tag, column))));
    let width = columns.len();
    let row = |row: &&PathRow| -> Vec<f64> {
        let contact = row.results().iter().take(1).flat_map(|result| result.row(&of_contact));
        let results = row.results().iter().flat_map(|result| result.row(&of_result));
        let numbers = row.values.iter().copied().chain(contact).chain(results);
        // A refused contact has no numbers.
        numbers.chain(std::iter::repeat(f64::NAN)).take(width).collect()
    };
    Table {
        name: name.to_owned(),
        columns,
        rows: rows.iter().map(row).collect(),
        remarks: remarks(rows.iter().map(|row| &row.results)),
        ..Table::default()
    }
}

/// Returns `full` or `reduced`, followed by a number if the same method occurs again.
pub(super) fn tag(methods: &[Method], k: usize) -> String {
    let name = methods[k].name();
    match methods[..k].iter().filter(|method| method.name() == name).count() {
        0 => name.to_owned(),
        again => format!("{name}{}", again + 1),
    }
}

/// Draws film thickness, traction and pressure over the last varied quantity, with one line for each method and each
/// combination of the other quantities. Failed solves are left out.
pub(super) fn charts(x: &ChartAxis, varied: &[String], methods: &[Method], rows: &[&PathRow]) -> Vec<Chart> {
    let chart = |(name, axis): (&str, &str)| {
        let mut chart = Chart::new(axis, x.clone(), ChartAxis::linear(axis));
        chart.quantities = varied.last().map(|along| [along.clone(), name.to_owned()]);
        for k in 0..methods.len() {
            for rows in rows.chunk_by(|a, b| others(a) == others(b)) {
                let point = |row: &&PathRow| {
                    let value = row.results().get(k)?.value(name)?;
                    Some([*row.values.last()?, value])
                };
                let fixed = varied.iter().zip(others(rows[0])).map(|(name, value)| format!(", {name} {value}"));
                let title: String = std::iter::once(tag(methods, k)).chain(fixed).collect();
                chart.add(title, Marks::Line, rows.iter().filter_map(point));
            }
        }
        chart
    };
    let results = rows.iter().flat_map(|row| row.results());
    let slides = results.into_iter().any(|result| result.point.sliding.slide_to_roll_ratio != 0.0);
    let quantities = [
        (names::H_C, "Central film thickness H_c"),
        (names::H_MIN, "Minimum film thickness H_min"),
        (names::P_MAX, "Maximum pressure P_max"),
        (names::TRACTION, "Traction coefficient"),
        (names::MID_FILM_RISE, "Temperature rise at mid-film, X = 0 [K]"),
        (names::SURFACE_1_RISE, "Temperature rise of body 1, X = 0 [K]"),
        (names::SURFACE_2_RISE, "Temperature rise of body 2, X = 0 [K]"),
    ];
    let warm = has_heat(rows);
    let shown = |name: &str| match name {
        names::TRACTION => slides,
        name => warm || !name.starts_with("heat."),
    };
    quantities.into_iter().filter(|(name, _)| shown(name)).map(chart).collect()
}

fn has_heat(rows: &[&PathRow]) -> bool {
    rows.iter().flat_map(|row| row.results()).any(|result| result.heat.is_some())
}

/// Returns the values of all varied quantities except the last.
fn others(row: &PathRow) -> &[f64] {
    row.values.split_last().map_or(&[], |(_, others)| others)
}
