//! Specification of a training: contacts, solutions, local models, bases and sampled equations.

use crate::solver::discrete::grid::GridSpec;
use crate::solver::discrete::reynolds::PENALTY;
use crate::solver::parameters::{ParameterSpace, Quantity, REFERENCE_ROUGHNESS_M};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant};
use crate::solver::physics::surfaces::Roughness;
use crate::solver::reduced::{Domain, ReducedModel, Sampling, Scheme, Window};
use fastrand::Rng;
use serde::{Deserialize, Serialize};

/// Default number of points per local model at which errors are measured.
pub const EVIDENCE: usize = 1000;

/// Error indicator of a training.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Indicator {
    /// Residual e_f^I of (3.15), the dissertation's indicator, without large-scale work.
    #[default]
    Residual,
    /// e_f^I of (3.15) exactly as in the dissertation: in the Euclidean norm, with its own online scheme (δ̃ in the
    /// state, the nearest snapshot as the only initial guess). Its tolerances 100 … 0.1 refer to this indicator.
    Dissertation,
    /// Change of the reduced solution by three Newton steps of the full system: the largest of |ΔH_c/H_c|,
    /// ½|ΔH_min/H_min| (central and minimum film thickness) and the state error e_z of (3.10). A tolerance for it
    /// refers to quantities of interest, and the state includes the position of the pressure spike.
    Correction,
}

/// Selection of the training points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Plan {
    /// Farthest-point sampling (3.16) with the distance (3.20).
    FarthestPoint {
        /// Number of full solutions (per local model).
        snapshots: usize,
    },
    /// Tensor grid over the box, Table 3.2: nodes of R, u_m, w (logarithmic), α.
    Grid {
        /// Numbers of nodes for radius, speed, load and alpha.
        nodes: [usize; 4],
    },
    /// Automatic algorithm of section 3.1.3, Fig. 3.2 (numbers of full solutions are per local model).
    Adaptive {
        /// Number of initial solutions by (3.16).
        start: usize,
        /// Error indicator.
        #[serde(default)]
        indicator: Indicator,
        /// Tolerances of the indicator, descending.
        tolerances: Vec<f64>,
        /// Number of good approximations in a row of the global search (3.17) that ends a tolerance.
        successes: usize,
        /// σ of the local search (3.18), in widths of the range.
        local_sigma: f64,
        /// Number of good approximations in a row that ends a local search; 0 omits it.
        local_successes: usize,
        /// Number of candidates in the vicinity (σ/2) of a bad point, of which the worst is solved in full; 0 uses
        /// the point itself.
        vicinity: usize,
        /// Maximum number of full solutions.
        limit: usize,
    },
    /// Greedy algorithm: the worst of a pool that is drawn again by (3.17) in every round (numbers are per local
    /// model).
    WorstOfPool {
        /// Number of initial solutions by (3.16).
        start: usize,
        /// Error indicator.
        #[serde(default)]
        indicator: Indicator,
        /// Number of random points judged per round.
        pool: usize,
        /// Number of worst points that are solved in full per round.
        per_round: usize,
        /// The training ends if no point of a pool exceeds this value.
        tolerance: f64,
        /// Maximum number of full solutions.
        limit: usize,
    },
}

impl Plan {
    /// Returns true if the plan searches for bad approximations.
    pub fn searches(&self) -> bool {
        matches!(self, Self::Adaptive { .. } | Self::WorstOfPool { .. })
    }

    /// Returns the number of full solutions per local model by (3.16) before any search; `None` for a tensor grid.
    pub(super) fn first_solutions(&self) -> Option<usize> {
        match *self {
            Self::FarthestPoint { snapshots: first }
            | Self::Adaptive { start: first, .. }
            | Self::WorstOfPool { start: first, .. } => Some(first),
            Self::Grid { .. } => None,
        }
    }
}

/// One in that many full solutions, of a line contact and of a point contact, has the training's own constants and is
/// a starting value online.
const OWN: [u64; 2] = [4, 2];

