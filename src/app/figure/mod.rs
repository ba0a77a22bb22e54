//! Figures for print.

mod canvas;
mod dialog;
mod settings;
mod sitting;
mod texture;

pub use canvas::{Axis, Canvas, Recording};
pub use dialog::{Figures, ToImage};
pub use settings::FigureSettings;
pub use sitting::{enter, pixels, scale};
pub use texture::Texture;
