//! The computational domains: of a line contact along X ([`mod@line`]), of the half of a point contact that its
//! symmetry leaves ([`mod@point`]), and of either kind ([`mod@contact`]).

pub mod contact;
mod error;
mod fitting;
mod interpolation;
pub mod line;
pub mod point;

pub use contact::{ContactGrid, GridSpec};
pub use error::{GridError, MAX_BYTES};
pub use fitting::that_would_do;
pub(crate) use interpolation::{cubic, dot};
pub use line::{
    FIRST_UNKNOWN, INLET, LONGEST_INLET, LONGEST_OUTLET, LineGrid, MAX_GRADED_NODES, MAX_UNIFORM_NODES, ReferenceGrid,
    registration_scale, spike_position, stretched,
};
pub use point::{PointGrid, PointGridSpec};
