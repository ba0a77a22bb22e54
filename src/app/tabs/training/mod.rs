//! Making a reduced model: what it shall be trained for and how, the training as it runs, and what its model is worth.

mod charts;
mod comparison;
pub(super) mod fields;
mod form;

use crate::app::controls::{message_ui, sentence, warning_ui};
use crate::app::desk::Desk;
use crate::app::numbers;
use crate::app::purpose::Purpose;
use crate::app::training::{Notice, Running};
use crate::engine::job::Standing;
use egui::{Button, ProgressBar, Response, ScrollArea, Ui};

/// Width of the form.
const FORM_WIDTH: f32 = 316.0;

/// The tab.
pub fn ui(ui: &mut Ui, desk: &mut Desk) {
    ui.horizontal_top(|ui| {
        ui.vertical(|ui| {
            ui.set_width(FORM_WIDTH);
            ScrollArea::vertical().id_salt("training form").auto_shrink(false).show(ui, |ui| form::ui(ui, desk));
        });
        ui.separator();
        ui.vertical(|ui| {
            ScrollArea::vertical().id_salt("training").auto_shrink(false).show(ui, |ui| {
                let (top, height) = (ui.cursor().top(), ui.available_height());
                buttons(ui, desk);
                status(ui, desk);
                comparison::ui(ui, desk);
                charts::key(ui, desk);
                let searches = desk.training.spec.as_ref().is_some_and(|spec| spec.plan.searches());
                let rest = (height - (ui.cursor().top() - top) - 12.0).max(300.0);
                let lower = if searches { (0.34 * rest).max(115.0) } else { 0.0 };
                charts::plane(ui, desk, rest - lower);
                if searches {
                    charts::indicator(ui, desk, lower);
                }
            });
        });
    });
}

fn buttons(ui: &mut Ui, desk: &mut Desk) {
    let ctx = ui.ctx().clone();
    let runs = desk.training.job().is_some();
    let enabled = |ui: &mut Ui, on: bool, name: &str, tip: &str| -> Response {
        ui.add_enabled(on, Button::new(name)).on_hover_text(tip).on_disabled_hover_text(tip)
    };
    ui.horizontal_wrapped(|ui| {
        if runs {
            let tip =
                "Ends the work; a training keeps its full solutions and makes a model of them. Again: no model either";
            if ui.button("Stop").on_hover_text(tip).clicked() {
                desk.training.stop();
            }
        } else {
            let free = !desk.training.left_behind;
            let tip = if free {
                "Takes the full solutions and makes a model of them, beside the live picture"
            } else {
                "First resume or discard the training that was left unfinished"
            };
            if enabled(ui, free, "Start training", tip).clicked() {
                desk.start_training(&ctx);
            }
        }
        if desk.training.unfinished.is_some() {
            let tip = "Goes on as if it had never been stopped: the model will be the same";
            if enabled(ui, !runs, "Resume training", tip).clicked() {
                desk.training.resume(&ctx);
            }
            if enabled(ui, !runs, "Discard", "Forgets the unfinished training").clicked() {
                desk.training.discard();
            }
        }
    });
    if desk.training.made.is_none() {
        return;
    }
    ui.horizontal_wrapped(|ui| {
        let used = desk.uses_made_model();
        let tip = "The picture, the badge and all tabs use it from now on";
        if enabled(ui, !used, "Use this model", tip).clicked() {
            desk.use_made_model();
        }
        if used && enabled(ui, true, "Back to the former model", "Puts the model in use that was before").clicked() {
            desk.use_former_model();
        }
        if enabled(ui, true, "Save model…", "Writes it as a .rom file").clicked()
            && let Some(made) = desk.training.made.clone()
        {
            desk.ask_path(&ctx, Purpose::Model { bytes: made.bytes });
        }
        let other = desk.model().is_some();
        let tip = "Size, time and errors of both at the same random points, against full solutions";
        if enabled(ui, other && !runs, "Compare models", tip).clicked() {
            desk.compare_models(&ctx);
        }
    });
}

fn status(ui: &mut Ui, desk: &mut Desk) {
    for notice in &desk.training.notices {
        match notice {
            Notice::Done(text) => {
                ui.label(sentence(text));
            }
            Notice::Short(text) => warning_ui(ui, text),
            Notice::Wrong(text) => message_ui(ui, text),
        }
    }
    if let Some(job) = desk.training.job() {
        running(ui, job);
        return;
    }
    if let Some(made) = &desk.training.made {
        let model = &made.model;
        let windows = model.windows.len();
        let largest =
            |size: fn(&crate::solver::reduced::Window) -> usize| model.windows.iter().map(size).max().unwrap_or(0);
        let text = format!(
            "{}, {} pressure modes, {} rows, {} MB",
            if windows == 1 { "One window".to_owned() } else { format!("{windows} windows") },
            largest(|w| w.pressure.modes.ncols()),
            largest(|w| w.sampled_rows.len()),
            numbers::digits(made.bytes.len() as f64 / 1e6, 2)
        );
        ui.weak(text).on_hover_text(model.log.join("\n"));
    } else if desk.training.left_behind
        && let Some(unfinished) = &desk.training.unfinished
    {
        warning_ui(
            ui,
            &format!(
                "“{}” was left unfinished with {} full solutions; resume it, or discard it",
                unfinished.spec.title,
                unfinished.solutions()
            ),
        );
    }
}

/// What runs, how far it is, and how long it may take.
fn running(ui: &mut Ui, running: &Running) {
    let Standing { stage, done, total, .. } = running.job.standing();
    let count = if total > 0 { format!("{done} of {total}") } else { String::new() };
    let (stage, fraction) = (sentence(&stage), done as f32 / total.max(1) as f32);
    let stopping = running.job.stopping();
    ui.label(if stopping { format!("Stopping. {stage}") } else { stage });
    let width = ui.available_width().min(420.0);
    let bar = ui.add(ProgressBar::new(fraction).text(count).desired_width(width));
    crate::app::controls::named(ui, bar, "Progress of the training");
    if running.most > 0 {
        let solved = running.chart().solved.len();
        let left = match running.time_left() {
            Some(seconds) if seconds >= 1.0 && !stopping => {
                let word = if running.fewer { "at most" } else { "about" };
                format!("; {word} {} left", remaining(seconds))
            }
            _ => String::new(),
        };
        let of = if running.fewer { "at most " } else { "" };
        ui.weak(format!("{solved} full solutions of {of}{}{left}", running.most));
    }
}

/// A time to wait, no more exact than it is known.
fn remaining(seconds: f64) -> String {
    let thin = numbers::THIN;
    if seconds < 90.0 { format!("{seconds:.0}{thin}s") } else { format!("{:.0}{thin}min", seconds / 60.0) }
}
