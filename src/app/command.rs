//! Everything the user can ask for by menu, key or palette, in one place.

use super::answers::picture::Cuts;
use super::document::Edit;
use super::purpose::Purpose;
use super::tab::Tab;
use super::traction::{Served, Sweep};
use super::training::TrainingCommand;
use super::transient::InTimeCommand;
use egui::{Context, Key, KeyboardShortcut, Modifiers};
use std::path::PathBuf;

/// What the user can ask for: by menu, key and palette, or in a panel or tab.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Start with a fresh document.
    New,
    /// Open a scene.
    Open,
    /// Save under the known name.
    Save,
    /// Save under a name to be given.
    SaveAs,
    /// Export a plot as a picture.
    ExportPlot,
    /// Export the profiles as a table.
    ExportProfiles,
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
    /// Light theme.
    LightTheme,
    /// Dark theme.
    DarkTheme,
    /// The system's theme.
    SystemTheme,
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
    /// Open a certain scene.
    OpenPath(PathBuf),
    /// Ask where something is to be written, or what is to be read.
    Ask(Purpose),
    /// Export a plot that is on the screen as a drawing.
    Draw(&'static str),
    /// Run the study of the open scene.
    RunStudy,
    /// Put the sentence about the last file away.
    Dismiss,
    /// Draw a curve by a reduced model.
    FollowSweep(Box<(Sweep, Served)>),
    /// Go to a place on the axis of the traction curve.
    GoAlong(f64),
    /// Stop the full solutions along the traction curve.
    StopAlong,
    /// What becomes of contacts in time.
    InTime(InTimeCommand),
    /// What becomes of trainings and of what they made.
    Training(TrainingCommand),
}

/// The menus from left to right, each in its groups.
pub const MENUS: [(&str, &[&[Command]]); 5] = {
    use Command as C;
    [
        ("File", &[&[C::New, C::Open], &[C::Save, C::SaveAs], &[C::ExportPlot, C::ExportProfiles], &[C::Quit]]),
        ("Edit", &[&[C::Undo, C::Redo], &[C::Pin, C::Unpin], &[C::CopyReadouts]]),
        (
            "View",
            &[
                &[C::Palette, C::Presentation],
                &[C::Overlay, C::Difference],
                &[C::LightTheme, C::DarkTheme, C::SystemTheme],
                &[C::LargerText, C::SmallerText, C::NormalText],
                &[C::FitPlots, C::ResetLayout],
            ],
        ),
        ("Run", &[&[C::Verify, C::EstimateGridError], &[C::SolveAlong, C::RunInTime, C::Train], &[C::Cancel]]),
        ("Help", &[&[C::Manual, C::Keyboard], &[C::About]]),
    ]
};

const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

impl Command {
    /// Asks where a table is to be written.
    pub fn csv(text: String) -> Self {
        Self::Ask(Purpose::Csv { text })
    }

    /// All of them with the names of their menus, in their order.
    pub fn all() -> impl Iterator<Item = (&'static str, Self)> {
        MENUS.into_iter().flat_map(|(menu, groups)| {
            groups.iter().flat_map(move |group| group.iter().map(move |command| (menu, command.clone())))
        })
    }

