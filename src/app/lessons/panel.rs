//! Panel of the lessons. It shows what to do, points at the control, detects that it was done, and shows what to
//! notice.

use super::goal::{Goal, OnScreen};
use super::text::Lesson;
use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::{described, named, point_at};
use crate::app::document::Edit;
use crate::app::tab::Tab;
use crate::app::theme::Palette;
use egui::{Button, RichText, ScrollArea, Ui, vec2};
use egui_commonmark::{CommonMarkCache, CommonMarkViewer};
use std::sync::LazyLock;

/// Source texts of the built-in lessons.
const TEXTS: [&str; 14] = [
    include_str!("../../../assets/lessons/01_rigid_to_hertz.md"),
    include_str!("../../../assets/lessons/02_the_spike.md"),
    include_str!("../../../assets/lessons/03_four_regimes.md"),
    include_str!("../../../assets/lessons/04_when_formulas_fail.md"),
    include_str!("../../../assets/lessons/05_horseshoe.md"),
    include_str!("../../../assets/lessons/06_from_ball_to_roller.md"),
    include_str!("../../../assets/lessons/07_stribeck_and_traction.md"),
    include_str!("../../../assets/lessons/08_shear_thinning.md"),
    include_str!("../../../assets/lessons/09_a_load_that_breathes.md"),
    include_str!("../../../assets/lessons/10_what_a_basis_is.md"),
    include_str!("../../../assets/lessons/11_when_to_trust.md"),
    include_str!("../../../assets/lessons/12_starvation.md"),
    include_str!("../../../assets/lessons/13_heat.md"),
    include_str!("../../../assets/lessons/14_boundary_to_full_film.md"),
];

/// A test checks that none of them is refused.
pub(super) static LESSONS: LazyLock<Vec<Lesson>> =
    LazyLock::new(|| TEXTS.iter().flat_map(|text| Lesson::read(text)).collect());

/// Maximum number of lessons of the user.
#[cfg(feature = "desktop")]
const MOST_OWN: usize = 100;
/// Least width of the panel next to the tabs \[points\].
const WIDTH: f32 = 300.0;
/// Initial height of the panel below the tabs \[points\].
pub const HEIGHT: f32 = 190.0;
/// Width of the window from which the panel fits next to adjacent tabs \[points\].
pub const BESIDE: f32 = 1600.0;

/// List of lessons, and the running one.
#[derive(Default)]
pub struct Lessons {
    /// True if the list or a lesson is shown.
    open: bool,
    own: Vec<Lesson>,
    /// Files of the user that are no lessons, with the reasons.
    refused: Vec<String>,
    now: Option<Standing>,
    cache: CommonMarkCache,
}

/// Running lesson.
struct Standing {
    lesson: Lesson,
    step: usize,
    /// True once the conditions of the step were met. It stays true.
    done: bool,
}

/// Returns the number of built-in lessons.
pub fn count() -> usize {
    LESSONS.len()
}

impl Lessons {
    /// Shows or hides the list.
    pub fn toggle(&mut self) {
        self.open = !self.open;
    }

    /// Returns true if the panel is visible.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Closes the panel. The running lesson keeps its step.
    pub fn close(&mut self) {
        self.open = false;
    }

