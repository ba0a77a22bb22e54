//! Generalized Reynolds row (3.23): contribution of shear-thinning to the nodes of the row, and to its derivatives.
//!
//! A shear-thinning node is a Newtonian one with the mobility multiplied by φ and the flow multiplied by
//! 1 + SRR (½ − Z₀), with the slide-to-roll ratio SRR. φ and Z₀ follow from the film integrals at the node's own
//! pressure gradient. The row itself is the Newtonian row.
//!
//! The derivatives have two additional parts, with respect to the nodal gradients P_X and P_Y, which are central
//! differences. So the row extends from X −3 to +2, across to Y ±2 and to the diagonals: ∂f/∂P + (∂f/∂P_X) G_X +
//! (∂f/∂P_Y) G_Y with the constant difference operators of [`NodalGradient`].

use super::film_integrals::{FilmLoad, FilmRule, KnownFilm, LAST_STEP, PRODUCTION_RULE, film_integrals_near};
use super::{CENTER, EAST, NORTH, Node, RowGeometry, SOUTH, STENCIL, WEST};
use crate::host::pool;
use crate::solver::physics::lubricant::{ScaledFluid, ScaledShear};

/// Number of gradients computed by one task.
const SHARE: usize = 2048;

/// Shear-thinning node as the row uses it, and its derivatives by the pressure gradient.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShearNode {
    /// Node as the row uses it.
    pub node: Node,
    /// ∂(flow)/∂(P_X, P_Y).
    pub flow_gradient: [f64; 2],
    /// ∂ξ/∂(P_X, P_Y), with the mobility ξ.
    pub mobility_gradient: [f64; 2],
    /// Solved film, in units of the law's scale.
    pub known: KnownFilm,
}

/// Numerical treatment of the film integrals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmTreatment {
    /// Quadrature rule across the film.
    pub rule: &'static FilmRule,
    /// True to treat the integrals as constants in the Jacobian. This is cheaper and gives the same solution within
    /// rounding, but convergence is no longer quadratic.
    pub frozen: bool,
    /// Step of the mid-film stress, relative to it, that ends its iteration. The error of the integrals is the square
    /// of it.
    pub last_step: f64,
}

impl Default for FilmTreatment {
    fn default() -> Self {
        Self { rule: &PRODUCTION_RULE, frozen: false, last_step: LAST_STEP }
    }
}

/// State of a node that its film integrals depend on.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodeState {
    /// P.
    pub pressure: f64,
    /// (P_X, P_Y); P_Y is zero for a line contact.
    pub gradient: [f64; 2],
    /// H.
    pub film: f64,
}

impl ShearNode {
    /// Evaluates the node.
    #[inline]
    pub fn new(
        fluid: &ScaledFluid,
        shear: &ScaledShear,
        inverse_lambda: f64,
        state: NodeState,
        treatment: FilmTreatment,
    ) -> Self {
        Self::near(&KnownFilm::default(), fluid, shear, inverse_lambda, state, treatment)
    }

    /// Evaluates the node, starting from a nearby solved film, for example that of the previous iterate.
    #[inline]
    pub fn near(
        known: &KnownFilm,
        fluid: &ScaledFluid,
        shear: &ScaledShear,
        inverse_lambda: f64,
        NodeState { pressure, gradient, film }: NodeState,
        treatment: FilmTreatment,
    ) -> Self {
        let state = fluid.at(pressure);
        let node = Node::of_state(&state, inverse_lambda, pressure, film);
        let newtonian = Self { node, ..Self::default() };
        if film <= 0.0 {
            // Overlapping surfaces occur only in intermediate iterates: there is no film to integrate over.
            return newtonian;
        }
        let load = shear.film_load(gradient, film, state.viscosity);
        if load == FilmLoad::default() {
            return newtonian;
        }
        let integrals = film_integrals_near(&shear.fluidity, (treatment.rule, treatment.last_step), load, known);
        let srr = shear.slide_to_roll_ratio;
        let carried = 1.0 - srr * integrals.shift;
        let mut out = Self {
            node: Node {
                pressure,
                flow: node.flow * carried,
                flow_p: node.flow_p * carried,
                flow_h: node.flow_h * carried,
                mobility: node.mobility * integrals.mobility,
                mobility_p: node.mobility_p * integrals.mobility,
                mobility_h: node.mobility_h * integrals.mobility,
            },
            known: KnownFilm { load, mid_stress: integrals.mid_stress, d_mid_stress: integrals.d_mid_stress },
            ..Self::default()
        };
        if treatment.frozen {
            return out;
        }
        let ([mobility_a, mobility_b, mobility_s], [shift_a, shift_b, shift_s]) =
            (integrals.d_mobility, integrals.d_shift);
        // a and b grow with H and the gradient; S with μ̄ and 1/H.
        let (a_h, b_h, per_gradient) = (load.a / film, load.b / film, shear.gradient * film);
        let (s_p, s_h) = (load.sliding * state.log_viscosity_slope, -load.sliding / film);
        out.node.mobility_p += node.mobility * mobility_s * s_p;
        out.node.mobility_h += node.mobility * (mobility_a * a_h + mobility_b * b_h + mobility_s * s_h);
        out.mobility_gradient = [mobility_a, mobility_b].map(|slope| node.mobility * slope * per_gradient);
        let slid = -srr * node.flow;
        out.node.flow_p += slid * shift_s * s_p;
        out.node.flow_h += slid * (shift_a * a_h + shift_b * b_h + shift_s * s_h);
        out.flow_gradient = [shift_a, shift_b].map(|slope| slid * slope * per_gradient);
        out
    }
}

