//! Parameters of reduced models: quantities, each defined once, and the spaces that they span.

mod axis;
mod constants;
mod estimation;
mod metric;
mod named;
mod outside;
mod quantity;
mod sampling;
mod scale;
mod space;
mod tables;

pub use axis::Axis;
pub use estimation::{Estimate, Estimated, EstimationError, estimate};
pub use metric::{MOST_NUMBERS, Metric, Place, SHAPE_WEIGHT, apart, distance, separation};
pub use outside::Outside;
pub(crate) use quantity::enlarged;
pub use quantity::{Quantity, REFERENCE_ROUGHNESS_M};
pub use sampling::{MOST_AXES, Unit, middle};
pub use scale::Scale;
pub use space::{CIRCLES, ParameterSpace};
