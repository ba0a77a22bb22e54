//! The contact in time: what drives it, how film and pressure answer, and how the frames differ.

mod cost;
pub mod form;
pub mod methods;
mod profiles;
pub mod series;

use crate::app::controls::{message_ui, named, sentence, warning_ui};
use crate::app::desk::Desk;
use crate::app::figure::{self, Subject};
use crate::app::numbers;
use crate::app::purpose::Purpose;
use crate::app::theme::rich;
use crate::app::transient::{Run, TransientView, export};
use crate::engine::TOO_STEEP;
use crate::solver::full::transient::Ended;
use crate::solver::reduced::tpwl::TpwlRecord;
use egui::{Button, ProgressBar, ScrollArea, Slider, Ui};

/// Width of the form.
const FORM_WIDTH: f32 = 300.0;
/// Width from which on the profiles stand beside the series.
const SIDE_BY_SIDE: f32 = 560.0;
/// Heights below which plots cannot be read.
const LEAST_HEIGHT: f32 = 104.0;

/// The tab.
pub fn ui(ui: &mut Ui, desk: &mut Desk) {
    if let Some(why) = desk.no_transient() {
        ui.centered_and_justified(|ui| ui.weak(why));
        return;
    }
    ui.horizontal_top(|ui| {
        if !desk.transient.form_hidden {
            ui.vertical(|ui| {
                ui.set_width(FORM_WIDTH);
                ScrollArea::vertical().id_salt("transient form").auto_shrink(false).show(ui, |ui| form::ui(ui, desk));
            });
            ui.separator();
        }
        ui.vertical(|ui| {
            ScrollArea::vertical().id_salt("transient").auto_shrink(false).show(ui, |ui| results(ui, desk));
        });
    });
}

fn results(ui: &mut Ui, desk: &mut Desk) {
    let (top, height) = (ui.cursor().top(), ui.available_height());
    buttons(ui, desk);
    status(ui, desk);
    if desk.transient.runs.iter().all(|run| run.trajectory.moments.is_empty()) {
        if desk.transient.work.standing().is_none() {
            ui.weak("Run it in time to see pressure and film follow the inputs.");
        }
        return;
    }
    player(ui, &mut desk.transient);
    let all = ui.vertical(|ui| {
        cost::ui(ui, desk);
        plots(ui, desk, height - (ui.cursor().top() - top) - 18.0)
    });
    figure::offer_of(ui, "Series and profiles", all.response.rect, Subject::InTime);
    if let Some(time) = all.inner {
        desk.transient.player.go_to(time);
    }
}

/// Series and profiles, beside each other where there is room; returns the time that was clicked at.
fn plots(ui: &mut Ui, desk: &Desk, height: f32) -> Option<f64> {
    let several = desk.transient.runs.len() > 1;
    let parts = if several { 2.7 } else { 2.0 };
    if ui.available_width() < SIDE_BY_SIDE {
        let clicked = series::ui(ui, desk, (0.55 * height / parts).max(LEAST_HEIGHT));
        profiles::ui(ui, desk, (0.5 * height).max(LEAST_HEIGHT));
        return clicked;
    }
    let (unit, width) = ((height / parts).max(LEAST_HEIGHT), ui.available_width());
    let both = ui.horizontal_top(|ui| {
        let series = ui.vertical(|ui| {
            ui.set_width(0.56 * width);
            series::ui(ui, desk, unit)
        });
        ui.vertical(|ui| profiles::ui(ui, desk, 0.5 * unit * parts));
        series.inner
    });
    both.inner
}

fn buttons(ui: &mut Ui, desk: &mut Desk) {
    let ctx = ui.ctx().clone();
    ui.horizontal_wrapped(|ui| {
        let mut form = !desk.transient.form_hidden;
        ui.toggle_value(&mut form, "Set-up")
            .on_hover_text("Shows what drives the contact, or leaves the room to plots");
        desk.transient.form_hidden = !form;
        run_button(ui, desk);
        let there = desk.transient.runs.iter().any(|run| !run.trajectory.moments.is_empty());
        let tip = "All moments of every run with their SI twins, each run in columns of its own";
        if ui.add_enabled(there, Button::new("Export series…")).on_hover_text(tip).clicked()
            && let Some(text) = export::series(&desk.transient)
        {
            desk.ask_path(&ctx, Purpose::Csv { text });
        }
        let tip = "Pressure and film of every run at the moment that is shown";
        if ui.add_enabled(there, Button::new("Export profiles…")).on_hover_text(tip).clicked()
            && let Some(text) = export::profiles(&desk.transient)
        {
            desk.ask_path(&ctx, Purpose::Csv { text });
        }
        let tip = "Any of these plots, or the whole tab, as SVG or PNG with axes and parameters";
        if ui.add_enabled(there, Button::new("Export plot…")).on_hover_text(tip).clicked() {
            desk.figures.ask();
        }
    });
}

