//! Replacing a file as a whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file could not be written; whatever stood there before still does.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {reason}; choose a file in a folder that exists and may be written", path.display())]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// Why.
    pub reason: io::Error,
}

/// Writes `bytes` to `path`: first beside it, then in its place, so that a failure never leaves half a file.
///
/// # Errors
/// When the folder does not exist or cannot be written.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write(path, bytes).map_err(|reason| WriteError { path: path.to_owned(), reason })
}

fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // A link is followed, and a device or pipe is written to instead of being replaced.
    let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    if let Ok(metadata) = fs::metadata(&target) {
        if metadata.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        }
        if !metadata.is_file() {
            return File::options().write(true).open(&target)?.write_all(bytes);
        }
    }
    let name = target.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "it names no file"))?;
    let beside = target.with_file_name(format!(".{}.{}.part", name.to_string_lossy(), std::process::id()));
    let written = File::create(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    let done = written.and_then(|()| fs::rename(&beside, &target));
    if done.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&beside);
    }
    done
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_whole_files_and_leaves_nothing_beside_them() {
        let folder = std::env::temp_dir().join(format!("ehl-atomic-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.txt");
        replace(&path, b"one").unwrap();
        replace(&path, b"two").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        assert!(replace(&folder, b"x").unwrap_err().to_string().contains("folder"));
        assert!(replace(&folder.join("missing/a.txt"), b"x").is_err());
        fs::remove_dir_all(&folder).unwrap();
    }
}
