//! Opening, saving and exporting: never blocks the window, never overwrites what the user did not name, never loses work unasked.

use super::controls::message_ui;
use super::document::{Document, document_from_scene, document_to_scene};
use super::state::State;
use egui::{Context, Id, Modal, RichText, TextEdit, Ui, ViewportCommand};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::time::{Duration, Instant};

/// Largest file that is read as a scene.
const LARGEST_SCENE_BYTES: u64 = 8 << 20;
/// Recent files kept.
const MOST_RECENT: usize = 8;
/// A system dialog that is gone sooner than this was never there.
const NO_DIALOG: Duration = Duration::from_millis(700);

/// What a path is asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum Purpose {
    /// Open a scene.
    Open,
    /// Save the scene.
    Save,
    /// Write a table.
    Csv {
        /// Its content.
        text: String,
    },
}

/// What waits for the answer about unsaved changes.
#[derive(Clone, Debug, PartialEq)]
pub enum Pending {
    /// A fresh document.
    New,
    /// The dialog to open a scene.
    OpenDialog,
    /// A certain scene.
    Open(PathBuf),
    /// The end.
    Quit,
}

/// The window that asks for a path, beside the system's own dialog.
struct PathWindow {
    purpose: Purpose,
    path: String,
    message: Option<String>,
    overwrite: Option<PathBuf>,
    browse: Option<(Receiver<Option<PathBuf>>, Instant)>,
    fresh: bool,
}

/// What the window knows about files.
pub struct Files {
    /// Where the document was opened from or saved to.
    pub path: Option<PathBuf>,
    /// Recently used scenes, newest first.
    pub recent: Vec<PathBuf>,
    /// A sentence about the last file action: what was done, or what went wrong.
    pub notice: Option<Result<String, String>>,
    /// Whether the system's file dialog is tried.
    pub native_dialogs: bool,
    saved: Document,
    window: Option<PathWindow>,
    pending: Option<Pending>,
    after_save: Option<Pending>,
    quit: bool,
}

impl Files {
    /// Nothing opened, nothing to lose.
    pub fn new(document: &Document) -> Self {
        Self {
            path: None,
            recent: Vec::new(),
            notice: None,
            native_dialogs: true,
            saved: document.clone(),
            window: None,
            pending: None,
            after_save: None,
            quit: false,
        }
    }

    /// Declares what is on disk, as a restored session does.
    pub fn set_saved(&mut self, saved: Document) {
        self.saved = saved;
    }

    /// What is on disk.
    pub fn saved(&self) -> &Document {
        &self.saved
    }

    /// Whether a window of this module is open.
    pub fn asks(&self) -> bool {
        self.window.is_some() || self.pending.is_some()
    }
}

impl State {
    /// Whether there is something to lose.
    pub fn dirty(&self) -> bool {
        self.document != *self.files.saved()
    }

    /// Does something that ends the present document, after asking when there is something to lose.
    pub fn request(&mut self, ctx: &Context, pending: Pending) {
        if self.dirty() {
            self.files.pending = Some(pending);
        } else {
            self.proceed(ctx, pending);
        }
    }

