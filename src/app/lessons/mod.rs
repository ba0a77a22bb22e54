//! Lessons that point at controls and detect when a step is done.

mod goal;
mod panel;
#[cfg(test)]
mod tests;
mod text;
mod worksheet;

pub use goal::OnScreen;
pub use panel::{BESIDE, HEIGHT, Lessons, count};
pub use text::Lesson;
