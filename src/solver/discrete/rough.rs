//! Nodes and rows of a contact with rough surfaces.
//!
//! The unknown is the total pressure P = P_h + P_a(H), the sum of the film pressure P_h and the asperity pressure P_a at
//! the film thickness H. The Reynolds equation holds for P_h, so its derivative with respect to H contains that of P_a
//! at the same node. At the ends of the domain P_h is prescribed, and the asperities carry nothing.
//!
//! A film that is shear-thinning or thermal is evaluated as a smooth one with the pressure P_h and the mean gap of the
//! rough surfaces. Its mobility is then multiplied by the ratio of the flow factor's H³φ to the cube of the mean gap,
//! and its flow by the ratio of the flow that both surfaces carry to the mean gap.

use super::nodes::Nodes;
use super::reynolds::{CENTER, Node, Row, RowGeometry, STENCIL, row};
use crate::host::pool;
use crate::solver::physics::lubricant::ScaledFluid;
use crate::solver::physics::surfaces::{AsperityTable, ScaledRoughness};

/// Nodes per task.
const SHARE: usize = 512;

/// Asperity pressure of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Asperities {
    /// P_a.
    pub pressure: f64,
    /// dP_a/dH.
    pub slope: f64,
}

impl Asperities {
    /// Evaluates a law at the film thickness H of a node with a quadrature weight, which vanishes at the ends of the
    /// domain.
    pub fn at(rough: &ScaledRoughness, table: &AsperityTable, film: f64, weight: f64) -> Self {
        if weight <= 0.0 {
            return Self::default();
        }
        let (pressure, slope) = rough.asperity_pressure(table, film);
        Self { pressure, slope }
    }
}

/// One node of a rough contact.
#[derive(Clone, Copy, Debug, Default)]
struct RoughNode {
    /// Node of the film: P_h, flow and mobility along X.
    along: Node,
    /// The same with the mobility along Y; used in anisotropic contacts only.
    across: Node,
    asperities: Asperities,
    /// Shear flow between surfaces of unequal roughness, a part of the flow that is not stored mass, and its derivatives
    /// by P_h and H.
    sheared: [f64; 3],
}

/// Laws of a rough contact.
#[derive(Clone, Copy, Debug)]
pub struct RoughLaws<'a> {
    /// Density and viscosity.
    pub fluid: &'a ScaledFluid,
    /// Roughness.
    pub rough: &'a ScaledRoughness,
    /// 1/λ̄ of (2.23).
    pub inverse_lambda: f64,
}

/// Nodes of a rough contact, with the table of their asperity law.
#[derive(Clone, Debug)]
pub struct RoughNodes {
    table: AsperityTable,
    nodes: Vec<RoughNode>,
    /// P_h ≥ 0 and mean gap of the last evaluation by [`RoughNodes::evaluate_film`], node arrays.
    fields: [Vec<f64>; 2],
}

impl RoughNodes {
    /// Allocates `count` nodes and tabulates the asperity law.
    pub fn new(rough: &ScaledRoughness, count: usize) -> Self {
        Self { table: rough.table(), nodes: vec![RoughNode::default(); count], fields: Default::default() }
    }

    /// Returns the table of the asperity law.
    pub fn table(&self) -> &AsperityTable {
        &self.table
    }

    /// Returns the asperity pressure of a node at the last evaluation.
    #[inline]
    pub fn asperities(&self, node: usize) -> Asperities {
        self.nodes[node].asperities
    }

    /// Returns the film pressure P_h of a node at the last evaluation.
    #[inline]
    pub fn film_pressure(&self, node: usize) -> f64 {
        self.nodes[node].along.pressure
    }

