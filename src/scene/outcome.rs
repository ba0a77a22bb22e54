//! Outcome of a scene: values by name and method, verdicts, tables.

use super::atomic_file::{self, WriteError};
use super::expectation::Expectation;
use super::method::Method;
use super::notice::Notice;
use super::statistics::{median, percentile};
use super::table::Table;
use crate::solver::warning::{Repeated, Warning};
use serde_json::{Value, json};
use std::path::Path;

/// Value with its name and the method that computed it.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedValue {
    /// Name, as expectations use it.
    pub name: String,
    /// The method, if the value belongs to one.
    pub method: Option<Method>,
    /// The value.
    pub value: f64,
}

/// Result of checking one expectation.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The expectation.
    pub expected: Expectation,
    /// Computed value; `None` if the scene has no such value.
    pub value: Option<f64>,
    /// True if the expectation is met.
    pub holds: bool,
}

/// Evaluation of the rows of a study: values, convergence, warnings.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// All values.
    pub values: Vec<NamedValue>,
    /// True if every solve that should converge did so.
    pub converged: bool,
    /// Warnings and remarks.
    pub warnings: Vec<Notice>,
}

/// Outcome of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneOutcome {
    /// The scene's title.
    pub title: String,
    /// The scene's source.
    pub source: String,
    /// Time of the whole run \[s\].
    pub wall_s: f64,
    /// True if the scene accepts solves that do not converge.
    pub failures_expected: bool,
    /// Values and warnings found in the rows.
    pub found: Findings,
    /// Verdict on each expectation.
    pub verdicts: Vec<Verdict>,
    /// Tables of the study.
    pub tables: Vec<Table>,
}

impl Default for Findings {
    fn default() -> Self {
        Self { values: Vec::new(), converged: true, warnings: Vec::new() }
    }
}

impl Findings {
    pub(super) fn push(&mut self, name: impl Into<String>, method: Option<&Method>, value: f64) {
        self.values.push(NamedValue { name: name.into(), method: method.cloned(), value });
    }

    /// Adds warnings about a part of the study, or about the whole study if `part` is empty.
    pub(super) fn warn(&mut self, part: &str, warnings: impl IntoIterator<Item = Warning>) {
        let of_part = |warning| Notice::Warning { part: part.to_owned(), warning };
        self.warnings.extend(warnings.into_iter().map(of_part));
    }

    /// Adds kinds of warnings that apply to several results of a part.
    pub(super) fn warn_repeated(&mut self, part: &str, kinds: impl IntoIterator<Item = Repeated>) {
        let of_part = |repeated| Notice::Repeated { part: part.to_owned(), repeated };
        self.warnings.extend(kinds.into_iter().map(of_part));
    }

    /// Adds median, 95th percentile and maximum of a quantity, as `name_median`, `name_p95` and `name_max`.
    pub(super) fn push_spread(&mut self, name: &str, method: Option<&Method>, values: &[f64]) {
        self.push(format!("{name}_median"), method, median(values));
        self.push(format!("{name}_p95"), method, percentile(values, 0.95));
        self.push(format!("{name}_max"), method, percentile(values, 1.0));
    }

    /// Adds statistics of the Newton steps and times of single solves.
    pub(super) fn push_effort(&mut self, method: Option<&Method>, newton: &[f64], seconds: &[f64]) {
        self.push("newton_median", method, median(newton));
        self.push("newton_max", method, percentile(newton, 1.0));
        self.push("median_s", method, median(seconds));
        self.push("p99_s", method, percentile(seconds, 0.99));
    }

    /// Adds how often calibrated error bounds hold, in per cent, and the median overestimation. `ratios` are bound over
    /// true error.
    pub(super) fn push_bounds(&mut self, name: &str, method: Option<&Method>, ratios: &[f64]) {
        let held = ratios.iter().filter(|ratio| **ratio >= 1.0).count();
        self.push(format!("{name}.holds_percent"), method, 100.0 * held as f64 / ratios.len() as f64);
        self.push(format!("{name}.over_error_median"), method, median(ratios));
    }

