//! What a model file holds: bases, rows, operators, snapshots and the training scene, in postcard's encoding.
//!
//! K V_p is not stored: it is recomputed when a model is read. Bases are stored to an accuracy of the fields they make
//! ([`super::stored_matrix`]).

use super::model_file::ModelFileError;
use super::stored_matrix::{StoredBasis, StoredMatrix};
use crate::solver::discrete::grid::{ContactGrid, ContactGridSpec};
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::{LimitingStress, Lubricant, ShearLaw, Sliding};
use crate::solver::reduced::{
    Calibration, Domain, ReducedModel, RollingCalibration, SampledRows, Sampling, SlidingDomain, Snapshot,
    TractionRule, Window,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Relative accuracy of pressures and deformations at every node to which the bases of a kind of contact are kept.
fn accuracy(kind: ContactKind) -> f64 {
    match kind {
        ContactKind::Line => 1e-13,
        ContactKind::Point => 2e-10,
    }
}

#[derive(Serialize, Deserialize)]
struct StoredModel {
    title: String,
    domain: Domain,
    windows: Vec<StoredWindow>,
    scene: String,
    log: Vec<String>,
}

/// What follows the model where its lubricant thins under shear.
#[derive(Serialize, Deserialize)]
struct StoredShear {
    law: ShearLaw,
    limiting_stress: Option<LimitingStress>,
    domain: SlidingDomain,
    /// Of the snapshots of each window.
    snapshots: Vec<Vec<Sliding>>,
}

/// What follows that where there is any, one of each window.
#[derive(Serialize, Deserialize)]
struct StoredTraction {
    rules: Vec<Option<TractionRule>>,
    calibrations: Vec<Option<Calibration>>,
}

#[derive(Serialize, Deserialize)]
struct StoredWindow {
    m: (f64, f64),
    grid: ContactGridSpec,
    penalty: f64,
    pressure: StoredBasis,
    deformation: StoredBasis,
    sampling: Sampling,
    sampled_rows: Vec<usize>,
    reconstruction: StoredMatrix,
    snapshots: Vec<Snapshot>,
    /// That of a model that knows sliding is kept with its traction.
    calibration: Option<RollingCalibration>,
}

impl StoredModel {
    /// Takes over what a shear-thinning lubricant adds.
    fn thin(&mut self, shear: StoredShear) -> Result<(), ModelFileError> {
        let StoredShear { law, limiting_stress, domain, snapshots } = shear;
        let lubricant = Lubricant { shear: law, limiting_stress, ..self.domain.lubricant };
        let ratios = |s: &Sliding| (s.slide_to_roll_ratio, s.newtonian_plateau_ratio.unwrap_or(0.0));
        let sound = |s: &Sliding| ratios(s).0.is_finite() && (0.0..=1.0).contains(&ratios(s).1);
        let fits = snapshots.len() == self.windows.len()
            && self.windows.iter().zip(&snapshots).all(|(window, sliding)| window.snapshots.len() == sliding.len())
            && snapshots.iter().flatten().all(sound);
        if !fits || law == ShearLaw::Newtonian || lubricant.check().is_err() {
            return Err(ModelFileError::Damaged { what: "shear-thinning" });
        }
        for (window, sliding) in self.windows.iter_mut().zip(snapshots) {
            for (snapshot, sliding) in window.snapshots.iter_mut().zip(sliding) {
                snapshot.point.sliding = sliding;
            }
        }
        self.domain.lubricant = lubricant;
        self.domain.sliding = Some(domain);
        Ok(())
    }
}

impl StoredTraction {
    /// Hands every window its own.
    fn give(self, windows: &mut [Window]) -> Result<(), ModelFileError> {
        let damaged = Err(ModelFileError::Damaged { what: "traction" });
        if [self.rules.len(), self.calibrations.len()] != [windows.len(); 2] {
            return damaged;
        }
        for ((window, rule), calibration) in windows.iter_mut().zip(self.rules).zip(self.calibrations) {
            let known = |c: &Calibration| c.sound() && c.sliding();
            if !rule.as_ref().is_none_or(|rule| rule.sound(&window.grid)) || !calibration.as_ref().is_none_or(known) {
                return damaged;
            }
            (window.traction, window.calibration) = (rule, calibration);
        }
        Ok(())
    }
}

impl StoredWindow {
    fn into_window(self, grid: ContactGrid) -> Result<Window, ModelFileError> {
        let nodes = grid.len();
        let damaged = |what| Err(ModelFileError::Damaged { what });
        let (Some(pressure), Some(deformation)) = (self.pressure.into_basis(nodes), self.deformation.into_basis(nodes))
        else {
            return damaged("bases");
        };
        let modes = pressure.modes.ncols();
        if modes == 0 || deformation.modes.ncols() == 0 {
            return damaged("bases");
        }
        let Some(reconstruction) = self.reconstruction.into_mat(modes) else { return damaged("sampled rows") };
        let rows_fit = self.sampled_rows.is_sorted_by(|a, b| a < b)
            && self.sampled_rows.last().is_some_and(|&r| r < grid.unknowns())
            && reconstruction.ncols() == self.sampled_rows.len();
        if !rows_fit {
            return damaged("sampled rows");
        }
        let snapshots_fit = self.snapshots.iter().all(|s| {
            s.point.check().is_ok()
                && s.point.kind == grid.kind()
                && s.coefficients.len() == modes
                && s.coefficients.iter().chain([&s.h_0, &s.h_c]).all(|v| v.is_finite())
        });
        if !(self.penalty.is_finite() && self.penalty > 0.0) {
            return damaged("penalty");
        }
        if self.snapshots.is_empty() || !snapshots_fit {
            return damaged("snapshots");
        }
        let calibration = self.calibration.map(Calibration::from);
        if !calibration.as_ref().is_none_or(Calibration::sound) {
            return damaged("calibration");
        }
        let rows = SampledRows { rows: self.sampled_rows, reconstruction };
        let mut window = Window::new(self.m, grid, pressure, deformation, self.snapshots, self.sampling, rows);
        (window.penalty, window.calibration) = (self.penalty, calibration);
        Ok(window)
    }
}

/// The payload of a model file; none where the model cannot be encoded.
pub(super) fn encode(model: &ReducedModel) -> Option<Vec<u8>> {
    let accuracy = accuracy(model.contact());
    let basis = |basis, grid: &ContactGrid| StoredBasis::new(basis, grid.nodes().1, accuracy);
    let stored = StoredModel {
        title: model.title.clone(),
        domain: model.domain.clone(),
        windows: model
            .windows
            .iter()
            .map(|w| StoredWindow {
                m: w.m,
                grid: w.grid.spec(),
                penalty: w.penalty,
                pressure: basis(&w.pressure, &w.grid),
                deformation: basis(&w.deformation, &w.grid),
                sampling: w.sampling,
                sampled_rows: w.sampled_rows.clone(),
                reconstruction: StoredMatrix::exact(&w.reconstruction),
                snapshots: w.snapshots.clone(),
                calibration: w.calibration.as_ref().and_then(|c| RollingCalibration::try_from(c).ok()),
            })
            .collect(),
        scene: model.scene.clone(),
        log: model.log.clone(),
    };
    let mut payload = postcard::to_allocvec(&stored).ok()?;
    if let Some(domain) = model.domain.sliding {
        let Lubricant { shear: law, limiting_stress, .. } = model.domain.lubricant;
        let of_window = |w: &Window| w.snapshots.iter().map(|snapshot| snapshot.point.sliding).collect();
        let snapshots = model.windows.iter().map(of_window).collect();
        let shear = StoredShear { law, limiting_stress, domain, snapshots };
        payload = postcard::to_extend(&shear, payload).ok()?;
        let traction = StoredTraction {
            rules: model.windows.iter().map(|w| w.traction.clone()).collect(),
            calibrations: model.windows.iter().map(|w| w.calibration.clone()).collect(),
        };
        if traction.rules.iter().any(Option::is_some) || traction.calibrations.iter().any(Option::is_some) {
            payload = postcard::to_extend(&traction, payload).ok()?;
        }
    }
    Some(payload)
}

/// The model of a payload.
///
/// # Errors
/// When its parts do not fit each other.
pub(super) fn decode(payload: &[u8]) -> Result<ReducedModel, ModelFileError> {
    let undecodable = |_| ModelFileError::Damaged { what: "its content cannot be decoded" };
    let (mut stored, rest): (StoredModel, &[u8]) = postcard::take_from_bytes(payload).map_err(undecodable)?;
    let mut traction = None;
    if !rest.is_empty() {
        let (shear, rest) = postcard::take_from_bytes(rest).map_err(undecodable)?;
        stored.thin(shear)?;
        if !rest.is_empty() {
            traction = Some(postcard::from_bytes::<StoredTraction>(rest).map_err(undecodable)?);
        }
    }
    let grids = grids(&stored.windows)?;
    let mut windows: Vec<Window> =
        stored.windows.into_par_iter().zip(grids).map(|(w, grid)| w.into_window(grid)).collect::<Result<_, _>>()?;
    let Some(kind) = windows.first().map(|window| window.grid.kind()) else {
        return Err(ModelFileError::Damaged { what: "no windows" });
    };
    if windows.iter().any(|window| window.grid.kind() != kind) {
        return Err(ModelFileError::Damaged { what: "windows of different contacts" });
    }
    if let Some(traction) = traction {
        traction.give(&mut windows)?;
    }
    let StoredModel { title, domain, scene, log, .. } = StoredModel { windows: Vec::new(), ..stored };
    Ok(ReducedModel { title, domain, windows, scene, log })
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
