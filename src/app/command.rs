//! Everything the user can ask for by menu, key or palette, in one place.

use super::answers::picture::Cuts;
use super::display::Thresholds;
use super::document::Edit;
use super::in_use::InUse;
use super::layouts::Layout;
use super::purpose::{Purpose, Written};
use super::sheets::Form;
use super::tab::Tab;
use crate::app::tabs::training::TrainingCommand;
use crate::app::tabs::transient::TransientCommand;
use crate::host::browser;
use crate::scene::Scene;
use egui::{Context, Id, Key, KeyboardShortcut, Modifiers, ThemePreference};
use std::path::PathBuf;
use std::sync::Arc;

/// What the user can ask for: by menu, key and palette, or in a panel or tab.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Start with a fresh document.
    New,
    /// Open a scene.
    Open,
    /// Show the scenes of the program.
    Examples,
    /// Solve a table of load cases.
    LoadCases,
    /// Put a link to what is shown on the clipboard.
    CopyLink,
    /// Ask for a link and open it.
    OpenLink,
    /// Open what a link holds.
    OpenFragment(String),
    /// Save under the known name.
    Save,
    /// Save under a name to be given.
    SaveAs,
    /// Export a plot as a figure.
    ExportFigures,
    /// Export the profiles as a table.
    ExportProfiles,
    /// Write a results sheet of the contact.
    ExportSheet(Form),
    /// Close the program.
    Quit,
    /// Take the last edit back.
    Undo,
    /// Do it again.
    Redo,
    /// Put the read-outs on the clipboard as a table.
    CopyReadouts,
    /// Pin the live curve.
    Pin,
    /// Remove all pins.
    Unpin,
    /// What can be set once for all documents.
    Settings,
    /// From where on the badge uses another word.
    SetThresholds(Thresholds),
    /// All of these by typing.
    Palette,
    /// Nothing but plots and sliders, large.
    Presentation,
    /// Draw the full solution over the reduced one, or no more.
    Overlay,
    /// Draw the difference of both, or no more.
    Difference,
    /// Fit all plots to their data.
    FitPlots,
    /// Arrange the tabs.
    Arrange(Layout),
    /// Show the lessons, or no more.
    Lessons,
    /// Say in every tab what is seen and why, or no more.
    ShowWhy,
    /// Plots and exports in SI units, or no more.
    SiUnits,
    /// Let the axes of the tabs in front stand still, or no more.
    LockAxes,
    /// Let the axes of a tab stand still, or no more.
    LockAxesOf(Tab),
    /// Use a theme.
    Theme(ThemePreference),
    /// Light presentations whatever the theme, or no more.
    LightPresentation,
    /// Larger text and lines.
    LargerText,
    /// Smaller text and lines.
    SmallerText,
    /// Text as it was.
    NormalText,
    /// Panels and tabs as they were.
    ResetLayout,
    /// Full solve now.
    Verify,
    /// Solve on a second grid to see what the first one costs.
    EstimateGridError,
    /// Full solutions along the traction curve.
    SolveAlong,
    /// Take the contact through time.
    RunInTime,
    /// Train the model that the Training tab specifies.
    Train,
    /// Forget the training that is not at its end.
    DiscardTraining,
    /// Forget the model that was trained.
    ThrowModelAway,
    /// Stop what runs.
    Cancel,
    /// What can be read about the program and its physics.
    Manual,
    /// List of keys.
    Keyboard,
    /// What this program is.
    About,
    /// Change the document; a refusal stands beside the field of this name.
    Edit(Edit, &'static str),
    /// Say under the name of a field why what was entered there makes no sense.
    Refuse(&'static str, &'static str),
    /// Go to a tab.
    Go(Tab),
    /// Cut a point contact elsewhere.
    Cut(Cuts),
    /// Remove one pin, by its place.
    RemovePin(usize),
    /// Draw by another reduced model.
    UseModel(InUse),
    /// Open a certain scene.
    OpenPath(PathBuf),
    /// Open a scene that lies nowhere yet.
    OpenScene(Arc<Scene>),
    /// Ask where something is to be written, or what is to be read.
    Ask(Purpose),
    /// Export a plot of a tab as a figure.
    ExportFigure(Tab),
    /// Run the study of the open scene.
    RunStudy,
    /// Put the question above the tabs away.
    CloseHeadline,
    /// Put the sentence about the last file away.
    Dismiss,
    /// Change transient runs or the moment that is shown.
    Transient(TransientCommand),
    /// Compare all reduced models that can be.
    CompareModels,
    /// What becomes of trainings and of what they made.
    Training(TrainingCommand),
}

