//! Messages to the simulation.

use crate::border::text_of;
use ehl_explorer::engine::coupled::fmu::IDENTIFIER;
use std::ffi::{CString, c_char, c_int, c_void};

/// Status of a call, with the same numbers in both versions of the standard.
pub const OK: c_int = 0;
/// The call has an answer, with warnings.
pub const WARNING: c_int = 1;
/// The call was refused, and the instance is unchanged.
pub const DISCARD: c_int = 2;
/// The call failed.
pub const ERROR: c_int = 3;

/// `fmi2CallbackLogger`.
pub type Logger2 = unsafe extern "C" fn(
    *mut c_void,
    *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
    ...
);

/// `fmi3LogMessageCallback`.
pub type Logger3 = unsafe extern "C" fn(*mut c_void, status: c_int, category: *const c_char, message: *const c_char);

/// Logger of the simulation.
#[derive(Clone, Copy)]
pub enum Logger {
    Two(Logger2),
    Three(Logger3),
}

/// Recipient of messages about one instance.
pub struct Log {
    /// Name of the instance.
    name: CString,
    /// `None` if the simulation has no logger.
    logger: Option<Logger>,
    /// Pointer of the simulation, passed to the logger.
    environment: *mut c_void,
}

impl Log {
    /// Returns the log of an instance with a name.
    ///
    /// # Safety
    /// The name is null or ends with a zero; the logger accepts the environment.
    pub unsafe fn new(name: *const c_char, logger: Option<Logger>, environment: *mut c_void) -> Self {
        // SAFETY: guaranteed by the caller.
        let name = unsafe { text_of(name) };
        Self { name: CString::new(name.unwrap_or(IDENTIFIER)).unwrap_or_default(), logger, environment }
    }

    /// Sends a message, and returns its status.
    pub fn say(&self, status: c_int, sentence: &str) -> c_int {
        let Some(logger) = self.logger else { return status };
        let category = if status == WARNING { c"logStatusWarning" } else { c"logStatusError" };
        let sentence = match logger {
            // The message is a `printf` format.
            Logger::Two(_) => sentence.replace('%', "%%"),
            Logger::Three(_) => sentence.to_owned(),
        };
        let Ok(message) = CString::new(sentence.replace('\0', " ")) else { return status };
        let (category, message) = (category.as_ptr(), message.as_ptr());
        // SAFETY: the logger and its environment come from the simulation; the strings end with zeros and outlive the
        // call.
        match logger {
            Logger::Two(logger) => unsafe { logger(self.environment, self.name.as_ptr(), status, category, message) },
            Logger::Three(logger) => unsafe { logger(self.environment, status, category, message) },
        }
        status
    }
}
