//! The row of a line contact: four neighbouring nodes, upwind from whichever side the flow comes.
//!
//! A row whose flow comes from the outlet is the row of the mirrored contact: the same function, with its nodes in the opposite order.

use super::{Node, RowGeometry, row};

/// Nodes a line row depends on.
pub const LINE_STENCIL: usize = 4;

/// The side a row's flow comes from, relative to the grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Upstream {
    /// The inlet: nodes two upstream to one downstream. A stationary contact has only such rows.
    #[default]
    Inlet,
    /// The outlet: nodes one to the inlet's side, two to the outlet's.
    Outlet,
    /// The outlet, at the last unknown, behind which there is one node only: the quotient is of first order there.
    Edge,
}

/// A line row's value and its derivatives, in the order of the nodes along X.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LineRow {
    /// f_p of (2.31).
    pub value: f64,
    /// ∂f_p/∂P.
    pub d_p: [f64; LINE_STENCIL],
    /// ∂f_p/∂H.
    pub d_h: [f64; LINE_STENCIL],
}

impl Upstream {
    /// The side for row `unknown` of `unknowns` when the flow passes with `velocity` relative to the grid.
    pub fn of(velocity: f64, unknown: usize, unknowns: usize) -> Self {
        match (velocity < 0.0, unknown + 1 == unknowns) {
            (false, _) => Self::Inlet,
            (true, false) => Self::Outlet,
            (true, true) => Self::Edge,
        }
    }

    /// First node of row `unknown` in a node array.
    #[inline]
    pub fn first_node(self, unknown: usize) -> usize {
        match self {
            Self::Inlet | Self::Edge => unknown,
            Self::Outlet => unknown + 1,
        }
    }

    /// Coefficients of row `unknown` on the abscissae `x` of a node array.
    pub fn geometry(self, x: &[f64], unknown: usize) -> RowGeometry {
        let x = &x[self.first_node(unknown)..];
        match self {
            Self::Inlet => RowGeometry::new([x[0], x[1], x[2], x[3]]),
            Self::Outlet => RowGeometry::new([-x[3], -x[2], -x[1], -x[0]]),
            Self::Edge => RowGeometry::first_column([-x[3], -x[2], -x[1]]),
        }
    }

    /// Evaluates row `unknown`; `nodes` is a node array.
    #[inline]
    pub fn row(self, geometry: &RowGeometry, penalty: f64, nodes: &[Node], unknown: usize) -> LineRow {
        let first = self.first_node(unknown);
        let n = &nodes[first..first + LINE_STENCIL];
        match self {
            Self::Inlet => {
                let r = row(geometry, penalty, [&n[0], &n[1], &n[2], &n[3], &n[2], &n[2]]);
                let along = |d: [f64; 6]| [d[0], d[1], d[2], d[3]];
                LineRow { value: r.value, d_p: along(r.d_p), d_h: along(r.d_h) }
            }
            Self::Outlet => {
                let r = row(geometry, penalty, [&n[3], &n[2], &n[1], &n[0], &n[1], &n[1]]);
                let along = |d: [f64; 6]| [d[3], d[2], d[1], d[0]];
                LineRow { value: r.value, d_p: along(r.d_p), d_h: along(r.d_h) }
            }
            Self::Edge => {
                let r = row(geometry, penalty, [&n[3], &n[3], &n[2], &n[1], &n[2], &n[2]]);
                let along = |d: [f64; 6]| [0.0, d[3], d[2], d[1]];
                LineRow { value: r.value, d_p: along(r.d_p), d_h: along(r.d_h) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::PENALTY;
    use super::*;
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::{Lubricant, ScaledFluid};

    const X: [f64; 6] = [-1.04, -1.01, -0.99, -0.98, -0.96, -0.95];
    const P: [f64; 6] = [0.01, 0.02, 0.05, 0.04, 0.06, 0.03];
    const H: [f64; 6] = [0.14, 0.13, 0.1, 0.11, 0.095, 0.12];

    fn fluid() -> ScaledFluid {
        Lubricant::default().scaled(&OperatingPoint::TABLE_2_1).unwrap()
    }

    fn nodes(p: &[f64], h: &[f64]) -> Vec<Node> {
        p.iter().zip(h).map(|(&p, &h)| Node::new(&fluid(), 1.0 / 0.01, p, h)).collect()
    }

    #[test]
    fn a_flow_from_the_outlet_is_the_mirrored_flow_from_the_inlet() {
        let mirrored = |values: [f64; 6]| -> Vec<f64> { values.into_iter().rev().collect() };
        let x: Vec<f64> = mirrored(X).iter().map(|x| -x).collect();
        let (speed, storage, history) = (0.7, 3.0, -0.2);
        let own = Upstream::Outlet.geometry(&X, 1).in_time(speed, storage, history);
        let other = Upstream::Inlet.geometry(&x, 0).in_time(speed, storage, history);
        let a = Upstream::Outlet.row(&own, PENALTY, &nodes(&P, &H), 1);
        let b = Upstream::Inlet.row(&other, PENALTY, &nodes(&mirrored(P), &mirrored(H)), 0);
        assert!((a.value - b.value).abs() < 1e-12 * a.value.abs());
        for m in 0..LINE_STENCIL {
            assert!((a.d_p[m] - b.d_p[LINE_STENCIL - 1 - m]).abs() < 1e-9);
        }
    }

    #[test]
    fn derivatives_in_time_agree_with_finite_differences_from_either_side() {
        for (upstream, unknown) in [(Upstream::Inlet, 1), (Upstream::Outlet, 1), (Upstream::Edge, 2)] {
            let geometry = upstream.geometry(&X, unknown).in_time(0.7, 30.0, -0.2);
            let exact = upstream.row(&geometry, PENALTY, &nodes(&P, &H), unknown);
            let scale = exact.d_p.iter().chain(&exact.d_h).fold(0.0f64, |a, b| a.max(b.abs()));
            let step = 1e-7;
            for m in 0..LINE_STENCIL {
                let at = |dp: f64, dh: f64| {
                    let (mut p, mut h) = (P, H);
                    p[upstream.first_node(unknown) + m] += dp;
                    h[upstream.first_node(unknown) + m] += dh;
                    upstream.row(&geometry, PENALTY, &nodes(&p, &h), unknown).value
                };
                let d_p = (at(step, 0.0) - at(-step, 0.0)) / (2.0 * step);
                let d_h = (at(0.0, step) - at(0.0, -step)) / (2.0 * step);
                assert!((d_p - exact.d_p[m]).abs() < 1e-6 * scale, "{upstream:?} dP {m}");
                assert!((d_h - exact.d_h[m]).abs() < 1e-6 * scale, "{upstream:?} dH {m}");
            }
        }
    }
}
