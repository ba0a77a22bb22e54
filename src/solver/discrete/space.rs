//! Differences between a line and a plane: the nodes of a row and its coefficients, quadrature weights, gap and
//! deformation. All other code is written once over a [`Space`].

use super::elasticity::{PointScratch, Scratch};
use super::grid::{FIRST_UNKNOWN, INLET, LineGrid, PointGrid};
use super::reynolds::line::Upstream;
use super::reynolds::{RowGeometry, STENCIL};
use crate::host::pool;
use std::sync::Arc;

/// Nodes, weights and deformation of a contact. Node arrays run over X and, fastest, Y.
pub trait Grid {
    /// Work space of a deformation.
    type Scratch: Default;

    /// Quadrature weights of node arrays; zero where the pressure P vanishes.
    fn weights(&self) -> &[f64];

    /// Abscissae X and ordinates Y ≤ 0; a line has the single ordinate Y = 0.
    fn abscissae(&self) -> (&[f64], &[f64]);

    /// Ordinates κY in units of the half-width a, like the abscissae.
    fn across(&self) -> &[f64];

    /// Number of unknown pressures.
    fn unknowns(&self) -> usize;

    /// Number of unknowns at one abscissa. Unknowns run over X and, fastest, over these.
    fn column_unknowns(&self) -> usize;

    /// Node index of an unknown.
    fn node(&self, unknown: usize) -> usize;

    /// Nodes and weights of the cubic interpolation at X = 0 (and Y = 0).
    fn at_zero(&self) -> [(usize, f64); 4];

    /// Computes the deformation Δ = K P at every node. Both slices are node arrays.
    fn deform(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut Self::Scratch);

    /// Whether the pressure goes on beyond its ends, where that of a lightly loaded contact is known.
    fn continues(&self) -> bool {
        false
    }

    /// Returns the value of a node array at X = 0 (and Y = 0).
    fn central(&self, values: &[f64]) -> f64 {
        self.at_zero().iter().map(|(node, w)| w * values[*node]).sum()
    }
}

/// Grid with the rows of its Reynolds equation.
pub trait Space: Sync {
    /// Type of the grid.
    type Grid: Grid;
    /// True if loops over its nodes and rows run on several threads.
    const PARALLEL: bool;
    /// Number of leading nodes of a row's six that may have a weight.
    const NODES: usize;
    /// Number of axes along which the pressure has a gradient.
    const AXES: usize;

    /// Grid of the space.
    fn grid(&self) -> &Self::Grid;

    /// Returns the nodes that an unknown's row depends on, and its coefficients. A missing node is replaced by
    /// another with weight zero.
    fn row(&self, unknown: usize) -> ([usize; STENCIL], RowGeometry);

    /// Returns the same with every second node, to estimate the discretisation error of the first. `None` if a node
    /// lies outside.
    fn wide_row(&self, unknown: usize) -> Option<([usize; STENCIL], RowGeometry)>;

    /// Calls `f` for every unknown with its index, the nodes of its row and its item.
    fn each_row<T: Send>(&self, items: &mut [T], f: impl Fn(usize, [usize; STENCIL], &mut T) + Sync);

    /// Writes the gap of the undeformed bodies at every node, (2.24).
    fn write_gap(&self, gap: &mut [f64]);

    /// Copies the unknowns to a node array; its other entries stay unchanged.
    fn spread(&self, unknowns: &[f64], nodes: &mut [f64]);

    /// Returns the deformation of a node in the middle of the grid by unit pressure at itself.
    fn own_deformation(&self) -> f64;
}

impl Grid for LineGrid {
    type Scratch = Scratch;

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn abscissae(&self) -> (&[f64], &[f64]) {
        (&self.x, &[0.0])
    }

    fn across(&self) -> &[f64] {
        &[0.0]
    }

    fn unknowns(&self) -> usize {
        self.x.len() - INLET - FIRST_UNKNOWN
    }

    fn column_unknowns(&self) -> usize {
        1
    }

    fn node(&self, unknown: usize) -> usize {
        unknown + FIRST_UNKNOWN
    }