/// A command as menus show it.
pub struct Item {
    pub menu: &'static str,
    /// Its group there; a line stands between groups.
    pub group: u8,
    /// What it does.
    pub command: Command,
    /// Its name; `…` where a dialog follows.
    pub name: &'static str,
    /// Other words that people look for it by.
    pub synonyms: &'static str,
    key: Option<(Modifiers, Key)>,
}

const PLAIN: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// The menus from left to right, each in its groups.
pub static MENUS: &[Item] = {
    use Command as C;
    const fn item(
        menu: &'static str,
        group: u8,
        command: Command,
        name: &'static str,
        synonyms: &'static str,
        key: Option<(Modifiers, Key)>,
    ) -> Item {
        Item { menu, group, command, name, synonyms, key }
    }
    &[
        item("File", 0, C::New, "New", "", Some((CTRL, Key::N))),
        item("File", 0, C::Open, "Open…", "", Some((CTRL, Key::O))),
        item("File", 0, C::Examples, "Examples…", "scenes tables figures dissertation search", None),
        item("File", 0, C::LoadCases, "Load cases…", "table csv paste bearings gears batch", None),
        item("File", 0, C::OpenLink, "Open link…", "address url share fragment", None),
        item("File", 1, C::Save, "Save", "", Some((CTRL, Key::S))),
        item("File", 1, C::SaveAs, "Save as…", "", Some((CTRL_SHIFT, Key::S))),
        item("File", 1, C::CopyLink, "Copy link", "address url share send fragment", None),
        item("File", 2, C::ExportFigures, "Export figure…", "picture plot image svg png", Some((CTRL, Key::E))),
        item("File", 2, C::ExportProfiles, "Export profiles as CSV…", "table data", None),
        item("File", 3, C::Quit, "Quit", "", Some((CTRL, Key::Q))),
        item("Edit", 0, C::Undo, "Undo", "", Some((CTRL, Key::Z))),
        item("Edit", 0, C::Redo, "Redo", "", Some((CTRL_SHIFT, Key::Z))),
        item("Edit", 1, C::Pin, "Pin curve", "compare keep", Some((CTRL, Key::D))),
        item("Edit", 1, C::Unpin, "Remove all pins", "", Some((CTRL_SHIFT, Key::D))),
        item("Edit", 2, C::CopyReadouts, "Copy read-outs", "clipboard table values", Some((CTRL_SHIFT, Key::C))),
        item(
            "Edit",
            3,
            C::Settings,
            "Settings…",
            "preferences options thresholds badge theme text",
            Some((CTRL, Key::Comma)),
        ),
        item("View", 0, C::Palette, "Command palette…", "", Some((CTRL, Key::P))),
        item("View", 0, C::Presentation, "Presentation", "full screen projector lecture", Some((PLAIN, Key::F11))),
        item("View", 1, C::Overlay, "Full solution over the profiles", "show hide overlay reduced compare", None),
        item("View", 1, C::Difference, "Difference of the profiles", "show hide overlay reduced compare", None),
        item("View", 1, C::ShowWhy, "Why, in three sentences", "teach explain note lecture", None),
        item("View", 2, C::Arrange(Layout::Explore), "Layout: Explore", "arrange tabs preset", None),
        item("View", 2, C::Arrange(Layout::Teach), "Layout: Teach", "arrange tabs preset lecture", None),
        item("View", 2, C::Arrange(Layout::Engineer), "Layout: Engineer", "arrange tabs preset bearing", None),
        item("View", 2, C::Arrange(Layout::ModelReduction), "Layout: Model reduction", "arrange tabs preset", None),
        item("View", 3, C::Theme(ThemePreference::Light), "Light theme", "colours colors mode", None),
        item("View", 3, C::Theme(ThemePreference::Dark), "Dark theme", "colours colors mode", None),
        item("View", 3, C::Theme(ThemePreference::System), "System theme", "colours colors mode", None),
        item("View", 4, C::LargerText, "Larger text", "zoom font size scale", Some((CTRL, Key::Plus))),
        item("View", 4, C::SmallerText, "Smaller text", "zoom font size scale", Some((CTRL, Key::Minus))),
        item("View", 4, C::NormalText, "Normal text", "zoom font size scale", Some((CTRL, Key::Num0))),
        item(
            "View",
            5,
            C::SiUnits,
            "SI units",
            "dimensionless micrometre gigapascal millimetre",
            Some((PLAIN, Key::F7)),
        ),
        item("View", 5, C::LockAxes, "Lock axes", "still zoom scale hold", Some((PLAIN, Key::F8))),
        item("View", 5, C::FitPlots, "Fit plots to data", "zoom reset axes", Some((PLAIN, Key::F2))),
        item("View", 5, C::ResetLayout, "Reset layout", "tabs panels windows", None),
        item("Run", 0, C::Verify, "Verify now", "full solve check", Some((PLAIN, Key::F5))),
        item("Run", 0, C::EstimateGridError, "Estimate grid error", "accuracy nodes refine", None),
        item("Run", 1, C::SolveAlong, "Full solutions along the traction curve", "", None),
        item("Run", 1, C::RunInTime, "Run in time", "transient march", None),
        item("Run", 1, C::Train, "Start training", "reduced model snapshots", None),
        item("Run", 2, C::Cancel, "Cancel", "stop abort", Some((PLAIN, Key::Escape))),
        item("Help", 0, C::Manual, "Manual", "help documentation tour physics", Some((PLAIN, Key::F1))),
        item("Help", 0, C::Lessons, "Lessons", "teach learn course steps", None),
        item("Help", 0, C::Keyboard, "Keyboard", "keys shortcuts help", None),
        item("Help", 1, C::About, "About EHL Explorer", "", None),
    ]
};

