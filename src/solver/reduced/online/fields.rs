//! Reconstructs pressure, film thickness and temperatures at all nodes from a reduced solution, and scalars from them.
//! This is the only online work on the whole grid. It is done on request.

use super::{Online, ReducedError, operators_of};
use crate::host::pool;
use crate::solver::discrete::grid::{ContactGrid, stretched};
use crate::solver::discrete::heat::{ACROSS, Lines, MovingSource, Profile, Spread, apply};
use crate::solver::discrete::nodes::{Laws, Nodes};
use crate::solver::discrete::reynolds::generalized::{FilmTreatment, NodeState, PlaneGradient};
use crate::solver::full::heat::{NodeArrays, Temperatures, one_sided};
use crate::solver::full::{Mesh, Problem, Report, Scalars, Solution, Termination, scalars_of};
use crate::solver::reduced::ReducedSolution;
use crate::solver::reduced::dense;
use crate::solver::reduced::operators::{Operators, Stations, carried, cut_off};
use std::borrow::Cow;
use std::cell::OnceCell;
use std::sync::Arc;

impl Online {
    /// Reconstructs fields and scalars of a reduced solution on the grid of its local model.
    /// `report.newton_iterations` holds the online iterations.
    ///
    /// # Errors
    /// [`ReducedError`] if the solution's point is refused or if it belongs to another model.
    pub fn reconstruct(&self, solution: &ReducedSolution) -> Result<Solution, ReducedError> {
        let fields = self.fields(solution)?;
        let scalars = fields.scalars(solution.h_0);
        let multiplier = fields.multiplier();
        let asperity_pressure = self.asperity_pressure(solution.window, &fields);
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
            asperity_pressure,
            report: Report {
                termination: Termination::Converged,
                newton_iterations: solution.iterations,
                linear_iterations: 0,
                attempts: 1,
                residuals: Vec::new(),
                steps: Vec::new(),
                residual_norm: solution.residual_estimate,
                cautious_front: false,
                reached: None,
            },
            grid_cost: self.model.windows.get(solution.window).and_then(|window| window.grid_cost(&solution.point)),
            heat,
        })
    }

    /// Returns the asperity pressure at all nodes; empty for smooth surfaces.
    fn asperity_pressure(&self, window: usize, fields: &Fields) -> Vec<f64> {
        let Fields { problem, grid, film, .. } = fields;
        let Some(rough) = &problem.rough else { return Vec::new() };
        let operators = self.windows.get(window).and_then(OnceCell::get);
        let known = operators.and_then(Operators::asperity_table).filter(|table| rough.fits(table));
        let table = known.map_or_else(|| Cow::Owned(rough.table()), Cow::Borrowed);
        let at_node = |(weight, film): (&f64, &f64)| {
            if *weight > 0.0 { rough.asperity_pressure(&table, *film).0 } else { 0.0 }
        };
        grid.weights().iter().zip(film).map(at_node).collect()
    }

    /// Reconstructs the fields of a reduced solution and returns only the scalars.
    ///
    /// # Errors
    /// [`ReducedError`] if the solution's point is refused or if it belongs to another model.
    pub fn scalars(&self, solution: &ReducedSolution) -> Result<Scalars, ReducedError> {
        Ok(self.fields(solution)?.scalars(solution.h_0))
    }

    /// Returns the minimum film thickness H over all nodes; NaN if one of them is NaN.
    pub(super) fn lowest_film(&self, solution: &ReducedSolution) -> Result<f64, ReducedError> {
        Ok(lowest(&self.fields(solution)?.film))
    }

    /// Reconstructs the fields of a solution, blended with those of its neighbouring local models.
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

    /// Reconstructs the fields of a solution in its own local model, with the rigid-body separation `h_0` of this
    /// model.
    fn fields_of_window(&self, solution: &ReducedSolution, h_0: f64) -> Result<Fields, ReducedError> {
        let problem = Problem::new(&solution.point, solution.lubricant)?;
        let (Some(window), Some(cell)) = (self.model.windows.get(solution.window), self.windows.get(solution.window))
        else {
            return Err(ReducedError::Empty);
        };
        let operators = cell.get_or_init(|| operators_of(&self.model, window, &self.options));
        let modes = solution.coefficients.len();
        if modes > window.pressure.count() || modes != operators.modes() {
            return Err(ReducedError::Empty);
        }
        let scale = window.grid.scale(problem.moes);
        let (nodes, across) = (window.grid.len(), window.grid.nodes().1);
        // Pressures behind the last cavitation boundary are zero.
        let ahead = match solution.fronts.iter().max() {
            Some(last) if self.options.deformation_modes.is_none() && window.shapes.is_none() && !window.is_rough() => {
                (last * across).min(nodes)
            }
            _ => nodes,
        };
        // Single precision is enough for point contacts: on their grids no film is so thin that the eighth digit of a
        // pressure matters.
        let single = window.grid.kind().is_point();
        let mut pressure = vec![0.0; nodes];
        window.pressure.field(&solution.coefficients, single, &mut pressure[..ahead]);
        let ellipse = problem.point.ellipse();
        // The total pressure of rough surfaces does not end at the cavitation boundary, so it is not cut off.
        let cuts_off = !solution.fronts.is_empty() && !window.is_rough();
        let mut film = match &window.shapes {
            Some(shapes) => {
                let mut film = vec![0.0; pressure.len()];
                let modes = &window.pressure.basis().modes;
                shapes.add_deformation(modes, &ellipse, &solution.coefficients, &mut film);
                film
            }
            // The deformation K P is computed below, from the pressures after the cut.
            None if cuts_off && self.options.deformation_modes.is_none() => Vec::new(),
            None => {
                let mut film = vec![0.0; nodes];
                dense::times(operators.deformation(window), &solution.coefficients, &mut film);
                film
            }
        };
        if cuts_off {
            let whole = if film.is_empty() { Vec::new() } else { pressure.clone() };
            cut_off(&window.grid, &solution.fronts, &mut pressure);
            if film.is_empty() {
                film = window.grid.deformation(&pressure);
            } else {
                let missing: Vec<f64> = whole.iter().zip(&pressure).map(|(whole, kept)| whole - kept).collect();
                film.iter_mut().zip(window.grid.deformation(&missing)).for_each(|(film, bent)| *film -= bent);
            }
            // In front of the boundary, negative pressures are remainders of the modes.
            pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        }
        let (offset, curvature) = (h_0 - 0.5 * scale.ln(), ellipse.gap_curvature());
        let across: Vec<f64> = (0..across).map(|j| window.grid.place(j).1).map(|y| curvature * y * y).collect();
        for (i, column) in film.chunks_exact_mut(across.len()).enumerate() {
            let x = stretched(window.grid.place(i * across.len()).0, scale);
            for (h, across) in column.iter_mut().zip(&across) {
                *h = offset + 0.5 * (x * x + across) + scale * *h;
            }
        }
        let fronts = if cuts_off { solution.fronts.clone() } else { Vec::new() };
        Ok(Fields { problem, grid: window.grid.clone(), scale, pressure, film, fronts })
    }
}

