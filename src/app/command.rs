//! List of all commands that menus, keys and the command palette offer.

use super::answers::picture::Cuts;
use super::display::Thresholds;
use super::document::Edit;
use super::in_use::InUse;
use super::layouts::Layout;
use super::machines::MachineKind;
use super::panels::sliders::ChosenSliders;
use super::purpose::{Purpose, Written};
use super::tab::Tab;
use crate::app::reports::ReportSettings;
use crate::app::tabs::training::TrainingCommand;
use crate::app::tabs::transient::TransientCommand;
use crate::host::browser;
use crate::scene::ReportFormat;
use crate::scene::Scene;
use crate::solver::physics::engineering::UnitSystem;
use egui::{Context, Id, Key, KeyboardShortcut, Modifiers, Popup, ThemePreference};
use std::path::PathBuf;
use std::sync::Arc;

/// Command of the user, from a menu, a key, the palette, a panel or a tab.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Starts with a new document.
    New,
    /// Opens a scene.
    Open,
    /// Shows the example scenes.
    Examples,
    /// Solves a table of load cases.
    LoadCases,
    /// Opens the window of measured data.
    Measured,
    /// Solves a table of load cases in the Results tab. The document stays.
    SolveCases(Arc<Scene>),
    /// Opens the form of a machine.
    Machine(MachineKind),
    /// Puts a text into the window of load cases and opens it.
    OpenLoadCases(String),
    /// Copies a link to the present view to the clipboard.
    CopyLink,
    /// Opens a link that the user enters.
    OpenLink,
    /// Opens the content of a link.
    OpenFragment(String),
    /// Saves under the present name.
    Save,
    /// Saves under a new name.
    SaveAs,
    /// Exports a plot as a figure.
    ExportFigures,
    /// Exports the profiles as a table.
    ExportProfiles,
    /// Writes a report of the contact.
    ExportReport(ReportFormat),
    /// Draw the first full transient run as an animation.
    AnimateRun,
    /// Draw the contact under a range of loads as an animation.
    AnimateLoad,
    /// Writes the worksheet of the running lesson.
    ExportWorksheet,
    /// Marks the lesson of this title as finished.
    FinishLesson(String),
    /// Closes the program.
    Quit,
    /// Reverts the last edit.
    Undo,
    /// Repeats the reverted edit.
    Redo,
    /// Copies the read-outs to the clipboard as a table.
    CopyReadouts,
    /// Pins the live curve.
    Pin,
    /// Exchanges the contact with that of the last pin.
    SwapPin,
    /// Removes all pins.
    Unpin,
    /// Opens the settings that apply to all documents.
    Settings,
    /// Sets the error limits of the badge.
    SetThresholds(Thresholds),
    /// Opens the command palette.
    Palette,
    /// Switches the presentation mode, which shows only plots and sliders, enlarged.
    Presentation,
    /// Sets the sliders of presentations.
    PresentSliders(ChosenSliders),
    /// Shows or hides the full solution over the reduced one.
    Overlay,
    /// Shows or hides the difference between reduced and full solution.
    Difference,
    /// Fits all plots to their data.
    FitPlots,
    /// Arranges the tabs.
    Arrange(Layout),
    /// Shows or hides the lessons.
    Lessons,
    /// Shows or hides the explanation in every tab.
    ShowWhy,
    /// Switches plots and exports between dimensionless values and units.
    SwitchUnits,
    /// Sets author, company and paper of reports.
    Reports(ReportSettings),
    /// Selects a system of units.
    System(UnitSystem),
    /// Locks or unlocks the axes of the tabs in front.
    LockAxes,
    /// Locks or unlocks the axes of a tab.
    LockAxesOf(Tab),
    /// Selects a theme.
    Theme(ThemePreference),
    /// Switches light colours for presentations in any theme.
    LightPresentation,
    /// Enlarges text and lines.
    LargerText,
    /// Reduces text and lines.
    SmallerText,
    /// Resets the size of text and lines.
    NormalText,
    /// Resets the arrangement of panels and tabs.
    ResetLayout,
    /// Starts a full solve now.
    Verify,
    /// Solves on a second grid to estimate the discretisation error.
    EstimateGridError,
    /// Computes full solutions along the traction curve.
    SolveAlong,
    /// Starts a transient run.
    RunInTime,
    /// Trains the model that the Training tab specifies.
    Train,
    /// Discards an unfinished training.
    DiscardTraining,
    /// Discards the trained model.
    ThrowModelAway,
    /// Stops running jobs.
    Cancel,
    /// Opens the manual.
    Manual,
    /// Shows the list of keys.
    Keyboard,
    /// Shows information about the program.
    About,
    /// Changes the document. A refusal is shown next to the field of this name.
    Edit(Edit, &'static str),
    /// Shows a refusal under the name of a field.
    Refuse(&'static str, &'static str),
    /// Brings a tab to the front.
    Go(Tab),
    /// Moves the cuts of a point contact.
    Cut(Cuts),
    /// Removes the pin with this index.
    RemovePin(usize),
    /// Puts another reduced model in use.
    UseModel(InUse),
    /// Opens the scene at a path.
    OpenPath(PathBuf),
    /// Opens a scene that has no file.
    OpenScene(Arc<Scene>),
    /// Opens a dialog for a path to read or write.
    Ask(Purpose),
    /// Exports a plot of a tab as a figure.
    ExportFigure(Tab),
    /// Scrolls a panel to a heading or control and draws a ring around it.
    PointAt(&'static str),
    /// Runs the study of the open scene.
    RunStudy,
    /// Closes the headline above the tabs.
    CloseHeadline,
    /// Closes the notice about the last file.
    Dismiss,
    /// Changes transient runs or the displayed time.
    Transient(TransientCommand),
    /// Compares all compatible reduced models.
    CompareModels,
    /// Acts on trainings and trained models.
    Training(TrainingCommand),
}

/// Command as a menu item.
pub struct Item {
    pub menu: &'static str,
    /// Group within the menu. A line separates groups.
    pub group: u8,
    /// Command.
    pub command: Command,
    /// Name, with `…` if a dialog follows.
    pub name: &'static str,
    /// Keywords for the search in the palette.
    pub synonyms: &'static str,
    key: Option<(Modifiers, Key)>,
}

const PLAIN: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// Menu items, ordered by menu and group.
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
        item("File", 0, C::New, "New", "empty start scene", Some((CTRL, Key::N))),
        item("File", 0, C::Open, "Open…", "load file scene", Some((CTRL, Key::O))),
        item("File", 0, C::Examples, "Examples…", "scenes tables figures dissertation search", None),
        item("File", 0, C::LoadCases, "Load cases…", "table csv paste bearings gears batch spreadsheet excel", None),
        item(
            "File",
            0,
            C::Measured,
            "Measured data…",
            "table csv fit rig experiment film friction traction alpha Eyring oil estimate",
            None,
        ),
        item("File", 0, C::OpenLink, "Open link…", "address url share fragment", None),
        item("File", 1, C::Save, "Save", "file scene store", Some((CTRL, Key::S))),
        item("File", 1, C::SaveAs, "Save as…", "file scene store", Some((CTRL_SHIFT, Key::S))),
        item("File", 1, C::CopyLink, "Copy link", "address url share send fragment", None),
        item(
            "File",
            2,
            C::ExportFigures,
            "Export figure…",
            "picture plot image svg png print pdf",
            Some((CTRL, Key::E)),
        ),
        item(
            "File",
            2,
            C::ExportReport(ReportFormat::Pdf),
            "Export report as PDF…",
            "report sheet protocol print pdf summary document customer",
            None,
        ),
        item(
            "File",
            2,
            C::ExportReport(ReportFormat::Html),
            "Export report as HTML…",
            "report sheet protocol print summary document page",
            None,
        ),
        item(
            "File",
            2,
            C::AnimateRun,
            "Export animation of the transient run…",
            "film movie video gif apng slides",
            None,
        ),
        item("File", 2, C::AnimateLoad, "Export animation over load…", "film movie video gif apng slides sweep", None),
        item("File", 2, C::ExportProfiles, "Export profiles as CSV…", "table data pressure film thickness excel", None),
        item(
            "File",
            2,
            C::ExportWorksheet,
            "Export worksheet…",
            "lesson print exercise solutions pdf class teach",
            None,
        ),
        item("File", 3, C::Quit, "Quit", "exit close end", Some((CTRL, Key::Q))),
        item("Edit", 0, C::Undo, "Undo", "back revert", Some((CTRL, Key::Z))),
        item("Edit", 0, C::Redo, "Redo", "again repeat", Some((CTRL_SHIFT, Key::Z))),
        item("Edit", 1, C::Pin, "Pin curve", "compare keep", Some((CTRL, Key::D))),
        item("Edit", 1, C::SwapPin, "Swap with the last pin", "compare two contacts exchange side by side", None),
        item("Edit", 1, C::Unpin, "Remove all pins", "clear compare unpin", Some((CTRL_SHIFT, Key::D))),
        item(
            "Edit",
            2,
            C::CopyReadouts,
            "Copy read-outs",
            "clipboard table values results film thickness",
            Some((CTRL_SHIFT, Key::C)),
        ),
        item(
            "Edit",
            2,
            C::Machine(MachineKind::Bearing),
            "From a bearing…",
            "rolling ball roller race deep groove angular contact machine",
            None,
        ),
        item(
            "Edit",
            2,
            C::Machine(MachineKind::Gear),
            "From a gear pair…",
            "teeth spur helical involute machine",
            None,
        ),
        item("Edit", 2, C::Machine(MachineKind::Cam), "From a cam…", "follower lift valve tappet machine", None),
        item(
            "Edit",
            3,
            C::Settings,
            "Settings…",
            "preferences options thresholds badge theme text",
            Some((CTRL, Key::Comma)),
        ),
        item("View", 0, C::Palette, "Command palette…", "search find", Some((CTRL, Key::P))),
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
            C::SwitchUnits,
            "Units on axes",
            "dimensionless SI micrometre gigapascal millimetre",
            Some((PLAIN, Key::F7)),
        ),
        item("View", 5, C::System(UnitSystem::Si), "Units: SI", "system metre pascal kelvin", None),
        item("View", 5, C::System(UnitSystem::Engineering), "Units: Engineering", "system mm GPa metric", None),
        item(
            "View",
            5,
            C::System(UnitSystem::Imperial),
            "Units: Imperial",
            "system inch psi ksi lbf Fahrenheit US",
            None,
        ),
        item("View", 5, C::LockAxes, "Lock axes", "still zoom scale hold", Some((PLAIN, Key::F8))),
        item("View", 5, C::FitPlots, "Fit plots to data", "zoom reset axes", Some((PLAIN, Key::F2))),
        item("View", 5, C::ResetLayout, "Reset layout", "tabs panels windows", None),
        item("Run", 0, C::Verify, "Verify now", "full solve check", Some((PLAIN, Key::F5))),
        item("Run", 0, C::EstimateGridError, "Estimate grid error", "accuracy nodes refine", None),
        item("Run", 1, C::SolveAlong, "Full solutions along the traction curve", "friction Stribeck check", None),
        item("Run", 1, C::RunInTime, "Run transient", "time step march harmonic load", None),
        item("Run", 1, C::Train, "Start training", "reduced model snapshots", None),
        item("Run", 2, C::Cancel, "Cancel", "stop abort", Some((PLAIN, Key::Escape))),
        item("Help", 0, C::Manual, "Manual", "help documentation tour physics", Some((PLAIN, Key::F1))),
        item("Help", 0, C::Lessons, "Lessons", "teach learn course steps exercise worksheet tutorial", None),
        item("Help", 0, C::Keyboard, "Keyboard", "keys shortcuts help", None),
        item("Help", 1, C::About, "About EHL Explorer", "version licence", None),
    ]
};

