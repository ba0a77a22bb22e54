//! Grid of either kind of contact, as a reduced model uses it: node arrays with weights, Reynolds equations, and the
//! deformation operator, independent of their layout.
//!
//! Along X all quantities refer to a reference coordinate ξ with X = −1 + (ξ + 1)s. The film thickness is H = H₀ − ½
//! ln s + (X² + Y²)/2 + s K P, where H₀ is the rigid-body separation, P the pressure and K the elastic kernel. The
//! scale s registers line contacts by their pressure spike. A point contact has s = 1.

use super::GridError;
use super::line::{FIRST_UNKNOWN, INLET, ReferenceGrid};
use super::point::{PointGrid, PointGridSpec};
use crate::host::pool::on_all_cores;
use crate::solver::discrete::elasticity::{Flexibility, PointScratch, Scratch};
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::physics::contact::{ContactKind, Moes};
use faer::Mat;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Grid specification, as given in scenes and on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Grid", deny_unknown_fields)]
pub enum GridSpec {
    /// Line contact: equidistant nodes from inlet to outlet, both ends included; kernel (2.39).
    Uniform {
        /// Spacing ΔX.
        dx: f64,
        /// Inlet and outlet.
        domain: (f64, f64),
    },
    /// Line contact: nodes graded towards X = ±1, kernel of hat functions, registered by the pressure spike if
    /// `registered`.
    Graded {
        /// Number of nodes, both ends included.
        nodes: usize,
        /// Inlet and outlet in the reference coordinate ξ.
        domain: (f64, f64),
        /// Maps the spike to ξ = 1.
        registered: bool,
    },
    /// Point contact, half domain Y ≤ 0.
    Plane(PointGridSpec),
    /// Line contact with a thin film: the spacing at X = ±1 follows the film thickness; kernel of hat functions.
    Following {
        /// Length of the zone in front of the contact in which the film closes.
        zone: f64,
        /// Number of cells per cell of the usual spacing.
        finer: f64,
        /// Inlet and outlet.
        domain: (f64, f64),
    },
}

impl GridSpec {
    /// Returns its kind of contact.
    pub fn kind(&self) -> ContactKind {
        match self {
            Self::Uniform { .. } | Self::Graded { .. } | Self::Following { .. } => ContactKind::Line,
            Self::Plane(_) => ContactKind::Point,
        }
    }

    /// Returns the first column of nodes with a film. Node arrays of a line contact begin with a node outside the
    /// inlet.
    pub fn first_column(&self) -> usize {
        if self.kind().is_line() { INLET } else { 0 }
    }

    /// Builds the grid and its kernel. This is expensive and done once per specification.
    ///
    /// # Errors
    /// If the specification is refused.
    pub fn build(&self) -> Result<ContactGrid, GridError> {
        Ok(match self {
            Self::Uniform { .. } | Self::Graded { .. } | Self::Following { .. } => ContactGrid::Line(self.line()?),
            Self::Plane(spec) => ContactGrid::Point(spec.build()?),
        })
    }

    /// As [`Self::build`], but the kernel of a point contact, which takes long, is computed when it is first used.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_without_kernel(&self) -> Result<ContactGrid, GridError> {
        match self {
            Self::Plane(spec) => Ok(ContactGrid::Point(spec.build_without_kernel()?)),
            _ => self.build(),
        }
    }
}

/// Grid of either kind of contact with its kernel; cheap to clone.
#[derive(Clone, Debug)]
pub enum ContactGrid {
    /// Reference grid of line contacts.
    Line(Arc<ReferenceGrid>),
    /// Grid of the half domain Y ≤ 0 of a point contact.
    Point(Arc<PointGrid>),
}

impl ContactGrid {
    /// Returns the specification from which it was built.
    pub fn spec(&self) -> GridSpec {
        match self {
            Self::Line(grid) => grid.spec,
            Self::Point(grid) => GridSpec::Plane(grid.spec),
        }
    }

    /// Returns its kind of contact.
    pub fn kind(&self) -> ContactKind {
        self.spec().kind()
    }

    /// Returns the reference grid of a line contact, or `None` for a point contact.
    pub fn line(&self) -> Option<&Arc<ReferenceGrid>> {
        match self {
            Self::Line(grid) => Some(grid),
            Self::Point(_) => None,
        }
    }

    /// Returns the grid of a point contact, or `None` for a line contact.
    pub fn point(&self) -> Option<&Arc<PointGrid>> {
        match self {
            Self::Line(_) => None,
            Self::Point(grid) => Some(grid),
        }
    }

    /// Returns the length of node arrays.
    pub fn len(&self) -> usize {
        self.weights().len()
    }

    /// Always returns `false`.
    pub fn is_empty(&self) -> bool {
        self.weights().is_empty()
    }

    /// Returns the number of nodes along X, both ends included, and across, outer edge and axis included. A line
    /// contact has one across.
    pub fn nodes(&self) -> (usize, usize) {
        match self {
            // Node arrays of a line contact have one node outside the inlet.
            Self::Line(grid) => (grid.xi.len() - 1, 1),
            Self::Point(grid) => (grid.nx(), grid.ny()),
        }
    }

