//! Parts that the transient tabs share: form, run button, status line and time bar.

use super::advice::advice;
use super::export;
use super::runs::{TransientCommand, TransientRuns};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{either_button, named, sentence, standing_ui};
use crate::app::document::{Edit, Shape};
use crate::app::drawn::{self, Owner};
use crate::app::form::{Form, LastField};
use crate::app::tabs::transient::{Run, Setup, model_in_use};
use crate::app::theme::{Palette, rich};
use crate::app::{caption, numbers};
use crate::scene::TransientStudy;
use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::Ended;
use crate::solver::physics::engineering::UnitSystem;
use crate::solver::reduced::tpwl::{TpwlRecord, Weighting};
use crate::solver::warning::Warning;
use egui::text::{LayoutJob, TextFormat};
use egui::{Color32, FontId, Label, ScrollArea, Slider, TextStyle, Ui};
use std::sync::Arc;

/// Draws a form of the document's transient study. Returns the field that was changed last. `name` is the name
/// under which a refusal is stored.
pub fn edit(
    ui: &mut Ui,
    (name, last): (&'static str, LastField),
    context: &Context<'_>,
    commands: &mut Commands,
    content: impl FnOnce(&mut Ui, &mut Form<'_>, &mut TransientStudy),
) -> LastField {
    let before = context.document.transient_study();
    let mut study = before.clone();
    let mut form = Form::new(name, last, context);
    ui.add_enabled_ui(!context.transient.runs_by_hand(), |ui| content(ui, &mut form, &mut study));
    let edit = (study != before).then(|| Edit::Transient(Box::new(study)));
    form.ask(edit, "Frames", commands)
}

/// Makes the transient runs follow the document. Every tab that shows them calls it.
pub fn follow(context: &Context<'_>, commands: &mut Commands) {
    let wanted = Setup::of(context.document, context.file);
    if !context.transient.follows(&wanted) && !context.transient.runs_by_hand() {
        commands.push(Command::Transient(TransientCommand::Follow(Box::new(wanted))));
    }
}

/// Draws the reason why this contact has no transient runs, with a button that changes to a roller if that helps.
fn elsewhere(ui: &mut Ui, context: &Context<'_>, why: &str, commands: &mut Commands) {
    ui.weak(sentence(why));
    let tip = "A line contact with the same quantities";
    if context.document.point.kind.is_point()
        && context.document.no_transient().is_none()
        && ui.button("Show a line contact").on_hover_text(tip).clicked()
    {
        commands.edit(Edit::Shape(Shape::Roller), "contact");
    }
}

/// Returns true if runs are computed or are about to start automatically.
pub fn is_coming(context: &Context<'_>) -> bool {
    let view = context.transient;
    let wanted = Setup::of(context.document, context.file);
    view.standing().is_some() || view.waits() || !view.follows(&wanted)
}

/// Draws the rest grey if it belongs to a previous set-up.
pub fn grey_where_stale(ui: &mut Ui, context: &Context<'_>, name: &'static str) {
    let view = context.transient;
    let Some(setup) = &view.setup else { return };
    if drawn::is_grey(ui.ctx(), name, Owner::Transient(Arc::clone(setup)), context) {
        drawn::fade(ui, is_coming(context));
    }
}

/// Draws the button that starts or stops the runs.
pub fn run_button(ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
    let view = context.transient;
    let runs = view.runs_by_hand();
    let tip = if runs {
        "Keeps the results so far (Esc)"
    } else {
        "Computes the transient contact in each frame, then with each model"
    };
    if either_button(ui, ["Run transient", "Stop"], runs).on_hover_text(tip).clicked() {
        let setup = || Box::new(Setup::of(context.document, context.file));
        commands.push(Command::Transient(if runs { TransientCommand::Stop } else { TransientCommand::Run(setup()) }));
    }
}

/// Draws progress, refusals, early ends, and a warning if the results are out of date. The text takes one line that
/// is always present, so that nothing below moves. The full text is shown on hover.
pub fn status<'a>(ui: &mut Ui, context: &'a Context<'_>, refused: impl IntoIterator<Item = &'a str>) {
    let view = context.transient;
    let palette = Palette::of(ui);
    let size = TextStyle::Small.resolve(ui.style()).size;
    let mut line = LayoutJob::default();
    for (text, color) in sentences(context, refused, &palette) {
        let before = if line.is_empty() { "" } else { ".  " };
        let format = TextFormat { font_id: FontId::proportional(size), color, ..TextFormat::default() };
        line.append(&format!("{before}{}", sentence(&text).trim_end_matches('.')), 0.0, format);
    }
    ui.horizontal(|ui| {
        ui.set_min_height(ui.spacing().interact_size.y);
        if view.runs_by_hand() {
            standing_ui(ui, view.standing(), "Progress of the transient runs");
        }
        if !line.is_empty() {
            ui.add(Label::new(line).truncate());
        }
    });
}

/// Returns the messages about the runs, the most severe first.
fn sentences<'a>(
    context: &'a Context<'_>,
    refused: impl IntoIterator<Item = &'a str>,
    palette: &Palette,
) -> Vec<(String, Color32)> {
    let view = context.transient;
    let wrong = refused.into_iter().chain(view.work.message.as_deref()).chain(view.notes.iter().map(String::as_str));
    let mut said: Vec<(String, Color32)> = wrong.map(|text| (text.to_owned(), palette.wrong)).collect();
    for run in view.runs.iter().filter(|run| run.ended) {
        let cancelled = matches!(run.trajectory.ended, Ended::Cancelled { .. });
        let color = if cancelled { palette.quiet } else { palette.wrong };
        said.extend(run.trajectory.stopped().map(|warning| (format!("{}: {warning}", run.name()), color)));
    }
    let mut warn = |text: String| said.push((text, palette.warning));
    let wanted = Setup::of(context.document, context.file);
    let asked = |setup: &&Arc<Setup>| ***setup != wanted && !wanted.is_quick();
    if let Some(setup) = view.setup.as_ref().filter(asked) {
        let of = numbers::moes(setup.point.moes());
        warn(format!("The results belong to {of} and a previous set-up; run again for the present one"));
    }
    let steep = |(_, run): (_, &Run)| !run.replayed && run.record.as_ref().is_some_and(TpwlRecord::too_steep);
    if view.linearised_runs().any(steep) {
        warn(Warning::TooSteep { advice: advice(view).to_owned() }.to_string());
    }
    let quiet = palette.quiet;
    // A warning that several runs share is shown once.
    let of_runs = view.runs.iter().flat_map(|run| run.warnings.iter().map(move |warning| (run, warning)));
    let mut shared: Vec<(&Warning, String)> = Vec::new();
    for (run, warning) in of_runs.filter(|(_, warning)| !matches!(warning, Warning::MarchStopped { .. })) {
        match shared.iter_mut().find(|(other, _)| *other == warning) {
            Some((_, names)) => *names = format!("{names}, {}", run.name()),
            None => shared.push((warning, run.name())),
        }
    }
    shared.into_iter().for_each(|(warning, names)| warn(format!("{names}: {warning}")));
    said.extend(model_in_use(context.document).map(|text| (text, quiet)));
    said
}

