//! Catalogue entry of a model file: kind, title, trained range, size and hash. It is read from the directory of the
//! file, without decoding its arrays.

use super::container::{Contents, ModelKind};
use super::error::ModelFileError;
use super::sound::domain;
use crate::engine::checked_file::{HEADER, hash_of};
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::Domain;

/// Properties of a model, read from the directory of its file. No array is decoded.
#[derive(Clone, Debug, PartialEq)]
pub struct Catalogue {
    /// Steady or transient model.
    pub kind: ModelKind,
    /// Line or point contact.
    pub contact: ContactKind,
    /// Title for display.
    pub title: String,
    /// Trained range. For a transient model, the range of its reference contacts.
    pub domain: Domain,
    /// Size of the file \[bytes\].
    pub bytes: usize,
    /// Hash of the content, as stored in the header.
    pub hash: u64,
}

impl Catalogue {
    /// Reads the entry from a whole file. Does not check the hash.
    ///
    /// # Errors
    /// If the file has another format or version, is truncated, or has a damaged directory.
    pub fn of(bytes: &[u8]) -> Result<Self, ModelFileError> {
        Self::from(&Contents::unchecked(bytes)?, bytes)
    }

    /// Reads the entry from the beginning of a file, with header and directory. The arrays may be missing.
    ///
    /// # Errors
    /// As [`Self::of`].
    pub fn of_head(bytes: &[u8]) -> Result<Self, ModelFileError> {
        Self::from(&Contents::of_head(bytes)?, bytes)
    }

    fn from(contents: &Contents<'_>, head: &[u8]) -> Result<Self, ModelFileError> {
        let (title, ..) = contents.texts();
        let (kind, contact, domain) = (contents.kind(), contents.contact(), domain(contents)?);
        Ok(Self { kind, contact, title, domain, bytes: HEADER + contents.bytes, hash: hash_of(head) })
    }
}
