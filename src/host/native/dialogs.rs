//! File dialogs of the operating system.

use super::worker;
use crate::host::wanted::Wanted;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};

/// True if the user can also type a path.
pub const TYPED: bool = true;

/// Opens a dialog and calls `call` when it is closed. The channel returns a path, or `None` after a cancel. If the
/// system has no dialog, the channel is closed immediately.
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
        // The window may be closed already. Then there is no receiver.
        if sender.send(answer).is_ok() {
            call();
        }
    };
    // Without a thread the receiver is disconnected immediately.
    let _handle = worker::spawn("file dialog", run);
    receiver
}
