//! Measured film thicknesses and friction coefficients: the window in which tables are opened and constants of the
//! lubricant are fitted, and the points that plots draw.

mod fit;
mod points;
mod window;

pub use points::MeasuredPoints;
pub use window::MeasuredWindow;
