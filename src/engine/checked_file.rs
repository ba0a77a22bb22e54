//! Files with a checked header, used for reduced models, unfinished trainings and shards.
//!
//! Layout: magic (8 bytes), version (u32), payload length (u64), XXH3 hash of everything else (u64), all little-endian;
//! then the payload, and nothing after it.

use crate::host::files;
use std::io;
use std::path::Path;
use xxhash_rust::xxh3::Xxh3;

/// Number of bytes before the hash.
const BEFORE_HASH: usize = 20;
/// Number of bytes before the payload.
pub(super) const HEADER: usize = 28;

/// File format.
pub(super) struct Format {
    /// Magic bytes at the beginning.
    pub magic: &'static [u8; 8],
    /// Version for writing and reading.
    pub version: u32,
    /// Largest accepted payload \[bytes\].
    pub max_payload: u64,
}

/// Error in the content of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flaw {
    /// Not a file of this format.
    Foreign,
    /// Another version.
    OtherVersion { found: u32 },
    /// Fewer bytes than announced in the header.
    Truncated { found: u64, wanted: u64 },
    /// The header announces more bytes than accepted.
    TooLarge { bytes: u64 },
    /// The hash does not match.
    Changed,
}

/// Reason why a file cannot be read.
pub(super) enum Unreadable {
    /// Error of the system.
    Io(io::Error),
    /// Error in the content.
    Flaw(Flaw),
}

impl From<io::Error> for Unreadable {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl From<Flaw> for Unreadable {
    fn from(flaw: Flaw) -> Self {
        Self::Flaw(flaw)
    }
}

impl Format {
    /// Returns the content of a file with this payload.
    pub fn seal(&self, payload: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(HEADER + payload.len());
        bytes.extend_from_slice(self.magic);
        bytes.extend_from_slice(&self.version.to_le_bytes());
        bytes.extend_from_slice(&(payload.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&hash(&bytes, payload).to_le_bytes());
        bytes.extend_from_slice(payload);
        bytes
    }

    /// Returns the payload of a file's content, and checks the hash.
    pub fn open<'a>(&self, bytes: &'a [u8]) -> Result<&'a [u8], Flaw> {
        let payload = self.payload(bytes)?;
        let own = hash(bytes.get(..BEFORE_HASH).unwrap_or_default(), payload);
        let whole = bytes.len() == HEADER + payload.len();
        if whole && hash_of(bytes) == own { Ok(payload) } else { Err(Flaw::Changed) }
    }

    /// Returns the payload without checking the hash.
    pub fn payload<'a>(&self, bytes: &'a [u8]) -> Result<&'a [u8], Flaw> {
        let announced = self.announced(bytes)?;
        let rest = bytes.get(HEADER..).unwrap_or_default();
        let cut = Flaw::Truncated { found: bytes.len() as u64, wanted: announced + HEADER as u64 };
        usize::try_from(announced).ok().and_then(|length| rest.get(..length)).ok_or(cut)
    }

    /// Reads a whole file. The announced size is checked before memory is allocated.
    pub fn read(&self, path: &Path) -> Result<Vec<u8>, Unreadable> {
        let length = files::size(path)?;
        let wanted = self.announced(&files::read_at_most(path, HEADER as u64)?)? + HEADER as u64;
        if length < wanted {
            return Err(Flaw::Truncated { found: length, wanted }.into());
        }
        // One additional byte shows whether the file continues after the payload.
        Ok(files::read_at_most(path, wanted + 1)?)
    }

    /// Checks magic, version and announced size.
    pub fn announced(&self, bytes: &[u8]) -> Result<u64, Flaw> {
        if !bytes.starts_with(self.magic) {
            return Err(Flaw::Foreign);
        }
        if bytes.len() < HEADER {
            return Err(Flaw::Truncated { found: bytes.len() as u64, wanted: HEADER as u64 });
        }
        let found = u64_at(bytes, 8).unwrap_or_default() as u32;
        if found != self.version {
            return Err(Flaw::OtherVersion { found });
        }
        let announced = u64_at(bytes, 12).unwrap_or_default();
        if announced > self.max_payload {
            return Err(Flaw::TooLarge { bytes: announced });
        }
        Ok(announced)
    }
}

fn hash(before: &[u8], payload: &[u8]) -> u64 {
    let mut hash = Xxh3::new();
    hash.update(before);
    hash.update(payload);
    hash.digest()
}

/// Returns the hash stored in a file's content.
pub(super) fn hash_of(bytes: &[u8]) -> u64 {
    u64_at(bytes, BEFORE_HASH).unwrap_or_default()
}

fn u64_at(bytes: &[u8], at: usize) -> Option<u64> {
    bytes.get(at..at + 8)?.try_into().ok().map(u64::from_le_bytes)
}
