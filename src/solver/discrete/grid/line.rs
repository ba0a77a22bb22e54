//! Computational domain of a line contact: uniform as in the dissertation, or graded towards the ends of the Hertzian
//! zone.
//!
//! A grid is a *reference* grid in ξ, built once with its elastic kernel, and an affine map X = −1 + (ξ + 1) s. For s
//! = 1 both are the same. Registration chooses s so that the pressure spike always lies at ξ = 1. Then the contacts
//! of a whole range of the Moes numbers M and L are similar in ξ, which suits a reduced basis. One fine patch of
//! nodes resolves all their spikes.
//!
//! Node arrays everywhere in the solver have one extra leading node. Index 0 lies outside the inlet and belongs to
//! the upwind stencil of the first unknown. Index 1 is the inlet, the last index the outlet. The pressure P vanishes
//! at all three.

mod refined;

use super::{GridError, GridSpec, dot};
use crate::solver::discrete::elasticity::{Flexibility, Scratch};
use crate::solver::discrete::reynolds::RowGeometry;
use crate::solver::limits::Number;
use crate::solver::physics::contact::Moes;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Index of the inlet node in node arrays.
pub const INLET: usize = 1;
/// Index of the first unknown pressure in node arrays.
pub const FIRST_UNKNOWN: usize = 2;
/// Maximum number of nodes of a graded grid; its kernel is stored as a dense matrix.
pub const MAX_GRADED_NODES: usize = 4001;
/// Maximum number of nodes of a uniform grid.
pub const MAX_UNIFORM_NODES: usize = 200_001;

/// Longest inlet of a domain, as −X.
pub const LONGEST_INLET: f64 = 1e7;
/// Longest outlet of a domain.
pub const LONGEST_OUTLET: f64 = 1e7;

const EXPLORER_NODES: usize = 632;
const EXPLORER_INLET: f64 = -20.0;
const EXPLORER_OUTLET: f64 = 3.2;

/// Returns X = −1 + (ξ + 1) s of a reference abscissa ξ under the map with scale s.
#[inline]
pub fn stretched(xi: f64, scale: f64) -> f64 {
    -1.0 + (xi + 1.0) * scale
}

impl GridSpec {
    /// Grid of the dissertation: 1201 nodes from −4 to 2.
    pub const DISSERTATION: Self = Self::Uniform { dx: 0.005, domain: (-4.0, 2.0) };

    /// Default grid of the explorer: 632 registered nodes, fine at ξ = ±1, with an inlet long enough for M = 2.
    pub const EXPLORER: Self =
        Self::Graded { nodes: EXPLORER_NODES, domain: (EXPLORER_INLET, EXPLORER_OUTLET), registered: true };

    /// Returns a grid with the spacing and outlet of [`GridSpec::EXPLORER`] and another inlet. The number of nodes
    /// follows.
    pub fn explorer_from(inlet: f64, registered: bool) -> Self {
        let domain = (inlet, EXPLORER_OUTLET);
        Self::Graded { nodes: explorer_cells(domain) + 1, domain, registered }
    }

    /// Builds the reference grid of line contacts and its kernel. This is expensive and done once per specification.
    ///
    /// # Errors
    /// If the domain cuts the contact, the number of nodes is out of range, or it is a grid of point contacts.
    pub fn line(&self) -> Result<Arc<ReferenceGrid>, GridError> {
        let xi = self.line_nodes()?;
        Ok(Arc::new(ReferenceGrid::of_nodes(*self, xi)?))
    }

    /// Checks the specification without building the grid.
    ///
    /// # Errors
    /// As [`GridSpec::build`].
    pub fn check(&self) -> Result<(), GridError> {
        match self {
            Self::Uniform { .. } | Self::Graded { .. } | Self::Following { .. } => self.line_nodes().map(|_| ()),
            Self::Plane(spec) => spec.check().map(|_| ()),
        }
    }