impl ScaledShear {
    /// Returns the scalars of the film integrals at a gradient (P_X, P_Y), a film thickness H > 0 and a viscosity μ̄.
    #[inline]
    pub fn film_load(&self, gradient: [f64; 2], film: f64, viscosity: f64) -> FilmLoad {
        let across = self.gradient * film;
        FilmLoad { a: across * gradient[0], b: across * gradient[1], sliding: self.sliding * viscosity / film }
    }
}

/// Returns ∂f/∂P_X (`axis` 0) or ∂f/∂P_Y (`axis` 1) at the nodes of a row; the nodal gradients count as separate
/// variables.
#[inline]
pub fn gradient_slopes(geometry: &RowGeometry, nodes: [&ShearNode; STENCIL], axis: usize) -> [f64; STENCIL] {
    let center = nodes[CENTER];
    let mut out = [0.0; STENCIL];
    for (k, weight) in [(WEST, geometry.west), (EAST, geometry.east), (SOUTH, geometry.south), (NORTH, geometry.north)]
    {
        let half_drop = 0.5 * weight * (nodes[k].node.pressure - center.node.pressure);
        out[k] += half_drop * nodes[k].mobility_gradient[axis];
        out[CENTER] += half_drop * center.mobility_gradient[axis];
    }
    for (k, weight) in geometry.upwind.into_iter().enumerate() {
        out[k] -= weight * nodes[k].flow_gradient[axis];
    }
    out
}

/// Operator G_X or G_Y: central differences of P along one axis, of second order for variable spacing too. P vanishes
/// beyond both ends, unless the last entry lies on an axis of symmetry.
#[derive(Clone, Debug, Default)]
pub struct NodalGradient {
    /// Weights of the upstream neighbour, the node itself and the downstream neighbour.
    pub weights: Vec<[f64; 3]>,
}

impl NodalGradient {
    /// Builds the operator on at least two increasing abscissae.
    pub fn new(x: &[f64]) -> Self {
        let last = x.len() - 1;
        let weights = (0..=last).map(|i| {
            let upstream = if i == 0 { x[1] - x[0] } else { x[i] - x[i - 1] };
            let downstream = if i == last { x[last] - x[last - 1] } else { x[i + 1] - x[i] };
            let sum = upstream + downstream;
            let (west, east) = (-downstream / (upstream * sum), upstream / (downstream * sum));
            [west, -(west + east), east]
        });
        Self { weights: weights.collect() }
    }

    /// Builds the operator for a last abscissa on an axis of symmetry, where the gradient vanishes. A single abscissa
    /// has gradient zero.
    pub fn up_to_axis(x: &[f64]) -> Self {
        if x.len() < 2 {
            return Self { weights: vec![[0.0; 3]; x.len()] };
        }
        let mut out = Self::new(x);
        if let Some(last) = out.weights.last_mut() {
            *last = [0.0; 3];
        }
        out
    }

    /// Returns the gradient at entry i of a node array.
    #[inline]
    pub fn at(&self, values: &[f64], i: usize) -> f64 {
        let [west, own, east] = self.weights[i];
        let upstream = if i == 0 { 0.0 } else { west * values[i - 1] };
        upstream + own * values[i] + values.get(i + 1).map_or(0.0, |v| east * v)
    }
}

/// Nodal gradients (P_X, P_Y) of node arrays over X and, fastest, Y. A single Y is a line contact.
#[derive(Clone, Debug, Default)]
pub struct PlaneGradient {
    along: NodalGradient,
    across: NodalGradient,
}