    /// Returns the first column of nodes with a film, see [`GridSpec::first_column`].
    pub fn first_column(&self) -> usize {
        self.spec().first_column()
    }

    /// Returns the number of unknown pressures.
    pub fn unknowns(&self) -> usize {
        match self {
            Self::Line(grid) => grid.xi.len() - 3,
            Self::Point(grid) => grid.unknowns(),
        }
    }

    /// Returns the node index of an unknown.
    pub fn node(&self, unknown: usize) -> usize {
        match self {
            Self::Line(_) => unknown + FIRST_UNKNOWN,
            Self::Point(grid) => grid.node(unknown),
        }
    }

    /// Returns the number of lines of unknowns along X.
    pub fn lines(&self) -> usize {
        match self {
            Self::Line(_) => 1,
            Self::Point(grid) => grid.column_unknowns(),
        }
    }

    /// Returns the line of an unknown's node, and its column along X in node arrays.
    pub fn line_and_column(&self, node: usize) -> (usize, usize) {
        match self {
            Self::Line(_) => (0, node),
            Self::Point(grid) => (node % grid.ny() - 1, node / grid.ny()),
        }
    }

    /// Returns one entry of K in ξ: the deformation at a node by unit pressure at another.
    pub fn kernel_entry(&self, node: usize, other: usize) -> f64 {
        match self {
            Self::Line(grid) => grid.flexibility.entry(node, other),
            Self::Point(grid) => grid.flexibility.entry(node, other),
        }
    }

    /// Applies K to one node array, in ξ.
    pub fn deformation(&self, pressure: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; pressure.len()];
        match self {
            Self::Line(grid) => grid.flexibility.apply(pressure, &mut out, &mut Scratch::default()),
            Self::Point(grid) => grid.deform(pressure, &mut out, &mut PointScratch::default()),
        }
        out
    }

    /// Returns the deformations of `nodes` by unit pressure at each of `others`, one column after the other, in ξ.
    pub fn kernel_columns(&self, nodes: &[usize], others: &[usize]) -> Vec<f32> {
        let mut entries = Vec::with_capacity(nodes.len() * others.len());
        match self {
            Self::Line(grid) => {
                for &other in others {
                    entries.extend(nodes.iter().map(|&node| grid.flexibility.entry(node, other) as f32));
                }
            }
            Self::Point(grid) => {
                let (ny, blocks) = (grid.ny(), grid.flexibility.column_blocks());
                let places: Vec<(usize, usize)> = nodes.iter().map(|node| (node / ny, node % ny)).collect();
                for other in others {
                    // Entries at equal distances along X are equal.
                    let (column, from) = (other / ny, (other % ny - 1) * ny);
                    let entry = |&(own, across): &(usize, usize)| blocks[own.abs_diff(column)][from + across] as f32;
                    entries.extend(places.iter().map(entry));
                }
            }
        }
        entries
    }

    /// Returns the quadrature weights of node arrays in ξ and Y; zero where P vanishes.
    pub fn weights(&self) -> &[f64] {
        match self {
            Self::Line(grid) => &grid.weights,
            Self::Point(grid) => &grid.weights,
        }
    }

    /// Returns the scale s of the map X = −1 + (ξ + 1)s for a contact.
    pub fn scale(&self, moes: Moes) -> f64 {
        match self {
            Self::Line(grid) => grid.scale(moes),
            Self::Point(_) => 1.0,
        }
    }

    /// Returns ξ and Y of a node.
    pub fn place(&self, node: usize) -> (f64, f64) {
        match self {
            Self::Line(grid) => (grid.xi[node], 0.0),
            Self::Point(grid) => (grid.x[node / grid.ny()], grid.y[node % grid.ny()]),
        }
    }

    /// Returns the abscissae ξ and the ordinates Y of node arrays. A line contact has one ordinate, Y = 0.
    pub fn abscissae(&self) -> (&[f64], &[f64]) {
        match self {
            Self::Line(grid) => (&grid.xi, &[0.0]),
            Self::Point(grid) => (&grid.x, &grid.y),
        }
    }

    /// Returns the stencil of an unknown's equation in ξ: its nodes and coefficients. A missing node is replaced by
    /// another one with weight zero.
    pub fn row(&self, unknown: usize) -> ([usize; STENCIL], RowGeometry) {
        match self {
            Self::Line(grid) => {
                let node = unknown + FIRST_UNKNOWN;
                let xi = |offset: usize| grid.xi[unknown + offset];
                let geometry = RowGeometry::new([xi(0), xi(1), xi(2), xi(3)]);
                ([unknown, unknown + 1, node, unknown + 3, node, node], geometry)
            }
            Self::Point(grid) => grid.row(unknown),
        }
    }

    /// Returns nodes and weights of the cubic interpolation at X = 0 (and Y = 0) under scale s. If a node of a point
    /// contact lies there, its weight is 1 and all others are 0.
    pub fn at_zero(&self, scale: f64) -> [(usize, f64); 4] {
        match self {
            Self::Line(grid) => {
                let xi = &grid.xi;
                let at = 1.0 / scale - 1.0;
                let upper = xi.partition_point(|&v| v < at).clamp(3, xi.len() - 2);
                let first = upper - 2;
                std::array::from_fn(|k| {
                    let others = (0..4).filter(|&j| j != k);
                    let weight = others.map(|j| (at - xi[first + j]) / (xi[first + k] - xi[first + j])).product();
                    (first + k, weight)
                })
            }
            Self::Point(grid) => grid.interpolation_on_axis(0.0),
        }
    }

    /// Returns the operator of nodal gradients along ξ and, in the same unit, across. Node (i, j) has the index i·n_y
    /// + j.
    pub fn gradient(&self) -> PlaneGradient {
        match self {
            Self::Line(grid) => PlaneGradient::new(&grid.xi, &[0.0]),
            Self::Point(grid) => PlaneGradient::new(&grid.x, &grid.across),
        }
    }

    /// Applies K to every column, in ξ.
    pub fn flex(&self, columns: &Mat<f64>) -> Mat<f64> {
        match self {
            Self::Line(grid) => {
                if let Flexibility::Dense(kernel) = &grid.flexibility {
                    return kernel * columns;
                }
                let apply = |input: &[f64], output: &mut [f64], scratch: &mut Scratch| {
                    grid.flexibility.apply(input, output, scratch);
                };
                column_by_column(columns, apply)
            }
            Self::Point(grid) => {
                let apply = |input: &[f64], output: &mut [f64], scratch: &mut PointScratch| {
                    grid.deform(input, output, scratch);
                };
                column_by_column(columns, apply)
            }
        }
    }
}

