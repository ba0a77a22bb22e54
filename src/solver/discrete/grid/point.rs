//! Computational domain of a circular or elliptical point contact in X = x/a and Y = y/b. By symmetry it is the half
//! Y ≤ 0, with pressure P = 0 at inlet, outlet and outer edge.
//!
//! Node arrays run over all nodes, Y fastest. Node (i, j) has the index i·n_y + j, with j = 0 on the outer edge and j
//! = n_y − 1 on the symmetry axis Y = 0. The unknown pressures are those inside and on the axis, in the same order.

use super::{GridError, LONGEST_INLET, LONGEST_OUTLET, MAX_BYTES, cubic};
use crate::solver::discrete::elasticity::{KernelError, PointFlexibility, PointScratch};
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::limits::Number;
use crate::solver::physics::contact::Ellipse;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Specification of a point grid, as given in scenes and on the command line. It is equidistant along X, and across
/// either equidistant or refined in the side lobes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename = "Plane", deny_unknown_fields)]
pub struct PointGridSpec {
    /// Spacing ΔX.
    pub dx: f64,
    /// Spacing ΔY, away from the side lobes if these are refined.
    pub dy: f64,
    /// Inlet, outlet and outer edge (Y₀ < 0) of the half domain.
    pub domain: (f64, f64, f64),
    /// Factor by which the spacing across is finer in the side lobes, in which H_min lies; 1 is equidistant. Above 8,
    /// the finest spacing lies close to the edge of the contact, for thin films. For a value below 1, the spacing grows
    /// from the axis to the outer edge by the inverse of this factor. Then the pressure continues beyond the ends of the
    /// domain, for lightly loaded contacts.
    #[serde(default = "equidistant")]
    pub refinement: f64,
}

fn equidistant() -> f64 {
    1.0
}

/// Widest spacing along X and across in the usual domains.
const WIDEST_DX: f64 = 0.1;
const WIDEST_DY: f64 = 0.2;
/// Minimum number of cells along X and across in larger domains.
const FEWEST: (f64, f64) = (60.0, 10.0);
/// Smallest spacing across relative to that at the outer edge.
const COARSEST: f64 = 0.02;
/// Position of the side lobes in heavily loaded contacts, and half-width of the refined zone.
const SIDE_LOBE: f64 = -0.95;
const SIDE_LOBE_WIDTH: f64 = 0.1;
/// Largest refinement of these lobes. Above it, the lobes are those of a thin film.
const MOST_WIDE: f64 = 8.0;
/// Finest spacing across relative to that at the outer edge.
const FINEST: f64 = 1000.0;
/// Distance of the lobes of a thin film from the edge of the contact, in their spacings.
const THIN_LOBE: f64 = 4.0;
/// Growth of the spacing with the distance from these lobes.
const GROWTH: f64 = 0.25;

impl PointGridSpec {
    /// Grid of the dissertation, section 3.2: 301×41 nodes.
    pub const DISSERTATION: Self = Self::uniform(0.02, 0.05, (-4.0, 2.0, -2.0));

    /// Grid of the dissertation with four times finer spacing across in the side lobes: 301×59 nodes. Its H_min lies
    /// within 2 % of that on 301×161.
    pub const EXPLORER: Self = Self { refinement: 4.0, ..Self::DISSERTATION };

    /// Coarse grid of Table 2.3, 151×41 nodes, for interactive pictures. H_c is 5 % too small at M = 200.
    pub const QUICK: Self = Self::uniform(0.04, 0.05, (-4.0, 2.0, -2.0));

    /// Fine grid of 601×81 nodes.
    pub const FINE: Self = Self::uniform(0.01, 0.025, (-4.0, 2.0, -2.0));

    /// Fine grid with four times finer spacing across in the side lobes: 601×116 nodes.
    pub const FINEST: Self = Self { refinement: 4.0, ..Self::FINE };

    /// Creates a specification with equidistant nodes in both directions. The domain is inlet, outlet and outer edge.
    pub const fn uniform(dx: f64, dy: f64, domain: (f64, f64, f64)) -> Self {
        Self { dx, dy, refinement: 1.0, domain }
    }

