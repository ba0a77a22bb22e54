//! Everything the user can ask for by menu or key, in one place.

use egui::{Context, Key, KeyboardShortcut, Modifiers};

/// What the user can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    /// Full solutions along the traction curve.
    SolveAlong,
    /// Stop what runs.
    Cancel,
    /// List of keys.
    Keyboard,
    /// What this program is.
    About,
}

const CTRL_SHIFT: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

impl Command {
    /// All of them, longest shortcuts first so that Ctrl+Shift+Z is not taken for Ctrl+Z.
    pub const ALL: [Self; 24] = [
        Self::Redo,
        Self::SaveAs,
        Self::CopyReadouts,
        Self::Unpin,
        Self::New,
        Self::Open,
        Self::Save,
        Self::ExportPlot,
        Self::Quit,
        Self::Undo,
        Self::Pin,
        Self::FitPlots,
        Self::LightTheme,
        Self::DarkTheme,
        Self::SystemTheme,
        Self::LargerText,
        Self::SmallerText,
        Self::NormalText,
        Self::ResetLayout,
        Self::Verify,
        Self::SolveAlong,
        Self::Cancel,
        Self::Keyboard,
        Self::About,
    ];

    /// As menus show it; `…` where a dialog follows.
    pub fn name(self) -> &'static str {
        match self {
            Self::New => "New",
            Self::Open => "Open…",
            Self::Save => "Save",
            Self::SaveAs => "Save as…",
            Self::ExportPlot => "Export plot…",
            Self::Quit => "Quit",
            Self::Undo => "Undo",
            Self::Redo => "Redo",
            Self::CopyReadouts => "Copy read-outs",
            Self::Pin => "Pin curve",
            Self::Unpin => "Remove all pins",
            Self::FitPlots => "Fit plots to data",
            Self::LightTheme => "Light theme",
            Self::DarkTheme => "Dark theme",
            Self::SystemTheme => "System theme",
            Self::LargerText => "Larger text",
            Self::SmallerText => "Smaller text",
            Self::NormalText => "Normal text",
            Self::ResetLayout => "Reset layout",
            Self::Verify => "Verify now",
            Self::SolveAlong => "Full solutions along the traction curve",
            Self::Cancel => "Cancel",
            Self::Keyboard => "Keyboard",
            Self::About => "About EHL Explorer",
        }
    }

    /// Its key, when it has one.
    pub fn shortcut(self) -> Option<KeyboardShortcut> {
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
            Self::FitPlots => (Modifiers::NONE, Key::F2),
            Self::LargerText => (Modifiers::COMMAND, Key::Plus),
            Self::SmallerText => (Modifiers::COMMAND, Key::Minus),
            Self::NormalText => (Modifiers::COMMAND, Key::Num0),
            Self::Verify => (Modifiers::NONE, Key::F5),
            Self::Cancel => (Modifiers::NONE, Key::Escape),
            Self::Keyboard => (Modifiers::NONE, Key::F1),
            _ => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }

    /// The commands whose keys were pressed in this frame.
    pub fn pressed(ctx: &Context) -> Vec<Self> {
        // A text field keeps its own undo, and Escape must still leave it.
        let typing = ctx.text_edit_focused();
        let left_to_fields = [Self::Undo, Self::Redo, Self::Cancel];
        Self::ALL
            .into_iter()
            .filter(|command| !(typing && left_to_fields.contains(command)))
            .filter(|command| command.shortcut().is_some_and(|s| ctx.input_mut(|i| i.consume_shortcut(&s))))
            .collect()
    }
}
