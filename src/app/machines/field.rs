//! Editable row for one numerical parameter of a rolling bearing, gear pair or cam, with conversion between the unit on
//! the screen and the unit in which the machine stores it.

use crate::app::controls::{Entries, row_name, typed_field};
use crate::app::theme::name_and_symbol;
use crate::app::units;
use crate::solver::physics::engineering::{self, Dimension, QuantityKind};
use egui::Ui;
use std::f64::consts::PI;

/// Numerical parameter of a machine of type `M`, as an editable row.
pub(super) struct Field<M> {
    /// Accessible name.
    pub name: &'static str,
    /// Name of the row with its symbol and subscript.
    pub row: (&'static str, &'static str, &'static str),
    /// Kind of quantity and storage unit.
    pub stored: Stored,
    /// Tooltip.
    pub tip: &'static str,
    /// Returns the physical dimension, which determines the units that may be typed.
    pub dimension: fn(&M) -> Dimension,
    /// Returns the value as the machine stores it; `None` if the machine has no such value.
    pub get: fn(&M) -> Option<f64>,
    /// Stores a value in the unit of the machine.
    pub set: fn(&mut M, f64),
}

/// Kind of quantity, and size of one storage unit in SI units.
pub(super) type Stored = (QuantityKind, f64);

pub(super) const LENGTH: Stored = (QuantityKind::Length, 1.0);
pub(super) const CLEARANCE: Stored = (QuantityKind::FilmThickness, 1.0);
pub(super) const DEGREE: Stored = (QuantityKind::Angle, PI / 180.0);
pub(super) const RPM: Stored = (QuantityKind::Rotation, PI / 30.0);
pub(super) const FORCE: Stored = (QuantityKind::Force, 1.0);
pub(super) const NUMBER: Stored = (QuantityKind::Number, 1.0);

impl<M> Field<M> {
    /// Draws the row if the machine has the value, and stores a typed value.
    pub fn ui(&self, ui: &mut Ui, machine: &mut M, entries: &mut Entries) {
        let Some(value) = (self.get)(machine) else { return };
        let ((kind, stored), dimension) = (self.stored, (self.dimension)(machine));
        let unit = kind.unit(units::system(ui.ctx()));
        ui.horizontal(|ui| {
            let (word, symbol, index) = self.row;
            row_name(ui, name_and_symbol(ui, word, symbol, index), self.tip);
            // The radius of a plane is entered and shown as infinite.
            let read = |text: &str| match text.trim().to_lowercase().as_str() {
                "plane" | "none" | "∞" | "inf" if dimension == Dimension::Length => Ok(f64::INFINITY),
                _ => Ok(unit.number(engineering::parse(text, dimension, unit.name)?)),
            };
            if let Some(typed) = typed_field(ui, entries, self.name, unit.number(value * stored), 84.0, self.tip, read)
            {
                (self.set)(machine, unit.si(typed) / stored);
                entries.answer(self.name, Ok(()));
            }
            ui.label(unit.name);
        });
    }
}

/// Rounds a typed number. Negative numbers and NaN become 0, which the machine refuses.
pub(super) fn whole(value: f64) -> u32 {
    // A cast of a float saturates.
    value.round() as u32
}
