//! Writes a file as a whole or not at all, and explains why a file cannot be written.

use crate::host::files;
use std::io;
use std::path::{Path, PathBuf};

/// Error of [`replace`]. An existing file is unchanged.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {}; choose a file in a folder that exists and may be written", path.display(), said(reason))]
pub struct WriteError {
    /// File that could not be written.
    pub path: PathBuf,
    /// Reason given by the system.
    pub reason: io::Error,
}

/// Returns the reason of a file error as text. The text of the system is replaced where it is only a number.
pub fn said(reason: &io::Error) -> String {
    match reason.kind() {
        io::ErrorKind::InvalidFilename => "its name is longer than the system accepts".to_owned(),
        _ => reason.to_string(),
    }
}

/// Writes `bytes` to a temporary file in the same folder, which then replaces the file at `path`. A failure never
/// leaves half a file.
///
/// # Errors
/// If the folder does not exist or cannot be written.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    files::replace(path, bytes).map_err(|reason| WriteError { path: path.to_owned(), reason })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn replaces_whole_files_and_leaves_nothing_beside_them() {
        let folder = std::env::temp_dir().join(format!("ehl-atomic-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.txt");
        replace(&path, b"one").unwrap();
        replace(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        #[cfg(unix)]
        {
            use std::os::unix::fs::{PermissionsExt, symlink};
            let plain = folder.join("b.txt");
            fs::write(&plain, b"b").unwrap();
            let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
            assert_eq!(mode(&path), mode(&plain), "it has the permissions of any other file");
            let link = folder.join("link");
            symlink(&path, &link).unwrap();
            replace(&link, b"three").unwrap();
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink() && fs::read(&path).unwrap() == b"three");
        }
        assert!(replace(&folder, b"x").unwrap_err().to_string().contains("folder"));
        assert!(replace(&folder.join("missing/a.txt"), b"x").is_err());
        fs::remove_dir_all(&folder).unwrap();
    }
}
