//! The rupture boundary B of reduced contacts under complementarity, (D.14)–(D.22): behind it P = 0 and no row is asked
//! for, before it λ = 0.
//!
//! A state is the sum of the modes, cut off at B. V, the load's row, P and K P change by single nodes when B moves,
//! (D.21) and (D.22), so nothing is of large scale. K V of the Jacobian stays that of a place of B nearby: what the few
//! nodes between bend is in the fields, and its derivative is too small to slow Newton's method.
//!
//! B moves up along a line where one of the nodes before it has a negative pressure, (D.17), else down where λ is
//! negative at its first ruptured node. (D.18) as printed has the opposite sign: B would go back and forth.

use crate::solver::discrete::grid::{ContactGrid, dot};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::model::{Snapshot, Window};
use faer::linalg::matmul::matmul;
use faer::reborrow::ReborrowMut;
use faer::{Accum, Mat, MatMut, MatRef, Par};

/// Nodes before B at which pressures are looked at: k of (D.17).
const BEFORE: usize = 5;
/// The pressure that counts as negative in (D.17): smaller ones are what the basis leaves.
const NEGATIVE: f64 = -1e-4;
/// The same in time, and what is none worth the name: there the bases are of fewer contacts, and pressures behind the
/// contact that matter are smaller.
const LITTLE: f64 = 1e-5;
/// Nodes that B may move beyond where it was in any of the trainings.
const MARGIN: usize = 4;
/// So many turns between up and down leave B of a line where it is: its place is known to one node.
const TURNS: u8 = 4;
/// Nodes that B may pass at once where it strides, at first.
const STRIDE: usize = 4;
/// Places of B at which K V is kept: a solve takes the nearest of them. As many as these, and as take this many bytes.
const KEPT: usize = 8;
const KEPT_BYTES: usize = 16 << 20;

/// The boundary, with what it changes.
pub(super) struct Front {
    lines: Vec<Line>,
    /// The nodes that it may pass, line after line.
    nodes: Vec<Passed>,
    /// V at these nodes, row-major nodes × modes.
    modes: Vec<f64>,
    /// Deformation of the support by unit pressure at each of these nodes, row-major nodes × support.
    bends: Vec<f64>,
    kept: Vec<Kept>,
    /// Whether B may pass several nodes at once, and looks for negative pressures among all that it may pass.
    pub strides: bool,
    /// Whether modes are held at zero behind B: in windows of many oils it lies at places far apart.
    restrains: bool,
    /// Σ v vᵀ over the nodes behind B, modes × modes, where they are.
    behind: Mat<f64>,
    /// Whether B is out of force: a penalty holds all pressures, as far as there are modes.
    idle: bool,
    /// Which of them is in the Jacobian.
    loaded: Option<usize>,
    /// wᵀ V without a boundary.
    whole_load: Vec<f64>,
    /// Line and column of each sampled row.
    rows: Vec<(usize, usize)>,
    /// What the film at X = 0 (and Y = 0) gains per unit of each coefficient.
    pub lift: Vec<f64>,
    /// The scale it was found for: the nodes at X = 0 follow from it.
    aimed: Option<f64>,
    /// Work space: nodes that pass, and whether they carry pressure again.
    passing: Vec<(usize, bool)>,
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
    /// Deformation at X = 0 (and Y = 0) by unit pressure here, in ξ.
    zero: f64,
}

/// K V at one place of B.
struct Kept {
    /// Of each line how many nodes carry pressure.
    fronts: Vec<usize>,
    deformation: Vec<f64>,
    /// Σ v vᵀ over the nodes behind it, where modes are held at zero there.
    behind: Mat<f64>,
}

/// What the boundary changes of the operators.
pub(super) struct Changed<'a> {
    /// V at the support, then K V, row-major.
    pub state_rows: &'a mut [f64],
    pub load_row: &'a mut [f64],
    /// P at the support, then K P.
    pub fields: &'a mut [f64],
}

/// Of each line along X the first column of a node array behind which no pressure is positive.
pub(crate) fn fronts(grid: &ContactGrid, pressure: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut fronts = vec![0; grid.lines()];
    for node in (0..grid.unknowns()).map(|k| grid.node(k)) {
        let (line, column) = grid.line_and_column(node);
        if fronts[line] == 0 || pressure(node) > 0.0 {
            fronts[line] = column + 1;
        }
    }
    fronts
}

