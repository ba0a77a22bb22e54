//! Newton's method for contacts with rough surfaces. The unknown is the total pressure P = P_h + P_a(H).
//!
//! Cavitation is a complementarity condition for the film pressure P_h, with an [active set](super::active_set). In the
//! cavitated set the asperities carry the pressure alone, so its equations are P − P_a(H) = 0.

use super::active_set::ActiveSet;
use super::newton_space::NewtonSpace;
use super::problem::Problem;
use super::solution::Solution;
use super::system::{System, evaluate_film};
use crate::solver::discrete::reynolds::{CENTER, Row};
use crate::solver::discrete::rough::{Asperities, RoughNodes};
use crate::solver::discrete::space::Grid;

#[cfg(test)]
mod tests;

/// Film pressure below which a node behind the contact counts as cavitated in an initial state.
const NO_FILM_PRESSURE: f64 = 1e-6;
/// Largest changes of P and of P_h in one step.
const LARGEST_STEPS: (f64, f64) = (0.3, 0.6);
/// Largest reduction of the film thickness in one step, relative to H + 4σ, and the smallest such length, in units of σ.
const FILM_LOSS: f64 = 0.8;
const ASPERITY_HEIGHT: f64 = 4.0;
const LEAST_FILM: f64 = 0.25;
/// Largest asperity pressure at the centre of an initial state.
const LARGEST_ASPERITY_PRESSURE: f64 = 0.9;

/// Central asperity pressures P_a of cold starts, one per start. A start has the larger of the film thickness of its
/// formula and that of this pressure.
pub(super) const COLD_PRESSURES: [f64; 3] = [0.5, 0.8, 0.2];

impl ActiveSet {
    /// Replaces the equations of the cavitated set by P − P_a(H) = 0, after [`Self::hold`].
    pub(super) fn hold_on_asperities(&self, rows: &mut [Row], grid: &impl Grid, pressure: &[f64], rough: &RoughNodes) {
        for (k, (row, _)) in rows.iter_mut().zip(&self.ruptured).enumerate().filter(|(_, (_, ruptured))| **ruptured) {
            let node = grid.node(k);
            let Asperities { pressure: carried, slope } = rough.asperities(node);
            row.value = pressure[node] - carried;
            row.d_h[CENTER] = -slope;
        }
    }
}

/// Film between rough surfaces, node arrays.
pub(super) struct RoughFilm {
    /// Film pressure P_h ≥ 0.
    pub pressure: Vec<f64>,
    /// Mean gap in units of a²/R.
    pub gap: Vec<f64>,
    /// Pressure-driven flow over that of a smooth film with the mean gap.
    pub flow_factor: Vec<f64>,
    /// Asperity pressure P_a.
    pub asperities: Vec<f64>,
}

impl<S: NewtonSpace> System<S> {
    /// Prepares the nodes of rough surfaces. The table of an asperity law is reused for further contacts with this law.
    pub(super) fn begin_rough(&mut self, problem: &Problem) {
        let count = self.pressure.len();
        self.rough = problem.rough.as_ref().map(|rough| match self.rough.take() {
            Some(nodes) if rough.fits(nodes.table()) => nodes,
            _ => RoughNodes::new(rough, count),
        });
    }

    /// Evaluates the nodes of rough surfaces. No effect for smooth surfaces.
    pub(super) fn evaluate_rough(&mut self, problem: &Problem) {
        let Self { space, rough, nodes, pressure, film, thinning, warm, treatment, .. } = self;
        let Some((rough, laws)) = rough.as_mut().zip(problem.rough_laws()) else { return };
        let (weights, fields) = (space.grid().weights(), (&pressure[..], &film[..]));
        if problem.shear.is_none() && problem.heat.is_none() {
            rough.evaluate(laws, fields, weights, nodes, S::PARALLEL);
            return;
        }
        rough.evaluate_film(laws, fields, weights, nodes, |nodes, fields| {
            evaluate_film(space, (nodes, thinning, warm), problem, fields, *treatment);
        });
    }

    /// Returns pressure and mean gap of the film between rough surfaces, and the pressure of the asperities, at the
    /// current state. `None` for smooth surfaces.
    pub(super) fn film_between_asperities(&self, problem: &Problem) -> Option<RoughFilm> {
        let (nodes, rough) = self.rough.as_ref().zip(problem.rough)?;
        let weights = self.space.grid().weights();
        let carried = |(film, weight): (&f64, &f64)| Asperities::at(&rough, nodes.table(), *film, *weight).pressure;
        let asperities: Vec<f64> = self.film.iter().zip(weights).map(carried).collect();
        let pressure = self.pressure.iter().zip(&asperities).map(|(total, carried)| (total - carried).max(0.0));
        let mut pressure: Vec<f64> = pressure.collect();
        let gap: Vec<f64> = self.film.iter().map(|film| rough.mean_gap(*film).0).collect();
        let flow_factor = self.film.iter().zip(&gap).map(|(film, gap)| rough.cube(*film).0 / gap.powi(3)).collect();
        // In the cavitated set the difference is rounding.
        for (k, _) in self.active.ruptured.iter().enumerate().filter(|(_, ruptured)| **ruptured) {
            pressure[self.space.grid().node(k)] = 0.0;
        }
        Some(RoughFilm { pressure, gap, flow_factor, asperities })
    }

