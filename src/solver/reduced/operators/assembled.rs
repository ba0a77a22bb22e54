//! Reduced operators of one local model for chosen numbers of modes. Nothing in them is of large scale.

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
use crate::solver::physics::surfaces::AsperityTable;
use crate::solver::reduced::model::Window;
use faer::MatRef;

/// Data and work space of Newton's iteration for one local model.
pub(crate) struct Operators {
    pub(super) system: SampledSystem,
    pub(super) deformation: Deformation,
    pub(super) equations: Equations,
    pub(super) parts: Vec<Box<dyn Part>>,
    /// Scale for which the lift of whole modes is computed, and that lift.
    lifted_at: f64,
    whole_lift: Vec<f64>,
    readings: Readings,
}

impl Operators {
    /// Builds the operators with the first `modes` pressure modes and, if given, the first `deformation_modes`
    /// deformation modes.
    pub fn new(window: &Window, modes: usize, deformation_modes: Option<usize>, flow: Flow<'_>) -> Self {
        let modes = modes.clamp(1, window.pressure.count());
        let axes = match (flow, window.grid.kind()) {
            (Flow::Newtonian | Flow::Rough | Flow::Transient(_), _) => 0,
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

    /// Returns the place of a node in the support.
    pub fn place(&self, node: usize) -> usize {
        self.system.support.place(node)
    }

    /// Sets the stencil (places in the support) and the coefficients of row `r`. The sampled equations come first,
    /// followed by the rows that the cavitation boundary may pass.
    pub fn set_row(&mut self, r: usize, stencil: [usize; STENCIL], geometry: RowGeometry) {
        (self.system.stencils[r], self.system.geometry[r]) = (stencil, geometry);
    }

    /// Returns ρ̄H at the own nodes of all rows of [`Self::set_row`], for the last evaluated state.
    pub fn flow(&self) -> impl Iterator<Item = f64> + '_ {
        self.system.flow()
    }

    /// Returns K V_p or V_δ V_δᵀ W K V_p over the whole node array of the local model.
    pub fn deformation<'a>(&'a self, window: &'a Window) -> MatRef<'a, f64> {
        self.deformation.whole(window, self.system.modes)
    }

    /// Prepares all parts for a contact and its initial guess.
    pub fn begin(&mut self, case: &Case<'_>, start: &Start<'_>) {
        let Self { system, parts, .. } = self;
        system.active = start.modes.clamp(1, system.modes);
        system.stop = case.stop;
        parts.iter_mut().for_each(|part| part.begin(system, case, start));
    }

    /// Computes the contribution of each coefficient to the film thickness at X = 0 (and Y = 0), after [`Self::begin`].
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

    /// Returns the film thickness at X = 0 (and Y = 0) without the rigid-body separation H₀, after [`Self::aim`].
    pub fn lifted(&self, coefficients: &[f64]) -> f64 {
        dot(&self.system.lift, coefficients)
    }

    /// Returns the load that coefficients carry on a grid of scale 1.
    pub fn carried(&self, coefficients: &[f64]) -> f64 {
        self.system.carried(coefficients)
    }

    /// Scales the coefficients such that they carry the load on a grid of scale s.
    pub fn carry_load(&self, problem: &Problem, scale: f64, coefficients: &mut [f64]) {
        let factor = problem.load / (scale * self.carried(coefficients));
        if factor.is_finite() && factor > 0.0 {
            coefficients.iter_mut().for_each(|c| *c *= factor);
        }
    }

    /// Returns the table of the last contact's asperity law; `None` for smooth surfaces.
    pub fn asperity_table(&self) -> Option<&AsperityTable> {
        self.parts.iter().find_map(|part| part.asperity_table())
    }

    /// Returns the reports of all parts about a state, which must be the one that the last iteration ended with.
    pub fn read(&mut self, case: &Case<'_>, coefficients: &[f64], h_0: f64) -> &mut Readings {
        let Self { system, parts, readings, .. } = self;
        readings.fronts.clear();
        readings.cut.clear();
        (readings.traction, readings.temperatures) = (None, None);
        parts.iter_mut().for_each(|part| part.read(system, case, State { coefficients, h_0 }, readings));
        readings
    }
}
