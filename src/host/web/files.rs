//! Files of a page: those that the user has chosen stand in memory, those of the session are kept by the browser, and
//! everything else that is written is offered for download.

use super::page;
use std::cell::RefCell;
use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

/// Folder of what the browser keeps.
pub const SESSION: &str = "/session";
/// Folder of what the user has chosen.
pub(super) const CHOSEN: &str = "/chosen";

thread_local! {
    /// By path; nothing where a file was too large to be read.
    static FILES: RefCell<HashMap<PathBuf, Option<Vec<u8>>>> = RefCell::default();
}

fn missing() -> io::Error {
    io::Error::new(io::ErrorKind::NotFound, "no such file was opened in this page")
}

fn kept(path: &Path) -> Option<String> {
    path.starts_with(SESSION).then(|| page::kept(&path.to_string_lossy())).flatten()
}

/// Takes a file that the user has chosen: its name, a zero, its content; the name alone where the file is too large to
/// be read. Returns its path.
pub fn arrived(file: &[u8]) -> PathBuf {
    let mut parts = file.splitn(2, |byte| *byte == 0);
    let name = String::from_utf8_lossy(parts.next().unwrap_or_default()).into_owned();
    let content = parts.next().map(<[u8]>::to_vec);
    FILES.with_borrow_mut(|files| {
        // A file that is chosen anew may have changed: it gets a folder of its own.
        let path = Path::new(CHOSEN).join(files.len().to_string()).join(name);
        files.insert(path.clone(), content);
        path
    })
}

/// Reads a file, at most so many bytes of it.
///
/// # Errors
/// When there is none.
pub fn read_at_most(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    if let Some(text) = kept(path) {
        return Ok(text.into_bytes().into_iter().take(most).collect());
    }
    FILES.with_borrow(|files| {
        let bytes = files.get(path).ok_or_else(missing)?;
        let bytes =
            bytes.as_ref().ok_or_else(|| io::Error::new(io::ErrorKind::FileTooLarge, "it is larger than 64 MiB"))?;
        Ok(bytes.get(..most).unwrap_or(bytes).to_vec())
    })
}

/// Size of a file \[bytes\].
///
/// # Errors
/// When there is none.
pub fn size(path: &Path) -> io::Result<u64> {
    Ok(read_at_most(path, u64::MAX)?.len() as u64)
}

/// Whether there is a file of this path.
pub fn exists(path: &Path) -> bool {
    size(path).is_ok()
}

/// There are no folders.
///
/// # Errors
/// Never.
pub fn make_folder(_path: &Path) -> io::Result<()> {
    Ok(())
}

/// Gives a file another name.
///
/// # Errors
/// When there is none, or it cannot be kept.
pub fn rename(path: &Path, other: &Path) -> io::Result<()> {
    replace(other, &read_at_most(path, u64::MAX)?)
}

/// Keeps a file of the session, or offers a file for download.
///
/// # Errors
/// When the browser cannot keep it.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if !path.starts_with(SESSION) {
        page::download(&path.file_name().unwrap_or_default().to_string_lossy(), bytes);
        return Ok(());
    }
    let refused = page::keep(&path.to_string_lossy(), &String::from_utf8_lossy(bytes));
    refused.map_or(Ok(()), |why| Err(io::Error::new(io::ErrorKind::StorageFull, why)))
}