/// Draws a tab: its form, if it has a width, next to its plots, which scroll if necessary, above the time bar. If the
/// contact is refused, draws the reason instead.
pub fn page<T>(
    ui: &mut Ui,
    tab: &mut T,
    (name, form_width, refused): (&str, Option<f32>, Option<&'static str>),
    (context, commands): (&Context<'_>, &mut Commands),
    form: impl FnOnce(&mut T, &mut Ui, &mut Commands),
    pictures: impl FnOnce(&mut T, &mut Ui, &mut Commands),
) {
    if let Some(why) = refused {
        elsewhere(ui, context, why, commands);
        return;
    }
    follow(context, commands);
    ui.horizontal_top(|ui| {
        if let Some(width) = form_width {
            ui.vertical(|ui| {
                ui.set_width(width);
                let area = ScrollArea::vertical().id_salt(format!("{name} form")).auto_shrink(false);
                area.show(ui, |ui| form(tab, ui, commands));
            });
            ui.separator();
        }
        ui.vertical(|ui| {
            // Wide rows of the plots must not widen the bar.
            let width = ui.available_width();
            let height = (ui.available_height() - TIME_BAR).max(TIME_BAR);
            let area = ScrollArea::vertical().id_salt(name).auto_shrink(false).max_height(height);
            area.show(ui, |ui| pictures(tab, ui, commands));
            ui.scope(|ui| {
                ui.set_max_width(width);
                player(ui, context.transient, commands);
            });
        });
    });
}

/// Height of the time bar with the space above it.
const TIME_BAR: f32 = 32.0;

/// Draws the time bar: a slider over the computed time, and a button to play.
pub fn player(ui: &mut Ui, view: &TransientRuns, commands: &mut Commands) {
    let Some(setup) = &view.setup else { return };
    let playing = view.player.playing();
    let mut ask = |command| commands.push(Command::Transient(command));
    if playing {
        let seconds = ui.input(|i| i.stable_dt).min(0.1);
        ask(TransientCommand::PlayOn(f64::from(seconds)));
    }
    ui.horizontal(|ui| {
        let (name, tip) = if playing { ("Pause", "Pauses the display") } else { ("Play", "Play the profiles in time") };
        if ui.button(name).on_hover_text(tip).clicked() {
            ask(TransientCommand::TogglePlay);
        }
        let mut time = view.player.time();
        let text =
            format!("{{T}} = {}, {}", numbers::significant(time), numbers::duration(time * setup.time_scale_s()));
        let costs = costs(view);
        let room = if ui.available_width() > COSTS_FROM { 190.0 + COSTS } else { 190.0 };
        ui.spacing_mut().slider_width = (ui.available_width() - room).max(80.0);
        let response = ui.add(Slider::new(&mut time, 0.0..=view.player.end().max(f64::MIN_POSITIVE)).show_value(false));
        let response = named(ui, response, "Time T");
        if response.changed() {
            ask(TransientCommand::GoTo(time));
        }
        let tip = "Time of the displayed profiles, in units of a/u_m of the reference contact (2.22) and in seconds";
        let time = ui.horizontal(|ui| {
            ui.set_min_width(TIME);
            ui.label(rich(&text, 13.5, ui.visuals().text_color())).on_hover_text(tip);
        });
        if room > 190.0 {
            ui.weak(costs)
                .on_hover_text("Medians of the time per step, and how many times faster than the full system");
        }
        time.inner
    });
}

/// Minimum width of the tab to show computing times next to the time, and their width.
const COSTS_FROM: f32 = 780.0;
const COSTS: f32 = 330.0;
/// Width of the displayed time.
const TIME: f32 = 120.0;

/// Returns the time per step of each method, as text.
fn costs(view: &TransientRuns) -> String {
    let Some(first) = view.runs.first().map(Run::frame) else { return String::new() };
    let own = || view.runs.iter().filter(|run| run.frame() == first);
    let full = own().find(|run| run.by == MarchedBy::Full).and_then(Run::seconds_per_step);
    let said = |run: &Run| {
        let seconds = run.seconds_per_step()?;
        let name = match run.by {
            MarchedBy::Full => "full",
            MarchedBy::Reduced => "reduced",
            MarchedBy::Linearised(Weighting::DualTaylor) => "linearised",
            MarchedBy::Linearised(Weighting::Dissertation) => return None,
        };
        let faster = full.filter(|_| run.by != MarchedBy::Full).map(|full| faster(full / seconds));
        Some(format!("{name} {}{}", numbers::duration(seconds), faster.unwrap_or_default()))
    };
    own().filter_map(said).collect::<Vec<_>>().join("   ")
}

/// Returns a speed-up in brackets.
pub fn faster(times: f64) -> String {
    format!(" (×{}{})", numbers::THIN, numbers::digits(times, 2))
}

/// Returns the contact and the inputs of the runs on the screen, for the caption of a figure.
pub fn caption(view: &TransientRuns, system: UnitSystem) -> Option<String> {
    let setup = view.setup.as_ref()?;
    Some(format!("{}; {}", caption::contact(&setup.point, &setup.lubricant, system), export::inputs(setup)))
}
