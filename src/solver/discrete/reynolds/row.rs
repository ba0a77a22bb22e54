//! One row of the discrete Reynolds equation (2.31) at one node: its value and exact derivatives.
//!
//! The row is a function of six nodes, in the order [`WEST2`], [`WEST`], [`CENTER`], [`EAST`], [`SOUTH`], [`NORTH`].
//! A line contact is a grid with one row of nodes in Y, whose Y coefficients are zero. The full system uses all rows,
//! a hyper-reduced model its sampled ones.
//!
//! The spacing may vary along X. The upwind quotient is (B.4), which is (2.32) on a uniform grid. The diffusion term
//! is the flux difference over the cell, as in the dissertation on a uniform grid.

use crate::solver::physics::lubricant::{FluidState, ScaledFluid};

/// Number of nodes that a row depends on.
pub const STENCIL: usize = 6;
/// Second node upstream.
pub const WEST2: usize = 0;
/// First node upstream.
pub const WEST: usize = 1;
/// Node of the row itself.
pub const CENTER: usize = 2;
/// First node downstream.
pub const EAST: usize = 3;
/// Neighbour at smaller Y.
pub const SOUTH: usize = 4;
/// Neighbour at larger Y.
pub const NORTH: usize = 5;

/// Dimensionless penalty factor γ̄ of the dissertation, (2.36).
pub const PENALTY: f64 = 1e6;

/// Quantities of one node that a row uses: pressure P, mass flow ρ̄H and mobility ξ = ρ̄H³/(η̄λ̄) with their
/// derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// P.
    pub pressure: f64,
    /// ρ̄H.
    pub flow: f64,
    /// ∂(ρ̄H)/∂P.
    pub flow_p: f64,
    /// ∂(ρ̄H)/∂H = ρ̄.
    pub flow_h: f64,
    /// ξ.
    pub mobility: f64,
    /// ∂ξ/∂P.
    pub mobility_p: f64,
    /// ∂ξ/∂H.
    pub mobility_h: f64,
}

impl Node {
    /// Evaluates the node at pressure P and film thickness H. `inverse_lambda` is 1/λ̄.
    #[inline]
    pub fn new(fluid: &ScaledFluid, inverse_lambda: f64, pressure: f64, film: f64) -> Self {
        Self::of_state(&fluid.at(pressure), inverse_lambda, pressure, film)
    }

    /// Evaluates the node with the fluid's state already known.
    #[inline]
    pub fn of_state(state: &FluidState, inverse_lambda: f64, pressure: f64, film: f64) -> Self {
        let per_cube = state.density / state.viscosity * inverse_lambda;
        let square = film * film;
        let mobility = per_cube * square * film;
        Self {
            pressure,
            flow: state.density * film,
            flow_p: state.density_slope * film,
            flow_h: state.density,
            mobility,
            mobility_p: mobility * (state.density_slope / state.density - state.log_viscosity_slope),
            mobility_h: 3.0 * per_cube * square,
        }
    }
}

/// Coefficients of one row. In a steady contact they are difference coefficients, which depend on the grid only. In a
/// transient contact they include the storage term of (2.31), see [`RowGeometry::in_time`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RowGeometry {
    /// Weights of ρ̄H at [`WEST2`], [`WEST`], [`CENTER`] in ∂(ρ̄H)/∂X, (B.4).
    pub upwind: [f64; 3],
    /// 1/(h_w h_c): weight of the western face in the diffusion term.
    pub west: f64,
    /// 1/(h_e h_c): weight of the eastern face.
    pub east: f64,
    /// 1/(h_s h_c): weight of the southern face; zero for a line contact.
    pub south: f64,
    /// 1/(h_n h_c): weight of the northern face; zero for a line contact and on the symmetry axis.
    pub north: f64,
    /// Contribution of the previous steps to the time derivative; zero in a steady contact.
    pub history: f64,
    /// Weight of the stored mass ρ̄H of the row's own node, which the last of the upwind weights includes; zero in a
    /// steady contact.
    pub storage: f64,
}

impl RowGeometry {
    /// Returns the coefficients of the row at the third of four adjacent abscissae x₋₂ < x₋₁ < x₀ < x₊₁, without
    /// diffusion across.
    pub fn new(x: [f64; 4]) -> Self {
        let (h0, h1, h2) = (x[1] - x[0], x[2] - x[1], x[3] - x[2]);
        let r = h1 / h0;
        let cell = 0.5 * (h1 + h2);
        Self {
            upwind: [r * r / (1.0 + r) / h1, -(1.0 + r) / h1, (1.0 + 2.0 * r) / (1.0 + r) / h1],
            west: 1.0 / (h1 * cell),
            east: 1.0 / (h2 * cell),
            ..Self::default()
        }
    }

