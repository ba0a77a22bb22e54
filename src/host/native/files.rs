//! Files of the system.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::Path;

/// Reads a file, at most so many bytes of it: devices and pipes announce no length.
///
/// # Errors
/// When it cannot be read.
pub fn read_at_most(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Size of a file \[bytes\].
///
/// # Errors
/// When there is none, or it cannot be asked.
pub fn size(path: &Path) -> io::Result<u64> {
    Ok(fs::metadata(path)?.len())
}

/// Whether there is a file or folder of this path.
pub fn exists(path: &Path) -> bool {
    path.exists()
}

/// Makes a folder and those above it.
///
/// # Errors
/// When the system refuses.
pub fn make_folder(path: &Path) -> io::Result<()> {
    fs::create_dir_all(path)
}

/// Gives a file another name.
///
/// # Errors
/// When the system refuses.
pub fn rename(path: &Path, other: &Path) -> io::Result<()> {
    fs::rename(path, other)
}

/// Writes a file: first beside it, then in its place, so that a failure never leaves half a file.
///
/// # Errors
/// When the folder does not exist or cannot be written.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
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
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // A name of full length leaves no room for more.
    let prefix: String = format!(".{}.", name.to_string_lossy()).chars().take(40).collect();
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    // Others may read it as any file of this user, not only this user as a temporary one.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut beside = builder.tempfile_in(folder)?;
    beside.write_all(bytes)?;
    beside.as_file().sync_all()?;
    // What is not put in its place is removed.
    beside.persist(&target).map(|_| ()).map_err(|refused| refused.error)
}
