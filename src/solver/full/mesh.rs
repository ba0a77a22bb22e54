//! Grid of a solution, described by its specification.

use crate::solver::discrete::grid::{GridSpec, LineGrid, PointGridSpec};
use serde::{Deserialize, Serialize};

/// Grid on which a solution is given. Node arrays of a line contact have one extra leading node outside the inlet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Specification from which the grid was built. For a line contact it is that of the reference grid.
    pub spec: GridSpec,
    /// Scale of the registration map; 1 without registration.
    pub scale: f64,
}

impl Mesh {
    /// Returns the grid of a line contact.
    pub fn of_line(grid: &LineGrid) -> Self {
        Self { spec: grid.reference.spec, scale: grid.scale }
    }

    /// Returns the grid specification of a point contact, or `None` for a line contact.
    pub fn plane(&self) -> Option<PointGridSpec> {
        match self.spec {
            GridSpec::Plane(spec) => Some(spec),
            _ => None,
        }
    }
}
