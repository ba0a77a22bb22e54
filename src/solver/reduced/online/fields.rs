//! From a reduced solution back to fields: the only large-scale work online, on request.

use super::{Online, ReducedError, ReducedSolution, operators_of};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::discrete::nodes::Nodes;
use crate::solver::full::{Mesh, Problem, Report, Scalars, Solution, Termination, scalars_of};
use crate::solver::reduced::operators::cut_off;
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Mat, Par};

impl Online {
    /// Fields and scalars of a reduced solution, on the window's grid; `report.newton_iterations` holds the online
    /// iterations.
    ///
    /// # Errors
    /// When the solution's point is refused or it belongs to another model.
    pub fn reconstruct(&self, solution: &ReducedSolution) -> Result<Solution, ReducedError> {
        let fields = self.fields(solution)?;
        let scalars = fields.scalars(solution.h_0);
        let multiplier = fields.multiplier(&solution.fronts);
        let Fields { problem, grid, scale, pressure, film } = fields;
        let (x, y) = match &grid {
            ContactGrid::Line(grid) => (grid.scaled(scale).x, vec![0.0]),
            ContactGrid::Point(grid) => (grid.x.clone(), grid.y.clone()),
        };
        Ok(Solution {
            problem,
            mesh: Mesh { spec: grid.spec(), scale },
            scalars,
            x,
            y,
            pressure,
            film,
            multiplier,
            fraction: Vec::new(),
            report: Report {
                termination: Termination::Converged,
                newton_iterations: solution.iterations,
                linear_iterations: 0,
                attempts: 1,
                residuals: Vec::new(),
                steps: Vec::new(),
                residual_norm: solution.residual_estimate,
                cautious_front: false,
            },
            grid_cost: None,
        })
    }

    /// Scalars only.
    ///
    /// # Errors
    /// When the solution's point is refused or it belongs to another model.
    pub fn scalars(&self, solution: &ReducedSolution) -> Result<Scalars, ReducedError> {
        Ok(self.fields(solution)?.scalars(solution.h_0))
    }

    /// The smallest film at any node.
    pub(super) fn lowest_film(&self, solution: &ReducedSolution) -> Result<f64, ReducedError> {
        let lower = |a: f64, b: &f64| if b.is_nan() { *b } else { a.min(*b) };
        Ok(self.fields(solution)?.film.iter().fold(f64::INFINITY, lower))
    }

    fn fields(&self, solution: &ReducedSolution) -> Result<Fields, ReducedError> {
        let problem = Problem::new(&solution.point, solution.lubricant)?;
        let (Some(window), Some(cell)) = (self.model.windows.get(solution.window), self.windows.get(solution.window))
        else {
            return Err(ReducedError::Empty);
        };
        let operators = cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        let modes = solution.coefficients.len();
        if modes > window.pressure.modes.ncols() || modes != operators.modes {
            return Err(ReducedError::Empty);
        }
        let scale = window.grid.scale(problem.moes);
        let multiply = |matrix: faer::MatRef<'_, f64>| {
            let mut out = vec![0.0; matrix.nrows()];
            matmul(
                ColMut::from_slice_mut(&mut out).as_mat_mut(),
                Accum::Replace,
                matrix,
                ColRef::from_slice(&solution.coefficients).as_mat(),
                1.0,
                Par::Seq,
            );
            out
        };
        let mut pressure = multiply(window.pressure.modes.get(.., ..modes));
        let ellipse = problem.point.ellipse();
        let mut film = match &window.shapes {
            None => multiply(operators.deformation(window)),
            Some(shapes) => {
                let mut film = vec![0.0; pressure.len()];
                for (weight, flexed) in shapes.weights(&ellipse).into_iter().zip(&shapes.flexed) {
                    let part = multiply(flexed.get(.., ..modes));
                    film.iter_mut().zip(part).for_each(|(film, part)| *film += weight * part);
                }
                film
            }
        };
        if !solution.fronts.is_empty() {
            let whole = pressure.clone();
            cut_off(&window.grid, &solution.fronts, &mut pressure);
            let missing = Mat::from_fn(whole.len(), 1, |i, _| whole[i] - pressure[i]);
            let bent = window.grid.flex(&missing);
            film.iter_mut().zip(bent.col(0).iter()).for_each(|(film, bent)| *film -= bent);
            // What modes leave before B.
            pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        }
        let (offset, curvature) = (solution.h_0 - 0.5 * scale.ln(), ellipse.gap_curvature());
        for (node, h) in film.iter_mut().enumerate() {
            let (xi, y) = window.grid.place(node);
            let x = -1.0 + (xi + 1.0) * scale;
            *h = offset + 0.5 * (x * x + curvature * y * y) + scale * *h;
        }
        Ok(Fields { problem, grid: window.grid.clone(), scale, pressure, film })
    }
}

/// Reconstructed node arrays.
struct Fields {
    problem: Problem,
    grid: ContactGrid,
    scale: f64,
    pressure: Vec<f64>,
    film: Vec<f64>,
}

impl Fields {
    /// λ behind the rupture boundary, node array; empty where there is none.
    fn multiplier(&self, fronts: &[usize]) -> Vec<f64> {
        let Self { problem, grid, scale, pressure, film } = self;
        if fronts.is_empty() {
            return Vec::new();
        }
        let mut multiplier = vec![0.0; pressure.len()];
        let nodes = Nodes::of(problem.laws(), &grid.gradient(), pressure, film);
        for unknown in 0..grid.unknowns() {
            let (line, column) = grid.line_and_column(grid.node(unknown));
            if column >= fronts[line] {
                let (stencil, geometry) = grid.row(unknown);
                multiplier[grid.node(unknown)] = -nodes.row(&geometry.scaled(*scale), 0.0, stencil).value;
            }
        }
        multiplier
    }

    fn scalars(&self, h_0: f64) -> Scalars {
        let Self { problem, grid, scale, pressure, film } = self;
        match grid {
            ContactGrid::Line(grid) => scalars_of(&grid.scaled(*scale), problem, pressure, film, h_0),
            ContactGrid::Point(grid) => scalars_of(&**grid, problem, pressure, film, h_0),
        }
    }
}
