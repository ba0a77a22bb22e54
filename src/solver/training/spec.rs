//! What a training is asked for: contacts, solutions, windows, bases and rows.

use crate::solver::discrete::grid::GridSpec;
use crate::solver::discrete::reynolds::PENALTY;
use crate::solver::parameters::{ParameterSpace, Quantity};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Heat, Lubricant};
use crate::solver::reduced::{Domain, ReducedModel, Sampling, Scheme, Window};
use fastrand::Rng;
use serde::{Deserialize, Serialize};

/// Measured points of a window unless a specification says otherwise.
pub const EVIDENCE: usize = 1000;

/// By what a training judges an approximation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Default)]
pub enum Indicator {
    /// e_f^I of (3.15), the dissertation's: no large-scale work at all.
    #[default]
    Residual,
    /// e_f^I of (3.15) as the dissertation has it: in the Euclidean norm, of its own online scheme (δ̃ in the state,
    /// the nearest snapshot as the only start). Its tolerances 100 … 0.1 mean this.
    Dissertation,
    /// By how much three Newton steps of the full system, taken from the reduced solution, change it: the largest of
    /// |ΔH_c/H_c|, ½|ΔH_min/H_min| and e_z of (3.10). A tolerance on it is one on what people read off, and the state
    /// keeps the spike in place.
    Correction,
}

/// Where the training solutions are taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Plan {
    /// Farthest point by (3.16) with the distance (3.20).
    FarthestPoint {
        /// Number of full solutions (per window).
        snapshots: usize,
    },
    /// A tensor grid over the box, Table 3.2: nodes of R, u_m, w (logarithmic), α.
    Grid {
        /// Nodes along radius, speed, load and alpha.
        nodes: [usize; 4],
    },
    /// The automatic algorithm of section 3.1.3, Fig. 3.2 (numbers of full solutions are per window).
    Adaptive {
        /// Pre-computed solutions by (3.16).
        start: usize,
        /// What an approximation is judged by.
        #[serde(default)]
        indicator: Indicator,
        /// Ladder of tolerances on the indicator, descending.
        tolerances: Vec<f64>,
        /// Good approximations in a row, global search (3.17), that end a rung of the ladder.
        successes: usize,
        /// σ of the local search (3.18), in widths of the range.
        local_sigma: f64,
        /// Good approximations in a row that end a local search; 0 leaves it out.
        local_successes: usize,
        /// Candidates in the close vicinity (σ/2) of a bad point of which the worst is solved in full; 0 takes the
        /// point itself.
        vicinity: usize,
        /// Full solutions at most.
        limit: usize,
    },
    /// Greedy: the worst of a pool that is drawn afresh by (3.17) in every round (numbers are per window).
    WorstOfPool {
        /// Pre-computed solutions by (3.16).
        start: usize,
        /// What an approximation is judged by.
        #[serde(default)]
        indicator: Indicator,
        /// Random points judged per round.
        pool: usize,
        /// The worst that are solved in full per round.
        per_round: usize,
        /// The training ends with a pool that has no worse point.
        tolerance: f64,
        /// Full solutions at most.
        limit: usize,
    },
}

impl Plan {
    /// Whether it searches for bad approximations.
    pub fn searches(&self) -> bool {
        matches!(self, Self::Adaptive { .. } | Self::WorstOfPool { .. })
    }

    /// Full solutions per window by (3.16) before any search; none of a grid.
    pub(super) fn first_solutions(&self) -> Option<usize> {
        match *self {
            Self::FarthestPoint { snapshots: first }
            | Self::Adaptive { start: first, .. }
            | Self::WorstOfPool { start: first, .. } => Some(first),
            Self::Grid { .. } => None,
        }
    }
}

/// One in that many full solutions of a line contact, and of a point contact, has the training's own constants and is a
/// starting value online: a solution of a point contact takes seconds.
const OWN: [u64; 2] = [4, 2];

/// Everything that determines a reduced model: the same specification gives the same model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrainingSpec {
    /// Title the model carries.
    pub title: String,
    /// What it is for.
    pub range: ParameterSpace,
    /// Laws of the lubricant.
    #[serde(default)]
    pub lubricant: Lubricant,
    /// Where the solutions are taken.
    pub plan: Plan,
    /// Windows of M with the grid of each.
    pub windows: Windows,
    /// Loss of information that pressure modes may neglect, (2.92).
    pub pressure_loss: f64,
    /// Loss of information that deformation modes may neglect, (2.93).
    pub deformation_loss: f64,
    /// How rows are sampled.
    #[serde(default)]
    pub sampling: Sampling,
    /// By what the online step is found: rows tested by V, or residual minimisation.
    #[serde(default)]
    pub scheme: Scheme,
    /// Sampled rows per pressure mode.
    pub rows_per_mode: f64,
    /// Penalty factor γ̄ of (2.36) in the reduced equations; the full solutions keep their own.
    #[serde(default = "penalty")]
    pub penalty: f64,
    /// Whether modes are made of max(P, 0). What a penalty leaves of negative pressures goes with 1/γ̄: the full
    /// solutions' own contradict a softer one, and the film takes the difference.
    #[serde(default)]
    pub positive_modes: bool,
    /// Random points per window at which its errors are measured for the calibrated bound; 0 leaves the bound out.
    #[serde(default = "evidence")]
    pub evidence: usize,
    /// Seed of everything random.
    pub seed: u64,
}

fn penalty() -> f64 {
    PENALTY
}

fn evidence() -> usize {
    EVIDENCE
}

impl TrainingSpec {
    /// A training of Newtonian contacts on one grid, with everything else as a scene has it that leaves it out, losses
    /// of information of 1e-6 and two rows per mode.
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

