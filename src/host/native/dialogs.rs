//! File dialogs of the system.

use super::worker;
use crate::host::wanted::Wanted;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};

/// Whether a path can also be typed.
pub const TYPED: bool = true;

/// Opens a dialog and calls when it is closed. The answer is a path, or nothing; where there is no dialog, the channel is
/// closed at once.
pub fn ask(wanted: Wanted, call: impl FnOnce() + Send + 'static) -> Receiver<Option<PathBuf>> {
    let (sender, receiver) = channel();
    let run = move || {
        let Wanted { reads, files, endings, suggestion } = wanted;
        let name = suggestion.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let mut dialog = rfd::FileDialog::new().add_filter(files, endings);
        if let Some(folder) = suggestion.parent().filter(|p| p.is_dir()) {
            dialog = dialog.set_directory(folder);
        }
        let answer = if reads { dialog.pick_file() } else { dialog.set_file_name(name).save_file() };
        // The window may be closed by now: then nobody waits for the answer.
        if sender.send(answer).is_ok() {
            call();
        }
    };
    // Without a thread the receiver is disconnected at once.
    let _handle = worker::spawn("file dialog", run);
    receiver
}
