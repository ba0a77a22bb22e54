//! From a reduced solution back to fields: the only large-scale work online, on request.

use super::{Online, ReducedError, ReducedSolution, operators_of};
use crate::solver::discrete::grid::{ContactGrid, INLET};
use crate::solver::discrete::heat::{March, Profile, WarmFilm};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::generalized::{NodalGradient, NodeState};
use crate::solver::full::heat::{NodeArrays, Temperatures, one_sided};
use crate::solver::full::{Mesh, Problem, Report, Scalars, Solution, Termination, scalars_of};
use crate::solver::reduced::operators::{cut_off, station_nodes};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Par};
use std::sync::Arc;

impl Online {
    /// Fields and scalars of a reduced solution, on the window's grid; `report.newton_iterations` holds the online
    /// iterations.
    ///
    /// # Errors
    /// When the solution's point is refused or it belongs to another model.
    pub fn reconstruct(&self, solution: &ReducedSolution) -> Result<Solution, ReducedError> {
        let fields = self.fields(solution)?;
        let scalars = fields.scalars(solution.h_0);
        let multiplier = fields.multiplier();
        let heat = solution.heat.as_ref().and_then(|warmth| fields.temperatures(&warmth.theta)).map(Arc::new);
        let Fields { problem, grid, scale, pressure, film, .. } = fields;
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
            grid_cost: self.model.windows.get(solution.window).and_then(|window| window.grid_cost(&solution.point)),
            heat,
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

    /// Fields of a solution, blended with those beside it.
    fn fields(&self, solution: &ReducedSolution) -> Result<Fields, ReducedError> {
        let mut blend = self.fields_of_window(solution, solution.own_h_0())?;
        let own = solution.own_share();
        if !solution.beside.is_empty() {
            blend.pressure.iter_mut().chain(&mut blend.film).for_each(|value| *value *= own);
        }
        for (share, other) in &solution.beside {
            let part = self.fields_of_window(other, other.h_0)?;
            if part.pressure.len() != blend.pressure.len() {
                return Err(ReducedError::Empty);
            }
            let add = |sum: &mut [f64], part: &[f64]| sum.iter_mut().zip(part).for_each(|(sum, p)| *sum += share * p);
            add(&mut blend.pressure, &part.pressure);
            add(&mut blend.film, &part.film);
            blend.fronts.iter_mut().zip(part.fronts).for_each(|(front, other)| *front = (*front).max(other));
        }
        Ok(blend)
    }

    fn fields_of_window(&self, solution: &ReducedSolution, h_0: f64) -> Result<Fields, ReducedError> {
        let problem = Problem::new(&solution.point, solution.lubricant)?;
        let (Some(window), Some(cell)) = (self.model.windows.get(solution.window), self.windows.get(solution.window))
        else {
            return Err(ReducedError::Empty);
        };
        let operators = cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        let modes = solution.coefficients.len();
        if modes > window.pressure.count() || modes != operators.modes {
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
        let mut pressure = multiply(window.pressure.basis().modes.get(.., ..modes));
        let ellipse = problem.point.ellipse();
        let ruptures = !solution.fronts.is_empty();
        let mut film = match &window.shapes {
            Some(shapes) => {
                let mut film = vec![0.0; pressure.len()];
                shapes.add_deformation(&ellipse, &solution.coefficients, &mut film);
                film
            }
            // What is cut off makes K P another one than that of the modes.
            None if ruptures && self.options.deformation_modes.is_none() => Vec::new(),
            None => multiply(operators.deformation(window)),
        };
        if ruptures {
            let whole = if film.is_empty() { Vec::new() } else { pressure.clone() };
            cut_off(&window.grid, &solution.fronts, &mut pressure);
            if film.is_empty() {
                film = window.grid.deformation(&pressure);
            } else {
                let missing: Vec<f64> = whole.iter().zip(&pressure).map(|(whole, kept)| whole - kept).collect();
                film.iter_mut().zip(window.grid.deformation(&missing)).for_each(|(film, bent)| *film -= bent);
            }
            // What modes leave before B.
            pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        }
        let (offset, curvature) = (h_0 - 0.5 * scale.ln(), ellipse.gap_curvature());
        for (node, h) in film.iter_mut().enumerate() {
            let (xi, y) = window.grid.place(node);
            let x = -1.0 + (xi + 1.0) * scale;
            *h = offset + 0.5 * (x * x + curvature * y * y) + scale * *h;
        }
        let fronts = solution.fronts.clone();
        Ok(Fields { problem, grid: window.grid.clone(), scale, pressure, film, fronts })
    }
}

/// Accuracy of the march that tells where heat goes.
const MARCHED: f64 = 1e-7;

/// Reconstructed node arrays.
struct Fields {
    problem: Problem,
    grid: ContactGrid,
    scale: f64,
    pressure: Vec<f64>,
    film: Vec<f64>,
    /// The first ruptured column of each line along X; empty under a penalty.
    fronts: Vec<usize>,
}

impl Fields {
    /// λ behind the rupture boundary, node array; empty where there is none.
    fn multiplier(&self) -> Vec<f64> {
        let Self { problem, grid, scale, pressure, film, fronts } = self;
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

    /// Temperatures by those at the stations of the march; none without heat.
    fn temperatures(&self, theta: &[Profile]) -> Option<Temperatures> {
        let Self { problem, grid: ContactGrid::Line(grid), scale, pressure, film, .. } = self else { return None };
        let (heat, laws) = (problem.heat.as_ref()?, problem.warm_laws()?);
        let x = grid.scaled(*scale).x;
        let gradient = NodalGradient::new(&x);
        let state = |node: usize| {
            let inlet = node == INLET;
            let ahead = || one_sided(&x[node..], [0, 1, 2].map(|k| pressure[node + k]));
            let slope = if inlet { ahead() } else { gradient.at(pressure, node) };
            NodeState { pressure: pressure[node], gradient: [slope, 0.0], film: film[node] }
        };
        let nodes = station_nodes(&self.grid);
        if theta.len() != nodes.len() {
            return None;
        }
        let states: Vec<NodeState> = nodes.iter().map(|&node| state(node)).collect();
        let mut march = March::new(nodes.iter().map(|&node| x[node]).collect());
        march.stations.iter_mut().zip(theta).for_each(|(station, theta)| station.theta = *theta);
        // What flows and where the heat goes, at the temperatures as they are.
        march.run(&problem.course(&states)?, 0.0, MARCHED);
        let mut warm = WarmFilm::default();
        warm.spread(&x, &march.x, |i| theta[i]);
        for (node, (theta, stress)) in warm.theta.iter().zip(&mut warm.stress).enumerate().skip(INLET) {
            laws.node(state(node), theta, stress);
        }
        let arrays = NodeArrays { x: &x, y: &[0.0], first: INLET, pressure, film, stress: &warm.stress };
        Some(Temperatures::marched(&[(&march, &states)], &[], &arrays, (problem, heat)))
    }

    fn scalars(&self, h_0: f64) -> Scalars {
        let Self { problem, grid, scale, pressure, film, .. } = self;
        match grid {
            ContactGrid::Line(grid) => scalars_of(&grid.scaled(*scale), problem, pressure, film, h_0),
            ContactGrid::Point(grid) => scalars_of(&**grid, problem, pressure, film, h_0),
        }
    }
}