/// Keys that belong to a browser: reload, full screen, bookmarks, windows and zoom.
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
    /// Returns the key, if there is one.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        let key = self.key.filter(|key| !(browser::PAGE && OF_BROWSERS.contains(key)));
        key.map(|(modifiers, key)| KeyboardShortcut::new(modifiers, key))
    }

    /// Returns true if the command is available here. A web page cannot quit the program.
    pub fn is_there(&self) -> bool {
        !(browser::PAGE && self.command == Command::Quit)
    }
}

impl Command {
    /// Creates the command that saves a table.
    pub fn csv(text: String) -> Self {
        Self::Ask(Purpose::Write(Written::Table, text.into_bytes().into()))
    }

    fn item(&self) -> Option<&'static Item> {
        MENUS.iter().find(|item| item.command == *self)
    }

    /// Returns the name in the menus. Empty if no menu has the command.
    pub fn name(&self) -> &'static str {
        self.item().map_or("", |item| item.name)
    }

    /// Returns the key, if there is one.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        self.item()?.shortcut()
    }

    /// Returns the commands whose keys were pressed in this frame.
    pub fn pressed(ctx: &Context) -> Vec<Self> {
        // Undo, Redo and Escape act on a text field while it has the focus. Escape removes the focus before this
        // frame is drawn, so the focus of the previous frame counts too.
        let now = ctx.text_edit_focused();
        let before = ctx.data_mut(|data| std::mem::replace(data.get_temp_mut_or(Id::unique("typing"), now), now));
        let typing = now || before;
        let left_to_fields = [Self::Undo, Self::Redo, Self::Cancel];
        // Escape closes an open menu or list first.
        let listed = Popup::is_any_open(ctx);
        let keys = MENUS.iter().filter_map(|item| Some((&item.command, item.shortcut()?)));
        let keys = keys.filter(|(command, _)| !(typing && left_to_fields.contains(*command)));
        let keys = keys.filter(|(command, _)| !(listed && **command == Self::Cancel));
        // Test shortcuts with Shift first, so that Ctrl+Shift+Z is not taken for Ctrl+Z.
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
    fn commands_keys_and_names_are_unique() {
        for (k, item) in MENUS.iter().enumerate() {
            for other in &MENUS[..k] {
                assert_ne!(item.command, other.command);
                assert_ne!(item.name, other.name);
                assert!(item.key.is_none() || item.key != other.key, "{}", item.name);
            }
        }
    }
}