    /// Returns the mass ρ̄ times mean gap that each node stores, at the last evaluation.
    pub fn stored(&self) -> impl Iterator<Item = f64> + '_ {
        self.nodes.iter().map(|node| node.along.flow - node.sheared[0])
    }

    /// Returns the asperity pressure at every node of the last evaluation, node array.
    pub fn asperity_pressure(&self) -> Vec<f64> {
        self.nodes.iter().map(|node| node.asperities.pressure).collect()
    }

    /// Evaluates all nodes at total pressure P and film thickness H, and writes those of the film to `nodes`. `weights`
    /// are the quadrature weights of the grid, which vanish at its ends.
    pub fn evaluate(
        &mut self,
        laws: RoughLaws<'_>,
        (pressure, film): (&[f64], &[f64]),
        weights: &[f64],
        nodes: &mut Nodes,
        parallel: bool,
    ) {
        let table = &self.table;
        let one = |k: usize, node: &mut RoughNode| {
            let asperities = Asperities::at(laws.rough, table, film[k], weights[k]);
            *node = RoughNode::new(laws, pressure[k], film[k], asperities);
        };
        if parallel {
            pool::each(&mut self.nodes, SHARE, one);
        } else {
            self.nodes.iter_mut().enumerate().for_each(|(k, node)| one(k, node));
        }
        nodes.set(self.nodes.iter().map(|node| node.along));
    }

    /// Evaluates all nodes like [`Self::evaluate`] for a film whose laws depend on the pressure gradient or on
    /// temperatures. `smooth` evaluates the nodes of a smooth film with the pressures P_h ≥ 0 and the mean gaps that it
    /// receives.
    pub fn evaluate_film(
        &mut self,
        laws: RoughLaws<'_>,
        (pressure, film): (&[f64], &[f64]),
        weights: &[f64],
        nodes: &mut Nodes,
        smooth: impl FnOnce(&mut Nodes, (&[f64], &[f64])),
    ) {
        let Self { table, nodes: own, fields: [pressures, gaps] } = self;
        pressures.clear();
        gaps.clear();
        let film_pressure = |k: usize, node: &RoughNode| pressure[k] - node.asperities.pressure;
        for (k, node) in own.iter_mut().enumerate() {
            node.asperities = Asperities::at(laws.rough, table, film[k], weights[k]);
            pressures.push(film_pressure(k, node).max(0.0));
            gaps.push(laws.rough.mean_gap(film[k]).0);
        }
        smooth(nodes, (pressures, gaps));
        for (k, node) in own.iter_mut().enumerate() {
            let between = FilmBetween::new(laws.rough, film_pressure(k, node), film[k]);
            let smooth = nodes[k];
            let (along, across) = (laws.rough.cube(film[k]), laws.rough.cube_across(film[k]));
            node.across = across.map(|cube| between.node(&smooth, cube)).unwrap_or_default();
            node.along = between.node(&smooth, along);
            node.sheared = between.sheared(&smooth);
            nodes.replace(k, node.along, (between.per_gap(along.0, 3), between.carried.0));
        }
    }

    /// Evaluates one node of a contact whose flow is the same along X and Y, and writes its film to `nodes`. If it is
    /// `cavitated`, the film carries no pressure. Returns the asperity pressure.
    #[inline]
    pub fn evaluate_one(
        &mut self,
        laws: RoughLaws<'_>,
        (k, cavitated): (usize, bool),
        (pressure, film): (f64, f64),
        nodes: &mut Nodes,
    ) -> Asperities {
        let (carried, slope) = laws.rough.asperity_pressure(&self.table, film);
        let asperities = Asperities { pressure: carried, slope };
        let total = if cavitated { carried } else { pressure };
        let node = RoughNode::new(laws, total, film, asperities);
        nodes.put(k, node.along);
        self.nodes[k] = node;
        asperities
    }

    /// Evaluates a row at these nodes, with its derivatives with respect to total pressure and film thickness.
    #[inline]
    pub fn row(&self, rough: &ScaledRoughness, geometry: &RowGeometry, stencil: [usize; STENCIL]) -> Row {
        let at = |geometry: &RowGeometry, of: fn(&RoughNode) -> &Node| {
            row(geometry, 0.0, stencil.map(|node| of(&self.nodes[node])))
        };
        let mut own = if rough.is_anisotropic() {
            let RowGeometry { south, north, .. } = *geometry;
            let along = at(&RowGeometry { south: 0.0, north: 0.0, ..*geometry }, |node| &node.along);
            let across = at(&RowGeometry { south, north, ..RowGeometry::default() }, |node| &node.across);
            sum(along, &across)
        } else {
            at(geometry, |node| &node.along)
        };
        if geometry.storage != 0.0 {
            let [flow, flow_p, flow_h] = self.nodes[stencil[CENTER]].sheared;
            own.value += geometry.storage * flow;
            own.d_p[CENTER] += geometry.storage * flow_p;
            own.d_h[CENTER] += geometry.storage * flow_h;
        }
        for ((d_h, d_p), &node) in own.d_h.iter_mut().zip(own.d_p).zip(&stencil) {
            *d_h -= d_p * self.nodes[node].asperities.slope;
        }
        own
    }
}

