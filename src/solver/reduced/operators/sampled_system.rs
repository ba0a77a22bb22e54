//! Sampled equations of a local model over the nodes they depend on, with the state and the work space of an
//! iteration. All parts of the operators share it. Nothing in it is of large scale.

use super::case::{Case, Stop};
use super::deformation::Deformation;
use super::support::{Needed, StateRows, Support};
use crate::solver::discrete::nodes::{Laws, Nodes, Order};
use crate::solver::discrete::reynolds::film_integrals::LAST_STEP;
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::discrete::reynolds::{CENTER, RowGeometry, SOUTH, STENCIL};
use crate::solver::reduced::dense::SmallSystem;
use crate::solver::reduced::model::Window;
use crate::solver::reduced::sums::{RowNode, add_columns, jacobian_row};
use faer::Mat;
use std::ops::Range;

/// Role of a sampled equation in an iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RowState {
    /// A penalty acts on the pressure of its node.
    Penalised,
    /// It holds without a penalty.
    Full,
    /// A part evaluates it.
    Held,
    /// It lies behind the cavitation boundary: the multiplier λ balances it, whatever its value.
    Cavitated,
}

/// Rows, state and work space.
pub(super) struct SampledSystem {
    pub modes: usize,
    /// Number of modes whose coefficients the steps change; Galerkin's equations of the others are omitted.
    pub active: usize,
    /// Number of axes along which the rows use pressure gradients: none for Newtonian contacts.
    pub axes: usize,
    /// Nodes that the rows depend on.
    pub support: Support,
    /// Ranges of the support at which states are evaluated: first the own places, then those of parts.
    pub seen: Vec<Range<usize>>,
    /// True to evaluate all of them at the end of an iteration too, because the next time step uses the mass flow ρ̄H
    /// there.
    pub transient: bool,
    /// Sampled equations, followed by further rows that parts use: six places of the support each. Missing nodes have
    /// weight zero.
    pub stencils: Vec<[usize; STENCIL]>,
    pub geometry: Vec<RowGeometry>,
    /// Weights and states of the sampled equations.
    pub row_weights: Vec<f64>,
    pub row_states: Vec<RowState>,
    /// Modes on the support.
    pub basis: StateRows,
    /// wᵀ V_p.
    pub load_row: Vec<f64>,
    /// s K V_p at X = 0 (and Y = 0): film thickness there per unit of each coefficient.
    pub lift: Vec<f64>,
    /// Stopping criterion.
    pub stop: Stop,
    /// P and K P on the support, and gradients if needed. They are updated with the steps, so that each iteration
    /// multiplies by the large `basis` only once.
    pub fields: Vec<f64>,
    pub step_fields: Vec<f64>,
    pub films: Vec<f64>,
    pub nodes: Nodes,
    /// Step that ends the iteration of the film integrals at a shear-thinning node.
    pub film_step: f64,
    pub values: Vec<f64>,
    /// Derivatives of each row by P and by H of its nodes, and by H of all of them at once.
    pub by_pressure: Vec<[f64; STENCIL]>,
    pub by_film: Vec<[f64; STENCIL]>,
    pub film_column: Vec<f64>,
    pub jacobian_rows: Vec<f64>,
    /// Reduced Jacobian including the load row, and the step.
    pub step: SmallSystem,
    /// Copy of the Jacobian for observers, before factorisation.
    pub jacobian: Mat<f64>,
    pub product: Vec<f64>,
}