    /// Returns the number of nodes along X and across, boundaries and axis included.
    ///
    /// # Errors
    /// If the domain cuts the contact, or the spacing is too wide or too narrow.
    pub fn nodes(&self) -> Result<(usize, usize), GridError> {
        let (from, to, edge) = self.domain;
        let along = (-LONGEST_INLET..=-1.5).contains(&from) && (1.2..=LONGEST_OUTLET).contains(&to);
        if !(along && (-LONGEST_OUTLET..=-1.2).contains(&edge)) {
            let [from, to, edge] = [from, to, edge].map(Number);
            return Err(GridError::Refused(format!(
                "the half domain {from} ≤ X ≤ {to}, {edge} ≤ Y ≤ 0 cuts the contact; its inlet must lie between \
                 −{LONGEST_INLET} and −1.5, its outlet between 1.2 and {LONGEST_OUTLET}, its edge between \
                 −{LONGEST_OUTLET} and −1.2"
            )));
        }
        let widest = (WIDEST_DX.max((to - from) / FEWEST.0), WIDEST_DY.max(-edge / FEWEST.1));
        for (name, spacing, widest) in [("ΔX", self.dx, widest.0), ("ΔY", self.dy, widest.1)] {
            if !(1e-4..=widest).contains(&spacing) {
                let spacing = Number(spacing);
                return Err(GridError::Refused(format!(
                    "{name} is {spacing}, but must lie between 1e-4 and {widest}: fewer nodes cannot hold the contact"
                )));
            }
        }
        if !(COARSEST..=FINEST).contains(&self.refinement) {
            let refinement = Number(self.refinement);
            return Err(GridError::Refused(format!(
                "the refinement of the side lobes is {refinement}, but must lie between 1 (equidistant) and {FINEST}, or \
                 between {COARSEST} and 1 (wider towards the outer edge)"
            )));
        }
        let cells = self.cells_beyond(edge).round();
        Ok((((to - from) / self.dx).round() as usize + 1, cells as usize + 1))
    }

    /// Returns the number of cells between an ordinate Y ≤ 0 and the axis: ∫ dY/spacing. The spacing is dy/(1 +
    /// (refinement − 1)/(1 + t²)), where t is the distance to the side lobe in units of its width. For a refinement
    /// above [`MOST_WIDE`], it grows linearly from dy/refinement at the side lobe to dy.
    fn cells_beyond(&self, y: f64) -> f64 {
        if self.continues() {
            let growth = (1.0 / self.refinement - 1.0) / -self.domain.2;
            return (-growth * y).ln_1p() / (growth * self.dy);
        }
        if self.refinement > MOST_WIDE {
            let finest = self.dy / (self.refinement - 1.0);
            let lobe = THIN_LOBE * finest - 1.0;
            let growing = |y: f64| (GROWTH * (y - lobe) / finest).asinh() / GROWTH;
            return -y / self.dy + growing(0.0) - growing(y);
        }
        let angle = |y: f64| ((y - SIDE_LOBE) / SIDE_LOBE_WIDTH).atan();
        (-y + (self.refinement - 1.0) * SIDE_LOBE_WIDTH * (angle(0.0) - angle(y))) / self.dy
    }

    /// True if the pressure continues beyond the ends of the domain.
    pub fn continues(&self) -> bool {
        self.refinement < 1.0
    }

