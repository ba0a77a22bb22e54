//! Why a contact is refused.

use super::fields::Field;
use super::words::Words;

/// A field that is refused, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The field.
    pub field: Field,
    /// The sentence, in which fields stand as `<radius-y>`.
    sentence: String,
}

impl Refusal {
    /// Refuses a field with a sentence, in which fields stand as `<radius-y>` or `<grid=model>`.
    pub(in crate::scene) fn new(field: Field, sentence: impl Into<String>) -> Self {
        Self { field, sentence: sentence.into() }
    }

    /// The sentence in the words of an interface.
    pub fn in_words(&self, words: Words) -> String {
        words.spelled(&self.sentence)
    }
}

/// Refuses a field.
pub(super) fn refuse<T>(field: Field, sentence: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal::new(field, sentence))
}