/// Complete specification of a reduced model: the same specification gives the same model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingSpec {
    /// Title of the model.
    pub title: String,
    /// Parameter space.
    pub range: ParameterSpace,
    /// Laws of the lubricant.
    #[serde(default)]
    pub lubricant: Lubricant,
    /// Selection of the training points.
    pub plan: Plan,
    /// Local models with their grids.
    pub windows: Windows,
    /// Loss of information of the pressure modes, (2.92).
    pub pressure_loss: f64,
    /// Loss of information of the deformation modes, (2.93).
    pub deformation_loss: f64,
    /// Sampling method of the equations.
    #[serde(default)]
    pub sampling: Sampling,
    /// Scheme of the online step: rows tested by V, or residual minimisation.
    #[serde(default)]
    pub scheme: Scheme,
    /// Number of sampled equations per pressure mode.
    pub rows_per_mode: f64,
    /// Penalty factor γ̄ of (2.36) in the reduced equations; the full solutions keep their own.
    #[serde(default = "penalty")]
    pub penalty: f64,
    /// True to build modes from max(P, 0). Negative pressures of a penalty are proportional to 1/γ̄. Those of the full
    /// solutions contradict a softer penalty of the reduced equations and would cause an error of the film thickness.
    #[serde(default)]
    pub positive_modes: bool,
    /// Number of random points per local model at which errors are measured for the error bound; 0 omits the bound.
    #[serde(default = "evidence")]
    pub evidence: usize,
    /// Seed of all random numbers.
    pub seed: u64,
}

fn penalty() -> f64 {
    PENALTY
}

fn evidence() -> usize {
    EVIDENCE
}

impl TrainingSpec {
    /// Creates a training of Newtonian contacts on one grid, with losses of information of 1e-6, two rows per mode,
    /// and the defaults of a scene.
    pub fn new(range: ParameterSpace, m: (f64, f64), grid: GridSpec, plan: Plan) -> Self {
        Self {
            title: String::new(),
            range,
            lubricant: Lubricant::default(),
            plan,
            windows: Windows::Given(vec![WindowSpec::new(m, grid)]),
            pressure_loss: 1e-6,
            deformation_loss: 1e-6,
            sampling: Sampling::default(),
            scheme: Scheme::default(),
            rows_per_mode: 2.0,
            penalty: PENALTY,
            positive_modes: false,
            evidence: EVIDENCE,
            seed: 1,
        }
    }

    /// Returns the same training with another cavitation model.
    pub fn under(self, cavitation: Cavitation) -> Self {
        Self { lubricant: Lubricant { cavitation, ..self.lubricant }, ..self }
    }

    /// Returns the same training with other thermal laws; `None` for isothermal contacts.
    pub fn heated(self, heat: Option<Heat>) -> Self {
        Self { lubricant: Lubricant { heat, ..self.lubricant }, ..self }
    }

    /// Returns the same training with the laws of rough surfaces, if its range varies the film ratio: then its contacts
    /// have the reference roughness, and no shear flow. Otherwise they are smooth.
    pub fn on_surfaces(self, roughness: Option<Roughness>) -> Self {
        let sigma = REFERENCE_ROUGHNESS_M;
        let laws = Roughness { sigma, shear_flow: 0.0, ..roughness.unwrap_or(Roughness::new(sigma)) };
        let rough = self.range.is_rough().then_some(laws);
        Self { lubricant: self.lubricant.on_rough_surfaces(rough), ..self }
    }

    /// Returns true if a model is of the same kind of contacts.
    pub fn is_of(&self, model: &ReducedModel) -> bool {
        model.contact() == self.contact()
            && model.of_ellipses() == self.range.of_ellipses()
            && model.domain.heats() == self.heats()
            && model.domain.is_rough() == self.range.is_rough()
    }

    /// Returns the kind of contact: that of the grids; automatic local models are of line contacts.
    pub fn contact(&self) -> ContactKind {
        match &self.windows {
            Windows::Given(windows) => windows.first().map_or_else(ContactKind::default, |window| window.grid.kind()),
            Windows::Automatic { .. } => ContactKind::Line,
            Windows::Anchored { grid, .. } => grid.kind(),
        }
    }

    /// Returns true if the model stores the discretisation error, which varies strongly over lubricant ranges.
    pub fn tells_grid_costs(&self) -> bool {
        self.range.varies_lubricant() && !self.heats()
    }

    /// Returns true if reduced solutions have temperatures along the lines of a plane, for which a solve with all
    /// rows is a hundred times as expensive.
    pub(super) fn warms_a_plane(&self) -> bool {
        self.heats() && self.contact().is_point()
    }

    /// Returns true if reduced solutions have temperatures along a line.
    pub(super) fn warms_a_line(&self) -> bool {
        self.heats() && self.contact().is_line()
    }

    /// Returns true for thermal contacts.
    pub fn heats(&self) -> bool {
        self.lubricant.heat.is_some()
    }

