//! Deformation K(κ) V of the modes V of a local model for all elliptical contacts. K is the elastic kernel and κ = b/a
//! the ratio of the semi-axes; K V is interpolated between few values of κ.
//!
//! The entries are smooth functions of ln κ. With six Chebyshev nodes over the range of a local model the error is
//! about 1e-6 of the largest deformation. The online cost hardly changes, because K V is interpolated once per contact.
//! Single precision (6e-8) is sufficient and halves the memory. The deformations of a local model take much memory, so
//! they are computed when it is first used.

use super::online::ReducedError;
use crate::host::pool::{computed, on_all_cores};
use crate::solver::discrete::grid::{ContactGrid, GridError, PointGrid};
use crate::solver::parameters::{CIRCLES, ParameterSpace};
use crate::solver::physics::contact::{Ellipse, OperatingPoint};
use faer::Mat;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Number of nodes in ln κ for a range of radius ratios up to a factor of ten, and for a wider range.
const NODES: [usize; 2] = [6, 9];
/// Part of the range of ln κ by which shapes may be used beyond each of its ends.
const BEYOND: f64 = 0.1;

/// Deformation K V of the modes of a local model for an interval of the radius ratio R_y/R.
#[derive(Clone, Debug)]
pub struct Shapes {
    /// Interval of R_y/R.
    pub ratios: (f64, f64),
    /// Ends of the interval of ln κ.
    ends: (f64, f64),
    grid: Arc<PointGrid>,
    /// K(κ) V over the node array, one matrix per node in ln κ; see [`Self::flexed`].
    flexed: OnceLock<Vec<Mat<f32>>>,
}

/// Returns Chebyshev node `i` of the second kind of `count` nodes in −1…1.
fn node(i: usize, count: usize) -> f64 {
    -(PI * i as f64 / (count - 1) as f64).cos()
}

impl Shapes {
    /// Creates the shapes of modes on the nodes of a grid.
    ///
    /// # Errors
    /// [`GridError`] if no ellipse has one of the ratios.
    pub fn new(grid: &Arc<PointGrid>, ratios: (f64, f64)) -> Result<Self, GridError> {
        let (low, high) = ratios;
        let log_kappa = |ratio: f64| match Ellipse::of_ratio(ratio) {
            Ok(ellipse) => Ok(ellipse.kappa.ln()),
            Err(error) => Err(GridError::Refused(error.to_string())),
        };
        let ends = (log_kappa(low)?, log_kappa(high)?);
        Ok(Self { ratios, ends, grid: Arc::clone(grid), flexed: OnceLock::new() })
    }

    /// Returns the number of nodes in ln κ.
    pub(super) fn count(&self) -> usize {
        NODES[usize::from(self.ratios.1 > 10.0 * self.ratios.0)]
    }

    /// Returns K(κ) V for the modes V of the local model, one matrix per node in ln κ. The first call computes them.
    pub(super) fn flexed(&self, modes: &Mat<f64>) -> &[Mat<f32>] {
        let all: &Vec<Mat<f32>> = computed(&self.flexed, || {
            let (ends, count) = (self.ends, self.count());
            let flexed = |i: usize| {
                let at = 0.5 * (ends.0 + ends.1) + 0.5 * (ends.1 - ends.0) * node(i, count);
                let grid = self.grid.of_ellipse(Ellipse::of_kappa(at.exp()))?;
                let flexed = ContactGrid::Point(grid).flex(modes);
                Ok(Mat::from_fn(flexed.nrows(), flexed.ncols(), |node, k| flexed[(node, k)] as f32))
            };
            let all = on_all_cores(|| (0..count).into_par_iter().map(flexed).collect::<Result<_, GridError>>());
            // A kernel is refused only for its size, and the kernel of the grid has the same size.
            all.unwrap_or_default()
        });
        all
    }

    /// Returns the factor by which R_y/R of a contact lies outside the interval of the shapes, or of circular contacts
    /// for `None`. It is 1 inside.
    pub fn aside(shapes: Option<&Self>, point: &OperatingPoint) -> f64 {
        let ((low, high), ratio) = (shapes.map_or(CIRCLES, |shapes| shapes.ratios), point.radius_ratio());
        (low / ratio).max(ratio / high).max(1.0)
    }

    /// Checks that a local model with these shapes, or of circular contacts for `None`, is valid for a contact.
    ///
    /// # Errors
    /// [`ReducedError::Ellipse`] if it is not, with R_y/R of the trained range.
    pub(super) fn check(
        shapes: Option<&Self>,
        point: &OperatingPoint,
        range: &ParameterSpace,
    ) -> Result<(), ReducedError> {
        let ellipse = point.ellipse();
        if shapes.map_or(ellipse != Ellipse::CIRCLE, |shapes| !shapes.hold_for(&ellipse)) {
            return Err(ReducedError::Ellipse { given: ellipse.radius_ratio, known: range.radius_ratio() });
        }
        Ok(())
    }

    /// Returns true if the shapes are valid for an ellipse. They are also valid slightly beyond their range.
    pub fn hold_for(&self, ellipse: &Ellipse) -> bool {
        self.place(ellipse).abs() <= 1.0 + 2.0 * BEYOND
    }

    /// Returns ln κ of an ellipse, scaled such that the interval is −1…1.
    fn place(&self, ellipse: &Ellipse) -> f64 {
        let (low, high) = self.ends;
        if high > low { (2.0 * ellipse.kappa.ln() - low - high) / (high - low) } else { 0.0 }
    }

    /// Returns K(κ) V of an ellipse.
    #[cfg(test)]
    pub(crate) fn flexed_at(&self, modes: &Mat<f64>, ellipse: &Ellipse) -> Mat<f64> {
        let (nodes, count) = modes.shape();
        let mut sum = Mat::zeros(nodes, count);
        for k in 0..count {
            let mut unit = vec![0.0; k + 1];
            unit[k] = 1.0;
            let mut column = vec![0.0; nodes];
            self.add_deformation(modes, ellipse, &unit, &mut column);
            (0..nodes).for_each(|node| sum[(node, k)] = column[node]);
        }
        sum
    }

    /// Adds the deformation K(κ) V q to the node array `film`. If there are fewer coefficients q than modes, they
    /// belong to the first modes.
    pub(super) fn add_deformation(&self, modes: &Mat<f64>, ellipse: &Ellipse, coefficients: &[f64], film: &mut [f64]) {
        for (weight, flexed) in self.weights(ellipse).into_iter().zip(self.flexed(modes)) {
            for (q, column) in coefficients.iter().zip(flexed.col_iter()) {
                let factor = weight * q;
                film.iter_mut().zip(column.iter()).for_each(|(film, value)| *film += factor * f64::from(*value));
            }
        }
    }

    /// Returns the interpolation weights at an ellipse, one per matrix.
    pub(super) fn weights(&self, ellipse: &Ellipse) -> Vec<f64> {
        let (count, at) = (self.count(), self.place(ellipse));
        if let Some(exact) = (0..count).find(|&i| node(i, count) == at) {
            return (0..count).map(|i| f64::from(u8::from(i == exact))).collect();
        }
        // Barycentric weights of these nodes: alternating signs, halved at the ends.
        let weight = |i: usize| {
            let half = if i == 0 || i + 1 == count { 0.5 } else { 1.0 };
            let sign = if i.is_multiple_of(2) { half } else { -half };
            sign / (at - node(i, count))
        };
        let sum: f64 = (0..count).map(weight).sum();
        (0..count).map(|i| weight(i) / sum).collect()
    }
}
