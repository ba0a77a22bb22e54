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
mod reach;

pub(super) use reach::support;
pub(crate) use reach::{cut_off, fronts, passed_rows};

use self::bending::{Bent, Kept};
use self::reach::{BEFORE, each_passed, passed};
use super::support::{StateRows, Support};
use crate::solver::discrete::grid::dot;
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::physics::contact::ContactKind;
use crate::solver::reduced::model::Window;
use crate::solver::reduced::sums::row_times;
use faer::linalg::matmul::matmul;
use faer::reborrow::ReborrowMut;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::ops::Range;

/// The pressure that counts as negative in (D.17), of a line and of a plane: smaller ones are what the basis leaves. Of
/// lines it leaves so little that B one node too far, with a pressure of −1e-4 there, is by far their largest error of
/// H_min.
const NEGATIVE: [f64; 2] = [-1e-6, -1e-4];
/// The same in time, and what is none worth the name: there the bases are of fewer contacts, and pressures behind the
/// contact that matter are smaller.
const LITTLE: f64 = 1e-5;
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
pub(super) struct Front {
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
    /// Of each line of nodes the further places on which rows behind B depend.
    near: Vec<Range<usize>>,
    kept: Vec<Kept>,
    /// Whether B may pass several nodes at once, and looks for negative pressures among all that it may pass.
    pub strides: bool,
    /// The pressure that counts as negative.
    negative: f64,
    /// How often B of a line may turn.
    turns: u8,
    /// Whether modes are held at zero behind B: in windows of many oils it lies at places far apart.
    restrains: bool,
    /// Σ v vᵀ over the nodes behind B, modes × modes, where they are.
    behind: Mat<f64>,
    /// Whether B is out of force: a penalty holds all pressures, as far as there are modes.
    idle: bool,
    /// Which of them is in the Jacobian.
    loaded: usize,
    /// Line and column of each sampled row.
    rows: Vec<(usize, usize)>,
    /// What the film at X = 0 (and Y = 0) gains per unit of each coefficient.
    pub lift: Vec<f64>,
    /// The scale it was found for: the nodes at X = 0 follow from it.
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
    /// Its row, of places in the support.
    stencil: [usize; STENCIL],
    geometry: RowGeometry,
    /// Whether a sampled row is its own.
    sampled: bool,
    /// Deformation at X = 0 (and Y = 0) by unit pressure here, in ξ.
    zero: f64,
}

/// What B did after a step.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Moved {
    /// It is where it was.
    Still,
    /// It passed nodes, but no sampled row began or ceased to be asked for.
    BetweenRows,
    /// It passed sampled rows: the derivatives of the former ones serve no more.
    PastRows,
}

/// What the boundary changes of the operators.
pub(super) struct Changed<'a> {
    pub load_row: &'a mut [f64],
    /// P at the support, then K P and the gradients.
    pub fields: &'a mut [f64],
}