/// Tolerance of the march that computes the heat balance.
const MARCHED: f64 = 1e-7;

/// Number of nodes whose stress is computed by one parallel task.
const SHARE: usize = 256;

/// Reconstructed node arrays.
struct Fields {
    problem: Problem,
    grid: ContactGrid,
    /// Scale of the grid for this contact: X = stretched(ξ, scale).
    scale: f64,
    /// P.
    pressure: Vec<f64>,
    /// H.
    film: Vec<f64>,
    /// First cavitated column of each line along X; empty with a penalty or for rough surfaces.
    fronts: Vec<usize>,
}

impl Fields {
    /// Returns X of the columns of nodes.
    fn x(&self) -> Vec<f64> {
        self.grid.abscissae().0.iter().map(|xi| stretched(*xi, self.scale)).collect()
    }

    /// Returns the multiplier λ of the complementarity at all nodes, zero in front of the cavitation boundary; empty
    /// without a boundary.
    fn multiplier(&self) -> Vec<f64> {
        let Self { problem, grid, scale, pressure, film, fronts } = self;
        if fronts.is_empty() {
            return Vec::new();
        }
        let mut multiplier = vec![0.0; pressure.len()];
        let cavitated = |unknown: &usize| {
            let (line, column) = grid.line_and_column(grid.node(*unknown));
            column >= fronts[line]
        };
        let behind: Vec<usize> = (0..grid.unknowns()).filter(cavitated).collect();
        let rows: Vec<_> = behind.iter().map(|&unknown| grid.row(unknown)).collect();
        let mut nodes = Nodes::new(pressure.len(), problem.shear.is_some());
        let (laws, state) = (problem.laws(), (&pressure[..], &film[..]));
        let gradient = PlaneGradient::new(&self.x(), grid.abscissae().1);
        let gradient = |node: usize| gradient.at_node(pressure, node);
        let reached = rows.iter().flat_map(|(stencil, _)| *stencil).min().unwrap_or(pressure.len());
        let treatment = FilmTreatment::default();
        let newtonian = Laws { shear: None, ..laws };
        nodes.evaluate_part(&newtonian, reached..pressure.len(), state, gradient, treatment);
        if let Some(law) = laws.shear {
            // Shear-thinning has no effect without pressure nearby. Most rows behind the boundary have no pressure
            // nearby and are omitted.
            let near = |node: &usize| pressure[*node] != 0.0 || gradient(*node) != [0.0; 2];
            let affected = rows.iter().filter(|(stencil, _)| stencil.iter().any(near));
            let mut wanted: Vec<usize> = affected.flat_map(|(stencil, _)| *stencil).collect();
            wanted.sort_unstable();
            wanted.dedup();
            nodes.thin((&laws, law), wanted, state, gradient, treatment);
        }
        for (unknown, (stencil, geometry)) in behind.into_iter().zip(rows) {
            multiplier[grid.node(unknown)] = -nodes.row(&geometry.scaled(*scale), 0.0, stencil).value;
        }
        multiplier
    }

