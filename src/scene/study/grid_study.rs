//! Grid study: observed order of convergence of H_c, central film thickness, and its extrapolated value.

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use crate::scene::answer::Request;
use crate::scene::check::{count, number, refuse};
use crate::scene::contact_result::ContactResult;
use crate::scene::grid::Grid;
use crate::scene::method::Method;
use crate::scene::names;
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::Solution;
use serde::{Deserialize, Serialize};

/// The contact on a sequence of finer uniform grids over the scene's domain: observed order and extrapolated value. For
/// a point contact, ΔY is constant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GridStudy {
    /// Spacings ΔX in descending order with a constant ratio; at least three.
    pub dx: Vec<f64>,
}

/// Columns: spacing and nodes of the grid, and compared results.
const COLUMNS: [&str; 7] =
    ["dx", "nodes", names::H_C, names::H_MIN, names::P_C, names::NEWTON_ITERATIONS, names::WALL_S];

/// Result on one grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Spacing ΔX.
    pub dx: f64,
    /// Full solution on the grid.
    pub result: ContactResult,
}

impl Row {
    fn h_c(&self) -> f64 {
        self.result.scalars.map_or(f64::NAN, |scalars| scalars.h_c)
    }
}

impl GridStudy {
    fn ratio(&self) -> f64 {
        self.dx[0] / self.dx[1]
    }

    /// Returns Richardson's extrapolation of H_c from the two finest grids.
    fn limit(&self, rows: &[&Row]) -> Option<f64> {
        let [.., coarse, fine] = rows else { return None };
        Some(fine.h_c() + (fine.h_c() - coarse.h_c()) / (self.ratio().powi(2) - 1.0))
    }
}

impl Question for GridStudy {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        let dx = &self.dx;
        count("study.dx (how many)", dx.len(), 3, 12)?;
        dx.iter().try_for_each(|&dx| number("study.dx", dx, 1e-4, 0.2))?;
        let ratio = self.ratio();
        if !(ratio > 1.05 && dx.windows(2).all(|w| (w[0] / w[1] / ratio - 1.0).abs() < 1e-6)) {
            return Err(refuse("study.dx", "must fall by one constant factor, as 0.02, 0.01, 0.005 do"));
        }
        match experiment.grid {
            Grid::Uniform { .. } | Grid::Plane(_) => Ok(()),
            _ => Err(refuse("grid", "must be Uniform or Plane for a grid study, which takes its domain from it")),
        }
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let template = setting.experiment.request()?;
        let mut former: Option<Solution> = None;
        for (i, &dx) in self.dx.iter().enumerate() {
            setting.step("grids", i, self.dx.len())?;
            let grid = match setting.experiment.grid {
                Grid::Uniform { domain, .. } => Grid::Uniform { dx, domain },
                Grid::Plane(spec) => Grid::Plane(PointGridSpec { dx, ..spec }),
                _ => return Err(RunError::Study("a grid study needs a Uniform or Plane `grid`".to_owned())),
            };
            let request = Request { grid, ..template.clone() };
            let answer = setting.bench.answer(&request, former.as_ref(), setting.observer)?;
            tell(Row { dx, result: answer.result.clone() });
            former = answer.into_fields();
        }
        Ok(())
    }

    /// Values: `H_c.1`, … (coarsest first), `order` (from the three finest grids), `order.1`, … (from each three
    /// neighbours, coarsest first), `H_c_extrapolated` (Richardson, from the two finest), `H_c_error` (relative, of the
    /// finest).
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        let of = Some(&Method::Full);
        for row in rows {
            found.warn(&format!("dx {}", row.dx), row.result.warnings.iter().cloned());
            found.converged &= row.result.converged;
        }
        for (i, row) in rows.iter().enumerate() {
            found.push(format!("H_c.{}", i + 1), of, row.h_c());
        }
        let mut order = f64::NAN;
        for (i, rows) in rows.windows(3).enumerate() {
            let h = [0, 1, 2].map(|k| rows[k].h_c());
            order = ((h[0] - h[1]) / (h[1] - h[2])).ln() / self.ratio().ln();
            found.push(format!("order.{}", i + 1), of, order);
        }
        found.push("order", of, order);
        if let (Some(limit), Some(finest)) = (self.limit(rows), rows.last()) {
            found.push("H_c_extrapolated", of, limit);
            found.push("H_c_error", of, (finest.h_c() / limit - 1.0).abs());
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("grids", &COLUMNS);
        table.rows.extend(rows.iter().map(|Row { dx, result }| {
            let nodes = (result.nodes.0 * result.nodes.1) as f64;
            let scalars = result.scalars.map_or([f64::NAN; 3], |s| [s.h_c, s.h_min, s.p_c]);
            let effort = [result.newton_iterations as f64, result.wall_s];
            [*dx, nodes].into_iter().chain(scalars).chain(effort).collect()
        }));
        vec![table.with_warnings(rows.iter().map(|row| &row.result.warnings[..]))]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let mut film = Chart::new("Central film thickness", ChartAxis::log("Spacing ΔX"), ChartAxis::linear("H_c"));
        film.add("full", Marks::Line, rows.iter().map(|row| [row.dx, row.h_c()]));
        let y = ChartAxis::log("|H_c/limit − 1|");
        let mut error = Chart::new("Error of H_c against the extrapolated limit", ChartAxis::log("Spacing ΔX"), y);
        if let Some(limit) = self.limit(rows) {
            error.add("full", Marks::Line, rows.iter().map(|row| [row.dx, (row.h_c() / limit - 1.0).abs()]));
        }
        vec![film, error]
    }
}
