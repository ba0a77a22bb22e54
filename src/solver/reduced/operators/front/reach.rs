//! Position of the boundary B in a node array, and nodes that it may reach.

use crate::solver::discrete::grid::ContactGrid;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::model::Window;

/// Number of nodes that B may move beyond its positions in the training.
const MARGIN: usize = 4;
/// Number of nodes that B of a rough contact may move beyond its positions in the training, for a line and for each line
/// of a plane.
const FARTHER: [usize; 2] = [16, 6];
/// Number of nodes in front of B whose pressures are checked: k of (D.17).
pub(super) const BEFORE: usize = 5;

/// Returns, for each line along X, the first column of a node array behind which no pressure is positive.
pub(crate) fn fronts(grid: &ContactGrid, pressure: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut fronts = vec![0; grid.lines()];
    for node in (0..grid.unknowns()).map(|k| grid.node(k)) {
        let (line, column) = grid.line_and_column(node);
        if fronts[line] == 0 || pressure(node) > 0.0 {
            fronts[line] = column + 1;
        }
    }
    fronts
}

/// Sets pressures behind B to zero.
pub(crate) fn cut_off(grid: &ContactGrid, fronts: &[usize], pressure: &mut [f64]) {
    let across = grid.nodes().1;
    let before = across - grid.lines();
    for (column, nodes) in pressure.chunks_exact_mut(across).enumerate() {
        for (p, front) in nodes[before..].iter_mut().zip(fronts) {
            if column >= *front {
                *p = 0.0;
            }
        }
    }
}

/// Returns the nodes that B may pass, line by line, as ranges of columns.
pub(super) fn passed(window: &Window) -> Vec<(usize, usize)> {
    let grid = &window.grid;
    let last = (0..grid.unknowns()).map(|k| grid.line_and_column(grid.node(k)).1).max().unwrap_or(0);
    let first = grid.line_and_column(grid.node(0)).1;
    let of_line = |line: usize| {
        let own = || window.snapshots.iter().filter_map(move |snapshot| snapshot.fronts.get(line).copied());
        let lowest = own().min().unwrap_or(last).saturating_sub(BEFORE + MARGIN).max(first);
        let highest = (own().max().unwrap_or(last) + 1).min(last);
        (lowest, highest.max(lowest))
    };
    (0..grid.lines()).map(of_line).collect()
}

/// Calls `tell` with line and unknown of the rows that B of a rough contact may pass or look at, line by line along X.
/// Every line has at least one.
pub(in crate::solver::reduced::operators) fn each_near(window: &Window, mut tell: impl FnMut(usize, usize)) {
    let (grid, lines) = (&window.grid, window.grid.lines());
    let first = grid.line_and_column(grid.node(0)).1;
    let columns = grid.unknowns() / lines;
    let farther = FARTHER[usize::from(grid.kind().is_point())];
    for line in 0..lines {
        let fronts = || window.snapshots.iter().filter_map(|snapshot| snapshot.fronts.get(line).copied());
        let end = (fronts().max().unwrap_or(columns) + farther).saturating_sub(first).clamp(1, columns);
        let lowest = fronts().min().unwrap_or(first).saturating_sub(farther + first).min(end - 1);
        (lowest..end).for_each(|column| tell(line, column * lines + line));
    }
}

/// Returns the rows, as unknowns, that the boundary may pass, line by line; empty for cavitation by a penalty.
pub(crate) fn passed_rows(window: &Window) -> Vec<usize> {
    let mut rows = Vec::new();
    if window.cavitation == Cavitation::Complementarity {
        each_passed(window, |_, unknown| rows.push(unknown));
    }
    rows
}

/// Calls `tell` with line and unknown of every node that B may pass, line by line.
pub(super) fn each_passed(window: &Window, mut tell: impl FnMut(usize, usize)) {
    let (grid, lines) = (&window.grid, window.grid.lines());
    let first = grid.line_and_column(grid.node(0)).1;
    for (line, (lowest, highest)) in passed(window).into_iter().enumerate() {
        (lowest..=highest).for_each(|column| tell(line, (column - first) * lines + line));
    }
}
