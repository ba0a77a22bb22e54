//! What a reduced model is made of.

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
use crate::solver::parameters::{Metric, apart, separation};
use crate::solver::physics::contact::{ContactKind, Moes, OperatingPoint};
use crate::solver::physics::lubricant::Cavitation;
use faer::Mat;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A training solution as the model keeps it.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// The operating point.
    pub point: OperatingPoint,
    /// Its coefficients in the pressure basis.
    pub coefficients: Vec<f64>,
    /// Its H₀.
    pub h_0: f64,
    /// Its central film H_c, from the full solution.
    pub h_c: f64,
    /// Under complementarity the first ruptured column of each line along X, in node arrays; empty under a penalty.
    pub fronts: Vec<usize>,
    /// What the grid costs H_c, where the training asked.
    pub grid_cost: Option<GridCost>,
}

/// One local model: a window of M with its own grid, bases and sampled rows.
#[derive(Clone, Debug)]
pub struct Window {
    /// Range of M for which this window is used.
    pub m: (f64, f64),
    /// Of a window that serves the contacts around a place in (ln M, ln L) that place; M then says no more than how far
    /// these reach.
    pub anchor: Option<Moes>,
    /// Distance between its solutions, if it was built around an anchor.
    pub metric: Metric,
    /// The grid of its solutions.
    pub grid: ContactGrid,
    /// Penalty factor γ̄ of (2.36) in the reduced equations. Sampled rows of a point contact want it softer than the
    /// full system.
    pub penalty: f64,
    /// How its films rupture: of complementarity it has the solutions, the boundary that moves, and no penalty.
    pub cavitation: Cavitation,
    /// Pressure basis, with K V_p: the exact deformation operator, of a circle.
    pub pressure: PressureModes,
    /// Deformation basis (of K P in the reference coordinate ξ); windows around anchors share one.
    pub deformation: Arc<PodBasis>,
    /// K V_p of ellipses, where the window knows them.
    pub shapes: Option<Shapes>,
    /// How rows were sampled.
    pub sampling: Sampling,
    /// Sampled rows as indices of unknowns, ascending.
    pub sampled_rows: Vec<usize>,
    /// By what the online step is found.
    pub scheme: Scheme,
    /// What is made of the sampled rows' values: of Galerkin's scheme G with Vᵀ W f ≈ G f_I, modes × rows; of least
    /// squares a factor each, 1 × rows; of GNAT what the Jacobian's basis says of them, equations × rows.
    pub reconstruction: Mat<f64>,
    /// What GNAT makes of the residual's values, of the size of the former.
    pub residual_reconstruction: Option<Mat<f64>>,
    /// Training solutions.
    pub snapshots: Vec<Snapshot>,
    /// Traction from few of the nodes that these rows depend on; none where the model does not know sliding.
    pub traction: Option<TractionRule>,
    /// What it knows about its own errors, with all modes and these rows; none until it was measured.
    pub calibration: Option<Calibration>,
}

/// How large the model of a window is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ModelSize {
    /// Pressure modes.
    pub pressure: usize,
    /// Deformation modes.
    pub deformation: usize,
    /// Sampled rows.
    pub rows: usize,
}

impl std::fmt::Display for ModelSize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { pressure, deformation, rows } = self;
        write!(f, "{pressure} pressure modes, {deformation} deformation modes, {rows} sampled rows")
    }
}

/// A reduced model of stationary contacts of one kind.
#[derive(Clone, Debug)]
pub struct ReducedModel {
    /// Title for people.
    pub title: String,
    /// What it was trained for.
    pub domain: Domain,
    /// Local models by ascending M.
    pub windows: Vec<Window>,
    /// The scene it was trained by, as text; empty for a model that was never saved.
    pub scene: String,
    /// What the training did, one sentence per line.
    pub log: Vec<String>,
}

/// Weights under which deformations are decomposed: the cell sizes, with the neighbour's at the nodes that carry no
/// pressure.
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

