//! Training tab: specification of a reduced model, the running training, and the comparison of its model.

use super::trainings::{Training, TrainingCommand};
use super::{charts, comparison_view, form};
use crate::app::command::Command;
use crate::app::context::{Commands, Context};
use crate::app::controls::{message_ui, named, sentence, warning_ui};
use crate::app::form::LastField;
use crate::app::notice::Notice;
use crate::app::numbers;
use crate::app::purpose::{Purpose, Written};
use crate::app::tabs::training::{Made, Running};
use crate::app::tabs::{About, View};
use crate::engine::job::Standing;
use egui::{Button, Label, ProgressBar, ScrollArea, Ui};

/// Width of the form.
const FORM_WIDTH: f32 = 316.0;

/// Training tab with the state of its form.
#[derive(Default)]
pub struct TrainingTab {
    /// Title while it is typed.
    pub title: Option<String>,
    /// Field that was changed last.
    pub last: LastField,
    /// Trainings and their results.
    pub work: Training,
}

const ABOUT: About = About {
    keywords: "snapshots model plan range train own reduced",
    page: "training.md",
    has_units: false,
    why: "A reduced model is trained from full solutions, its snapshots, of contacts all over a range. A plan that \
          always adds the contact with the worst approximation needs the fewest snapshots. Outside its range a model \
          is not valid, so choose the range for the contacts that you need.",
};

impl View for TrainingTab {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn ui(&mut self, ui: &mut Ui, context: &Context<'_>, commands: &mut Commands) {
        ui.horizontal_top(|ui| {
            ui.vertical(|ui| {
                ui.set_width(FORM_WIDTH);
                let area = ScrollArea::vertical().id_salt("training form").auto_shrink(false);
                area.show(ui, |ui| form::ui(ui, self, context, commands));
            });
            ui.separator();
            ui.vertical(|ui| {
                let area = ScrollArea::vertical().id_salt("training").auto_shrink(false);
                area.show(ui, |ui| results(ui, &self.work, context, commands));
            });
        });
    }

    fn receive(&mut self) {
        self.work.receive();
    }

    fn jobs(&self, _: &Context<'_>) -> Vec<Standing> {
        self.work.standing().into_iter().collect()
    }

    fn stop(&mut self) {
        self.work.stop();
    }
}

fn results(ui: &mut Ui, training: &Training, context: &Context<'_>, commands: &mut Commands) {
    let (top, height) = (ui.cursor().top(), ui.available_height());
    buttons(ui, training, context, commands);
    status(ui, training);
    comparison_view::ui(ui, training, commands);
    charts::key(ui, &training.chart);
    let searches = training.spec.as_ref().is_some_and(|spec| spec.plan.searches());
    let rest = (height - (ui.cursor().top() - top) - 12.0).max(300.0);
    let lower = if searches { (0.34 * rest).max(115.0) } else { 0.0 };
    charts::plane(ui, training, context, rest - lower);
    if searches {
        charts::indicator(ui, training, context, lower);
    }
}

fn buttons(ui: &mut Ui, training: &Training, context: &Context<'_>, commands: &mut Commands) {
    use TrainingCommand as C;
    let runs = training.standing().is_some();
    let mut button = |ui: &mut Ui, on: bool, name: &str, tip: &str, command: Command| {
        button(ui, commands, on, (name, tip), command);
    };
    ui.horizontal_wrapped(|ui| {
        if runs {
            let tip =
                "Stops the job. A training keeps its full solutions and makes a model of them; a second click omits \
                 the model";
            button(ui, true, "Stop", tip, Command::Training(C::Stop));
        } else {
            let free = !training.left_behind;
            let tip = if free {
                "Computes the full solutions and makes a model of them in the background"
            } else {
                "First resume or discard the unfinished training"
            };
            button(ui, free, "Start training", tip, Command::Train);
        }
        if training.unfinished.is_some() {
            let tip = "Resumes the training; the model is the same as without the stop";
            button(ui, !runs, "Resume training", tip, Command::Training(C::Resume));
            button(ui, !runs, "Discard…", "Discards the unfinished training", Command::DiscardTraining);
        }
    });
    if let Some(made) = &training.made {
        made_ui(ui, (training, made), context, commands);
    }
    compare_ui(ui, training, context, commands);
}

/// Draws a button that submits a command.
fn button(ui: &mut Ui, commands: &mut Commands, on: bool, (name, tip): (&str, &str), command: Command) {
    let button = ui.add_enabled(on, Button::new(name)).on_hover_text(tip).on_disabled_hover_text(tip);
    if button.clicked() {
        commands.push(command);
    }
}