    /// Returns the abscissae ξ of a line contact's grid.
    fn line_nodes(&self) -> Result<Vec<f64>, GridError> {
        let holds_the_contact = |(from, to): (f64, f64)| {
            if (-LONGEST_INLET..=-1.5).contains(&from) && (1.2..=LONGEST_OUTLET).contains(&to) {
                return Ok(());
            }
            let (from, to) = (Number(from), Number(to));
            Err(GridError::Refused(format!(
                "the domain {from}…{to} cuts the contact; its inlet must lie between −{LONGEST_INLET} and −1.5 and its \
                 outlet between 1.2 and {LONGEST_OUTLET}"
            )))
        };
        Ok(match *self {
            Self::Uniform { dx, domain } => {
                holds_the_contact(domain)?;
                let (from, to) = domain;
                let cells = ((to - from) / dx).round();
                if !(cells.is_finite() && dx > 0.0 && cells >= 60.0 && cells < MAX_UNIFORM_NODES as f64) {
                    return Err(GridError::nodes(cells + 1.0, MAX_UNIFORM_NODES));
                }
                let cells = cells as usize;
                let step = (to - from) / cells as f64;
                (0..cells + 2).map(|i| from + (i as f64 - 1.0) * step).collect()
            }
            Self::Graded { nodes, domain, .. } => {
                holds_the_contact(domain)?;
                if !(61..=MAX_GRADED_NODES).contains(&nodes) {
                    return Err(GridError::nodes(nodes as f64, MAX_GRADED_NODES));
                }
                graded_nodes(nodes, domain.0, domain.1)
            }
            Self::Following { zone, finer, domain } => {
                holds_the_contact(domain)?;
                if !((1e-7..=1.0).contains(&zone) && (0.1..=64.0).contains(&finer)) {
                    return Err(GridError::Refused(format!(
                        "the zone is {} and the refinement {}, but must lie between 1e-7 and 1, and between 0.1 and 64",
                        Number(zone),
                        Number(finer)
                    )));
                }
                following_nodes(zone, 1.0 / finer, domain)?
            }
            Self::Plane(_) => {
                let sentence = "a line contact has no Y; its grid is uniform or graded along X";
                return Err(GridError::Refused(sentence.to_owned()));
            }
        })
    }
}

/// Reference grid with its elastic kernel, shared by all grids mapped from it.
#[derive(Debug)]
pub struct ReferenceGrid {
    /// Specification from which it was built.
    pub spec: GridSpec,
    /// Node abscissae ξ with the leading node outside the inlet.
    pub xi: Vec<f64>,
    /// Quadrature weights (cell sizes) in ξ; zero at the three nodes where P vanishes.
    pub weights: Vec<f64>,
    /// Deformation of every node by every pressure, in ξ.
    pub flexibility: Flexibility,
}

/// Grid of one contact: a reference grid under the map X = −1 + (ξ + 1) s.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "Placed", try_from = "Placed")]
pub struct LineGrid {
    /// Reference grid.
    pub reference: Arc<ReferenceGrid>,
    /// Scale s of the map; 1 without registration.
    pub scale: f64,
    /// Node abscissae X with the leading node outside the inlet.
    pub x: Vec<f64>,
    /// Quadrature weights in X.
    pub weights: Vec<f64>,
    /// Difference coefficients of the equations at the unknowns. Entry k belongs to node k + [`FIRST_UNKNOWN`].
    pub rows: Vec<RowGeometry>,
}

/// Data from which the grid of one contact is built.
#[derive(Serialize, Deserialize)]
struct Placed {
    spec: GridSpec,
    scale: f64,
}

impl From<LineGrid> for Placed {
    fn from(grid: LineGrid) -> Self {
        Self { spec: grid.reference.spec, scale: grid.scale }
    }
}

impl TryFrom<Placed> for LineGrid {
    type Error = GridError;

    fn try_from(Placed { spec, scale }: Placed) -> Result<Self, GridError> {
        Ok(spec.line()?.scaled(scale))
    }
}

impl ReferenceGrid {
    /// Computes the weights and the kernel of given abscissae, including the node outside.
    fn of_nodes(spec: GridSpec, xi: Vec<f64>) -> Result<Self, GridError> {
        let flexibility = match spec {
            GridSpec::Uniform { .. } => Flexibility::uniform(xi[1] - xi[0], xi.len())?,
            _ => Flexibility::graded(&xi),
        };
        Ok(Self { spec, weights: node_weights(&xi), xi, flexibility })
    }

