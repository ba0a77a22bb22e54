//! Point study: the contact, solved by one or several methods.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::{Answer, Request};
use crate::scene::check;
use crate::scene::field_tables::profile_table;
use crate::scene::method::Method;
use crate::solver::full::Solution;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The contact, solved by one or several methods.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Methods by which it is solved.
    pub methods: Vec<Method>,
}

/// Answer of one method.
pub type Row = Arc<Answer>;

impl Question for Point {
    type Row = Row;

    fn check(&self, _experiment: &Experiment) -> Checked {
        check::methods("study.methods", &self.methods)
    }

    fn methods(&self) -> &[Method] {
        &self.methods
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let request = setting.experiment.request()?;
        for (i, method) in self.methods.iter().enumerate() {
            setting.step("solving", i, self.methods.len())?;
            let request = Request { method: method.clone(), ..request.clone() };
            tell(Arc::new(setting.bench.answer(&request, None, setting.observer)?));
        }
        Ok(())
    }

    /// Values: every number of each method's result, and `H_c_error` of a reduced method relative to the full one.
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            let (method, result) = (&row.request.method, &row.result);
            result.values().into_iter().for_each(|(name, value)| found.push(name, Some(method), value));
            found.warn(method.name(), result.warnings.iter().cloned());
            found.converged &= result.converged;
        }
        let h_c = |row: &Row| row.result.scalars.map(|scalars| scalars.h_c);
        let Some(full) = rows.iter().find(|row| row.request.method == Method::Full).and_then(|row| h_c(row)) else {
            return;
        };
        for row in rows.iter().filter(|row| row.result.reduced.is_some()) {
            if let Some(reduced) = h_c(row) {
                found.push("H_c_error", Some(&row.request.method), (reduced / full - 1.0).abs());
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let table = |(i, row): (usize, &&Row)| {
            let suffix = if i == 0 { String::new() } else { format!("_{i}") };
            Some(profile_table(format!("profile_{}{suffix}", row.request.method.name()), row.fields()?))
        };
        rows.iter().enumerate().filter_map(table).collect()
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let x = ChartAxis::linear("X = x/a");
        let mut pressure = Chart::new("Pressure along Y = 0", x.clone(), ChartAxis::linear("P = p/p_H"));
        let mut film = Chart::new("Film thickness along Y = 0", x, ChartAxis::linear("H = h R/a²"));
        for row in rows {
            let Some(solution) = row.fields() else { continue };
            pressure.add(row.request.method.name(), Marks::Line, solution.profile().map(|(x, p, _)| [x, p]));
            film.add(row.request.method.name(), Marks::Line, solution.profile().map(|(x, _, h)| [x, h]));
        }
        let sets = rows.iter().filter_map(|row| sets(row.fields()?));
        [pressure, film].into_iter().chain(sets).collect()
    }
}

/// Number of nodes before the cavitation boundary that the reduced method of appendix D monitors.
const WATCHED: usize = 5;

/// Draws the cavitated nodes of a point contact, the first cavitated node on each line along X, and the nodes before it
/// (Fig. D.2). `None` for the penalty model, which does not define a set of cavitated nodes.
fn sets(solution: &Solution) -> Option<Chart> {
    let (x, y) = (&solution.x, &solution.y);
    if solution.multiplier.is_empty() || y.len() < 2 {
        return None;
    }
    let mut chart = Chart::new("Cavitated nodes", ChartAxis::linear("X = x/a"), ChartAxis::linear("Y = y/a"));
    chart.equal = true;
    let (mut ruptured, mut front, mut before) = (Vec::new(), Vec::new(), Vec::new());
    for (j, &across) in y.iter().enumerate().skip(1) {
        let held = |i: &usize| solution.pressure[i * y.len() + j] == 0.0 && x[*i] > 0.0;
        let Some(first) = (1..x.len() - 1).find(held) else { continue };
        front.push([x[first], across]);
        ruptured.extend((first + 1..x.len() - 1).map(|i| [x[i], across]));
        before.extend((first.saturating_sub(WATCHED)..first).map(|i| [x[i], across]));
    }
    chart.add("A: cavitated", Marks::Dots, ruptured);
    chart.add("B: first cavitated nodes", Marks::Dots, front);
    chart.add("Q: five nodes before B", Marks::Dots, before);
    Some(chart)
}
