//! The reduced operators of one window for a chosen truncation, and the Newton iteration on them. Nothing here is of large scale, and
//! nothing is allocated inside an iteration.

use super::model::{Window, deformation_weights};
use crate::solver::contact::ContactKind;
use crate::solver::full::{Problem, mid_film_stress};
use crate::solver::grid::dot;
use crate::solver::reynolds::film_integrals::KnownFilm;
use crate::solver::reynolds::generalized::{FilmTreatment, NodeState, ShearNode, gradient_slopes};
use crate::solver::reynolds::{CENTER, Node, RowGeometry, STENCIL, row};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, Conj, Mat, MatMut, MatRef, Par};
use pulp::Arch;

/// The nodes of a row by twos: a row of the Jacobian is read and written half as often.
const PAIRS: [(usize, usize); STENCIL / 2] = [(0, 1), (2, 3), (4, 5)];

/// How an online Newton iteration ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnlineOutcome {
    pub converged: bool,
    pub iterations: usize,
    pub step: f64,
    /// e_f^I, (3.15), with rows weighted by √w.
    pub residual: f64,
}

/// One contact as the reduced operators see it.
#[derive(Clone, Copy)]
pub(crate) struct Case<'a> {
    pub problem: &'a Problem,
    /// Registration scale s.
    pub scale: f64,
    /// 1/R̄ of (2.24); 1 where the radius does not vary.
    pub curvature: f64,
    /// Penalty factor γ̄.
    pub penalty: f64,
    /// s K V_p at X = 0 (and Y = 0): what the film there gains per unit of each coefficient.
    pub lift: &'a [f64],
}

/// When an online iteration stops.
#[derive(Clone, Copy)]
pub(crate) struct Stop {
    pub tolerance: f64,
    pub max_newton: usize,
}

/// One online iterate, as the training sees it.
pub(crate) struct Iterate<'a> {
    /// f_I on the sampled rows.
    pub residual: &'a [f64],
    /// J V Δz̃ on the sampled rows.
    pub jacobian_step: &'a [f64],
    /// The reduced Jacobian, load row included.
    pub jacobian: MatRef<'a, f64>,
    /// (Δp̃, ΔH₀).
    pub step: &'a [f64],
    /// p̃ before the step.
    pub coefficients: &'a [f64],
    /// What the film at X = 0 gains per unit of each coefficient.
    pub lift: &'a [f64],
    /// H_c before the step.
    pub h_c: f64,
}

