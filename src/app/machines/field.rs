//! Number of a machine that can be typed, with its unit.

use crate::app::controls::{Entries, row_name, typed_field};
use crate::app::theme::name_and_symbol;
use crate::app::units;
use crate::solver::physics::engineering::{self, Dimension, QuantityKind};
use egui::Ui;
use std::f64::consts::PI;

/// Number of a machine that can be typed.
pub(super) struct Field<M> {
    /// Accessible name.
    pub name: &'static str,
    /// Name of the row with its symbol and subscript.
    pub row: (&'static str, &'static str, &'static str),
    pub stored: Stored,
    pub tip: &'static str,
    pub dimension: fn(&M) -> Dimension,
    /// Returns the value as the machine stores it; `None` if the machine has no such value.
    pub get: fn(&M) -> Option<f64>,
    pub set: fn(&mut M, f64),
}

/// Kind of a value, and the size in SI units of the unit in which the machine stores it.
pub(super) type Stored = (QuantityKind, f64);

pub(super) const LENGTH: Stored = (QuantityKind::Length, 1.0);
pub(super) const CLEARANCE: Stored = (QuantityKind::FilmThickness, 1.0);
pub(super) const DEGREE: Stored = (QuantityKind::Angle, PI / 180.0);
pub(super) const RPM: Stored = (QuantityKind::Rotation, PI / 30.0);
pub(super) const FORCE: Stored = (QuantityKind::Force, 1.0);
pub(super) const NUMBER: Stored = (QuantityKind::Number, 1.0);

impl<M> Field<M> {
    /// Draws the value if the machine has it, and sets what was typed.
    pub fn ui(&self, ui: &mut Ui, machine: &mut M, entries: &mut Entries) {
        let Some(value) = (self.get)(machine) else { return };
        let ((kind, stored), dimension) = (self.stored, (self.dimension)(machine));
        let unit = kind.unit(units::system(ui.ctx()));
        ui.horizontal(|ui| {
            let (word, symbol, index) = self.row;
            row_name(ui, name_and_symbol(ui, word, symbol, index), self.tip);
            // A plane has no radius. It is shown and typed as infinite.
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

/// Returns a typed whole number. Texts without sense become 0, which the machine refuses.
pub(super) fn whole(value: f64) -> u32 {
    // A cast of a float saturates.
    value.round() as u32
}
