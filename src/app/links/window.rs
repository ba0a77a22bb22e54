//! Window to paste a link into.

use super::fragment::Fragment;
use crate::app::command::Command;
use crate::app::context::Commands;
use crate::app::controls::reserved_message;
use egui::{Context, Id, Modal, TextEdit};

/// State of the window.
#[derive(Default)]
pub struct LinkWindow {
    text: Option<String>,
    message: Option<String>,
    fresh: bool,
}

impl LinkWindow {
    /// Opens the window.
    pub fn open(&mut self) {
        *self = Self { text: Some(String::new()), message: None, fresh: true };
    }

    /// Returns true if the window is open.
    pub fn is_open(&self) -> bool {
        self.text.is_some()
    }

    /// Draws the window.
    pub fn ui(&mut self, ctx: &Context, commands: &mut Commands) {
        let Some(text) = &mut self.text else { return };
        let (mut open, mut close) = (false, false);
        let response = Modal::new(Id::unique("link")).show(ctx, |ui| {
            ui.set_width(440.0);
            ui.heading("Open a link");
            let label = ui.label("An address with #, or its part from # on");
            let edit = ui.add(TextEdit::singleline(text).desired_width(f32::INFINITY)).labelled_by(label.id);
            if std::mem::take(&mut self.fresh) {
                edit.request_focus();
            }
            if edit.changed() {
                self.message = None;
            }
            open = edit.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
            // The buttons stay where they are while a message appears.
            reserved_message(ui, self.message.as_deref());
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                open |= ui.button("Open").clicked();
                close = ui.button("Cancel").clicked();
            });
        });
        if open {
            match Fragment::read(text) {
                Ok(_) => {
                    commands.push(Command::OpenFragment(text.clone()));
                    close = true;
                }
                Err(why) => self.message = Some(why.to_string()),
            }
        }
        if close || response.should_close() {
            *self = Self::default();
        }
    }
}