/// Applies an operator to every column.
fn column_by_column<S: Default + Send>(
    columns: &Mat<f64>,
    apply: impl Fn(&[f64], &mut [f64], &mut S) + Sync,
) -> Mat<f64> {
    let n = columns.nrows();
    let one = |scratch: &mut S, j: usize| {
        let input: Vec<f64> = columns.col(j).iter().copied().collect();
        let mut output = vec![0.0; n];
        apply(&input, &mut output, scratch);
        output
    };
    let done: Vec<Vec<f64>> = on_all_cores(|| (0..columns.ncols()).into_par_iter().map_init(S::default, one).collect());
    Mat::from_fn(n, columns.ncols(), |i, j| done[j][i])
}

/// Adds the undeformed gap H₀ + X²/(2R̄) + Y²/2 to a node array, such as a deformation. `curvature` is 1/R̄.
pub(crate) fn add_gap(film: &mut [f64], (x, y): (&[f64], &[f64]), h_0: f64, curvature: f64) {
    for (column, x) in film.chunks_exact_mut(y.len()).zip(x) {
        for (film, y) in column.iter_mut().zip(y) {
            *film += h_0 + 0.5 * (curvature * x * x + y * y);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ron::extensions::Extensions;

    #[test]
    fn a_grid_is_written_as_scenes_write_it() {
        let options = ron::Options::default().with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES);
        for (spec, text) in [
            (
                GridSpec::Graded { nodes: 200, domain: (-6.0, 1.9), registered: true },
                "Graded(nodes:200,domain:(-6.0,1.9),registered:true)",
            ),
            (
                GridSpec::Plane(PointGridSpec::DISSERTATION),
                "Plane(dx:0.02,dy:0.05,domain:(-4.0,2.0,-2.0),refinement:1.0)",
            ),
        ] {
            assert_eq!(options.to_string(&spec).unwrap(), text);
            assert_eq!(options.from_str::<GridSpec>(text).unwrap(), spec);
        }
        let short: GridSpec = options.from_str("Plane(dx:0.02,dy:0.05,domain:(-4.0,2.0,-2.0))").unwrap();
        assert_eq!(short, GridSpec::Plane(PointGridSpec::DISSERTATION));
        assert!(options.from_str::<GridSpec>("Plane(dx:0.02,dy:0.05,domain:(-4,2,-2),depth:1)").is_err());
    }

    #[test]
    fn rows_and_weights_of_both_kinds_refer_to_their_node_arrays() {
        let line = GridSpec::DISSERTATION.build().unwrap();
        let point = GridSpec::Plane(PointGridSpec::uniform(0.1, 0.1, (-2.0, 1.5, -1.5))).build().unwrap();
        for grid in [line, point] {
            for unknown in [0, 1, grid.unknowns() / 2, grid.unknowns() - 1] {
                let (stencil, _) = grid.row(unknown);
                assert_eq!(stencil[crate::solver::discrete::reynolds::CENTER], grid.node(unknown));
                assert!(stencil.iter().all(|&node| node < grid.len()) && grid.weights()[grid.node(unknown)] > 0.0);
            }
            let zero: f64 = grid.at_zero(1.0).iter().map(|(node, w)| w * (grid.place(*node).0 + 1.0)).sum();
            assert!((zero - 1.0).abs() < 1e-12, "interpolation at X = 0: {zero}");
        }
    }
}