    /// Returns the share of the carried load that asperities carry; 0 for smooth surfaces.
    pub(super) fn asperity_load_share(&self) -> f64 {
        let weights = self.space.grid().weights();
        let carried = |nodes: &RoughNodes| -> f64 {
            weights.iter().enumerate().map(|(node, weight)| weight * nodes.asperities(node).pressure).sum()
        };
        self.rough.as_ref().map_or(0.0, |nodes| carried(nodes) / self.carried_load())
    }

    /// Initialises the cavitated set of rough surfaces: nodes behind the centre without film pressure.
    pub(super) fn begin_rough_rupture(&mut self, problem: &Problem) {
        self.begin_rough(problem);
        self.evaluate_rough(problem);
        let Self { space, active, rough, rows, .. } = self;
        let Some(rough) = rough else { return };
        let grid = space.grid();
        let (x, y) = grid.abscissae();
        let ruptured = |node: usize| x[node / y.len()] > 0.0 && rough.film_pressure(node) <= NO_FILM_PRESSURE;
        active.begin((0..rows.len()).map(|k| ruptured(grid.node(k))));
    }

    /// Adds nodes with negative film pressure to the cavitated set, where the asperities carry all pressure. Returns
    /// `false` if there were none.
    pub(super) fn join_rough_rupture(&mut self) -> bool {
        let Self { space, active, rough, pressure, .. } = self;
        let Some(rough) = rough else { return false };
        let mut joined = false;
        for (k, ruptured) in active.ruptured.iter_mut().enumerate().filter(|(_, ruptured)| !**ruptured) {
            let node = space.grid().node(k);
            if rough.film_pressure(node) < 0.0 {
                (pressure[node], *ruptured, joined) = (rough.asperities(node).pressure, true, true);
            }
        }
        if joined {
            self.deform();
            self.set_h_0(self.h_0);
        }
        joined
    }

    /// Returns the longest admissible share, at most 1, of the step in `step`, `step_deformation` and ΔH₀ = `shift`, by
    /// the changes of both pressures and of the film thickness. `None` for smooth surfaces.
    pub(super) fn longest_rough_step(&self, problem: &Problem, shift: f64) -> Option<f64> {
        let (nodes, sigma) = self.rough.as_ref().zip(problem.rough.map(|rough| rough.sigma))?;
        let mut longest: f64 = 1.0;
        let steps = self.film.iter().zip(self.step.iter().zip(&self.step_deformation));
        for (node, (film, (step, deformation))) in steps.enumerate() {
            let change = deformation + shift;
            let of_film = step - nodes.asperities(node).slope * change;
            longest = longest.min(LARGEST_STEPS.0 / step.abs()).min(LARGEST_STEPS.1 / of_film.abs());
            let room = FILM_LOSS * (film + ASPERITY_HEIGHT * sigma).max(LEAST_FILM * sigma);
            if change < -room {
                longest = longest.min(-room / change);
            }
        }
        Some(longest)
    }

    /// Sets the central film thickness of an initial state, at least that at which the asperity pressure is `pressure`.
    pub(super) fn set_central_film_above_asperities(&mut self, problem: &Problem, film: f64, pressure: f64) {
        self.begin_rough(problem);
        let touching =
            self.rough.as_ref().zip(problem.rough).map(|(nodes, rough)| rough.film_at(nodes.table(), pressure));
        self.set_central_film(touching.map_or(film, |touching| film.max(touching)));
    }

    /// Sets the central film thickness of a start from another solution. `ratio` is that of the formula's film
    /// thicknesses. Asperities that carry much fix their distance in units of σ, so that the ratio does not matter.
    pub(super) fn set_film_of_rough_start(&mut self, problem: &Problem, former: &Solution, ratio: f64) {
        let sigma = |problem: &Problem| problem.rough.map(|rough| rough.sigma);
        let film = match sigma(problem).zip(sigma(&former.problem)) {
            Some((own, other)) if problem.lubricant.roughness == former.problem.lubricant.roughness => {
                former.scalars.h_c * own / other
            }
            Some(_) => former.scalars.h_c,
            None => former.scalars.h_c * ratio,
        };
        self.set_central_film_above_asperities(problem, film, LARGEST_ASPERITY_PRESSURE);
    }
}