    /// Returns the scale of the map for a contact, from its Moes numbers if the grid is registered.
    pub fn scale(&self, moes: Moes) -> f64 {
        match self.spec {
            GridSpec::Graded { registered: true, .. } => registration_scale(moes),
            _ => 1.0,
        }
    }

    /// Returns the grid of a contact.
    pub fn for_contact(self: &Arc<Self>, moes: Moes) -> LineGrid {
        self.scaled(self.scale(moes))
    }

    /// Returns the grid under the map with scale s.
    pub fn scaled(self: &Arc<Self>, scale: f64) -> LineGrid {
        let x: Vec<f64> = self.xi.iter().map(|xi| stretched(*xi, scale)).collect();
        let weights = self.weights.iter().map(|w| w * scale).collect();
        let rows = x.windows(4).map(|w| RowGeometry::new([w[0], w[1], w[2], w[3]])).collect();
        LineGrid { reference: Arc::clone(self), scale, x, weights, rows }
    }
}

impl LineGrid {
    /// Returns the length of node arrays: the nodes of the grid and the one outside.
    pub fn len(&self) -> usize {
        self.x.len()
    }

    /// Always returns `false`: every grid has at least 61 nodes.
    pub fn is_empty(&self) -> bool {
        self.x.is_empty()
    }

    /// Returns the number of unknown pressures.
    pub fn unknowns(&self) -> usize {
        self.x.len() - 3
    }

    /// Computes the deformation δ = K P at every node, (2.37). Both slices are node arrays.
    pub fn deform(&self, pressure: &[f64], deformation: &mut [f64], scratch: &mut Scratch) {
        self.reference.flexibility.apply(pressure, deformation, scratch);
        if self.scale != 1.0 {
            let shift = self.kernel_shift() * dot(&self.reference.weights, pressure);
            for d in deformation.iter_mut() {
                *d = self.scale * *d + shift;
            }
        }
    }

    /// Returns −s ln s / π. The map adds this constant times ∫P dξ to the deformation by the logarithmic kernel.
    pub fn kernel_shift(&self) -> f64 {
        if self.scale == 1.0 { 0.0 } else { -self.scale * self.scale.ln() / std::f64::consts::PI }
    }

    /// Returns one entry of K: the deformation at node `i` by unit pressure at node `j`.
    pub fn kernel_entry(&self, i: usize, j: usize) -> f64 {
        self.scale * self.reference.flexibility.entry(i, j) + self.kernel_shift() * self.reference.weights[j]
    }

    /// Returns the first index and the weights of the cubic (4-point Lagrange) interpolation at X. At a node, its
    /// weight is 1 and all others are 0.
    pub fn interpolation(&self, x: f64) -> (usize, [f64; 4]) {
        let (first, weights) = super::cubic(&self.x[INLET..], x);
        (first + INLET, weights)
    }

    /// Returns the value of a node array at X by cubic interpolation.
    pub fn at(&self, values: &[f64], x: f64) -> f64 {
        let (first, weights) = self.interpolation(x);
        weights.iter().zip(&values[first..]).map(|(w, v)| w * v).sum()
    }
}

/// Returns the cell sizes of the unknowns' nodes, zero elsewhere.
fn node_weights(xi: &[f64]) -> Vec<f64> {
    let n = xi.len();
    (0..n).map(|i| if (FIRST_UNKNOWN..n - 1).contains(&i) { 0.5 * (xi[i + 1] - xi[i - 1]) } else { 0.0 }).collect()
}

/// Returns the number of cells of a domain in the spacing of [`GridSpec::EXPLORER`].
pub(super) fn explorer_cells((from, to): (f64, f64)) -> usize {
    let count = |from: f64, to: f64| cells(from, to, FINE_SAMPLES);
    let share = count(from, to) / count(EXPLORER_INLET, EXPLORER_OUTLET);
    ((EXPLORER_NODES - 1) as f64 * share).round().max(0.0) as usize
}

