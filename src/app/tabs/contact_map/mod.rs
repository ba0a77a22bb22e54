//! Film thickness or pressure over the plane of a point contact, and its interferogram.

mod contours;
mod export;
mod images;
pub mod optics;
mod scale;
mod tab;

pub use export::particulars;
pub use tab::{ContactMap, MapView};
