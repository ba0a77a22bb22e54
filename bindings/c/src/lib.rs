//! Contacts solved by reduced models, for C (`contact`, with the header `include/ehl_contact.h`) and as Functional
//! Mock-up Units (`fmi2`, `fmi3`).
//!
//! Unsafe code is needed only at the C interface, because of its pointers. Panics do not cross it, and errors are
//! returned as sentences.

mod border;
mod component;
pub mod contact;
mod fmi2;
mod fmi3;
mod instance;
mod log;
mod state;
