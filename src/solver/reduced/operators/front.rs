//! Cavitation boundary B of reduced contacts with complementarity, (D.14)–(D.22). Behind it P = 0 and no row is
//! required; in front of it the multiplier λ is 0.
//!
//! A state is the sum of the modes, cut off at B. If B moves, single nodes are added to or removed from V, the load
//! row, P and K P, (D.21) and (D.22), so nothing is of large scale. K V of the Jacobian stays that of a nearby
//! position of B. The deformation by the few nodes in between is included in the fields; its derivative is too small
//! to slow Newton's method. Only nodes near B are evaluated.
//!
//! B moves up along a line if one of the nodes in front of it has a negative pressure, (D.17), otherwise down if λ is
//! negative at its first cavitated node. (D.18) as printed has the opposite sign, with which B would oscillate.

mod bending;
mod following;
pub(super) mod reach;

pub(crate) use reach::{cut_off, fronts, passed_rows};

use self::bending::{Bent, StoredFront};
use self::reach::{each_passed, passed};
use super::case::{Case, Start, State};
use super::part::{Centre, Flow, Kind, Moved, Part, Setting, Step};
use super::readings::Readings;
use super::sampled_system::SampledSystem;
use crate::solver::discrete::grid::dot;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::model::Window;
use faer::linalg::matmul::matmul;
use faer::reborrow::ReborrowMut;
use faer::{Accum, Mat, MatMut, MatRef, Par};

/// Part of the operators of local models with complementarity.
pub(super) const KIND: Kind = Kind {
    nodes: |window, flow, nodes| {
        if window.cavitation == Cavitation::Complementarity && flow != Flow::Rough {
            each_passed(window, |_, unknown| nodes.at_times.extend(window.grid.row(unknown).0));
        }
    },
    make: |Setting { window, flow, .. }, system| {
        let cavitates = window.cavitation == Cavitation::Complementarity && flow != Flow::Rough;
        cavitates.then(|| -> Box<dyn Part> { Box::new(Front::new(window, system)) })
    },
};

/// Factor by which modes are restrained to zero behind the cavitation boundary, relative to the size of the equations.
const RESTRAINED: f64 = 1e-6;

/// Pressure that counts as negative in (D.17), for a line and for a plane. Smaller negative pressures are errors of
/// the basis. For lines these are small: a boundary one node too far, with a pressure of −1e-4 there, is by far their
/// largest error of the minimum film thickness.
const NEGATIVE: [f64; 2] = [-1e-6, -1e-4];
/// Number of direction changes after which B of a line stays where it is: its position is then known to one node.
const TURNS: u8 = 4;
/// The same for planes with shear-thinning lubricants. In half of these contacts B of one or two lines would
/// oscillate, because the bases have larger errors behind B. Stopping at the first change hardly affects the result
/// (H_c by 1e-4 at most in 95 of 100 contacts, less than the model error) and halves the number of steps. For
/// Newtonian contacts it saves few steps and causes larger errors.
const TURNS_THINNING: u8 = 1;
/// Initial number of nodes that B may pass at once in a transient contact.
const STRIDE: usize = 4;

/// Boundary with the quantities that it changes.
struct Front {
    lines: Vec<Line>,
    /// Nodes that it may pass, line by line.
    nodes: Vec<Passed>,
    /// V at these nodes, row-major nodes × modes.
    modes: Vec<f64>,
    /// Deformation of the support by unit pressure at each of these nodes, row-major nodes × support. It is
    /// multiplied by small pressures only.
    bends: Vec<f32>,
    /// True for the places of the support behind B.
    cut: Vec<bool>,
    /// Number of places of the support that the sampled equations use; and the line of each further place.
    own: usize,
    asked: Vec<usize>,
    kept: Vec<StoredFront>,
    /// Pressure that counts as negative.
    negative: f64,
    /// Maximum number of direction changes of B per line.
    turns: u8,
    /// Whether modes are restrained to zero behind B, as in local models around anchors, where the positions of B
    /// differ widely. And the factor of the restraint in the last matrix.
    restrains: bool,
    restraint: f64,
    /// Σ v vᵀ over the nodes behind B, modes × modes, if modes are restrained.
    behind: Mat<f64>,
    /// True if B is inactive: a penalty acts on all pressures, as far as there are modes.
    idle: bool,
    /// True if B stays where it is.
    held: bool,
    /// Index of the stored K V in the Jacobian.
    loaded: usize,
    /// Line and column of each sampled equation.
    rows: Vec<(usize, usize)>,
    /// Scale for which the deformations at X = 0 are computed.
    aimed: Option<f64>,
    /// Work space: nodes that are passed, and whether they carry pressure afterwards.
    passing: Vec<(usize, bool)>,
    /// Work space: nodes between B and its position in K V, and the pressures there that K V does not include.
    bending: Vec<(usize, f64)>,
    bent: Bent,
}