    fn proceed(&mut self, ctx: &Context, pending: Pending) {
        match pending {
            Pending::New => {
                self.replace_document(Document::default());
                self.files.saved = self.document.clone();
                self.files.path = None;
                self.files.notice = None;
            }
            Pending::OpenDialog => self.ask_path(ctx, Purpose::Open),
            Pending::Open(path) => self.open_path(&path),
            Pending::Quit => {
                self.files.quit = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
        }
    }

    /// Opens a scene. What is on the screen stays when it cannot be read.
    pub fn open_path(&mut self, path: &Path) {
        match read_scene(path) {
            Ok(document) => {
                self.replace_document(document);
                self.files.saved = self.document.clone();
                self.files.path = Some(path.to_owned());
                self.remember(path);
                self.files.notice = Some(Ok(format!("Opened {}", path.display())));
            }
            Err(message) => self.files.notice = Some(Err(message)),
        }
    }

    /// Saves to the known path or asks for one.
    pub fn save(&mut self, ctx: &Context) {
        match self.files.path.clone() {
            Some(path) => {
                if let Err(message) = self.save_to(&path) {
                    self.files.notice = Some(Err(message));
                }
            }
            None => self.ask_path(ctx, Purpose::Save),
        }
    }

    fn save_to(&mut self, path: &Path) -> Result<(), String> {
        let text = document_to_scene(&self.document)?;
        write_atomically(path, &text)?;
        self.files.saved = self.document.clone();
        self.files.path = Some(path.to_owned());
        self.remember(path);
        self.files.notice = Some(Ok(format!("Saved {}", path.display())));
        Ok(())
    }

    fn remember(&mut self, path: &Path) {
        self.files.recent.retain(|p| p != path);
        self.files.recent.insert(0, path.to_owned());
        self.files.recent.truncate(MOST_RECENT);
    }

    /// Asks for a path, by the system's dialog and by a text field for where there is none.
    pub fn ask_path(&mut self, ctx: &Context, purpose: Purpose) {
        let suggestion = match &purpose {
            Purpose::Open => String::new(),
            Purpose::Save => self.files.path.as_deref().unwrap_or(Path::new("contact.ron")).display().to_string(),
            Purpose::Csv { .. } => "profiles.csv".to_owned(),
        };
        let browse = self.files.native_dialogs.then(|| (browse(ctx, &purpose, &suggestion), Instant::now()));
        self.files.window =
            Some(PathWindow { purpose, path: suggestion, message: None, overwrite: None, browse, fresh: true });
    }

    /// The windows of this module, dropped files, and the question before closing.
    pub fn files_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let dropped: Vec<PathBuf> = ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_path_buf()).collect());
        if let Some(path) = dropped.into_iter().next() {
            self.request(&ctx, Pending::Open(path));
        }
        if ctx.input(|i| i.viewport().close_requested()) && self.dirty() && !self.files.quit {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.files.pending = Some(Pending::Quit);
        }
        self.browse_answer(&ctx);
        self.path_window_ui(&ctx);
        self.unsaved_ui(&ctx);
    }

    fn browse_answer(&mut self, ctx: &Context) {
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
                // The system's dialog has asked about overwriting already.
                window.overwrite = Some(path.clone());
                window.path = path.display().to_string();
                self.act_on_path(ctx);
            }
            None if at_once => {}
            None => self.files.window = None,
        }
    }

    fn path_window_ui(&mut self, ctx: &Context) {
        let Some(window) = &mut self.files.window else { return };
        let (title, action) = match window.purpose {
            Purpose::Open => ("Open a scene", "Open"),
            Purpose::Save => ("Save the scene", "Save"),
            Purpose::Csv { .. } => ("Export the data as CSV", "Export"),
        };
        let waiting = window.browse.is_some();
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
            if let Some(message) = &window.message {
                message_ui(ui, message);
            }
            if waiting {
                ui.label(
                    RichText::new("The system's file dialog is open; a path typed here does the same.").small().weak(),
                );
            }
            ui.add_space(4.0);
            ui.horizontal(|ui| {
                let exists = window.overwrite.is_some() && window.purpose != Purpose::Open;
                act |= ui.button(if exists { "Replace the file" } else { action }).clicked();
                if !waiting {
                    again =
                        ui.button("Browse…").on_hover_text("The system's file dialog, where there is one").clicked();
                }
                close = ui.button("Cancel").clicked();
            });
        });
        if again {
            let (purpose, path) = (window.purpose.clone(), window.path.clone());
            window.browse = Some((browse(ctx, &purpose, &path), Instant::now()));
        }
        if act {
            self.act_on_path(ctx);
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
        if window.purpose != Purpose::Open && path.exists() && !known && window.overwrite.as_deref() != Some(&path) {
            window.message = Some("a file of this name exists; press again to replace it".to_owned());
            window.overwrite = Some(path);
            return;
        }
        let result = match window.purpose.clone() {
            Purpose::Open => {
                self.open_path(&path);
                match self.files.notice.take() {
                    Some(Err(message)) => Err(message),
                    other => {
                        self.files.notice = other;
                        Ok(())
                    }
                }
            }
            Purpose::Save => self.save_to(&path),
            Purpose::Csv { text } => write_atomically(&path, &text)
                .map(|()| self.files.notice = Some(Ok(format!("Exported {}", path.display())))),
        };
        match (result, &mut self.files.window) {
            (Ok(()), _) => {
                self.files.window = None;
                if let Some(next) = self.files.after_save.take() {
                    self.proceed(ctx, next);
                }
            }
            (Err(message), Some(window)) => {
                window.overwrite = None;
                window.message = Some(message);
            }
            (Err(message), None) => self.files.notice = Some(Err(message)),
        }
    }

    fn unsaved_ui(&mut self, ctx: &Context) {
        let Some(pending) = self.files.pending.clone() else { return };
        let (mut save, mut discard, mut cancel) = (false, false, false);
        let response = Modal::new(Id::unique("unsaved changes")).show(ctx, |ui| {
            ui.set_width(380.0);
            ui.heading("Save the changes?");
            ui.label("The operating point or its settings have changed since they were last saved.");
            ui.add_space(6.0);
            ui.horizontal(|ui| {
                save = ui.button("Save…").clicked();
                discard = ui.button("Discard changes").clicked();
                cancel = ui.button("Cancel").clicked();
            });
        });
        if discard {
            self.files.pending = None;
            self.proceed(ctx, pending);
        } else if save {
            self.files.pending = None;
            self.save(ctx);
            if self.files.window.is_some() {
                self.files.after_save = Some(pending);
            } else if !self.dirty() {
                self.proceed(ctx, pending);
            }
        } else if cancel || response.should_close() {
            self.files.pending = None;
        }
    }
}