impl SampledSystem {
    /// Builds the sampled equations of a local model with its first modes and gradients along `axes` axes, over their
    /// own nodes and those that parts need.
    pub fn new(window: &Window, (modes, axes): (usize, usize), deformation: &Deformation, needed: Needed) -> Self {
        let grid = &window.grid;
        let rows = &window.sampled_rows;
        let (stencils, geometry): (Vec<_>, Vec<_>) = rows.iter().map(|&row| grid.row(row)).unzip();
        let own = stencils.iter().flatten().copied().chain(needed.always).collect();
        let support = Support::new(grid, own, needed.at_times);
        let nodes = support.nodes();
        let basis = StateRows::of(window, &nodes, (modes, axes), &deformation.at(window, &nodes, modes));
        let weights = grid.weights();
        let (n, s) = (rows.len(), support.len());
        Self {
            modes,
            active: modes,
            axes,
            seen: std::iter::once(0..support.own).collect(),
            transient: false,
            stencils: stencils.iter().map(|stencil| stencil.map(|node| support.place(node))).collect(),
            geometry,
            row_weights: rows.iter().map(|&row| weights[grid.node(row)]).collect(),
            row_states: vec![RowState::Penalised; n],
            basis,
            load_row: window.pressure.carried(weights, modes),
            lift: vec![0.0; modes],
            stop: Stop::default(),
            fields: vec![0.0; (2 + axes) * s],
            step_fields: vec![0.0; (2 + axes) * s],
            films: vec![0.0; s],
            nodes: Nodes::new(s, axes > 0),
            film_step: LAST_STEP,
            values: vec![0.0; n],
            by_pressure: vec![[0.0; STENCIL]; n],
            by_film: vec![[0.0; STENCIL]; n],
            film_column: vec![0.0; n],
            jacobian_rows: vec![0.0; n * modes],
            step: SmallSystem::new(modes + 1),
            jacobian: Mat::zeros(modes + 1, modes + 1),
            product: vec![0.0; n],
            support,
        }
    }

    /// Computes the film thicknesses of the fields.
    pub fn lay_films(&mut self, case: &Case<'_>, h_0: f64) {
        let Case { scale, curvature, .. } = *case;
        let deformation = &self.fields[self.support.len()..];
        let offset = h_0 - 0.5 * scale.ln();
        for part in &self.seen {
            let places = self.support.places[part.clone()].iter().zip(&deformation[part.clone()]);
            for (film, (place, deformation)) in self.films[part.clone()].iter_mut().zip(places) {
                *film = offset + place.gap(scale, curvature) + scale * deformation;
            }
        }
    }