impl PlaneGradient {
    /// Builds the operators on a grid with these abscissae and ordinates; the last ordinate is the axis of symmetry.
    pub fn new(x: &[f64], y: &[f64]) -> Self {
        Self { along: NodalGradient::new(x), across: NodalGradient::up_to_axis(y) }
    }

    /// Builds the operators on the abscissae of a line contact.
    pub fn along_line(x: &[f64]) -> Self {
        Self::new(x, &[0.0])
    }

    /// G_X.
    pub fn along(&self) -> &NodalGradient {
        &self.along
    }

    /// Computes the gradients at all nodes, on all threads if `parallel`.
    pub fn field(&self, values: &[f64], out: &mut [[f64; 2]], parallel: bool) {
        let ny = self.across().max(1);
        let least = if parallel { SHARE.div_ceil(ny) } else { usize::MAX };
        pool::each_chunk(out, ny, least, |i, column| {
            column.iter_mut().enumerate().for_each(|(j, gradient)| *gradient = self.at(values, i, j));
        });
    }

    /// Returns the gradient at a node, given by its index.
    #[inline]
    pub fn at_node(&self, values: &[f64], node: usize) -> [f64; 2] {
        let ny = self.across();
        self.at(values, node / ny, node % ny)
    }

    /// Number of nodes across.
    #[inline]
    pub fn across(&self) -> usize {
        self.across.weights.len()
    }

    /// Returns the gradient at node (i, j).
    #[inline]
    pub fn at(&self, values: &[f64], i: usize, j: usize) -> [f64; 2] {
        let ny = self.across();
        let [west, own, east] = self.along.weights[i];
        let node = i * ny + j;
        let upstream = if i == 0 { 0.0 } else { west * values[node - ny] };
        let downstream = values.get(node + ny).map_or(0.0, |v| east * v);
        let across = self.across.at(&values[i * ny..(i + 1) * ny], j);
        [upstream + own * values[node] + downstream, across]
    }

    /// Returns the terms of the gradient at a node, along and across: upstream neighbour, node itself and downstream
    /// neighbour, with their weights. A missing neighbour has the node's own index and weight zero.
    pub fn parts(&self, node: usize) -> [[(usize, f64); 3]; 2] {
        let ny = self.across();
        let (i, j) = (node / ny, node % ny);
        let part = |weights: &[[f64; 3]], at: usize, stride: usize| {
            let [west, own, east] = weights[at];
            let (first, last) = (at == 0, at + 1 == weights.len());
            let upstream = if first { (node, 0.0) } else { (node - stride, west) };
            let downstream = if last { (node, 0.0) } else { (node + stride, east) };
            [upstream, (node, own), downstream]
        };
        [part(&self.along.weights, i, ny), part(&self.across.weights, j, 1)]
    }
}

#[cfg(test)]
mod tests {
    use super::super::{PENALTY, row};
    use super::*;
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::{Fluidity, Lubricant, ShearLaw, Sliding};

    const X: [f64; 8] = [-1.06, -1.045, -1.03, -1.015, -1.0, -0.98, -0.96, -0.93];
    const FILMS: [f64; 8] = [0.16, 0.15, 0.14, 0.13, 0.12, 0.11, 0.1, 0.1];
    const PRESSURES: [f64; 8] = [0.01, 0.012, 0.02, 0.03, 0.05, 0.06, 0.08, 0.07];
    const CARREAU: ShearLaw = ShearLaw::Carreau { critical_stress: 1e6, beta: 2.198, n: 0.6, npr: 0.1 };

    /// Row at entry 4 with its derivatives by all eight P and H.
    fn evaluate(shear: &ScaledShear, p: &[f64; 8], h: &[f64; 8]) -> (f64, [f64; 8], [f64; 8]) {
        let fluid = Lubricant::default().scaled(&OperatingPoint::TABLE_2_1).unwrap();
        let gradient = NodalGradient::new(&X);
        let node = |i: usize| {
            let gradient = [gradient.at(p, i), 0.0];
            ShearNode::new(
                &fluid,
                shear,
                100.0,
                NodeState { pressure: p[i], gradient, film: h[i] },
                FilmTreatment::default(),
            )
        };
        let nodes: [ShearNode; 4] = std::array::from_fn(|m| node(m + 2));
        let geometry = RowGeometry::new([X[2], X[3], X[4], X[5]]);
        let order = [0, 1, 2, 3, CENTER, CENTER];
        let r = row(&geometry, PENALTY, order.map(|m| &nodes[m].node));
        let slopes = gradient_slopes(&geometry, order.map(|m| &nodes[m]), 0);
        let (mut d_p, mut d_h) = ([0.0; 8], [0.0; 8]);
        for m in 0..4 {
            d_p[m + 2] += r.d_p[m];
            d_h[m + 2] += r.d_h[m];
            for (c, weight) in gradient.weights[m + 2].into_iter().enumerate() {
                d_p[m + 1 + c] += slopes[m] * weight;
            }
        }
        (r.value, d_p, d_h)
    }

