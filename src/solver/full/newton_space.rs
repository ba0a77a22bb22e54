//! Parts of Newton's method that depend on the space: step control, preconditioner and initial guesses.

use super::mesh::Mesh;
use super::problem::{Problem, SolveError};
use super::system::{SolveOptions, System};
use super::thinning::Thinning;
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::reynolds::Row;
use crate::solver::discrete::space::{Grid, Space};
use crate::solver::physics::contact::ContactKind;

/// Settings of a step control, with the default settings of a solve.
pub trait StepControl: Copy + PartialEq + std::fmt::Debug {
    /// Returns the default settings of a solve.
    fn options() -> SolveOptions<Self>;
}

impl<C: StepControl> Default for SolveOptions<C> {
    fn default() -> Self {
        C::options()
    }
}

/// Limits of a step of pressure and film thickness between two marches of the temperatures.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Largest change of P.
    pub largest_step: f64,
    /// Largest relative reduction of the film thickness.
    pub film_loss: f64,
    /// Shortest share of the step in backtracking.
    pub shortest_step: f64,
    /// Enables backtracking.
    pub looks_back: bool,
    /// True for the last step, which is solved nearly to rounding.
    pub last: bool,
}

/// Result of a Newton step.
pub struct Taken {
    /// Size of the undamped step, so that damping is never mistaken for convergence.
    pub size: f64,
    /// ΔH₀ of the undamped step, unless its size includes it; zero otherwise.
    pub shift: f64,
    /// Residual norm after the step.
    pub residual: f64,
}

/// Equations for which a matrix is assembled.
pub struct ScaledRows<'a> {
    /// Values and derivatives.
    pub rows: &'a [Row],
    /// Contribution of shear thinning to the derivatives.
    pub thinning: Option<&'a Thinning>,
    /// Factor of each equation.
    pub scaling: &'a [f64],
    /// True for unknowns that are film fractions, which cause no deformation and carry no load. Empty without
    /// fractions.
    pub fractions: &'a [bool],
}

/// Factorised matrix.
pub trait Factors: Default {
    /// Replaces b by A⁻¹ b.
    fn solve(&mut self, b: &mut [f64]);
}

/// Space with the parts that Newton's method needs.
pub trait NewtonSpace: Space + Sized {
    /// Settings of the step control.
    type Control: StepControl;
    /// Data that the step control keeps from step to step.
    type Memory: Default;
    /// Matrix that preconditions the linear solves.
    type Matrix: Factors;
    /// Specification from which the grid is built.
    type Spec;
    /// Grid data that a solver keeps between contacts.
    type Reference;
    /// Part of the grid that depends on the contact: the scale of a line contact's registration, or the ellipse of a
    /// point contact.
    type Form: Copy + PartialEq;

    /// Kind of contact on this space.
    const KIND: ContactKind;
    /// Residual beyond which the iteration is stopped as diverged.
    const WORST_RESIDUAL: f64;
    /// True if steps clip pressures and thus change the load. Without clipping, the load holds exactly from the start
    /// and after every step, because the preconditioner's load equation is exact.
    const CLIPS: bool;
    /// Central film thicknesses of cold starts, in units of the contact's film formula.
    const COLD_FILMS: [f64; 3];
    /// First column of nodes along X with a film.
    const FIRST_COLUMN: usize;
    /// Range of M in which cold starts converge.
    const EASY_M: (f64, f64);
    /// L up to which cold starts converge.
    const EASY_L: f64;
    /// M up to which several cold starts are tried, and M up to which one is tried.
    const COLD_M: (f64, f64);

    /// Builds the grid and its kernel.
    ///
    /// # Errors
    /// If the specification is refused.
    fn build(spec: Self::Spec) -> Result<Self::Reference, SolveError>;

    /// Returns the number of unknown pressures.
    fn unknowns(reference: &Self::Reference) -> usize;

    /// Returns how often the spacing may be doubled such that a contact of a continuation is still resolved well
    /// enough to start another one.
    fn coarsening(_: &Self::Reference, _: &Problem) -> usize {
        0
    }