    fn at_zero(&self) -> [(usize, f64); 4] {
        let (first, weights) = self.interpolation(0.0);
        std::array::from_fn(|k| (first + k, weights[k]))
    }

    fn deform(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut Scratch) {
        LineGrid::deform(self, pressure, deformation, scratch);
    }
}

impl Grid for PointGrid {
    type Scratch = PointScratch;

    fn weights(&self) -> &[f64] {
        &self.weights
    }

    fn abscissae(&self) -> (&[f64], &[f64]) {
        (&self.x, &self.y)
    }

    fn across(&self) -> &[f64] {
        &self.across
    }

    fn unknowns(&self) -> usize {
        PointGrid::unknowns(self)
    }

    fn continues(&self) -> bool {
        self.spec.continues()
    }

    fn column_unknowns(&self) -> usize {
        PointGrid::column_unknowns(self)
    }

    fn node(&self, unknown: usize) -> usize {
        PointGrid::node(self, unknown)
    }

    fn at_zero(&self) -> [(usize, f64); 4] {
        self.interpolation_on_axis(0.0)
    }

    fn deform(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut PointScratch) {
        PointGrid::deform(self, pressure, deformation, scratch);
    }
}

/// Grid and rows of a line contact. In a transient contact the rows change with every step.
#[derive(Clone, Debug)]
pub struct LineSpace {
    /// Grid.
    pub grid: LineGrid,
    /// 1/R̄ of (2.24), with the relative radius R̄; 1 if the radius is constant.
    pub curvature: f64,
    /// Height of the surfaces' features at every node, which makes the gap smaller; empty for smooth surfaces.
    pub features: Vec<f64>,
    /// Coefficients of the rows; in a steady contact those of the grid.
    pub rows: Vec<RowGeometry>,
    /// Side from which the flow of each row comes.
    pub upstream: Vec<Upstream>,
}

impl LineSpace {
    /// Creates the space of a steady contact.
    pub fn new(grid: LineGrid) -> Self {
        let (rows, upstream) = (grid.rows.clone(), vec![Upstream::Inlet; grid.rows.len()]);
        Self { grid, curvature: 1.0, features: Vec::new(), rows, upstream }
    }
}

impl Space for LineSpace {
    type Grid = LineGrid;
    const PARALLEL: bool = false;
    const NODES: usize = 4;
    const AXES: usize = 1;

    fn grid(&self) -> &LineGrid {
        &self.grid
    }

    #[inline]
    fn row(&self, unknown: usize) -> ([usize; STENCIL], RowGeometry) {
        (self.upstream[unknown].stencil(unknown), self.rows[unknown])
    }

    fn wide_row(&self, unknown: usize) -> Option<([usize; STENCIL], RowGeometry)> {
        let (own, x) = (unknown + FIRST_UNKNOWN, &self.grid.x);
        let stencil = [own.checked_sub(4).filter(|&node| node >= INLET)?, own - 2, own, own + 2, own, own];
        if own + 2 >= x.len() {
            return None;
        }
        Some((stencil, RowGeometry::new([x[own - 4], x[own - 2], x[own], x[own + 2]])))
    }

    #[inline]
    fn each_row<T: Send>(&self, items: &mut [T], f: impl Fn(usize, [usize; STENCIL], &mut T) + Sync) {
        for (k, (item, upstream)) in items.iter_mut().zip(&self.upstream).enumerate() {
            f(k, upstream.stencil(k), item);
        }
    }

    fn write_gap(&self, gap: &mut [f64]) {
        for (gap, x) in gap.iter_mut().zip(&self.grid.x) {
            *gap = 0.5 * self.curvature * x * x;
        }
        for (gap, height) in gap.iter_mut().zip(&self.features) {
            *gap -= height;
        }
    }

    fn spread(&self, unknowns: &[f64], nodes: &mut [f64]) {
        let count = self.grid.rows.len();
        nodes[FIRST_UNKNOWN..FIRST_UNKNOWN + count].copy_from_slice(&unknowns[..count]);
    }

    fn own_deformation(&self) -> f64 {
        self.grid.kernel_entry(self.grid.len() / 2, self.grid.len() / 2)
    }
}

