//! What windows around anchors have in a file beside what every window has.

use super::snapshots::give_each;
use super::sound::sound_interval;
use super::window::StoredWindow;
use crate::engine::former::domain::FormerOils;
use crate::engine::former::stored_matrix::{StoredBasis, StoredMatrix};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::GridCost;
use crate::solver::parameters::Metric;
use crate::solver::physics::contact::Moes;
use crate::solver::reduced::{Combined, PodBasis, ReducedModel, SharedBasis};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The oils of a model, and where its windows lie among them.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredOils {
    pub oils: FormerOils,
    /// Thinnest H_c.
    pub thinnest_film: f64,
    pub windows: Vec<StoredAnchor>,
}

/// The basis that the pressure modes of all windows are made of, and what those of each window are in it.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredSharedBasis {
    pub basis: StoredBasis,
    pub factors: Vec<StoredMatrix>,
}

/// Of every window what the grid costs H_c of each of its snapshots: by its ends, and by its spacing.
pub(super) type GridCosts = Vec<Vec<(f32, f32)>>;

/// A window around an anchor.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredAnchor {
    /// M and L of the anchor.
    moes: (f64, f64),
    /// The coefficients of its snapshots, snapshots × modes; no more than starts are made of them.
    coefficients: StoredMatrix,
}

impl StoredOils {
    /// The oils that a model was trained for.
    pub fn domain(&self) -> (FormerOils, f64) {
        (self.oils, self.thinnest_film)
    }
}

/// Gives the snapshots of a model's windows what their grid costs them; `None` where that does not fit them.
pub(super) fn give_grid_costs(windows: &mut [StoredWindow], costs: &GridCosts) -> Option<()> {
    let fits = |(window, costs): (&StoredWindow, &Vec<_>)| window.snapshots.len() == costs.len();
    if costs.len() != windows.len() || !windows.iter().zip(costs).all(fits) {
        return None;
    }
    for (window, costs) in windows.iter_mut().zip(costs) {
        for (snapshot, (truncation, resolution)) in window.snapshots.iter_mut().zip(costs) {
            let (truncation, resolution) = (f64::from(*truncation), f64::from(*resolution));
            snapshot.grid_cost = Some(GridCost { truncation, resolution });
        }
    }
    Some(())
}

/// Of each window what its pressure modes are made of; none where they are its own. `None` where that does not fit them.
pub(super) fn combined(
    windows: &[StoredWindow],
    grids: &[ContactGrid],
    shared: Option<StoredSharedBasis>,
) -> Option<Vec<Option<Combined>>> {
    let Some(StoredSharedBasis { basis, factors }) = shared else { return Some(vec![None; windows.len()]) };
    let grid = grids.first()?;
    let alike = grids.iter().all(|other| other.spec() == grid.spec());
    if !alike || factors.len() != windows.len() || basis.rows() != grid.len() {
        return None;
    }
    let basis = basis.into_basis(grid.len())?;
    let modes = basis.modes.ncols();
    let shared = Arc::new(SharedBasis::new(basis, grid));
    let of_window = |(factors, window): (StoredMatrix, &StoredWindow)| {
        let factors = factors.into_mat(modes).filter(|factors| factors.ncols() <= window.snapshots.len())?;
        Some(Some(Combined { shared: Arc::clone(&shared), factors }))
    };
    factors.into_iter().zip(windows).map(of_window).collect()
}

/// The deformation basis of each window; of windows around anchors those without one share that of the first. `None` where
/// one is damaged, or has no modes.
pub(super) fn deformations(
    windows: &mut [StoredWindow],
    grids: &[ContactGrid],
    anchored: bool,
) -> Option<Vec<Arc<PodBasis>>> {
    let own = windows.par_iter_mut().zip(grids).map(|(window, grid)| {
        let stored = std::mem::replace(&mut window.deformation, StoredBasis::elsewhere(grid.len()));
        if anchored && stored.columns() == 0 {
            return Some(None);
        }
        let basis = stored.into_basis(grid.len()).filter(|basis| basis.modes.ncols() > 0)?;
        Some(Some(Arc::new(basis)))
    });
    let own: Vec<Option<Arc<PodBasis>>> = own.collect::<Option<_>>()?;
    let first = own.first().cloned().flatten();
    own.into_iter().map(|own| own.or_else(|| first.clone())).collect()
}

/// Gives the snapshots of a model's windows their coefficients; `None` where they do not fit.
pub(super) fn give_coefficients(windows: &mut [StoredWindow], oils: &mut StoredOils) -> Option<()> {
    if windows.len() != oils.windows.len() {
        return None;
    }
    let each = windows.iter_mut().zip(&mut oils.windows);
    each.map(|(window, stored)| give_each(window, std::mem::take(&mut stored.coefficients))).collect()
}

/// Gives a model its oils and the anchors of its windows; `None` where these do not fit it.
pub(super) fn anchor(model: &mut ReducedModel, oils: &StoredOils) -> Option<()> {
    let anchors: Vec<(f64, f64)> = oils.windows.iter().map(|window| window.moes).collect();
    let placed = |&(m, l): &(f64, f64)| Moes { m, l }.check().is_ok();
    let grid = model.windows.first()?.grid.spec();
    let shared = model.windows.iter().all(|window| window.grid.spec() == grid);
    let fits = anchors.len() == model.windows.len() && anchors.iter().all(placed) && shared;
    if !fits {
        return None;
    }
    for (window, (m, l)) in model.windows.iter_mut().zip(anchors) {
        (window.anchor, window.metric) = (Some(Moes { m, l }), Metric::of_solutions(&model.domain.space));
    }
    Some(())
}
