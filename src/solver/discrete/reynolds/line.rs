//! Nodes of a line contact's row: four neighbours, upwind from the side the flow comes from.
//!
//! A row with flow from the outlet is the row of the mirrored contact: the same function, with its nodes in reverse
//! order.

use super::{CENTER, RowGeometry, STENCIL};

/// Side from which the flow of a row comes, relative to the grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Upstream {
    /// Inlet: two nodes upstream, one downstream. A steady contact has only such rows.
    #[default]
    Inlet,
    /// Outlet: one node on the inlet side, two on the outlet side.
    Outlet,
    /// Outlet, at the last unknown, which has a single node behind it: the difference quotient is of first order.
    Edge,
}

impl Upstream {
    /// Returns the side for row `unknown` of `unknowns` if the flow passes with `velocity` relative to the grid.
    pub fn of(velocity: f64, unknown: usize, unknowns: usize) -> Self {
        match (velocity < 0.0, unknown + 1 == unknowns) {
            (false, _) => Self::Inlet,
            (true, false) => Self::Outlet,
            (true, true) => Self::Edge,
        }
    }

    /// Returns the nodes of row `unknown` in a node array; missing nodes have weight zero.
    #[inline]
    pub fn stencil(self, unknown: usize) -> [usize; STENCIL] {
        let own = unknown + CENTER;
        match self {
            Self::Inlet => [unknown, own - 1, own, own + 1, own, own],
            Self::Outlet => [own + 2, own + 1, own, own - 1, own, own],
            Self::Edge => [own + 1, own + 1, own, own - 1, own, own],
        }
    }

    /// Returns the coefficients of row `unknown` on the abscissae `x` of a node array.
    pub fn geometry(self, x: &[f64], unknown: usize) -> RowGeometry {
        let [west_2, west, own, east, ..] = self.stencil(unknown).map(|node| x[node]);
        match self {
            Self::Inlet => RowGeometry::new([west_2, west, own, east]),
            Self::Outlet => RowGeometry::new([-west_2, -west, -own, -east]),
            Self::Edge => RowGeometry::first_column([-west, -own, -east]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Node, PENALTY, Row, row};
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

    fn evaluate(upstream: Upstream, geometry: &RowGeometry, p: &[f64], h: &[f64], unknown: usize) -> Row {
        let nodes = nodes(p, h);
        row(geometry, PENALTY, upstream.stencil(unknown).map(|node| &nodes[node]))
    }

    #[test]
    fn a_flow_from_the_outlet_is_the_mirrored_flow_from_the_inlet() {
        let mirrored = |values: [f64; 6]| -> Vec<f64> { values.into_iter().rev().collect() };
        let x: Vec<f64> = mirrored(X).iter().map(|x| -x).collect();
        let (speed, storage, history) = (0.7, 3.0, -0.2);
        let own = Upstream::Outlet.geometry(&X, 1).in_time(speed, storage, history);
        let other = Upstream::Inlet.geometry(&x, 0).in_time(speed, storage, history);
        let a = evaluate(Upstream::Outlet, &own, &P, &H, 1);
        let b = evaluate(Upstream::Inlet, &other, &mirrored(P), &mirrored(H), 0);
        assert!((a.value - b.value).abs() < 1e-12 * a.value.abs());
        for (a, b) in a.d_p.iter().zip(b.d_p) {
            assert!((a - b).abs() < 1e-9);
        }
    }

    #[test]
    fn time_derivatives_agree_with_one_sided_differences() {
        for (upstream, unknown) in [(Upstream::Inlet, 1), (Upstream::Outlet, 1), (Upstream::Edge, 2)] {
            let geometry = upstream.geometry(&X, unknown).in_time(0.7, 30.0, -0.2);
            let exact = evaluate(upstream, &geometry, &P, &H, unknown);
            let scale = exact.d_p.iter().chain(&exact.d_h).fold(0.0f64, |a, b| a.max(b.abs()));
            let step = 1e-7;
            let stencil = upstream.stencil(unknown);
            for m in 0..4 {
                let at = |dp: f64, dh: f64| {
                    let (mut p, mut h) = (P, H);
                    p[stencil[m]] += dp;
                    h[stencil[m]] += dh;
                    evaluate(upstream, &geometry, &p, &h, unknown).value
                };
                let d_p = (at(step, 0.0) - at(-step, 0.0)) / (2.0 * step);
                let d_h = (at(0.0, step) - at(0.0, -step)) / (2.0 * step);
                // If a node replaces another, its derivatives belong to both places.
                let whole =
                    |d: &[f64; STENCIL]| -> f64 { (0..4).filter(|&e| stencil[e] == stencil[m]).map(|e| d[e]).sum() };
                assert!((d_p - whole(&exact.d_p)).abs() < 1e-6 * scale, "{upstream:?} dP {m}");
                assert!((d_h - whole(&exact.d_h)).abs() < 1e-6 * scale, "{upstream:?} dH {m}");
            }
        }
    }
}
