//! One basis of a transient model: its reduced operators, and the discrete Reynolds equations at the sampled nodes, whose
//! coefficients are set for every time step.

use crate::solver::discrete::grid::ContactGrid;
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::full::transient::{Conditions, History, Step};
use crate::solver::reduced::Window;
use crate::solver::reduced::contact_rows::ContactRows;
use crate::solver::reduced::operators::{Flow, Operators, passed_rows};

/// Reduced operators of a basis, and the stencils from which a time step forms its equations. A row is the discrete
/// Reynolds equation of one node.
pub(super) struct Part {
    /// Reduced operators.
    pub operators: Operators,
    /// Stencils and coefficients of the sampled equations and of the rows of nodes that the cavitation boundary may cross,
    /// for flow from the inlet and from the outlet. The flow of a point contact comes from the inlet.
    sides: Vec<[Side; 2]>,
    /// Nodes of these rows, and their X.
    pub nodes: Vec<usize>,
    pub x: Vec<f64>,
    /// Modes at the nodes from which central and minimum film thickness and pressure are read.
    pub contact: ContactRows,
}

/// Stencil and coefficients of a row for one flow direction.
#[derive(Clone, Copy, Default)]
struct Side {
    stencil: [usize; STENCIL],
    geometry: RowGeometry,
}

impl Part {
    /// Builds the operators and stencils of the whole basis or of a local one.
    pub fn new(window: &Window) -> Self {
        let (grid, modes) = (&window.grid, window.pressure.count());
        let rows: Vec<usize> = window.sampled_rows.iter().copied().chain(passed_rows(window)).collect();
        let further: Vec<usize> = match grid {
            ContactGrid::Line(grid) => rows.iter().map(|row| (row + 4).min(grid.xi.len() - 1)).collect(),
            ContactGrid::Point(_) => Vec::new(),
        };
        let operators = Operators::new(window, modes, None, Flow::Transient(&further));
        let side = |(stencil, geometry): ([usize; STENCIL], RowGeometry)| Side {
            stencil: stencil.map(|node| operators.place(node)),
            geometry,
        };
        let sides = rows.iter().map(|&row| match grid {
            ContactGrid::Line(line) => [1.0, -1.0].map(|velocity| {
                let upstream = Upstream::of(velocity, row, grid.unknowns());
                side((upstream.stencil(row), upstream.geometry(&line.xi, row)))
            }),
            ContactGrid::Point(_) => [side(grid.row(row)); 2],
        });
        let sides = sides.collect();
        let nodes: Vec<usize> = rows.iter().map(|row| grid.node(*row)).collect();
        let (pressure, deformation) = (window.pressure.basis().modes.as_ref(), window.pressure.flexed().as_ref());
        Self {
            x: nodes.iter().map(|node| grid.place(*node).0).collect(),
            nodes,
            sides,
            operators,
            contact: match grid {
                ContactGrid::Line(line) => ContactRows::new(&line.scaled(1.0), pressure, deformation),
                ContactGrid::Point(plane) => ContactRows::new(&**plane, pressure, deformation),
            },
        }
    }

    /// Sets the coefficients of the sampled equations for a step. [`History::carry`] must have interpolated the previous
    /// states to these nodes before.
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