    /// As menus show it; `…` where a dialog follows.
    pub fn name(&self) -> &'static str {
        match self {
            Self::New => "New",
            Self::Open => "Open…",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::ExportPlot => "Export plot…",
            Self::ExportProfiles => "Export profiles as CSV…",
            Self::Quit => "Quit",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::CopyReadouts => "Copy read-outs",
            Self::Pin => "Pin curve",
            Self::Unpin => "Remove all pins",
            Self::Palette => "Command palette…",
            Self::Presentation => "Presentation",
            Self::Overlay => "Show or hide the full solution",
            Self::Difference => "Show or hide the difference",
            Self::FitPlots => "Fit plots to data",
            Self::LightTheme => "Light theme",
            Self::DarkTheme => "Dark theme",
            Self::SystemTheme => "System theme",
            Self::LargerText => "Larger text",
            Self::SmallerText => "Smaller text",
            Self::NormalText => "Normal text",
            Self::ResetLayout => "Reset layout",
            Self::Verify => "Verify now",
            Self::EstimateGridError => "Estimate grid error",
            Self::SolveAlong => "Full solutions along the traction curve",
            Self::RunInTime => "Run in time",
            Self::Train => "Start training",
            Self::Cancel => "Cancel",
            Self::Manual => "Manual",
            Self::Keyboard => "Keyboard",
            Self::About => "About EHL Explorer",
            _ => "",
        }
    }

    /// Other words that people look for it by.
    pub fn synonyms(&self) -> &'static str {
        match self {
            Self::ExportPlot => "picture figure image svg png",
            Self::ExportProfiles => "table data",
            Self::CopyReadouts => "clipboard table values",
            Self::Pin => "compare keep",
            Self::Presentation => "full screen projector lecture",
            Self::Overlay | Self::Difference => "overlay reduced compare",
            Self::FitPlots => "zoom reset axes",
            Self::LightTheme | Self::DarkTheme | Self::SystemTheme => "colours colors mode",
            Self::LargerText | Self::SmallerText | Self::NormalText => "zoom font size scale",
            Self::ResetLayout => "tabs panels windows",
            Self::Verify => "full solve check",
            Self::EstimateGridError => "accuracy nodes refine",
            Self::RunInTime => "transient march",
            Self::Train => "reduced model snapshots",
            Self::Cancel => "stop abort",
            Self::Manual => "help documentation tour physics",
            Self::Keyboard => "keys shortcuts help",
            _ => "",
        }
    }

    /// Its key, when it has one.
    pub fn shortcut(&self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::New => (Modifiers::COMMAND, Key::N),
            Self::Open => (Modifiers::COMMAND, Key::O),
            Self::Save => (Modifiers::COMMAND, Key::S),
            Self::SaveAs => (CTRL_SHIFT, Key::S),
            Self::ExportPlot => (Modifiers::COMMAND, Key::E),
            Self::Quit => (Modifiers::COMMAND, Key::Q),
            Self::Undo => (Modifiers::COMMAND, Key::Z),
            Self::Redo => (CTRL_SHIFT, Key::Z),
            Self::CopyReadouts => (CTRL_SHIFT, Key::C),
            Self::Pin => (Modifiers::COMMAND, Key::D),
            Self::Unpin => (CTRL_SHIFT, Key::D),
            Self::Palette => (Modifiers::COMMAND, Key::P),
            Self::Presentation => (Modifiers::NONE, Key::F11),
            Self::FitPlots => (Modifiers::NONE, Key::F2),
            Self::LargerText => (Modifiers::COMMAND, Key::Plus),
            Self::SmallerText => (Modifiers::COMMAND, Key::Minus),
            Self::NormalText => (Modifiers::COMMAND, Key::Num0),
            Self::Verify => (Modifiers::NONE, Key::F5),
            Self::Cancel => (Modifiers::NONE, Key::Escape),
            Self::Manual => (Modifiers::NONE, Key::F1),
            _ => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

    /// The commands whose keys were pressed in this frame.
    pub fn pressed(ctx: &Context) -> Vec<Self> {
        // A text field keeps its own undo, and Escape must still leave it.
        let typing = ctx.text_edit_focused();
        let left_to_fields = [Self::Undo, Self::Redo, Self::Cancel];
        let keys = Self::all().filter_map(|(_, command)| {
            let shortcut = command.shortcut()?;
            Some((command, shortcut))
        });
        let keys = keys.filter(|(command, _)| !(typing && left_to_fields.contains(command)));
        // Those with Shift first: Ctrl+Shift+Z must not be taken for Ctrl+Z.
        let (shifted, plain): (Vec<_>, Vec<_>) = keys.partition(|(_, shortcut)| shortcut.modifiers.shift);
        let pressed = |shortcut: &KeyboardShortcut| ctx.input_mut(|i| i.consume_shortcut(shortcut));
        let both = shifted.into_iter().chain(plain);
        both.filter(|(_, shortcut)| pressed(shortcut)).map(|(command, _)| command).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_command_stands_in_two_menus_and_no_key_or_name_means_two_things() {
        let all: Vec<Command> = Command::all().map(|(_, command)| command).collect();
        for (k, command) in all.iter().enumerate() {
            for other in &all[..k] {
                assert_ne!(command, other);
                assert_ne!(command.name(), other.name());
                assert!(command.shortcut().is_none() || command.shortcut() != other.shortcut(), "{}", command.name());
            }
        }
    }
}