    /// Reads lessons of the user: files ending in `.md` in a folder, in the order of their names.
    #[cfg(feature = "desktop")]
    pub fn look_in(&mut self, folder: &std::path::Path) {
        let Ok(entries) = std::fs::read_dir(folder) else { return };
        let mut files: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        files.retain(|path| path.extension().is_some_and(|ending| ending == "md"));
        files.sort();
        (self.own, self.refused) = (Vec::new(), Vec::new());
        for path in files.into_iter().take(MOST_OWN) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&path).map_err(|error| error.to_string());
            match text.and_then(|text| Lesson::read(&text).map_err(|error| error.to_string())) {
                Ok(lesson) => self.own.push(lesson),
                Err(why) => self.refused.push(format!("{name}: {why}")),
            }
        }
    }

    /// Draws the panel.
    ///
    /// `finished` has the titles of the lessons that were finished.
    pub fn ui(&mut self, ui: &mut Ui, screen: &OnScreen, finished: &[String], commands: &mut Commands) {
        point_at(ui.ctx(), None);
        if self.now.is_some() {
            self.lesson_ui(ui, screen, commands);
        } else {
            self.list_ui(ui, finished, commands);
        }
    }

    /// Returns the lesson that runs.
    pub fn running(&self) -> Option<&Lesson> {
        self.now.as_ref().map(|now| &now.lesson)
    }

    fn list_ui(&mut self, ui: &mut Ui, finished: &[String], commands: &mut Commands) {
        ui.horizontal(|ui| {
            ui.heading("Lessons");
            self.close_ui(ui);
        });
        ui.weak("Each lesson starts from its own contact. Undo restores yours.");
        let mut chosen = None;
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            for (k, lesson) in LESSONS.iter().chain(&self.own).enumerate() {
                let steps = lesson.steps.len();
                let width = vec2(ui.available_width(), 0.0);
                let title = format!("{}. {}", k + 1, lesson.title);
                let done = finished.contains(&lesson.title);
                let state = if done { "done".to_owned() } else { format!("{steps} steps") };
                let button = Button::new(&title).wrap().min_size(width).shortcut_text(state);
                let response = ui.add(button);
                let response = described(ui, response, if done { "done" } else { "" });
                if named(ui, response, &title).on_hover_text(&lesson.about).clicked() {
                    chosen = Some(lesson.clone());
                }
            }
            for why in &self.refused {
                ui.colored_label(Palette::of(ui).wrong, why);
            }
        });
        if let Some(lesson) = chosen {
            self.begin(lesson, commands);
        }
    }

    /// Opens a lesson by its number, from 1. Returns the commands that it needs.
    pub fn open_lesson(&mut self, number: usize) -> Vec<Command> {
        let mut commands = Commands::default();
        if let Some(lesson) = number.checked_sub(1).and_then(|k| LESSONS.get(k)) {
            self.open = true;
            self.begin(lesson.clone(), &mut commands);
        }
        commands.take()
    }

    fn begin(&mut self, lesson: Lesson, commands: &mut Commands) {
        commands.push(Command::Go(Tab::Profiles));
        commands.edit(Edit::Contact(lesson.point, Box::new(lesson.lubricant.laws)), "lesson");
        // Locked axes are fitted to the contact of the lesson.
        commands.push(Command::FitPlots);
        self.now = Some(Standing { lesson, step: 0, done: false });
    }

    fn close_ui(&mut self, ui: &mut Ui) {
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let button = ui.button("Close");
            if named(ui, button, "Close the lessons").clicked() {
                self.open = false;
            }
        });
    }

    fn lesson_ui(&mut self, ui: &mut Ui, screen: &OnScreen, commands: &mut Commands) {
        let mut leave = false;
        let wide = ui.available_width() > 2.0 * WIDTH;
        let title = self.now.as_ref().map_or_else(String::new, |now| now.lesson.title.clone());
        ui.horizontal(|ui| {
            leave = ui.button("All lessons").clicked();
            let tip = "A page for print: questions with space for answers, and the solutions on a second page";
            if ui.button("Worksheet…").on_hover_text(tip).clicked() {
                commands.push(Command::ExportWorksheet);
            }
            if wide {
                ui.heading(&title);
            }
            self.close_ui(ui);
        });
        if !wide {
            ui.heading(&title);
        }
        let Self { now, cache, .. } = self;
        let Some(Standing { lesson, step, done }) = now else { return };
        let count = lesson.steps.len();
        let Some(present) = lesson.steps.get(*step) else { return };
        *done |= present.goals.iter().all(|goal| goal.holds(screen));
        if !*done {
            point_at(ui.ctx(), present.control.as_deref().map(super::goal::control));
        }
        // The buttons are below the text, at a fixed position.
        let below = 2.6 * ui.spacing().interact_size.y;
        let height = (ui.available_height() - below).max(60.0);
        ScrollArea::vertical().id_salt(*step).max_height(height).auto_shrink(false).show(ui, |ui| {
            if *step == 0 {
                CommonMarkViewer::new().show(ui, cache, &lesson.about);
                ui.add_space(6.0);
            }
            ui.label(RichText::new(&present.title).strong());
            CommonMarkViewer::new().show(ui, cache, &present.text);
            for tab in present.goals.iter().filter_map(Goal::tab) {
                if ui.button(format!("Open {}", tab.title())).clicked() {
                    commands.push(Command::Go(tab));
                }
            }
            ui.add_space(6.0);
            if *done {
                let color = Palette::of(ui).verified;
                ui.label(
                    RichText::new(if present.goals.is_empty() { "To be seen" } else { "Done" }).strong().color(color),
                );
                ui.label(&present.seen);
            }
        });
        ui.separator();
        let mut target = *step;
        ui.horizontal(|ui| {
            if ui.add_enabled(*step > 0, Button::new("Back")).clicked() {
                target = *step - 1;
            }
            ui.weak(format!("Step {} of {count}", *step + 1));
            let last = *step + 1 == count;
            let name = if last { "Finish" } else { "Next" };
            let next = ui.button(if *done { RichText::new(name).strong() } else { RichText::new(name) });
            if next.clicked() {
                if last {
                    commands.push(Command::FinishLesson(lesson.title.clone()));
                    leave = true;
                } else {
                    target = *step + 1;
                }
            }
        });
        if target != *step {
            (*step, *done) = (target, false);
            ui.ctx().request_repaint();
        }
        if leave {
            self.now = None;
        }
    }
}