/// Line of unknowns along X with its part of B.
struct Line {
    /// First column that B may have, its index among the nodes, and the number of nodes that it may pass.
    column: usize,
    first: usize,
    count: usize,
    /// Number of these nodes that carry pressure; the next one is B.
    front: usize,
    /// Number of these nodes that carry pressure in K V.
    kept: usize,
    /// Number of these nodes in front of the restrained ones.
    restrained: usize,
    /// Last direction of B, and number of direction changes.
    down: Option<bool>,
    turns: u8,
    /// Number of nodes that B may pass at once.
    stride: usize,
}

/// Node that B may pass.
struct Passed {
    /// Place in the support.
    place: usize,
    node: usize,
    /// Weight in the load.
    weight: f64,
    /// True if a sampled equation belongs to it.
    sampled: bool,
    /// Deformation at X = 0 (and Y = 0) by unit pressure at this node, in ξ.
    zero: f64,
}

impl Front {
    /// Creates the boundary of a local model over its rows, and adds the rows that it may pass.
    fn new(window: &Window, system: &mut SampledSystem) -> Self {
        let (grid, weights, modes) = (&window.grid, window.grid.weights(), system.modes);
        let SampledSystem { support, stencils, geometry, basis, .. } = system;
        let (mut nodes, mut owners): (Vec<Passed>, Vec<usize>) = (Vec::new(), Vec::new());
        each_passed(window, |line, unknown| {
            let (node, (stencil, coefficients)) = (grid.node(unknown), grid.row(unknown));
            owners.push(line);
            stencils.push(stencil.map(|node| support.place(node)));
            geometry.push(coefficients);
            nodes.push(Passed {
                place: support.place(node),
                node,
                weight: weights[node],
                sampled: window.sampled_rows.contains(&unknown),
                zero: 0.0,
            });
        });
        let line = |(line, (column, highest)): (usize, (usize, usize))| {
            let first = owners.partition_point(|&owner| owner < line);
            // The last node is never passed. Its row shows whether B must move beyond the range of the training.
            let count = highest - column;
            Line {
                column,
                first,
                count,
                front: count,
                kept: count,
                restrained: count,
                down: None,
                turns: 0,
                stride: STRIDE,
            }
        };
        let lines: Vec<Line> = passed(window).into_iter().enumerate().map(line).collect();
        let passed: Vec<usize> = nodes.iter().map(|passed| passed.node).collect();
        let plane = grid.kind().is_point();
        let mut front = Self {
            rows: window.sampled_rows.iter().map(|&row| grid.line_and_column(grid.node(row))).collect(),
            bends: grid.kernel_columns(&support.nodes(), &passed),
            modes: nodes.iter().flat_map(|p| basis.values[p.place * modes..][..modes].iter().copied()).collect(),
            cut: vec![false; support.len()],
            own: support.own,
            asked: support.places[support.own..].iter().map(|place| place.node % support.across).collect(),
            kept: Vec::new(),
            negative: NEGATIVE[usize::from(plane)],
            turns: if plane && !basis.gradients.is_empty() { TURNS_THINNING } else { TURNS },
            restrains: window.anchor.is_some(),
            restraint: 0.0,
            behind: Mat::zeros(modes, modes),
            idle: false,
            held: false,
            loaded: 0,
            aimed: None,
            passing: Vec::with_capacity(nodes.len()),
            bending: Vec::with_capacity(nodes.len()),
            bent: Bent::new(window.sampled_rows.len(), modes),
            lines,
            nodes,
        };
        system.seen.resize(1 + support.across, support.own..support.own);
        let whole = std::mem::take(&mut basis.deformations);
        front.keep(window, &whole, &system.load_row);
        std::mem::swap(&mut basis.deformations, &mut front.kept[0].deformation);
        front
    }

    /// Returns the first cavitated column of each line; for an inactive B, the first column behind the pressures.
    pub fn fronts<'a>(&'a self, pressure: &'a [f64]) -> impl Iterator<Item = usize> + 'a {
        self.lines.iter().map(move |line| {
            let carries = |k: &usize| !self.idle || pressure[self.nodes[line.first + k].place] > 0.0;
            line.column + (0..line.front).rfind(carries).map_or(0, |k| k + 1)
        })
    }

    /// Returns the nodes behind B, and the pressures of the modes there.
    pub fn cut<'a>(&'a self, coefficients: &'a [f64]) -> impl Iterator<Item = (usize, f64)> + 'a {
        let modes = coefficients.len();
        let behind = self.lines.iter().flat_map(|line| line.first + line.front..line.first + line.count);
        behind.map(move |k| (self.nodes[k].node, dot(&self.modes[k * modes..][..modes], coefficients)))
    }

