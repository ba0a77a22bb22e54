//! Command palette.

mod entry;
mod places;
mod search;
mod window;

pub use window::Palette;
