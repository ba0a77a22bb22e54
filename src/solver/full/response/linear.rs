//! Complex linear system of a periodic change, and its solution by GMRES.
//!
//! The unknowns are the amplitudes (p, h₀) of pressure and rigid-body separation; the film thickness changes by
//! K p + h₀ with the elastic kernel K. Complex vectors are stored as alternating real and imaginary parts, so that the
//! solvers of real systems serve for them.

use super::derivative::TimeDerivative;
use super::unsupported::check_lubricant;
use crate::solver::discrete::reynolds::{CENTER, Row, STENCIL};
use crate::solver::discrete::space::{Grid, Space};
use crate::solver::full::gmres::Gmres;
use crate::solver::full::newton_space::{Factors, NewtonSpace};
use crate::solver::full::{Problem, Solution, SolveError, SolveOptions, System};
use realfft::num_complex::Complex64;

/// Reason why a linear response is not available.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// The steady contact is refused.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The contact has a property that is not supported; contains what is supported.
    #[error("the linear response covers {0}")]
    Unsupported(&'static str),
    /// The steady solution has not converged.
    #[error("the linear response needs a steady solution that has converged")]
    NotConverged,
    /// The grid does not resolve a wave.
    #[error(
        "the wavelength {wavelength} a is shorter than four spacings of the grid; accepted are wavelengths from \
         {shortest:.4} a on, or a finer grid"
    )]
    ShortWave {
        /// Wavelength λ/a.
        wavelength: f64,
        /// Shortest accepted wavelength.
        shortest: f64,
    },
    /// The characteristic derivative does not fit the grid.
    #[error(
        "the derivative along characteristics needs a uniform grid whose spacing is the time step {step}, but the \
         spacing is {spacing}"
    )]
    NoCharacteristics {
        /// Time step ΔT.
        step: f64,
        /// Largest spacing ΔX in the contact.
        spacing: f64,
    },
    /// The linear solve stopped before its tolerance.
    #[error("the linear system at the frequency Ω = {omega:.4} did not converge: its residual is {residual:.1e}")]
    Stalled {
        /// Ω.
        omega: f64,
        /// Relative residual that was reached.
        residual: f64,
    },
}

/// Derivatives of one equation for changes e^(iΩT).
#[derive(Clone, Copy, Debug, Default)]
pub struct ComplexRow {
    /// By the pressures of the six nodes.
    pub d_p: [Complex64; STENCIL],
    /// By their film thicknesses.
    pub d_h: [Complex64; STENCIL],
}

/// Space with a factorised approximation of the complex system.
pub trait ResponseSpace: NewtonSpace {
    /// Factors of the approximation.
    type ComplexFactors: Factors;

    /// Assembles and factorises an approximation of the scaled equations. Vectors alternate real and imaginary parts.
    fn factorise(&self, factors: &mut Self::ComplexFactors, rows: &[ComplexRow], scaling: &[f64]);
}

/// Tolerance of a solve relative to its right-hand side, and the largest number of Krylov iterations.
const TOLERANCE: f64 = 1e-10;
const MOST_KRYLOV: usize = 200;
/// Largest relative residual of a solve that counts as converged. Rounding may stop an iteration above its tolerance.
const ACCEPTED: f64 = 1e-7;

/// Steady contact prepared for responses at any frequency.
pub struct LinearResponse<S: ResponseSpace> {
    system: System<S>,
    problem: Problem,
    rows: Vec<ComplexRow>,
    scaling: Vec<f64>,
    factors: Bordered<S::ComplexFactors>,
    krylov: Gmres,
    /// Node arrays of the real and the imaginary part.
    parts: [Vec<f64>; 2],
    deformations: [Vec<f64>; 2],
}

/// Amplitudes of a periodic change.
pub struct Amplitudes {
    /// Pressure p, node array.
    pub pressure: Vec<Complex64>,
    /// Deformation K p + h₀, node array.
    pub film: Vec<Complex64>,
    /// h₀.
    pub h_0: Complex64,
}

impl<S: ResponseSpace> LinearResponse<S> {
    /// Creates the linearised system of a steady solution on its grid.
    ///
    /// # Errors
    /// If the solution has not converged, or if the contact is not supported.
    pub fn new(reference: &S::Reference, solution: &Solution) -> Result<Self, ResponseError> {
        check_lubricant(&solution.problem.lubricant)?;
        if !solution.converged() {
            return Err(ResponseError::NotConverged);
        }
        let problem = solution.problem;
        let mut system = System::new(S::on(reference, S::form_of(reference, &problem))?);
        if system.space.grid().continues() {
            return Err(ResponseError::Unsupported("contacts whose pressure ends within the domain"));
        }
        system.set_pressure(&problem, &solution.pressure);
        system.set_h_0(solution.scalars.h_0);
        Ok(Self::around(system, problem))
    }

