//! Load-case study: a table with one contact per line, each solved from a cold start as if it were alone.

use super::path::tag;
use super::question::{
    Chart, ChartAxis, Checked, Divisible, Experiment, Findings, Marks, Notice, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::Request;
use crate::scene::bench::answer_or_full;
use crate::scene::check;
use crate::scene::contact_result::{ContactResult, contact_columns, result_columns};
use crate::scene::contact_row::{ByMethods, RefusedContact, remarks};
use crate::scene::extras::Extras;
use crate::scene::load_cases::{CaseTable, LoadCase};
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Number of refused lines that are named in warnings. The table names all of them.
const NAMED: usize = 20;

/// Table of load cases. Quantities that are missing in the table are those of the scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LoadCases {
    /// The table.
    pub cases: CaseTable,
    /// Methods by which each line is solved.
    pub methods: Vec<Method>,
}

/// Result of one line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Line number, from 1.
    pub line: usize,
    /// Name; may be empty.
    pub name: String,
    /// Measured central film thickness \[m\].
    #[serde(default)]
    pub measured_m: Option<f64>,
    /// Results by each method, or the reason why the line is refused.
    pub results: ByMethods,
}

impl Row {
    fn results(&self) -> &[ContactResult] {
        self.results.as_ref().map_or(&[], Vec::as_slice)
    }

    /// Returns the relative deviation of the k-th method's central film thickness from the measured one.
    fn deviation(&self, k: usize) -> Option<f64> {
        Some(self.results().get(k)?.value(names::H_C_M)? / self.measured_m? - 1.0)
    }
}

impl LoadCases {
    fn read(&self, setting: &Setting<'_>) -> Result<Vec<LoadCase>, RunError> {
        Ok(self.cases.cases(setting.experiment, &|path| setting.bench.resolve(path))?)
    }

    fn solve_all(&self, cases: Vec<LoadCase>, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let total = cases.len();
        for (i, LoadCase { line, name, measured_m, request }) in cases.into_iter().enumerate() {
            setting.step("load cases", i, total)?;
            // Drop starting values, so that a line's result does not depend on the lines above it.
            setting.bench.forget();
            let results = match request {
                Ok(request) => self.solve(setting, &request)?,
                Err(why) => Err(RefusedContact::of(&why)),
            };
            tell(Row { line, name, measured_m, results });
        }
        Ok(())
    }

    /// Solves one contact by each method, or returns the reason why it is refused.
    fn solve(&self, setting: &mut Setting<'_>, request: &Request) -> Result<ByMethods, RunError> {
        let mut results = Vec::with_capacity(self.methods.len());
        for method in &self.methods {
            let request = Request { method: method.clone(), ..request.clone() };
            match answer_or_full(setting.bench, &request, setting.observer) {
                Ok(answer) => results.push(answer.result),
                Err(stopped) if stopped.cancelled() => return Err(stopped),
                Err(refused) => return Ok(Err(RefusedContact::of(&refused))),
            }
        }
        Ok(Ok(results))
    }
}

/// Each piece is one line of the table.
impl Divisible for LoadCases {
    fn pieces(&self, setting: &mut Setting<'_>, round: usize, _: &[&Row]) -> Result<Vec<usize>, RunError> {
        Ok(if round == 0 { (0..self.read(setting)?.len()).collect() } else { Vec::new() })
    }

    fn work(
        &self,
        setting: &mut Setting<'_>,
        _: usize,
        pieces: &[usize],
        tell: &Tell<'_, Row>,
    ) -> Result<(), RunError> {
        let cases = self.read(setting)?;
        let chosen = pieces.iter().filter_map(|piece| cases.get(*piece).cloned()).collect();
        self.solve_all(chosen, setting, tell)
    }

    fn seconds(row: &mut Row) -> Vec<&mut f64> {
        row.results.iter_mut().flatten().map(|result| &mut result.wall_s).collect()
    }

    fn methods_mut(&mut self) -> &mut [Method] {
        &mut self.methods
    }
}

