//! Formula comparison: full solutions and a published film-thickness formula.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::at::At;
use crate::scene::check::{count, number, refuse};
use crate::scene::method::Method;
use crate::scene::names;
use crate::scene::statistics::median;
use crate::solver::full::Solution;
use crate::solver::physics::contact::{FilmFormula, OperatingPoint};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// Full solutions compared with a published film-thickness formula at all pairs of M and L in the default realisation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FormulaComparison {
    /// The formula.
    pub formula: FilmFormula,
    /// Load numbers.
    pub m: Vec<f64>,
    /// Lubricant numbers.
    pub l: Vec<f64>,
}

/// Result at one contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Load number.
    pub m: f64,
    /// Lubricant number.
    pub l: f64,
    /// Film thickness of the full solution \[m\], central or minimum as predicted by the formula; `None` if the solve
    /// failed.
    pub full_m: Option<f64>,
    /// Film thickness by the formula \[m\].
    pub formula_m: f64,
    /// True if the contact is in the range of the formula.
    pub in_range: bool,
    /// Warnings about the full solution.
    pub warnings: Vec<Warning>,
}

impl Row {
    /// Returns the full solution over the formula, minus 1.
    pub fn deviation(&self) -> f64 {
        self.full_m.unwrap_or(f64::NAN) / self.formula_m - 1.0
    }
}

impl Question for FormulaComparison {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        let wanted = self.formula.contact();
        if wanted != experiment.contact {
            let (wanted, contact) = (wanted.name(), experiment.contact.name());
            let problem = format!("is made for {wanted} contacts, but the scene's is a {contact} contact");
            return Err(refuse("study.formula", problem));
        }
        count("study.m (how many)", self.m.len(), 1, 1000)?;
        count("study.l (how many)", self.l.len(), 1, 1000)?;
        self.m.iter().try_for_each(|&m| number("study.m", m, 0.05, 1e5))?;
        self.l.iter().try_for_each(|&l| number("study.l", l, 1e-3, 1e3))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let mut former: Option<Solution> = None;
        let all = self.l.iter().flat_map(|&l| self.m.iter().map(move |&m| (m, l)));
        for (i, (m, l)) in all.enumerate() {
            setting.step("formula comparison", i, self.l.len() * self.m.len())?;
            let point = At::moes(m, l).point(experiment.contact)?;
            let request = experiment.request_at(OperatingPoint { sliding: experiment.sliding, ..point });
            let answer = setting.bench.answer(&request, former.as_ref(), observer)?;
            let full_m = answer.fields().map(|solution| {
                let s = &solution.scalars;
                point.film_scale_m() * if self.formula.predicts_minimum() { s.h_min } else { s.h_c }
            });
            let predicted = self.formula.predict(&point);
            let warnings = answer.result.warnings.clone();
            tell(Row { m, l, full_m, formula_m: predicted.film_m, in_range: predicted.in_range, warnings });
            former = answer.into_fields().or(former);
        }
        Ok(())
    }

    /// Values: `failures`, `deviation_median`, `deviation_max` (relative deviation of the full solution from the
    /// formula).
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let of = Some(&Method::Full);
        let failures = rows.iter().filter(|row| row.full_m.is_none()).count();
        let deviations: Vec<f64> = rows.iter().map(|row| row.deviation().abs()).filter(|d| d.is_finite()).collect();
        found.converged &= failures == 0;
        found.push("failures", of, failures as f64);
        found.warn_repeated("", Warning::summary(rows.iter().map(|row| &row.warnings[..])));
        found.push("deviation_median", of, median(&deviations));
        found.push("deviation_max", of, deviations.iter().copied().fold(f64::NAN, f64::max));
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table =
            Table::new("formula", &[names::M, names::L, "h_full_m", "h_formula_m", "deviation", "in_range"]);
        table.rows.extend(rows.iter().map(|row| {
            let in_range = f64::from(u8::from(row.in_range));
            vec![row.m, row.l, row.full_m.unwrap_or(f64::NAN), row.formula_m, row.deviation(), in_range]
        }));
        vec![table.with_warnings(rows.iter().map(|row| &row.warnings[..]))]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let x = ChartAxis::log("Load number M");
        let mut films = Chart::new("Film", x.clone(), ChartAxis::log("h [m]"));
        let mut deviations = Chart::new("Full solution over formula, less 1", x, ChartAxis::linear("Deviation"));
        for rows in rows.chunk_by(|a, b| a.l == b.l) {
            let l = rows[0].l;
            films.add(format!("formula, L {l}"), Marks::Line, rows.iter().map(|row| [row.m, row.formula_m]));
            let full = rows.iter().filter_map(|row| Some([row.m, row.full_m?]));
            films.add(format!("full, L {l}"), Marks::Dots, full);
            deviations.add(format!("L {l}"), Marks::Line, rows.iter().map(|row| [row.m, row.deviation()]));
        }
        vec![films, deviations]
    }
}
