//! The rupture boundary B of reduced contacts under complementarity, (D.14)–(D.22): behind it P = 0 and no row is asked
//! for, before it λ = 0.
//!
//! A state is the sum of the modes, cut off at B. V, the load's row, P and K P change by single nodes when B moves,
//! (D.21) and (D.22), so nothing is of large scale. K V of the Jacobian stays that of a place of B nearby: what the few
//! nodes between bend is in the fields, and its derivative is too small to slow Newton's method. Of the nodes that B may
//! pass only those near it are looked at.
//!
//! B moves up along a line where one of the nodes before it has a negative pressure, (D.17), else down where λ is
//! negative at its first ruptured node. (D.18) as printed has the opposite sign: B would go back and forth.

mod bending;
mod following;
mod reach;

pub(crate) use reach::{cut_off, fronts, passed_rows};

use self::bending::{Bent, Kept};
use self::reach::{each_passed, passed};
use super::case::{Case, Start, State};
use super::part::{Centre, Kind, Moved, Part, Setting, Step};
use super::readings::Readings;
use super::sampled_system::SampledSystem;
use crate::solver::discrete::grid::dot;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::model::Window;
use faer::linalg::matmul::matmul;
use faer::reborrow::ReborrowMut;
use faer::{Accum, Mat, MatMut, MatRef, Par};

/// Operators of a window with complementarity have it.
pub(super) const KIND: Kind = Kind {
    nodes: |window, _, nodes| {
        if window.cavitation == Cavitation::Complementarity {
            each_passed(window, |_, unknown| nodes.at_times.extend(window.grid.row(unknown).0));
        }
    },
    make: |Setting { window, .. }, system| {
        let cavitates = window.cavitation == Cavitation::Complementarity;
        cavitates.then(|| -> Box<dyn Part> { Box::new(Front::new(window, system)) })
    },
};

/// How much modes are held at zero behind the cavitation boundary, relative to the equations' own size.
const RESTRAINED: f64 = 1e-6;

/// The pressure that counts as negative in (D.17), of a line and of a plane: smaller ones are what the basis leaves. Of
/// lines it leaves so little that B one node too far, with a pressure of −1e-4 there, is by far their largest error of
/// H_min.
const NEGATIVE: [f64; 2] = [-1e-6, -1e-4];
/// So many turns between up and down leave B of a line where it is: its place is known to one node.
const TURNS: u8 = 4;
/// The same of planes of thinning lubricants. Half of their contacts have a line or two whose B would go to and fro: bases
/// of more numbers leave more behind it. Left where it turns first, one node of one line changes little there (1e-4 of H_c
/// at most in 95 of 100, and less than models are off by), and most of these contacts take half as many steps. Newtonian
/// ones would save one in thirty, and a few of their films would be off by a hundredth.
const TURNS_THINNING: u8 = 1;
/// Nodes that B may pass at once where it strides, at first.
const STRIDE: usize = 4;

/// The boundary, with what it changes.
struct Front {
    lines: Vec<Line>,
    /// The nodes that it may pass, line after line.
    nodes: Vec<Passed>,
    /// V at these nodes, row-major nodes × modes.
    modes: Vec<f64>,
    /// Deformation of the support by unit pressure at each of these nodes, row-major nodes × support. It is multiplied by
    /// small pressures only.
    bends: Vec<f32>,
    /// Which places of the support lie behind B.
    cut: Vec<bool>,
    /// How many places of the support the sampled rows ask for themselves, and of each further one the line of nodes.
    own: usize,
    asked: Vec<usize>,
    kept: Vec<Kept>,
    /// The pressure that counts as negative.
    negative: f64,
    /// How often B of a line may turn.
    turns: u8,
    /// Whether modes are held at zero behind B: in windows of many oils it lies at places far apart. By how much they are
    /// in the matrix solved last.
    restrains: bool,
    restraint: f64,
    /// Σ v vᵀ over the nodes behind B, modes × modes, where they are.
    behind: Mat<f64>,
    /// Whether B is out of force: a penalty holds all pressures, as far as there are modes.
    idle: bool,
    /// Which of them is in the Jacobian.
    loaded: usize,
    /// Line and column of each sampled row.
    rows: Vec<(usize, usize)>,
    /// The scale at which deformations at X = 0 are known.
    aimed: Option<f64>,
    /// Work space: nodes that pass, and whether they carry pressure again.
    passing: Vec<(usize, bool)>,
    /// Work space: nodes between B and its place in K V, and the pressures there that K V does not know.
    bending: Vec<(usize, f64)>,
    bent: Bent,
}

/// A line of unknowns along X with its part of B.
struct Line {
    /// The first column that B may have, its place among the nodes, and how many it may pass.
    column: usize,
    first: usize,
    count: usize,
    /// How many of them carry pressure: the next one is B.
    front: usize,
    /// How many do in K V.
    kept: usize,
    /// How many lie before those that are held at zero.
    restrained: usize,
    /// Which way B moved last, and how often it turned.
    down: Option<bool>,
    turns: u8,
    /// How many nodes it may pass at once.
    stride: usize,
}

/// A node that B may pass.
struct Passed {
    /// Its place in the support.
    place: usize,
    node: usize,
    /// Its weight in the load.
    weight: f64,
    /// Whether a sampled row is its own.
    sampled: bool,
    /// Deformation at X = 0 (and Y = 0) by unit pressure here, in ξ.
    zero: f64,
}

impl Front {
    /// The boundary of a window over its rows; adds to them those that it may pass.
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
            // The last one is never passed: its row says whether B must move on to where no training has been.
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
        let plane = grid.kind() == ContactKind::Point;
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

    /// The first ruptured column of each line; where B is out of force, the first one behind the pressures.
    pub fn fronts<'a>(&'a self, pressure: &'a [f64]) -> impl Iterator<Item = usize> + 'a {
        self.lines.iter().map(move |line| {
            let carries = |k: &usize| !self.idle || pressure[self.nodes[line.first + k].place] > 0.0;
            line.column + (0..line.front).rfind(carries).map_or(0, |k| k + 1)
        })
    }

    /// Nodes behind B, and the pressures of the modes there.
    pub fn cut<'a>(&'a self, coefficients: &'a [f64]) -> impl Iterator<Item = (usize, f64)> + 'a {
        let modes = coefficients.len();
        let behind = self.lines.iter().flat_map(|line| line.first + line.front..line.first + line.count);
        behind.map(move |k| (self.nodes[k].node, dot(&self.modes[k * modes..][..modes], coefficients)))
    }

    /// Puts B somewhere before an iteration begins; without a place it is behind all modes, and out of force.
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
        let far = |kept: &Kept| self.lines.iter().zip(&kept.fronts).map(apart).sum::<usize>();
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
    }

    fn aim(&mut self, system: &mut SampledSystem, at: Centre<'_>) {
        self.lift(&mut system.lift, at);
    }

    fn spread(&mut self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        self.cut_and_bend(system, coefficients, fields);
    }

    /// Behind the boundary modes are no part of P.
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

    /// Adds, by a factor, that modes are zero behind B: of modes that differ there alone nothing else tells the
    /// coefficients, and Newton's steps would go astray. Solutions are zero there, so that this changes them by no more than
    /// the basis misses.
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
    /// How many of the nodes that B may pass carry pressure where it has this column.
    fn place_of(&self, front: usize) -> usize {
        front.saturating_sub(self.column).clamp(1, self.count.max(1))
    }
}
