//! The test trajectory (3.21) through a box.

use super::path::{self, Path, PathRow, places, trajectory_points};
use super::question::{Chart, ChartAxis, Checked, Experiment, Findings, Question, RunError, Setting, Table, Tell};
use crate::scene::check::{self, MAX_POINTS, refuse};
use crate::scene::method::Method;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::training::{QuantityBox, Range};
use serde::{Deserialize, Serialize};

/// The test trajectory (3.21) through a box, 0 ≤ c ≤ 2.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Trajectory {
    /// The box.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<QuantityBox>,
    /// Another range in its place, whose coordinates swing by the same waves; what it excludes is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub through: Option<Range>,
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
        match (&self.range, &self.through) {
            (Some(range), None) => check::quantity_box("study.range", range),
            (None, Some(range)) => range.check().map_err(|refused| refused.within("study.through")),
            _ => Err(refuse(
                "study.range, study.through",
                "must be one of both: the box of the trajectory, or another range",
            )),
        }
    }

    fn methods(&self) -> &[Method] {
        &self.methods
    }

    fn run(&self, setting: &mut Setting<'_>, tell: &Tell<'_, PathRow>) -> Result<(), RunError> {
        let Experiment { contact, sliding, .. } = *setting.experiment;
        let mut contacts = Vec::new();
        if let Some(range) = &self.range {
            let points = trajectory_points(range, setting.experiment, self.points)?;
            contacts.extend(points.into_iter().map(|(c, point)| (vec![c], OperatingPoint { sliding, ..point })));
        }
        if let Some(range) = &self.through {
            let point = |c| Some((vec![c], range.trajectory(contact, c)?));
            contacts.extend(places(self.points).filter_map(point));
        }
        let (line, methods) = (contacts.len().max(1), &self.methods[..]);
        let path = Path { name: "trajectory", contacts, line, methods, cold: false, on_model_grid: false };
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
