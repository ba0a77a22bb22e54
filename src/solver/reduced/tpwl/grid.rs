//! Grid of a linearised model: of a line contact under its registration, or of a circular contact.

use crate::solver::discrete::elasticity::{PointScratch, Scratch};
use crate::solver::discrete::grid::{GridError, GridSpec, LineGrid, PointGrid, PointGridSpec};
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::discrete::space::Grid;
use crate::solver::full::Mesh;
use crate::solver::reduced::contact_rows::ContactRows;
use faer::MatRef;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Grid of either kind of contact.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum SpaceGrid {
    /// Grid of a line contact.
    Line(LineGrid),
    /// Grid of a circular contact.
    Plane(Plane),
}

/// Grid of a circular contact, stored as its specification.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "PointGridSpec", try_from = "PointGridSpec")]
pub struct Plane(pub Arc<PointGrid>);

impl From<Plane> for PointGridSpec {
    fn from(Plane(grid): Plane) -> Self {
        grid.spec
    }
}

impl TryFrom<PointGridSpec> for Plane {
    type Error = GridError;

    fn try_from(spec: PointGridSpec) -> Result<Self, GridError> {
        Ok(Self(spec.build()?))
    }
}

impl SpaceGrid {
    /// Returns the length of node arrays.
    pub fn len(&self) -> usize {
        self.weights().len()
    }

    /// Always returns `false`.
    pub fn is_empty(&self) -> bool {
        self.weights().is_empty()
    }

    /// Returns the quadrature weights of node arrays.
    pub fn weights(&self) -> &[f64] {
        match self {
            Self::Line(grid) => &grid.weights,
            Self::Plane(Plane(grid)) => &grid.weights,
        }
    }

    /// Returns the abscissae X and the ordinates Y of node arrays.
    pub fn abscissae(&self) -> (&[f64], &[f64]) {
        match self {
            Self::Line(grid) => grid.abscissae(),
            Self::Plane(Plane(grid)) => grid.abscissae(),
        }
    }

    /// Returns X and Y of a node.
    pub fn place(&self, node: usize) -> (f64, f64) {
        let (x, y) = self.abscissae();
        (x[node / y.len()], y[node % y.len()])
    }

    /// Returns the number of unknown pressures.
    pub fn unknowns(&self) -> usize {
        match self {
            Self::Line(grid) => grid.unknowns(),
            Self::Plane(Plane(grid)) => grid.unknowns(),
        }
    }

    /// Returns the node of an unknown.
    pub fn node(&self, unknown: usize) -> usize {
        match self {
            Self::Line(grid) => grid.node(unknown),
            Self::Plane(Plane(grid)) => grid.node(unknown),
        }
    }

    /// Returns the nodes of an unknown's row and its coefficients, for flow from the inlet.
    pub fn row(&self, unknown: usize) -> ([usize; STENCIL], RowGeometry) {
        match self {
            Self::Line(grid) => (Upstream::Inlet.stencil(unknown), grid.rows[unknown]),
            Self::Plane(Plane(grid)) => grid.row(unknown),
        }
    }

    /// Computes the deformation K P at every node.
    pub fn deform(&self, pressure: &[f64], deformation: &mut [f64]) {
        match self {
            Self::Line(grid) => grid.deform(pressure, deformation, &mut Scratch::default()),
            Self::Plane(Plane(grid)) => grid.deform(pressure, deformation, &mut PointScratch::default()),
        }
    }

    /// Returns the grid as stored in trajectories.
    pub fn mesh(&self) -> Mesh {
        match self {
            Self::Line(grid) => Mesh::of_line(grid),
            Self::Plane(Plane(grid)) => Mesh { spec: GridSpec::Plane(grid.spec), scale: 1.0 },
        }
    }

    /// Returns the data from which the scalars of states are computed, for V and K V.
    pub(super) fn contact_rows(&self, pressure: MatRef<'_, f64>, deformation: MatRef<'_, f64>) -> ContactRows {
        match self {
            Self::Line(grid) => ContactRows::new(grid, pressure, deformation),
            Self::Plane(Plane(grid)) => ContactRows::new(&**grid, pressure, deformation),
        }
    }
}