impl Front {
    /// The boundary of a window, for operators over a support, with the modes and the whole K V there, row-major.
    pub fn new(window: &Window, support: &Support, (state, whole): (&StateRows, Vec<f64>), load_row: &[f64]) -> Self {
        let (grid, weights, modes) = (&window.grid, window.grid.weights(), load_row.len());
        let (mut nodes, mut owners): (Vec<Passed>, Vec<usize>) = (Vec::new(), Vec::new());
        each_passed(window, |line, unknown| {
            let (node, (stencil, geometry)) = (grid.node(unknown), grid.row(unknown));
            owners.push(line);
            let stencil = stencil.map(|node| support.place(node));
            nodes.push(Passed {
                place: support.place(node),
                node,
                weight: weights[node],
                stencil,
                geometry,
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
            modes: nodes.iter().flat_map(|p| state.values[p.place * modes..][..modes].iter().copied()).collect(),
            cut: vec![false; support.len()],
            own: support.own,
            asked: support.places[support.own..].iter().map(|place| place.node % support.across).collect(),
            near: vec![support.own..support.own; support.across],
            kept: Vec::new(),
            strides: false,
            negative: NEGATIVE[usize::from(plane)],
            turns: if plane && !state.gradients.is_empty() { TURNS_THINNING } else { TURNS },
            restrains: window.anchor.is_some(),
            behind: Mat::zeros(modes, modes),
            idle: false,
            loaded: 0,
            lift: vec![0.0; modes],
            aimed: None,
            passing: Vec::with_capacity(nodes.len()),
            bending: Vec::with_capacity(nodes.len()),
            bent: Bent::new(window.sampled_rows.len(), modes),
            lines,
            nodes,
        };
        front.keep(window, &whole, load_row);
        front
    }

    /// The first ruptured column of each line; where B is out of force, the first one behind the pressures.
    pub fn fronts<'a>(&'a self, pressure: &'a [f64]) -> impl Iterator<Item = usize> + 'a {
        self.lines.iter().map(move |line| {
            let carries = |k: &usize| !self.idle || pressure[self.nodes[line.first + k].place] > 0.0;
            line.column + (0..line.front).rfind(carries).map_or(0, |k| k + 1)
        })
    }

    /// Gives the row of node `k` that B may pass other coefficients and other nodes.
    pub fn set_row(&mut self, k: usize, stencil: [usize; STENCIL], geometry: RowGeometry) {
        (self.nodes[k].stencil, self.nodes[k].geometry) = (stencil, geometry);
    }

    /// Places in the support of the nodes that B may pass.
    pub fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.nodes.iter().map(|passed| passed.place)
    }

    /// Nodes behind B, and the pressures of the modes there.
    pub fn cut<'a>(&'a self, coefficients: &'a [f64]) -> impl Iterator<Item = (usize, f64)> + 'a {
        let modes = self.lift.len();
        let behind = self.lines.iter().flat_map(|line| line.first + line.front..line.first + line.count);
        behind.map(move |k| (self.nodes[k].node, dot(&self.modes[k * modes..][..modes], coefficients)))
    }

    /// Whether a sampled row lies behind B.
    pub fn is_ruptured(&self, row: usize) -> bool {
        let (line, column) = self.rows[row];
        let line = &self.lines[line];
        !self.idle && column >= line.column + line.front
    }

    /// Whether B ruptures the film, and no penalty does.
    pub fn in_force(&self) -> bool {
        !self.idle
    }

    /// Puts B somewhere before an iteration begins; without a place it is behind all modes, and out of force.
    pub fn begin(&mut self, fronts: Option<&[usize]>, load_row: &mut [f64]) {
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
        self.loaded = (0..self.kept.len()).min_by_key(|k| far(&self.kept[*k])).unwrap_or(0);
        let nearest = &self.kept[self.loaded];
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
        self.look_near();
    }

    /// Adds to the equations, by a factor, that modes are zero behind B: of modes that differ there alone nothing else
    /// tells the coefficients, and Newton's steps would go astray. Solutions are zero there, so that this changes them by
    /// no more than the basis misses.
    pub fn restrain(&mut self, factor: f64, mut matrix: MatMut<'_, f64>) {
        if self.idle || !self.restrains {
            return;
        }
        let Self { lines, modes: basis, behind, .. } = self;
        let modes = matrix.ncols();
        for line in lines.iter_mut().filter(|line| line.front != line.restrained) {
            let sign = if line.front < line.restrained { 1.0 } else { -1.0 };
            let (from, to) = (line.front.min(line.restrained), line.front.max(line.restrained));
            let own = &basis[(line.first + from) * modes..(line.first + to) * modes];
            let passed = MatRef::from_row_major_slice(own, to - from, modes);
            matmul(behind.as_mut(), Accum::Add, passed.transpose(), passed, sign, Par::Seq);
            line.restrained = line.front;
        }
        for (column, own) in matrix.rb_mut().col_iter_mut().zip(behind.col_iter()) {
            column.iter_mut().zip(own.iter()).for_each(|(entry, own)| *entry += factor * own);
        }
    }

    /// What [`Self::restrain`] adds to the right-hand side.
    pub fn pull(&self, factor: f64, coefficients: &[f64], rhs: &mut [f64]) {
        if self.idle || !self.restrains {
            return;
        }
        for (own, coefficient) in self.behind.col_iter().zip(coefficients) {
            let value = factor * coefficient;
            rhs.iter_mut().zip(own.iter()).for_each(|(rhs, own)| *rhs -= value * own);
        }
    }

    /// Lets B follow a step: `nodes` are those before it, `state` the modes at the support, `step` what it added to the
    /// fields, by the factor `omega`, and `shift` to H₀; `changed` has the fields behind it. What gradients add to λ is
    /// left out: where P ends they are small, and when steps are, λ is that of the rows.
    pub fn follow(
        &mut self,
        (nodes, state): (&Nodes, &StateRows),
        (scale, omega): (f64, f64),
        (step, shift): (&[f64], f64),
        coefficients: &[f64],
        changed: Changed<'_>,
    ) -> Moved {
        if self.idle {
            return Moved::Still;
        }
        let Changed { load_row, fields } = changed;
        let s = self.cut.len();
        let turns = if self.strides { TURNS } else { self.turns };
        self.passing.clear();
        for line in &mut self.lines {
            if line.turns >= turns {
                continue;
            }
            let at = |k: usize| &self.nodes[line.first + k];
            let (stride, first, end) = if self.strides {
                // Behind the last pressure worth the name there may be no modes that B could see become negative.
                let little = |k: &usize| fields[at(*k).place].abs() < LITTLE;
                (line.stride, 1, line.front - (1..line.front).rev().take_while(little).count())
            } else {
                (1, line.front.saturating_sub(BEFORE), line.front)
            };
            let least = if self.strides { -LITTLE } else { self.negative };
            let pressure = |k: usize| {
                let looked_at = self.strides || at(k).place < self.own;
                if looked_at { fields[at(k).place] } else { row_times(&self.modes, line.first + k, coefficients) }
            };
            let negative = (first..end).find(|&k| pressure(k) < least).filter(|_| line.front > 1);
            // (D.16): λ after the step.
            let multiplier = |k: usize| {
                let boundary = at(k);
                let row = nodes.row(&boundary.geometry.scaled(scale), 0.0, boundary.stencil);
                let change = boundary
                    .stencil
                    .iter()
                    .zip(row.d_p)
                    .zip(row.d_h)
                    .map(|((&node, a), b)| a * step[node] + b * (scale * step[s + node] + shift));
                -(row.value + omega * change.sum::<f64>())
            };
            let front = match negative {
                Some(first) => first.max(end.saturating_sub(stride)),
                None => {
                    // More flows in at these nodes than the gap takes: the liquid fills them.
                    let mut inflow = 0.0;
                    let filled = |&k: &usize| {
                        inflow += at(k).weight * multiplier(k);
                        inflow < 0.0
                    };
                    line.front + (line.front..line.count.min(line.front + stride)).take_while(filled).count()
                }
            };
            if front == line.front {
                continue;
            }
            let down = front > line.front;
            let turned = line.down.is_some_and(|was| was != down);
            line.turns += u8::from(turned);
            line.stride = if turned { (line.stride / 4).max(1) } else { 2 * line.stride };
            line.down = Some(down);
            let passing = line.front.min(front)..line.front.max(front);
            self.passing.extend(passing.map(|k| (line.first + k, down)));
            line.front = front;
        }
        if self.passing.is_empty() {
            return Moved::Still;
        }
        let modes = load_row.len();
        let (pressure, rest) = fields.split_at_mut(s);
        let deformation = &mut rest[..s];
        for &(k, carries) in &self.passing {
            let (passed, own) = (&self.nodes[k], &self.modes[k * modes..][..modes]);
            let (value, sign) = (dot(own, coefficients), if carries { 1.0 } else { -1.0 });
            pressure[passed.place] = if carries { value } else { 0.0 };
            self.cut[passed.place] = !carries;
            let bends = &self.bends[k * s..][..self.own];
            deformation.iter_mut().zip(bends).for_each(|(out, bend)| *out += sign * value * f64::from(*bend));
            for ((lift, load), v) in self.lift.iter_mut().zip(&mut *load_row).zip(own) {
                *lift += sign * passed.zero * v;
                *load += sign * passed.weight * v;
            }
        }
        self.look_near();
        self.find_bending(coefficients);
        self.spread_near(state, coefficients, fields);
        if self.passing.iter().any(|(k, _)| self.nodes[*k].sampled) { Moved::PastRows } else { Moved::BetweenRows }
    }
}

impl Line {
    /// How many of the nodes that B may pass carry pressure where it has this column.
    fn place_of(&self, front: usize) -> usize {
        front.saturating_sub(self.column).clamp(1, self.count.max(1))
    }
}
