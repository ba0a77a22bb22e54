//! Sections through the fields of a solution along X and, over both halves, across Y, and values at single positions.

use super::solution::Solution;

/// Returns the cell of ascending nodes that contains a position: the index of its upper node, and the relative
/// position between both nodes. `None` outside.
pub(super) fn cell(nodes: &[f64], at: f64) -> Option<(usize, f64)> {
    let upper = nodes.partition_point(|&node| node < at).max(1);
    let (low, high) = (*nodes.get(upper - 1)?, *nodes.get(upper)?);
    (at >= low).then(|| (upper, if high > low { (at - low) / (high - low) } else { 0.0 }))
}

impl Solution {
    /// Returns X, P and H along X at an ordinate Y of either half, interpolated linearly between the nodes across. A
    /// line contact returns its profile for any Y. Empty outside the domain.
    pub fn along(&self, y: f64) -> Vec<(f64, f64, f64)> {
        let ny = self.y.len();
        if ny == 1 {
            return self.profile().collect();
        }
        let Some((j, t)) = cell(&self.y, -y.abs()) else { return Vec::new() };
        let between = |values: &[f64], i: usize| (1.0 - t) * values[i * ny + j - 1] + t * values[i * ny + j];
        (0..self.x.len()).map(|i| (self.x[i], between(&self.pressure, i), between(&self.film, i))).collect()
    }

    /// Returns Y, P and H across both halves at an abscissa X, interpolated linearly between the nodes along X. Empty
    /// for a line contact and outside the domain.
    pub fn across(&self, x: f64) -> Vec<(f64, f64, f64)> {
        let ny = self.y.len();
        let Some((i, t)) = cell(&self.x, x).filter(|_| ny > 1) else { return Vec::new() };
        let between = |values: &[f64], j: usize| (1.0 - t) * values[(i - 1) * ny + j] + t * values[i * ny + j];
        let half = (0..ny).map(|j| (self.y[j], between(&self.pressure, j), between(&self.film, j)));
        // The node on the axis belongs to both halves and is included once.
        half.clone().chain(half.rev().skip(1).map(|(y, p, h)| (-y, p, h))).collect()
    }

    /// Returns P and H at a position of a point contact, interpolated bilinearly between the nodes of either half.
    /// `None` outside the domain and for a line contact.
    pub fn at(&self, x: f64, y: f64) -> Option<(f64, f64)> {
        let at = |values: &[f64]| self.value_at(|node| values.get(node).copied(), x, y);
        Some((at(&self.pressure)?, at(&self.film)?))
    }

    /// Interpolates any nodal value that is even in Y, as [`Self::at`] does.
    pub fn value_at(&self, value: impl Fn(usize) -> Option<f64>, x: f64, y: f64) -> Option<f64> {
        let ny = self.y.len();
        let ((i, s), (j, t)) = (cell(&self.x, x)?, cell(&self.y, -y.abs())?);
        let at = |i: usize, j: usize| value(i * ny + j);
        let column = |i: usize| Some((1.0 - t) * at(i, j - 1)? + t * at(i, j)?);
        Some((1.0 - s) * column(i - 1)? + s * column(i)?)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{PointSolver, Start};
    use crate::solver::discrete::grid::PointGridSpec;
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::physics::lubricant::Lubricant;

    #[test]
    fn cuts_meet_the_nodes_and_each_other_and_are_symmetric() {
        let spec = PointGridSpec::uniform(0.1, 0.1, (-3.0, 1.8, -1.4));
        let point = si_from_moes(&MoesRequest::new(ContactKind::Point, 30.0, 5.0)).unwrap();
        let s = PointSolver::new(spec).unwrap().solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        let axis: Vec<_> = s.profile().collect();
        assert_eq!(s.along(0.0), axis);
        let (i, j) = (30, 9);
        let k = i * s.y.len() + j;
        for half in [-1.0, 1.0] {
            let (p, h) = s.at(s.x[i], half * s.y[j]).unwrap();
            assert!((p - s.pressure[k]).abs() < 1e-12 && (h - s.film[k]).abs() < 1e-12);
        }
        let across = s.across(0.03);
        assert_eq!(across.len(), 2 * s.y.len() - 1);
        for (a, b) in across.iter().zip(across.iter().rev()) {
            assert_eq!((a.0, a.1, a.2), (-b.0, b.1, b.2));
            let (p, h) = s.at(0.03, a.0).unwrap();
            assert!((p - a.1).abs() < 1e-12 && (h - a.2).abs() < 1e-12);
        }
        assert!(s.along(1.5).is_empty() && s.across(-3.1).is_empty() && s.at(0.0, 2.0).is_none());
    }
}
