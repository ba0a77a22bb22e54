//! One window of a model on its way to or from a file.

use super::sound::are_rows;
use crate::engine::former::domain::FormerSnapshot;
use crate::engine::former::stored_matrix::{StoredBasis, StoredMatrix};
use crate::engine::rom::ModelFileError;
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Sliding;
use crate::solver::reduced::{
    Calibration, Combined, Domain, FeatureSet, Keeping, PodBasis, PressureModes, RULE_ACCURACY, ReducedModel,
    SampledRows, Sampling, Scheme, Snapshot, TractionRule, Window,
};
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Accuracy of the deformations of a plane, relative as that of pressures: their bases end at modes that are common, and no
/// mobility multiplies what they lose. Those of a line go on to rare ones, and are kept as its pressures.
const BENT_ACCURACY: f64 = 1e-5;

#[derive(Serialize, Deserialize)]
pub(super) struct StoredWindow {
    pub m: (f64, f64),
    pub grid: GridSpec,
    penalty: f64,
    pub pressure: StoredBasis,
    /// Of windows around anchors the first one has it for all.
    pub deformation: StoredBasis,
    sampling: Sampling,
    sampled_rows: Vec<usize>,
    reconstruction: StoredMatrix,
    _none: Vec<FormerSnapshot>,
    #[serde(skip)]
    pub snapshots: Vec<Snapshot>,
    traction: Option<TractionRule>,
    /// None where the calibrations of all windows are kept together.
    _one: Option<()>,
    #[serde(skip)]
    pub calibration: Option<Calibration>,
}

/// Sampled rows on their way to or from a file, with the scheme that they serve.
#[derive(Serialize, Deserialize)]
pub(in crate::engine) struct StoredRows {
    pub rows: Vec<usize>,
    pub reconstruction: StoredMatrix,
    pub scheme: Scheme,
    /// What GNAT makes of the residual.
    pub residual: Option<StoredMatrix>,
}

impl StoredRows {
    /// The rows of a model with so many modes on a grid.
    ///
    /// # Errors
    /// When they do not fit it or each other.
    pub fn into_rows(self, modes: usize, grid: &ContactGrid) -> Result<SampledRows, ModelFileError> {
        let damaged = |what| Err(ModelFileError::Damaged { what });
        let Self { rows, reconstruction, scheme, residual } = self;
        let (gnat, stored) = (matches!(scheme, Scheme::Gnat { .. }), reconstruction.rows());
        let equations = match scheme {
            Scheme::Galerkin => modes,
            Scheme::LeastSquares { .. } => 1,
            Scheme::Gnat { .. } => stored.max(modes).min(grid.unknowns()),
        };
        let Some(reconstruction) = reconstruction.into_mat(equations) else { return damaged("sampled rows") };
        let residual = residual.map(|residual| residual.into_mat(equations));
        let fits = |own: &Option<Mat<f64>>| own.as_ref().is_some_and(|own| own.ncols() == reconstruction.ncols());
        let enough = scheme == Scheme::Galerkin || reconstruction.ncols() > modes;
        if !enough || gnat != residual.is_some() || !residual.iter().all(fits) {
            return damaged("scheme");
        }
        if !are_rows(&rows, grid) || reconstruction.ncols() != rows.len() {
            return damaged("sampled rows");
        }
        Ok(SampledRows { rows, reconstruction, scheme, residual: residual.flatten() })
    }
}

impl StoredWindow {
    /// The window of a model with this domain, on its grid.
    ///
    /// # Errors
    /// When its parts do not fit each other or the domain.
    pub fn into_window(
        self,
        grid: ContactGrid,
        domain: &Domain,
        deformation: Arc<PodBasis>,
        ((scheme, residual), combined): ((Scheme, Option<StoredMatrix>), Option<Combined>),
    ) -> Result<Window, ModelFileError> {
        let nodes = grid.len();
        let damaged = |what| Err(ModelFileError::Damaged { what });
        let pressure = match combined {
            Some(combined) => self.pressure.into_singular_values().map(|values| combined.into_modes(values)),
            None => self.pressure.into_basis(nodes).map(|basis| PressureModes::own(basis, &grid)),
        };
        let Some(pressure) = pressure else { return damaged("bases") };
        let modes = pressure.count();
        if modes == 0 {
            return damaged("bases");
        }
        // What they make may have to be told by the modes there.
        if !are_rows(&self.sampled_rows, &grid) {
            return damaged("sampled rows");
        }
        let of_rows = || modes_at(&grid, &pressure, &self.sampled_rows);
        let Some(reconstruction) = self.reconstruction.of_modes(of_rows) else { return damaged("sampled rows") };
        let stored = StoredRows { rows: self.sampled_rows, reconstruction, scheme, residual };
        let rows = stored.into_rows(modes, &grid)?;
        let snapshots_fit = self.snapshots.iter().all(|s| {
            let Sliding { slide_to_roll_ratio, newtonian_plateau_ratio } = s.point.sliding;
            s.point.check().is_ok()
                && s.point.kind == grid.kind()
                && slide_to_roll_ratio.is_finite()
                && newtonian_plateau_ratio.is_none_or(|ratio| (0.0..=1.0).contains(&ratio))
                && s.coefficients.len() == modes
                && s.coefficients.iter().chain([&s.h_0, &s.h_c]).all(|v| v.is_finite())
        });
        if !(self.penalty.is_finite() && self.penalty > 0.0) {
            return damaged("penalty");
        }
        if self.snapshots.is_empty() || !snapshots_fit {
            return damaged("snapshots");
        }
        let (slides, heat) = (domain.slides(), domain.heats());
        let of_kind = |known: &Calibration| known.is_of(&FeatureSet::of(domain));
        if heat && scheme != Scheme::Galerkin {
            return damaged("heat");
        }
        if !self.traction.as_ref().is_none_or(|rule| slides && rule.sound(&grid)) {
            return damaged("traction");
        }
        if !self.calibration.as_ref().is_none_or(|known| known.sound() && of_kind(known)) {
            return damaged("calibration");
        }
        let mut window = Window::new(self.m, grid, pressure, deformation, self.snapshots, self.sampling, rows);
        (window.penalty, window.traction, window.calibration) = (self.penalty, self.traction, self.calibration);
        Ok(window)
    }
}

/// What all modes are at the nodes of sampled rows.
fn modes_at(grid: &ContactGrid, pressure: &PressureModes, rows: &[usize]) -> Mat<f64> {
    let nodes: Vec<usize> = rows.iter().map(|&row| grid.node(row)).collect();
    pressure.at(&nodes, pressure.count())
}
