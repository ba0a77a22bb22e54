//! Differences between lines and planes in a march: equations of a step, features of the surfaces, settings of Newton's
//! method, and scales of another load.

use super::frame::Conditions;
use super::history::History;
use super::march::Step;
use super::pace::ROUNDING;
use super::signal::Input;
use crate::solver::discrete::grid::FIRST_UNKNOWN;
use crate::solver::discrete::reynolds::line::Upstream;
use crate::solver::discrete::space::{LineSpace, PlaneSpace};
use crate::solver::full::newton_space::NewtonSpace;
use crate::solver::full::{Backtracking, SolveOptions};
use crate::solver::physics::lubricant::Cavitation;

/// Space of a march.
pub trait MarchSpace: NewtonSpace {
    /// Returns the half-width and the scale of the film thickness, a²/R, of the dry contact with the given inputs,
    /// relative to those of the reference contact.
    fn dry_scales(input: Input) -> (f64, f64);

    /// Sets the equations of the steady contact at the given conditions.
    fn set_steady_rows(&mut self, at: &Conditions);

    /// Sets the equations of a step. `characteristic` is the spacing ΔX if the scheme follows the characteristics.
    fn set_rows(&mut self, step: &Step, history: &History, characteristic: Option<f64>);

    /// Sets 1/R̄ of (2.24), and the heights of features at (X, Y in units of a), if there are any.
    fn set_shape(&mut self, curvature: f64, height: Option<impl Fn(f64, f64) -> f64>);

    /// Returns the settings of a step's Newton iteration from the extrapolation, and from the previous state.
    fn step_options(cavitation: Cavitation) -> [SolveOptions<Self::Control>; 2];
}

/// Stopping tolerance of a step's Newton iteration for ‖Δz‖/‖z‖, with the unknowns z. Convergence is quadratic, so
/// the remaining error is far smaller.
const STEP_TOLERANCE: f64 = 1e-6;
/// Stopping tolerance for cavitation by active sets, with the bounds of the tolerance of its linear solves. A step ends
/// when the set is steady, so that accuracy costs only Krylov iterations, and mass is conserved to 1e-9 of the flow.
const HELD_TOLERANCE: f64 = 1e-8;
const HELD_FORCING: (f64, f64) = (1e-12, 1e-5);
/// Maximum number of Newton steps from the extrapolation, for line and point contacts. A point contact has no line
/// search that would end a bad iteration.
const MOST_NEWTON: [usize; 2] = [12, 20];

impl MarchSpace for LineSpace {
    fn dry_scales(Input { load, radius, .. }: Input) -> (f64, f64) {
        ((load * radius).sqrt(), load)
    }

    fn set_steady_rows(&mut self, at: &Conditions) {
        for (row, geometry) in self.rows.iter_mut().zip(&self.grid.rows) {
            *row = geometry.in_time(at.speed, 0.0, 0.0);
        }
        self.upstream.fill(Upstream::Inlet);
    }

    fn set_rows(&mut self, step: &Step, history: &History, characteristic: Option<f64>) {
        let Self { grid, rows, upstream, .. } = self;
        // A step that had to be divided does not meet the nodes of the characteristics.
        let meets =
            |spacing: f64| (step.length / spacing - 1.0).abs() < ROUNDING && (step.ratio - 1.0).abs() < ROUNDING;
        if characteristic.is_some_and(meets) {
            let weight = 1.0 / step.length;
            for (k, (row, geometry)) in rows.iter_mut().zip(&grid.rows).enumerate() {
                let node = k + FIRST_UNKNOWN;
                let former = 0.5 * history.flow(1, node - 2) - 2.0 * history.flow(0, node - 1);
                *row = geometry.in_time(0.0, 1.5 * weight, weight * former);
            }
            return;
        }
        let (unknowns, weights) = (grid.unknowns(), step.history_weights());
        for (k, (row, upstream)) in rows.iter_mut().zip(upstream).enumerate() {
            let node = k + FIRST_UNKNOWN;
            let velocity = step.velocity(grid.x[node]);
            *upstream = Upstream::of(velocity, k, unknowns);
            let geometry = match upstream {
                Upstream::Inlet => grid.rows[k],
                Upstream::Outlet | Upstream::Edge => upstream.geometry(&grid.x, k),
            };
            *row = geometry.in_time(velocity.abs(), step.quotient.now, history.at(weights, node));
        }
    }

    fn set_shape(&mut self, curvature: f64, height: Option<impl Fn(f64, f64) -> f64>) {
        self.curvature = curvature;
        self.features.clear();
        if let Some(height) = height {
            self.features.extend(self.grid.x.iter().map(|&x| height(x, 0.0)));
        }
    }

    fn step_options(cavitation: Cavitation) -> [SolveOptions<Backtracking>; 2] {
        let mut control = Backtracking { levelled_kernel: true, ..Backtracking::default() };
        let mut tolerance = STEP_TOLERANCE;
        if cavitation != Cavitation::Penalty {
            (tolerance, control.forcing) = (HELD_TOLERANCE, HELD_FORCING);
        }
        let farther = SolveOptions { tolerance, control, ..SolveOptions::default() };
        let control = Backtracking { shortest_step: 1.0, ..control };
        [SolveOptions { max_newton: MOST_NEWTON[0], control, ..farther }, farther]
    }
}

impl MarchSpace for PlaneSpace {
    fn dry_scales(Input { load, radius, .. }: Input) -> (f64, f64) {
        let half_width = (load * radius).cbrt();
        (half_width, half_width * half_width / radius)
    }

    fn set_steady_rows(&mut self, at: &Conditions) {
        self.motion.speed = at.speed;
        self.motion.storage = 0.0;
        self.motion.history.clear();
        self.motion.history.resize(self.grid.unknowns(), 0.0);
    }

    fn set_rows(&mut self, step: &Step, history: &History, _: Option<f64>) {
        let Self { grid, motion } = self;
        let weights = step.history_weights();
        (motion.speed, motion.storage) = (step.now.speed, step.quotient.now);
        motion.history.clear();
        motion.history.extend((0..grid.unknowns()).map(|k| history.at(weights, grid.node(k))));
    }

    fn set_shape(&mut self, _: f64, height: Option<impl Fn(f64, f64) -> f64>) {
        let Self { grid, motion } = self;
        motion.features.clear();
        if let Some(height) = height {
            let across = &grid.across;
            motion
                .features
                .extend(grid.x.iter().flat_map(|&x| across.iter().map(move |&y| (x, y))).map(|(x, y)| height(x, y)));
        }
    }

    fn step_options(_: Cavitation) -> [SolveOptions<Self::Control>; 2] {
        let farther = SolveOptions::default();
        [SolveOptions { max_newton: MOST_NEWTON[1], ..farther }, farther]
    }
}