    /// Creates the linearised system around the state of a system, which must solve the problem with the steady rows of
    /// its space.
    pub(in crate::solver::full) fn around(mut system: System<S>, problem: Problem) -> Self {
        let options = SolveOptions::<S::Control>::default();
        system.begin(&problem, &options);
        system.evaluate(&problem, options.penalty);
        let (nodes, unknowns) = (system.pressure.len(), system.rows.len());
        Self {
            system,
            problem,
            rows: vec![ComplexRow::default(); unknowns],
            scaling: vec![1.0; unknowns],
            factors: Bordered::default(),
            krylov: Gmres::default(),
            parts: [0, 1].map(|_| vec![0.0; nodes]),
            deformations: [0, 1].map(|_| vec![0.0; nodes]),
        }
    }

    /// Computes the responses to a change of the load by 1 and to a change of the speed of the flow by 1, both in the
    /// units of the equations, which have the current `speed` > 0.
    ///
    /// # Errors
    /// If a linear solve stalls.
    pub fn to_load_and_speed(&mut self, omega: f64, speed: f64) -> Result<[Amplitudes; 2], ResponseError> {
        self.set_frequency(omega, TimeDerivative::Exact);
        let to_load = self.solve(omega, |_| Complex64::ZERO, 1.0)?;
        let System { space, nodes, active, .. } = &self.system;
        let convection = |k: usize| {
            let (stencil, geometry) = space.row(k);
            let sum = geometry.upwind.iter().zip(stencil).map(|(weight, node)| weight * nodes[node].flow).sum::<f64>();
            if active.holds() && active.ruptured[k] { 0.0 } else { -sum / speed }
        };
        let forced: Vec<f64> = (0..self.rows.len()).map(convection).collect();
        Ok([to_load, self.solve_forced(omega, |k| forced[k].into(), 0.0)?])
    }

    /// Returns the steady problem.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    pub(super) fn grid(&self) -> &S::Grid {
        self.system.space.grid()
    }

    /// Returns the film thickness of the steady solution at X = 0 (and Y = 0).
    pub fn central_film(&self) -> f64 {
        self.grid().central(&self.system.film)
    }

    /// Sets the equations for a frequency.
    pub(super) fn set_frequency(&mut self, omega: f64, derivative: TimeDerivative) {
        let Self { system, rows, scaling, factors, .. } = self;
        let System { space, rows: steady, nodes, active, .. } = system;
        let diagonal = space.own_deformation();
        for (k, (row, steady)) in rows.iter_mut().zip(&*steady).enumerate() {
            let Row { d_p, d_h, .. } = steady;
            *row = ComplexRow { d_p: d_p.map(Complex64::from), d_h: d_h.map(Complex64::from) };
            let held = active.holds() && active.ruptured[k];
            if !held {
                let (stencil, geometry) = space.row(k);
                for (e, weight) in derivative.added_weights(geometry.upwind, omega).into_iter().enumerate() {
                    let node = &nodes[stencil[e]];
                    row.d_p[e] -= weight * node.flow_p;
                    row.d_h[e] -= weight * node.flow_h;
                }
            }
            scaling[k] = 1.0 / (row.d_p[CENTER].norm() + row.d_h[CENTER].norm() * diagonal);
        }
        space.factorise(&mut factors.matrix, rows, scaling);
        factors.border(space, rows, scaling);
    }

    /// Solves for the change under a gap that changes by `gap` (node function) and a load that changes by `load`.
    ///
    /// # Errors
    /// If the linear solve stalls at the frequency `omega`, which [`Self::set_frequency`] has set.
    pub(super) fn solve(
        &mut self,
        omega: f64,
        gap: impl Fn(usize) -> Complex64,
        load: f64,
    ) -> Result<Amplitudes, ResponseError> {
        let by_gap = |k: usize| {
            let (stencil, _) = self.system.space.row(k);
            self.rows[k].d_h[..S::NODES].iter().zip(stencil).map(|(d, node)| d * gap(node)).sum()
        };
        let forced: Vec<Complex64> = (0..self.rows.len()).map(by_gap).collect();
        self.solve_forced(omega, |k| forced[k], load)
    }

    /// Solves for the change under a change `forced` of the value of each unknown's equation and a load that changes
    /// by `load`.
    fn solve_forced(
        &mut self,
        omega: f64,
        forced: impl Fn(usize) -> Complex64,
        load: f64,
    ) -> Result<Amplitudes, ResponseError> {
        let Self { system, rows, scaling, factors, krylov, parts, deformations, .. } = self;
        let System { space, scratch, .. } = system;
        let space = &*space;
        let (grid, weights) = (space.grid(), space.grid().weights());
        let unknowns = rows.len();
        let mut rhs = vec![0.0; 2 * unknowns + 2];
        for (k, s) in scaling.iter().enumerate() {
            let value = -s * forced(k);
            (rhs[2 * k], rhs[2 * k + 1]) = (value.re, value.im);
        }
        rhs[2 * unknowns] = load;
        let mut solution = vec![0.0; rhs.len()];
        let outcome = krylov.solve(
            &rhs,
            &mut solution,
            (TOLERANCE, MOST_KRYLOV),
            |v, out| {
                for (offset, (part, deformation)) in parts.iter_mut().zip(&mut *deformations).enumerate() {
                    for k in 0..unknowns {
                        part[grid.node(k)] = v[2 * k + offset];
                    }
                    grid.deform(part, deformation, scratch);
                    out[2 * unknowns + offset] = weights.iter().zip(&*part).map(|(w, p)| w * p).sum();
                }
                let shift = Complex64::new(v[2 * unknowns], v[2 * unknowns + 1]);
                let pair = |[re, im]: &[Vec<f64>; 2], node: usize| Complex64::new(re[node], im[node]);
                let mut products = vec![Complex64::ZERO; unknowns];
                space.each_row(&mut products, |k, stencil, out| {
                    let ComplexRow { d_p, d_h } = &rows[k];
                    let of =
                        |e: usize| d_p[e] * pair(parts, stencil[e]) + d_h[e] * (pair(deformations, stencil[e]) + shift);
                    *out = (0..S::NODES).map(of).sum::<Complex64>() * scaling[k];
                });
                for (out, product) in out.chunks_exact_mut(2).zip(products) {
                    (out[0], out[1]) = (product.re, product.im);
                }
            },
            |v| factors.apply(v),
            |_| true,
        );
        // A NaN is not below any limit.
        if !(outcome.relative_residual < ACCEPTED || rhs.iter().all(|r| *r == 0.0)) {
            return Err(ResponseError::Stalled { omega, residual: outcome.relative_residual });
        }
        for (offset, (part, deformation)) in parts.iter_mut().zip(&mut *deformations).enumerate() {
            for k in 0..unknowns {
                part[grid.node(k)] = solution[2 * k + offset];
            }
            grid.deform(part, deformation, scratch);
        }
        let h_0 = Complex64::new(solution[2 * unknowns], solution[2 * unknowns + 1]);
        let complex = |[re, im]: &[Vec<f64>; 2], shift: Complex64| {
            re.iter().zip(im).map(|(re, im)| Complex64::new(*re, *im) + shift).collect()
        };
        Ok(Amplitudes { pressure: complex(parts, Complex64::ZERO), film: complex(deformations, h_0), h_0 })
    }
}

