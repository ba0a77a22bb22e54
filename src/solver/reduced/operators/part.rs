//! Interface of the parts of reduced operators.

use super::case::{Case, Start, State};
use super::deformation::Deformation;
use super::readings::Readings;
use super::sampled_system::SampledSystem;
use super::support::Needed;
use crate::solver::physics::surfaces::AsperityTable;
use crate::solver::reduced::model::Window;
use faer::MatMut;

/// Type of flow that operators are built for.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Flow<'a> {
    /// Steady, Newtonian, isothermal.
    Newtonian,
    /// Steady, shear-thinning, isothermal.
    Thinning,
    /// Steady, thermal; the lubricant may be shear-thinning.
    Thermal,
    /// Steady, Newtonian, isothermal, with rough surfaces.
    Rough,
    /// Transient, Newtonian, isothermal. Rows may later use these further nodes.
    Transient(&'a [usize]),
}

/// Context in which operators are built.
#[derive(Clone, Copy)]
pub(super) struct Setting<'a> {
    pub window: &'a Window,
    pub flow: Flow<'a>,
    pub deformation: &'a Deformation,
}

/// Kind of part: its nodes and its constructor.
pub(super) struct Kind {
    /// Adds the nodes that the part uses in addition to those of the sampled equations.
    pub nodes: fn(&Window, Flow<'_>, &mut Needed),
    /// Creates the part; `None` if operators of this local model do not need it.
    pub make: fn(Setting<'_>, &mut SampledSystem) -> Option<Box<dyn Part>>,
}

/// Film at X = 0 (and Y = 0), as an interpolation between nodes.
#[derive(Clone, Copy)]
pub(super) struct Centre<'a> {
    pub window: &'a Window,
    pub nodes: &'a [(usize, f64)],
    /// Registration scale s.
    pub scale: f64,
}

/// Applied step.
#[derive(Clone, Copy)]
pub(super) struct Step {
    /// Share of the step that was applied, 0…1.
    pub omega: f64,
    /// Relative step ‖Δp̃‖/‖p̃‖ of the pressure coefficients.
    pub size: f64,
}

/// Change by a part after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Moved {
    /// Nothing.
    Still,
    /// Fields, but the derivatives of the rows can be used again.
    BetweenRows,
    /// Fields or laws, so that the derivatives must be computed again.
    PastRows,
    /// Pressure coefficients p̃ and rigid-body separation H₀ themselves.
    State,
    /// The part has no finite state.
    Lost,
}

/// One part of the physics or of the numerics of the sampled system. Each method is one phase of a solve; the default
/// does nothing. Nothing may be allocated from `spread` to `settle`.
pub(super) trait Part: Send {
    /// Prepares the part for a contact before its iteration starts.
    fn begin(&mut self, _system: &mut SampledSystem, _case: &Case<'_>, _start: &Start<'_>) {}

    /// Modifies `lift`, the film thickness at X = 0 (and Y = 0) per unit of each coefficient. It is given for whole
    /// modes of a circular contact.
    fn aim(&mut self, _system: &mut SampledSystem, _at: Centre<'_>) {}

    /// Modifies pressure P, deformation K P and gradients of coefficients, which are stored one after the other at the
    /// support.
    fn spread(&mut self, _system: &SampledSystem, _coefficients: &[f64], _fields: &mut [f64]) {}

    /// Evaluates the nodes from fields and film thicknesses by the part's own laws; returns false to leave this to
    /// others.
    fn nodes(&mut self, _system: &mut SampledSystem, _case: &Case<'_>, _state: State<'_>) -> bool {
        false
    }

    /// Evaluates the rows in [`RowState::Held`](super::sampled_system::RowState::Held), with their derivatives if
    /// `sloping`. Returns the sum of their weighted squares.
    fn rows(&mut self, _system: &mut SampledSystem, _case: &Case<'_>, _sloping: bool) -> f64 {
        0.0
    }

    /// Modifies the derivatives of the rows by P and H of their nodes.
    fn slopes(&mut self, _system: &mut SampledSystem) {}

    /// Modifies the derivatives of the rows by the coefficients; `exact` in a slow iteration.
    fn jacobian(&mut self, _system: &mut SampledSystem, _scale: f64, _exact: bool) {}

    /// Modifies Galerkin's equations for the step from `coefficients`. Without a matrix the factors of the previous
    /// step are used again, and only the right-hand side is new.
    fn equations(&mut self, _coefficients: &[f64], _matrix: Option<MatMut<'_, f64>>, _rhs: &mut [f64]) {}

    /// Returns the longest admissible share of the step, 0…1, by the part's own limits; `None` to leave this to others.
    fn longest_step(&self, _system: &SampledSystem, _case: &Case<'_>) -> Option<f64> {
        None
    }

    /// Updates the part after a step; may change the state that the step led to.
    fn settle(
        &mut self,
        _system: &mut SampledSystem,
        _case: &Case<'_>,
        _step: Step,
        _state: (&mut [f64], &mut f64),
    ) -> Moved {
        Moved::Still
    }

    /// Returns the table of the last contact's asperity law; `None` for smooth surfaces.
    fn asperity_table(&self) -> Option<&AsperityTable> {
        None
    }

    /// Writes the part's results for the state that the iteration ended with.
    fn read(&mut self, _system: &SampledSystem, _case: &Case<'_>, _state: State<'_>, _readings: &mut Readings) {}
}
