//! Changes of the deformations K V (of the modes) and K P (of the pressure) by the boundary B: at stored positions of
//! B, and by the nodes in between.

use super::Front;
use crate::solver::discrete::reynolds::CENTER;
use crate::solver::reduced::model::{Snapshot, Window};
use crate::solver::reduced::operators::part::Centre;
use crate::solver::reduced::operators::sampled_system::{RowState, SampledSystem};
use crate::solver::reduced::sums::{add_columns, row_times};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::ops::Range;

/// Maximum number of positions of B with stored K V, and their maximum memory in bytes. A solve uses the nearest
/// position.
const KEPT: usize = 8;
const KEPT_BYTES: usize = 16 << 20;

/// K V at one position of B.
pub(super) struct StoredFront {
    /// Number of nodes that carry pressure, for each line.
    pub fronts: Vec<usize>,
    /// K V at the support, row-major. For the position in use it is stored in the basis of the system.
    pub deformation: Vec<f64>,
    /// Σ v vᵀ over the nodes behind B, if modes are restrained there.
    pub behind: Mat<f64>,
    /// wᵀ V.
    pub load: Vec<f64>,
    /// Contribution to the film thickness at X = 0 (and Y = 0), and the scale for which it was computed.
    pub lift: (Option<f64>, Vec<f64>),
}

/// Number of nodes whose deformation is added to the Jacobian at once.
const TOGETHER: usize = 32;

/// Work space: change of the rows by the deformation of some nodes, rows × nodes column-major, and modes at these
/// nodes, row-major.
#[derive(Default)]
pub(super) struct Bent {
    rows: Vec<f64>,
    modes: Vec<f64>,
}

impl Bent {
    pub fn new(rows: usize, modes: usize) -> Self {
        Self { rows: vec![0.0; TOGETHER * rows], modes: vec![0.0; TOGETHER * modes] }
    }
}