fn sum(mut first: Row, second: &Row) -> Row {
    first.value += second.value;
    first.d_p.iter_mut().zip(second.d_p).for_each(|(a, b)| *a += b);
    first.d_h.iter_mut().zip(second.d_h).for_each(|(a, b)| *a += b);
    first
}

impl RoughNode {
    fn new(laws: RoughLaws<'_>, pressure: f64, film: f64, asperities: Asperities) -> Self {
        let RoughLaws { fluid, rough, inverse_lambda } = laws;
        let film_pressure = pressure - asperities.pressure;
        let state = fluid.at(film_pressure.max(0.0));
        // Below zero the laws are constant.
        let rises = f64::from(u8::from(film_pressure >= 0.0));
        let (density_slope, viscosity_slope) = (rises * state.density_slope, rises * state.log_viscosity_slope);
        let ((gap, gap_h), (shear, shear_h)) = (rough.mean_gap(film), rough.shear_flow(film));
        let (carried, carried_h) = (gap + shear, gap_h + shear_h);
        let per_cube = state.density / state.viscosity * inverse_lambda;
        let thins = density_slope / state.density - viscosity_slope;
        let node = |(cube, cube_h): (f64, f64)| Node {
            pressure: film_pressure,
            flow: state.density * carried,
            flow_p: density_slope * carried,
            flow_h: state.density * carried_h,
            mobility: per_cube * cube,
            mobility_p: per_cube * cube * thins,
            mobility_h: per_cube * cube_h,
        };
        let across = rough.cube_across(film).map(node).unwrap_or_default();
        let sheared = [state.density * shear, density_slope * shear, state.density * shear_h];
        Self { along: node(rough.cube(film)), across, asperities, sheared }
    }
}

/// Conversion of a node of a smooth film with the mean gap to one between rough surfaces.
struct FilmBetween {
    film_pressure: f64,
    /// 1 if the laws depend on P_h, 0 below zero, where they are constant.
    rises: f64,
    /// Mean gap and its derivative by H.
    gap: (f64, f64),
    /// Flow that both surfaces carry over the mean gap, and its derivative by H.
    carried: (f64, f64),
}

impl FilmBetween {
    fn new(rough: &ScaledRoughness, film_pressure: f64, film: f64) -> Self {
        let (gap, (shear, shear_h)) = (rough.mean_gap(film), rough.shear_flow(film));
        let extra = shear / gap.0;
        let rises = f64::from(u8::from(film_pressure >= 0.0));
        Self { film_pressure, rises, gap, carried: (1.0 + extra, (shear_h - extra * gap.1) / gap.0) }
    }

    /// Returns a value over a power of the mean gap.
    fn per_gap(&self, value: f64, power: i32) -> f64 {
        value / self.gap.0.powi(power)
    }

    /// Returns the node. `cube` is the cube of the film thickness times the flow factor, and its derivative by H.
    fn node(&self, smooth: &Node, (cube, cube_h): (f64, f64)) -> Node {
        let (_, gap_h) = self.gap;
        let factor = self.per_gap(cube, 3);
        let factor_h = self.per_gap(cube_h, 3) - 3.0 * factor * gap_h / self.gap.0;
        let (carried, carried_h) = self.carried;
        Node {
            pressure: self.film_pressure,
            flow: smooth.flow * carried,
            flow_p: self.rises * smooth.flow_p * carried,
            flow_h: smooth.flow_h * gap_h * carried + smooth.flow * carried_h,
            mobility: smooth.mobility * factor,
            mobility_p: self.rises * smooth.mobility_p * factor,
            mobility_h: smooth.mobility_h * gap_h * factor + smooth.mobility * factor_h,
        }
    }

    /// Returns the flow that is not stored mass, and its derivatives by P_h and H.
    fn sheared(&self, smooth: &Node) -> [f64; 3] {
        let (_, gap_h) = self.gap;
        let (extra, extra_h) = (self.carried.0 - 1.0, self.carried.1);
        [smooth.flow * extra, self.rises * smooth.flow_p * extra, smooth.flow_h * gap_h * extra + smooth.flow * extra_h]
    }
}