    /// Returns the domain that the model will declare. If the viscosity law determines α, the domain contains this α
    /// and the corresponding L.
    pub fn domain(&self) -> Domain {
        let contact = self.contact();
        let mut space = self.range.clone();
        let fixed = space.fixed.iter_mut().find(|(quantity, _)| *quantity == Quantity::Alpha);
        if let Some((own, (_, alpha))) = self.lubricant.own_coefficient().zip(fixed) {
            let ratio = own / *alpha;
            *alpha = own;
            if let Some(axis) = space.axis_mut(Quantity::L) {
                axis.ends = (axis.ends.0 * ratio, axis.ends.1 * ratio);
            }
        }
        Domain { contact, space: space.with_followers(contact), lubricant: self.lubricant }
    }

    /// Returns the lubricant for the full solution of a contact. In a space with varying constants, most contacts of
    /// a farthest-point plan have random ones, selected by the last digits of their loads. The basis includes all
    /// solutions; starting values are only those of the training's own lubricant.
    pub fn lubricant_of(&self, point: &OperatingPoint) -> Lubricant {
        let digits = point.load.to_bits();
        let planned = matches!(self.plan, Plan::FarthestPoint { .. });
        let own = digits.is_multiple_of(OWN[self.contact() as usize]) || !planned;
        if own {
            return self.lubricant;
        }
        self.range.with_random_heat(self.lubricant, &mut Rng::with_seed(self.seed ^ digits))
    }

    /// Returns a lubricant with random constants of the space, for the traction quadrature and the measurement of
    /// errors.
    pub(super) fn random_lubricant(&self, rng: &mut Rng) -> Lubricant {
        self.range.with_random_constants(self.lubricant, rng)
    }

    /// Returns the interval of R_y/R of a local model.
    pub(super) fn shapes_of(&self, window: &WindowSpec) -> (f64, f64) {
        window.radius_ratio.unwrap_or(self.range.radius_ratio())
    }

    /// Returns a model with one local model only.
    pub(super) fn model_of(&self, window: &Window) -> ReducedModel {
        let (windows, domain) = (vec![window.clone()], self.domain());
        ReducedModel { title: String::new(), domain, windows, scene: String::new(), log: Vec::new() }
    }
}

/// Definition of the local models of a model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Windows {
    /// The listed ones, by ascending M.
    Given(Vec<WindowSpec>),
    /// Line contacts only: selected by the training from its range. Inlet and registration of the grid by trial,
    /// edges by splitting.
    Automatic {
        /// Number of pressure modes above which a local model is split: the cost of a reduced solve grows with their
        /// cube.
        modes: usize,
    },
    /// Cells around anchors in (ln M, ln L), with the Moes parameters M and L, on one grid, selected by the training
    /// from its solutions. Numbers of full solutions of the plan are per local model.
    Anchored {
        /// Number of local models.
        count: usize,
        /// Maximum number of pressure modes of each.
        modes: usize,
        /// Common grid.
        grid: GridSpec,
        /// Number of modes of a shared basis of which all pressure modes are combinations, to keep files of point
        /// contacts small; 0 for separate modes.
        #[serde(default)]
        shared: usize,
        /// Permitted root mean square error of the modes over the solutions of a local model, relative to the film
        /// thickness where that is small. It limits the number of modes; 0 permits all.
        #[serde(default)]
        missing: f64,
        /// The same for each single solution. The larger number of modes of the two limits is used.
        #[serde(default)]
        missing_of_any: f64,
        /// Number of pressure modes for whose error the range is divided; 0 uses `modes`. Cells with hardly more
        /// solutions than that are not divided further.
        #[serde(default)]
        divided_by: usize,
    },
}

/// Specification of one local model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WindowSpec {
    /// Interval of M (training points extend beyond it by an overlap).
    pub m: (f64, f64),
    /// Grid.
    pub grid: GridSpec,
    /// Interval of R_y/R, for a model of elliptical contacts; `None` for the whole interval of the model.
    #[serde(default)]
    pub radius_ratio: Option<(f64, f64)>,
    /// M and L of its anchor, if the training selects anchors.
    #[serde(default)]
    pub anchor: Option<(f64, f64)>,
    /// Truncation of its pressure modes; `None` for that of the training. Thick films allow a larger one.
    #[serde(default)]
    pub pressure_loss: Option<f64>,
}

impl WindowSpec {
    /// Creates a local model of line or circular contacts.
    pub fn new(m: (f64, f64), grid: GridSpec) -> Self {
        Self { m, grid, radius_ratio: None, anchor: None, pressure_loss: None }
    }

    /// Returns the interval of R_y/R to which the local model is restricted; all numbers above 0 without one.
    pub(super) fn served_ratios(&self) -> (f64, f64) {
        self.radius_ratio.unwrap_or((0.0, f64::INFINITY))
    }

    /// Returns true if another local model has the same radius ratios.
    pub(super) fn has_shapes_of(&self, other: &Self) -> bool {
        self.radius_ratio == other.radius_ratio
    }
}