    /// Returns the value with this name: of the given method, or else the first one with the name.
    pub fn value(&self, name: &str, method: Option<&Method>) -> Option<f64> {
        let fits = |v: &&NamedValue| v.name == name && method.is_none_or(|m| v.method.as_ref() == Some(m));
        self.values.iter().find(fits).map(|v| v.value)
    }

    /// Checks the expectations against the values.
    pub fn verdicts(&self, expected: &[Expectation]) -> Vec<Verdict> {
        let verdict = |expected: &Expectation| {
            let value = self.value(&expected.name, expected.method.as_ref());
            let holds = value.is_some_and(|answer| expected.within.holds(expected.value, answer));
            Verdict { expected: expected.clone(), value, holds }
        };
        expected.iter().map(verdict).collect()
    }
}

impl SceneOutcome {
    /// Returns true if all expectations are met and every solve converged, or if the scene accepts solves that do not
    /// converge.
    pub fn passed(&self) -> bool {
        self.verdicts.iter().all(|verdict| verdict.holds) && (self.found.converged || self.failures_expected)
    }

    /// Writes the outcome (JSON) and its tables (CSV) into a folder, with a common file name.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, folder: &Path, name: &str) -> Result<(), WriteError> {
        let path = folder.join(format!("{name}.json"));
        let text = serde_json::to_string_pretty(&self.to_json());
        let text = text.map_err(|error| WriteError { path: path.clone(), reason: error.into() })? + "\n";
        atomic_file::replace(&path, text.as_bytes())?;
        for table in &self.tables {
            atomic_file::replace(&folder.join(format!("{name}.{}.csv", table.name)), table.to_csv().as_bytes())?;
        }
        Ok(())
    }

    /// Returns the object printed by `run --json`.
    pub fn to_json(&self) -> Value {
        let number = |value: f64| if value.is_finite() { json!(value) } else { Value::Null };
        let with_method = |mut object: Value, method: &Option<Method>| {
            if let (Some(fields), Some(method)) = (object.as_object_mut(), method) {
                fields.insert("method".to_owned(), json!(method.name()));
            }
            object
        };
        let expectations: Vec<Value> = self
            .verdicts
            .iter()
            .map(|Verdict { expected, value, holds }| {
                let verdict = if *holds { "ok" } else { "short" };
                let (value, wanted) = (value.map_or(Value::Null, number), expected.wanted());
                let (name, from) = (&expected.name, &expected.from);
                let object = json!({"name": name, "value": value, "wanted": wanted, "verdict": verdict, "from": from});
                with_method(object, &expected.method)
            })
            .collect();
        let values: Vec<Value> = self
            .found
            .values
            .iter()
            .map(|v| with_method(json!({"name": v.name, "value": number(v.value)}), &v.method))
            .collect();
        let mut object = json!({
            "title": self.title, "source": self.source, "wall_s": self.wall_s, "converged": self.found.converged,
            "passed": self.passed(), "expectations": expectations, "values": values,
        });
        if let (Some(fields), false) = (object.as_object_mut(), self.found.warnings.is_empty()) {
            let texts: Vec<String> = self.found.warnings.iter().map(ToString::to_string).collect();
            fields.insert("warning".to_owned(), json!(texts.join("; ")));
            fields.insert("warnings".to_owned(), self.found.warnings.iter().map(Notice::to_json).collect());
        }
        object
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Within;

    #[test]
    fn a_solve_that_failed_counts_unless_failures_are_expected() {
        let good = SceneOutcome::default();
        let (name, from, within) = ("H_c".to_owned(), String::new(), Within::AtLeast(0.0));
        let expected = Expectation { name, method: None, value: None, within, from };
        let verdict = |holds| Verdict { expected: expected.clone(), value: Some(1.0), holds };
        let found = Findings { converged: false, ..Findings::default() };
        let failed = SceneOutcome { found, verdicts: vec![verdict(true)], ..good.clone() };
        assert!(good.passed() && !failed.passed());
        assert!(SceneOutcome { failures_expected: true, ..failed.clone() }.passed());
        assert!(!SceneOutcome { failures_expected: true, verdicts: vec![verdict(false)], ..failed }.passed());
    }
}
