//! Parts shared by the plots of several tabs.

pub mod axes;
pub mod color_bar;
pub mod color_map;
pub mod contours;
pub mod cut_line;
pub mod direction;
pub mod frame;
pub mod grip;
pub mod key;
pub mod raster;
