//! Local models around anchors in (ln M, ln L), for spaces whose lubricant varies.
//!
//! Registered pressures vary most with ln M and ln L, three times less over the lubricant ranges with ln p_H, and little with
//! Roelands' exponent z. A local model that is narrow in one of the latter needs hardly fewer modes than a wide one, so local
//! models are the cells of anchors in (ln M, ln L), whatever the lubricant.

use super::error_estimate::{ErrorEstimate, Estimated};
use super::model::{ReducedModel, Window};
use super::reduced_solution::ReducedSolution;
use crate::solver::full::GridCost;
use crate::solver::parameters::apart;
use crate::solver::physics::contact::{Moes, OperatingPoint};

/// How much farther than the nearest anchor, in ln M and ln L, another one may be to be blended in.
const BLENDED: f64 = 0.05;

/// How much farther contacts of its training may lie: a window knows more than it is asked for, so that nothing is
/// extrapolated where it is blended.
pub(crate) const BEYOND_CELLS: f64 = 0.1;

/// How far a contact lies from an anchor, in ln M and ln L.
pub(crate) fn from_anchor(moes: Moes, anchor: Moes) -> f64 {
    (moes.m / anchor.m).ln().hypot((moes.l / anchor.l).ln())
}

impl ReducedModel {
    /// Windows beside the one with the nearest anchor that share in a contact, with their shares; none but near borders.
    /// Shares begin with zero where an anchor comes near enough, so that nothing jumps.
    pub(super) fn blended(&self, moes: Moes) -> Vec<(f64, usize)> {
        // Temperatures are not blended.
        let Some(nearest) = self.nearest_anchor(moes).filter(|_| !self.domain.heats()) else { return Vec::new() };
        let far = |k: usize| self.windows[k].anchor.map_or(f64::INFINITY, |anchor| from_anchor(moes, anchor));
        let least = far(nearest);
        let share = |k: usize| (1.0 - (far(k) - least) / BLENDED).max(0.0).powi(2);
        let others = (0..self.windows.len()).filter(|k| *k != nearest).map(|k| (share(k), k));
        let others: Vec<(f64, usize)> = others.filter(|(share, _)| *share > 0.0).collect();
        let all = 1.0 + others.iter().map(|(share, _)| share).sum::<f64>();
        others.into_iter().map(|(share, k)| (share / all, k)).collect()
    }

    /// The window with the nearest anchor; none of a model without anchors.
    pub(super) fn nearest_anchor(&self, moes: Moes) -> Option<usize> {
        self.next_anchor(moes, usize::MAX)
    }

    /// The same but for one window.
    pub(super) fn next_anchor(&self, moes: Moes, except: usize) -> Option<usize> {
        let far = |(k, window): (usize, &Window)| window.anchor.map(|anchor| (k, from_anchor(moes, anchor)));
        let others = self.windows.iter().enumerate().filter(|(k, _)| *k != except);
        others.filter_map(far).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }
}

/// Training solutions between which the cost of the grid is interpolated.
const NEIGHBOURS: usize = 8;

impl Window {
    /// What the grid costs H_c of a contact, by those of the training solutions around it; none where these do not say.
    pub fn grid_cost(&self, point: &OperatingPoint) -> Option<GridCost> {
        let place = self.metric.place(point);
        let known = self.snapshots.iter().filter_map(|snapshot| {
            let cost = snapshot.grid_cost.filter(|cost| cost.total().is_finite())?;
            Some((apart(place, self.metric.place(&snapshot.point)), cost))
        });
        let mut near: Vec<(f64, GridCost)> = known.collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(NEIGHBOURS);
        // Shepard's weights fall with the fourth power of the distance.
        let weights: Vec<f64> = near.iter().map(|(apart, _)| 1.0 / (apart * apart).max(f64::MIN_POSITIVE)).collect();
        let all: f64 = weights.iter().sum();
        let mean = |of: &dyn Fn(&GridCost) -> f64| {
            near.iter().zip(&weights).map(|((_, cost), weight)| of(cost) * (weight / all)).sum::<f64>()
        };
        let [truncation, resolution] = [mean(&|cost| cost.truncation), mean(&|cost| cost.resolution)];
        (!near.is_empty()).then_some(GridCost { truncation, resolution })
    }
}

impl ReducedSolution {
    /// The share of its own window in it.
    pub(super) fn own_share(&self) -> f64 {
        1.0 - self.beside.iter().map(|(share, _)| share).sum::<f64>()
    }

    /// H₀ of its own window.
    pub(super) fn own_h_0(&self) -> f64 {
        let others = self.beside.iter().map(|(share, other)| share * other.h_0).sum::<f64>();
        (self.h_0 - others) / self.own_share()
    }

    /// Makes its numbers those of the blend with the solutions beside it.
    pub(super) fn blend(&mut self) {
        if self.beside.is_empty() {
            return;
        }
        let (own, beside) = (self.own_share(), std::mem::take(&mut self.beside));
        let mix = |mine: f64, of: &dyn Fn(&Self) -> f64| {
            own * mine + beside.iter().map(|(share, other)| share * of(other)).sum::<f64>()
        };
        (self.h_0, self.h_c) = (mix(self.h_0, &|other| other.h_0), mix(self.h_c, &|other| other.h_c));
        self.residual_estimate = mix(self.residual_estimate, &|other| other.residual_estimate);
        self.iterations += beside.iter().map(|(_, other)| other.iterations).sum::<usize>();
        let tractions: Option<f64> = beside.iter().map(|(share, other)| Some(share * other.traction?)).sum();
        self.traction = self.traction.zip(tractions).map(|(mine, others)| own * mine + others);
        // The error of a blend is the blend of the errors, at most.
        self.error = self.error.and_then(|mine| {
            let errors: Option<Vec<ErrorEstimate>> = beside.iter().map(|(_, other)| other.error).collect();
            let errors = errors?;
            let quantity = |of: &dyn Fn(&ErrorEstimate) -> Estimated| {
                let parts =
                    || std::iter::once((own, of(&mine))).chain(beside.iter().map(|b| b.0).zip(errors.iter().map(of)));
                Estimated {
                    likely: parts().map(|(share, part)| share * part.likely).sum(),
                    bound: parts().map(|(share, part)| share * part.bound).sum(),
                }
            };
            let (h_c, h_min, state) = (quantity(&|e| e.h_c), quantity(&|e| e.h_min), quantity(&|e| e.state));
            // All tell it, or none does: they are of one contact.
            let traction = mine.traction.map(|own| quantity(&|e| e.traction.unwrap_or(own)));
            Some(ErrorEstimate { h_c, h_min, state, traction, rise: None })
        });
        self.beside = beside;
    }
}
