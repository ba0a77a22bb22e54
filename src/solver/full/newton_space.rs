//! What a space brings to Newton's method: its step control and its preconditioner, because those really differ, and
//! where it starts.

use super::mesh::Mesh;
use super::problem::{Problem, SolveError};
use super::system::{SolveOptions, System};
use super::thinning::Thinning;
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::reynolds::Row;
use crate::solver::discrete::space::{Grid, Space};
use crate::solver::physics::contact::ContactKind;

/// Settings of a step control, with the settings of all else that go with it.
pub trait StepControl: Copy + PartialEq + std::fmt::Debug {
    /// The settings of a solve.
    fn options() -> SolveOptions<Self>;
}

impl<C: StepControl> Default for SolveOptions<C> {
    fn default() -> Self {
        C::options()
    }
}

/// What a step of pressure and film has to keep to between two marches.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// Largest change of P.
    pub largest_step: f64,
    /// Largest share of the film that it may take away.
    pub film_loss: f64,
    /// Backtracking ends at this share of it.
    pub shortest_step: f64,
    /// Whether there is backtracking at all.
    pub looks_back: bool,
    /// Whether it is the last one, solved for all but to rounding.
    pub last: bool,
}

/// What a Newton step did.
pub struct Taken {
    /// Size of the undamped step, so that damping never looks like convergence.
    pub size: f64,
    /// ΔH₀ of the undamped step, where its size does not contain it.
    pub shift: f64,
    /// Residual norm after the step.
    pub residual: f64,
}

/// The rows that a matrix is assembled for.
pub struct ScaledRows<'a> {
    /// Values and derivatives.
    pub rows: &'a [Row],
    /// What shear-thinning adds to the derivatives.
    pub thinning: Option<&'a Thinning>,
    /// What each row is multiplied with.
    pub scaling: &'a [f64],
    /// Which unknowns are fractions, which deform nothing and carry no load; empty where none are.
    pub fractions: &'a [bool],
}

/// A factorised matrix.
pub trait Factors: Default {
    /// b ← A⁻¹ b.
    fn solve(&mut self, b: &mut [f64]);
}

/// A space with what Newton's method needs on it.
pub trait NewtonSpace: Space + Sized {
    /// The settings of its step control.
    type Control: StepControl;
    /// What that remembers from step to step.
    type Memory: Default;
    /// The matrix that preconditions the linear solves.
    type Matrix: Factors;
    /// What its grid is built from, and what a solver keeps of it between contacts.
    type Spec;
    /// What a solver keeps of its grid between contacts.
    type Reference;
    /// What a contact makes of that: the scale of a line's registration, the ellipse of a point contact.
    type Form: Copy + PartialEq;

    /// The kind of contact it is a space of.
    const KIND: ContactKind;
    /// Residual beyond which the iteration is given up.
    const WORST_RESIDUAL: f64;
    /// Whether steps clip pressures, and so lose the load they carry. Where they do not, it holds exactly from the
    /// start and every step keeps it, because the preconditioner's load row is exact.
    const CLIPS: bool;
    /// Films tried by a cold start, in units of the contact's film formula.
    const COLD_FILMS: [f64; 3];
    /// The first column of nodes along X that has a film.
    const FIRST_COLUMN: usize;
    /// Range of M in which cold starts converge.
    const EASY_M: (f64, f64);
    /// L up to which they do.
    const EASY_L: f64;
    /// M up to which several cold starts are tried, and up to which one is.
    const COLD_M: (f64, f64);

    /// Builds the grid and its kernel.
    ///
    /// # Errors
    /// When the specification is refused.
    fn build(spec: Self::Spec) -> Result<Self::Reference, SolveError>;

    /// Number of unknown pressures.
    fn unknowns(reference: &Self::Reference) -> usize;

    /// How often the spacing may be doubled as long as a contact of a walk is resolved well enough to start another one.
    fn coarsening(_: &Self::Reference, _: &Problem) -> usize {
        0
    }

    /// The grid with 2ⁿ times the spacing; none where it has no coarser ones.
    ///
    /// # Errors
    /// When its kernel cannot be built.
    fn coarser(_: &Self::Reference, _: i32) -> Result<Option<Self::Reference>, SolveError> {
        Ok(None)
    }

    /// What a problem makes of the grid.
    fn form_of(reference: &Self::Reference, problem: &Problem) -> Self::Form;

    /// The space on a grid in a form.
    ///
    /// # Errors
    /// When the kernel of that form cannot be built.
    fn on(reference: &Self::Reference, form: Self::Form) -> Result<Self, SolveError>;

    /// The form it has.
    fn form(&self) -> Self::Form;

    /// Its grid as solutions name it.
    fn mesh(&self) -> Mesh;

    /// Accuracy of the next linear solve, relative to its right-hand side.
    fn forcing(control: &Self::Control, memory: &mut Self::Memory, residual: f64) -> f64;

    /// Takes the step `system.update` as far as it helps; `before` is the residual norm.
    fn step(
        system: &mut System<Self>,
        problem: &Problem,
        options: &SolveOptions<Self::Control>,
        memory: &mut Self::Memory,
        before: f64,
    ) -> Taken;

    /// The control of steps that take turns with the temperatures.
    fn beside_heat(control: Self::Control, turn: Turn) -> Self::Control;

    /// Assembles and factorises a matrix near the Jacobian of the scaled rows; `false` when `go_on` ended it half way.
    fn assemble(
        &self,
        matrix: &mut Self::Matrix,
        control: &Self::Control,
        rows: &ScaledRows<'_>,
        go_on: impl Fn() -> bool + Sync,
    ) -> bool;
}

/// A factorised matrix, bordered by the H₀ column and the load row.
#[derive(Default)]
pub struct Preconditioner<M> {
    /// The matrix of the rows.
    pub matrix: M,
    /// Its solution for the H₀ column.
    column: Vec<f64>,
    /// wᵀ column.
    schur: f64,
    /// Quadrature weights of the unknowns.
    weights: Vec<f64>,
}

impl<M: Factors> Preconditioner<M> {
    /// Borders the matrix, assembled for these rows, by the film's and the load's.
    pub fn border<S: Space>(&mut self, space: &S, &ScaledRows { rows, scaling, fractions, .. }: &ScaledRows<'_>) {
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

    /// v ← M⁻¹ v; the last entry belongs to H₀.
    pub fn apply(&mut self, v: &mut [f64]) {
        let (head, last) = v.split_at_mut(self.weights.len());
        self.matrix.solve(head);
        let carried = dot(&self.weights, head);
        let dh_0 = if self.schur == 0.0 { 0.0 } else { (carried - last[0]) / self.schur };
        for (v, c) in head.iter_mut().zip(&self.column) {
            *v -= dh_0 * c;
        }
        last[0] = dh_0;
    }
}