/// Returns the desired relative spacing at ξ: fine at ±1, moderate inside, growing with the distance into the inlet.
fn wanted_spacing(xi: f64) -> f64 {
    let bump = |center: f64, depth: f64, width: f64| depth / (1.0 + ((xi - center) / width).powi(2));
    // The inlet of heavily loaded contacts determines the accuracy of H_c.
    let base =
        0.016 / (1.0 + bump(-1.02, 14.0, 0.04) + bump(-1.0, 2.0, 0.3) + bump(1.0, 3.0, 0.05) + bump(0.93, 1.0, 0.2));
    let inlet = (-1.15 - xi).max(0.0);
    let outlet = (xi - 1.25).max(0.0);
    base + 0.028 * inlet * inlet / (inlet + 0.5) + 0.03 * outlet
}

/// Number of samples for counting the cells of a whole grid.
const FINE_SAMPLES: usize = 20_000;

/// Returns ∫ dξ/spacing over a short interval by Simpson's rule: the number of cells in it, up to a factor.
fn cells_between(a: f64, b: f64) -> f64 {
    let middle = 0.5 * (a + b);
    (b - a) / 6.0 * (1.0 / wanted_spacing(a) + 4.0 / wanted_spacing(middle) + 1.0 / wanted_spacing(b))
}

/// Length beyond which a domain is counted in pieces. Equal samples would miss the contact.
const LONG: f64 = 1500.0;

/// Returns ∫ dξ/spacing over a whole domain in `samples` intervals, or that many in each piece of a long one.
fn cells(from: f64, to: f64, samples: usize) -> f64 {
    if to - from <= LONG {
        return cells_of_piece(from, to, samples);
    }
    // The spacing grows with the distance, and so do the pieces.
    let (mut low, mut high) = (from.max(-20.0), to.min(20.0));
    let mut sum = cells_of_piece(low, high, samples);
    while low > from {
        let next = (4.0 * low).max(from);
        sum += cells_of_piece(next, low, samples);
        low = next;
    }
    while high < to {
        let next = (4.0 * high).min(to);
        sum += cells_of_piece(high, next, samples);
        high = next;
    }
    sum
}

/// Returns the same integral in equal intervals.
fn cells_of_piece(from: f64, to: f64, samples: usize) -> f64 {
    let step = (to - from) / samples as f64;
    let at = |i: usize| from + i as f64 * step;
    (0..samples).map(|i| cells_between(at(i), at(i + 1))).sum()
}

/// Returns `nodes` abscissae, and the one outside, that equidistribute 1/spacing. One node lies exactly at ξ = 1,
/// where registration puts the spike. Thus grids of equal resolution share their nodes in the contact, whatever their
/// inlets. The ends move by half a cell at most.
fn graded_nodes(nodes: usize, from: f64, to: f64) -> Vec<f64> {
    // ∫ dξ/spacing on fine samples; all later steps are exact to rounding.
    let samples = 40 * nodes;
    let step = (to - from) / samples as f64;
    let at = |i: usize| from + i as f64 * step;
    let total = cells(from, to, samples);
    let before: f64 = if to - from > LONG {
        cells(from, 1.0, samples)
    } else {
        let whole = ((1.0 - from) / step).floor() as usize;
        (0..whole).map(|i| cells_between(at(i), at(i + 1))).sum::<f64>() + cells_between(at(whole), 1.0)
    };
    let per_node = total / (nodes - 1) as f64;
    // March from ξ = 1 in both directions. Each node solves cells_between(previous, node) = per_node by Newton's
    // method.
    let next = |x: f64, sign: f64| {
        let mut y = x + sign * per_node * wanted_spacing(x);
        for _ in 0..4 {
            y -= (cells_between(x, y) - sign * per_node) * wanted_spacing(y);
        }
        y
    };
    let upstream = ((before / per_node).round() as usize).clamp(2, nodes - 3);
    let mut x = vec![0.0; nodes + 1];
    let anchor = upstream + 1;
    x[anchor] = 1.0;
    for i in (0..anchor).rev() {
        x[i] = next(x[i + 1], -1.0);
    }
    for i in anchor + 1..=nodes {
        x[i] = next(x[i - 1], 1.0);
    }
    x
}

