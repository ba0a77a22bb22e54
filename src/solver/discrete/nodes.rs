//! Evaluation of the nodes of a contact at one state, Newtonian, generalized or thermal. All parts of the solver use
//! it: the full system, reduced and linearised models, error measures and balances.

use super::heat::{RULE, WarmFilm, WarmLaws};
use super::reynolds::film_integrals::KnownFilm;
use super::reynolds::generalized::{FilmTreatment, NodeState, PlaneGradient, ShearNode, gradient_slopes};
use super::reynolds::{Node, Row, RowGeometry, STENCIL, row};
use crate::host::pool::on_all_cores;
use crate::solver::physics::lubricant::{ScaledFluid, ScaledShear};
use rayon::prelude::*;
use std::ops::{Deref, Range};

/// Laws that determine a node from pressure, gradient and film thickness in one contact.
#[derive(Clone, Copy, Debug)]
pub struct Laws<'a> {
    /// Density and viscosity.
    pub fluid: &'a ScaledFluid,
    /// Shear-thinning law; `None` for a Newtonian lubricant.
    pub shear: Option<&'a ScaledShear>,
    /// 1/λ̄ of (2.23).
    pub inverse_lambda: f64,
}

/// Order in which nodes are evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// On all threads. Each node starts from its own film of the previous evaluation.
    Parallel,
    /// One after the other. Each node starts from its own film of the previous evaluation.
    Alone,
    /// One after the other. A node without a previous film starts from the film of the node before it.
    BesideTheFormer,
}

/// Nodes per task, Newtonian and shear-thinning: a film integral takes as long as some hundred Newtonian nodes.
const SHARE: [usize; 2] = [2048, 32];

/// Number of nodes whose laws are evaluated at once.
const AT_ONCE: usize = 8;

/// Nodes as the rows use them. Dereferences to a slice of [`Node`].
#[derive(Clone, Debug)]
pub struct Nodes {
    nodes: Vec<Node>,
    /// Shear-thinning part of each node; empty if the last evaluated state was Newtonian.
    thinning: Vec<ShearNode>,
}

impl Deref for Nodes {
    type Target = [Node];

    fn deref(&self) -> &[Node] {
        &self.nodes
    }
}

impl Nodes {
    /// Allocates `count` nodes, and their shear-thinning parts if `thinning`.
    pub fn new(count: usize, thinning: bool) -> Self {
        Self { nodes: vec![Node::default(); count], thinning: Vec::with_capacity(if thinning { count } else { 0 }) }
    }

    /// Evaluates the nodes of the given pressure and film thickness.
    pub fn of(laws: Laws<'_>, gradient: &PlaneGradient, pressure: &[f64], film: &[f64]) -> Self {
        let mut nodes = Self::new(pressure.len(), laws.shear.is_some());
        let at = |k: usize| gradient.at_node(pressure, k);
        nodes.evaluate(laws, (pressure, film), at, FilmTreatment::default(), Order::Alone);
        nodes
    }

    /// Discards the films of previous evaluations. Those of another contact are not suitable as initial guesses.
    pub fn forget(&mut self) {
        self.thinning.fill(ShearNode::default());
    }

    /// Returns true if the last evaluated state is shear-thinning.
    pub fn thins(&self) -> bool {
        !self.thinning.is_empty()
    }

