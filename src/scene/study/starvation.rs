//! Starvation study: film thickness of the contact over the inlet film thickness.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::Request;
use crate::scene::check::{count, number, refuse};
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::full::Solution;
use crate::solver::physics::lubricant::{Cavitation, Lubricant};
use crate::solver::warning::Warning;
use serde::{Deserialize, Serialize};

/// The contact with inlet film thicknesses that are r times the film thickness drawn in by the flooded contact. The
/// latter is the central film thickness times the density ratio. Cavitation is mass-conserving.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Starvation {
    /// Ratios r.
    pub ratios: Vec<f64>,
}

/// Columns: r, inlet film thickness, film thickness over the flooded one, position of the meniscus, Newton steps.
const COLUMNS: [&str; 5] = ["r", names::SUPPLY_FILM, "film_ratio", names::X_MENISCUS, names::NEWTON_ITERATIONS];

/// Result for one inlet film thickness.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Ratio r.
    pub ratio: f64,
    /// Inlet film thickness \[m\].
    pub supply_m: f64,
    /// H_c over that of the flooded contact; `None` if the solve failed.
    pub film: Option<f64>,
    /// X of the meniscus on the axis; `None` if the inlet is fully flooded.
    pub meniscus: Option<f64>,
    /// Number of Newton steps.
    pub newton_iterations: usize,
    /// Warnings.
    pub warnings: Vec<Warning>,
}

/// Starvation law h_c/h_cff = r/(1 + r^γ)^(1/γ) by Chevalier, Lubrecht, Cann, Colin and Dalmaz 1998.
fn law(ratio: f64, exponent: f64) -> f64 {
    ratio / (1.0 + ratio.powf(exponent)).powf(1.0 / exponent)
}

/// Returns the γ for which the largest deviation of the law is smallest, and this deviation.
fn fitted(films: &[[f64; 2]]) -> (f64, f64) {
    let miss = |exponent: f64| films.iter().map(|[r, film]| (law(*r, exponent) - film).abs()).fold(0.0, f64::max);
    let exponents = (100..=5000).map(|hundredths| 0.01 * f64::from(hundredths));
    let best = exponents.min_by(|a, b| miss(*a).total_cmp(&miss(*b))).unwrap_or(f64::NAN);
    (best, miss(best))
}

/// Returns (r, film thickness ratio) of the solved rows.
fn films(rows: &[&Row]) -> Vec<[f64; 2]> {
    rows.iter().filter_map(|row| Some([row.ratio, row.film?])).collect()
}

impl Question for Starvation {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        if experiment.lubricant.cavitation.supply_film_m().is_some() {
            return Err(refuse("cavitation", "sets an inlet film thickness, which this study varies; leave it out"));
        }
        count("study.ratios (how many)", self.ratios.len(), 1, 200)?;
        self.ratios.iter().try_for_each(|&ratio| number("study.ratios", ratio, 0.01, 100.0))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let request = setting.experiment.request()?;
        let mut solved = |supply_film_m: Option<f64>, step: usize| {
            setting.step("supplies", step, self.ratios.len() + 1)?;
            let lubricant = Lubricant { cavitation: Cavitation::MassConserving { supply_film_m }, ..request.lubricant };
            let request = Request { lubricant, ..request.clone() };
            setting.bench.answer(&request, None, setting.observer)
        };
        let flooded = solved(None, 0)?;
        let Some(full) = flooded.fields() else { return Ok(()) };
        let scalars = full.scalars;
        let drawn_m = scalars.h_c * full.problem.fluid.at(scalars.p_c).density * full.problem.point.film_scale_m();
        for (i, &ratio) in self.ratios.iter().enumerate() {
            let supply_m = ratio * drawn_m;
            let answer = solved(Some(supply_m), i + 1)?;
            let fields = answer.fields();
            tell(Row {
                ratio,
                supply_m,
                film: fields.map(|solution| solution.scalars.h_c / scalars.h_c),
                meniscus: fields.and_then(Solution::meniscus),
                newton_iterations: answer.result.newton_iterations,
                warnings: answer.result.warnings.clone(),
            });
        }
        Ok(())
    }

    /// Values: `failures`, `gamma` and `law_error_max` (of the published law with this γ), and `film_0`, `film_1` …,
    /// film thickness over the flooded one, in the order of the ratios.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let of = Some(&Method::Full);
        let failures = self.ratios.len() - films(rows).len().min(self.ratios.len());
        found.converged &= failures == 0;
        found.push("failures", of, failures as f64);
        let (gamma, miss) = fitted(&films(rows));
        found.push("gamma", of, gamma);
        found.push("law_error_max", of, miss);
        found.warn_repeated("", Warning::summary(rows.iter().map(|row| &row.warnings[..])));
        for (k, row) in rows.iter().enumerate() {
            found.push(format!("film_{k}"), of, row.film.unwrap_or(f64::NAN));
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("starvation", &COLUMNS);
        table.rows.extend(rows.iter().map(|row| {
            let [film, meniscus] = [row.film, row.meniscus].map(|value| value.unwrap_or(f64::NAN));
            vec![row.ratio, row.supply_m, film, meniscus, row.newton_iterations as f64]
        }));
        vec![table.with_warnings(rows.iter().map(|row| &row.warnings[..]))]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let mut chart = Chart::new(
            "Film thickness relative to the flooded contact",
            ChartAxis::log("Inlet film thickness ratio r"),
            ChartAxis::linear("h_c/h_c,flooded"),
        );
        let films = films(rows);
        if films.len() > 1 {
            let (gamma, _) = fitted(&films);
            let ends = films.iter().fold([f64::INFINITY, 0.0], |[a, b], [r, _]| [r.min(a), r.max(b)]);
            let at = (0..=100).map(|k| ends[0] * (ends[1] / ends[0]).powf(0.01 * f64::from(k)));
            chart.add(format!("law with γ = {gamma:.2}"), Marks::Line, at.map(|r| [r, law(r, gamma)]));
        }
        chart.add("full", Marks::Dots, films);
        let mut menisci = Chart::new(
            "Meniscus",
            ChartAxis::log("Inlet film thickness ratio r"),
            ChartAxis::linear("X of the meniscus"),
        );
        menisci.add("full", Marks::Line, rows.iter().filter_map(|row| Some([row.ratio, row.meniscus?])));
        vec![chart, menisci]
    }
}
