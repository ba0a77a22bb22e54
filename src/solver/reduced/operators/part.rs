//! The interface of the parts that reduced operators are composed of.

use super::case::{Case, Start, State};
use super::deformation::Deformation;
use super::readings::Readings;
use super::sampled_system::SampledSystem;
use super::support::Needed;
use crate::solver::reduced::model::Window;
use faer::MatMut;

/// The equations that operators are made for.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Flow<'a> {
    /// Steady, Newtonian, isothermal.
    Newtonian,
    /// Steady, shear-thinning, isothermal.
    Thinning,
    /// Steady, thermal; the lubricant may thin under shear.
    Thermal,
    /// Transient, Newtonian, isothermal. Rows may come to read these further nodes.
    Transient(&'a [usize]),
}

/// What operators are made for.
#[derive(Clone, Copy)]
pub(super) struct Setting<'a> {
    pub window: &'a Window,
    pub flow: Flow<'a>,
    pub deformation: &'a Deformation,
}

/// How a kind of part comes into operators.
pub(super) struct Kind {
    /// Adds the nodes that the part reads in addition to those of the sampled rows.
    pub nodes: fn(&Window, Flow<'_>, &mut Needed),
    /// Makes the part; `None` if operators of this window need none.
    pub make: fn(Setting<'_>, &mut SampledSystem) -> Option<Box<dyn Part>>,
}

/// The film at X = 0 (and Y = 0), as an interpolation between nodes.
#[derive(Clone, Copy)]
pub(super) struct Centre<'a> {
    pub window: &'a Window,
    pub nodes: &'a [(usize, f64)],
    /// Registration scale s.
    pub scale: f64,
}

/// A step that was taken.
#[derive(Clone, Copy)]
pub(super) struct Step {
    /// The share of it that was taken, 0…1.
    pub omega: f64,
    /// ‖Δp̃‖/‖p̃‖.
    pub size: f64,
}

/// What parts changed after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Moved {
    /// Nothing.
    Still,
    /// Fields, but the derivatives of the rows still serve.
    BetweenRows,
    /// Fields or laws, so that the derivatives serve no more.
    PastRows,
    /// p̃ and H₀ themselves.
    State,
    /// The part has no finite state.
    Lost,
}

/// What one part of the physics or of the numerics adds to the sampled system. Each method is one phase of a solve; by
/// default a part has nothing to do in it. Nothing may be allocated from `spread` to `settle`.
pub(super) trait Part: Send {
    /// Prepares for a contact before its iteration begins.
    fn begin(&mut self, _system: &mut SampledSystem, _case: &Case<'_>, _start: &Start<'_>) {}

    /// Amends `lift`: the film at X = 0 (and Y = 0) per unit of each coefficient, given for whole modes of a circle.
    fn aim(&mut self, _system: &mut SampledSystem, _at: Centre<'_>) {}

    /// Amends P, K P and the gradients of coefficients, one behind the other at the support.
    fn spread(&mut self, _system: &SampledSystem, _coefficients: &[f64], _fields: &mut [f64]) {}

    /// Evaluates the nodes from fields and films by laws of its own; returns false if it leaves them to others.
    fn nodes(&mut self, _system: &mut SampledSystem, _case: &Case<'_>, _state: State<'_>) -> bool {
        false
    }

    /// Amends the derivatives of the rows with respect to P and H of their nodes.
    fn slopes(&mut self, _system: &mut SampledSystem) {}

    /// Amends the derivatives of the rows with respect to the coefficients; `exact` in an iteration that turned out slow.
    fn jacobian(&mut self, _system: &mut SampledSystem, _scale: f64, _exact: bool) {}

    /// Amends Galerkin's equations for the step from `coefficients`; without a matrix the factors of the previous step
    /// serve again, and only the right-hand side is new.
    fn equations(&mut self, _coefficients: &[f64], _matrix: Option<MatMut<'_, f64>>, _rhs: &mut [f64]) {}

    /// Follows a step, and may change the state that it led to.
    fn settle(
        &mut self,
        _system: &mut SampledSystem,
        _case: &Case<'_>,
        _step: Step,
        _state: (&mut [f64], &mut f64),
    ) -> Moved {
        Moved::Still
    }

    /// Reports what it found at the state that the iteration ended with.
    fn read(&mut self, _system: &SampledSystem, _case: &Case<'_>, _state: State<'_>, _readings: &mut Readings) {}
}