/// Half Y ≤ 0 of a point contact.
#[derive(Clone, Debug)]
pub struct PlaneSpace {
    /// Grid.
    pub grid: Arc<PointGrid>,
    /// Transient terms of the rows, and features of the surfaces.
    pub motion: Motion,
}

/// Transient terms of the rows of a point contact, and features of its surfaces. By default the contact is steady and
/// its surfaces are smooth.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    /// Speed of the flow along X, at least 0.
    pub speed: f64,
    /// Weight of ρ̄H in its time derivative.
    pub storage: f64,
    /// Contribution of the previous steps to the time derivative of each unknown's row. Empty for a steady contact, in
    /// which speed and storage have no effect.
    pub history: Vec<f64>,
    /// Height of the features at every node, which makes the gap smaller; empty for smooth surfaces.
    pub features: Vec<f64>,
}

impl PlaneSpace {
    /// Creates the space of a steady contact.
    pub fn new(grid: Arc<PointGrid>) -> Self {
        Self { grid, motion: Motion::default() }
    }
}

/// Rows handled by one task.
const SHARE: usize = 2048;

impl Space for PlaneSpace {
    type Grid = PointGrid;
    const PARALLEL: bool = true;
    const NODES: usize = STENCIL;
    const AXES: usize = 2;

    fn grid(&self) -> &PointGrid {
        &self.grid
    }

    #[inline]
    fn row(&self, unknown: usize) -> ([usize; STENCIL], RowGeometry) {
        let (stencil, geometry) = self.grid.row(unknown);
        let Motion { speed, storage, history, .. } = &self.motion;
        match history.get(unknown) {
            None => (stencil, geometry),
            Some(history) => (stencil, geometry.in_time(*speed, *storage, *history)),
        }
    }

    fn wide_row(&self, unknown: usize) -> Option<([usize; STENCIL], RowGeometry)> {
        let PointGrid { x, across: y, .. } = &*self.grid;
        let (ny, node) = (y.len(), self.grid.node(unknown));
        let (i, j) = (node / ny, node % ny);
        if i < 4 || i + 2 >= x.len() || j < 2 {
            return None;
        }
        // Beyond the axis lies the mirror image.
        let axis = ny - 1;
        let (north, beyond) = if j + 2 > axis { (2 * axis - j - 2, -1.0) } else { (j + 2, 1.0) };
        let across = (j < axis).then(|| beyond * y[north] - y[j]);
        let geometry = RowGeometry::new([x[i - 4], x[i - 2], x[i], x[i + 2]]).across(y[j] - y[j - 2], across);
        Some(([node - 4 * ny, node - 2 * ny, node, node + 2 * ny, node - 2, i * ny + north], geometry))
    }

    #[inline]
    fn each_row<T: Send>(&self, items: &mut [T], f: impl Fn(usize, [usize; STENCIL], &mut T) + Sync) {
        let m = self.grid.column_unknowns();
        pool::each_chunk(items, m, SHARE.div_ceil(m), |column, items| {
            let ny = m + 1;
            let west2 = if column == 0 { ny } else { 2 * ny };
            for (j, item) in items.iter_mut().enumerate() {
                let n = (column + 1) * ny + j + 1;
                // The missing northern node on the axis has weight zero, whichever node replaces it.
                f(column * m + j, [n - west2, n - ny, n, n + ny, n - 1, n + 1], item);
            }
        });
    }

    fn write_gap(&self, gap: &mut [f64]) {
        gap.iter_mut().enumerate().for_each(|(node, gap)| *gap = self.grid.parabola(node));
        gap.iter_mut().zip(&self.motion.features).for_each(|(gap, height)| *gap -= height);
    }

    fn spread(&self, unknowns: &[f64], nodes: &mut [f64]) {
        let (m, ny) = (self.grid.column_unknowns(), self.grid.ny());
        let columns = unknowns[..self.grid.unknowns()].chunks_exact(m);
        for (column, values) in nodes.chunks_exact_mut(ny).skip(1).zip(columns) {
            column[1..].copy_from_slice(values);
        }
    }

    fn own_deformation(&self) -> f64 {
        let middle = self.grid.node(self.grid.unknowns() / 2);
        self.grid.flexibility.entry(middle, middle)
    }
}