    /// Returns the ordinates from the outer edge to the axis, at equal distances in the cell count.
    pub fn ordinates(&self, ny: usize) -> Vec<f64> {
        let edge = self.domain.2;
        let all = self.cells_beyond(edge);
        let at = |j: usize| {
            let wanted = all * (ny - 1 - j) as f64 / (ny - 1) as f64;
            // The cell count falls monotonically from the edge to the axis: bisection to rounding.
            let (mut low, mut high) = (edge, 0.0);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if self.cells_beyond(middle) > wanted { low = middle } else { high = middle }
            }
            0.5 * (low + high)
        };
        let uniform = |j: usize| edge - edge * j as f64 / (ny - 1) as f64;
        (0..ny)
            .map(|j| match j {
                0 => edge,
                // The last node lies exactly on the axis.
                j if j + 1 == ny => 0.0,
                j if self.refinement == 1.0 => uniform(j),
                j => at(j),
            })
            .collect()
    }

    /// Checks the specification as [`PointGridSpec::build`] does, without building the grid. Returns the number of
    /// nodes.
    ///
    /// # Errors
    /// If the domain cuts the contact, or the grid is too coarse for it or too fine for the memory.
    pub fn check(&self) -> Result<(usize, usize), GridError> {
        let (nx, ny) = self.nodes()?;
        let bytes = Self::bytes(nx, ny);
        if bytes <= MAX_BYTES {
            return Ok((nx, ny));
        }
        Err(GridError::Refused(format!(
            "a grid of {nx}×{ny} nodes would need {:.1} GB of memory; at most {:.1} GB are accepted: take a wider \
             spacing, above all across (dy)",
            bytes / 1e9,
            MAX_BYTES / 1e9
        )))
    }

    /// Returns the memory in bytes of the kernel and the preconditioner for nx × ny nodes. They grow as nx·ny², all
    /// other data as nx·ny.
    fn bytes(nx: usize, ny: usize) -> f64 {
        let (nx, ny) = (nx as f64, ny as f64);
        nx * ny * ny * (8.0 + 24.0) + nx * ny * 8.0 * 160.0
    }

    /// Builds the grid and its kernel. This is expensive and done once per specification.
    ///
    /// # Errors
    /// If the domain cuts the contact, or the grid is too coarse for it or too fine for the memory.
    pub fn build(&self) -> Result<Arc<PointGrid>, GridError> {
        self.with(PointFlexibility::new)
    }

    /// As [`Self::build`], but computes the kernel when it is first used.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn build_without_kernel(&self) -> Result<Arc<PointGrid>, GridError> {
        self.with(|hx, nx, y, edges, factor| Ok(PointFlexibility::later(hx, nx, y, edges, factor)))
    }

    fn with(
        &self,
        kernel: impl FnOnce(f64, usize, &[f64], &[f64], f64) -> Kernel,
    ) -> Result<Arc<PointGrid>, GridError> {
        let (nx, ny) = self.check()?;
        let (from, to, _) = self.domain;
        let x: Vec<f64> = (0..nx).map(|i| from + (to - from) * i as f64 / (nx - 1) as f64).collect();
        Ok(Arc::new(PointGrid::new(*self, x, self.ordinates(ny), Ellipse::CIRCLE, kernel)?))
    }
}

/// Kernel of a grid, or the reason why there is none.
type Kernel = Result<PointFlexibility, KernelError>;

/// Grid on the half domain of a point contact, with its kernel.
#[derive(Debug)]
pub struct PointGrid {
    /// Specification from which it was built.
    pub spec: PointGridSpec,
    /// Shape whose semi-axes are the units of X and Y.
    pub ellipse: Ellipse,
    /// Abscissae X, equidistant.
    pub x: Vec<f64>,
    /// Ordinates Y from the outer edge to 0.
    pub y: Vec<f64>,
    /// Ordinates κY in units of a, used for distances in the equations and the kernel. κ = b/a is the ratio of the
    /// semi-axes.
    pub across: Vec<f64>,
    /// Quadrature weights of node arrays: the cells of both halves, so that wᵀP is the integral (2.29). Zero where P
    /// vanishes.
    pub weights: Vec<f64>,
    /// Deformation of every node by every pressure.
    pub flexibility: PointFlexibility,
    /// Difference coefficients along X of the unknowns' columns.
    columns: Vec<RowGeometry>,
}