impl Question for LoadCases {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        check::methods("study.methods", &self.methods)?;
        match &self.cases {
            // A file is read only when the study runs, so that a scene can be written before its table.
            CaseTable::File(_) => Ok(()),
            CaseTable::Text(_) => {
                let read = self.cases.cases(experiment, &|path| path.to_owned());
                read.map(drop).map_err(|error| check::refuse("study.cases", format!("are refused: {error}")))
            }
        }
    }

    fn methods(&self) -> &[Method] {
        &self.methods
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let cases = self.read(setting)?;
        self.solve_all(cases, setting, tell)
    }

    /// Values: `cases`, `refused`; for each method `failures`; for each reduced method also `untrained`, the number of
    /// contacts outside the trained range, and `H_c_error` relative to the first full method. If the table has measured film
    /// thicknesses, `deviation_mean` is the mean deviation of h_c from them, and `deviation` are its amounts. A value of the
    /// first method for a named line has the name of the line, as `shaft.hertz.p_h_pa`.
    fn findings(&self, experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for name in &experiment.expected {
            let of_line = |row: &&&Row| !row.name.is_empty() && name.starts_with(&format!("{}.", row.name));
            let value =
                rows.iter().find(of_line).and_then(|row| row.results().first()?.value(&name[row.name.len() + 1..]));
            value.into_iter().for_each(|value| found.push(name.clone(), None, value));
        }
        let refused = || rows.iter().filter(|row| row.results.is_err());
        found.push("cases", None, rows.len() as f64);
        found.push("refused", None, refused().count() as f64);
        found.converged &= refused().count() == 0;
        found.warnings.extend(refused().take(NAMED).map(|row| {
            let name = if row.name.is_empty() { String::new() } else { format!(" ({})", row.name) };
            let why = row.results.as_ref().err().map_or_else(String::new, ToString::to_string);
            Notice::Sentence(format!("line {}{name}: {why}", row.line))
        }));
        if refused().count() > NAMED {
            let more = format!("{} more lines are refused; the table names them", refused().count() - NAMED);
            found.warnings.push(more.into());
        }
        let full = self.methods.iter().position(|method| *method == Method::Full);
        for (k, method) in self.methods.iter().enumerate() {
            let of = Some(method);
            let warnings = Warning::summary(rows.iter().filter_map(|row| Some(&row.results().get(k)?.warnings[..])));
            found.warn_repeated(&tag(&self.methods, k), warnings);
            let failures = rows.iter().filter_map(|row| row.results().get(k)).filter(|r| !r.converged).count();
            found.converged &= failures == 0;
            found.push("failures", of, failures as f64);
            let deviations: Vec<f64> = rows.iter().filter_map(|row| row.deviation(k)).collect();
            if !deviations.is_empty() {
                let amounts: Vec<f64> = deviations.iter().map(|deviation| deviation.abs()).collect();
                found.push("deviation_mean", of, deviations.iter().sum::<f64>() / deviations.len() as f64);
                found.push_spread("deviation", of, &amounts);
            }
            if method.model().is_none() {
                continue;
            }
            let untrained = rows.iter().filter_map(|row| row.results().get(k)).filter(|r| r.untrained()).count();
            found.push("untrained", of, untrained as f64);
            let Some(full) = full else { continue };
            let error = |row: &&Row| {
                let h_c = |k: usize| row.results().get(k)?.value(names::H_C);
                Some((h_c(k)? / h_c(full)? - 1.0).abs())
            };
            let errors: Vec<f64> = rows.iter().filter_map(error).collect();
            found.push_spread("H_c_error", of, &errors);
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let extras = Extras::of_results(rows.iter().flat_map(|row| row.results()));
        let (of_contact, of_result) = (contact_columns(), result_columns(extras));
        let results = (0..self.methods.len()).map(|k| tag(&self.methods, k));
        let results = results.flat_map(|tag| of_result.iter().map(move |column| names::by(&tag, column)));
        let measured = rows.iter().any(|row| row.measured_m.is_some()).then_some(&"measured_h_c_m");
        let first = std::iter::once(&"line").chain(measured).chain(&of_contact);
        let columns: Vec<String> = first.map(|&column| column.to_owned()).chain(results).collect();
        let numbers = |row: &&Row| -> Vec<f64> {
            let film = measured.map(|_| row.measured_m.unwrap_or(f64::NAN));
            let line = std::iter::once(row.line as f64).chain(film);
            let Some(first) = row.results().first() else {
                return line.chain(std::iter::repeat(f64::NAN)).take(columns.len()).collect();
            };
            let results = row.results().iter().flat_map(|result| result.row(&of_result));
            line.chain(first.row(&of_contact)).chain(results).collect()
        };
        let named = rows.iter().any(|row| !row.name.is_empty());
        vec![Table {
            name: "load_cases".to_owned(),
            rows: rows.iter().map(numbers).collect(),
            labels: rows.iter().filter(|_| named).map(|row| row.name.clone()).collect(),
            remarks: remarks(rows.iter().map(|row| &row.results)),
            columns,
        }]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let chart = |(name, title, factor): (&str, &str, f64)| {
            let mut chart = Chart::new(title, ChartAxis::linear("Line of the table"), ChartAxis::linear(title));
            for k in 0..self.methods.len() {
                let point = |row: &&Row| Some([row.line as f64, factor * row.results().get(k)?.value(name)?]);
                let marks = if k == 0 { Marks::Line } else { Marks::Dots };
                chart.add(tag(&self.methods, k), marks, rows.iter().filter_map(point));
            }
            let measured = |row: &&Row| Some([row.line as f64, factor * row.measured_m?]);
            if name == names::H_C_M && rows.iter().any(|row| row.measured_m.is_some()) {
                chart.add("measured", Marks::Dots, rows.iter().filter_map(measured));
            }
            chart
        };
        [
            (names::H_C_M, "Central film thickness h_c [µm]", 1e6),
            (names::H_MIN_M, "Minimum film thickness h_min [µm]", 1e6),
            (names::TRACTION, "Traction coefficient", 1.0),
        ]
        .map(chart)
        .into()
    }
}
