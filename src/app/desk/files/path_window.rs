//! Window to choose a path. It opens the file dialog of the system. If there is none, it says so and offers a text
//! field.

use crate::app::controls::{either_button, reserved_message};
use crate::app::desk::Desk;
use crate::app::notice::Notice;
use crate::app::purpose::{Purpose, Words, Written};
use crate::app::refusal::Refusal;
use crate::host::clock::Stopwatch;
use crate::host::wanted::Wanted;
use crate::host::{dialogs, files};
use crate::scene::atomic_file;
use egui::{Context, Id, Modal, RichText, TextEdit};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError};
use std::time::Duration;

/// A system dialog that closes faster than this was never shown.
const NO_DIALOG: Duration = Duration::from_millis(700);

/// State of the window.
pub struct PathWindow {
    purpose: Purpose,
    path: String,
    message: Option<String>,
    overwrite: Option<PathBuf>,
    browse: Option<(Receiver<Option<PathBuf>>, Stopwatch)>,
    fresh: bool,
    /// True if the system has no file dialog.
    no_dialog: bool,
}

impl Desk {
    /// Requests a path by the file dialog of the system, or by a text field if there is none.
    pub fn ask_path(&mut self, ctx: &Context, purpose: Purpose) {
        let known = self.files.path.as_deref().filter(|_| purpose == Purpose::Save);
        let suggestion = known.unwrap_or(Path::new(purpose.words().name)).display().to_string();
        let browse = self.files.native_dialogs.then(|| (browse(ctx, &purpose, &suggestion), Stopwatch::start()));
        self.files.window = Some(PathWindow {
            purpose,
            path: suggestion,
            message: None,
            overwrite: None,
            browse,
            fresh: true,
            no_dialog: false,
        });
    }

    pub(super) fn browse_answer(&mut self, ctx: &Context) {
        let Some(window) = &mut self.files.window else { return };
        let Some((receiver, since)) = &window.browse else { return };
        let answer = match receiver.try_recv() {
            Ok(answer) => answer,
            Err(TryRecvError::Empty) => return,
            Err(TryRecvError::Disconnected) => None,
        };
        let at_once = since.elapsed() < NO_DIALOG;
        window.browse = None;
        match answer {
            Some(path) => {
                // The system dialog has already confirmed overwriting.
                window.overwrite = Some(path.clone());
                window.path = path.display().to_string();
                self.act_on_path(ctx);
            }
            None if at_once && dialogs::TYPED => window.no_dialog = true,
            None => self.files.window = None,
        }
    }

    pub(super) fn path_window_ui(&mut self, ctx: &Context) {
        let Some(window) = &mut self.files.window else { return };
        let Words { title, action, .. } = window.purpose.words();
        if window.browse.is_some() {
            self.waiting_ui(ctx);
            return;
        }
        let no_dialog = window.no_dialog;
        let (mut act, mut close, mut again) = (false, false, false);
        let response = Modal::new(Id::unique("path window")).show(ctx, |ui| {
            ui.set_width(440.0);
            ui.heading(title);
            let label = ui.label("Path of the file");
            let edit =
                ui.add(TextEdit::singleline(&mut window.path).desired_width(f32::INFINITY)).labelled_by(label.id);
            if std::mem::take(&mut window.fresh) {
                edit.request_focus();
            }
            if edit.changed() {
                window.overwrite = None;
                window.message = None;
            }
            if edit.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
                act = true;
            }
            // The buttons stay where they are while a message appears or a path is typed.
            reserved_message(ui, window.message.as_deref());
            if no_dialog {
                ui.label(RichText::new("The system has no file dialog here: type the path.").small().weak());
            }
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                let exists = window.overwrite.is_some() && !window.purpose.reads();
                act |= match window.purpose.reads() {
                    true => ui.button(action).clicked(),
                    false => either_button(ui, [action, "Replace the file"], exists).clicked(),
                };
                again = ui.button("Browse…").on_hover_text("The file dialog of the system, if there is one").clicked();
                close = ui.button("Cancel").clicked();
            });
        });
        if again {
            let (purpose, path) = (window.purpose.clone(), window.path.clone());
            window.browse = Some((browse(ctx, &purpose, &path), Stopwatch::start()));
        }
        if act {
            self.act_on_path(ctx);
        } else if close || response.should_close() {
            self.files.window = None;
            self.files.after_save = None;
        }
    }

    /// Draws the window while the system dialog is open. It offers to continue if that dialog does not appear.
    fn waiting_ui(&mut self, ctx: &Context) {
        let Some(window) = &mut self.files.window else { return };
        let (mut typed, mut close) = (false, false);
        let response = Modal::new(Id::unique("system dialog")).show(ctx, |ui| {
            ui.set_width(300.0);
            ui.label("The file dialog is open.");
            ui.horizontal(|ui| {
                typed = dialogs::TYPED && ui.button("Type a path instead").clicked();
                close = ui.button("Cancel").clicked();
            });
        });
        if typed {
            window.browse = None;
        } else if close || response.should_close() {
            self.files.window = None;
            self.files.after_save = None;
        }
    }

    fn act_on_path(&mut self, ctx: &Context) {
        let Some(window) = &mut self.files.window else { return };
        let path = PathBuf::from(window.path.trim());
        if path.as_os_str().is_empty() {
            window.message = Some("a path is needed".to_owned());
            return;
        }
        let known = self.files.path.as_deref() == Some(path.as_path()) && window.purpose == Purpose::Save;
        if files::exists(&path) && !window.purpose.reads() && !known && window.overwrite.as_deref() != Some(&path) {
            window.message = Some("a file of this name exists; press again to replace it".to_owned());
            window.overwrite = Some(path);
            return;
        }
        let result = match window.purpose.clone() {
            Purpose::Open => self.open_path(&path),
            Purpose::Save => self.save_to(&path),
            Purpose::Inputs => self
                .document
                .read_inputs(&path)
                .map(|()| self.files.notice = Some(Notice::Done(format!("Read {}", path.display())))),
            Purpose::Profile(k) => self
                .document
                .read_profile(k, &path)
                .map(|()| self.files.notice = Some(Notice::Done(format!("Read {}", path.display())))),
            Purpose::Cases => self.load_cases.read(&path),
            Purpose::Measured => self.measured.read(&path),
            Purpose::ComparedModel => self.tabs.training.work.add_beside(self.answers.store(), &path),
            Purpose::Write(what, bytes) => {
                let done = if what == Written::Model { "Saved the model" } else { "Exported" };
                atomic_file::replace(&path, &bytes).map_err(Refusal::from).map(|()| {
                    self.tabs.training.work.saved(&bytes);
                    self.files.notice = Some(Notice::Done(format!("{done} {}", path.display())));
                })
            }
        };
        match (result, &mut self.files.window) {
            (Ok(()), _) => {
                self.files.window = None;
                if let Some(next) = self.files.after_save.take() {
                    self.request(ctx, next);
                }
            }
            (Err(message), Some(window)) => {
                window.overwrite = None;
                window.message = Some(message.to_string());
            }
            (Err(why), None) => self.files.notice = Some(Notice::wrong(why)),
        }
    }
}

/// Opens the file dialog of the system.
fn browse(ctx: &Context, purpose: &Purpose, suggestion: &str) -> Receiver<Option<PathBuf>> {
    let Words { files, endings, .. } = purpose.words();
    let wanted = Wanted { reads: purpose.reads(), files, endings, suggestion: PathBuf::from(suggestion) };
    let ctx = ctx.clone();
    dialogs::ask(wanted, move || ctx.request_repaint())
}