/// How many times the largest residual that was measured in training an answer may have where the model was not
/// trained.
const FAR_RESIDUAL: f64 = 10.0;

impl Window {
    /// Assembles a window from its bases, with the penalty of the full system.
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

    /// Why an iteration outside the model's range has found no solution, by its residual e_f^I: it is far beyond those
    /// of the training.
    pub fn residual_doubt(&self, residual: f64) -> Option<String> {
        let largest = self.calibration.as_ref().map_or(f64::INFINITY, Calibration::largest_residual);
        let far = residual.is_nan() || residual > FAR_RESIDUAL * largest;
        far.then(|| {
            format!("its residual of {residual:.1e} is far beyond those of the training, {largest:.1e} at most")
        })
    }

    /// How far a solution of its own at a point is likely to be off from the full one that ruptures by a law; `None` until
    /// errors were measured.
    pub fn likely_error(
        &self,
        features: &Features,
        point: &OperatingPoint,
        asked: Cavitation,
    ) -> Option<ErrorEstimate> {
        let estimate = self.calibration.as_ref()?.estimate(features);
        Some(estimate.against(point, asked, self.cavitation))
    }

    /// R_y/R that it serves: all of a window that knows one shape.
    pub fn served_ratios(&self) -> (f64, f64) {
        self.shapes.as_ref().map_or((0.0, f64::INFINITY), |shapes| shapes.ratios)
    }

    /// How large it is with all its modes.
    pub fn size(&self) -> ModelSize {
        let (pressure, deformation) = (self.pressure.count(), self.deformation.modes.ncols());
        ModelSize { pressure, deformation, rows: self.sampled_rows.len() }
    }

    /// Replaces the sampled rows, which ends a calibration and the rule for the traction on their nodes.
    pub fn set_rows(&mut self, sampling: Sampling, rows: SampledRows) {
        self.sampling = sampling;
        self.sampled_rows = rows.rows;
        (self.scheme, self.reconstruction, self.residual_reconstruction) =
            (rows.scheme, rows.reconstruction, rows.residual);
        (self.traction, self.calibration) = (None, None);
    }

    /// The nearest training solution by [`separation`], or by what tells oils apart where it knows many.
    pub fn nearest(&self, point: &OperatingPoint) -> Option<(&Snapshot, f64)> {
        if self.anchor.is_some() {
            let own = self.metric.place(point);
            let far = |snapshot: &Snapshot| apart(own, self.metric.place(&snapshot.point));
            let all = self.snapshots.iter().map(|snapshot| (snapshot, far(snapshot)));
            return all.min_by(|a, b| a.1.total_cmp(&b.1));
        }
        self.snapshots.iter().map(|s| (s, separation(point, &s.point))).min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl ReducedModel {
    /// Index of the window that serves a contact: by the nearest anchor, or by its shape, then by M.
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

    /// The window that serves a contact.
    pub fn window_at(&self, point: &OperatingPoint) -> &Window {
        &self.windows[self.window_for(point)]
    }

    /// The kind of contact it is a model of.
    pub fn contact(&self) -> ContactKind {
        self.windows.first().map_or_else(ContactKind::default, |window| window.grid.kind())
    }

    /// Whether it is a model of ellipses.
    pub fn of_ellipses(&self) -> bool {
        self.domain.space.of_ellipses()
    }

    /// Whether its rows want gradients of the pressure: of a lubricant that thins under shear, and of films with heat.
    pub(crate) fn slides(&self) -> bool {
        self.domain.slides()
    }

    /// Whether it is a model of this kind of contact: of lines, of circles, or of ellipses.
    pub fn is_of(&self, point: &OperatingPoint) -> bool {
        self.contact() == point.kind && self.of_ellipses() == point.is_elliptic()
    }

    /// Whether the model was trained for a problem.
    pub fn trust(&self, problem: &Problem) -> Trust {
        self.domain.trust(problem)
    }
}