    /// Returns the temperature fields from the profiles θ at the stations. `None` for an isothermal contact, or if the
    /// number of profiles is not that of the stations.
    fn temperatures(&self, theta: &[Profile]) -> Option<Temperatures> {
        let Self { problem, grid, scale, pressure, film, .. } = self;
        let (heat, laws) = (problem.heat.as_ref()?, problem.warm_laws()?);
        let ((_, y), across, first) = (grid.abscissae(), grid.nodes().1, grid.first_column());
        let kappa = problem.point.ellipse().kappa;
        // Converts Y to units of a.
        let in_a = |y: &[f64]| y.iter().map(|y| kappa * y).collect::<Vec<f64>>();
        let y = &in_a(y)[..];
        let x = self.x();
        let gradient = PlaneGradient::new(&x, y);
        let state = |node: usize| {
            let mut slopes = gradient.at_node(pressure, node);
            if node / across == first {
                // The pressure of the node outside the inlet is not defined.
                slopes[0] = one_sided(&x[first..], [0, 1, 2].map(|k| pressure[node + k * across]));
            }
            NodeState { pressure: pressure[node], gradient: slopes, film: film[node] }
        };
        let stations = Stations::of(grid);
        let at: Vec<f64> = stations.xi(grid).iter().map(|xi| stretched(*xi, *scale)).collect();
        let mut lines = Lines::new(in_a(&stations.y(grid)), &at, &Arc::new(MovingSource::new(&at)));
        if theta.len() != lines.stations().count() {
            return None;
        }
        for (line, nodes) in lines.lines.iter_mut().zip(stations.nodes()) {
            line.states.iter_mut().zip(nodes).for_each(|(known, node)| *known = state(node));
        }
        lines.stations_mut().zip(theta).for_each(|(station, theta)| station.theta = *theta);
        // The share 0 leaves the temperatures as they are and computes flow and heat balance.
        lines.march(&problem.course(&[])?, (0.0, MARCHED), true);
        let places = x.iter().flat_map(|x| y.iter().map(|y| (*x, *y)));
        let profiles = Spread::new(&at, &lines.y, places).profiles(&lines).collect::<Vec<Profile>>();
        let skipped = first * across;
        let mut stress = vec![0.0; pressure.len()];
        pool::each(&mut stress[skipped..], SHARE, |k, stress| {
            let node = skipped + k;
            laws.node(state(node), &apply(&ACROSS.to_rule, &profiles[node]), stress);
        });
        let counted = |(node, p): (usize, &f64)| carried(grid.kind(), x[node / across], *p);
        let pressure: Vec<f64> = pressure.iter().enumerate().map(counted).collect();
        let arrays = NodeArrays { x: &x, y, first, pressure: &pressure, film, stress: &stress };
        Some(Temperatures::marched(&lines, &profiles[skipped..], &arrays, (problem, heat)))
    }

    /// Returns the scalars of the fields with the rigid-body separation `h_0`.
    fn scalars(&self, h_0: f64) -> Scalars {
        let Self { problem, grid, scale, pressure, film, .. } = self;
        match grid {
            ContactGrid::Line(grid) => scalars_of(&grid.scaled(*scale), problem, pressure, film, h_0),
            ContactGrid::Point(grid) => scalars_of(&**grid, problem, pressure, film, h_0),
        }
    }
}

/// Returns the lowest of the values; NaN if one of them is NaN.
fn lowest(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |lowest, value| if lowest.is_nan() || *value >= lowest { lowest } else { *value })
}

#[cfg(test)]
mod tests {
    use super::lowest;

    #[test]
    fn a_film_that_is_not_a_number_is_not_lost() {
        assert_eq!(lowest(&[3.0, 1.0, 2.0]), 1.0);
        for place in 0..3 {
            let mut films = [3.0, 1.0, 2.0];
            films[place] = f64::NAN;
            assert!(lowest(&films).is_nan(), "{films:?}");
        }
    }
}
