//! Nodes of a grid at which temperatures are marched: every few nodes of a line, or of a few lines of a plane.

use crate::solver::discrete::grid::{ContactGrid, INLET};
use crate::solver::physics::contact::ContactKind;

/// Minimum number of stations along a line contact. With 90, tractions of fast contacts with little sliding have an
/// error of 1.5 %.
const STATIONS: usize = 120;

/// Minimum distance of stations along the lines of a plane in the contact; multiplied by −X in front of it. With
/// 0.075, or with seven lines, film thicknesses of the hottest contacts have an error of more than 1 %.
const SPACING: f64 = 0.055;
/// X where this distance ends, and the distance behind it.
const BEHIND: f64 = 1.15;
const SPACING_BEHIND: f64 = 0.15;

/// −Y of the marched lines of a plane; the nearest lines of the grid are used.
const ORDINATES: [f64; 11] = [1.5, 1.2, 1.05, 0.95, 0.85, 0.75, 0.62, 0.48, 0.32, 0.16, 0.0];

/// Pressures behind X = 0 up to which the film of a plane counts as cavitated in the sum of the traction; smaller
/// pressures are remainders of the modes. In lightly loaded contacts, whose viscosity hardly rises with pressure,
/// they would add 1 % to the traction.
const LEFT: f64 = 1e-4;

/// Nodes of a grid at which temperatures are marched.
pub(crate) struct Stations {
    /// Columns of nodes, from the inlet to the outlet.
    columns: Vec<usize>,
    /// Lines along X, from the edge of a plane to its axis.
    lines: Vec<usize>,
    /// Number of nodes across.
    across: usize,
}

impl Stations {
    /// Selects the stations of a grid.
    pub fn of(grid: &ContactGrid) -> Self {
        let ((xi, y), across) = (grid.abscissae(), grid.nodes().1);
        if grid.kind().is_line() {
            return Self { columns: along_line(grid.len()), lines: vec![0], across };
        }
        let nearest =
            |wanted: f64| (0..across).min_by(|&a, &b| (y[a] + wanted).abs().total_cmp(&(y[b] + wanted).abs()));
        let mut lines: Vec<usize> = ORDINATES.into_iter().filter_map(nearest).collect();
        lines.dedup();
        Self { columns: along_plane(xi), lines, across }
    }

    /// Returns the abscissae ξ of the columns.
    pub fn xi(&self, grid: &ContactGrid) -> Vec<f64> {
        self.columns.iter().map(|&column| grid.abscissae().0[column]).collect()
    }

    /// Returns the ordinates of the lines in units of a.
    pub fn y(&self, grid: &ContactGrid) -> Vec<f64> {
        self.lines.iter().map(|&line| grid.abscissae().1[line]).collect()
    }

    /// Returns the nodes at the stations of each line.
    pub fn nodes(&self) -> impl Iterator<Item = Vec<usize>> + '_ {
        self.lines.iter().map(|line| self.columns.iter().map(|column| column * self.across + line).collect())
    }

    /// Returns the first three nodes of each line, for the one-sided slope at the inlet.
    pub fn inlets(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let first = self.columns.first().copied().unwrap_or_default();
        self.lines.iter().map(move |line| [0, 1, 2].map(|k| (first + k) * self.across + line))
    }
}

/// Returns equally spaced nodes of a line contact from the inlet to the outlet.
fn along_line(nodes: usize) -> Vec<usize> {
    let last = nodes - 1;
    let stride = ((last - INLET) / STATIONS).max(1);
    (INLET..last).step_by(stride).filter(|node| last - node >= stride).chain([last]).collect()
}

/// Returns columns of a plane with the minimum distances.
fn along_plane(xi: &[f64]) -> Vec<usize> {
    let (mut out, mut last) = (vec![0], xi[0]);
    for (column, &xi) in xi.iter().enumerate().take(xi.len() - 1) {
        let apart = if xi < BEHIND { SPACING * (-xi).max(1.0) } else { SPACING_BEHIND };
        // Tolerance for rounding in sums of spacings.
        if xi - last >= apart * (1.0 - 1e-9) {
            out.push(column);
            last = xi;
        }
    }
    out.push(xi.len() - 1);
    out
}

/// Returns P at X as used in the traction of thermal contacts.
pub(crate) fn carried(kind: ContactKind, x: f64, pressure: f64) -> f64 {
    if kind.is_point() && x > 0.0 && pressure <= LEFT { 0.0 } else { pressure }
}