/// Sets pressures behind B to zero.
pub(crate) fn cut_off(grid: &ContactGrid, fronts: &[usize], pressure: &mut [f64]) {
    for node in (0..grid.unknowns()).map(|k| grid.node(k)) {
        let (line, column) = grid.line_and_column(node);
        if column >= fronts[line] {
            pressure[node] = 0.0;
        }
    }
}

/// The nodes that B may pass, line after line, as ranges of columns.
fn passed(window: &Window) -> Vec<(usize, usize)> {
    let grid = &window.grid;
    let last = (0..grid.unknowns()).map(|k| grid.line_and_column(grid.node(k)).1).max().unwrap_or(0);
    let first = grid.line_and_column(grid.node(0)).1;
    let of_line = |line: usize| {
        let own = || window.snapshots.iter().filter_map(move |snapshot| snapshot.fronts.get(line).copied());
        let lowest = own().min().unwrap_or(last).saturating_sub(BEFORE + MARGIN).max(first);
        let highest = (own().max().unwrap_or(last) + 1).min(last);
        (lowest, highest.max(lowest))
    };
    (0..grid.lines()).map(of_line).collect()
}

/// The rows, as unknowns, that the boundary may pass, line after line; none where a penalty holds the pressures.
pub(crate) fn passed_rows(window: &Window) -> Vec<usize> {
    let mut rows = Vec::new();
    if window.cavitation == Cavitation::Complementarity {
        each_passed(window, |_, unknown| rows.push(unknown));
    }
    rows
}

/// Nodes of the support that the boundary asks for.
pub(super) fn support(window: &Window) -> Vec<usize> {
    let mut nodes = Vec::new();
    each_passed(window, |_, unknown| nodes.extend(window.grid.row(unknown).0));
    nodes
}

/// Tells line and unknown of every node that B may pass, line after line.
fn each_passed(window: &Window, mut tell: impl FnMut(usize, usize)) {
    let (grid, lines) = (&window.grid, window.grid.lines());
    let first = grid.line_and_column(grid.node(0)).1;
    for (line, (lowest, highest)) in passed(window).into_iter().enumerate() {
        (lowest..=highest).for_each(|column| tell(line, (column - first) * lines + line));
    }
}

