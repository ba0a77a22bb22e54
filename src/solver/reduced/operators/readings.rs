//! What reduced operators report of a solution.

use crate::solver::reduced::warmth::Warmth;

/// What operators report of the state that an iteration ended with.
#[derive(Default)]
pub(crate) struct Readings {
    /// The first cavitated column of each line along X; empty under a penalty.
    pub fronts: Vec<usize>,
    /// Nodes behind the cavitation boundary, and the pressures that the modes have there.
    pub cut: Vec<(usize, f64)>,
    /// Traction (3.41); `None` for a window without a traction quadrature.
    pub traction: Option<RuleTraction>,
    /// Temperatures; `None` for an isothermal contact.
    pub warmth: Option<Warmth>,
}

impl Readings {
    /// Empty, with room for what a cavitation boundary over so many rows reports.
    pub(super) fn with_room(rows: usize) -> Self {
        Self { fronts: Vec::with_capacity(rows), cut: Vec::with_capacity(rows), ..Self::default() }
    }
}

/// The traction of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleTraction {
    /// Its coefficient.
    pub coefficient: f64,
    /// The share that the limiting stress takes of what it were without one, 0…1. `None` for a thermal contact, whose
    /// temperatures are those under the limit.
    pub cut: Option<f64>,
}
