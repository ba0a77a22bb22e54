//! Refusal of a contact.

use super::fields::Field;
use super::words::Words;

/// Refused field with the reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// The field.
    pub field: Field,
    /// Reason. Fields are written as `<radius-y>`.
    sentence: String,
}

impl Refusal {
    /// Refuses a field with a sentence. Fields are written as `<radius-y>` or `<grid=model>`.
    pub(in crate::scene) fn new(field: Field, sentence: impl Into<String>) -> Self {
        Self { field, sentence: sentence.into() }
    }

    /// Returns the sentence with fields spelled as in an interface.
    pub fn in_words(&self, words: Words) -> String {
        words.spelled(&self.sentence)
    }
}

/// Refuses a field.
pub(super) fn refuse<T>(field: Field, sentence: impl Into<String>) -> Result<T, Refusal> {
    Err(Refusal::new(field, sentence))
}