    /// Returns the coefficients in the first column behind the inlet of a point contact, where the upwind quotient is
    /// of first order. `x` holds the abscissae of the inlet, the column itself and the next column. The node at
    /// [`WEST2`] has weight zero.
    pub fn first_column(x: [f64; 3]) -> Self {
        let (h1, h2) = (x[1] - x[0], x[2] - x[1]);
        let cell = 0.5 * (h1 + h2);
        Self { upwind: [0.0, -1.0 / h1, 1.0 / h1], west: 1.0 / (h1 * cell), east: 1.0 / (h2 * cell), ..Self::default() }
    }

    /// Returns the row under the map X = −1 + (ξ + 1)s, for coefficients given in ξ. Terms across and in time are
    /// unchanged.
    #[inline]
    pub fn scaled(&self, scale: f64) -> Self {
        let (first, second) = (1.0 / scale, 1.0 / (scale * scale));
        Self { upwind: self.upwind.map(|w| w * first), west: self.west * second, east: self.east * second, ..*self }
    }

    /// Returns the same row with diffusion across; `south` and `north` are the distances to the neighbours in Y.
    /// `north` is `None` on the symmetry axis: the cell is then its southern half, and no flow crosses the axis.
    pub fn across(self, south: f64, north: Option<f64>) -> Self {
        let cell = 0.5 * (south + north.unwrap_or(0.0));
        Self { south: 1.0 / (south * cell), north: north.map_or(0.0, |h| 1.0 / (h * cell)), ..self }
    }

    /// Returns true if the row depends on the nodes at [`SOUTH`] and [`NORTH`].
    #[inline]
    pub fn reaches_across(&self) -> bool {
        self.south != 0.0 || self.north != 0.0
    }

    /// Converts the row of a circular contact's grid to that of an elliptical one with κ = b/a: distances across are
    /// multiplied by κ.
    #[inline]
    pub fn across_by(&self, kappa: f64) -> Self {
        let square = 1.0 / (kappa * kappa);
        Self { south: self.south * square, north: self.north * square, ..*self }
    }

    /// Returns the transient row: the flow passes the node at `speed` ≥ 0 instead of 1, and ∂(ρ̄H)/∂T is `storage`
    /// ρ̄H + `history`. The storage is added to the upwind weight of the row's own node, so that a transient row
    /// costs no more than a steady one.
    pub fn in_time(self, speed: f64, storage: f64, history: f64) -> Self {
        let [west_2, west, center] = self.upwind.map(|weight| speed * weight);
        Self { upwind: [west_2, west, center + storage], history, storage, ..self }
    }
}

/// Value of a row and its derivatives with respect to P and H of the six nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// f_p of (2.31).
    pub value: f64,
    /// ∂f_p/∂P.
    pub d_p: [f64; STENCIL],
    /// ∂f_p/∂H.
    pub d_h: [f64; STENCIL],
}

