//! What a reduced model can vary: quantities, each defined once, and the spaces that they span.

mod axis;
mod constants;
mod metric;
mod named;
mod outside;
mod quantity;
mod sampling;
mod space;
mod tables;

pub use axis::{Axis, Scale};
pub use metric::{MOST_NUMBERS, Metric, Place, SHAPE_WEIGHT, apart, distance, separation};
pub use outside::Outside;
pub use quantity::Quantity;
pub use sampling::{MOST_AXES, Unit, middle};
pub use space::{CIRCLES, ParameterSpace};
