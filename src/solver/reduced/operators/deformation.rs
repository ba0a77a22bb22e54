//! Deformation operator of reduced contacts.

use crate::solver::reduced::dense::{self, quadratic_form};
use crate::solver::reduced::model::{Window, deformation_weights};
use faer::{Mat, MatRef};

/// K V_p, exact or projected onto a basis of deformations.
pub(super) enum Deformation {
    /// K V_p of the local model.
    Exact,
    /// V_δ V_δᵀ W K V_p.
    Projected {
        /// Projected operator over the whole node array.
        operator: Mat<f64>,
        /// E_δ of (3.13) with δ̃ condensed: the part of K V_p that V_δ does not represent, as a quadratic form.
        missing: Mat<f64>,
    },
}

impl Deformation {
    /// Returns the operator for the first modes of a local model, projected onto `deformation_modes` modes if given.
    pub fn of(window: &Window, modes: usize, deformation_modes: Option<usize>) -> Self {
        let Some(k) = deformation_modes else { return Self::Exact };
        let exact = window.pressure.flexed().get(.., ..modes);
        let k = k.clamp(1, window.deformation.modes.ncols());
        let weights = deformation_weights(&window.grid);
        let v = window.deformation.modes.get(.., ..k);
        let weighted = Mat::from_fn(v.nrows(), k, |i, j| weights[i] * v[(i, j)]);
        let operator = dense::product(v, dense::product(weighted.transpose(), exact).as_ref());
        let missing = Mat::from_fn(v.nrows(), modes, |i, j| weights[i].sqrt() * (exact[(i, j)] - operator[(i, j)]));
        let missing = dense::product(missing.transpose(), missing.as_ref());
        Self::Projected { operator, missing }
    }

    /// Returns the operator at some nodes, nodes × modes.
    pub fn at(&self, window: &Window, nodes: &[usize], modes: usize) -> Mat<f64> {
        match self {
            Self::Exact => window.pressure.flexed_at(nodes, modes),
            Self::Projected { operator, .. } => Mat::from_fn(nodes.len(), modes, |i, k| operator[(nodes[i], k)]),
        }
    }

    /// Returns the operator over the whole node array.
    pub fn whole<'a>(&'a self, window: &'a Window, modes: usize) -> MatRef<'a, f64> {
        match self {
            Self::Exact => window.pressure.flexed().get(.., ..modes),
            Self::Projected { operator, .. } => operator.as_ref(),
        }
    }

    /// Returns the square of the projection error of the deformation for the given coefficients, per unit of the scale.
    pub fn missed(&self, coefficients: &[f64]) -> f64 {
        match self {
            Self::Exact => 0.0,
            Self::Projected { missing, .. } => quadratic_form(missing.as_ref(), coefficients).max(0.0),
        }
    }
}
