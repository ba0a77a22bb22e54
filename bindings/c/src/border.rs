//! Functions for the C interface: strings, messages, and conversion of panics into errors.

use std::ffi::{CStr, c_char};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Reason of a refusal, as a sentence for the caller.
pub struct Refused(pub String);

impl<E: Display> From<E> for Refused {
    fn from(reason: E) -> Self {
        Self(reason.to_string())
    }
}

/// Runs a function and converts a panic into an error message.
pub fn guarded<T>(work: impl FnOnce() -> Result<T, Refused>) -> Result<T, Refused> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| Err("the solver stopped unexpectedly".into()))
}

/// Returns a C string; `None` if it is null or not UTF-8.
///
/// # Safety
/// `text` is null or ends with a zero, and lives as long as the result is used.
pub unsafe fn text_of<'a>(text: *const c_char) -> Option<&'a str> {
    if text.is_null() {
        return None;
    }
    // SAFETY: it is not null; the rest is guaranteed by the caller.
    unsafe { CStr::from_ptr(text) }.to_str().ok()
}

/// Writes a message into a buffer. A message that is too long is cut off between characters.
///
/// # Safety
/// The buffer is null or writable for `length` bytes.
pub unsafe fn write_message(buffer: *mut c_char, length: usize, message: &str) {
    let Some(room) = length.checked_sub(1).filter(|_| !buffer.is_null()) else { return };
    let end = (0..=room.min(message.len())).rev().find(|end| message.is_char_boundary(*end)).unwrap_or(0);
    // SAFETY: the buffer has room for `end` bytes and a zero, and does not overlap a Rust string.
    unsafe {
        buffer.copy_from_nonoverlapping(message.as_ptr().cast(), end);
        buffer.add(end).write(0);
    }
}

/// Returns values passed by the simulation; empty if the pointer is null.
///
/// # Safety
/// `pointer` is null or points to `length` values, which do not change as long as the result is used.
pub unsafe fn slice<'a, T>(pointer: *const T, length: usize) -> &'a [T] {
    if pointer.is_null() {
        return &[];
    }
    // SAFETY: guaranteed by the caller.
    unsafe { std::slice::from_raw_parts(pointer, length) }
}

/// Returns a place for values of the simulation; empty if the pointer is null.
///
/// # Safety
/// `pointer` is null or points to `length` values, which only the result uses as long as it is used.
pub unsafe fn slice_mut<'a, T>(pointer: *mut T, length: usize) -> &'a mut [T] {
    if pointer.is_null() {
        return &mut [];
    }
    // SAFETY: guaranteed by the caller.
    unsafe { std::slice::from_raw_parts_mut(pointer, length) }
}
