//! What the text of a document leaves out.

/// Whether a field may be left out of the text of a scene.
pub(in crate::scene) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}
