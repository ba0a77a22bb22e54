//! Read-outs of a transient contact at the displayed time, from the first method that has reached it.

use super::readouts::{Cell, cells_ui};
use crate::app::context::Context;
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::theme::{Palette, symbol};
use crate::solver::full::transient::Quantity;
use crate::solver::parameters::Quantity::Load;
use egui::Ui;
use std::sync::Arc;

/// Draws the read-outs. Returns true if there are any.
pub fn ui(ui: &mut Ui, context: &Context<'_>) -> bool {
    let view = context.transient;
    let time = view.player.time();
    let there = |quantity| view.runs.iter().find_map(|run| Some((run, run.trajectory.at(quantity, time)?)));
    let (Some(setup), Some((run, h_c))) = (&view.setup, there(Quantity::CentralFilm)) else { return false };
    let value = |quantity| run.trajectory.at(quantity, time).unwrap_or(f64::NAN);
    let palette = Palette::of(ui);
    let system = context.system;
    let (film, pressure) = (setup.point.film_scale_m(), setup.point.hertz().pressure_pa);
    let films = [
        ("c", h_c, "Central film thickness at the displayed time"),
        ("min", value(Quantity::MinimumFilm), "Minimum film thickness of the contact zone at the displayed time"),
    ];
    let read = |name, value: f64, unit, color, tip: &'static str| {
        let value = numbers::significant(value);
        Cell { name, value, unit, color, delta: None, tip: tip.into() }
    };
    let mut cells: Vec<Cell> = films
        .into_iter()
        .map(|(index, h, tip)| read(symbol(ui, "H", index), h, numbers::length(h * film, system), palette.film, tip))
        .collect();
    let p = value(Quantity::MaximumPressure);
    let (name, si) = (symbol(ui, "P", "max"), numbers::pressure(p * pressure, system));
    cells.push(read(name, p, si, palette.pressure, "Maximum pressure at the displayed time"));
    if setup.lubricant.is_rough() {
        let share = numbers::share(value(Quantity::AsperityLoadShare));
        let tip = "Share of the load that asperities carry at the displayed time";
        let name = symbol(ui, "L", "a");
        cells.push(Cell {
            name,
            value: share,
            unit: String::new(),
            color: palette.traction,
            delta: None,
            tip: tip.into(),
        });
    }
    let load = setup.point.load * setup.study.inputs.load.at(time);
    let unit = Load.kind(setup.point.kind).unit(system);
    let cell = (symbol(ui, "w", ""), unit.number(load), unit.name.to_owned());
    cells.push(read(cell.0, cell.1, cell.2, palette.text, "Load at the displayed time"));
    let tip = "Displayed time, and the method of these values";
    cells.push(read(symbol(ui, "T", ""), time, run.name(), palette.quiet, tip));
    ui.scope(|ui| {
        if drawn::is_grey(ui.ctx(), "read-outs of the moment", Owner::Transient(Arc::clone(setup)), context) {
            ui.disable();
        }
        cells_ui(ui, cells);
    });
    true
}
