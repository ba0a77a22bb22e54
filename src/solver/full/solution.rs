//! Solution of a problem, with the problem and an account of how it was solved.

use super::far_field;
use super::grid_cost::GridCost;
use super::heat::Temperatures;
use super::mesh::Mesh;
use super::problem::Problem;
use super::report::{Report, Termination};
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::reynolds::generalized::PlaneGradient;
use crate::solver::discrete::space::Grid;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Scalar results of a solution. Positions and values are dimensionless, (2.22).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, Default)]
pub struct Scalars {
    /// H_c, central film thickness at X = 0 (and Y = 0), interpolated if there is no node.
    pub h_c: f64,
    /// H_min, minimum nodal film thickness in −1.2 < X < 1.5.
    pub h_min: f64,
    /// Position of H_min along X.
    pub x_h_min: f64,
    /// Position of H_min across, at most 0; zero for a line contact.
    pub y_h_min: f64,
    /// Pressure at X = 0 (and Y = 0).
    pub p_c: f64,
    /// Maximum nodal pressure.
    pub p_max: f64,
    /// Position of the maximum pressure along X.
    pub x_p_max: f64,
    /// H₀, rigid-body separation with the kernel of (2.27) or (2.25).
    pub h_0: f64,
    /// Load-balance residual |∫P/load − 1| with the load of (2.28) or (2.29).
    pub load_residual: f64,
}

/// Traction coefficient of a Newtonian fluid per unit slide-to-roll ratio SRR, (3.41): coefficient = `per_srr` · SRR.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Traction {
    /// Coefficient at SRR = 1.
    pub per_srr: f64,
}

/// Fields and scalars of one contact, with its problem and an account of how it was solved.
///
/// Node arrays run over X and, fastest, over Y. Node (i, j) has the index i·n_y + j, and the last j lies on the axis
/// Y = 0. A line contact has n_y = 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Solution {
    /// Problem that was solved.
    pub problem: Problem,
    /// Grid of the solution.
    pub mesh: Mesh,
    /// Abscissae X.
    pub x: Vec<f64>,
    /// Ordinates Y ≤ 0; only 0 for a line contact.
    pub y: Vec<f64>,
    /// Pressure P at the nodes.
    pub pressure: Vec<f64>,
    /// Film thickness H at the nodes.
    pub film: Vec<f64>,
    /// Multiplier λ at the nodes, zero in the full film; empty for cavitation by the penalty.
    pub multiplier: Vec<f64>,
    /// Film fraction θ at the nodes, the filled share of the gap; empty unless the cavitation model conserves mass.
    pub fraction: Vec<f64>,
    /// Asperity pressure P_a at the nodes, a part of the pressure P; empty for smooth surfaces.
    #[serde(default)]
    pub asperity_pressure: Vec<f64>,
    /// Scalar results.
    pub scalars: Scalars,
    /// Account of how it was solved.
    pub report: Report,
    /// Discretisation error of the central film thickness, if it was requested ([`ContactSolver::judged`]).
    ///
    /// [`ContactSolver::judged`]: super::ContactSolver::judged
    pub grid_cost: Option<GridCost>,
    /// Temperatures; `None` for an isothermal solution.
    pub heat: Option<Arc<Temperatures>>,
}

impl Solution {
    /// Returns these fields as the solution of another problem that has the same film. Sliding does not change the
    /// film of a Newtonian lubricant, and a limiting stress changes no film.
    pub fn of_problem(self, problem: Problem) -> Self {
        Self { problem, ..self }
    }

    /// True if the solve converged, so that the solution may be shown as a result.
    pub fn converged(&self) -> bool {
        self.report.termination == Termination::Converged
    }

    /// Returns the operator of nodal gradients of its node arrays along X and across, both in units of 1/a.
    pub fn gradient(&self) -> PlaneGradient {
        let kappa = self.problem.point.ellipse().kappa;
        let across: Vec<f64> = self.y.iter().map(|y| kappa * y).collect();
        PlaneGradient::new(&self.x, &across)
    }

