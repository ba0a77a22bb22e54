//! Computational domains: along X for a line contact ([`mod@line`]), the symmetric half for a point contact
//! ([`mod@point`]), and either of them ([`mod@contact`]).

pub mod contact;
mod error;
mod fitting;
mod interpolation;
pub mod line;
pub mod point;

pub(crate) use contact::add_gap;
pub use contact::{ContactGrid, GridSpec};
pub use error::{GridError, MAX_BYTES};
pub use fitting::that_would_do;
pub(crate) use interpolation::{cubic, dot};
pub use line::{
    FIRST_UNKNOWN, INLET, LONGEST_INLET, LONGEST_OUTLET, LineGrid, MAX_GRADED_NODES, MAX_UNIFORM_NODES, ReferenceGrid,
    registration_scale, spike_position, stretched,
};
pub use point::{PointGrid, PointGridSpec};