impl PointGrid {
    fn new(
        spec: PointGridSpec,
        x: Vec<f64>,
        y: Vec<f64>,
        ellipse: Ellipse,
        kernel: impl FnOnce(f64, usize, &[f64], &[f64], f64) -> Kernel,
    ) -> Result<Self, GridError> {
        let (nx, ny) = (x.len(), y.len());
        let edges: Vec<f64> = (0..ny).map(|j| if j + 1 < ny { 0.5 * (y[j] + y[j + 1]) } else { 0.0 }).collect();
        let hx = (x[nx - 1] - x[0]) / (nx - 1) as f64;
        let mut weights = vec![0.0; nx * ny];
        for column in weights.chunks_exact_mut(ny).skip(1).take(nx - 2) {
            for (j, weight) in column.iter_mut().enumerate().skip(1) {
                *weight = 2.0 * hx * (edges[j] - edges[j - 1]);
            }
        }
        let columns = (1..nx - 1)
            .map(|i| match i {
                1 => RowGeometry::first_column([x[0], x[1], x[2]]),
                _ => RowGeometry::new([x[i - 2], x[i - 1], x[i], x[i + 1]]),
            })
            .collect();
        let in_a = |values: &[f64]| values.iter().map(|y| ellipse.kappa * y).collect::<Vec<f64>>();
        let across = in_a(&y);
        let flexibility = kernel(hx, nx, &across, &in_a(&edges), ellipse.kernel_factor())?;
        Ok(Self { spec, ellipse, x, y, across, weights, flexibility, columns })
    }

    /// Returns the same nodes in the semi-axes of an ellipse, with its kernel, or this grid if it has that ellipse.
    ///
    /// # Errors
    /// If the kernel cannot be transformed.
    pub fn of_ellipse(self: &Arc<Self>, ellipse: Ellipse) -> Result<Arc<Self>, GridError> {
        if ellipse == self.ellipse {
            return Ok(Arc::clone(self));
        }
        Ok(Arc::new(Self::new(self.spec, self.x.clone(), self.y.clone(), ellipse, PointFlexibility::new)?))
    }

    /// Returns the number of nodes along X, both ends included.
    pub fn nx(&self) -> usize {
        self.x.len()
    }

    /// Returns the number of nodes across, outer edge and axis included.
    pub fn ny(&self) -> usize {
        self.y.len()
    }

    /// Returns the length of node arrays.
    pub fn len(&self) -> usize {
        self.x.len() * self.y.len()
    }

    /// Always returns `false`.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Returns the number of unknown pressures in one column of nodes.
    pub fn column_unknowns(&self) -> usize {
        self.y.len() - 1
    }

    /// Returns the number of unknown pressures.
    pub fn unknowns(&self) -> usize {
        (self.x.len() - 2) * self.column_unknowns()
    }

    /// Returns the node index of an unknown.
    pub fn node(&self, unknown: usize) -> usize {
        let m = self.column_unknowns();
        (unknown / m + 1) * self.ny() + unknown % m + 1
    }

    /// Returns the stencil of an unknown's equation: its nodes and coefficients. A node missing at the first column
    /// or the axis is replaced by a neighbour with weight zero.
    pub fn row(&self, unknown: usize) -> ([usize; STENCIL], RowGeometry) {
        let (m, ny) = (self.column_unknowns(), self.ny());
        let (column, j) = (unknown / m, unknown % m + 1);
        let node = (column + 1) * ny + j;
        let on_axis = j + 1 == ny;
        let south = self.across[j] - self.across[j - 1];
        let north = (!on_axis).then(|| self.across[j + 1] - self.across[j]);
        let west2 = if column == 0 { node - ny } else { node - 2 * ny };
        let stencil = [west2, node - ny, node, node + ny, node - 1, if on_axis { node - 1 } else { node + 1 }];
        (stencil, self.columns[column].across(south, north))
    }

    /// Computes the deformation Δ = K P at every node, (2.38). Both slices are node arrays.
    pub fn deform(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut PointScratch) {
        self.flexibility.apply(pressure, deformation, scratch);
    }

    /// Returns the gap of the undeformed bodies (X² + g_y Y²)/2 at a node, (2.24).
    pub fn parabola(&self, node: usize) -> f64 {
        let (x, y) = (self.x[node / self.ny()], self.y[node % self.ny()]);
        0.5 * (x * x + self.ellipse.gap_curvature() * y * y)
    }

