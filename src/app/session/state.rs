//! Last session: one file, `session.ron`, that is replaced as a whole soon after every change. Unreadable parts are
//! set to their defaults and reported, and the file is kept as `session.ron.bad`.

use super::layout;
use super::place::Place;
use super::shown::Shown;
use crate::app::document::Document;
use crate::app::explorer::Explorer;
use crate::app::layouts::Layout;
use crate::app::notice::Notice;
use crate::app::refusal::Refusal;
use crate::app::tab::Tab;
use crate::host::files;
use crate::scene::atomic_file::{self, WriteError};

use egui_tiles::Tree;
use serde::{Deserialize, Serialize};
use std::io;
use std::path::{Path, PathBuf};

/// Name of the file in the session's folder.
pub(super) const FILE: &str = "session.ron";
/// Maximum size of the file \[bytes\]: two scenes and a few lines.
const MAX_BYTES: u64 = 16 << 20;

/// State that is restored when the explorer starts again.
#[derive(Clone, PartialEq)]
pub struct Session {
    document: Document,
    saved: Document,
    path: Option<PathBuf>,
    recent: Vec<PathBuf>,
    shown: Shown,
    place: Place,
    tree: Tree<Tab>,
}

/// Session in the form of the file.
#[derive(Serialize, Deserialize)]
#[serde(default)]
struct Written {
    document: String,
    saved: String,
    path: Option<PathBuf>,
    recent: Vec<PathBuf>,
    display: Shown,
    place: Place,
    tree: Tree<Tab>,
}

impl Default for Written {
    fn default() -> Self {
        let (shown, place) = (Shown::default(), Place::default());
        let (document, saved) = (String::new(), String::new());
        Self {
            document,
            saved,
            path: None,
            recent: Vec::new(),
            display: shown,
            place,
            tree: Layout::default().tree(Place::default().size.0),
        }
    }
}

impl Session {
    /// Returns the present state.
    pub fn of(explorer: &Explorer) -> Self {
        let desk = &explorer.desk;
        Self {
            document: desk.document.clone(),
            saved: desk.files.saved().clone(),
            path: desk.files.path.clone(),
            recent: desk.files.recent.clone(),
            shown: Shown::of(&explorer.desk),
            place: explorer.place,
            tree: explorer.tree.clone(),
        }
    }

    /// Returns true if it equals [`Session::of`].
    pub(super) fn is_of(&self, explorer: &Explorer) -> bool {
        let (desk, files) = (&explorer.desk, &explorer.desk.files);
        self.document == desk.document
            && self.saved == *files.saved()
            && self.path == files.path
            && self.recent == files.recent
            && self.shown == Shown::of(&explorer.desk)
            && self.place == explorer.place
            && self.tree == explorer.tree
    }

    /// Returns the text of the file.
    ///
    /// # Errors
    /// A sentence. In practice never.
    fn to_ron(&self) -> Result<String, Refusal> {
        let written = Written {
            document: self.document.to_ron()?,
            saved: self.saved.to_ron()?,
            path: self.path.clone(),
            recent: self.recent.clone(),
            display: self.shown.clone(),
            place: self.place,
            tree: self.tree.clone(),
        };
        let written: &dyn erased_serde::Serialize = &written;
        Ok(ron::ser::to_string_pretty(written, ron::ser::PrettyConfig::new())?)
    }

    /// Returns a session from the text of the file, with the names of the parts that were set to their defaults.
    fn from_ron(text: &str) -> (Self, Vec<&'static str>) {
        let mut lost = Vec::new();
        let written = ron::from_str::<Written>(text).unwrap_or_else(|_| {
            lost.push("its text");
            Written::default()
        });
        let mut sound = |what: &'static str, sound: bool| {
            if !sound {
                lost.push(what);
            }
            sound
        };
        let Written { document, saved, path, recent, display, place, tree } = written;
        let document = (!document.is_empty()).then(|| Document::from_ron(&document));
        sound("the document", !matches!(document, Some(Err(_))));
        let known = matches!(document, Some(Ok(_)));
        let document = document.and_then(Result::ok).unwrap_or_default();
        let saved = if known { Document::from_ron(&saved).ok() } else { None };
        let tree = layout::checked(&tree);
        sound("its layout", tree.is_some());
        let session = Self {
            saved: saved.unwrap_or_else(|| document.clone()),
            document,
            path: path.filter(|_| known),
            recent,
            shown: if sound("how things were shown", display.is_sound()) { display } else { Shown::default() },
            place: if sound("the place of the window", place.is_sound()) { place } else { Place::default() },
            tree: tree.unwrap_or_else(|| Layout::default().tree(Place::default().size.0)),
        };
        (session, lost)
    }

    /// Restores the display settings, and the document if `with_document` is true.
    fn restore(self, explorer: &mut Explorer, with_document: bool) {
        self.shown.restore(&mut explorer.desk);
        explorer.place = self.place;
        explorer.tree = self.tree;
        let desk = &mut explorer.desk;
        desk.files.recent = self.recent;
        if with_document {
            desk.files.set_saved(self.saved);
            desk.files.path = self.path;
            desk.replace_document(self.document);
        }
    }

    /// Writes the file as a whole or not at all.
    ///
    /// # Errors
    /// A sentence if it cannot be written.
    pub(super) fn write(&self, path: &Path) -> Result<(), Refusal> {
        let text = self.to_ron()?;
        atomic_file::replace(path, text.as_bytes()).map_err(|WriteError { path, reason }| {
            Refusal::new(format!("The session cannot be kept in {}: {reason}", path.display()))
        })
    }
}

