//! Number of a machine that can be typed, with its unit.

use crate::app::controls::{Entries, row_name, typed_field};
use crate::app::refusal::Refusal;
use crate::app::theme::name_and_symbol;
use crate::solver::physics::engineering::{self, Dimension};
use egui::Ui;
use std::f64::consts::PI;

/// Number of a machine that can be typed.
pub(super) struct Field<M> {
    /// Accessible name.
    pub name: &'static str,
    /// Name of the row with its symbol and subscript.
    pub row: (&'static str, &'static str, &'static str),
    pub unit: Unit,
    pub tip: &'static str,
    pub dimension: fn(&M) -> Dimension,
    /// Returns the value as the machine stores it; `None` if the machine has no such value.
    pub get: fn(&M) -> Option<f64>,
    pub set: fn(&mut M, f64),
}

/// Unit of a field: its name, its size in SI units, and its size in the unit in which the machine stores the value.
pub(super) type Unit = (&'static str, f64, f64);

pub(super) const MM: Unit = ("mm", 1e-3, 1e-3);
pub(super) const MICRO: Unit = ("µm", 1e-6, 1e-6);
pub(super) const DEGREE: Unit = ("°", PI / 180.0, 1.0);
pub(super) const RPM: Unit = ("rpm", PI / 30.0, 1.0);
pub(super) const NEWTON: Unit = ("N", 1.0, 1.0);
pub(super) const NONE: Unit = ("", 1.0, 1.0);

impl<M> Field<M> {
    /// Draws the value if the machine has it, and sets what was typed.
    pub fn ui(&self, ui: &mut Ui, machine: &mut M, entries: &mut Entries) {
        let Some(value) = (self.get)(machine) else { return };
        let (unit, si, stored) = self.unit;
        let dimension = (self.dimension)(machine);
        ui.horizontal(|ui| {
            let (word, symbol, index) = self.row;
            row_name(ui, name_and_symbol(ui, word, symbol, index), self.tip);
            // A plane has no radius. It is shown and typed as infinite.
            let read = |text: &str| match text.trim().to_lowercase().as_str() {
                "plane" | "none" | "∞" | "inf" if dimension == Dimension::Length => Ok(f64::INFINITY),
                _ => engineering::parse(text, dimension, unit).map(|value| value / si).map_err(Refusal::from),
            };
            if let Some(typed) = typed_field(ui, entries, self.name, value / stored, 84.0, self.tip, read) {
                (self.set)(machine, typed * stored);
                entries.answer(self.name, Ok(()));
            }
            ui.label(unit);
        });
    }
}

/// Returns a typed whole number. Texts without sense become 0, which the machine refuses.
pub(super) fn whole(value: f64) -> u32 {
    // A cast of a float saturates.
    value.round() as u32
}
