//! Grid of a contact specification.

use super::fields::{ContactSpec, Field};
use super::refusal::{Refusal, refuse};
use crate::scene::grid::Grid;
use crate::solver::discrete::grid::{GridError, GridSpec, PointGridSpec};
use crate::solver::physics::contact::OperatingPoint;

/// Spacing and ends of the dissertation's grid for line contacts.
const LINE: (f64, (f64, f64)) = (0.005, (-4.0, 2.0));

impl ContactSpec {
    /// Returns the grid of a full or a reduced solution.
    pub(super) fn grid_for(&self, full: bool, point: &OperatingPoint) -> Result<Grid, Refusal> {
        let own = [Field::Dx, Field::Dy, Field::Domain].into_iter().find(|field| self.states(*field));
        if point.kind.is_line() {
            let across = self.domain.is_some_and(|domain| domain.y.is_some()).then_some(Field::Domain);
            if let Some(field) = self.dy.map(|_| Field::Dy).or(across) {
                return refuse(field, "a line contact has no Y: leave out <dy> and the third number of <domain>");
            }
        }
        if !full {
            if let Some(field) = own {
                let left_out = "leave out <dx>, <dy> and <domain> with <method=reduced>";
                return refuse(field, format!("a reduced model brings its own grid: {left_out}"));
            }
            return match self.grid {
                None | Some(Grid::Model) => Ok(Grid::Model),
                Some(_) => {
                    let accepted = "with <method=reduced> only <grid=model> is accepted";
                    refuse(Field::Grid, format!("a reduced model brings its own grid: {accepted}"))
                }
            };
        }
        let Some(field) = own else {
            let grid = self.grid.unwrap_or(Grid::Usual).for_contact(point);
            return grid.map_err(|error| of_grid(Field::Grid, &error));
        };
        if point.kind.is_line() { self.line_grid() } else { self.plane(field) }
    }

    /// Returns the grid of a line contact if spacing or ends are stated.
    fn line_grid(&self) -> Result<Grid, Refusal> {
        let ends = self.domain.map(|domain| domain.x);
        match (self.grid, self.dx) {
            (Some(Grid::Graded | Grid::Model), Some(_)) => {
                refuse(Field::Dx, "<dx> belongs to the uniform grid; leave it out or use <grid=uniform>")
            }
            (Some(Grid::Model), None) => {
                refuse(Field::Domain, "<domain> belongs to uniform and graded grids; leave it out with <grid=model>")
            }
            (Some(Grid::Graded), None) => match (ends, GridSpec::EXPLORER) {
                (Some(domain), GridSpec::Graded { nodes, registered, .. }) => {
                    Ok(Grid::GradedNodes { nodes, domain, registered })
                }
                _ => Ok(Grid::Graded),
            },
            (_, dx) => Ok(Grid::Uniform { dx: dx.unwrap_or(LINE.0), domain: ends.unwrap_or(LINE.1) }),
        }
    }

    /// Returns the grid of a point contact if spacing or ends are stated.
    fn plane(&self, field: Field) -> Result<Grid, Refusal> {
        let default = match self.grid {
            Some(Grid::Model) => {
                return refuse(field, "<grid=model> is the model's own: leave out <dx>, <dy> and <domain>");
            }
            Some(Grid::Graded) => PointGridSpec::EXPLORER,
            _ => PointGridSpec::DISSERTATION,
        };
        let (from, to, edge) = default.domain;
        let ends = self.domain.map_or((from, to), |domain| domain.x);
        let edge = self.domain.and_then(|domain| domain.y).unwrap_or(edge);
        let (dx, dy) = (self.dx.unwrap_or(default.dx), self.dy.unwrap_or(default.dy));
        let spec = PointGridSpec { dx, dy, domain: (ends.0, ends.1, edge), ..default };
        spec.check().map_err(|error| of_grid(field, &error))?;
        Ok(Grid::Plane(spec))
    }
}

fn of_grid(field: Field, error: &GridError) -> Refusal {
    Refusal::new(field, error.to_string())
}