/// Ratio of the spacing to the distance from an end of the Hertzian zone, on a grid that follows a thin film.
const GROWTH: f64 = 0.06;
/// Distance from the end, in units of the zone, below which the spacing is constant.
const NEAREST: f64 = 1.5;

/// Returns the desired spacing at ξ for a film that closes in a zone of this length: that of [`wanted_spacing`], and
/// towards ξ = ±1 proportional to the distance.
fn following_spacing(zone: f64, xi: f64) -> f64 {
    let near = |end: f64| 1.0 / (GROWTH * (NEAREST * zone + (xi - end).abs()));
    1.0 / (1.0 / wanted_spacing(xi) + near(-1.0) + near(1.0))
}

/// Returns ∫ dξ/spacing over a short interval by Simpson's rule.
fn following_cells(zone: f64, a: f64, b: f64) -> f64 {
    let at = |xi: f64| 1.0 / following_spacing(zone, xi);
    (b - a) / 6.0 * (at(a) + 4.0 * at(0.5 * (a + b)) + at(b))
}

/// Returns the abscissae, and the one outside, that equidistribute 1/spacing. One of them lies at ξ = 1.
///
/// # Errors
/// If there would be too many nodes.
fn following_nodes(zone: f64, cell: f64, (from, to): (f64, f64)) -> Result<Vec<f64>, GridError> {
    let next = |x: f64, sign: f64| {
        let mut y = x + sign * cell * following_spacing(zone, x);
        for _ in 0..6 {
            y -= (following_cells(zone, x, y) - sign * cell) * following_spacing(zone, y);
        }
        y
    };
    let march = |end: f64, sign: f64| {
        let inside = move |x: &f64| sign * (x - end) < 0.0;
        std::iter::successors(Some(1.0), move |x| Some(next(*x, sign))).take_while(inside).take(MAX_GRADED_NODES)
    };
    let mut xi: Vec<f64> = march(from, -1.0).collect();
    // The inlet, and the node outside.
    for _ in 0..2 {
        xi.push(next(xi.last().copied().unwrap_or(1.0), -1.0));
    }
    xi.reverse();
    xi.extend(march(to, 1.0).skip(1));
    if xi.len() > MAX_GRADED_NODES {
        return Err(GridError::nodes(xi.len() as f64, MAX_GRADED_NODES));
    }
    Ok(xi)
}

/// Returns the scale s = (1 + X_s)/2 of the registration map, where X_s is the fitted position of the pressure spike.
pub fn registration_scale(moes: Moes) -> f64 {
    0.5 * (1.0 + spike_position(moes))
}