    /// Evaluates the nodes of the fields, isothermal. At the `end` of an iteration only those of the rows, unless the
    /// contact is transient, and without the derivatives of shear-thinning.
    pub fn evaluate_nodes(&mut self, case: &Case<'_>, end: bool) {
        let Case { problem, scale, .. } = *case;
        let count = self.support.len();
        let (pressure, rest) = self.fields.split_at(count);
        let gradients = &rest[count..];
        let laws = Laws { shear: problem.shear.as_ref().filter(|_| self.axes > 0), ..problem.laws() };
        let gradient = |k: usize| [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
        let treatment = FilmTreatment { last_step: self.film_step, frozen: end, ..FilmTreatment::default() };
        let state = (pressure, self.films.as_slice());
        if self.seen.len() == 1 {
            self.nodes.evaluate(laws, state, gradient, treatment, Order::BesideTheFormer);
            return;
        }
        let seen = if end && !self.transient { &self.seen[..1] } else { &self.seen[..] };
        for part in seen.iter().filter(|part| !part.is_empty()) {
            self.nodes.evaluate_part(&laws, part.clone(), state, gradient, treatment);
        }
    }

    /// Evaluates the sampled equations, with their derivatives if `sloping`. Returns the sum of their weighted squares.
    pub fn evaluate_rows(&mut self, case: &Case<'_>, sloping: bool) -> f64 {
        let Case { scale, penalty, .. } = *case;
        let mut sum = 0.0;
        for (r, state) in self.row_states.iter().enumerate() {
            let penalty = match state {
                RowState::Penalised => penalty,
                RowState::Full => 0.0,
                RowState::Held => continue,
                RowState::Cavitated => {
                    self.values[r] = 0.0;
                    (self.by_pressure[r], self.by_film[r]) = ([0.0; STENCIL], [0.0; STENCIL]);
                    continue;
                }
            };
            let out = self.nodes.row(&self.geometry[r].scaled(scale), penalty, self.stencils[r]);
            self.values[r] = out.value;
            sum += self.row_weights[r] * scale * out.value * out.value;
            if sloping {
                (self.by_pressure[r], self.by_film[r]) = (out.d_p, out.d_h);
            }
        }
        sum
    }

    /// Computes the derivatives of the rows by the coefficients and by H₀.
    pub fn evaluate_jacobian(&mut self, scale: f64) {
        let (modes, count) = (self.modes, self.support.len());
        let StateRows { values, deformations, gradients, .. } = &self.basis;
        let thinning_axes = if self.nodes.thins() { self.axes } else { 0 };
        for (r, target) in self.jacobian_rows.chunks_exact_mut(modes).enumerate() {
            self.film_column[r] = self.by_film[r].iter().sum();
            if self.row_states[r] == RowState::Cavitated {
                target.fill(0.0);
                continue;
            }
            let (stencil, geometry) = (&self.stencils[r], self.geometry[r].scaled(scale));
            let of_node = |m: usize| {
                let own = stencil[m] * modes..(stencil[m] + 1) * modes;
                RowNode {
                    values: &values[own.clone()],
                    deformations: &deformations[own],
                    by_value: self.by_pressure[r][m],
                    by_deformation: scale * self.by_film[r][m],
                }
            };
            if geometry.reaches_across() {
                jacobian_row::<STENCIL>(std::array::from_fn(of_node), target);
            } else {
                jacobian_row::<SOUTH>(std::array::from_fn(of_node), target);
            }
            for axis in 0..thinning_axes {
                let per_gradient = if axis == 0 { 1.0 / scale } else { 1.0 };
                let slopes = self.nodes.slopes(&geometry, *stencil, axis);
                let column = |m: usize| {
                    let own = &gradients[(axis * count + stencil[m]) * modes..][..modes];
                    (per_gradient * slopes[m], own)
                };
                add_columns::<f64, STENCIL>(std::array::from_fn(column), target);
            }
        }
    }

    /// Returns ω = min(1, 0.3/max|ΔP|) for the step's fields, or less if a sampled film thickness would decrease by
    /// more than 70 %.
    pub fn damping(&self, scale: f64) -> f64 {
        let dh_0 = self.step.rhs[self.modes];
        let (pressure, deformation) = self.step_fields.split_at(self.support.len());
        let (mut largest, mut omega) = (0.0f64, 1.0f64);
        for part in &self.seen {
            largest = pressure[part.clone()].iter().fold(largest, |a, b| a.max(b.abs()));
            for (&film, d) in self.films[part.clone()].iter().zip(&deformation[part.clone()]) {
                let change = dh_0 + scale * d;
                if change < -0.7 * film && film > 0.0 {
                    omega = omega.min(-0.7 * film / change);
                }
            }
        }
        if largest > 0.3 { omega.min(0.3 / largest) } else { omega }
    }

    /// Applies a share of the step to the state and its fields; returns the relative size of the step.
    pub fn take_step(&mut self, omega: f64, coefficients: &mut [f64], h_0: &mut f64) -> f64 {
        let count = self.support.len();
        for part in &self.seen {
            for (field, step) in self.fields.chunks_exact_mut(count).zip(self.step_fields.chunks_exact(count)) {
                field[part.clone()]
                    .iter_mut()
                    .zip(&step[part.clone()])
                    .for_each(|(field, step)| *field += omega * step);
            }
        }
        let (mut change, mut size) = (0.0, 0.0);
        for (c, d) in coefficients.iter_mut().zip(&self.step.rhs) {
            *c += omega * d;
            change += d * d;
            size += *c * *c;
        }
        *h_0 += omega * self.step.rhs[self.modes];
        (change / size).sqrt()
    }

    /// Computes J V Δz̃ on the sampled equations, for the row snapshots.
    pub fn times_step(&mut self) {
        let dh_0 = self.step.rhs[self.modes];
        for (r, out) in self.product.iter_mut().enumerate() {
            let row = &self.jacobian_rows[r * self.modes..(r + 1) * self.modes];
            *out = self.film_column[r] * dh_0 + row.iter().zip(&self.step.rhs).map(|(a, b)| a * b).sum::<f64>();
        }
    }

    /// Returns the load that coefficients carry, per unit of the scale.
    pub fn carried(&self, coefficients: &[f64]) -> f64 {
        self.load_row.iter().zip(coefficients).map(|(l, c)| l * c).sum()
    }

    /// Returns ρ̄H at the own nodes of all rows.
    pub fn flow(&self) -> impl Iterator<Item = f64> + '_ {
        self.stencils.iter().map(|stencil| self.nodes[stencil[CENTER]].flow)
    }
}
