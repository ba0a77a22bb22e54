//! Refinement of a grid with the same grading: every interval is halved, every node is kept.
//!
//! A graded interval is halved in the grading's coordinate ∫dξ/spacing, not in ξ. Halving in ξ would give a staircase
//! of spacings. Its truncation error would differ from that of the coarse grid by more than the factor 2² that
//! Richardson extrapolation assumes. A new grid with twice as many nodes is not sufficient either, because its ends
//! would differ by up to half a cell.

use super::{
    GridError, GridSpec, INLET, MAX_GRADED_NODES, MAX_UNIFORM_NODES, ReferenceGrid, cells_between, following_cells,
    following_spacing, wanted_spacing,
};
use std::sync::Arc;

impl ReferenceGrid {
    /// Returns the grid with every interval halved. Node k of this grid is node 2k − 1 of the finer one (k ≥ 1). The
    /// ends are unchanged.
    ///
    /// # Errors
    /// If the refined grid would have too many nodes.
    pub fn refined(&self) -> Result<Arc<Self>, GridError> {
        let nodes = 2 * (self.xi.len() - 1) - 1;
        let (max, spec) = match self.spec {
            spec @ GridSpec::Uniform { .. } => (MAX_UNIFORM_NODES, spec),
            spec => (MAX_GRADED_NODES, spec),
        };
        let halve = |a: f64, b: f64| match spec {
            GridSpec::Uniform { .. } => 0.5 * (a + b),
            GridSpec::Following { zone, .. } => {
                halfway(a, b, |a, b| following_cells(zone, a, b), |xi| following_spacing(zone, xi))
            }
            _ => halfway(a, b, cells_between, wanted_spacing),
        };
        if nodes > max {
            return Err(GridError::nodes(nodes as f64, max));
        }
        let mut xi = Vec::with_capacity(nodes + 1);
        for pair in self.xi.windows(2) {
            xi.extend([halve(pair[0], pair[1]), pair[1]]);
        }
        let domain = (self.xi[INLET], xi[nodes]);
        let spec = match self.spec {
            GridSpec::Uniform { dx, .. } => GridSpec::Uniform { dx: 0.5 * dx, domain },
            GridSpec::Graded { registered, .. } => GridSpec::Graded { nodes, domain, registered },
            GridSpec::Following { zone, finer, .. } => GridSpec::Following { zone, finer: 2.0 * finer, domain },
            plane @ GridSpec::Plane(_) => plane,
        };
        Ok(Arc::new(Self::of_nodes(spec, xi)?))
    }
}

/// Returns the abscissa that halves the grading's coordinate between two nodes, by Newton's method.
fn halfway(a: f64, b: f64, cells: impl Fn(f64, f64) -> f64, spacing: impl Fn(f64) -> f64) -> f64 {
    let mut middle = 0.5 * (a + b);
    for _ in 0..4 {
        middle += 0.5 * (cells(middle, b) - cells(a, middle)) * spacing(middle);
    }
    middle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_interval_is_halved_and_every_node_kept() {
        for spec in [
            GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) },
            GridSpec::Graded { nodes: 300, domain: (-12.0, 2.5), registered: true },
        ] {
            let coarse = spec.line().unwrap();
            let fine = coarse.refined().unwrap();
            assert_eq!(fine.xi.len() - 1, 2 * (coarse.xi.len() - 1) - 1);
            for (k, xi) in coarse.xi.iter().enumerate().skip(1) {
                assert_eq!(*xi, fine.xi[2 * k - 1]);
            }
            let steps: Vec<f64> = fine.xi.windows(2).map(|w| w[1] - w[0]).collect();
            let coarse_ratio = coarse.xi.windows(3).map(|w| (w[2] - w[1]) / (w[1] - w[0])).fold(0.0, f64::max);
            // Smooth everywhere: the spacing changes half as much per cell as on the coarse grid.
            let ratio = steps.windows(2).map(|w| w[1] / w[0]).fold(0.0, f64::max);
            assert!(ratio < 1.0 + 0.6 * (coarse_ratio - 1.0) + 1e-9, "{ratio} against {coarse_ratio}");
        }
    }

    #[test]
    fn a_grid_is_not_refined_beyond_its_limit() {
        let grid = GridSpec::Graded { nodes: 2500, domain: (-8.0, 2.0), registered: false }.line().unwrap();
        assert!(grid.refined().unwrap_err().to_string().contains("4999 nodes"));
    }
}