    fn scaled(law: ShearLaw, srr: f64) -> ScaledShear {
        let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: None };
        ScaledShear::new(law, sliding, &OperatingPoint::TABLE_2_1).unwrap().unwrap()
    }

    #[test]
    fn derivatives_agree_with_finite_differences_everywhere() {
        for srr in [0.0, 0.02, -1.0] {
            let shear = scaled(CARREAU, srr);
            let (_, d_p, d_h) = evaluate(&shear, &PRESSURES, &FILMS);
            let largest = |d: &[f64; 8]| d.iter().fold(0.0f64, |a, b| a.max(b.abs()));
            for k in 0..8 {
                let step = 1e-7;
                let moved = |by: f64, film: bool| {
                    let (mut p, mut h) = (PRESSURES, FILMS);
                    if film {
                        h[k] += by
                    } else {
                        p[k] += by
                    }
                    evaluate(&shear, &p, &h).0
                };
                for (film, exact) in [(false, &d_p), (true, &d_h)] {
                    let difference = (moved(step, film) - moved(-step, film)) / (2.0 * step);
                    let error = (difference - exact[k]).abs() / largest(exact);
                    assert!(error < 1e-6, "SRR {srr}, entry {k}, film {film}: {error:e}");
                }
            }
            assert!(d_p[0] == 0.0 && d_p[1] != 0.0 || srr == 0.0, "the row reaches X −3 through the flow");
            assert!(d_p[6] != 0.0 && d_p[7] == 0.0, "and X +2 through the mobility");
        }
    }

    #[test]
    fn rows_without_thinning_are_newtonian_for_any_sliding() {
        let fluid = Lubricant::default().scaled(&OperatingPoint::TABLE_2_1).unwrap();
        let nodes: Vec<Node> = (2..6).map(|i| Node::new(&fluid, 100.0, PRESSURES[i], FILMS[i])).collect();
        let geometry = RowGeometry::new([X[2], X[3], X[4], X[5]]);
        let newtonian = row(&geometry, PENALTY, [0, 1, 2, 3, CENTER, CENTER].map(|m| &nodes[m]));
        for srr in [0.0, 0.5, -2.0] {
            let fluidity = Fluidity::of(CARREAU, 1.0).unwrap().0;
            let shear = ScaledShear { fluidity, ..scaled(CARREAU, srr) };
            let (value, d_p, d_h) = evaluate(&shear, &PRESSURES, &FILMS);
            assert!((value / newtonian.value - 1.0).abs() < 1e-12, "SRR {srr}");
            let scale = |d: &[f64]| d.iter().fold(0.0f64, |a, b| a.max(b.abs()));
            for m in 0..4 {
                assert!((d_p[m + 2] - newtonian.d_p[m]).abs() < 1e-12 * scale(&newtonian.d_p), "SRR {srr}");
                assert!((d_h[m + 2] - newtonian.d_h[m]).abs() < 1e-12 * scale(&newtonian.d_h), "SRR {srr}");
            }
        }
    }

    #[test]
    fn the_row_is_even_in_the_slide_to_roll_ratio() {
        let (one, other) = (scaled(CARREAU, 0.3), scaled(CARREAU, -0.3));
        let (a, b) = (evaluate(&one, &PRESSURES, &FILMS).0, evaluate(&other, &PRESSURES, &FILMS).0);
        assert!((a / b - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_parts_of_a_gradient_add_up_to_it() {
        let plane = PlaneGradient::new(&X, &[-1.0, -0.6, -0.3, 0.0]);
        let values: Vec<f64> = (0..4 * X.len()).map(|k| (k as f64 * 0.7).sin()).collect();
        for node in 0..values.len() {
            let sums = plane.parts(node).map(|part| part.iter().map(|(k, w)| w * values[*k]).sum::<f64>());
            assert_eq!(sums, plane.at_node(&values, node), "{node}");
        }
    }

    #[test]
    fn the_gradient_is_of_second_order_on_any_grid() {
        let gradient = NodalGradient::new(&X);
        let parabola = X.map(|x| 3.0 * x * x - x);
        for (i, x) in X.iter().enumerate().take(7).skip(1) {
            assert!((gradient.at(&parabola, i) - (6.0 * x - 1.0)).abs() < 1e-11);
        }
    }
}