/// Evaluates the row: diffusion in X and Y, convection, storage, penalty Λ = −γ̄ min(P, 0).
#[inline]
pub fn row(geometry: &RowGeometry, penalty: f64, nodes: [&Node; STENCIL]) -> Row {
    let center = nodes[CENTER];
    let mut out = Row { value: -geometry.history, ..Row::default() };
    for (k, weight) in [(WEST, geometry.west), (EAST, geometry.east), (SOUTH, geometry.south), (NORTH, geometry.north)]
    {
        if weight == 0.0 {
            continue;
        }
        let other = nodes[k];
        let drop = weight * (other.pressure - center.pressure);
        let face = 0.5 * (other.mobility + center.mobility);
        out.value += face * drop;
        out.d_p[k] += face * weight + 0.5 * other.mobility_p * drop;
        out.d_p[CENTER] += -face * weight + 0.5 * center.mobility_p * drop;
        out.d_h[k] += 0.5 * other.mobility_h * drop;
        out.d_h[CENTER] += 0.5 * center.mobility_h * drop;
    }
    for (k, weight) in geometry.upwind.into_iter().enumerate() {
        out.value -= weight * nodes[k].flow;
        out.d_p[k] -= weight * nodes[k].flow_p;
        out.d_h[k] -= weight * nodes[k].flow_h;
    }
    if center.pressure < 0.0 {
        out.value -= penalty * center.pressure;
        out.d_p[CENTER] -= penalty;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::{DensityLaw, Lubricant, ViscosityLaw};

    const X: [f64; 4] = [-1.03, -1.0, -0.98, -0.97];

    fn evaluate(fluid: &ScaledFluid, p: &[f64; 6], h: &[f64; 6], geometry: &RowGeometry) -> Row {
        let nodes: Vec<Node> = p.iter().zip(h).map(|(&p, &h)| Node::new(fluid, 1.0 / 0.01, p, h)).collect();
        row(geometry, PENALTY, std::array::from_fn(|k| &nodes[k]))
    }

    #[test]
    fn derivatives_agree_with_finite_differences_for_every_law() {
        let films = [0.13, 0.12, 0.1, 0.095, 0.11, 0.12];
        for density in [DensityLaw::Incompressible, DensityLaw::DowsonHigginson] {
            for viscosity in [ViscosityLaw::Barus, ViscosityLaw::Roelands] {
                let fluid = Lubricant { density, viscosity, ..Lubricant::default() }
                    .scaled(&OperatingPoint::TABLE_2_1)
                    .unwrap();
                for center in [0.04, -1e-3] {
                    let pressures = [0.01, 0.02, center, 0.06, 0.03, 0.05];
                    let first = RowGeometry::first_column([X[1], X[2], X[3]]);
                    for geometry in [
                        RowGeometry::new(X),
                        RowGeometry::new(X).across(0.05, Some(0.04)),
                        RowGeometry::new(X).across(0.05, None),
                        first.across(0.05, Some(0.05)),
                    ] {
                        let exact = evaluate(&fluid, &pressures, &films, &geometry);
                        let scale_p = exact.d_p.iter().fold(0.0f64, |a, b| a.max(b.abs()));
                        let scale_h = exact.d_h.iter().fold(0.0f64, |a, b| a.max(b.abs()));
                        for k in 0..STENCIL {
                            let moved = |mut values: [f64; STENCIL], by: f64| {
                                values[k] += by;
                                values
                            };
                            let difference = |value: &dyn Fn(f64) -> f64| (value(1e-7) - value(-1e-7)) / 2e-7;
                            let by_pressure =
                                difference(&|by| evaluate(&fluid, &moved(pressures, by), &films, &geometry).value);
                            let by_film =
                                difference(&|by| evaluate(&fluid, &pressures, &moved(films, by), &geometry).value);
                            assert!((by_pressure - exact.d_p[k]).abs() < 1e-6 * scale_p, "dP {k}");
                            assert!((by_film - exact.d_h[k]).abs() < 1e-6 * scale_h, "dH {k}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn uniform_spacing_gives_the_dissertations_quotients() {
        let g = RowGeometry::new([0.0, 0.1, 0.2, 0.3]);
        for (got, want) in g.upwind.into_iter().zip([5.0, -20.0, 15.0]) {
            assert!((got - want).abs() < 1e-12);
        }
        assert!((g.west - 100.0).abs() < 1e-9 && (g.east - 100.0).abs() < 1e-9);
    }

    #[test]
    fn second_order_for_a_manufactured_solution_on_a_graded_grid() {
        // Incompressible Barus fluid with smooth P(x), H(x): compares the row with the analytic expression.
        let point = OperatingPoint { alpha_per_pa: 1e-10, ..OperatingPoint::TABLE_2_1 };
        let fluid =
            Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus, ..Lubricant::default() }
                .scaled(&point)
                .unwrap();
        let a = point.alpha_hertz();
        let (p, dp, ddp) = (|x: f64| x.sin() + 2.0, |x: f64| x.cos(), |x: f64| -x.sin());
        let (h, dh) = (|x: f64| 1.0 + 0.3 * x * x, |x: f64| 0.6 * x);
        let exact = |x: f64| {
            let xi = h(x).powi(3) * (-a * p(x)).exp();
            let dxi = xi * (3.0 * dh(x) / h(x) - a * dp(x));
            dxi * dp(x) + xi * ddp(x) - dh(x)
        };
        let error = |step: f64| {
            // Smooth mapping of an equidistant grid.
            let map = |t: f64| t + 0.2 * t * t;
            let t0 = 0.4;
            let x: [f64; 4] = std::array::from_fn(|k| map(t0 + step * (k as f64 - 2.0)));
            let nodes: Vec<Node> = x.iter().map(|&x| Node::new(&fluid, 1.0, p(x), h(x))).collect();
            let r =
                row(&RowGeometry::new(x), PENALTY, [&nodes[0], &nodes[1], &nodes[2], &nodes[3], &nodes[2], &nodes[2]]);
            (r.value - exact(x[2])).abs()
        };
        let order = (error(0.02) / error(0.01)).log2();
        assert!((1.8..2.3).contains(&order), "order {order}");
    }
}