    /// The same of films that rupture so.
    pub fn under(self, cavitation: Cavitation) -> Self {
        Self { lubricant: Lubricant { cavitation, ..self.lubricant }, ..self }
    }

    /// The same of films that warm themselves.
    pub fn heated(self, heat: Option<Heat>) -> Self {
        Self { lubricant: Lubricant { heat, ..self.lubricant }, ..self }
    }

    /// Whether a model is of the contacts that it is about.
    pub fn is_of(&self, model: &ReducedModel) -> bool {
        model.contact() == self.contact()
            && model.of_ellipses() == self.range.of_ellipses()
            && model.domain.heats() == self.heats()
    }

    /// The kind of contact it is about: that of its grids; windows chosen by the training are of line contacts.
    pub fn contact(&self) -> ContactKind {
        match &self.windows {
            Windows::Given(windows) => windows.first().map_or_else(ContactKind::default, |window| window.grid.kind()),
            Windows::Automatic { .. } => ContactKind::Line,
            Windows::Anchored { grid, .. } => grid.kind(),
        }
    }

    /// Whether its model tells what the grid costs: over the range of many oils that differs much.
    pub fn tells_grid_costs(&self) -> bool {
        self.range.varies_lubricant() && !self.heats()
    }

    /// Whether reduced solutions have temperatures along the lines of a plane, of which all rows take as long as a hundred
    /// others.
    pub(super) fn warms_a_plane(&self) -> bool {
        self.heats() && self.contact() == ContactKind::Point
    }

    /// Whether reduced solutions have temperatures along a line.
    pub(super) fn warms_a_line(&self) -> bool {
        self.heats() && self.contact() == ContactKind::Line
    }

    /// True for films with heat.
    pub fn heats(&self) -> bool {
        self.lubricant.heat.is_some()
    }

    /// Returns the domain that the model will declare. Where the viscosity law determines α, that α counts, and L goes with
    /// it.
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

    /// Returns the lubricant for the full solution of a contact. Of a space with varying constants most contacts of a
    /// farthest-point plan, by the last digits of their loads, have random ones: the basis is made of all, starting values
    /// are those of the training's own lubricant.
    pub fn lubricant_of(&self, point: &OperatingPoint) -> Lubricant {
        let digits = point.load.to_bits();
        let planned = matches!(self.plan, Plan::FarthestPoint { .. });
        let own = digits.is_multiple_of(OWN[self.contact() as usize]) || !planned;
        if own {
            return self.lubricant;
        }
        self.range.with_random_heat(self.lubricant, &mut Rng::with_seed(self.seed ^ digits))
    }

    /// Returns the lubricant of a reduced solution that traction is fitted to, or errors are measured at: with random
    /// constants of the space.
    pub(super) fn random_lubricant(&self, rng: &mut Rng) -> Lubricant {
        self.range.with_random_constants(self.lubricant, rng)
    }

    /// Returns R_y/R of a window.
    pub(super) fn shapes_of(&self, window: &WindowSpec) -> (f64, f64) {
        window.radius_ratio.unwrap_or(self.range.radius_ratio())
    }

    /// Returns a model of one window only.
    pub(super) fn model_of(&self, window: &Window) -> ReducedModel {
        let (windows, domain) = (vec![window.clone()], self.domain());
        ReducedModel { title: String::new(), domain, windows, scene: String::new(), log: Vec::new() }
    }
}

/// Where the windows of a model come from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Windows {
    /// As listed, by ascending M.
    Given(Vec<WindowSpec>),
    /// Of a line contact, chosen by the training from its range: inlet and registration of the grid by trial, edges by
    /// splitting.
    Automatic {
        /// Pressure modes beyond which a window is split: what a reduced solve costs grows with their cube.
        modes: usize,
    },
    /// Cells around anchors in (ln M, ln L) on one grid, chosen by the training among its solutions. Numbers of full
    /// solutions of the plan are per window, as everywhere.
    Anchored {
        /// How many.
        count: usize,
        /// Pressure modes at most, of each.
        modes: usize,
        /// The grid of all.
        grid: GridSpec,
        /// Modes of a basis that the pressure modes of all are combinations of, which keeps files of point contacts
        /// small; 0 where each window has modes of its own.
        #[serde(default)]
        shared: usize,
        /// What the modes of a window may miss of its pressures, root mean square over its solutions, over their films as
        /// far as these are thin: it has no more modes than this asks for, and all where it is 0.
        #[serde(default)]
        missing: f64,
        /// The same of any one of its solutions: it has no more modes than the stricter of the two asks for.
        #[serde(default)]
        missing_of_any: f64,
        /// Pressure modes by what these miss the range is divided; 0 takes `modes`. Cells that hold hardly more solutions
        /// than that are divided no further.
        #[serde(default)]
        divided_by: usize,
    },
}

/// One window of a model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WindowSpec {
    /// Range of M it serves (training reaches beyond by an overlap).
    pub m: (f64, f64),
    /// Its grid.
    pub grid: GridSpec,
    /// Range of R_y/R it serves, of a model of ellipses; all of the model's where it is left out.
    #[serde(default)]
    pub radius_ratio: Option<(f64, f64)>,
    /// M and L of its anchor, where the training chose windows around anchors.
    #[serde(default)]
    pub anchor: Option<(f64, f64)>,
}

impl WindowSpec {
    /// A window of circles or lines.
    pub fn new(m: (f64, f64), grid: GridSpec) -> Self {
        Self { m, grid, radius_ratio: None, anchor: None }
    }

    /// True if it serves the same shapes as another window.
    pub(super) fn has_shapes_of(&self, other: &Self) -> bool {
        self.radius_ratio == other.radius_ratio
    }
}