    /// Evaluates all nodes at pressure P and film thickness H. `gradient` returns (P_X, P_Y) of a node; it is not
    /// called for a Newtonian lubricant.
    pub fn evaluate(
        &mut self,
        laws: Laws<'_>,
        (pressure, film): (&[f64], &[f64]),
        gradient: impl Fn(usize) -> [f64; 2] + Sync,
        treatment: FilmTreatment,
        order: Order,
    ) {
        let Laws { fluid, shear, inverse_lambda } = laws;
        let Some(law) = shear else {
            self.thinning.clear();
            let of = |(node, (&p, &h)): (&mut Node, (&f64, &f64))| *node = Node::new(fluid, inverse_lambda, p, h);
            match order {
                Order::Parallel if self.nodes.len() / 2 >= SHARE[0] => on_all_cores(|| {
                    let states = pressure.par_iter().zip(film);
                    self.nodes.par_iter_mut().zip(states).with_min_len(SHARE[0]).for_each(of);
                }),
                _ => self.nodes.iter_mut().zip(pressure.iter().zip(film)).for_each(of),
            }
            return;
        };
        self.thinning.resize(self.nodes.len(), ShearNode::default());
        let thinned = |k: usize, known: &KnownFilm| {
            let state = NodeState { pressure: pressure[k], gradient: gradient(k), film: film[k] };
            ShearNode::near(known, fluid, law, inverse_lambda, state, treatment)
        };
        match order {
            Order::Parallel if self.nodes.len() / 2 >= SHARE[1] => on_all_cores(|| {
                let all = self.thinning.par_iter_mut().zip(&mut self.nodes).enumerate().with_min_len(SHARE[1]);
                all.for_each(|(k, (own, node))| {
                    *own = thinned(k, &own.known);
                    *node = own.node;
                });
            }),
            Order::Parallel | Order::Alone => {
                for (k, (own, node)) in self.thinning.iter_mut().zip(&mut self.nodes).enumerate() {
                    *own = thinned(k, &own.known);
                    *node = own.node;
                }
            }
            Order::BesideTheFormer => self.thin_beside_the_former(0..self.nodes.len(), thinned),
        }
    }

    /// Evaluates a part of the nodes in the order [`Order::BesideTheFormer`]. `gradient` as in [`Self::evaluate`].
    pub fn evaluate_part(
        &mut self,
        laws: &Laws<'_>,
        part: Range<usize>,
        (pressure, film): (&[f64], &[f64]),
        gradient: impl Fn(usize) -> [f64; 2],
        treatment: FilmTreatment,
    ) {
        if let Some(law) = laws.shear {
            self.thin((laws, law), part, (pressure, film), gradient, treatment);
            return;
        }
        self.thinning.clear();
        let states = pressure[part.clone()].chunks(AT_ONCE).zip(film[part.clone()].chunks(AT_ONCE));
        for (nodes, (pressures, films)) in self.nodes[part].chunks_mut(AT_ONCE).zip(states) {
            let mut several = [0.0; AT_ONCE];
            several[..pressures.len()].copy_from_slice(pressures);
            let fluid = laws.fluid.at_all(&several);
            for (node, (state, (&p, &h))) in nodes.iter_mut().zip(fluid.iter().zip(pressures.iter().zip(films))) {
                *node = Node::of_state(state, laws.inverse_lambda, p, h);
            }
        }
    }

