//! Files of the operating system.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

/// Reads at most `most` bytes of a file. The limit is needed because devices and pipes have no length.
///
/// # Errors
/// If the file cannot be read.
pub fn read_at_most(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Returns the size of a file \[bytes\].
///
/// # Errors
/// If the file does not exist or its metadata cannot be read.
pub fn size(path: &Path) -> io::Result<u64> {
    Ok(fs::metadata(path)?.len())
}

/// Returns true if a file or folder has this path.
pub fn exists(path: &Path) -> bool {
    path.exists()
}

/// Creates a folder and its parents.
///
/// # Errors
/// If the system refuses.
pub fn make_folder(path: &Path) -> io::Result<()> {
    fs::create_dir_all(path)
}

/// Renames a file.
///
/// # Errors
/// If the system refuses.
pub fn rename(path: &Path, other: &Path) -> io::Result<()> {
    fs::rename(path, other)
}

/// Writes a file. The bytes go to a temporary file in the same folder, which then replaces the file. A failure
/// therefore never leaves half a file.
///
/// # Errors
/// If the folder does not exist or cannot be written.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    // Follow a link. Write to a device or pipe instead of replacing it.
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
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // A name of full length leaves no room for a prefix.
    let prefix: String = format!(".{}.", name.to_string_lossy()).chars().take(40).collect();
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    // Give the file the usual permissions of this user instead of the restricted ones of a temporary file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut beside = builder.tempfile_in(folder)?;
    beside.write_all(bytes)?;
    beside.as_file().sync_all()?;
    // If `persist` fails, the temporary file is removed.
    beside.persist(&target).map(|_| ()).map_err(|refused| refused.error)
}