    /// Returns the deformation Δ = H − H₀ − (X² + g_y Y²)/2 at the nodes. It includes the constant of a logarithmic
    /// kernel.
    pub fn deformation(&self) -> Vec<f64> {
        let curvature = self.problem.point.ellipse().gap_curvature();
        let gap = |x: &f64, y: &f64| 0.5 * (x * x + curvature * y * y);
        let parabola = self.x.iter().flat_map(|x| self.y.iter().map(move |y| gap(x, y)));
        self.film.iter().zip(parabola).map(|(h, gap)| h - self.scalars.h_0 - gap).collect()
    }

    /// Returns the index of the first abscissa inside the domain.
    pub(super) fn first(&self) -> usize {
        self.mesh.spec.first_column()
    }

    /// Returns the profile along the axis Y = 0 from inlet to outlet: X, P, H.
    pub fn profile(&self) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let ny = self.y.len();
        let axis = move |values: &'_ [f64], i: usize| values[i * ny + ny - 1];
        (self.first()..self.x.len()).map(move |i| (self.x[i], axis(&self.pressure, i), axis(&self.film, i)))
    }

    /// Returns all nodes of the domain, Y fastest: X, Y, P, H.
    pub fn nodes(&self) -> impl Iterator<Item = (f64, f64, f64, f64)> + '_ {
        let ny = self.y.len();
        (self.first() * ny..self.x.len() * ny)
            .map(move |k| (self.x[k / ny], self.y[k % ny], self.pressure[k], self.film[k]))
    }

    /// Returns λ at the nodes of [`nodes`](Self::nodes); empty for cavitation by the penalty.
    pub fn multipliers(&self) -> impl Iterator<Item = f64> + '_ {
        self.multiplier.iter().skip(self.first() * self.y.len()).copied()
    }

    /// Returns X and λ along the axis in the cavitated region; empty for cavitation by the penalty.
    pub fn axis_multiplier(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let ny = self.y.len();
        let axis = self.multiplier.iter().skip(ny - 1).step_by(ny);
        self.x.iter().zip(axis).filter(|(_, multiplier)| **multiplier > 0.0).map(|(x, multiplier)| (*x, *multiplier))
    }

    /// Returns position and height of the pressure spike on the axis: the last distinct local maximum in 0.2 < X <
    /// 1.2. `None` without a spike.
    pub fn spike(&self) -> Option<(f64, f64)> {
        let axis: Vec<(f64, f64)> = self.profile().map(|(x, p, _)| (x, p)).collect();
        let peak = axis.windows(3).rev().find(|w| {
            let [(_, before), (x, p), (_, after)] = [w[0], w[1], w[2]];
            x > 0.2 && x < 1.2 && p > 0.05 && p > before && p >= after
        })?;
        Some(peak[1])
    }

    /// Returns the position of the cavitation boundary on the axis: the first node behind the contact with P ≤ 0.
    pub fn rupture(&self) -> Option<f64> {
        let axis: Vec<(f64, f64)> = self.profile().map(|(x, p, _)| (x, p)).collect();
        match self.problem.rough {
            // Asperities carry pressure behind the boundary, too.
            Some(_) => self.axis_multiplier().next().map(|(x, _)| x),
            None => axis.get(axis.iter().rposition(|&(_, p)| p > 0.0)? + 1).map(|&(x, _)| x),
        }
    }

    /// Returns the position of the inlet meniscus on the axis: the first node in front of the contact with a full
    /// gap. `None` if the film is full from the first node on.
    pub fn meniscus(&self) -> Option<f64> {
        let ny = self.y.len();
        let full = |i: &usize| self.fraction.get(i * ny + ny - 1).is_none_or(|fraction| *fraction >= 1.0);
        let first = (self.first() + 1..self.x.len()).find(full)?;
        (first > self.first() + 1).then(|| self.x[first])
    }

    /// Returns X and θ along the axis; empty unless the cavitation model conserves mass.
    pub fn axis_fraction(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        let ny = self.y.len();
        let axis = self.fraction.iter().skip(ny - 1).step_by(ny).copied();
        self.x.iter().copied().zip(axis).skip(self.first())
    }

    /// Returns θ at the nodes of [`nodes`](Self::nodes); empty unless the cavitation model conserves mass.
    pub fn fractions(&self) -> impl Iterator<Item = f64> + '_ {
        self.fraction.iter().skip(self.first() * self.y.len()).copied()
    }

    /// Returns the Newtonian traction over the whole domain, (3.41), positive for SRR > 0: the mean shear force of
    /// both surfaces divided by the load.
    pub fn traction(&self) -> Traction {
        // τ = η u_s / h with u_s = SRR u_m, and friction = ∫τ dx / w. The Poiseuille part cancels in the mean of both
        // surfaces.
        let (point, fields) = (&self.problem.point, self.film_fields());
        let stress_scale = point.viscosity_pa_s * point.speed_m_per_s / point.film_scale_m();
        let stress = |k: usize| {
            let pressure = fields.pressure[k];
            let viscosity = if pressure > 0.0 { self.problem.fluid.at(pressure).viscosity } else { 1.0 };
            stress_scale * viscosity / fields.thickness[k]
        };
        Traction { per_srr: self.force_per_load(stress) }
    }

    /// Returns the integral of a nodal stress \[Pa\] over the filled part of the domain, divided by the load. It uses
    /// the trapezoidal rule and includes both halves of a point contact.
    pub(super) fn force_per_load(&self, stress: impl Fn(usize) -> f64) -> f64 {
        let ny = self.y.len();
        let stress = |k: usize| self.fraction.get(k).copied().unwrap_or(1.0) * stress(k);
        // Integral across both halves; the value itself for a line contact.
        let at = |i: usize| {
            let mut inner = stress(i * ny);
            if ny == 1 {
                return inner;
            }
            let across = |j: usize| {
                let outer = stress(i * ny + j);
                let part = (inner + outer) * (self.y[j] - self.y[j - 1]);
                inner = outer;
                part
            };
            (1..ny).map(across).sum()
        };
        let mut integral = 0.0;
        let mut upstream = at(self.first());
        for i in self.first() + 1..self.x.len() {
            let here = at(i);
            integral += 0.5 * (upstream + here) * (self.x[i] - self.x[i - 1]);
            upstream = here;
        }
        self.problem.point.area_per_load() * integral
    }
}