/// Draws the actions on the trained model.
fn made_ui(ui: &mut Ui, (training, made): (&Training, &Made), context: &Context<'_>, commands: &mut Commands) {
    use TrainingCommand as C;
    let mut button = |ui: &mut Ui, on: bool, name: &str, tip: &str, command: Command| {
        button(ui, commands, on, (name, tip), command);
    };
    ui.horizontal_wrapped(|ui| {
        let used = training.uses_made(context.answers);
        let tip = "The picture, the badge and all tabs use it from now on";
        button(ui, !used, "Use this model", tip, Command::Training(C::UseMade));
        if used {
            let tip = "Uses the previous model again";
            button(ui, true, "Restore previous model", tip, Command::Training(C::UseFormer));
        }
        let save = Command::Ask(Purpose::Write(Written::Model, made.bytes.clone()));
        button(ui, true, "Save model…", "Writes it as a .rom file", save);
        let tip = "Discards this model; until then the session’s folder stores it";
        button(ui, !made.saved, "Discard model…", tip, Command::ThrowModelAway);
    });
}

/// Draws the choice of models to compare.
fn compare_ui(ui: &mut Ui, training: &Training, context: &Context<'_>, commands: &mut Commands) {
    ui.horizontal_wrapped(|ui| {
        let several = training.comparable(context.answers, context.document).len() > 1;
        let ready = several && training.standing().is_none();
        let tip = match several {
            true => "Size, time and errors of all models at the same random contacts, against full solutions",
            false => "Another model of this kind of contact is needed: train one, or add one from a file",
        };
        button(ui, commands, ready, ("Compare models", tip), Command::CompareModels);
        let tip = "Reads the model of a .rom file for the comparison alone: the picture stays with the one in use";
        button(ui, commands, true, ("Add a model…", tip), Command::Ask(Purpose::ComparedModel));
        for (k, (name, model)) in training.beside.iter().enumerate() {
            let serves = context.document.training_spec().is_some_and(|spec| spec.is_of(model));
            ui.add_enabled(serves, Label::new(name))
                .on_hover_text(&model.title)
                .on_disabled_hover_text("It is for another kind of contact and is omitted");
            let cross = ui.small_button("×").on_hover_text("Removes it from the comparison");
            if named(ui, cross, &format!("Leave out {name}")).clicked() {
                commands.push(Command::Training(TrainingCommand::LeaveOut(k)));
            }
        }
    });
}

fn status(ui: &mut Ui, training: &Training) {
    for notice in &training.notices {
        match notice {
            Notice::Done(text) => {
                ui.label(sentence(text));
            }
            Notice::Short(text) => warning_ui(ui, text),
            Notice::Wrong(text) => message_ui(ui, text),
        }
    }
    if let Some(standing) = training.standing() {
        standing_ui(ui, standing, training.job());
        return;
    }
    if let Some(made) = &training.made {
        let model = &made.model;
        let windows = model.windows.len();
        let largest =
            |size: fn(&crate::solver::reduced::Window) -> usize| model.windows.iter().map(size).max().unwrap_or(0);
        let text = format!(
            "{}, {} pressure modes, {} sampled equations, {} MB",
            if windows == 1 { "One local model".to_owned() } else { format!("{windows} local models") },
            largest(|w| w.pressure.count()),
            largest(|w| w.sampled_rows.len()),
            numbers::digits(made.bytes.len() as f64 / 1e6, 2)
        );
        ui.weak(text).on_hover_text(model.log.join("\n"));
    }
    if training.left_behind
        && let Some(unfinished) = &training.unfinished
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

/// Draws the running job, its progress, and its remaining time.
fn standing_ui(ui: &mut Ui, standing: Standing, running: Option<&Running>) {
    let Standing { stage, done, total, .. } = standing;
    let count = if total > 0 { format!("{done} of {total}") } else { String::new() };
    let (stage, fraction) = (sentence(&stage), done as f32 / total.max(1) as f32);
    let stopping = running.is_some_and(|running| running.job.stopping());
    ui.label(if stopping { format!("Stopping. {stage}") } else { stage });
    let width = ui.available_width().min(420.0);
    let bar = ui.add(ProgressBar::new(fraction).text(count).desired_width(width));
    named(ui, bar, "Progress of the training");
    let Some(running) = running else { return };
    let solved = running.chart.solved.len();
    let left = match running.time_left() {
        Some(seconds) if seconds >= 1.0 && !stopping => {
            let word = if running.fewer { "at most" } else { "about" };
            format!("; {word} {} left", numbers::remaining(seconds))
        }
        _ => String::new(),
    };
    let of = if running.fewer { "at most " } else { "" };
    ui.weak(format!("{solved} full solutions of {of}{}{left}", running.most));
}
