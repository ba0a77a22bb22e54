//! What crosses the border to C: texts, messages, and never a panic.

use std::ffi::{CStr, c_char};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Why something is refused, as the sentence that crosses the border.
pub struct Refused(pub String);

impl<E: Display> From<E> for Refused {
    fn from(reason: E) -> Self {
        Self(reason.to_string())
    }
}

/// The result of some work; a panic becomes a sentence.
pub fn guarded<T>(work: impl FnOnce() -> Result<T, Refused>) -> Result<T, Refused> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Err("the solver stopped unexpectedly".into()))
}

/// A text of C; none where it is null or no UTF-8.
///
/// # Safety
/// It is null or ends with a zero, and lives as long as what is made of it is used.
pub unsafe fn text_of<'a>(text: *const c_char) -> Option<&'a str> {
    if text.is_null() {
        return None;
    }
    // SAFETY: it is not null; the rest is the caller's promise.
    unsafe { CStr::from_ptr(text) }.to_str().ok()
}

/// Writes a message into a buffer, cut off where it is too long, between characters.
///
/// # Safety
/// The buffer is null or writable for `length` bytes.
pub unsafe fn write_message(buffer: *mut c_char, length: usize, message: &str) {
    let Some(room) = length.checked_sub(1).filter(|_| !buffer.is_null()) else { return };
    let end = (0..=room.min(message.len())).rev().find(|end| message.is_char_boundary(*end)).unwrap_or(0);
    // SAFETY: the buffer has room for `end` bytes and a zero, and is no part of a Rust text.
    unsafe {
        buffer.copy_from_nonoverlapping(message.as_ptr().cast(), end);
        buffer.add(end).write(0);
    }
}
