//! Residual minimisation: combinations of the sampled equations that are minimised, instead of being tested by V.
//!
//! LSPG minimises the rows themselves, (2.68)–(2.72): all of them or, collocated, the sampled ones, (D.27). GNAT
//! minimises the reconstruction of all rows from the sampled ones by two bases, (2.80)–(2.82). D of (D.10) weights
//! rows by the first pressure mode. Rows differ by eight orders of magnitude between the far inlet and the contact,
//! and the mode vanishes in the cavitated region.

use super::sampling::{RowSnapshots, SampledRows, Sampling, TestSpace, gappy_rows, leading_modes};
use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, MatRef};
use serde::{Deserialize, Serialize};

/// Scheme that determines the online step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Scheme {
    /// Galerkin: the rows tested by V vanish.
    #[default]
    Galerkin,
    /// Least squares of the rows (LSPG).
    LeastSquares {
        /// True to weight the rows by D of (D.10).
        weighted: bool,
    },
    /// Least squares of the reconstruction of the sampled equations by two bases (GNAT).
    Gnat {
        /// True to weight the rows by D of (D.10).
        weighted: bool,
    },
}

impl Scheme {
    /// Returns the name used in sentences.
    pub fn name(self) -> &'static str {
        match self {
            Self::Galerkin => "Galerkin",
            Self::LeastSquares { weighted: true } => "weighted least squares",
            Self::LeastSquares { weighted: false } => "least squares",
            Self::Gnat { weighted: true } => "weighted GNAT",
            Self::Gnat { weighted: false } => "GNAT",
        }
    }

    /// Returns the factors of the rows, √w times D of (D.10), with the quadrature weights w.
    pub(crate) fn factors(self, test: &TestSpace) -> Vec<f64> {
        let weighted = matches!(self, Self::LeastSquares { weighted: true } | Self::Gnat { weighted: true });
        let of = |(row, weight): (usize, &f64)| weight.sqrt() * if weighted { test.modes[(row, 0)].abs() } else { 1.0 };
        test.weights.iter().enumerate().map(of).collect()
    }
}

/// Returns the rows of residual minimisation, selected by `sampling` from snapshots scaled with the scheme's factors.
/// `None` if the linear algebra fails.
pub(crate) fn minimised_rows(
    test: &TestSpace,
    (scheme, sampling): (Scheme, Sampling),
    snapshots: &RowSnapshots,
    count: usize,
) -> Option<SampledRows> {
    let factors = scheme.factors(test);
    let rows = match sampling {
        Sampling::All => (0..factors.len()).collect(),
        _ => gappy_rows(sampling, snapshots, count)?,
    };
    let own: Vec<f64> = rows.iter().map(|&row| factors[row]).collect();
    let plain = |rows: Vec<usize>| SampledRows {
        reconstruction: Mat::from_fn(1, rows.len(), |_, r| factors[rows[r]]),
        rows,
        scheme,
        residual: None,
    };
    if !matches!(scheme, Scheme::Gnat { .. }) || sampling == Sampling::All {
        return Some(plain(rows));
    }
    let [of_jacobian, of_residual] =
        [&snapshots.jacobian, &snapshots.residual].map(|snapshots| leading_modes(snapshots, rows.len()));
    let (of_jacobian, of_residual) = (of_jacobian?, of_residual?);
    let jacobian = interpolation(of_jacobian.as_ref(), &rows, &own);
    let residual = interpolation(of_residual.as_ref(), &rows, &own);
    let product: Mat<f64> = of_jacobian.transpose() * &of_residual;
    Some(SampledRows { rows, reconstruction: jacobian, scheme, residual: Some(product * residual) })
}

/// Returns (Φ_I)⁺ with the factors of the rows I: the coefficients in Φ of the reconstruction from these rows.
fn interpolation(modes: MatRef<'_, f64>, rows: &[usize], factors: &[f64]) -> Mat<f64> {
    let (count, square) = (modes.ncols(), rows.len());
    let sampled = Mat::from_fn(square, count, |r, c| modes[(rows[r], c)]);
    let identity = Mat::from_fn(square, square, |r, c| if r == c { factors[r] } else { 0.0 });
    if count == square {
        return PartialPivLu::new(sampled.as_ref()).solve(&identity);
    }
    let normal: Mat<f64> = sampled.transpose() * &sampled;
    PartialPivLu::new(normal.as_ref()).solve(sampled.transpose() * &identity)
}
