//! Example scenes by subject.

mod question;
mod sketch;
mod window;

pub use question::question;
pub use window::Examples;
