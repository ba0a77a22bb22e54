//! Contacts by reduced models, for C (`contact`, with the header `include/ehl_contact.h`) and as Functional Mock-up Units
//! (`fmi2`).
//!
//! The border to C is the only place with unsafe code: pointers come from there. Nothing here panics across it; what is
//! refused is told in a sentence.

mod border;
pub mod contact;
mod fmi2;
mod instance;
