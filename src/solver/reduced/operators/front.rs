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

use super::support::{Support, row_times};
use crate::solver::discrete::grid::{ContactGrid, dot};
use crate::solver::discrete::nodes::Nodes;
use crate::solver::discrete::reynolds::{RowGeometry, STENCIL};
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::model::{Snapshot, Window};
use faer::linalg::matmul::matmul;
use faer::reborrow::ReborrowMut;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::ops::Range;

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
    /// wᵀ V.
    load: Vec<f64>,
    /// What the film at X = 0 (and Y = 0) gains, and the scale it was found for.
    lift: (Option<f64>, Vec<f64>),
}

/// What the boundary changes of the operators.
pub(super) struct Changed<'a> {
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
    /// The boundary of a window, for operators over a support, with V and the whole K V there, row-major.
    pub fn new(window: &Window, support: &Support, (values, whole): (&[f64], Vec<f64>), load_row: &[f64]) -> Self {
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
        let mut front = Self {
            rows: window.sampled_rows.iter().map(|&row| grid.line_and_column(grid.node(row))).collect(),
            bends: grid.kernel_columns(&support.nodes(), &passed),
            modes: nodes.iter().flat_map(|p| values[p.place * modes..][..modes].iter().copied()).collect(),
            cut: vec![false; support.len()],
            own: support.own,
            asked: support.places[support.own..].iter().map(|place| place.node % support.across).collect(),
            near: vec![support.own..support.own; support.across],
            kept: Vec::new(),
            strides: false,
            restrains: window.anchor.is_some(),
            behind: Mat::zeros(modes, modes),
            idle: false,
            loaded: 0,
            lift: vec![0.0; modes],
            aimed: None,
            passing: Vec::with_capacity(nodes.len()),
            bending: Vec::with_capacity(nodes.len()),
            lines,
            nodes,
        };
        front.keep(window, &whole, load_row);
        front
    }

    /// Keeps K V, given whole, at places of B that are far from each other.
    fn keep(&mut self, window: &Window, whole: &[f64], whole_load: &[f64]) {
        let modes = self.lift.len();
        let s = whole.len() / modes;
        let most = (KEPT_BYTES / (8 * whole.len())).clamp(1, KEPT);
        let fronts = |snapshot: &Snapshot| -> Vec<usize> {
            self.lines.iter().zip(&snapshot.fronts).map(|(line, front)| line.place_of(*front)).collect()
        };
        let known: Vec<Vec<usize>> = window.snapshots.iter().map(fronts).collect();
        let from_all = |own: &Vec<usize>| known.iter().map(|other| apart(own, other)).sum::<usize>();
        let middle = known.iter().min_by_key(|own| from_all(own)).cloned();
        let mut chosen = vec![middle.unwrap_or_else(|| self.lines.iter().map(|line| line.count).collect())];
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
            let bent = Mat::from_fn(cut.len(), s, |k, place| f64::from(self.bends[cut[k] * s + place]));
            let own = Mat::from_fn(cut.len(), modes, |k, mode| self.modes[cut[k] * modes + mode]);
            let mut deformation = whole.to_vec();
            let out = MatMut::from_row_major_slice_mut(&mut deformation, s, modes);
            matmul(out, Accum::Add, bent.transpose(), own.as_ref(), -1.0, Par::Seq);
            let mut behind = Mat::zeros(modes, modes);
            if self.restrains {
                matmul(behind.as_mut(), Accum::Replace, own.transpose(), own.as_ref(), 1.0, Par::Seq);
            }
            let mut load = whole_load.to_vec();
            for k in cut {
                let own = &self.modes[k * modes..][..modes];
                load.iter_mut().zip(own).for_each(|(load, v)| *load -= self.nodes[k].weight * v);
            }
            let lift = (None, vec![0.0; modes]);
            self.kept.push(Kept { fronts, deformation, behind, load, lift });
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

    /// K V at the support, row-major, of a place of B nearby.
    pub fn deformations(&self) -> &[f64] {
        &self.kept[self.loaded].deformation
    }

    /// Whether a place of the support lies behind B.
    pub fn is_cut(&self, place: usize) -> bool {
        self.cut[place]
    }

    /// Places that no sampled row asks for and that are near B.
    pub fn near(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        self.near.iter().filter(|places| !places.is_empty()).cloned()
    }

    /// Nodes between B and its place in K V, and whether they carry pressure that K V does not know, 1, or the other way
    /// about, −1.
    fn between(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.lines.iter().flat_map(|line| {
            let sign = if line.front > line.kept { 1.0 } else { -1.0 };
            let both = line.front.min(line.kept)..line.front.max(line.kept);
            both.map(move |k| (line.first + k, sign))
        })
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

    /// Finds the places that are near B: those of the rows behind it.
    fn look_near(&mut self) {
        let (own, end) = (self.own, self.cut.len());
        self.near.fill(own..own);
        if self.strides || self.idle {
            // All are.
            self.near.first_mut().into_iter().for_each(|near| *near = own..end);
            return;
        }
        let Self { lines, nodes, asked, near, .. } = self;
        let mut see = |place: usize| {
            let Some(line) = place.checked_sub(own).map(|k| asked[k]) else { return };
            let seen = &mut near[line];
            *seen =
                if seen.start == seen.end { place..place + 1 } else { seen.start.min(place)..seen.end.max(place + 1) };
        };
        for line in lines {
            let behind = &nodes[line.first + line.front.min(line.count)];
            behind.stencil.iter().for_each(|place| see(*place));
        }
    }

    /// P and K P of coefficients: cuts off what lies behind B, adds to K P of the rows' own places what nodes between B
    /// and its place in K V bend, and finds both near B.
    pub fn spread(&mut self, values: &[f64], coefficients: &[f64], (pressure, deformation): (&mut [f64], &mut [f64])) {
        for line in &self.lines {
            for passed in &self.nodes[line.first + line.front..line.first + line.count] {
                pressure[passed.place] = 0.0;
            }
        }
        self.find_bending(coefficients);
        self.bend_part(0..self.own, deformation);
        self.spread_near(values, coefficients, (pressure, deformation));
    }

    /// P and K P of coefficients near B, where what bends is known.
    fn spread_near(&self, values: &[f64], coefficients: &[f64], (pressure, deformation): (&mut [f64], &mut [f64])) {
        let rows = self.deformations();
        for near in self.near() {
            for place in near.clone() {
                pressure[place] = if self.cut[place] { 0.0 } else { row_times(values, place, coefficients) };
                deformation[place] = row_times(rows, place, coefficients);
            }
            self.bend_part(near, deformation);
        }
    }

    /// Finds the pressures, of coefficients, that K V does not know.
    fn find_bending(&mut self, coefficients: &[f64]) {
        let mut bending = std::mem::take(&mut self.bending);
        bending.clear();
        bending.extend(self.between().map(|(k, sign)| (k, sign * row_times(&self.modes, k, coefficients))));
        self.bending = bending;
    }

    /// Adds what they bend to K P at a part of the support.
    fn bend_part(&self, part: Range<usize>, deformation: &mut [f64]) {
        let s = self.cut.len();
        let out = &mut deformation[part.clone()];
        for (k, value) in &self.bending {
            let bends = &self.bends[k * s..][part.clone()];
            out.iter_mut().zip(bends).for_each(|(out, bend)| *out += value * f64::from(*bend));
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
        for (k, sign) in self.between() {
            let bends = &self.bends[k * s..][..s];
            let bent = scale
                * sign
                * stencil.iter().zip(d_h).map(|(&place, slope)| slope * f64::from(bends[place])).sum::<f64>();
            target.iter_mut().zip(&self.modes[k * modes..][..modes]).for_each(|(out, v)| *out += bent * v);
        }
    }

    /// What the film at X = 0 (and Y = 0) gains, given by nodes and weights of an interpolation there and by what whole
    /// modes give it.
    pub fn aim(&mut self, grid: &ContactGrid, zero: &[(usize, f64)], scale: f64, whole: &[f64]) {
        let modes = whole.len();
        if self.aimed != Some(scale) {
            self.aimed = Some(scale);
            let weights = || zero.iter().filter(|(_, weight)| *weight != 0.0);
            for own in &mut self.nodes {
                own.zero = scale * weights().map(|(at, weight)| weight * grid.kernel_entry(*at, own.node)).sum::<f64>();
            }
        }
        let Self { kept, lines, nodes, modes: basis, .. } = self;
        let kept = &mut kept[self.loaded];
        if kept.lift.0 != Some(scale) {
            kept.lift.0 = Some(scale);
            kept.lift.1.copy_from_slice(whole);
            for k in
                lines.iter().zip(&kept.fronts).flat_map(|(line, front)| line.first + front..line.first + line.count)
            {
                let own = &basis[k * modes..][..modes];
                kept.lift.1.iter_mut().zip(own).for_each(|(lift, v)| *lift -= nodes[k].zero * v);
            }
        }
        let mut lift = std::mem::take(&mut self.lift);
        lift.copy_from_slice(&self.kept[self.loaded].lift.1);
        for (k, sign) in self.between() {
            let zero = sign * self.nodes[k].zero;
            lift.iter_mut().zip(&self.modes[k * modes..][..modes]).for_each(|(lift, v)| *lift += zero * v);
        }
        self.lift = lift;
    }

    /// Lets B follow a step: `nodes` are those before it, `values` V at the support, `step` what it added to the fields, by the factor `omega`,
    /// and `shift` to H₀; `changed` has the fields behind it. Whether B is still.
    pub fn follow(
        &mut self,
        (nodes, values): (&Nodes, &[f64]),
        (scale, omega): (f64, f64),
        (step, shift): (&[f64], f64),
        coefficients: &[f64],
        changed: Changed<'_>,
    ) -> bool {
        if self.idle {
            return true;
        }
        let Changed { load_row, fields } = changed;
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
            return true;
        }
        let modes = load_row.len();
        let (pressure, deformation) = fields.split_at_mut(s);
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
        self.spread_near(values, coefficients, (pressure, deformation));
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