    /// Returns the value of a node array on the axis at X by cubic interpolation.
    pub fn on_axis(&self, values: &[f64], x: f64) -> f64 {
        self.interpolation_on_axis(x).iter().map(|(node, w)| w * values[*node]).sum()
    }

    /// Returns nodes and weights of the cubic interpolation on the axis at X. At a node, its weight is 1 and all
    /// others are 0.
    pub fn interpolation_on_axis(&self, x: f64) -> [(usize, f64); 4] {
        let (first, weights) = cubic(&self.x, x);
        let ny = self.ny();
        std::array::from_fn(|k| ((first + k) * ny + ny - 1, weights[k]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dissertations_grid_has_11960_unknowns() {
        let grid = PointGridSpec::DISSERTATION.build().unwrap();
        assert_eq!((grid.nx(), grid.ny(), grid.unknowns()), (301, 41, 11960));
        let area: f64 = grid.weights.iter().sum();
        assert!((area - 299.0 * 0.02 * 79.0 * 0.05).abs() < 1e-9, "{area}");
        let axis = grid.weights[150 * 41 + 40];
        assert!((axis - 0.02 * 0.05).abs() < 1e-15 && (grid.weights[150 * 41 + 39] - 2.0 * axis).abs() < 1e-15);
        assert_eq!(grid.node(0), 42);
        assert_eq!(grid.node(11959), 299 * 41 + 40);
    }

    #[test]
    fn a_graded_grid_is_finer_in_the_side_lobes_and_smooth() {
        let grid = PointGridSpec::EXPLORER.build().unwrap();
        let steps: Vec<f64> = grid.y.windows(2).map(|w| w[1] - w[0]).collect();
        let near = |y: f64| steps[grid.y.partition_point(|&node| node < y) - 1];
        assert!((0.012..0.0145).contains(&near(-0.95)) && near(-0.01) > 0.045 && near(-1.9) > 0.045);
        assert!(steps.windows(2).all(|w| (0.8..1.25).contains(&(w[1] / w[0]))), "{steps:?}");
        assert_eq!((grid.y[0], grid.y[grid.ny() - 1]), (-2.0, 0.0));
        let area: f64 = grid.weights.iter().sum();
        assert!((area - 299.0 * 0.02 * (4.0 - steps[0])).abs() < 1e-9, "{area}");
    }

    #[test]
    fn side_lobes_of_thin_films_are_refined() {
        let grid = PointGridSpec { refinement: 20.0, ..PointGridSpec::DISSERTATION }.build().unwrap();
        let steps: Vec<f64> = grid.y.windows(2).map(|w| w[1] - w[0]).collect();
        let near = |y: f64| steps[grid.y.partition_point(|&node| node < y) - 1];
        assert!((0.002..0.003).contains(&near(-0.99)) && near(-0.5) > 0.03 && near(-1.9) > 0.04, "{steps:?}");
        assert!(steps.windows(2).all(|w| (0.75..1.33).contains(&(w[1] / w[0]))), "{steps:?}");
        assert_eq!((grid.y[0], grid.y[grid.ny() - 1]), (-2.0, 0.0));
    }

    #[test]
    fn bad_grids_are_refused_with_a_sentence() {
        let good = PointGridSpec::DISSERTATION;
        for (spec, word) in [
            (PointGridSpec { domain: (-0.5, 2.0, -2.0), ..good }, "cuts the contact"),
            (PointGridSpec { domain: (-4.0, 2.0, f64::NAN), ..good }, "cuts the contact"),
            (PointGridSpec { domain: (-4.0, 2.0, -0.9), ..good }, "cuts the contact"),
            (PointGridSpec { dx: 0.5, ..good }, "cannot hold the contact"),
            (PointGridSpec { dy: f64::NAN, ..good }, "ΔY"),
            (PointGridSpec { refinement: 0.01, ..good }, "refinement"),
            (PointGridSpec { dx: 1e-3, dy: 1e-3, ..good }, "GB of memory"),
        ] {
            let message = spec.build().unwrap_err().to_string();
            assert!(message.contains(word), "{message}");
        }
    }
}
