//! Figures for print.

mod canvas;
mod dialog;
mod sitting;
mod texture;

pub use canvas::{Axis, Canvas, Recording};
pub use dialog::{FigureSettings, Figures};
pub use sitting::{enter, pixels, scale};
pub use texture::Texture;
