//! File dialogs of the browser.

use super::{files, page};
use crate::host::wanted::Wanted;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};

/// Whether a path can also be typed.
pub const TYPED: bool = false;

/// Opens a dialog and calls when it is closed. The answer is a path, or nothing. A file that is to be written needs no
/// dialog: the browser asks by itself where it goes.
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
        // The window may be closed by now.
        let _ = sender.send(chosen.map(|file| files::arrived(&file)));
        if let Some(call) = call.take() {
            call();
        }
        false
    });
    page::pick(&endings.join(","), ticket);
    receiver
}