impl Front {
    /// The boundary of a window, for operators over a support with so many modes.
    pub fn new(window: &Window, support: &[usize], state_rows: &[f64], load_row: &[f64]) -> Self {
        let (grid, weights, modes) = (&window.grid, window.grid.weights(), load_row.len());
        let place = |node: usize| support.partition_point(|&s| s < node);
        let (mut nodes, mut owners): (Vec<Passed>, Vec<usize>) = (Vec::new(), Vec::new());
        each_passed(window, |line, unknown| {
            let (node, (stencil, geometry)) = (grid.node(unknown), grid.row(unknown));
            owners.push(line);
            let stencil = stencil.map(place);
            nodes.push(Passed { place: place(node), node, weight: weights[node], stencil, geometry, zero: 0.0 });
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
        let mut front = Self {
            rows: window.sampled_rows.iter().map(|&row| grid.line_and_column(grid.node(row))).collect(),
            bends: grid.kernel_columns(support, &passed),
            modes: nodes.iter().flat_map(|p| state_rows[p.place * modes..][..modes].iter().copied()).collect(),
            kept: Vec::new(),
            strides: false,
            restrains: window.anchor.is_some(),
            behind: Mat::zeros(modes, modes),
            idle: false,
            loaded: None,
            lift: vec![0.0; modes],
            aimed: None,
            whole_load: load_row.to_vec(),
            passing: Vec::with_capacity(nodes.len()),
            lines,
            nodes,
        };
        front.keep(window, &state_rows[support.len() * modes..2 * support.len() * modes]);
        front
    }

    /// Keeps K V, given whole, at places of B that are far from each other.
    fn keep(&mut self, window: &Window, whole: &[f64]) {
        let modes = self.lift.len();
        let s = whole.len() / modes;
        let most = (KEPT_BYTES / (8 * whole.len())).clamp(1, KEPT);
        let fronts = |snapshot: &Snapshot| -> Vec<usize> {
            self.lines.iter().zip(&snapshot.fronts).map(|(line, front)| line.place_of(*front)).collect()
        };
        let known: Vec<Vec<usize>> = window.snapshots.iter().map(fronts).collect();
        let from_all = |own: &Vec<usize>| known.iter().map(|other| apart(own, other)).sum::<usize>();
        let Some(middle) = known.iter().min_by_key(|own| from_all(own)) else { return };
        let mut chosen = vec![middle.clone()];
        while chosen.len() < most {
            let near = |own: &Vec<usize>| chosen.iter().map(|other| apart(own, other)).min().unwrap_or(0);
            let Some(next) = known.iter().max_by_key(|own| near(own)).filter(|own| near(own) > self.lines.len()) else {
                break;
            };
            chosen.push(next.clone());
        }
        for fronts in chosen {
            let cut =
                self.lines.iter().zip(&fronts).flat_map(|(line, front)| line.first + front..line.first + line.count);
            let cut: Vec<usize> = cut.collect();
            let bent = Mat::from_fn(cut.len(), s, |k, place| self.bends[cut[k] * s + place]);
            let own = Mat::from_fn(cut.len(), modes, |k, mode| self.modes[cut[k] * modes + mode]);
            let mut deformation = whole.to_vec();
            let out = MatMut::from_row_major_slice_mut(&mut deformation, s, modes);
            matmul(out, Accum::Add, bent.transpose(), own.as_ref(), -1.0, Par::Seq);
            let mut behind = Mat::zeros(modes, modes);
            if self.restrains {
                matmul(behind.as_mut(), Accum::Replace, own.transpose(), own.as_ref(), 1.0, Par::Seq);
            }
            self.kept.push(Kept { fronts, deformation, behind });
        }
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
    pub fn begin(&mut self, fronts: Option<&[usize]>, changed: Changed<'_>) {
        self.idle = fronts.is_none();
        let Self { lines, nodes, modes: basis, kept, whole_load, loaded, behind, .. } = self;
        for (number, line) in lines.iter_mut().enumerate() {
            let place = fronts.map_or(Some(line.count), |fronts| fronts.get(number).map(|front| line.place_of(*front)));
            (line.front, line.down, line.turns, line.stride) = (place.unwrap_or(line.front), None, 0, STRIDE);
        }
        let far =
            |kept: &Kept| lines.iter().zip(&kept.fronts).map(|(line, own)| line.front.abs_diff(*own)).sum::<usize>();
        let Some((index, nearest)) = kept.iter().enumerate().min_by_key(|(_, kept)| far(kept)) else { return };
        let modes = whole_load.len();
        if *loaded != Some(index) {
            let from = nearest.deformation.len();
            changed.state_rows[from..2 * from].copy_from_slice(&nearest.deformation);
            *loaded = Some(index);
        }
        changed.load_row.copy_from_slice(whole_load);
        behind.copy_from(&nearest.behind);
        for (line, kept) in lines.iter_mut().zip(&nearest.fronts) {
            (line.kept, line.restrained) = (*kept, *kept);
            for k in line.first..line.first + line.count {
                let row = &mut changed.state_rows[nodes[k].place * modes..][..modes];
                let own = &basis[k * modes..][..modes];
                if k < line.first + line.front {
                    row.copy_from_slice(own);
                } else {
                    row.fill(0.0);
                    changed.load_row.iter_mut().zip(own).for_each(|(load, v)| *load -= nodes[k].weight * v);
                }
            }
        }
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

    /// Adds to K P, of coefficients, what nodes between B and its place in K V bend.
    pub fn correct(&self, coefficients: &[f64], deformation: &mut [f64]) {
        let (modes, s) = (self.lift.len(), deformation.len());
        for line in &self.lines {
            let sign = if line.front > line.kept { 1.0 } else { -1.0 };
            for k in line.first + line.front.min(line.kept)..line.first + line.front.max(line.kept) {
                let value = sign * dot(&self.modes[k * modes..][..modes], coefficients);
                let bends = &self.bends[k * s..][..s];
                deformation.iter_mut().zip(bends).for_each(|(out, bend)| *out += value * bend);
            }
        }
    }

    /// Adds to a row of the Jacobian, by its derivatives with respect to the films, what nodes between B and its place in
    /// K V bend. Of one line always: there few nodes decide the film, and at a high M Newton's steps grow without them.
    /// Of many lines it costs more than the steps that it mostly saves, and waits until an iteration turns out `slow`.
    pub fn bend(
        &self,
        (stencil, d_h): (&[usize; STENCIL], [f64; STENCIL]),
        slow: bool,
        scale: f64,
        target: &mut [f64],
    ) {
        if self.idle || !(slow || self.lines.len() == 1) {
            return;
        }
        let (modes, s) = (self.lift.len(), self.bends.len() / self.nodes.len());
        for line in self.lines.iter().filter(|line| line.front != line.kept) {
            let sign = if line.front > line.kept { scale } else { -scale };
            for k in line.first + line.front.min(line.kept)..line.first + line.front.max(line.kept) {
                let bends = &self.bends[k * s..][..s];
                let bent = sign * stencil.iter().zip(d_h).map(|(&place, slope)| slope * bends[place]).sum::<f64>();
                target.iter_mut().zip(&self.modes[k * modes..][..modes]).for_each(|(out, v)| *out += bent * v);
            }
        }
    }

    /// What the film at X = 0 (and Y = 0) gains, given by nodes and weights of an interpolation there and by what whole
    /// modes give it.
    pub fn aim(&mut self, grid: &ContactGrid, zero: &[(usize, f64)], scale: f64, whole: &[f64]) {
        self.lift.copy_from_slice(whole);
        let modes = whole.len();
        if self.aimed != Some(scale) {
            self.aimed = Some(scale);
            let weights = || zero.iter().filter(|(_, weight)| *weight != 0.0);
            for own in &mut self.nodes {
                own.zero = scale * weights().map(|(at, weight)| weight * grid.kernel_entry(*at, own.node)).sum::<f64>();
            }
        }
        for line in &self.lines {
            for k in line.first + line.front..line.first + line.count {
                let zero = self.nodes[k].zero;
                let own = &self.modes[k * modes..][..modes];
                self.lift.iter_mut().zip(own).for_each(|(lift, v)| *lift -= zero * v);
            }
        }
    }

    /// Lets B follow a step: `nodes` are those before it, `step` what it added to the fields, by the factor `omega`,
    /// and `shift` to H₀; `changed` has the fields behind it. Whether B is still.
    pub fn follow(
        &mut self,
        nodes: &Nodes,
        (scale, omega): (f64, f64),
        (step, shift): (&[f64], f64),
        coefficients: &[f64],
        changed: Changed<'_>,
    ) -> bool {
        if self.idle {
            return true;
        }
        let Changed { state_rows, load_row, fields } = changed;
        let s = fields.len() / 2;
        self.passing.clear();
        for line in &mut self.lines {
            if line.turns >= TURNS {
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
            let least = if self.strides { -LITTLE } else { NEGATIVE };
            let negative = (first..end).find(|&k| fields[at(k).place] < least).filter(|_| line.front > 1);
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
            return true;
        }
        let modes = load_row.len();
        let (pressure, deformation) = fields.split_at_mut(s);
        for &(k, carries) in &self.passing {
            let (passed, own) = (&self.nodes[k], &self.modes[k * modes..][..modes]);
            let (value, sign) = (dot(own, coefficients), if carries { 1.0 } else { -1.0 });
            pressure[passed.place] = if carries { value } else { 0.0 };
            let bends = &self.bends[k * s..][..s];
            deformation.iter_mut().zip(bends).for_each(|(out, bend)| *out += sign * value * bend);
            for ((lift, load), v) in self.lift.iter_mut().zip(&mut *load_row).zip(own) {
                *lift += sign * passed.zero * v;
                *load += sign * passed.weight * v;
            }
            let row = &mut state_rows[passed.place * modes..][..modes];
            if carries { row.copy_from_slice(own) } else { row.fill(0.0) }
        }
        false
    }
}

impl Line {
    /// How many of the nodes that B may pass carry pressure where it has this column.
    fn place_of(&self, front: usize) -> usize {
        front.saturating_sub(self.column).clamp(1, self.count.max(1))
    }
}

/// How far two places of B are from each other.
fn apart(a: &[usize], b: &[usize]) -> usize {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).sum()
}
