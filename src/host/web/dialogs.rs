//! File dialogs of the browser.

use super::{files, page};
use crate::host::wanted::Wanted;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};

/// True if the user can also type a path.
pub const TYPED: bool = false;

/// Opens a dialog and calls `call` when it is closed. The channel returns a path, or `None` after a cancel. A file
/// to be written needs no dialog, because the browser itself asks where to store it.
pub fn ask(wanted: Wanted, call: impl FnOnce() + Send + 'static) -> Receiver<Option<PathBuf>> {
    let (sender, receiver) = channel();
    if !wanted.reads {
        let _ = sender.send(Some(wanted.suggestion));
        call();
        return receiver;
    }
    let mut call = Some(call);
    let endings: Vec<String> = wanted.endings.iter().map(|ending| format!(".{ending}")).collect();
    let ticket = page::ticket(move |chosen| {
        // The window may be closed already.
        let _ = sender.send(chosen.map(|file| files::arrived(&file)));
        if let Some(call) = call.take() {
            call();
        }
        false
    });
    page::pick(&endings.join(","), ticket);
    receiver
}
