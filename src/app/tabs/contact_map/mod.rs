//! Film thickness or pressure over the plane of a point contact, and its interferogram.

mod export;
mod images;
mod map_view;
mod optics;
mod scale;
mod tab;
mod why;

pub use tab::ContactMap;