/// The system's dialog in its own thread.
fn browse(ctx: &Context, purpose: &Purpose, suggestion: &str) -> Receiver<Option<PathBuf>> {
    let (sender, receiver) = channel();
    let (ctx, purpose, suggestion) = (ctx.clone(), purpose.clone(), PathBuf::from(suggestion));
    let run = move || {
        let name = suggestion.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let mut dialog = match purpose {
            Purpose::Csv { .. } => rfd::FileDialog::new().add_filter("Table", &["csv"]),
            _ => rfd::FileDialog::new().add_filter("Scene", &["ron"]),
        };
        if let Some(folder) = suggestion.parent().filter(|p| p.is_dir()) {
            dialog = dialog.set_directory(folder);
        }
        let answer = match purpose {
            Purpose::Open => dialog.pick_file(),
            _ => dialog.set_file_name(name).save_file(),
        };
        // The window may be closed by now: then nobody waits for the answer.
        if sender.send(answer).is_ok() {
            ctx.request_repaint();
        }
    };
    // Without a thread there is no system dialog: the receiver is disconnected at once and the text field remains.
    let _handle = std::thread::Builder::new().name("file dialog".into()).spawn(run);
    receiver
}

fn read_scene(path: &Path) -> Result<Document, String> {
    let shown = path.display();
    let metadata = std::fs::metadata(path).map_err(|e| format!("{shown} cannot be opened: {e}"))?;
    if !metadata.is_file() || metadata.len() > LARGEST_SCENE_BYTES {
        return Err(format!("{shown} is no scene: a file of at most 8 MB is expected"));
    }
    let text = std::fs::read_to_string(path).map_err(|e| format!("{shown} cannot be read: {e}"))?;
    document_from_scene(&text).map_err(|e| format!("{shown}: {e}"))
}

/// Writes the whole file or leaves what was there.
///
/// # Errors
/// A sentence that names the path.
pub fn write_atomically(path: &Path, text: &str) -> Result<(), String> {
    let failed = |e: std::io::Error| format!("{} cannot be written: {e}", path.display());
    let name = path.file_name().ok_or_else(|| format!("{} names no file", path.display()))?;
    let mut temporary_name = std::ffi::OsString::from(".");
    temporary_name.push(name);
    temporary_name.push(format!(".{}.part", std::process::id()));
    let temporary = path.with_file_name(temporary_name);
    let written = std::fs::File::create(&temporary)
        .and_then(|mut file| file.write_all(text.as_bytes()).and_then(|()| file.sync_all()))
        .and_then(|()| std::fs::rename(&temporary, path));
    written.map_err(|e| {
        // What could not be finished is of no use; if even this fails there is nothing left to do.
        let _leftover = std::fs::remove_file(&temporary);
        failed(e)
    })
}