    /// Sets the position of B before an iteration. Without positions B is behind all modes and inactive.
    fn put(&mut self, system: &mut SampledSystem, fronts: Option<&[usize]>) {
        self.idle = fronts.is_none();
        for (number, line) in self.lines.iter_mut().enumerate() {
            let place = fronts.map_or(Some(line.count), |fronts| fronts.get(number).map(|front| line.place_of(*front)));
            (line.front, line.down, line.turns, line.stride) = (place.unwrap_or(line.front), None, 0, STRIDE);
            for (k, passed) in self.nodes[line.first..line.first + line.count].iter().enumerate() {
                self.cut[passed.place] = k >= line.front;
            }
        }
        let apart = |line: (&Line, &usize)| line.0.front.abs_diff(*line.1);
        let far = |kept: &StoredFront| self.lines.iter().zip(&kept.fronts).map(apart).sum::<usize>();
        let loaded = (0..self.kept.len()).min_by_key(|k| far(&self.kept[*k])).unwrap_or(0);
        let in_use = &mut system.basis.deformations;
        std::mem::swap(in_use, &mut self.kept[self.loaded].deformation);
        std::mem::swap(in_use, &mut self.kept[loaded].deformation);
        self.loaded = loaded;
        let (nearest, load_row) = (&self.kept[loaded], &mut system.load_row);
        for (line, kept) in self.lines.iter_mut().zip(&nearest.fronts) {
            (line.kept, line.restrained) = (*kept, *kept);
        }
        load_row.copy_from_slice(&nearest.load);
        self.behind.copy_from(&nearest.behind);
        let modes = load_row.len();
        for (k, sign) in self.between() {
            let (own, weight) = (&self.modes[k * modes..][..modes], sign * self.nodes[k].weight);
            load_row.iter_mut().zip(own).for_each(|(load, v)| *load += weight * v);
        }
        self.look_near(system);
    }

    /// Adds the squares of the modes behind B to a matrix.
    fn restrain(&mut self, mut matrix: MatMut<'_, f64>) {
        let modes = matrix.ncols();
        let size = (0..modes).map(|k| matrix[(k, k)]).sum::<f64>() / modes as f64;
        self.restraint = RESTRAINED * size;
        let Self { lines, modes: basis, behind, restraint, .. } = self;
        for line in lines.iter_mut().filter(|line| line.front != line.restrained) {
            let sign = if line.front < line.restrained { 1.0 } else { -1.0 };
            let (from, to) = (line.front.min(line.restrained), line.front.max(line.restrained));
            let own = &basis[(line.first + from) * modes..(line.first + to) * modes];
            let passed = MatRef::from_row_major_slice(own, to - from, modes);
            matmul(behind.as_mut(), Accum::Add, passed.transpose(), passed, sign, Par::Seq);
            line.restrained = line.front;
        }
        for (column, own) in matrix.rb_mut().col_iter_mut().zip(behind.col_iter()) {
            column.iter_mut().zip(own.iter()).for_each(|(entry, own)| *entry += *restraint * own);
        }
    }
}

impl Part for Front {
    fn begin(&mut self, system: &mut SampledSystem, _: &Case<'_>, start: &Start<'_>) {
        self.put(system, start.fronts);
        self.held = start.held;
    }

    fn aim(&mut self, system: &mut SampledSystem, at: Centre<'_>) {
        self.lift(&mut system.lift, at);
    }

    fn spread(&mut self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        self.cut_and_bend(system, coefficients, fields);
    }

    /// Sets derivatives by P to zero behind the boundary, where modes are not part of P.
    fn slopes(&mut self, system: &mut SampledSystem) {
        for (slopes, stencil) in system.by_pressure.iter_mut().zip(&system.stencils) {
            for (slope, place) in slopes.iter_mut().zip(stencil) {
                if self.cut[*place] {
                    *slope = 0.0;
                }
            }
        }
    }

    fn jacobian(&mut self, system: &mut SampledSystem, scale: f64, exact: bool) {
        self.bend(system, scale, exact);
    }

    /// Restrains the modes to zero behind B. The coefficients of modes that differ only there would otherwise be
    /// undetermined, and Newton's method would diverge. Solutions are zero there, so that the restraint changes them
    /// by no more than the error of the basis.
    fn equations(&mut self, coefficients: &[f64], matrix: Option<MatMut<'_, f64>>, rhs: &mut [f64]) {
        if self.idle || !self.restrains {
            return;
        }
        if let Some(matrix) = matrix {
            self.restrain(matrix);
        }
        for (own, coefficient) in self.behind.col_iter().zip(coefficients) {
            let value = self.restraint * coefficient;
            rhs.iter_mut().zip(own.iter()).for_each(|(rhs, own)| *rhs -= value * own);
        }
    }

    fn settle(
        &mut self,
        system: &mut SampledSystem,
        case: &Case<'_>,
        step: Step,
        (coefficients, _): (&mut [f64], &mut f64),
    ) -> Moved {
        self.follow(system, (case.scale, step.omega), coefficients)
    }

    fn read(&mut self, system: &SampledSystem, _: &Case<'_>, state: State<'_>, readings: &mut Readings) {
        readings.fronts.extend(self.fronts(&system.fields));
        readings.cut.extend(self.cut(state.coefficients));
    }
}

impl Line {
    /// Returns the number of nodes that carry pressure if B has the column `front`.
    fn place_of(&self, front: usize) -> usize {
        front.saturating_sub(self.column).clamp(1, self.count.max(1))
    }
}
