//! Catalogue entry of a model file, read without its arrays.

use super::container::{Contents, ModelKind};
use super::error::ModelFileError;
use super::sound::domain;
use crate::engine::checked_file::{HEADER, hash_of};
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::Domain;

/// Properties of a model, read from the directory of its file. No array is decoded.
#[derive(Clone, Debug, PartialEq)]
pub struct Catalogue {
    /// Steady or transient.
    pub kind: ModelKind,
    /// Contact kind.
    pub contact: ContactKind,
    /// Title.
    pub title: String,
    /// Trained range; for a transient model that of its reference contacts.
    pub domain: Domain,
    /// Size of the file \[bytes\].
    pub bytes: usize,
    /// Hash of the content.
    pub hash: u64,
}

impl Catalogue {
    /// Reads the entry from the content of a file. Does not check the hash.
    ///
    /// # Errors
    /// If the file has another format or version, is truncated, or has a damaged directory.
    pub fn of(bytes: &[u8]) -> Result<Self, ModelFileError> {
        Self::from(&Contents::unchecked(bytes)?, bytes)
    }

    /// Reads the entry from header and directory alone.
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