/// Keys that belong to a browser: reload, full screen, bookmarks, its own windows and zoom.
const OF_BROWSERS: [(Modifiers, Key); 12] = [
    (CTRL, Key::N),
    (CTRL, Key::Q),
    (CTRL, Key::E),
    (CTRL, Key::D),
    (CTRL_SHIFT, Key::D),
    (CTRL_SHIFT, Key::C),
    (CTRL, Key::Plus),
    (CTRL, Key::Minus),
    (CTRL, Key::Num0),
    (PLAIN, Key::F1),
    (PLAIN, Key::F5),
    (PLAIN, Key::F11),
];

impl Item {
    /// Its key, when it has one.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        let key = self.key.filter(|key| !(browser::PAGE && OF_BROWSERS.contains(key)));
        key.map(|(modifiers, key)| KeyboardShortcut::new(modifiers, key))
    }

    /// Whether it can be done here: a page cannot be quit from inside.
    pub fn is_there(&self) -> bool {
        !(browser::PAGE && self.command == Command::Quit)
    }
}

impl Command {
    /// Asks where a table is to be written.
    pub fn csv(text: String) -> Self {
        Self::Ask(Purpose::Write(Written::Table, text.into_bytes().into()))
    }

    fn item(&self) -> Option<&'static Item> {
        MENUS.iter().find(|item| item.command == *self)
    }

    /// As menus show it; empty where none does.
    pub fn name(&self) -> &'static str {
        self.item().map_or("", |item| item.name)
    }

    /// Its key, when it has one.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        self.item()?.shortcut()
    }

    /// The commands whose keys were pressed in this frame.
    pub fn pressed(ctx: &Context) -> Vec<Self> {
        // A text field keeps its own undo, and Escape must still leave it.
        // A field that Escape leaves has lost its focus before this frame is drawn.
        let now = ctx.text_edit_focused();
        let before = ctx.data_mut(|data| std::mem::replace(data.get_temp_mut_or(Id::unique("typing"), now), now));
        let typing = now || before;
        let left_to_fields = [Self::Undo, Self::Redo, Self::Cancel];
        let keys = MENUS.iter().filter_map(|item| Some((&item.command, item.shortcut()?)));
        let keys = keys.filter(|(command, _)| !(typing && left_to_fields.contains(*command)));
        // Those with Shift first: Ctrl+Shift+Z must not be taken for Ctrl+Z.
        let (shifted, plain): (Vec<_>, Vec<_>) = keys.partition(|(_, shortcut)| shortcut.modifiers.shift);
        let pressed = |shortcut: &KeyboardShortcut| ctx.input_mut(|i| i.consume_shortcut(shortcut));
        let both = shifted.into_iter().chain(plain);
        both.filter(|(_, shortcut)| pressed(shortcut)).map(|(command, _)| command.clone()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_command_stands_in_two_menus_and_no_key_or_name_means_two_things() {
        for (k, item) in MENUS.iter().enumerate() {
            for other in &MENUS[..k] {
                assert_ne!(item.command, other.command);
                assert_ne!(item.name, other.name);
                assert!(item.key.is_none() || item.key != other.key, "{}", item.name);
            }
        }
    }
}
