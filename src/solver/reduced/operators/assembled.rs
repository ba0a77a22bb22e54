//! The reduced operators of one window for a chosen truncation. Nothing in them is of large scale.

use super::case::{Case, Start, State};
use super::deformation::Deformation;
use super::equations::Equations;
use super::part::{Centre, Flow, Part, Setting};
use super::parts::{needed, parts_of};
use super::readings::Readings;
use super::sampled_system::SampledSystem;
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::full::Problem;
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::model::Window;
use faer::MatRef;

/// What Newton's iteration needs of a window, and its work space.
pub(crate) struct Operators {
    pub(super) system: SampledSystem,
    pub(super) deformation: Deformation,
    pub(super) equations: Equations,
    pub(super) parts: Vec<Box<dyn Part>>,
    /// The scale at which the lift of whole modes is known, and that lift.
    lifted_at: f64,
    whole_lift: Vec<f64>,
    readings: Readings,
}

impl Operators {
    /// Operators with the first `modes` pressure modes and, if given, the first `deformation_modes` deformation modes.
    pub fn new(window: &Window, modes: usize, deformation_modes: Option<usize>, flow: Flow<'_>) -> Self {
        let modes = modes.clamp(1, window.pressure.count());
        let axes = match (flow, window.grid.kind()) {
            (Flow::Newtonian | Flow::Transient(_), _) => 0,
            (Flow::Thinning | Flow::Thermal, ContactKind::Line) => 1,
            (Flow::Thinning | Flow::Thermal, ContactKind::Point) => 2,
        };
        let deformation = Deformation::of(window, modes, deformation_modes);
        let mut needed = needed(window, flow);
        if let Flow::Transient(further) = flow {
            needed.always.extend_from_slice(further);
        }
        let mut system = SampledSystem::new(window, (modes, axes), &deformation, needed);
        system.transient = matches!(flow, Flow::Transient(_));
        let parts = parts_of(Setting { window, flow, deformation: &deformation }, &mut system);
        let equations = Equations::of(window, modes);
        let (whole_lift, readings) = (vec![0.0; modes], Readings::with_room(system.stencils.len()));
        Self { system, deformation, equations, parts, lifted_at: f64::NAN, whole_lift, readings }
    }

    /// Number of pressure modes.
    pub fn modes(&self) -> usize {
        self.system.modes
    }

    /// The place of a node in the support.
    pub fn place(&self, node: usize) -> usize {
        self.system.support.place(node)
    }

    /// Gives row `r` of the sampled ones, and behind them of those that the cavitation boundary may pass, other
    /// coefficients and other nodes: places in the support.
    pub fn set_row(&mut self, r: usize, stencil: [usize; STENCIL], geometry: RowGeometry) {
        (self.system.stencils[r], self.system.geometry[r]) = (stencil, geometry);
    }

    /// ρ̄H at the own nodes of the rows of [`Self::set_row`], of the state evaluated last.
    pub fn flow(&self) -> impl Iterator<Item = f64> + '_ {
        self.system.flow()
    }

    /// K V_p or V_δ V_δᵀ W K V_p over the whole node array of the window these operators are of.
    pub fn deformation<'a>(&'a self, window: &'a Window) -> MatRef<'a, f64> {
        self.deformation.whole(window, self.system.modes)
    }

    /// Prepares all parts for a contact and for where its iteration begins.
    pub fn begin(&mut self, case: &Case<'_>, start: &Start<'_>) {
        let Self { system, parts, .. } = self;
        system.active = start.modes.clamp(1, system.modes);
        system.stop = case.stop;
        parts.iter_mut().for_each(|part| part.begin(system, case, start));
    }

    /// Finds what the film at X = 0 (and Y = 0) gains per unit of each coefficient, after [`Self::begin`].
    pub fn aim(&mut self, window: &Window, scale: f64) {
        let Self { system, parts, deformation, lifted_at, whole_lift, .. } = self;
        let nodes = &window.grid.at_zero(scale);
        if *lifted_at != scale {
            *lifted_at = scale;
            let deformation = deformation.at(window, &nodes.map(|(node, _)| node), system.modes);
            let sum = |k: usize| nodes.iter().enumerate().map(|(i, (_, w))| w * deformation[(i, k)]).sum::<f64>();
            whole_lift.iter_mut().enumerate().for_each(|(k, lift)| *lift = scale * sum(k));
        }
        system.lift.copy_from_slice(whole_lift);
        parts.iter_mut().for_each(|part| part.aim(system, Centre { window, nodes, scale }));
    }

    /// The film at X = 0 (and Y = 0) over what H₀ gives it, since [`Self::aim`].
    pub fn lifted(&self, coefficients: &[f64]) -> f64 {
        dot(&self.system.lift, coefficients)
    }

    /// Scales coefficients so that they carry the load on a grid of scale s.
    pub fn carry_load(&self, problem: &Problem, scale: f64, coefficients: &mut [f64]) {
        let carried: f64 = self.system.load_row.iter().zip(coefficients.iter()).map(|(l, c)| l * c).sum();
        let factor = problem.load / (scale * carried);
        if factor.is_finite() && factor > 0.0 {
            coefficients.iter_mut().for_each(|c| *c *= factor);
        }
    }

    /// What all parts report of a state, the one that the last iteration ended with.
    pub fn read(&mut self, case: &Case<'_>, coefficients: &[f64], h_0: f64) -> &mut Readings {
        let Self { system, parts, readings, .. } = self;
        readings.fronts.clear();
        readings.cut.clear();
        (readings.traction, readings.warmth) = (None, None);
        parts.iter_mut().for_each(|part| part.read(system, case, State { coefficients, h_0 }, readings));
        readings
    }
}
