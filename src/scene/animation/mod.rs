//! Animations for slides, as animated PNG of 960×540 pixels.

mod frame;
mod march;
mod sweep;

pub use march::{full_march, of_march};
pub use sweep::of_sweep;
