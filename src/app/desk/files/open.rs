//! Opening, saving and exporting. These actions never block the window, and they overwrite or discard nothing
//! without the user's consent.

use super::state::Pending;
use crate::app::desk::{Desk, Opened};
use crate::app::document::Document;
use crate::app::links::Fragment;
use crate::app::notice::Notice;
use crate::app::panels::headline::Headline;
use crate::app::purpose::Purpose;
use crate::app::refusal::Refusal;
use crate::app::tab::Tab;
use crate::app::tabs::training::TrainingCommand;
use crate::engine::campaign::Folder;
use crate::host::browser;
use crate::scene::{Scene, Study};
use egui::{Context, Ui, ViewportCommand};
use std::path::{Path, PathBuf};

/// Number of recent files.
const MOST_RECENT: usize = 8;
/// Returns the tab that shows the result of a scene's study.
fn answering(study: &Study) -> Tab {
    match study {
        Study::Point(_) => Tab::Profiles,
        Study::Training(_) => Tab::Training,
        Study::Transient(_) => Tab::Transient,
        _ => Tab::Results,
    }
}

/// Returns true for the file of a reduced model.
pub(super) fn is_model(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "rom")
}

impl Desk {
    /// Returns true if there are unsaved changes.
    pub fn dirty(&self) -> bool {
        self.document != *self.files.saved()
    }

    /// Executes an action that replaces the present content. Requests a confirmation first if something would be
    /// lost.
    pub fn request(&mut self, ctx: &Context, pending: Pending) {
        if self.losses(&pending).is_empty() {
            self.proceed(ctx, pending);
        } else {
            self.files.pending = Some(pending);
        }
    }

    pub(super) fn proceed(&mut self, ctx: &Context, pending: Pending) {
        match pending {
            Pending::New => {
                self.replace_document(Document::default());
                self.files.saved = self.document.clone();
                self.files.path = None;
                self.files.notice = None;
            }
            Pending::OpenDialog => self.ask_path(ctx, Purpose::Open),
            Pending::Open(path) => {
                if let Err(why) = self.open_path(&path) {
                    self.files.notice = Some(Notice::wrong(why));
                }
            }
            Pending::OpenScene(scene) => {
                if let Err(why) = self.open_untitled(&scene) {
                    self.files.notice = Some(Notice::wrong(why));
                }
            }
            Pending::OpenLink(text) => {
                if let Err(why) = self.open_link(&text) {
                    self.files.notice = Some(Notice::wrong(why));
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

    /// Opens a scene, watches a campaign (its folder, or `campaign.ron` in it), or puts a reduced model (`.rom`) in
    /// use.
    ///
    /// # Errors
    /// A sentence if the file cannot be read. The screen then keeps its content.
    pub fn open_path(&mut self, path: &Path) -> Result<(), Refusal> {
        if is_model(path) {
            let store = self.answers.store();
            match store.model_of_file(path) {
                Ok(model) => {
                    self.answers.use_model(model);
                    self.files.notice = Some(Notice::Done(format!("Using the model {}", path.display())));
                }
                // A transient model serves runs by its scene; here its bases are shown.
                Err(why) => {
                    let model = store.trajectory_model_of_file(path).map_err(|_| why)?;
                    self.tabs.basis.open_in_time(model);
                    let said = format!("Reduced basis shows the transient model {}", path.display());
                    self.files.notice = Some(Notice::Done(said));
                }
            }
            return Ok(());
        }
        if let Some(folder) = Folder::meant(path) {
            let folder = Folder::open(&folder)?;
            self.open_path(&folder.scene_path())?;
            self.files.notice = Some(Notice::Done(format!("Watching the campaign {}", folder.path.display())));
            self.opened = Some(Opened::Campaign(folder.path));
            return Ok(());
        }
        let scene = Scene::read(path)?;
        let document = Document::of_scene(scene).map_err(|e| Refusal::new(format!("{}: {e}", path.display())))?;
        self.replace_document(document);
        self.files.saved = self.document.clone();
        self.files.path = Some(path.to_owned());
        self.remember(path);
        self.files.notice = Some(Notice::Done(format!("Opened {}", path.display())));
        self.opened = self.document.scene.as_ref().map(|scene| Opened::Scene(answering(&scene.study)));
        Ok(())
    }

    /// Opens a scene that has no file, with its question above the tabs.
    ///
    /// # Errors
    /// A sentence if the explorer cannot solve it. The screen then keeps its content.
    fn open_untitled(&mut self, scene: &Scene) -> Result<(), Refusal> {
        let document = Document::of_scene(scene.clone())?;
        self.replace_document(document);
        self.files.saved = self.document.clone();
        self.files.path = None;
        self.files.notice = None;
        self.headline = Some(Headline::of(scene));
        self.opened = Some(Opened::Scene(answering(&scene.study)));
        Ok(())
    }

    /// Opens the content of a link.
    ///
    /// # Errors
    /// A sentence. The screen then keeps its content.
    pub fn open_link(&mut self, text: &str) -> Result<(), Refusal> {
        let mut fragment = Fragment::read(text)?;
        if let Some(document) = fragment.document.take() {
            self.replace_document(document);
            self.files.saved = self.document.clone();
            self.files.path = None;
            self.files.notice = None;
        }
        self.opened = Some(Opened::Link(Box::new(fragment)));
        Ok(())
    }

    /// Saves to the present path, or opens a dialog for a path.
    pub fn save(&mut self, ctx: &Context) {
        match self.files.path.clone() {
            Some(path) => {
                if let Err(why) = self.save_to(&path) {
                    self.files.notice = Some(Notice::wrong(why));
                }
            }
            None => self.ask_path(ctx, Purpose::Save),
        }
    }

    pub(super) fn save_to(&mut self, path: &Path) -> Result<(), Refusal> {
        self.document.to_scene().write(path)?;
        self.files.saved = self.document.clone();
        self.files.path = Some(path.to_owned());
        self.remember(path);
        self.files.notice = Some(Notice::Done(format!("Saved {}", path.display())));
        Ok(())
    }

    /// Puts a scene first in the list of recent files.
    pub fn remember(&mut self, path: &Path) {
        self.files.recent.retain(|p| p != path);
        self.files.recent.insert(0, path.to_owned());
        self.files.recent.truncate(MOST_RECENT);
    }

    /// Draws the windows of this module, handles dropped files, and confirms the closing of the window.
    pub fn files_ui(&mut self, ui: &mut Ui) {
        let ctx = ui.ctx().clone();
        let dropped: Vec<PathBuf> = ctx.input(|i| i.raw.dropped_files.iter().map(|f| f.path().to_path_buf()).collect());
        if let Some(path) = dropped.into_iter().next().or_else(browser::dropped) {
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
