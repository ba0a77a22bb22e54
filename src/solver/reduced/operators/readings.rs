//! Results that reduced operators report for a solution.

use crate::solver::reduced::temperature_field::TemperatureField;

/// Results for the state that an iteration ended with.
#[derive(Default)]
pub(crate) struct Readings {
    /// First cavitated column of each line along X; empty with a penalty.
    pub fronts: Vec<usize>,
    /// Nodes behind the cavitation boundary, and the pressures of the modes there.
    pub cut: Vec<(usize, f64)>,
    /// Traction (3.41); `None` for a local model without a traction quadrature.
    pub traction: Option<RuleTraction>,
    /// Temperatures; `None` for an isothermal contact.
    pub temperatures: Option<TemperatureField>,
}

impl Readings {
    /// Creates empty results with capacity for a cavitation boundary over the given number of rows.
    pub(super) fn with_room(rows: usize) -> Self {
        Self { fronts: Vec::with_capacity(rows), cut: Vec::with_capacity(rows), ..Self::default() }
    }
}

/// Traction of a reduced solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RuleTraction {
    /// Traction coefficient.
    pub coefficient: f64,
    /// Share by which the limiting stress reduces the traction, 0…1. `None` for a thermal contact, whose temperatures
    /// already depend on the limit.
    pub cut: Option<f64>,
}
