//! Effect of the cavitation boundary B on the deformations of a reduced contact: K V of the modes V and K P of the
//! pressure P, where behind B both V and P are cut off. K V is stored for a few positions of B, and the nearest one is
//! in use. The nodes between this position and B are then added or removed one by one.

use super::Front;
use crate::solver::discrete::reynolds::CENTER;
use crate::solver::reduced::model::{Snapshot, Window};
use crate::solver::reduced::operators::part::Centre;
use crate::solver::reduced::operators::sampled_system::{RowState, SampledSystem};
use crate::solver::reduced::sums::{add_columns, row_times};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use std::ops::Range;

/// Maximum number of positions of B for which K V is stored.
const KEPT: usize = 8;
/// Maximum memory of all stored K V in bytes. One is stored in any case.
const KEPT_BYTES: usize = 16 << 20;

/// K V and other products of the modes V, all cut off at one position of B.
pub(super) struct StoredFront {
    /// Position of B: for each line, the number of nodes that carry pressure among those that B may pass.
    pub fronts: Vec<usize>,
    /// K V at the support, row-major support × modes. While this position is in use, K V is in the basis of the system
    /// instead.
    pub deformation: Vec<f64>,
    /// Σ v vᵀ over the nodes behind B, modes × modes, where v are the modes at a node. Zero if modes are not
    /// restrained.
    pub behind: Mat<f64>,
    /// wᵀ V: load of each mode, with the weights w of the nodes.
    pub load: Vec<f64>,
    /// Registration scale for which the lift was computed, and the lift: contribution of each mode to the film
    /// thickness at X = 0 (and Y = 0).
    pub lift: (Option<f64>, Vec<f64>),
}

/// Number of nodes whose deformation is added to the Jacobian by one matrix product.
const NODES_AT_ONCE: usize = 32;

/// Work space for the derivatives of the deformation, for up to [`NODES_AT_ONCE`] nodes.
#[derive(Default)]
pub(super) struct Bent {
    /// Change of each row by the deformation due to unit pressure at each node, column-major rows × nodes.
    rows: Vec<f64>,
    /// Modes at these nodes, row-major nodes × modes.
    modes: Vec<f64>,
}

impl Bent {
    /// Allocates the work space for numbers of rows and modes.
    pub fn new(rows: usize, modes: usize) -> Self {
        Self { rows: vec![0.0; NODES_AT_ONCE * rows], modes: vec![0.0; NODES_AT_ONCE * modes] }
    }
}

impl Front {
    /// Computes and stores K V for positions of B. The first one is the most central of the positions in the training;
    /// the next ones are each as far as possible from all previous ones. `whole` is K V and `whole_load` is wᵀ V of the
    /// modes that are not cut off.
    pub(super) fn keep(&mut self, window: &Window, whole: &[f64], whole_load: &[f64]) {
        let modes = whole_load.len();
        // Number of nodes of the support.
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

    /// Returns the nodes between B and the position for which K V in use was computed. The sign is +1 if a node carries
    /// pressure that K V does not include, and −1 if K V includes a pressure that B cuts off.
    pub(super) fn between(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.lines.iter().flat_map(|line| {
            let sign = if line.front > line.kept { 1.0 } else { -1.0 };
            let both = line.front.min(line.kept)..line.front.max(line.kept);
            both.map(move |k| (line.first + k, sign))
        })
    }

    /// Determines the states of the rows: whether each lies behind B, for instance. Determines too which places of the
    /// support near B are evaluated: those that the first row behind B uses on each line.
    pub(super) fn look_near(&mut self, system: &mut SampledSystem) {
        let SampledSystem { row_states, stencils, seen, support, transient, .. } = system;
        for ((state, (line, column)), stencil) in row_states.iter_mut().zip(&self.rows).zip(&*stencils) {
            let line = &self.lines[*line];
            *state = if self.idle {
                RowState::Penalised
            } else if *column >= line.column + line.front {
                RowState::Cavitated
            } else if support.places[stencil[CENTER]].xi < 0.0 {
                // B always lies at X ≥ 0. At X < 0 the penalty acts, in case the inlet of a transient contact
                // cavitates.
                RowState::Penalised
            } else {
                RowState::Full
            };
        }
        let (own, end) = (self.own, self.cut.len());
        let near = &mut seen[1..];
        near.fill(own..own);
        if *transient || self.idle {
            // Evaluate all places in addition to those of the sampled equations.
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

    /// Applies B to `fields`: P, K P and the gradients for the given coefficients, one after the other. Sets the
    /// pressures behind B to zero. At the places of the sampled equations it adds the deformation due to the nodes
    /// between B and the position in K V. Near B it computes all fields.
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

    /// Computes P, K P and the gradients for the given coefficients at the places near B. Call [`Self::find_bending`]
    /// before.
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

    /// Computes `bending`: the pressures for the given coefficients at the nodes between B and the position in K V.
    /// They are negative where K V includes a pressure that B cuts off.
    pub(super) fn find_bending(&mut self, coefficients: &[f64]) {
        let mut bending = std::mem::take(&mut self.bending);
        bending.clear();
        bending.extend(self.between().map(|(k, sign)| (k, sign * row_times(&self.modes, k, coefficients))));
        self.bending = bending;
    }

    /// Adds the deformation due to the pressures in `bending` to K P at a part of the support.
    fn bend_part(&self, part: Range<usize>, deformation: &mut [f64]) {
        let s = self.cut.len();
        let out = &mut deformation[part.clone()];
        let bends = |k: usize| &self.bends[k * s..][part.clone()];
        // With four nodes at once, the sums are read and written a quarter as often.
        let mut fours = self.bending.chunks_exact(4);
        for four in fours.by_ref() {
            let &[(k, a), (l, b), (m, c), (n, d)] = four else { continue };
            add_columns([(a, bends(k)), (b, bends(l)), (c, bends(m)), (d, bends(n))], out);
        }
        for (k, value) in fours.remainder() {
            add_columns([(*value, bends(*k))], out);
        }
    }

    /// Adds the deformation due to the nodes between B and the position in K V to the rows of the Jacobian. This is
    /// always done for a line contact: there few nodes determine the film thickness, and at high M Newton's method
    /// needs more steps without them. For a point contact, with many lines, it saves less than it costs, so it is done
    /// only if the iteration is `slow`.
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
            for (k, sign) in between.by_ref().take(NODES_AT_ONCE) {
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

    /// Modifies `lift`, the film thickness at X = 0 (and Y = 0) per unit of each coefficient. On entry it belongs to
    /// the whole modes, afterwards to the modes that are cut off at B.
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

/// Returns the distance between two positions of B: the sum over all lines, in nodes.
fn apart(a: &[usize], b: &[usize]) -> usize {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(*b)).sum()
}
