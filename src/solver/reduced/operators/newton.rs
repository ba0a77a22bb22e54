//! The Newton iteration on reduced operators. Nothing here is of large scale, and nothing is allocated inside an
//! iteration.

use super::assembled::Operators;
use super::front::{Changed, Front, Moved};
use super::least_squares::LeastSquares;
use super::support::seen;
use crate::solver::discrete::nodes::{Laws, Order};
use crate::solver::discrete::reynolds::film_integrals::LAST_STEP;
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::discrete::reynolds::{CENTER, SOUTH, STENCIL};
use crate::solver::full::Problem;
use crate::solver::reduced::dense::{SmallSystem, quadratic_form};
use crate::solver::reduced::sums::{RowNode, add_columns, jacobian_row};
use faer::linalg::matmul::matmul;
use faer::{Accum, ColMut, ColRef, MatRef, Par};

/// Steps after which an iteration is slow: most take two to five.
const SWIFT: usize = 12;

/// The relative step behind which derivatives serve again, and the share of it that the next one may have so that they
/// go on doing so.
const NEAR: f64 = 1e-2;
const SHRINKS: f64 = 0.3;

/// How much modes are held at zero behind the rupture boundary, relative to the equations' own size.
const RESTRAINED: f64 = 1e-6;

/// The step that ends the iteration of a thinning node's film, over the square of the one that ends the whole iteration.
/// Either leaves the square of its own step: at 1e-3 both are alike, at 1e-5 films are exact to rounding.
const FILM_STEP: f64 = 1e3;

/// How exact the derivatives of rows are.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Slopes {
    /// With K V of a place of the rupture boundary nearby, where there are many lines.
    Usual,
    /// With K V of its own place.
    Exact,
}

/// What rows are evaluated for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Wanted {
    /// A step, by their derivatives.
    Step(Slopes),
    /// A step by former derivatives, and what the rupture boundary looks at.
    StepAgain,
    /// What is left of them where the iteration ended.
    Rest,
}

/// How an online Newton iteration ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OnlineOutcome {
    pub converged: bool,
    pub iterations: usize,
    pub step: f64,
    /// e_f^I, (3.15), with rows weighted by √w.
    pub residual: f64,
}

impl OnlineOutcome {
    /// It, where an iteration that came to rest at an absurd residual has not converged: it has found garbage.
    pub(super) fn unless_absurd(mut self) -> Self {
        self.converged &= self.residual.is_finite() && self.residual < 1e3;
        self
    }
}

/// One contact as the reduced operators see it.
#[derive(Clone, Copy)]
pub(crate) struct Case<'a> {
    pub problem: &'a Problem,
    /// Registration scale s.
    pub scale: f64,
    /// 1/R̄ of (2.24); 1 where the radius does not vary.
    pub curvature: f64,
    /// Penalty factor γ̄; beside a rupture boundary it holds only the pressures before the centre.
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

