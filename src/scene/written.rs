//! Rule for leaving fields out of a scene's text.

/// Returns true if a field has its default value and may be left out.
pub(in crate::scene) fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}
