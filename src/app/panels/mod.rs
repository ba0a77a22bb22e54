//! The panels around the tabs.

pub mod bodies;
pub mod headline;
mod heat;
pub mod help;
pub mod lubricant;
pub mod menu;
pub mod model;
pub mod moment;
pub mod oil;
pub mod operating_point;
pub mod plane;
pub mod presentation;
pub mod readouts;
pub mod settings;
pub mod sliders;
pub mod strip;
pub mod surfaces;
