//! Dimension study: number of modes needed by the full solutions along a sweep (Table 3.7).

use super::question::{
    Chart, ChartAxis, Checked, Experiment, Findings, Marks, Question, RunError, Setting, Table, Tell,
};
use super::sweep::{check_axes, contacts_of};
use crate::scene::axis::Axis;
use crate::scene::check::{count, number};
use crate::scene::parallel::full_solutions;
use crate::solver::full::Solution;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::{PodBasis, deformation_weights};
use faer::Mat;
use serde::{Deserialize, Serialize};

/// Number of modes needed by the full solutions at all combinations of one to three varied quantities, for given losses
/// of information (Table 3.7).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Dimensions {
    /// Varied quantities.
    pub over: Vec<Axis>,
    /// Losses of information, (2.92) and (2.93).
    pub losses: Vec<f64>,
}

/// Largest number of full solutions kept at once, for line and point contacts: some hundred MB of fields.
const MOST_SNAPSHOTS: [usize; 2] = [10_000, 1_000];

/// Result of the study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Number of full solutions that converged.
    pub snapshots: usize,
    /// Number of full solutions that did not converge.
    pub full_failures: usize,
    /// Nodes along X and across.
    pub nodes: (usize, usize),
    /// Numbers of modes at each loss.
    pub dimensions: Vec<Dimension>,
}

/// Numbers of modes for one loss of information.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dimension {
    /// Loss of information.
    pub loss: f64,
    /// Number of pressure modes, (2.92).
    pub pressure: usize,
    /// Number of deformation modes, (2.93).
    pub deformation: usize,
}

impl Question for Dimensions {
    type Row = Row;

    fn check(&self, experiment: &Experiment) -> Checked {
        check_axes(&self.over, experiment)?;
        let contacts = self.over.iter().map(|axis| axis.values.len()).fold(1, usize::saturating_mul);
        count("study.over (points)", contacts, 1, MOST_SNAPSHOTS[experiment.contact as usize])?;
        count("study.losses (how many)", self.losses.len(), 1, 32)?;
        self.losses.iter().try_for_each(|&loss| number("study.losses", loss, 1e-15, 0.5))
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, Row>) -> Result<(), RunError> {
        let Setting { experiment, observer, .. } = *setting;
        let grid = setting.bench.grid(&experiment.request()?, observer)?;
        let contacts = contacts_of(experiment, &self.over)?;
        let points = contacts.into_iter().map(|(_, point)| point).collect::<Result<Vec<OperatingPoint>, _>>()?;
        let solutions = full_solutions(|_| grid.clone(), &points, experiment.lubricant, observer)?;
        let solutions: Vec<Solution> = solutions.into_iter().flatten().collect();
        let snapshots = solutions.len();
        let few = || RunError::Study("no full solution converged; there is nothing to decompose".to_owned());
        let decompose = |fields: Vec<Vec<f64>>, weights: &[f64]| {
            let snapshots = Mat::from_fn(grid.len(), fields.len(), |i, j| fields[j][i]);
            PodBasis::new(snapshots.as_ref(), weights, 0.0)
                .filter(|basis| !basis.singular_values.is_empty())
                .ok_or_else(few)
        };
        let deformation = solutions.iter().map(Solution::deformation).collect();
        let deformation = decompose(deformation, &deformation_weights(&grid))?;
        let pressure = decompose(solutions.into_iter().map(|solution| solution.pressure).collect(), grid.weights())?;
        let dimension = |&loss: &f64| Dimension {
            loss,
            pressure: pressure.modes_for(loss),
            deformation: deformation.modes_for(loss),
        };
        let dimensions = self.losses.iter().map(dimension).collect();
        tell(Row { snapshots, full_failures: points.len() - snapshots, nodes: grid.nodes(), dimensions });
        Ok(())
    }

    /// Values: `snapshots`, `full_failures`, `nodes_x`, `nodes_y`, `dofs` (2n + 1), and for every loss of information
    /// `basis_p[1e-5]` and `basis_delta[1e-5]`, (2.92) and (2.93).
    fn findings(&self, _experiment: &Experiment, rows: &[&Row], found: &mut Findings) {
        for row in rows {
            let (nx, ny) = row.nodes;
            found.converged &= row.full_failures == 0;
            found.push("snapshots", None, row.snapshots as f64);
            found.push("full_failures", None, row.full_failures as f64);
            found.push("nodes_x", None, nx as f64);
            found.push("nodes_y", None, ny as f64);
            found.push("dofs", None, (2 * nx * ny + 1) as f64);
            for Dimension { loss, pressure, deformation } in &row.dimensions {
                found.push(format!("basis_p[{loss:e}]"), None, *pressure as f64);
                found.push(format!("basis_delta[{loss:e}]"), None, *deformation as f64);
            }
        }
    }

    fn tables(&self, rows: &[&Row]) -> Vec<Table> {
        let mut table = Table::new("dimensions", &["loss", "basis_p", "basis_delta"]);
        let row = |d: &Dimension| vec![d.loss, d.pressure as f64, d.deformation as f64];
        table.rows.extend(rows.iter().flat_map(|rows| &rows.dimensions).map(row));
        vec![table]
    }

    fn charts(&self, rows: &[&Row]) -> Vec<Chart> {
        let x = ChartAxis::log("Loss of information");
        let mut chart = Chart::new("Number of modes required", x, ChartAxis::linear("Modes"));
        let all = || rows.iter().flat_map(|row| &row.dimensions);
        chart.add("pressure", Marks::Line, all().map(|d| [d.loss, d.pressure as f64]));
        chart.add("deformation", Marks::Line, all().map(|d| [d.loss, d.deformation as f64]));
        vec![chart]
    }
}
