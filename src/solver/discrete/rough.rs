//! Nodes and rows of a contact with rough surfaces.
//!
//! The unknown is the total pressure P = P_h + P_a(H), the sum of the film pressure P_h and the asperity pressure P_a at
//! the film thickness H. The Reynolds equation holds for P_h, so its derivative with respect to H contains that of P_a
//! at the same node. At the ends of the domain P_h is prescribed, and the asperities carry nothing.

use super::nodes::Nodes;
use super::reynolds::{Node, Row, RowGeometry, STENCIL, row};
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

/// One node of a rough contact.
#[derive(Clone, Copy, Debug, Default)]
struct RoughNode {
    /// Node of the film: P_h, flow and mobility along X.
    along: Node,
    /// The same with the mobility along Y; used in anisotropic contacts only.
    across: Node,
    asperities: Asperities,
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
}

impl RoughNodes {
    /// Allocates `count` nodes and tabulates the asperity law.
    pub fn new(rough: &ScaledRoughness, count: usize) -> Self {
        Self { table: rough.table(), nodes: vec![RoughNode::default(); count] }
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
            let asperities = if weights[k] > 0.0 {
                let (pressure, slope) = laws.rough.asperity_pressure(table, film[k]);
                Asperities { pressure, slope }
            } else {
                Asperities::default()
            };
            *node = RoughNode::new(laws, pressure[k], film[k], asperities);
        };
        if parallel {
            pool::each(&mut self.nodes, SHARE, one);
        } else {
            self.nodes.iter_mut().enumerate().for_each(|(k, node)| one(k, node));
        }
        nodes.set(self.nodes.iter().map(|node| node.along));
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
        let (carried, carried_h) = rough.carried(film);
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
        Self { along: node(rough.cube(film)), across, asperities }
    }
}