/// Factors of the equations, bordered by the h₀ column and the load equation.
#[derive(Default)]
struct Bordered<F> {
    matrix: F,
    /// Solution for the h₀ column.
    column: Vec<f64>,
    /// wᵀ column.
    schur: Complex64,
    /// Quadrature weights w of the unknowns.
    weights: Vec<f64>,
}

impl<F: Factors> Bordered<F> {
    fn border<S: Space>(&mut self, space: &S, rows: &[ComplexRow], scaling: &[f64]) {
        let (grid, weights) = (space.grid(), space.grid().weights());
        self.weights.clear();
        self.weights.extend((0..rows.len()).map(|k| weights[grid.node(k)]));
        self.column.clear();
        for (row, s) in rows.iter().zip(scaling) {
            let sum = s * row.d_h[..S::NODES].iter().sum::<Complex64>();
            self.column.extend([sum.re, sum.im]);
        }
        self.matrix.solve(&mut self.column);
        self.schur = self.load(&self.column);
    }

    fn load(&self, values: &[f64]) -> Complex64 {
        let pairs = values.chunks_exact(2).zip(&self.weights);
        pairs.map(|(v, w)| w * Complex64::new(v[0], v[1])).sum()
    }

    /// Replaces v by M⁻¹ v; the last pair belongs to h₀.
    fn apply(&mut self, v: &mut [f64]) {
        let (head, last) = v.split_at_mut(2 * self.weights.len());
        self.matrix.solve(head);
        let wanted = Complex64::new(last[0], last[1]);
        let h_0 = if self.schur == Complex64::ZERO { Complex64::ZERO } else { (self.load(head) - wanted) / self.schur };
        for (v, c) in head.chunks_exact_mut(2).zip(self.column.chunks_exact(2)) {
            let product = h_0 * Complex64::new(c[0], c[1]);
            v[0] -= product.re;
            v[1] -= product.im;
        }
        (last[0], last[1]) = (h_0.re, h_0.im);
    }
}
