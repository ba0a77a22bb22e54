//! One basis of a transient model with its operators.

use crate::solver::discrete::grid::{FIRST_UNKNOWN, LineGrid};
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::full::transient::{Conditions, History, Step};
use crate::solver::reduced::Window;
use crate::solver::reduced::contact_rows::ContactRows;
use crate::solver::reduced::operators::{Flow, Operators, passed_rows};

/// Operators of a basis, and time-dependent data of its rows.
pub(super) struct Part {
    pub operators: Operators,
    /// Stencils and coefficients of the sampled equations and of the rows that the cavitation boundary may pass, for
    /// flow from the inlet and from the outlet.
    sides: Vec<[Side; 2]>,
    /// Nodes of these rows, and their X.
    pub nodes: Vec<usize>,
    pub x: Vec<f64>,
    pub contact: ContactRows,
}

/// Stencil and coefficients of a row for one flow direction.
#[derive(Clone, Copy, Default)]
struct Side {
    stencil: [usize; STENCIL],
    geometry: RowGeometry,
}

impl Part {
    /// Builds the basis and rows of a local model on its grid.
    pub fn new(window: &Window, grid: &LineGrid) -> Self {
        let modes = window.pressure.count();
        let (unknowns, last) = (grid.unknowns(), grid.len() - 1);
        let rows: Vec<usize> = window.sampled_rows.iter().copied().chain(passed_rows(window)).collect();
        let further: Vec<usize> = rows.iter().map(|row| (row + 4).min(last)).collect();
        let operators = Operators::new(window, modes, None, Flow::Transient(&further));
        let place = |node: usize| operators.place(node);
        let side = |row: usize, velocity: f64| {
            let upstream = Upstream::of(velocity, row, unknowns);
            Side { stencil: upstream.stencil(row).map(place), geometry: upstream.geometry(&grid.x, row) }
        };
        let sides: Vec<[Side; 2]> = rows.iter().map(|&row| [side(row, 1.0), side(row, -1.0)]).collect();
        Self {
            nodes: rows.iter().map(|row| row + FIRST_UNKNOWN).collect(),
            x: rows.iter().map(|row| grid.x[row + FIRST_UNKNOWN]).collect(),
            sides,
            operators,
            contact: ContactRows::new(grid, window.pressure.basis().modes.as_ref(), window.pressure.flexed().as_ref()),
        }
    }

    /// Sets the coefficients of the sampled equations for a step; the previous states must be interpolated before.
    pub fn set_rows(&mut self, step: &Step, history: &History) {
        let weights = step.history_weights();
        for (r, (sides, x)) in self.sides.iter().zip(&self.x).enumerate() {
            let velocity = step.velocity(*x);
            let Side { stencil, geometry } = sides[usize::from(velocity < 0.0)];
            let geometry = geometry.in_time(velocity.abs(), step.quotient.now, history.at(weights, r));
            self.operators.set_row(r, stencil, geometry);
        }
    }

    /// Sets the coefficients of the sampled equations for a steady contact.
    pub fn rest(&mut self, at: &Conditions) {
        for (r, sides) in self.sides.iter().enumerate() {
            self.operators.set_row(r, sides[0].stencil, sides[0].geometry.in_time(at.speed, 0.0, 0.0));
        }
    }
}
