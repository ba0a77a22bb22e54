//! The computational domains: of a line contact along X ([`mod@line`]), of the half of a point contact that its
//! symmetry leaves ([`mod@point`]), and of either kind ([`mod@contact`]).

pub mod contact;
mod error;
mod fitting;
pub mod line;
pub mod point;

pub use contact::{ContactGrid, GridSpec};
pub use error::{GridError, MAX_BYTES};
pub use fitting::that_would_do;
pub use line::{
    FIRST_UNKNOWN, INLET, LONGEST_INLET, LONGEST_OUTLET, LineGrid, MAX_GRADED_NODES, MAX_UNIFORM_NODES, ReferenceGrid,
    registration_scale, spike_position, stretched,
};
pub use point::{PointGrid, PointGridSpec};

/// First index and weights of the cubic (4-point Lagrange) interpolation at X among increasing `nodes`; a single unit
/// weight where X is a node.
pub(crate) fn cubic(nodes: &[f64], x: f64) -> (usize, [f64; 4]) {
    let first = nodes.partition_point(|&node| node < x).saturating_sub(2).min(nodes.len() - 4);
    let near = &nodes[first..first + 4];
    if let Some(k) = near.iter().position(|&node| (node - x).abs() < 1e-10) {
        return (first, std::array::from_fn(|i| if i == k { 1.0 } else { 0.0 }));
    }
    let weight = |k: usize| (0..4).filter(|&j| j != k).map(|j| (x - near[j]) / (near[k] - near[j])).product::<f64>();
    (first, std::array::from_fn(weight))
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