/// True in the range of the minimum film thickness: −1.2 < X < 1.5.
pub(crate) fn under_contact(x: f64) -> bool {
    x > -1.2 && x < 1.5
}

/// Computes the scalar results of fields on a grid.
pub fn scalars_of(grid: &impl Grid, problem: &Problem, pressure: &[f64], film: &[f64], h_0: f64) -> Scalars {
    let beyond = if grid.continues() { far_field::load(grid, pressure) } else { 0.0 };
    let mut out = Scalars {
        h_c: grid.central(film),
        p_c: grid.central(pressure),
        h_min: f64::INFINITY,
        p_max: f64::NEG_INFINITY,
        h_0,
        load_residual: ((dot(grid.weights(), pressure) + beyond) / problem.load - 1.0).abs(),
        ..Scalars::default()
    };
    let (abscissae, ordinates) = grid.abscissae();
    // In a film much longer than the contact, the nodes are far apart.
    let length = if grid.continues() { 0.5 * (2.0 * out.h_c).sqrt() } else { 0.0 };
    let under_film = |x: f64| under_contact(x) || x.abs() < length;
    // The unknowns are all nodes between two corners.
    let across = ordinates.len();
    let (first, last) = (grid.node(0), grid.node(grid.unknowns() - 1));
    for (i, &x) in abscissae.iter().enumerate().take(last / across + 1).skip(first / across) {
        let under = under_film(x);
        for (j, &y) in ordinates.iter().enumerate().skip(first % across) {
            let node = i * across + j;
            if under && film[node] < out.h_min {
                (out.h_min, out.x_h_min, out.y_h_min) = (film[node], x, y);
            }
            if pressure[node] > out.p_max {
                (out.p_max, out.x_p_max) = (pressure[node], x);
            }
        }
    }
    out
}