impl Front {
    /// Stores K V, given for whole modes, at positions of B that are far from each other.
    pub(super) fn keep(&mut self, window: &Window, whole: &[f64], whole_load: &[f64]) {
        let modes = whole_load.len();
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
            let (mut bent, mut own) = (Vec::with_capacity(cut.len() * s), Vec::with_capacity(cut.len() * modes));
            for k in &cut {
                bent.extend(self.bends[k * s..][..s].iter().map(|bend| f64::from(*bend)));
                own.extend_from_slice(&self.modes[k * modes..][..modes]);
            }
            let bent = MatRef::from_row_major_slice(&bent, cut.len(), s);
            let own = MatRef::from_row_major_slice(&own, cut.len(), modes);
            let mut deformation = whole.to_vec();
            let out = MatMut::from_row_major_slice_mut(&mut deformation, s, modes);
            matmul(out, Accum::Add, bent.transpose(), own, -1.0, Par::Seq);
            let mut behind = Mat::zeros(modes, modes);
            if self.restrains {
                matmul(behind.as_mut(), Accum::Replace, own.transpose(), own, 1.0, Par::Seq);
            }
            let mut load = whole_load.to_vec();
            for k in cut {
                let own = &self.modes[k * modes..][..modes];
                load.iter_mut().zip(own).for_each(|(load, v)| *load -= self.nodes[k].weight * v);
            }
            let lift = (None, vec![0.0; modes]);
            self.kept.push(StoredFront { fronts, deformation, behind, load, lift });
        }
    }

    /// Returns the nodes between B and its position in K V, with +1 if they carry pressure that K V does not include,
    /// and −1 in the opposite case.
    pub(super) fn between(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.lines.iter().flat_map(|line| {
            let sign = if line.front > line.kept { 1.0 } else { -1.0 };
            let both = line.front.min(line.kept)..line.front.max(line.kept);
            both.map(move |k| (line.first + k, sign))
        })
    }

    /// Determines which rows lie behind B, and which further places near B are evaluated: those of the rows just
    /// behind it.
    pub(super) fn look_near(&mut self, system: &mut SampledSystem) {
        let SampledSystem { row_states, stencils, seen, support, transient, .. } = system;
        for ((state, (line, column)), stencil) in row_states.iter_mut().zip(&self.rows).zip(&*stencils) {
            let line = &self.lines[*line];
            *state = if self.idle {
                RowState::Penalised
            } else if *column >= line.column + line.front {
                RowState::Cavitated
            } else if support.places[stencil[CENTER]].xi < 0.0 {
                // There is no boundary in front of the centre. A cavitated inlet of a transient contact is treated by
                // the penalty.
                RowState::Penalised
            } else {
                RowState::Full
            };
        }
        let (own, end) = (self.own, self.cut.len());
        let near = &mut seen[1..];
        near.fill(own..own);
        if *transient || self.idle {
            // All further places.
            near.first_mut().into_iter().for_each(|near| *near = own..end);
            return;
        }
        let (first_row, asked) = (self.rows.len(), &self.asked);
        let mut see = |place: usize| {
            let Some(line) = place.checked_sub(own).map(|k| asked[k]) else { return };
            let seen = &mut near[line];
            *seen =
                if seen.start == seen.end { place..place + 1 } else { seen.start.min(place)..seen.end.max(place + 1) };
        };
        for line in &self.lines {
            let behind = first_row + line.first + line.front.min(line.count);
            stencils[behind].iter().for_each(|place| see(*place));
        }
    }

    /// Applies B to P, K P and the gradients of the coefficients. Cuts off pressures behind B, adds the deformation
    /// by nodes between B and its position in K V at the rows' own places, and computes all fields near B.
    pub(super) fn cut_and_bend(&mut self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        let (pressure, rest) = fields.split_at_mut(self.cut.len());
        for line in &self.lines {
            for passed in &self.nodes[line.first + line.front..line.first + line.count] {
                pressure[passed.place] = 0.0;
            }
        }
        self.find_bending(coefficients);
        self.bend_part(0..self.own, rest);
        self.spread_near(system, coefficients, fields);
    }

    /// Computes P, K P and the gradients of the coefficients near B, after [`Self::find_bending`].
    pub(super) fn spread_near(&self, system: &SampledSystem, coefficients: &[f64], fields: &mut [f64]) {
        let (basis, near) = (&system.basis, &system.seen[1..]);
        let count = self.cut.len();
        let (pressure, rest) = fields.split_at_mut(count);
        let (deformation, gradients) = rest.split_at_mut(count);
        for near in near.iter().filter(|near| !near.is_empty()) {
            for place in near.clone() {
                pressure[place] = if self.cut[place] { 0.0 } else { row_times(&basis.values, place, coefficients) };
                deformation[place] = row_times(&basis.deformations, place, coefficients);
                for (gradient, rows) in gradients.chunks_exact_mut(count).zip(basis.gradient_rows()) {
                    gradient[place] = row_times(rows, place, coefficients);
                }
            }
            self.bend_part(near.clone(), deformation);
        }
    }

    /// Computes the pressures of the coefficients that K V does not include.
    pub(super) fn find_bending(&mut self, coefficients: &[f64]) {
        let mut bending = std::mem::take(&mut self.bending);
        bending.clear();
        bending.extend(self.between().map(|(k, sign)| (k, sign * row_times(&self.modes, k, coefficients))));
        self.bending = bending;
    }

    /// Adds the deformation by these pressures to K P at a part of the support.
    fn bend_part(&self, part: Range<usize>, deformation: &mut [f64]) {
        let s = self.cut.len();
        let out = &mut deformation[part.clone()];
        let bends = |k: usize| &self.bends[k * s..][part.clone()];
        // Four nodes at once: the sums are read and written a quarter as often.
        let mut fours = self.bending.chunks_exact(4);
        for four in fours.by_ref() {
            let &[(k, a), (l, b), (m, c), (n, d)] = four else { continue };
            add_columns([(a, bends(k)), (b, bends(l)), (c, bends(m)), (d, bends(n))], out);
        }
        for (k, value) in fours.remainder() {
            add_columns([(*value, bends(*k))], out);
        }
    }

    /// Adds the deformation by nodes between B and its position in K V to the rows of the Jacobian. For a single line
    /// always: there few nodes determine the film thickness, and at high M Newton's method needs more steps without
    /// them. For many lines the cost exceeds the savings, so it is done only for `slow` iterations.
    pub(super) fn bend(&mut self, system: &mut SampledSystem, scale: f64, slow: bool) {
        if self.idle || !(slow || self.lines.len() == 1) {
            return;
        }
        let SampledSystem { modes, stencils, by_film, jacobian_rows, .. } = system;
        let (modes, rows, s) = (*modes, by_film.len(), self.cut.len());
        let mut own = std::mem::take(&mut self.bent);
        let mut between = self.between();
        loop {
            let mut count = 0;
            for (k, sign) in between.by_ref().take(TOGETHER) {
                let bends = &self.bends[k * s..][..s];
                for (bent, (stencil, slopes)) in
                    own.rows[count * rows..][..rows].iter_mut().zip(stencils.iter().zip(&*by_film))
                {
                    let sum: f64 = stencil.iter().zip(slopes).map(|(&at, slope)| slope * f64::from(bends[at])).sum();
                    *bent = scale * sign * sum;
                }
                own.modes[count * modes..][..modes].copy_from_slice(&self.modes[k * modes..][..modes]);
                count += 1;
            }
            if count == 0 {
                break;
            }
            let out = MatMut::from_row_major_slice_mut(jacobian_rows, rows, modes);
            let bent = MatRef::from_column_major_slice(&own.rows[..count * rows], rows, count);
            let basis = MatRef::from_row_major_slice(&own.modes[..count * modes], count, modes);
            matmul(out, Accum::Add, bent, basis, 1.0, Par::Seq);
        }
        drop(between);
        self.bent = own;
    }

    /// Replaces `lift`, given for whole modes, by the contribution of the cut-off modes to the film thickness at X =
    /// 0 (and Y = 0).
    pub(super) fn lift(&mut self, lift: &mut [f64], Centre { window, nodes: zero, scale }: Centre<'_>) {
        let modes = lift.len();
        if self.aimed != Some(scale) {
            self.aimed = Some(scale);
            let weights = || zero.iter().filter(|(_, weight)| *weight != 0.0);
            for own in &mut self.nodes {
                let entries = weights().map(|(at, weight)| weight * window.grid.kernel_entry(*at, own.node));
                own.zero = scale * entries.sum::<f64>();
            }
        }
        let Self { kept, lines, nodes, modes: basis, .. } = self;
        let kept = &mut kept[self.loaded];
        if kept.lift.0 != Some(scale) {
            kept.lift.0 = Some(scale);
            kept.lift.1.copy_from_slice(lift);
            for k in
                lines.iter().zip(&kept.fronts).flat_map(|(line, front)| line.first + front..line.first + line.count)
            {
                let own = &basis[k * modes..][..modes];
                kept.lift.1.iter_mut().zip(own).for_each(|(lift, v)| *lift -= nodes[k].zero * v);
            }
        }
        lift.copy_from_slice(&kept.lift.1);
        for (k, sign) in self.between() {
            let zero = sign * self.nodes[k].zero;
            lift.iter_mut().zip(&self.modes[k * modes..][..modes]).for_each(|(lift, v)| *lift += zero * v);
        }
    }
}

/// Returns the distance between two positions of B.
fn apart(a: &[usize], b: &[usize]) -> usize {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).sum()
}
