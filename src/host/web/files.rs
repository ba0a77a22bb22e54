//! Files of the web page, with the same functions as files of the desktop program. Files that the user has chosen are
//! kept in memory, and the browser stores the text files of the session. All other written files are offered for
//! download.

use super::page;
use std::cell::RefCell;
use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};

/// Folder of the files that the browser stores.
pub const SESSION: &str = "/session";
/// Folder of the files that the user has chosen.
pub(super) const CHOSEN: &str = "/chosen";

thread_local! {
    /// Content by path. `None` if a file was too large to be read.
    static FILES: RefCell<HashMap<PathBuf, Option<Vec<u8>>>> = RefCell::default();
}

fn missing() -> io::Error {
    io::Error::new(io::ErrorKind::NotFound, "no such file was opened in this page")
}

/// Returns a stored file of the session; `None` for other paths.
fn session_file(path: &Path) -> Option<String> {
    path.starts_with(SESSION).then(|| page::kept(&path.to_string_lossy())).flatten()
}

/// Stores a file that the user has chosen and returns its path. `file` consists of the name, a zero byte and the
/// content, or only of the name if the file is too large to be read.
pub fn arrived(file: &[u8]) -> PathBuf {
    let mut parts = file.splitn(2, |byte| *byte == 0);
    let name = String::from_utf8_lossy(parts.next().unwrap_or_default()).into_owned();
    let content = parts.next().map(<[u8]>::to_vec);
    FILES.with_borrow_mut(|files| {
        // A file that is chosen again may have changed. Therefore every choice gets a separate folder.
        let path = Path::new(CHOSEN).join(files.len().to_string()).join(name);
        files.insert(path.clone(), content);
        path
    })
}

/// Reads at most `most` bytes of a file.
///
/// # Errors
/// If there is no such file, or it was too large to be read.
pub fn read_at_most(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    if let Some(text) = session_file(path) {
        return Ok(text.into_bytes().into_iter().take(most).collect());
    }
    FILES.with_borrow(|files| {
        let bytes = files.get(path).ok_or_else(missing)?;
        let bytes =
            bytes.as_ref().ok_or_else(|| io::Error::new(io::ErrorKind::FileTooLarge, "it is larger than 64 MiB"))?;
        Ok(bytes.get(..most).unwrap_or(bytes).to_vec())
    })
}

/// Returns the size of a file \[bytes\].
///
/// # Errors
/// If there is no such file, or it was too large to be read.
pub fn size(path: &Path) -> io::Result<u64> {
    Ok(read_at_most(path, u64::MAX)?.len() as u64)
}

/// Returns true if the file with this path can be read.
pub fn exists(path: &Path) -> bool {
    size(path).is_ok()
}

/// Does nothing, because a page has no folders.
///
/// # Errors
/// Never.
pub fn make_folder(_path: &Path) -> io::Result<()> {
    Ok(())
}

/// Copies a file to another path. The original remains.
///
/// # Errors
/// If it cannot be read, or the browser cannot store it.
pub fn rename(path: &Path, other: &Path) -> io::Result<()> {
    replace(other, &read_at_most(path, u64::MAX)?)
}

/// Stores a text file of the session. Offers any other file for download.
///
/// # Errors
/// If the browser cannot store it.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if !path.starts_with(SESSION) {
        page::download(&path.file_name().unwrap_or_default().to_string_lossy(), bytes);
        return Ok(());
    }
    let refused = page::keep(&path.to_string_lossy(), &String::from_utf8_lossy(bytes));
    refused.map_or(Ok(()), |why| Err(io::Error::new(io::ErrorKind::StorageFull, why)))
}
