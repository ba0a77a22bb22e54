//! The test trajectory (3.21) through a box.

use super::path::{self, Path, PathRow, trajectory_points};
use super::question::{Chart, ChartAxis, Checked, Experiment, Findings, Question, RunError, Setting, Table, Tell};
use crate::scene::check::{self, MAX_POINTS};
use crate::scene::method::Method;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::QuantityBox;
use serde::{Deserialize, Serialize};

/// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trajectory {
    /// The box.
    pub range: QuantityBox,
    /// Equidistant values of c, both ends counted.
    pub points: usize,
    /// How each point is solved.
    pub methods: Vec<Method>,
}

impl Question for Trajectory {
    type Row = PathRow;

    fn check(&self, _experiment: &Experiment) -> Checked {
        check::methods("study.methods", &self.methods)?;
        check::count("study.points", self.points, 2, MAX_POINTS)?;
        check::quantity_box("study.range", &self.range)
    }

    fn methods(&self) -> &[Method] {
        &self.methods
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, PathRow>) -> Result<(), RunError> {
        let sliding = setting.experiment.sliding;
        let points = trajectory_points(&self.range, setting.experiment, self.points)?;
        let contacts = points.into_iter().map(|(c, point)| (vec![c], OperatingPoint { sliding, ..point })).collect();
        let path = Path { name: "trajectory", contacts, methods: &self.methods, cold: false, on_model_grid: false };
        path.solve(setting, tell)
    }

    fn findings(&self, experiment: &Experiment, rows: &[&PathRow], found: &mut Findings) {
        path::findings(&self.methods, experiment, rows, found);
    }

    fn tables(&self, rows: &[&PathRow]) -> Vec<Table> {
        vec![path::table("trajectory", &["c"], &self.methods, rows)]
    }

    fn charts(&self, rows: &[&PathRow]) -> Vec<Chart> {
        path::charts(&ChartAxis::linear("c"), &["c"], &self.methods, rows)
    }
}
