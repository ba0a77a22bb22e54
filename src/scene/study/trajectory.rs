//! Study of the test trajectory (3.21) through a range.

use super::path::{self, Path, PathRow, trajectory_points};
use super::question::{Chart, ChartAxis, Checked, Experiment, Findings, Question, RunError, Setting, Table, Tell};
use crate::scene::check::{self, MAX_POINTS};
use crate::scene::method::Method;
use crate::solver::parameters::ParameterSpace;
use crate::solver::physics::contact::OperatingPoint;
use serde::{Deserialize, Serialize};

/// The test trajectory (3.21) through a range, 0 ≤ c ≤ 2.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trajectory {
    /// The range. Its first four axes vary; contacts that it excludes are left out.
    pub range: ParameterSpace,
    /// Number of equidistant values of c, including both ends.
    pub points: usize,
    /// Methods by which each point is solved.
    pub methods: Vec<Method>,
}

impl Question for Trajectory {
    type Row = PathRow;

    fn check(&self, _experiment: &Experiment) -> Checked {
        check::methods("study.methods", &self.methods)?;
        check::count("study.points", self.points, 2, MAX_POINTS)?;
        check::space("study.range", &self.range)
    }

    fn methods(&self) -> &[Method] {
        &self.methods
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, PathRow>) -> Result<(), RunError> {
        let sliding = (!self.range.slides()).then_some(setting.experiment.sliding);
        let own = |point: OperatingPoint| OperatingPoint { sliding: sliding.unwrap_or(point.sliding), ..point };
        let points = trajectory_points(&self.range, setting.experiment, self.points);
        let contacts: Vec<_> = points.into_iter().map(|(c, point)| (vec![c], Ok(own(point)))).collect();
        let (line, methods) = (contacts.len().max(1), &self.methods[..]);
        let path = Path { name: "trajectory", contacts, line, methods, cold: false, on_model_grid: false };
        path.solve(setting, tell)
    }

    fn findings(&self, experiment: &Experiment, rows: &[&PathRow], found: &mut Findings) {
        path::findings(&self.methods, experiment, rows, found);
    }

    fn tables(&self, rows: &[&PathRow]) -> Vec<Table> {
        vec![path::table("trajectory", &["c".to_owned()], &self.methods, rows)]
    }

    fn charts(&self, rows: &[&PathRow]) -> Vec<Chart> {
        path::charts(&ChartAxis::linear("c"), &["c".to_owned()], &self.methods, rows)
    }
}