    /// Returns the grid with 2ⁿ times the spacing, or `None` if there is no coarser grid.
    ///
    /// # Errors
    /// If its kernel cannot be built.
    fn coarser(_: &Self::Reference, _: i32) -> Result<Option<Self::Reference>, SolveError> {
        Ok(None)
    }

    /// Returns the form of the grid for a problem.
    fn form_of(reference: &Self::Reference, problem: &Problem) -> Self::Form;

    /// Returns the space on a grid in the given form.
    ///
    /// # Errors
    /// If the kernel of that form cannot be built.
    fn on(reference: &Self::Reference, form: Self::Form) -> Result<Self, SolveError>;

    /// Returns its form.
    fn form(&self) -> Self::Form;

    /// Returns its grid as stored in solutions.
    fn mesh(&self) -> Mesh;

    /// Returns the accuracy of the next linear solve, relative to its right-hand side.
    fn forcing(control: &Self::Control, memory: &mut Self::Memory, residual: f64) -> f64;

    /// Takes the step `system.update`, damped or limited by the step control. `before` is the residual norm.
    fn step(
        system: &mut System<Self>,
        problem: &Problem,
        options: &SolveOptions<Self::Control>,
        memory: &mut Self::Memory,
        before: f64,
    ) -> Taken;

    /// Returns the control of steps that alternate with marches of the temperatures.
    fn beside_heat(control: Self::Control, turn: Turn) -> Self::Control;

    /// Assembles and factorises an approximation of the Jacobian of the scaled equations. Returns `false` if `go_on`
    /// stopped it.
    fn assemble(
        &self,
        matrix: &mut Self::Matrix,
        control: &Self::Control,
        rows: &ScaledRows<'_>,
        go_on: impl Fn() -> bool + Sync,
    ) -> bool;
}

/// Factorised matrix, bordered by the H₀ column and the load equation.
#[derive(Default)]
pub struct Preconditioner<M> {
    /// Matrix of the equations.
    pub matrix: M,
    /// Its solution for the H₀ column.
    column: Vec<f64>,
    /// wᵀ column.
    schur: f64,
    /// Quadrature weights w of the unknowns.
    weights: Vec<f64>,
    /// True if the load equation is ΔH₀ = 0.
    prescribed: bool,
}

impl<M: Factors> Preconditioner<M> {
    /// Borders the matrix assembled for these equations by the H₀ column and the load equation, or by ΔH₀ = 0 if H₀ is
    /// `prescribed`.
    pub fn border<S: Space>(
        &mut self,
        space: &S,
        &ScaledRows { rows, scaling, fractions, .. }: &ScaledRows<'_>,
        prescribed: bool,
    ) {
        self.prescribed = prescribed;
        let (grid, weights) = (space.grid(), space.grid().weights());
        self.weights.clear();
        self.weights.extend((0..rows.len()).map(|k| weights[grid.node(k)]));
        for (weight, _) in self.weights.iter_mut().zip(fractions).filter(|(_, fraction)| **fraction) {
            *weight = 0.0;
        }
        self.column.clear();
        self.column.extend(rows.iter().zip(scaling).map(|(row, s)| s * row.d_h[..S::NODES].iter().sum::<f64>()));
        self.matrix.solve(&mut self.column);
        self.schur = dot(&self.weights, &self.column);
    }

    /// Replaces v by M⁻¹ v; the last entry belongs to H₀.
    pub fn apply(&mut self, v: &mut [f64]) {
        let (head, last) = v.split_at_mut(self.weights.len());
        self.matrix.solve(head);
        if self.prescribed {
            // The right-hand side of ΔH₀ = 0 is zero, and so is the last entry of every Krylov vector.
            return;
        }
        let carried = dot(&self.weights, head);
        let dh_0 = if self.schur == 0.0 { 0.0 } else { (carried - last[0]) / self.schur };
        for (v, c) in head.iter_mut().zip(&self.column) {
            *v -= dh_0 * c;
        }
        last[0] = dh_0;
    }
}