/// Sees each iterate.
pub(crate) type RowObserver<'a> = &'a mut dyn FnMut(&Iterate<'_>);

pub(crate) struct Operators {
    pub modes: usize,
    /// The nodes the sampled rows depend on.
    support: Vec<Place>,
    /// Six of them per sampled row; those that a row lacks have weight zero.
    stencil: Vec<[usize; STENCIL]>,
    geometry: Vec<RowGeometry>,
    row_weights: Vec<f64>,
    /// V_p on the support, then K V_p on it, then, of a shear-thinning model, its gradients by ξ and, of a point contact, by Y: row-major,
    /// (2 + axes)·support × modes.
    state_rows: Vec<f64>,
    /// Axes along which the rows need gradients: none of a Newtonian model.
    axes: usize,
    /// G, row-major modes × rows.
    reconstruction: Mat<f64>,
    /// wᵀ V_p.
    load_row: Vec<f64>,
    /// Places in the support, and weights, of the rule for the traction; empty without one.
    traction: Vec<(usize, f64)>,
    /// V_δ V_δᵀ W K V_p over the whole node array, for reconstruction; none where the exact K V_p is used, which the window has.
    projected: Option<Mat<f64>>,
    /// E_δ of (3.13) with δ̃ condensed: what V_δ cannot represent of K V_p, as a quadratic form; empty for the exact operator.
    deformation_error: Option<Mat<f64>>,
    scratch: Scratch,
}

/// Where a node lies.
#[derive(Clone, Copy)]
struct Place {
    xi: f64,
    /// Y²/2: what the undeformed gap has across.
    across: f64,
}

struct Scratch {
    /// P and K P on the support, and the gradients where there are any. They follow the steps, so that each iteration multiplies once by the large `state_rows`.
    fields: Vec<f64>,
    step_fields: Vec<f64>,
    films: Vec<f64>,
    nodes: Vec<Node>,
    /// What the nodes are made of under shear-thinning.
    thinning: Vec<ShearNode>,
    values: Vec<f64>,
    jacobian_rows: Vec<f64>,
    film_column: Vec<f64>,
    reduced: Mat<f64>,
    jacobian: Mat<f64>,
    rhs: Vec<f64>,
    perm: Vec<usize>,
    perm_inverse: Vec<usize>,
    memory: MemBuffer,
    product: Vec<f64>,
}

impl Operators {
    /// Operators with the first `modes` pressure modes and, if given, the first `deformation_modes` deformation modes; `thinning` for
    /// lubricants that thin under shear.
    pub fn new(window: &Window, modes: usize, deformation_modes: Option<usize>, thinning: bool) -> Self {
        Self::with_support(window, modes, deformation_modes, thinning, &[])
    }

    /// The same with further nodes that its rows may come to depend on.
    pub fn with_support(
        window: &Window,
        modes: usize,
        deformation_modes: Option<usize>,
        thinning: bool,
        further: &[usize],
    ) -> Self {
        let modes = modes.clamp(1, window.pressure.modes.ncols());
        let reference = &window.grid;
        let basis = window.pressure.modes.get(.., ..modes);
        let exact = window.flexed.get(.., ..modes);
        let (projected, deformation_error) = match deformation_modes {
            None => (None, None),
            Some(k) => {
                let k = k.clamp(1, window.deformation.modes.ncols());
                let weights = deformation_weights(reference);
                let v = window.deformation.modes.get(.., ..k);
                let weighted = Mat::from_fn(v.nrows(), k, |i, j| weights[i] * v[(i, j)]);
                let projected: Mat<f64> = v * (weighted.transpose() * exact);
                let missing =
                    Mat::from_fn(v.nrows(), modes, |i, j| weights[i].sqrt() * (exact[(i, j)] - projected[(i, j)]));
                let error: Mat<f64> = missing.transpose() * &missing;
                (Some(projected), Some(error))
            }
        };
        let rows = &window.sampled_rows;
        let (stencils, geometry): (Vec<_>, Vec<_>) = rows.iter().map(|&row| reference.row(row)).unzip();
        let rule = window.traction.iter().flat_map(|rule| &rule.nodes);
        let mut support: Vec<usize> = stencils.iter().flatten().chain(further).chain(rule).copied().collect();
        support.sort_unstable();
        support.dedup();
        let stencil = stencils.iter().map(|nodes| nodes.map(|node| support.partition_point(|&s| s < node))).collect();
        let deformation = projected.as_ref().map_or(exact, Mat::as_ref);
        let axes = match reference.kind() {
            _ if !thinning => 0,
            ContactKind::Line => 1,
            ContactKind::Point => 2,
        };
        let mut state_rows = Vec::with_capacity((2 + axes) * support.len() * modes);
        for &node in &support {
            state_rows.extend((0..modes).map(|k| basis[(node, k)]));
        }
        for &node in &support {
            state_rows.extend((0..modes).map(|k| deformation[(node, k)]));
        }
        if axes > 0 {
            let (gradient, (_, ny)) = (reference.gradient(), reference.nodes());
            let columns: Vec<Vec<f64>> = (0..modes).map(|k| basis.col(k).iter().copied().collect()).collect();
            for axis in 0..axes {
                for &node in &support {
                    let at = |column: &Vec<f64>| gradient.at(column, node / ny, node % ny)[axis];
                    state_rows.extend(columns.iter().map(at));
                }
            }
        }
        let traction = window.traction.iter().flat_map(|rule| rule.nodes.iter().zip(&rule.weights));
        let traction = traction.map(|(&node, &weight)| (support.partition_point(|&s| s < node), weight)).collect();
        let weights = reference.weights();
        let load_row = (0..modes).map(|k| weights.iter().enumerate().map(|(i, w)| w * basis[(i, k)]).sum()).collect();
        let place = |node: &usize| {
            let (xi, y) = reference.place(*node);
            Place { xi, across: 0.5 * y * y }
        };
        let (n, s) = (rows.len(), support.len());
        let size = modes + 1;
        let memory = factor::lu_in_place_scratch::<usize, f64>(size, size, Par::Seq, faer::Spec::default())
            .or(solve::solve_in_place_scratch::<usize, f64>(size, 1, Par::Seq));
        Self {
            modes,
            stencil,
            geometry,
            row_weights: rows.iter().map(|&row| weights[reference.node(row)]).collect(),
            state_rows,
            axes,
            reconstruction: window.reconstruction.get(..modes, ..).to_owned(),
            load_row,
            traction,
            projected,
            deformation_error,
            scratch: Scratch {
                fields: vec![0.0; (2 + axes) * s],
                step_fields: vec![0.0; (2 + axes) * s],
                films: vec![0.0; s],
                nodes: vec![Node::default(); s],
                thinning: vec![ShearNode::default(); if axes > 0 { s } else { 0 }],
                values: vec![0.0; n],
                jacobian_rows: vec![0.0; n * modes],
                film_column: vec![0.0; n],
                reduced: Mat::zeros(size, size),
                jacobian: Mat::zeros(size, size),
                rhs: vec![0.0; size],
                perm: vec![0; size],
                perm_inverse: vec![0; size],
                memory: MemBuffer::new(memory),
                product: vec![0.0; n],
            },
            support: support.iter().map(place).collect(),
        }
    }

    /// Gives sampled row `r` other coefficients, and other nodes: places in the ascending support.
    pub fn set_row(&mut self, r: usize, stencil: [usize; STENCIL], geometry: RowGeometry) {
        (self.stencil[r], self.geometry[r]) = (stencil, geometry);
    }

    /// ρ̄H at the sampled rows' own nodes, of the state evaluated last.
    pub fn flow(&self) -> impl Iterator<Item = f64> + '_ {
        self.stencil.iter().map(|stencil| self.scratch.nodes[stencil[CENTER]].flow)
    }

    /// Newton's method on (p̃, H₀) for one case, damped by the largest pressure change.
    pub fn newton(
        &mut self,
        case: &Case<'_>,
        coefficients: &mut [f64],
        h_0: &mut f64,
        stop: Stop,
        mut observer: Option<RowObserver<'_>>,
    ) -> OnlineOutcome {
        let mut outcome = OnlineOutcome { converged: false, iterations: 0, step: f64::NAN, residual: f64::NAN };
        product(&self.state_rows, self.modes, coefficients, &mut self.scratch.fields);
        // The films of another contact are no start.
        self.scratch.thinning.fill(ShearNode::default());
        for iteration in 1..=stop.max_newton {
            self.evaluate(case, coefficients, *h_0, true);
            if !self.linear_step(case.problem, case.scale, coefficients, observer.is_some()) {
                return outcome;
            }
            outcome.iterations = iteration;
            if let Some(observer) = observer.as_mut() {
                self.jacobian_times_step();
                let s = &self.scratch;
                observer(&Iterate {
                    residual: &s.values,
                    jacobian_step: &s.product,
                    jacobian: s.jacobian.as_ref(),
                    step: &s.rhs,
                    coefficients,
                    lift: case.lift,
                    h_c: *h_0 - 0.5 * case.scale.ln() + dot(case.lift, coefficients),
                });
            }
            let omega = self.damping(case.scale);
            let s = &mut self.scratch;
            s.fields.iter_mut().zip(&s.step_fields).for_each(|(field, step)| *field += omega * step);
            let (mut change, mut size) = (0.0, 0.0);
            for (c, d) in coefficients.iter_mut().zip(&self.scratch.rhs) {
                *c += omega * d;
                change += d * d;
                size += *c * *c;
            }
            *h_0 += omega * self.scratch.rhs[self.modes];
            outcome.step = (change / size).sqrt();
            if !outcome.step.is_finite() {
                return outcome;
            }
            if omega == 1.0 && outcome.step < stop.tolerance {
                outcome.converged = true;
                break;
            }
        }
        outcome.residual = self.evaluate(case, coefficients, *h_0, false);
        // A converged iteration with an absurd residual has found garbage.
        outcome.converged &= outcome.residual.is_finite() && outcome.residual < 1e3;
        outcome
    }

    /// Evaluates the sampled rows at the fields; returns e_f^I.
    fn evaluate(&mut self, case: &Case<'_>, coefficients: &[f64], h_0: f64, derivatives: bool) -> f64 {
        let Case { problem, scale, curvature, penalty, .. } = *case;
        let s = &mut self.scratch;
        let count = self.support.len();
        let (pressure, rest) = s.fields.split_at(count);
        let (deformation, gradients) = rest.split_at(count);
        let offset = h_0 - 0.5 * scale.ln();
        for ((film, place), deformation) in s.films.iter_mut().zip(&self.support).zip(deformation) {
            let x = -1.0 + (place.xi + 1.0) * scale;
            *film = offset + (0.5 * curvature * x * x + place.across) + scale * deformation;
        }
        let thinning = problem.shear.as_ref().filter(|_| self.axes > 0);
        let states = pressure.iter().zip(&s.films);
        match thinning {
            None => {
                for (node, (&pressure, &film)) in s.nodes.iter_mut().zip(states) {
                    *node = Node::new(&problem.fluid, problem.inverse_lambda, pressure, film);
                }
            }
            Some(law) => {
                let nodes = s.nodes.iter_mut().zip(&mut s.thinning);
                let mut beside = KnownFilm::default();
                for (k, ((node, own), (&pressure, &film))) in nodes.zip(states).enumerate() {
                    let gradient = [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
                    let state = NodeState { pressure, gradient, film };
                    let (fluid, inverse_lambda) = (&problem.fluid, problem.inverse_lambda);
                    // Between two iterations the stress hardly changes; in the first one the node before is near.
                    let known = if own.known.is_empty() { beside } else { own.known };
                    *own = ShearNode::near(&known, fluid, law, inverse_lambda, state, FilmTreatment::default());
                    (*node, beside) = (own.node, own.known);
                }
            }
        }
        let (v, d) = self.state_rows.split_at(count * self.modes);
        let (d, g) = d.split_at(count * self.modes);
        let mut sum = 0.0;
        for (r, (stencil, geometry)) in self.stencil.iter().zip(&self.geometry).enumerate() {
            let geometry = geometry.scaled(scale);
            let out = row(&geometry, penalty, stencil.map(|node| &s.nodes[node]));
            s.values[r] = out.value;
            sum += self.row_weights[r] * scale * out.value * out.value;
            if derivatives {
                let target = &mut s.jacobian_rows[r * self.modes..(r + 1) * self.modes];
                target.fill(0.0);
                for (m, n) in PAIRS {
                    let [(one, a, b), (other, e, f)] = [m, n].map(|m| (stencil[m], out.d_p[m], scale * out.d_h[m]));
                    if [a, b, e, f] == [0.0; 4] {
                        continue;
                    }
                    let [one, other] = [one, other].map(|node| node * self.modes..(node + 1) * self.modes);
                    add_rows(target, [(a, &v[one.clone()]), (b, &d[one])], [(e, &v[other.clone()]), (f, &d[other])]);
                }
                for axis in 0..if thinning.is_some() { self.axes } else { 0 } {
                    let per_gradient = if axis == 0 { 1.0 / scale } else { 1.0 };
                    let slopes = gradient_slopes(&geometry, stencil.map(|node| &s.thinning[node]), axis);
                    for (m, n) in PAIRS {
                        let [a, b] = [m, n].map(|m| per_gradient * slopes[m]);
                        if [a, b] == [0.0; 2] {
                            continue;
                        }
                        let [one, other] = [m, n].map(|m| &g[(axis * count + stencil[m]) * self.modes..][..self.modes]);
                        add_gradients(target, (a, one), (b, other));
                    }
                }
                s.film_column[r] = out.d_h.iter().sum();
            }
        }
        if let Some(error) = &self.deformation_error {
            let c = ColRef::from_slice(coefficients);
            sum += scale * (c.transpose() * (error * c)).max(0.0);
        }
        let carried: f64 = self.load_row.iter().zip(coefficients).map(|(l, c)| l * c).sum();
        sum += (scale * carried - problem.load).powi(2);
        sum.sqrt()
    }

    /// Solves the reduced linear system; the step is left in `scratch.rhs`. False when it is singular.
    /// `keep` keeps a copy of the reduced Jacobian for an observer.
    fn linear_step(&mut self, problem: &Problem, scale: f64, coefficients: &[f64], keep: bool) -> bool {
        let modes = self.modes;
        let s = &mut self.scratch;
        let rows = s.values.len();
        let jacobian = MatRef::from_row_major_slice(&s.jacobian_rows, rows, modes);
        let g = self.reconstruction.as_ref();
        matmul(s.reduced.get_mut(..modes, ..modes), Accum::Replace, g, jacobian, 1.0, Par::Seq);
        matmul(
            s.reduced.get_mut(..modes, modes..),
            Accum::Replace,
            g,
            ColRef::from_slice(&s.film_column).as_mat(),
            1.0,
            Par::Seq,
        );
        matmul(
            ColMut::from_slice_mut(&mut s.rhs[..modes]).as_mat_mut(),
            Accum::Replace,
            g,
            ColRef::from_slice(&s.values).as_mat(),
            -1.0,
            Par::Seq,
        );
        let mut carried = 0.0;
        for (k, (l, c)) in self.load_row.iter().zip(coefficients).enumerate() {
            s.reduced[(modes, k)] = scale * l;
            carried += scale * l * c;
        }
        s.reduced[(modes, modes)] = 0.0;
        s.rhs[modes] = problem.load - carried;
        if keep {
            s.jacobian.copy_from(&s.reduced);
        }
        let stack = MemStack::new(&mut s.memory);
        let (_, perm) = factor::lu_in_place(
            s.reduced.as_mut(),
            &mut s.perm,
            &mut s.perm_inverse,
            Par::Seq,
            stack,
            faer::Spec::default(),
        );
        let lu = s.reduced.as_ref();
        let rhs = MatMut::from_column_major_slice_mut(&mut s.rhs, modes + 1, 1);
        solve::solve_in_place_with_conj(lu, lu, perm, Conj::No, rhs, Par::Seq, stack);
        s.rhs.iter().all(|v| v.is_finite())
    }

    /// ω = min(1, 0.3/max|ΔP|), and no sampled film loses more than 70 %.
    fn damping(&mut self, scale: f64) -> f64 {
        let s = &mut self.scratch;
        product(&self.state_rows, self.modes, &s.rhs[..self.modes], &mut s.step_fields);
        let (pressure, deformation) = s.step_fields.split_at(self.support.len());
        let largest = pressure.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        let mut omega = if largest > 0.3 { 0.3 / largest } else { 1.0 };
        let dh_0 = s.rhs[self.modes];
        for (&film, d) in s.films.iter().zip(deformation) {
            let change = dh_0 + scale * d;
            if change < -0.7 * film && film > 0.0 {
                omega = omega.min(-0.7 * film / change);
            }
        }
        omega
    }

    /// Traction coefficient (3.41) of the state evaluated last, by the window's rule; `None` where it has none, and under a limiting stress: the
    /// rule was fitted to stresses that nothing cuts.
    pub fn traction(&self, problem: &Problem, scale: f64) -> Option<f64> {
        if self.traction.is_empty() || self.axes == 0 || problem.lubricant.limiting_stress.is_some() {
            return None;
        }
        let (s, count) = (&self.scratch, self.support.len());
        let gradients = &s.fields[2 * count..];
        let stress = |&(k, weight): &(usize, f64)| {
            let gradient = [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
            weight * mid_film_stress(problem, NodeState { pressure: s.fields[k], gradient, film: s.films[k] })
        };
        let force: f64 = self.traction.iter().map(stress).sum();
        Some(scale * force * problem.point.area_per_load())
    }

    /// J V Δz̃ on the sampled rows, for the row snapshots.
    fn jacobian_times_step(&mut self) {
        let s = &mut self.scratch;
        let dh_0 = s.rhs[self.modes];
        for (r, out) in s.product.iter_mut().enumerate() {
            let row = &s.jacobian_rows[r * self.modes..(r + 1) * self.modes];
            *out = s.film_column[r] * dh_0 + row.iter().zip(&s.rhs).map(|(a, b)| a * b).sum::<f64>();
        }
    }

    /// K V_p or V_δ V_δᵀ W K V_p over the whole node array of the window these operators are of.
    pub fn deformation<'a>(&'a self, window: &'a Window) -> MatRef<'a, f64> {
        match &self.projected {
            Some(projected) => projected.as_ref(),
            None => window.flexed.get(.., ..self.modes),
        }
    }

    /// Scales coefficients so that they carry the load on a grid of scale s.
    pub fn carry_load(&self, problem: &Problem, scale: f64, coefficients: &mut [f64]) {
        let carried: f64 = self.load_row.iter().zip(coefficients.iter()).map(|(l, c)| l * c).sum();
        let factor = problem.load / (scale * carried);
        if factor.is_finite() && factor > 0.0 {
            coefficients.iter_mut().for_each(|c| *c *= factor);
        }
    }
}

/// out += (a v + b d) + (e w + f g), in registers as wide as the machine has.
fn add_rows(out: &mut [f64], [(a, v), (b, d)]: [(f64, &[f64]); 2], [(e, w), (f, g)]: [(f64, &[f64]); 2]) {
    Arch::new().dispatch(|| {
        for ((t, (v, d)), (w, g)) in out.iter_mut().zip(v.iter().zip(d)).zip(w.iter().zip(g)) {
            *t = (*t + (a * v + b * d)) + (e * w + f * g);
        }
    });
}

/// out += a v + b w, likewise.
fn add_gradients(out: &mut [f64], (a, v): (f64, &[f64]), (b, w): (f64, &[f64])) {
    Arch::new().dispatch(|| {
        for ((t, v), w) in out.iter_mut().zip(v).zip(w) {
            *t = (*t + a * v) + b * w;
        }
    });
}

/// out = A x for a row-major A.
fn product(rows: &[f64], columns: usize, x: &[f64], out: &mut [f64]) {
    matmul(
        ColMut::from_slice_mut(out).as_mat_mut(),
        Accum::Replace,
        MatRef::from_row_major_slice(rows, rows.len() / columns, columns),
        ColRef::from_slice(x).as_mat(),
        1.0,
        Par::Seq,
    );
}