/// The runs, started or stopped.
pub fn run_button(ui: &mut Ui, desk: &mut Desk) {
    if desk.transient.work.standing().is_some() {
        if ui.button("Stop").on_hover_text("What has been computed so far stays (Esc)").clicked() {
            desk.transient.stop();
        }
    } else if ui
        .button("Run in time")
        .on_hover_text("Takes the contact of the sliders through time, frame after frame, then by each model")
        .clicked()
    {
        desk.start_transient(&ui.ctx().clone());
    }
}

/// What runs and how far it is; how runs ended that did not reach the end; whether all of it is still what the sliders
/// say.
pub fn status(ui: &mut Ui, desk: &Desk) {
    let view = &desk.transient;
    if let Some(standing) = view.work.standing() {
        ui.horizontal(|ui| {
            ui.label(&standing.stage);
            let fraction = if standing.total > 0 { standing.done as f32 / standing.total as f32 } else { 0.0 };
            let bar = ProgressBar::new(fraction).desired_width(120.0).desired_height(8.0);
            let bar = ui.add(bar);
            named(ui, bar, "Progress of the contact in time");
            ui.weak(numbers::standing(&standing));
        });
    }
    if let Some(message) = &view.work.message {
        message_ui(ui, message);
    }
    for note in &view.notes {
        message_ui(ui, note);
    }
    let steep = |(_, run): (_, &Run)| run.record.as_ref().is_some_and(TpwlRecord::too_steep);
    if view.linearised_runs().any(steep) {
        warning_ui(ui, &format!("{TOO_STEEP}. Tick Reduced model, or train on inputs like these"));
    }
    for run in &view.runs {
        let said = |ended: &Ended| format!("{} {}", run.name(), ended.describe());
        match run.ended.then_some(&run.trajectory.ended) {
            Some(ended @ (Ended::StepRefused { .. } | Ended::ContactRefused { .. })) => message_ui(ui, &said(ended)),
            Some(ended @ Ended::Cancelled { .. }) => {
                ui.weak(sentence(&said(ended)));
            }
            Some(Ended::Finished) | None => {}
        }
    }
    if let Some(setup) = view.setup.as_ref().filter(|setup| ***setup != desk.transient_setup()) {
        let of = numbers::moes(setup.point.moes());
        warning_ui(ui, &format!("What is shown belongs to {of} and a former set-up; run it again for the present one"));
    }
}

/// The moment that is looked at: a slider over what was computed, and a button that plays it.
pub fn player(ui: &mut Ui, view: &mut TransientView) {
    let Some(setup) = view.setup.clone() else { return };
    let seconds = ui.input(|i| i.stable_dt).min(0.1);
    view.player.advance(f64::from(seconds), setup.study.duration);
    ui.horizontal(|ui| {
        let playing = view.player.playing();
        let (name, tip) = if playing { ("Pause", "Stand still here") } else { ("Play", "Play the profiles in time") };
        if ui.button(name).on_hover_text(tip).clicked() {
            view.player.toggle();
        }
        let mut time = view.player.time();
        let text =
            format!("{{T}} = {}, {}", numbers::significant(time), numbers::duration(time * setup.time_scale_s()));
        ui.spacing_mut().slider_width = (ui.available_width() - 190.0).max(80.0);
        let response = ui.add(Slider::new(&mut time, 0.0..=view.player.end().max(f64::MIN_POSITIVE)).show_value(false));
        let response = named(ui, response, "Time T");
        if response.changed() {
            view.player.go_to(time);
        }
        let tip =
            "The moment whose profiles are shown, in units of a/u_m of the reference contact (2.22) and on the clock";
        ui.label(rich(&text, 13.5, ui.visuals().text_color())).on_hover_text(tip);
    });
    if view.player.playing() {
        ui.ctx().request_repaint();
    }
}

/// Marks of an axis of this width that leave their labels room.
fn marks(width: f32) -> f64 {
    f64::from((width - 60.0).max(60.0) / 60.0)
}

/// The same for an axis of this height.
fn rows(height: f32) -> f64 {
    f64::from((height - 24.0).max(48.0) / 24.0).min(6.0)
}