/// Returns the text of the last session in a folder, if there was one.
fn text_in(folder: &Path) -> io::Result<Option<String>> {
    match files::read_at_most(&folder.join(FILE), MAX_BYTES) {
        Ok(bytes) => String::from_utf8(bytes).map(Some).map_err(io::Error::other),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(error),
    }
}

/// Saves unsaved changes of the last session as a separate file, because another scene replaces them.
fn set_aside(explorer: &mut Explorer, folder: &Path, document: &Document) -> Result<String, Refusal> {
    let free = (1..).map(|n| folder.join(format!("unsaved-{n}.ron"))).find(|path| !files::exists(path));
    let path = free.unwrap_or_else(|| folder.join("unsaved.ron"));
    let text = document.to_ron()?;
    atomic_file::replace(&path, text.as_bytes()).map_err(|WriteError { path, reason }| {
        Refusal::new(format!("Unsaved changes of the last session cannot be kept in {}: {reason}", path.display()))
    })?;
    explorer.desk.remember(&path);
    Ok(format!("Unsaved changes of the last session are kept in {} (File, Recent)", path.display()))
}

/// Restores the last session of a folder, with its document if `with_document` is true. Reports what could not be
/// restored.
pub fn restore(explorer: &mut Explorer, folder: &Path, with_document: bool) {
    let path = folder.join(FILE);
    let (session, lost) = match text_in(folder) {
        Ok(None) => return,
        Ok(Some(text)) => Session::from_ron(&text),
        Err(_) => Session::from_ron("\u{0}"),
    };
    let unsaved = (!with_document && session.document != session.saved).then(|| session.document.clone());
    session.restore(explorer, with_document);
    if let Some(document) = unsaved {
        let kept = set_aside(explorer, folder, &document).map_or_else(Notice::wrong, Notice::Done);
        explorer.desk.files.notice = Some(kept);
    }
    if lost.is_empty() {
        return;
    }
    let bad = folder.join(format!("{FILE}.bad"));
    let kept = match files::rename(&path, &bad) {
        Ok(()) => format!("the file is kept as {}", bad.display()),
        Err(error) => format!("the file cannot be kept as {} ({error})", bad.display()),
    };
    let lost = lost.join(", ");
    let said = format!("Not all of the last session could be restored ({lost}); {kept}");
    explorer.desk.files.notice = Some(Notice::Wrong(said));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::figure::FigureSettings;
    use crate::app::tabs::traction::Against;
    use crate::scene::named_lubricant::by_name;
    use crate::solver::parameters::Quantity;
    use crate::solver::physics::contact::Moes;

    /// Returns an explorer with its session in a temporary folder for this test.
    fn in_folder(name: &str) -> (PathBuf, impl Fn(bool) -> Explorer) {
        let folder = std::env::temp_dir().join(format!("ehl-session-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        let kept = folder.clone();
        (folder, move |with_document| Explorer::new(None).keeping_session_in(&kept, with_document))
    }

    /// Closes the explorer after its state has been passed to the keeper.
    fn close(mut explorer: Explorer) {
        let mut keeper = explorer.keeper.take().unwrap();
        assert_eq!(keeper.follow(&explorer), None);
    }

    fn notice(explorer: &Explorer) -> Option<&str> {
        match &explorer.desk.files.notice {
            Some(Notice::Wrong(said)) => Some(said),
            _ => None,
        }
    }

    #[test]
    fn session_restores_unsaved_changes() {
        let (folder, start) = in_folder("own");
        let mut explorer = start(true);
        let document = &mut explorer.desk.document;
        document.pick_lubricant(&by_name("squalane-pip").unwrap()).unwrap();
        document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
        document.set_quantity(Quantity::SlideToRollRatio, 0.3).unwrap();
        document.set_quantity(Quantity::NewtonianPlateauRatio, 0.4).unwrap();
        document.view.pressure_loss = Some(1e-6);
        explorer.desk.tabs.traction.choices.against = Against::Stribeck;
        explorer.desk.figures.settings = FigureSettings { dpi: 600.0, dark: true, ..FigureSettings::default() };
        explorer.desk.lock(Tab::Transient, true);
        explorer.place =
            Place { corner: Some((3.0, 4.0)), size: (1000.0, 700.0), maximized: true, sliders: 400.0, lessons: 350.0 };
        let (former, place) = (explorer.desk.document.clone(), explorer.place);
        let (shown, tree) = (Shown::of(&explorer.desk), explorer.tree.clone());
        close(explorer);
        let mut again = start(true);
        assert_eq!(notice(&again), None);
        let document = &again.desk.document;
        assert_eq!((document.point, &document.view), (former.point, &former.view));
        assert_eq!(document.lubricant, former.lubricant);
        assert!(Shown::of(&again.desk) == shown && again.place == place && again.tree == tree);
        assert!(again.desk.dirty(), "what was not saved is still unsaved");
        let session = Session::of(&again);
        assert!(session.is_of(&again));
        again.desk.files.set_saved(again.desk.document.clone());
        close(again);
        assert!(!start(true).desk.dirty());
        let without = start(false);
        assert!(without.desk.document == Document::default() && without.place == place);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn unsaved_changes_are_saved_separately() {
        let (folder, start) = in_folder("aside");
        let mut explorer = start(true);
        explorer.desk.document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
        let changed = explorer.desk.document.clone();
        close(explorer);
        let other = start(false);
        let kept = other.desk.files.recent.first().cloned().unwrap();
        assert!(matches!(&other.desk.files.notice, Some(Notice::Done(said)) if said.contains("unsaved-1.ron")));
        let again = Document::from_ron(&std::fs::read_to_string(kept).unwrap()).unwrap();
        assert_eq!((again.point, again.view), (changed.point, changed.view));
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn what_cannot_be_read_is_left_at_its_default_said_and_kept() {
        let (folder, start) = in_folder("damaged");
        let mut explorer = start(true);
        explorer.desk.document.set_moes(Moes { m: 55.0, l: 8.0 }).unwrap();
        explorer.desk.figures.settings = FigureSettings { width_mm: 170.0, ..FigureSettings::default() };
        let changed = explorer.desk.document.point;
        close(explorer);
        let (path, bad) = (folder.join(FILE), folder.join("session.ron.bad"));
        let whole = std::fs::read_to_string(&path).unwrap();
        let zoom = |value: &str| whole.replace("\"zoom\": 1.0", &format!("\"zoom\": {value}"));
        let width = |value: &str| whole.replace("sliders: 312.0", &format!("sliders: {value}"));
        let size = |value: &str| whole.replace("size: (1280.0", &format!("size: ({value}"));
        let first = |from: &str, to: &str| whole.replacen(from, to, 1);
        let cases = [
            ("its text", "(damaged".to_owned()),
            ("its text", whole[..whole.len() / 2].to_owned()),
            ("the document", first("Scene(", "Seen(")),
            ("its layout", first("Pane(Profiles)", "Pane(Regimes)")),
            ("how things were shown", zoom("0.0")),
            ("how things were shown", zoom("-1.0")),
            ("how things were shown", zoom("inf")),
            ("how things were shown", zoom("NaN")),
            ("how things were shown", zoom("1e9")),
            ("how things were shown", first("width_mm: 170.0", "width_mm: 1e9")),
            ("how things were shown", first("height_mm: 65.0", "height_mm: NaN")),
            ("how things were shown", first("dpi: 300.0", "dpi: 1e5")),
            ("how things were shown", first("\"locked\": [", "\"locked\": [Regimes, Regimes, ")),
            ("the place of the window", width("NaN")),
            ("the place of the window", size("1e30")),
        ];
        for (what, text) in cases {
            assert_ne!(text, whole, "{what}");
            std::fs::write(&path, &text).unwrap();
            let explorer = start(true);
            let sentence = notice(&explorer).unwrap_or_default();
            assert!(sentence.contains(what) && sentence.contains("session.ron.bad"), "{what}: {sentence}");
            assert_eq!(std::fs::read_to_string(&bad).unwrap(), text);
            assert!(explorer.desk.display.zoom == 1.0 && explorer.place == Place::default());
            assert!(explorer.desk.locked.is_empty());
            assert_eq!(explorer.desk.document.point == changed, !matches!(what, "its text" | "the document"), "{what}");
        }
        std::fs::write(&path, [0xff, 0xfe, 0x00]).unwrap();
        assert!(notice(&start(true)).unwrap().contains("its text"));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
