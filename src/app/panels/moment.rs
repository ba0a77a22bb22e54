//! Read-outs of a transient contact at the displayed time, from the first method that has reached it.

use super::readouts::cell;
use crate::app::context::Context;
use crate::app::drawn::{self, Owner};
use crate::app::numbers;
use crate::app::theme::{Palette, symbol};
use crate::solver::full::transient::Quantity;
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
    let (film, pressure) = (setup.point.film_scale_m(), setup.point.hertz().pressure_pa);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 26.0;
        if drawn::is_grey(ui.ctx(), "read-outs of the moment", Owner::Transient(Arc::clone(setup)), context) {
            ui.disable();
        }
        let films = [
            ("c", h_c, "Central film thickness at the displayed time"),
            ("min", value(Quantity::MinimumFilm), SMALLEST),
        ];
        for (index, h, tip) in films {
            let si = numbers::length(h * film);
            cell(ui, symbol(ui, "H", index), numbers::significant(h), si, palette.film, None, tip);
        }
        let p = value(Quantity::MaximumPressure);
        let (name, si) = (symbol(ui, "P", "max"), numbers::pressure(p * pressure));
        cell(ui, name, numbers::significant(p), si, palette.pressure, None, "Maximum pressure at the displayed time");
        let load = setup.point.load * setup.study.inputs.load.at(time);
        let (name, unit) = (symbol(ui, "w", ""), "kN/m".to_owned());
        cell(ui, name, numbers::significant(1e-3 * load), unit, palette.text, None, "Load at the displayed time");
        if ui.available_size_before_wrap().x > MOMENT {
            let tip = "Displayed time, and the method of these values";
            cell(ui, symbol(ui, "T", ""), numbers::significant(time), run.name(), palette.quiet, None, tip);
        }
    });
    true
}

/// Width of the text about the displayed time.
const MOMENT: f32 = 190.0;
/// Tooltip of the minimum film thickness.
const SMALLEST: &str = "Minimum film thickness of the contact zone at the displayed time";
