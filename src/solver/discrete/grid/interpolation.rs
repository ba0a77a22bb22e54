//! Inner product of node arrays and interpolation between nodes.

/// Returns the first index and the weights of the cubic (4-point Lagrange) interpolation at X among increasing
/// `nodes`. At a node, its weight is 1 and all others are 0.
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
