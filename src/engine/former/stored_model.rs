//! What a model file holds: bases, rows, operators, snapshots and the training scene, in postcard's encoding.
//!
//! K V_p is not stored: it is recomputed when a model is read. Bases are stored to an accuracy of the fields they make
//! ([`super::stored_matrix`]).

mod calibrations;
mod oils;
mod parts;
mod rupture;
mod shapes;
mod snapshots;
mod sound;
mod window;

pub(super) use sound::{entries, sound_domain};
pub(super) use window::StoredRows;

use super::domain::{FormerDomain, Further};
use crate::engine::rom::ModelFileError;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::observer::Observer;
use crate::solver::reduced::{Domain, ReducedModel, Window};
use calibrations::give_calibrations;
use oils::{StoredOils, anchor, combined, deformations, give_coefficients, give_grid_costs};
use parts::Parts;
use rayon::prelude::*;
use rupture::rupture;
use serde::{Deserialize, Serialize};
use shapes::shape;
use snapshots::give_snapshots;
use sound::{check_counts, sound_interval};
use window::StoredWindow;

/// What every model has; its further [`Parts`] follow.
#[derive(Serialize, Deserialize)]
struct StoredModel {
    title: String,
    domain: FormerDomain,
    windows: Vec<StoredWindow>,
    scene: String,
    log: Vec<String>,
}

/// # Errors
/// When the observer cancels.
fn wanted(observer: &dyn Observer) -> Result<(), ModelFileError> {
    if observer.cancelled() { Err(ModelFileError::Cancelled) } else { Ok(()) }
}

/// The model of a payload; `older` where its parts have no names.
///
/// # Errors
/// When its parts do not fit each other, or when the observer cancels.
pub(super) fn decode(payload: &[u8], observer: &dyn Observer) -> Result<ReducedModel, ModelFileError> {
    let damaged = |what| ModelFileError::Damaged { what };
    let (stored, rest): (StoredModel, &[u8]) =
        postcard::take_from_bytes(payload).map_err(|_| damaged("its content cannot be decoded"))?;
    let StoredModel { mut title, domain: former, mut windows, scene, mut log } = stored;
    let parts = Parts::read(rest, windows.len()).ok_or(damaged("its parts"))?;
    let Parts {
        rupture: ruptures,
        schemes,
        shapes,
        mut oils,
        shared,
        grid_costs,
        heat,
        eyring,
        calibrations,
        snapshots,
        thermal,
    } = parts;
    let further = Further {
        oils: oils.as_ref().map(StoredOils::domain),
        heat: heat.as_ref().map(|(_, heat)| *heat),
        eyring,
        thermal,
        radius_ratio: shapes.as_ref().map(|shapes| shapes.radius_ratio),
    };
    let contact = windows.first().map(|window| window.grid.kind()).unwrap_or_default();
    let mut domain = Domain { contact, space: former.space(further), lubricant: former.lubricant };
    domain.lubricant.heat = heat.map(|(heat, _)| heat.into());
    if !sound_domain(&domain) {
        return Err(damaged("its domain"));
    }
    // Those of ellipses ascend for each shape, those around anchors with these.
    let ascending = shapes.is_some() || oils.is_some() || windows.is_sorted_by(|a, b| a.m.0 <= b.m.0);
    if !(ascending && windows.iter().all(|window| sound_interval(window.m, f64::MAX))) {
        return Err(damaged("ranges of its windows"));
    }
    if let Some(snapshots) = snapshots {
        give_snapshots(&mut windows, snapshots).ok_or(damaged("snapshots"))?;
    }
    check_counts(&windows, &domain, payload.len())?;
    if let Some(costs) = &grid_costs {
        give_grid_costs(&mut windows, costs).ok_or(damaged("costs of its grid"))?;
    }
    if let Some(calibrations) = calibrations {
        give_calibrations(&mut windows, calibrations).ok_or(damaged("calibration"))?;
    }
    if let Some(oils) = &mut oils {
        give_coefficients(&mut windows, oils).ok_or(damaged("oils"))?;
    }
    // They are shown on terminals.
    log.iter_mut().chain([&mut title]).for_each(|text| text.retain(|letter| !letter.is_control()));
    let grids = grids(&windows)?;
    wanted(observer)?;
    let combined = combined(&windows, &grids, shared).ok_or(damaged("shared bases"))?;
    let deformations = deformations(&mut windows, &grids, oils.is_some()).ok_or(damaged("bases"))?;
    let mut schemes = schemes.unwrap_or_default();
    schemes.resize_with(windows.len(), Default::default);
    let parts = windows.into_par_iter().zip(grids).zip(deformations).zip(schemes.into_par_iter().zip(combined));
    let windows: Vec<Window> = parts
        .map(|(((w, grid), deformation), further)| {
            wanted(observer)?;
            w.into_window(grid, &domain, deformation, further)
        })
        .collect::<Result<_, _>>()?;
    let Some(kind) = windows.first().map(|window| window.grid.kind()) else {
        return Err(damaged("no windows"));
    };
    if windows.iter().any(|window| window.grid.kind() != kind) {
        return Err(damaged("windows of different contacts"));
    }
    let mut model = ReducedModel { title, domain, windows, scene, log };
    if let Some(ruptures) = ruptures {
        rupture(&mut model, ruptures).ok_or(damaged("rupture"))?;
    }
    if let Some(shapes) = shapes {
        shape(&mut model, shapes).ok_or(damaged("shapes"))?;
    }
    if let Some(oils) = oils {
        anchor(&mut model, &oils).ok_or(damaged("oils"))?;
    }
    Ok(model)
}

/// The grid of each window. Building one is the costly part of reading a model, so equal ones are built once.
fn grids(windows: &[StoredWindow]) -> Result<Vec<ContactGrid>, ModelFileError> {
    let mut grids: Vec<ContactGrid> = Vec::with_capacity(windows.len());
    for window in windows {
        let grid = match grids.iter().find(|grid| grid.spec() == window.grid) {
            Some(built) => built.clone(),
            None => window.grid.build()?,
        };
        grids.push(grid);
    }
    Ok(grids)
}
