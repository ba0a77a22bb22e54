//! Data of a reduced model.

use super::calibration::{Calibration, Features};
use super::combined::PressureModes;
use super::domain::{Domain, Trust};
use super::error_estimate::ErrorEstimate;
use super::minimisation::Scheme;
use super::pod::PodBasis;
use super::sampling::{SampledRows, Sampling};
use super::shapes::Shapes;
use super::traction::TractionRule;
use crate::solver::discrete::grid::{ContactGrid, FIRST_UNKNOWN};
use crate::solver::discrete::reynolds::PENALTY;
use crate::solver::full::{GridCost, Problem};
use crate::solver::parameters::{Metric, Quantity, apart, separation};
use crate::solver::physics::contact::{ContactKind, Moes, OperatingPoint};
use crate::solver::physics::lubricant::Cavitation;
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Training solution stored with the model.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Operating point.
    pub point: OperatingPoint,
    /// Coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// Rigid-body separation H₀.
    pub h_0: f64,
    /// Central film thickness H_c of the full solution.
    pub h_c: f64,
    /// With complementarity, the first cavitated column of each line along X, in node arrays; empty with a penalty.
    pub fronts: Vec<usize>,
    /// Discretisation error of H_c, if estimated in the training.
    pub grid_cost: Option<GridCost>,
}

/// Local model for an interval of M or around an anchor, with its own grid, bases and sampled equations.
#[derive(Clone, Debug)]
pub struct Window {
    /// Interval of M for which this local model is used.
    pub m: (f64, f64),
    /// Centre of the local model in (ln M, ln L), if it was built around one. `m` is then only the extent of its
    /// contacts.
    pub anchor: Option<Moes>,
    /// Distance between its solutions, if it was built around an anchor.
    pub metric: Metric,
    /// Grid of its solutions.
    pub grid: ContactGrid,
    /// Penalty factor γ̄ of (2.36) in the reduced equations. The sampled equations of a point contact need a softer
    /// one than the full system.
    pub penalty: f64,
    /// Cavitation model of its solutions. With complementarity the boundary moves, and there is no penalty.
    pub cavitation: Cavitation,
    /// Pressure basis V_p with its deformation K V_p, exact for circular contacts.
    pub pressure: PressureModes,
    /// Deformation basis (of K P in the reference coordinate ξ); local models around anchors share one.
    pub deformation: Arc<PodBasis>,
    /// K V_p of elliptical contacts, if the local model covers them.
    pub shapes: Option<Shapes>,
    /// Sampling method of the equations.
    pub sampling: Sampling,
    /// Sampled equations as indices of unknowns, ascending.
    pub sampled_rows: Vec<usize>,
    /// Scheme that determines the online step.
    pub scheme: Scheme,
    /// Reconstruction from the sampled equations. Galerkin: G with Vᵀ W f ≈ G f_I, modes × rows. Least squares: one
    /// factor each, 1 × rows. GNAT: coefficients in the Jacobian's basis, equations × rows.
    pub reconstruction: Mat<f64>,
    /// GNAT's reconstruction of the residual, of the same shape as `reconstruction`.
    pub residual_reconstruction: Option<Mat<f64>>,
    /// Training solutions.
    pub snapshots: Vec<Snapshot>,
    /// Traction quadrature on few nodes of these equations; `None` if the model does not include sliding.
    pub traction: Option<TractionRule>,
    /// Calibration of its errors, with all modes and these equations; `None` until they are measured.
    pub calibration: Option<Calibration>,
}

/// Size of a local model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModelSize {
    /// Number of pressure modes.
    pub pressure: usize,
    /// Number of deformation modes.
    pub deformation: usize,
    /// Number of sampled equations.
    pub rows: usize,
}

impl std::fmt::Display for ModelSize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { pressure, deformation, rows } = self;
        write!(f, "{pressure} pressure modes, {deformation} deformation modes, {rows} sampled equations")
    }
}

/// Reduced model of steady contacts of one kind.
#[derive(Clone, Debug)]
pub struct ReducedModel {
    /// Title for display.
    pub title: String,
    /// Trained range.
    pub domain: Domain,
    /// Local models by ascending M.
    pub windows: Vec<Window>,
    /// Training scene as text; empty for a model that was never saved.
    pub scene: String,
    /// Log of the training, one sentence per line.
    pub log: Vec<String>,
}

/// Returns the weights for the decomposition of deformations: the cell sizes, with the neighbour's at nodes that
/// carry no pressure.
pub fn deformation_weights(grid: &ContactGrid) -> Vec<f64> {
    let weights = grid.weights();
    let n = weights.len();
    match grid {
        ContactGrid::Line(_) => (0..n).map(|i| weights[i.clamp(FIRST_UNKNOWN, n - 2)]).collect(),
        ContactGrid::Point(grid) => {
            let (nx, ny) = (grid.nx(), grid.ny());
            (0..n).map(|node| weights[(node / ny).clamp(1, nx - 2) * ny + (node % ny).max(1)]).collect()
        }
    }
}

/// Largest accepted residual outside the trained range, relative to the largest one measured in the training.
const FAR_RESIDUAL: f64 = 10.0;