    /// Evaluates some nodes of a shear-thinning lubricant in the order [`Order::BesideTheFormer`]. `gradient` as in
    /// [`Self::evaluate`].
    pub fn thin(
        &mut self,
        (laws, law): (&Laws<'_>, &ScaledShear),
        wanted: impl IntoIterator<Item = usize>,
        (pressure, film): (&[f64], &[f64]),
        gradient: impl Fn(usize) -> [f64; 2],
        treatment: FilmTreatment,
    ) {
        self.thinning.resize(self.nodes.len(), ShearNode::default());
        self.thin_beside_the_former(wanted, |k, known| {
            let state = NodeState { pressure: pressure[k], gradient: gradient(k), film: film[k] };
            ShearNode::near(known, laws.fluid, law, laws.inverse_lambda, state, treatment)
        });
    }

    /// Evaluates some nodes in the order [`Order::BesideTheFormer`]. `thinned` receives the index of a node and a
    /// film to start from. The stress changes little between two evaluations; in the first evaluation the previous
    /// node is close enough.
    fn thin_beside_the_former(
        &mut self,
        wanted: impl IntoIterator<Item = usize>,
        thinned: impl Fn(usize, &KnownFilm) -> ShearNode,
    ) {
        let mut former = KnownFilm::default();
        for k in wanted {
            let own = &mut self.thinning[k];
            *own = thinned(k, if own.known.is_empty() { &former } else { &own.known });
            (self.nodes[k], former) = (own.node, own.known);
        }
    }

    /// Evaluates all nodes at P, H and the temperatures of a film. `gradient` returns (P_X, P_Y) of a node.
    pub fn evaluate_warm(
        &mut self,
        laws: &WarmLaws<'_>,
        (pressure, film): (&[f64], &[f64]),
        gradient: impl Fn(usize) -> [f64; 2] + Sync,
        warm: &mut WarmFilm,
        order: Order,
    ) {
        self.thinning.resize(self.nodes.len(), ShearNode::default());
        let one = |k: usize, (own, node): (&mut ShearNode, &mut Node), (theta, stress): (&[f64; RULE], &mut f64)| {
            let state = NodeState { pressure: pressure[k], gradient: gradient(k), film: film[k] };
            *own = laws.node(state, theta, stress);
            *node = own.node;
        };
        match order {
            Order::Parallel if self.nodes.len() / 2 >= SHARE[1] => on_all_cores(|| {
                let temperatures = warm.theta.par_iter().zip(&mut warm.stress);
                let all = self.thinning.par_iter_mut().zip(&mut self.nodes).zip(temperatures).enumerate();
                all.with_min_len(SHARE[1]).for_each(|(k, (node, film))| one(k, node, film));
            }),
            _ => {
                let temperatures = warm.theta.iter().zip(&mut warm.stress);
                let all = self.thinning.iter_mut().zip(&mut self.nodes).zip(temperatures).enumerate();
                all.for_each(|(k, (node, film))| one(k, node, film));
            }
        }
    }

    /// Does the same for some of the nodes, one after the other.
    pub fn evaluate_warm_at(
        &mut self,
        wanted: &[usize],
        laws: &WarmLaws<'_>,
        (pressure, film): (&[f64], &[f64]),
        gradient: impl Fn(usize) -> [f64; 2],
        warm: &mut WarmFilm,
    ) {
        self.thinning.resize(self.nodes.len(), ShearNode::default());
        for &k in wanted {
            let state = NodeState { pressure: pressure[k], gradient: gradient(k), film: film[k] };
            self.thinning[k] = laws.node(state, &warm.theta[k], &mut warm.stress[k]);
            self.nodes[k] = self.thinning[k].node;
        }
    }

    /// Sets a node to the fill fraction θ: its unknown is then θ, at P = 0.
    pub fn fill(&mut self, node: usize, fraction: f64) {
        let Node { pressure, flow, flow_p, flow_h, mobility_p, .. } = &mut self.nodes[node];
        (*pressure, *mobility_p) = (0.0, 0.0);
        (*flow, *flow_p, *flow_h) = (fraction * *flow, *flow, fraction * *flow_h);
        if let Some(thinning) = self.thinning.get_mut(node) {
            thinning.flow_gradient = thinning.flow_gradient.map(|slope| fraction * slope);
        }
    }

    /// Sets a node to a given flow, independent of its film thickness.
    pub fn supply(&mut self, node: usize, flow: f64) {
        let node = &mut self.nodes[node];
        (node.flow, node.flow_p, node.flow_h) = (flow, 0.0, 0.0);
    }

    /// Takes over nodes that were evaluated elsewhere.
    pub fn set(&mut self, nodes: impl Iterator<Item = Node>) {
        self.thinning.clear();
        self.nodes.iter_mut().zip(nodes).for_each(|(own, node)| *own = node);
    }

    /// Replaces one node of an evaluated film. The derivatives of mobility and flow by the pressure gradient are
    /// multiplied by the factors.
    pub fn replace(&mut self, k: usize, node: Node, (mobility, flow): (f64, f64)) {
        self.nodes[k] = node;
        if let Some(thinning) = self.thinning.get_mut(k) {
            thinning.node = node;
            thinning.mobility_gradient = thinning.mobility_gradient.map(|slope| mobility * slope);
            thinning.flow_gradient = thinning.flow_gradient.map(|slope| flow * slope);
        }
    }

    /// Replaces one node of a Newtonian state.
    #[inline]
    pub fn put(&mut self, k: usize, node: Node) {
        self.nodes[k] = node;
    }

    /// Evaluates a row at these nodes.
    #[inline]
    pub fn row(&self, geometry: &RowGeometry, penalty: f64, stencil: [usize; STENCIL]) -> Row {
        row(geometry, penalty, stencil.map(|node| &self.nodes[node]))
    }

    /// Returns the derivatives of a row by the nodal gradients along an axis, see [`gradient_slopes`]. Requires a
    /// shear-thinning state.
    #[inline]
    pub fn slopes(&self, geometry: &RowGeometry, stencil: [usize; STENCIL], axis: usize) -> [f64; STENCIL] {
        gradient_slopes(geometry, stencil.map(|node| &self.thinning[node]), axis)
    }
}