impl Operators {
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
        self.state.spread(self.support.own, self.front.as_mut(), coefficients, &mut self.scratch.fields);
        // The films of another contact are no start.
        self.scratch.nodes.forget();
        // Whether the last derivatives are those of a place so near that their factors serve again.
        let mut near = false;
        self.scratch.film_step = (FILM_STEP * stop.tolerance * stop.tolerance).min(stop.tolerance).max(LAST_STEP);
        for iteration in 1..=stop.max_newton {
            let slopes = if iteration > SWIFT { Slopes::Exact } else { Slopes::Usual };
            self.evaluate(case, coefficients, *h_0, if near { Wanted::StepAgain } else { Wanted::Step(slopes) });
            let solved = if near {
                self.step_again(case.problem, case.scale, coefficients)
            } else {
                self.linear_step(case.problem, case.scale, coefficients, observer.is_some())
            };
            if !solved {
                return outcome;
            }
            outcome.iterations = iteration;
            if let Some(observer) = observer.as_mut() {
                self.show(case, (coefficients, *h_0), observer);
            }
            let omega = self.damping(case.scale);
            let former = outcome.step;
            outcome.step = self.take_step(omega, coefficients, h_0);
            if !outcome.step.is_finite() {
                return outcome;
            }
            let moved = self.follow(case.scale, omega, coefficients);
            near = moved != Moved::PastRows
                && omega == 1.0
                && outcome.step < if near { SHRINKS * former } else { NEAR }
                && self.serves_again(case.penalty, observer.is_some());
            if omega == 1.0 && outcome.step < stop.tolerance && moved == Moved::Still {
                outcome.converged = true;
                break;
            }
        }
        outcome.residual = self.evaluate(case, coefficients, *h_0, Wanted::Rest);
        outcome.unless_absurd()
    }

    /// Shows an iterate and the step that was solved for there.
    pub(super) fn show(&mut self, case: &Case<'_>, (coefficients, h_0): (&[f64], f64), observer: &mut RowObserver<'_>) {
        self.jacobian_times_step();
        let s = &self.scratch;
        observer(&Iterate {
            residual: &s.values,
            jacobian_step: &s.product,
            jacobian: s.jacobian.as_ref(),
            step: &s.system.rhs,
            coefficients,
            lift: self.front.as_ref().map_or(case.lift, |front| &front.lift),
            h_c: h_0 - 0.5 * case.scale.ln() + self.lifted(case.lift, coefficients),
        });
    }

    /// Takes a share of the step that was solved for, and of its fields; returns its size, relative.
    pub(super) fn take_step(&mut self, omega: f64, coefficients: &mut [f64], h_0: &mut f64) -> f64 {
        let (s, count) = (&mut self.scratch, self.support.len());
        for part in seen(self.support.own, self.front.as_ref()) {
            for (field, step) in s.fields.chunks_exact_mut(count).zip(s.step_fields.chunks_exact(count)) {
                field[part.clone()]
                    .iter_mut()
                    .zip(&step[part.clone()])
                    .for_each(|(field, step)| *field += omega * step);
            }
        }
        let (mut change, mut size) = (0.0, 0.0);
        for (c, d) in coefficients.iter_mut().zip(&s.system.rhs) {
            *c += omega * d;
            change += d * d;
            size += *c * *c;
        }
        *h_0 += omega * s.system.rhs[self.modes];
        (change / size).sqrt()
    }

    /// Lets the rupture boundary follow a step.
    fn follow(&mut self, scale: f64, omega: f64, coefficients: &[f64]) -> Moved {
        let Self { front, state, load_row, scratch: s, .. } = self;
        let Some(front) = front else { return Moved::Still };
        let steps = (s.step_fields.as_slice(), s.system.rhs[state.modes]);
        let changed = Changed { load_row, fields: &mut s.fields };
        front.follow((&s.nodes, state), (scale, omega), steps, coefficients, changed)
    }

    /// The films of the fields.
    pub(super) fn lay_films(&mut self, case: &Case<'_>, h_0: f64) {
        let Case { scale, curvature, .. } = *case;
        let s = &mut self.scratch;
        let deformation = &s.fields[self.support.len()..];
        let offset = h_0 - 0.5 * scale.ln();
        for part in seen(self.support.own, self.front.as_ref()) {
            let places = self.support.places[part.clone()].iter().zip(&deformation[part.clone()]);
            for (film, (place, deformation)) in s.films[part].iter_mut().zip(places) {
                *film = offset + place.gap(scale, curvature) + scale * deformation;
            }
        }
    }

    /// Evaluates the sampled rows at the fields; returns e_f^I.
    pub(super) fn evaluate(&mut self, case: &Case<'_>, coefficients: &[f64], h_0: f64, wanted: Wanted) -> f64 {
        self.lay_films(case, h_0);
        self.evaluate_nodes(case, wanted == Wanted::Rest);
        let slopes = match wanted {
            Wanted::Step(slopes) => Some(slopes),
            Wanted::StepAgain | Wanted::Rest => None,
        };
        self.evaluate_rows(case, coefficients, slopes)
    }

    /// The nodes of the fields. At the `end` of an iteration those of the rows alone, unless time goes on from what flows
    /// at the others, and without what thinning adds to derivatives.
    fn evaluate_nodes(&mut self, case: &Case<'_>, end: bool) {
        let Case { problem, scale, .. } = *case;
        let s = &mut self.scratch;
        let count = self.support.len();
        let (pressure, rest) = s.fields.split_at(count);
        let gradients = &rest[count..];
        let shear = problem.shear.as_ref().filter(|_| self.axes > 0);
        let gradient = |k: usize| [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
        let treatment = FilmTreatment { last_step: s.film_step, frozen: end, ..FilmTreatment::default() };
        let asking = self.front.as_ref().filter(|front| !end || front.strides);
        match self.heated.as_mut().zip(problem.warm_laws()) {
            Some((heated, laws)) => {
                let (warm, wanted) = heated.film();
                s.nodes.evaluate_warm_at(wanted, &laws, (pressure, &s.films), gradient, warm);
            }
            None if self.front.is_some() => {
                let laws = Laws { shear, ..problem.laws() };
                for part in seen(self.support.own, asking) {
                    s.nodes.evaluate_part(&laws, part, (pressure, &s.films), gradient, treatment);
                }
            }
            None => s.nodes.evaluate(
                Laws { shear, ..problem.laws() },
                (pressure, &s.films),
                gradient,
                treatment,
                Order::BesideTheFormer,
            ),
        }
    }

    /// The sampled rows of these nodes.
    fn evaluate_rows(&mut self, case: &Case<'_>, coefficients: &[f64], slopes: Option<Slopes>) -> f64 {
        let Case { problem, scale, penalty, .. } = *case;
        let (s, count) = (&mut self.scratch, self.support.len());
        let (v, g) = (&self.state.values, &self.state.gradients);
        let d = self.state.deformations(self.front.as_ref());
        // Behind the boundary modes are no part of P.
        let ahead = |node: usize, slope: f64| match &self.front {
            Some(front) if front.is_cut(node) => 0.0,
            _ => slope,
        };
        let mut sum = 0.0;
        for (r, (stencil, geometry)) in self.stencil.iter().zip(&self.geometry).enumerate() {
            if self.front.as_ref().is_some_and(|front| front.is_ruptured(r)) {
                // λ balances it, whatever it is.
                (s.values[r], s.film_column[r], s.film_slopes[r]) = (0.0, 0.0, [0.0; STENCIL]);
                s.jacobian_rows[r * self.modes..(r + 1) * self.modes].fill(0.0);
                continue;
            }
            let geometry = geometry.scaled(scale);
            // Before the centre there is no boundary: where the inlet ruptures, in time, a penalty holds it.
            let ruptures = self.front.as_ref().is_some_and(Front::in_force);
            let held = !ruptures || self.support.places[stencil[CENTER]].xi < 0.0;
            let out = s.nodes.row(&geometry, if held { penalty } else { 0.0 }, *stencil);
            s.values[r] = out.value;
            sum += self.row_weights[r] * scale * out.value * out.value;
            if slopes.is_some() {
                let target = &mut s.jacobian_rows[r * self.modes..(r + 1) * self.modes];
                let of_node = |m: usize| {
                    let own = stencil[m] * self.modes..(stencil[m] + 1) * self.modes;
                    RowNode {
                        values: &v[own.clone()],
                        deformations: &d[own],
                        by_value: ahead(stencil[m], out.d_p[m]),
                        by_deformation: scale * out.d_h[m],
                    }
                };
                if geometry.reaches_across() {
                    jacobian_row::<STENCIL>(std::array::from_fn(of_node), target);
                } else {
                    jacobian_row::<SOUTH>(std::array::from_fn(of_node), target);
                }
                for axis in 0..if s.nodes.thins() { self.axes } else { 0 } {
                    let per_gradient = if axis == 0 { 1.0 / scale } else { 1.0 };
                    let slopes = s.nodes.slopes(&geometry, *stencil, axis);
                    let column = |m: usize| {
                        let own = &g[(axis * count + stencil[m]) * self.modes..][..self.modes];
                        (per_gradient * slopes[m], own)
                    };
                    add_columns::<f64, STENCIL>(std::array::from_fn(column), target);
                }
                (s.film_slopes[r], s.film_column[r]) = (out.d_h, out.d_h.iter().sum());
            }
        }
        if let Some((slopes, front)) = slopes.zip(self.front.as_mut()) {
            front.bend((&self.stencil, &s.film_slopes), slopes == Slopes::Exact, scale, &mut s.jacobian_rows);
        }
        if let Some(error) = &self.deformation_error {
            sum += scale * quadratic_form(error.as_ref(), coefficients).max(0.0);
        }
        let carried: f64 = self.load_row.iter().zip(coefficients).map(|(l, c)| l * c).sum();
        sum += (scale * carried - problem.load).powi(2);
        sum.sqrt()
    }

    /// Solves the reduced linear system; the step is left in `scratch.system.rhs`. False when it is singular.
    /// `keep` keeps a copy of the reduced Jacobian for an observer.
    pub(super) fn linear_step(&mut self, problem: &Problem, scale: f64, coefficients: &[f64], keep: bool) -> bool {
        if self.scratch.minimised.is_some() {
            return self.least_squares_step(problem, scale, coefficients);
        }
        let modes = self.modes;
        let s = &mut self.scratch;
        let rows = s.values.len();
        let jacobian = MatRef::from_row_major_slice(&s.jacobian_rows, rows, modes);
        let (g, SmallSystem { matrix, rhs, .. }) = (self.reconstruction.as_ref(), &mut s.system);
        matmul(matrix.get_mut(..modes, ..modes), Accum::Replace, g, jacobian, 1.0, Par::Seq);
        let (films, values) = (ColRef::from_slice(&s.film_column), ColRef::from_slice(&s.values));
        matmul(matrix.get_mut(..modes, modes..), Accum::Replace, g, films.as_mat(), 1.0, Par::Seq);
        let reduced = ColMut::from_slice_mut(&mut rhs[..modes]);
        matmul(reduced.as_mat_mut(), Accum::Replace, g, values.as_mat(), -1.0, Par::Seq);
        if let Some(front) = &mut self.front {
            let size = (0..modes).map(|k| matrix[(k, k)]).sum::<f64>() / modes as f64;
            s.restraint = RESTRAINED * size;
            front.restrain(s.restraint, matrix.get_mut(..modes, ..modes));
            front.pull(s.restraint, coefficients, &mut rhs[..modes]);
        }
        let mut carried = 0.0;
        for (k, (l, c)) in self.load_row.iter().zip(coefficients).enumerate() {
            matrix[(modes, k)] = scale * l;
            carried += scale * l * c;
        }
        matrix[(modes, modes)] = 0.0;
        rhs[modes] = problem.load - carried;
        if keep {
            s.jacobian.copy_from(&*matrix);
        }
        // Those that are left out stay as they are.
        for k in self.active..modes {
            matrix.row_mut(k).fill(0.0);
            matrix.col_mut(k).fill(0.0);
            (matrix[(k, k)], rhs[k]) = (1.0, 0.0);
        }
        s.system.solve();
        s.system.rhs.iter().all(|v| v.is_finite())
    }

    /// Whether factors may serve for a further step: of Galerkin's equations without a penalty, whose derivatives jump
    /// where pressures change sign. Observers are shown what was solved.
    fn serves_again(&self, penalty: f64, observed: bool) -> bool {
        penalty == 0.0 && !observed && self.scratch.minimised.is_none()
    }

    /// The step by the present values and the factors of the last [`Self::linear_step`].
    fn step_again(&mut self, problem: &Problem, scale: f64, coefficients: &[f64]) -> bool {
        let (modes, s) = (self.modes, &mut self.scratch);
        let (values, rhs) = (ColRef::from_slice(&s.values), &mut s.system.rhs);
        let reduced = ColMut::from_slice_mut(&mut rhs[..modes]);
        matmul(reduced.as_mat_mut(), Accum::Replace, self.reconstruction.as_ref(), values.as_mat(), -1.0, Par::Seq);
        if let Some(front) = &self.front {
            front.pull(s.restraint, coefficients, &mut rhs[..modes]);
        }
        rhs[self.active..modes].fill(0.0);
        let carried: f64 = self.load_row.iter().zip(coefficients).map(|(l, c)| scale * l * c).sum();
        rhs[modes] = problem.load - carried;
        s.system.solve_again();
        s.system.rhs.iter().all(|v| v.is_finite())
    }

    /// The step that makes the sum of squares least, of the rows or of what two bases make of them, and of the load's
    /// row, (2.80)–(2.82), (D.11)–(D.13). False when the columns are dependent.
    fn least_squares_step(&mut self, problem: &Problem, scale: f64, coefficients: &[f64]) -> bool {
        let modes = self.modes;
        let s = &mut self.scratch;
        let Some(LeastSquares { matrix, rhs, .. }) = &mut s.minimised else { return false };
        let (rows, equations) = (s.values.len(), matrix.nrows() - 1);
        let jacobian = MatRef::from_row_major_slice(&s.jacobian_rows, rows, modes);
        let own = self.reconstruction.as_ref();
        match &self.residual_reconstruction {
            None => {
                for (r, factor) in own.row(0).iter().enumerate() {
                    for k in 0..modes {
                        matrix[(r, k)] = factor * jacobian[(r, k)];
                    }
                    (matrix[(r, modes)], rhs[r]) = (factor * s.film_column[r], -factor * s.values[r]);
                }
            }
            Some(of_residual) => {
                matmul(matrix.get_mut(..equations, ..modes), Accum::Replace, own, jacobian, 1.0, Par::Seq);
                let (films, values) = (ColRef::from_slice(&s.film_column), ColRef::from_slice(&s.values));
                matmul(matrix.get_mut(..equations, modes..), Accum::Replace, own, films.as_mat(), 1.0, Par::Seq);
                let right = ColMut::from_slice_mut(&mut rhs[..equations]);
                matmul(right.as_mat_mut(), Accum::Replace, of_residual.as_ref(), values.as_mat(), -1.0, Par::Seq);
            }
        }
        let mut carried = 0.0;
        for (k, (l, c)) in self.load_row.iter().zip(coefficients).enumerate() {
            matrix[(equations, k)] = scale * l;
            carried += scale * l * c;
        }
        (matrix[(equations, modes)], rhs[equations]) = (0.0, problem.load - carried);
        if let Some(minimised) = &mut s.minimised {
            minimised.solve();
            s.system.rhs.copy_from_slice(&minimised.rhs[..=modes]);
        }
        s.system.rhs.iter().all(|v| v.is_finite())
    }

    /// ω = min(1, 0.3/max|ΔP|), and no sampled film loses more than 70 %.
    pub(super) fn damping(&mut self, scale: f64) -> f64 {
        let s = &mut self.scratch;
        let (step, dh_0) = s.system.rhs.split_at(self.modes);
        self.state.spread(self.support.own, self.front.as_mut(), step, &mut s.step_fields);
        let (pressure, deformation) = s.step_fields.split_at(self.support.len());
        let (mut largest, mut omega, dh_0) = (0.0f64, 1.0f64, dh_0[0]);
        for part in seen(self.support.own, self.front.as_ref()) {
            largest = pressure[part.clone()].iter().fold(largest, |a, b| a.max(b.abs()));
            for (&film, d) in s.films[part.clone()].iter().zip(&deformation[part]) {
                let change = dh_0 + scale * d;
                if change < -0.7 * film && film > 0.0 {
                    omega = omega.min(-0.7 * film / change);
                }
            }
        }
        if largest > 0.3 { omega.min(0.3 / largest) } else { omega }
    }

    /// J V Δz̃ on the sampled rows, for the row snapshots.
    fn jacobian_times_step(&mut self) {
        let s = &mut self.scratch;
        let dh_0 = s.system.rhs[self.modes];
        for (r, out) in s.product.iter_mut().enumerate() {
            let row = &s.jacobian_rows[r * self.modes..(r + 1) * self.modes];
            *out = s.film_column[r] * dh_0 + row.iter().zip(&s.system.rhs).map(|(a, b)| a * b).sum::<f64>();
        }
    }
}