impl Window {
    /// Creates a local model from its bases, with the penalty of the full system.
    pub fn new(
        m: (f64, f64),
        grid: ContactGrid,
        pressure: PressureModes,
        deformation: impl Into<Arc<PodBasis>>,
        snapshots: Vec<Snapshot>,
        sampling: Sampling,
        rows: SampledRows,
    ) -> Self {
        let deformation = deformation.into();
        let SampledRows { rows: sampled_rows, reconstruction, scheme, residual } = rows;
        Self {
            m,
            anchor: None,
            metric: Metric::default(),
            grid,
            penalty: PENALTY,
            cavitation: Cavitation::Penalty,
            pressure,
            deformation,
            shapes: None,
            sampling,
            sampled_rows,
            scheme,
            reconstruction,
            residual_reconstruction: residual,
            snapshots,
            traction: None,
            calibration: None,
        }
    }

    /// Returns the reason why a solution outside the trained range is not accepted, by its residual e_f^I: it is far
    /// beyond those of the training. `None` if it is not.
    pub fn residual_doubt(&self, residual: f64) -> Option<String> {
        let largest = self.calibration.as_ref().map_or(f64::INFINITY, Calibration::largest_residual);
        let far = residual.is_nan() || residual > FAR_RESIDUAL * largest;
        far.then(|| {
            format!("its residual of {residual:.1e} is far beyond those of the training, {largest:.1e} at most")
        })
    }

    /// Estimates the error of a solution with respect to the full one with the cavitation model `asked`; `None` until
    /// errors are measured.
    pub fn likely_error(
        &self,
        features: &Features,
        point: &OperatingPoint,
        asked: Cavitation,
    ) -> Option<ErrorEstimate> {
        let estimate = self.calibration.as_ref()?.estimate(features);
        Some(estimate.against(point, asked, self.cavitation))
    }

    /// Returns the interval of R_y/R; everything if the local model has a single shape.
    pub fn served_ratios(&self) -> (f64, f64) {
        self.shapes.as_ref().map_or((0.0, f64::INFINITY), |shapes| shapes.ratios)
    }

    /// True for rough surfaces.
    pub fn is_rough(&self) -> bool {
        self.metric.counts(Quantity::SmoothFilmRatio)
    }

    /// Returns the size with all modes.
    pub fn size(&self) -> ModelSize {
        let (pressure, deformation) = (self.pressure.count(), self.deformation.modes.ncols());
        ModelSize { pressure, deformation, rows: self.sampled_rows.len() }
    }

    /// Replaces the sampled equations. This discards the calibration and the traction quadrature.
    pub fn set_rows(&mut self, sampling: Sampling, rows: SampledRows) {
        self.sampling = sampling;
        self.sampled_rows = rows.rows;
        (self.scheme, self.reconstruction, self.residual_reconstruction) =
            (rows.scheme, rows.reconstruction, rows.residual);
        (self.traction, self.calibration) = (None, None);
    }

    /// Returns the nearest training solution and its distance: by the model's metric for local models around anchors
    /// and for rough surfaces, otherwise by [`separation`].
    pub fn nearest(&self, point: &OperatingPoint) -> Option<(&Snapshot, f64)> {
        if self.anchor.is_some() || self.is_rough() {
            let own = self.metric.place(point);
            let far = |snapshot: &Snapshot| apart(own, self.metric.place(&snapshot.point));
            let all = self.snapshots.iter().map(|snapshot| (snapshot, far(snapshot)));
            return all.min_by(|a, b| a.1.total_cmp(&b.1));
        }
        self.snapshots.iter().map(|s| (s, separation(point, &s.point))).min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl ReducedModel {
    /// Returns the index of the local model for a contact: by the nearest anchor, or by its radius ratio and then by M.
    pub fn window_for(&self, point: &OperatingPoint) -> usize {
        let moes = point.moes();
        if let Some(nearest) = self.nearest_anchor(moes) {
            return nearest;
        }
        let m = moes.m;
        let aside = |window: &Window| Shapes::aside(window.shapes.as_ref(), point);
        let nearest = self.windows.iter().map(aside).fold(f64::INFINITY, f64::min);
        let beside = |w: &&Window| aside(w) <= nearest;
        let own = self.windows.iter().position(|w| beside(&w) && m <= w.m.1);
        own.or_else(|| self.windows.iter().rposition(|w| beside(&w))).unwrap_or(0)
    }

    /// Returns the local model for a contact.
    pub fn window_at(&self, point: &OperatingPoint) -> &Window {
        &self.windows[self.window_for(point)]
    }

    /// Returns true for an outline: a model without its bases, which cannot solve.
    pub fn is_outline(&self) -> bool {
        self.windows.first().is_some_and(|window| window.pressure.is_outline())
    }

    /// Returns the kind of contact.
    pub fn contact(&self) -> ContactKind {
        self.windows.first().map_or_else(ContactKind::default, |window| window.grid.kind())
    }

    /// Returns true for a model of elliptical contacts.
    pub fn of_ellipses(&self) -> bool {
        self.domain.space.of_ellipses()
    }

    /// Returns true if its rows need pressure gradients: for shear-thinning lubricants and for thermal films.
    pub(crate) fn slides(&self) -> bool {
        self.domain.slides()
    }

    /// Returns true if the model is of the point's kind of contact: line, circular or elliptical.
    pub fn is_of(&self, point: &OperatingPoint) -> bool {
        self.contact() == point.kind && self.of_ellipses() == point.is_elliptic()
    }

    /// Returns whether the model was trained for a problem.
    pub fn trust(&self, problem: &Problem) -> Trust {
        self.domain.trust(problem)
    }
}
