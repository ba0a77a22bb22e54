//! Opening, saving and exporting: never blocks the window, never overwrites what the user did not name, never loses
//! work unasked.

mod losses;
mod path_window;

use super::{Desk, Opened};
use crate::app::document::Document;
use crate::app::panels::headline::Headline;
use crate::app::purpose::Purpose;
use crate::app::tab::Tab;
use crate::app::tabs::training::TrainingCommand;
use crate::engine::campaign::Folder;
use crate::scene::{Scene, Study};
use egui::{Context, Ui, ViewportCommand};
use path_window::PathWindow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Recent files kept.
const MOST_RECENT: usize = 8;
/// What waits for the answer about unsaved changes.
#[derive(Clone, Debug, PartialEq)]
pub enum Pending {
    /// A fresh document.
    New,
    /// The dialog to open a scene.
    OpenDialog,
    /// A certain scene.
    Open(PathBuf),
    /// A scene that lies nowhere yet.
    OpenScene(Arc<Scene>),
    /// The end.
    Quit,
    /// Another training.
    Train,
    /// The end of a training that was stopped.
    DiscardTraining,
    /// The end of a model that was trained.
    ThrowModelAway,
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

/// The tab that answers a scene's question.
fn answering(study: &Study) -> Tab {
    match study {
        Study::Point(_) => Tab::Profiles,
        Study::Training(_) => Tab::Training,
        Study::Transient(_) => Tab::Transient,
        _ => Tab::Results,
    }
}

fn is_model(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "rom")
}

impl Desk {
    /// Whether there is something to lose.
    pub fn dirty(&self) -> bool {
        self.document != *self.files.saved()
    }

    /// Does something that ends what there is, after asking when there is something to lose.
    pub fn request(&mut self, ctx: &Context, pending: Pending) {
        if self.losses(&pending).is_empty() {
            self.proceed(ctx, pending);
        } else {
            self.files.pending = Some(pending);
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
            Pending::Open(path) => {
                if let Err(message) = self.open_path(&path) {
                    self.files.notice = Some(Err(message));
                }
            }
            Pending::OpenScene(scene) => {
                if let Err(message) = self.open_untitled(&scene) {
                    self.files.notice = Some(Err(message));
                }
            }
            Pending::Quit => {
                self.files.quit = true;
                ctx.send_viewport_cmd(ViewportCommand::Close);
            }
            Pending::Train => self.tabs.training.work.start(ctx, &self.document),
            Pending::DiscardTraining => {
                self.tabs.training.work.execute(ctx, &mut self.answers, TrainingCommand::Discard)
            }
            Pending::ThrowModelAway => {
                self.tabs.training.work.execute(ctx, &mut self.answers, TrainingCommand::ThrowAway)
            }
        }
    }

    /// Opens a scene, watches a campaign (its folder, or `campaign.ron` in it), or puts a reduced model (`.rom`) in use.
    ///
    /// # Errors
    /// A sentence when it cannot be read; what is on the screen stays.
    pub fn open_path(&mut self, path: &Path) -> Result<(), String> {
        if is_model(path) {
            let model = self.answers.store.model_of_file(path).map_err(|e| e.to_string())?;
            self.answers.use_model(model);
            self.files.notice = Some(Ok(format!("Using the model {}", path.display())));
            return Ok(());
        }
        if let Some(folder) = Folder::meant(path) {
            let folder = Folder::open(&folder).map_err(|e| e.to_string())?;
            self.open_path(&folder.scene_path())?;
            self.files.notice = Some(Ok(format!("Watching the campaign {}", folder.path.display())));
            self.opened = Some(Opened::Campaign(folder.path));
            return Ok(());
        }
        let scene = Scene::read(path).map_err(|e| e.to_string())?;
        let document = Document::of_scene(scene).map_err(|e| format!("{}: {e}", path.display()))?;
        self.replace_document(document);
        self.files.saved = self.document.clone();
        self.files.path = Some(path.to_owned());
        self.remember(path);
        self.files.notice = Some(Ok(format!("Opened {}", path.display())));
        self.opened = self.document.scene.as_ref().map(|scene| Opened::Scene(answering(&scene.study)));
        Ok(())
    }

    /// Opens a scene that has no file, with its question above the tabs.
    ///
    /// # Errors
    /// A sentence when the explorer cannot solve it; what is on the screen stays.
    fn open_untitled(&mut self, scene: &Scene) -> Result<(), String> {
        let document = Document::of_scene(scene.clone())?;
        self.replace_document(document);
        self.files.saved = self.document.clone();
        self.files.path = None;
        self.files.notice = None;
        self.headline = Some(Headline::of(scene));
        self.opened = Some(Opened::Scene(answering(&scene.study)));
        Ok(())
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
        self.document.to_scene().write(path).map_err(|e| e.to_string())?;
        self.files.saved = self.document.clone();
        self.files.path = Some(path.to_owned());
        self.remember(path);
        self.files.notice = Some(Ok(format!("Saved {}", path.display())));
        Ok(())
    }

    /// Puts a scene first among those that were used.
    pub fn remember(&mut self, path: &Path) {
        self.files.recent.retain(|p| p != path);
        self.files.recent.insert(0, path.to_owned());
        self.files.recent.truncate(MOST_RECENT);
    }

    /// The windows of this module, dropped files, and the question before closing.
    pub fn files_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let dropped: Vec<PathBuf> = ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_path_buf()).collect());
        if let Some(path) = dropped.into_iter().next() {
            self.request(&ctx, Pending::Open(path));
        }
        let closes = ctx.input(|i| i.viewport().close_requested()) && !self.files.quit;
        if closes && !self.losses(&Pending::Quit).is_empty() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.files.pending = Some(Pending::Quit);
        }
        self.browse_answer(&ctx);
        self.path_window_ui(&ctx);
        self.losses_ui(&ctx);
    }
}
