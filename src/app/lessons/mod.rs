//! Lessons that point at controls and see what was done.

mod goal;
mod panel;
mod text;

pub use goal::OnScreen;
pub use panel::{BESIDE, HEIGHT, Lessons, WIDTH, count};
