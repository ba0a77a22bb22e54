//! Lessons that point at controls and detect when a step is done.

mod goal;
mod panel;
mod text;

pub use goal::OnScreen;
pub use panel::{BESIDE, HEIGHT, Lessons, WIDTH, count};
