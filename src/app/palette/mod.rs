//! Command palette.

mod entry;
mod search;
mod window;

pub use window::Palette;
