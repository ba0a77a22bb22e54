//! Local models around anchors in (ln M, ln L), with the Moes parameters M and L, for lubricant-parameterised models.
//!
//! Registered pressures vary most with ln M and ln L, three times less with ln p_H (Hertzian pressure p_H) over the
//! lubricant ranges, and little with Roelands' exponent z. A local model that is narrow in p_H or z hardly needs fewer
//! modes than a wide one. So local models are the cells of anchors in (ln M, ln L), for all lubricants.

use super::error_estimate::{ErrorEstimate, Estimated};
use super::model::{ReducedModel, Window};
use super::reduced_solution::ReducedSolution;
use crate::solver::full::GridCost;
use crate::solver::parameters::apart;
use crate::solver::physics::contact::{Moes, OperatingPoint};

/// Another local model is blended in if its anchor is at most this much farther than the nearest one, in ln M and ln L.
const BLENDED: f64 = 0.05;

/// Overlap of the training cells: contacts may lie this much farther away than the cell's border, so that blending
/// does not extrapolate.
pub(crate) const BEYOND_CELLS: f64 = 0.1;

/// Returns the distance of a contact from an anchor, in ln M and ln L.
pub(crate) fn from_anchor(moes: Moes, anchor: Moes) -> f64 {
    (moes.m / anchor.m).ln().hypot((moes.l / anchor.l).ln())
}

impl ReducedModel {
    /// Returns the local models that are blended with the nearest one near borders, with their shares. The shares
    /// start at zero, so that the blend is continuous.
    pub(super) fn blended(&self, moes: Moes) -> Vec<(f64, usize)> {
        // Thermal solutions are not blended.
        let Some(nearest) = self.nearest_anchor(moes).filter(|_| !self.domain.heats()) else { return Vec::new() };
        let far = |k: usize| self.windows[k].anchor.map_or(f64::INFINITY, |anchor| from_anchor(moes, anchor));
        let least = far(nearest);
        let share = |k: usize| (1.0 - (far(k) - least) / BLENDED).max(0.0).powi(2);
        let others = (0..self.windows.len()).filter(|k| *k != nearest).map(|k| (share(k), k));
        let others: Vec<(f64, usize)> = others.filter(|(share, _)| *share > 0.0).collect();
        let all = 1.0 + others.iter().map(|(share, _)| share).sum::<f64>();
        others.into_iter().map(|(share, k)| (share / all, k)).collect()
    }

    /// Returns the local model with the nearest anchor; `None` for a model without anchors.
    pub(super) fn nearest_anchor(&self, moes: Moes) -> Option<usize> {
        self.next_anchor(moes, usize::MAX)
    }

    /// Returns the local model with the nearest anchor except one.
    pub(super) fn next_anchor(&self, moes: Moes, except: usize) -> Option<usize> {
        let far = |(k, window): (usize, &Window)| window.anchor.map(|anchor| (k, from_anchor(moes, anchor)));
        let others = self.windows.iter().enumerate().filter(|(k, _)| *k != except);
        others.filter_map(far).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(k, _)| k)
    }
}

/// Number of training solutions from which the discretisation error is interpolated.
const NEIGHBOURS: usize = 8;

impl Window {
    /// Interpolates the discretisation error of the central film thickness H_c from the training solutions around a
    /// contact; `None` if they have none.
    pub fn grid_cost(&self, point: &OperatingPoint) -> Option<GridCost> {
        let place = self.metric.place(point);
        let known = self.snapshots.iter().filter_map(|snapshot| {
            let cost = snapshot.grid_cost.filter(|cost| cost.total().is_finite())?;
            Some((apart(place, self.metric.place(&snapshot.point)), cost))
        });
        let mut near: Vec<(f64, GridCost)> = known.collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        near.truncate(NEIGHBOURS);
        // Shepard's weights decrease with the fourth power of the distance.
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
    /// Returns the share of the solution's own local model in the blend.
    pub(super) fn own_share(&self) -> f64 {
        1.0 - self.beside.iter().map(|(share, _)| share).sum::<f64>()
    }

    /// Returns the rigid-body separation H₀ of the solution's own local model.
    pub(super) fn own_h_0(&self) -> f64 {
        let others = self.beside.iter().map(|(share, other)| share * other.h_0).sum::<f64>();
        (self.h_0 - others) / self.own_share()
    }

    /// Replaces the scalars by those of the blend with the solutions of `beside`.
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
        // The error of a blend is at most the blend of the errors.
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
            // All solutions have these estimates or none, since they are of one contact.
            let traction = mine.traction.map(|own| quantity(&|e| e.traction.unwrap_or(own)));
            let load_share = mine.load_share.map(|own| quantity(&|e| e.load_share.unwrap_or(own)));
            Some(ErrorEstimate { h_c, h_min, state, traction, rise: None, load_share })
        });
        self.beside = beside;
    }
}
