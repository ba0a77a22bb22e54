//! The grid of a solution, by what it is built from.

use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use serde::{Deserialize, Serialize};

/// The grid that a solution lives on. Node arrays of a line contact have one extra leading node outside the inlet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// What it was built from; of a line contact its reference grid.
    pub spec: GridSpec,
    /// Scale of the registration map; 1 where there is none.
    pub scale: f64,
}

impl Mesh {
    /// The specification of a point contact's grid; `None` of a line contact's.
    pub fn plane(&self) -> Option<PointGridSpec> {
        match self.spec {
            GridSpec::Plane(spec) => Some(spec),
            _ => None,
        }
    }
}