/// Returns the fitted position X_s of the pressure spike, in (0.2, 1).
///
/// ln((1 − X_s)/X_s) is a cubic in ln M plus a term that fades with L. It was fitted to the spikes of 75 full
/// solutions with M 2…500 and L 10…22 (Roelands, Dowson–Higginson, default realisation, ΔX = 0.0025, spike refined by
/// a parabola). The root-mean-square deviation is 0.015. Below L ≈ 12 the spike fades, and the fit continues smoothly
/// from its value there. Only smoothness matters: the map moves nodes and never changes the equations.
pub fn spike_position(Moes { m, l }: Moes) -> f64 {
    let x = m.clamp(1.5, 1000.0).ln();
    let effective_l = 12.0 + 2.0 * (0.5 * (l.min(40.0) - 12.0)).exp().ln_1p();
    let fade = (3.0 - 0.25 * effective_l).exp();
    let log_ratio = 1.8728 + x * (-2.3636 + x * (0.42316 - 0.03449 * x)) + fade * (0.79158 - 0.19788 * x);
    1.0 / (1.0 + log_ratio.exp())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_of_a_long_domain_are_counted_to_its_ends() {
        // Trapezoidal rule in the logarithm of the distance.
        let beyond = |end: f64| {
            let (n, from) = (100_000, 20.0f64);
            let step = (end.abs() / from).ln() / f64::from(n);
            let at = |k: i32| from * (step * f64::from(k)).exp();
            (0..n).map(|k| step * at(k) / wanted_spacing(end.signum() * at(k))).sum::<f64>()
        };
        let whole = cells_of_piece(-20.0, 20.0, 200_000) + beyond(-1e5) + beyond(1e4);
        assert!((cells(-1e5, 1e4, FINE_SAMPLES) / whole - 1.0).abs() < 1e-3, "{whole}");
        let grid = GridSpec::Graded { nodes: 1200, domain: (-1e5, 1e4), registered: false }.line().unwrap();
        assert!((grid.xi[INLET] / -1e5 - 1.0).abs() < 0.1, "{}", grid.xi[INLET]);
    }

    #[test]
    fn the_dissertations_grid_has_1201_nodes_with_both_ends() {
        let grid = GridSpec::DISSERTATION.line().unwrap().scaled(1.0);
        assert_eq!(grid.len() - 1, 1201);
        assert_eq!(grid.unknowns(), 1199);
        assert!((grid.x[INLET] + 4.0).abs() < 1e-12 && (grid.x[1201] - 2.0).abs() < 1e-12);
        assert!((grid.weights.iter().sum::<f64>() - 1199.0 * 0.005).abs() < 1e-12);
    }

    #[test]
    fn graded_nodes_are_smooth_and_fine_at_the_pressure_spike() {
        let grid = GridSpec::Graded { nodes: 720, domain: (-8.0, 1.9), registered: false }.line().unwrap();
        let xi = &grid.xi;
        let steps: Vec<f64> = xi.windows(2).map(|w| w[1] - w[0]).collect();
        assert!(steps.iter().all(|&h| h > 0.0));
        assert!(steps.windows(2).skip(1).all(|w| (w[1] / w[0] - 1.0).abs() < 0.12));
        let spacing_at = |x: f64| steps[xi.partition_point(|&v| v < x) - 1];
        assert!(spacing_at(1.0) < 0.35 * spacing_at(0.0) && spacing_at(-1.0) < 0.6 * spacing_at(0.0));
    }

    #[test]
    fn another_inlet_keeps_the_explorers_nodes_in_the_contact() {
        assert_eq!(GridSpec::explorer_from(-20.0, true), GridSpec::EXPLORER);
        let (long, short) = (GridSpec::EXPLORER.line().unwrap(), GridSpec::explorer_from(-10.0, true).line().unwrap());
        assert!(short.xi.len() < long.xi.len());
        let from_the_spike = |xi: &[f64]| {
            let spike = xi.iter().position(|&v| v == 1.0).unwrap();
            xi[spike - 300..spike + 50].to_vec()
        };
        let pairs = from_the_spike(&long.xi).into_iter().zip(from_the_spike(&short.xi));
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 5e-3));
    }

    #[test]
    fn interpolation_is_exact_for_cubics_and_at_nodes() {
        let grid = GridSpec::Graded { nodes: 300, domain: (-8.0, 1.9), registered: true }
            .line()
            .unwrap()
            .for_contact(Moes { m: 20.0, l: 8.0 });
        let cubic = |x: f64| 1.0 + x * (0.5 + x * (-0.3 + x * 0.1));
        let values: Vec<f64> = grid.x.iter().map(|&x| cubic(x)).collect();
        for x in [-0.4, 0.0, 0.77, grid.x[40], grid.x[INLET]] {
            assert!((grid.at(&values, x) - cubic(x)).abs() < 1e-11);
        }
    }

    #[test]
    fn bad_grids_are_refused_with_a_sentence() {
        for spec in [
            GridSpec::Uniform { dx: 0.005, domain: (-0.5, 2.0) },
            GridSpec::Uniform { dx: f64::NAN, domain: (-4.0, 2.0) },
            GridSpec::Uniform { dx: 0.0, domain: (-4.0, 2.0) },
            GridSpec::Uniform { dx: 1e-9, domain: (-4.0, 2.0) },
            GridSpec::Graded { nodes: 10, domain: (-8.0, 2.0), registered: true },
            GridSpec::Graded { nodes: 500, domain: (f64::NAN, 2.0), registered: true },
        ] {
            assert!(spec.line().is_err(), "{spec:?}");
        }
    }
}
