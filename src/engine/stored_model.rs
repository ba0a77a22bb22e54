//! What a model file holds: bases, rows, operators, snapshots and the training scene, in postcard's encoding.
//!
//! K V_p is not stored: it is recomputed when a model is read. Bases are stored to an accuracy of the fields they make
//! ([`super::stored_matrix`]).

use super::model_file::ModelFileError;
use super::stored_matrix::{StoredBasis, StoredMatrix};
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec};
use crate::solver::physics::contact::{ContactKind, Ellipse};
use crate::solver::physics::lubricant::{Cavitation, ShearLaw, Sliding};
use crate::solver::reduced::{
    Beside, Calibration, Domain, ReducedModel, SampledRows, Sampling, Scheme, Shapes, SlidingDomain, Snapshot,
    TractionRule, Window,
};
use faer::Mat;
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

/// What follows a model whose films do not rupture by the penalty or whose steps are not Galerkin's; older files end
/// without it.
#[derive(Default, Serialize, Deserialize)]
struct StoredFurther {
    cavitation: Cavitation,
    /// Of every window and each of its snapshots the first ruptured column of each line along X; empty under a penalty.
    fronts: Vec<Vec<Vec<usize>>>,
    /// Of every window its scheme, and what GNAT makes of the residual.
    schemes: Vec<(Scheme, Option<StoredMatrix>)>,
}

/// What follows that in a model of ellipses; others end without it.
#[derive(Serialize, Deserialize)]
struct StoredShapes {
    /// R_y/R of the model.
    radius_ratio: (f64, f64),
    /// R_y/R of every window, and R_y \[m\] of each of its snapshots.
    windows: Vec<((f64, f64), Vec<f64>)>,
}

#[derive(Serialize, Deserialize)]
struct StoredWindow {
    m: (f64, f64),
    grid: GridSpec,
    penalty: f64,
    pressure: StoredBasis,
    deformation: StoredBasis,
    sampling: Sampling,
    sampled_rows: Vec<usize>,
    reconstruction: StoredMatrix,
    snapshots: Vec<Snapshot>,
    traction: Option<TractionRule>,
    calibration: Option<Calibration>,
}

/// Whether two numbers are the ends of an interval within 0…`most`.
fn sound_interval((low, high): (f64, f64), most: f64) -> bool {
    0.0 <= low && low <= high && high <= most
}

/// Whether a domain can be that of a model: one that knows sliding is of a lubricant that thins under shear, and only
/// such a one.
fn sound_domain(domain: &Domain) -> bool {
    let Domain { m, l, alpha_per_pa, max_hertz_pressure_pa, viscosity_pa_s, lubricant, sliding, .. } = domain;
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let thins = lubricant.shear != ShearLaw::Newtonian;
    let sliding_is_sound = |sliding: &SlidingDomain| {
        sound_interval(sliding.srr, f64::MAX) && sound_interval(sliding.npr, 1.0) && positive(sliding.modulus_pa)
    };
    thins == sliding.is_some()
        && lubricant.check().is_ok()
        && [m, l, alpha_per_pa].into_iter().all(|interval| sound_interval(*interval, f64::MAX))
        && [*max_hertz_pressure_pa, *viscosity_pa_s].into_iter().all(positive)
        && sliding.as_ref().is_none_or(sliding_is_sound)
}

/// Entries of node arrays on a grid, without building it.
fn entries(grid: &GridSpec) -> Result<usize, GridError> {
    Ok(match grid {
        GridSpec::Graded { nodes, .. } => nodes.saturating_add(1),
        GridSpec::Uniform { dx, domain: (from, to) } => (((to - from) / dx).round() as usize).saturating_add(2),
        GridSpec::Plane(spec) => spec.check().map(|(nx, ny)| nx * ny)?,
    })
}

/// Refuses what would take more memory than a model of so many bytes does, before anything of it is built: modes come
/// from snapshots, and every node of a grid has a byte at least.
fn check_counts(windows: &[StoredWindow], bytes: usize) -> Result<(), ModelFileError> {
    let mut nodes = 0usize;
    for window in windows {
        let rows = entries(&window.grid)?;
        nodes = nodes.saturating_add(rows);
        let fits = |basis: &StoredBasis| basis.rows() == rows && basis.columns() <= window.snapshots.len();
        if !(fits(&window.pressure) && fits(&window.deformation)) {
            return Err(ModelFileError::Damaged { what: "bases" });
        }
    }
    if nodes > bytes { Err(ModelFileError::Damaged { what: "grids" }) } else { Ok(()) }
}

/// Solves each window at two of its own snapshots, the first and the last.
///
/// # Errors
/// When a window does not give the H_c that it was trained from.
pub(super) fn prove(model: &ReducedModel) -> Result<(), ModelFileError> {
    let sliding = model.domain.sliding.is_some();
    let proven = |window: &Window| window.reproduces_snapshots(model.domain.lubricant, sliding);
    match model.windows.par_iter().find_first(|window| !proven(window)) {
        Some(window) => Err(ModelFileError::Unproven { m: window.m }),
        None => Ok(()),
    }
}

impl StoredWindow {
    fn into_window(
        self,
        grid: ContactGrid,
        sliding: bool,
        (scheme, residual): (Scheme, Option<StoredMatrix>),
    ) -> Result<Window, ModelFileError> {
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
        let (gnat, stored) = (matches!(scheme, Scheme::Gnat { .. }), self.reconstruction.rows());
        let equations = match scheme {
            Scheme::Galerkin => modes,
            Scheme::LeastSquares { .. } => 1,
            Scheme::Gnat { .. } => stored.max(modes).min(grid.unknowns()),
        };
        let Some(reconstruction) = self.reconstruction.into_mat(equations) else { return damaged("sampled rows") };
        let residual = residual.map(|residual| residual.into_mat(equations));
        let fits = |own: &Option<Mat<f64>>| own.as_ref().is_some_and(|own| own.ncols() == reconstruction.ncols());
        let enough = scheme == Scheme::Galerkin || reconstruction.ncols() > modes;
        if !enough || gnat != residual.is_some() || !residual.iter().all(fits) {
            return damaged("scheme");
        }
        let residual = residual.flatten();
        let rows_fit = self.sampled_rows.is_sorted_by(|a, b| a < b)
            && self.sampled_rows.last().is_some_and(|&r| r < grid.unknowns())
            && reconstruction.ncols() == self.sampled_rows.len();
        if !rows_fit {
            return damaged("sampled rows");
        }
        let snapshots_fit = self.snapshots.iter().all(|s| {
            let Sliding { slide_to_roll_ratio, newtonian_plateau_ratio } = s.point.sliding;
            s.point.check().is_ok()
                && s.point.kind == grid.kind()
                && slide_to_roll_ratio.is_finite()
                && newtonian_plateau_ratio.is_none_or(|ratio| (0.0..=1.0).contains(&ratio))
                && s.coefficients.len() == modes
                && s.coefficients.iter().chain([&s.h_0, &s.h_c]).all(|v| v.is_finite())
        });
        if !(self.penalty.is_finite() && self.penalty > 0.0) {
            return damaged("penalty");
        }
        if self.snapshots.is_empty() || !snapshots_fit {
            return damaged("snapshots");
        }
        if !self.traction.as_ref().is_none_or(|rule| sliding && rule.sound(&grid)) {
            return damaged("traction");
        }
        if !self
            .calibration
            .as_ref()
            .is_none_or(|known| known.sound() && (known.beside() == Some(Beside::Sliding)) == sliding)
        {
            return damaged("calibration");
        }
        let rows = SampledRows { rows: self.sampled_rows, reconstruction, scheme, residual };
        let mut window = Window::new(self.m, grid, pressure, deformation, self.snapshots, self.sampling, rows);
        (window.penalty, window.traction, window.calibration) = (self.penalty, self.traction, self.calibration);
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
                traction: w.traction.clone(),
                calibration: w.calibration.clone(),
            })
            .collect(),
        scene: model.scene.clone(),
        log: model.log.clone(),
    };
    let payload = postcard::to_allocvec(&stored).ok()?;
    let (windows, cavitation) = (&model.windows, model.domain.lubricant.cavitation);
    let usual = cavitation == Cavitation::Penalty && windows.iter().all(|window| window.scheme == Scheme::Galerkin);
    let shapes = stored_shapes(model);
    if usual && shapes.is_none() {
        return Some(payload);
    }
    let of_window = |window: &Window| window.snapshots.iter().map(|snapshot| snapshot.fronts.clone()).collect();
    let fronts = if cavitation == Cavitation::Penalty { Vec::new() } else { windows.iter().map(of_window).collect() };
    let scheme = |window: &Window| (window.scheme, window.residual_reconstruction.as_ref().map(StoredMatrix::exact));
    let schemes = windows.iter().map(scheme).collect();
    let payload = postcard::to_extend(&StoredFurther { cavitation, fronts, schemes }, payload).ok()?;
    match shapes {
        Some(shapes) => postcard::to_extend(&shapes, payload).ok(),
        None => Some(payload),
    }
}

/// What only a model of ellipses has.
fn stored_shapes(model: &ReducedModel) -> Option<StoredShapes> {
    let of_window = |window: &Window| {
        let radii = window.snapshots.iter().map(|s| s.point.radius_y_m.unwrap_or(s.point.radius_m));
        Some((window.shapes.as_ref()?.radius_ratio, radii.collect()))
    };
    let windows: Option<Vec<_>> = model.windows.iter().map(of_window).collect();
    Some(StoredShapes { radius_ratio: model.domain.radius_ratio, windows: windows.filter(|all| !all.is_empty())? })
}

/// Gives the windows of a model their shapes; `None` where these do not fit them.
fn shape(model: &mut ReducedModel, StoredShapes { radius_ratio, windows }: StoredShapes) -> Option<()> {
    let sound =
        |(low, high): (f64, f64)| Ellipse::of_ratio(low).is_ok() && Ellipse::of_ratio(high).is_ok() && low < high;
    if windows.len() != model.windows.len() || !sound(radius_ratio) || model.domain.sliding.is_some() {
        return None;
    }
    model.domain.radius_ratio = radius_ratio;
    for (window, (ratios, radii)) in model.windows.iter_mut().zip(windows) {
        let ContactGrid::Point(grid) = &window.grid else { return None };
        if !sound(ratios) || radii.len() != window.snapshots.len() || window.cavitation != Cavitation::Penalty {
            return None;
        }
        window.shapes = Some(Shapes::new(grid, &window.pressure.modes, ratios).ok()?);
        for (snapshot, radius_y) in window.snapshots.iter_mut().zip(radii) {
            snapshot.point.radius_y_m = Some(radius_y);
            snapshot.point.check().ok()?;
        }
    }
    Some(())
}

/// What follows the model in a payload; `None` where it cannot be understood.
fn further(rest: &[u8], windows: usize) -> Option<(StoredFurther, Option<StoredShapes>)> {
    let (mut further, mut shapes) = (StoredFurther::default(), None);
    if !rest.is_empty() {
        let (known, rest) = postcard::take_from_bytes::<StoredFurther>(rest).ok()?;
        if known.schemes.len() != windows {
            return None;
        }
        further = known;
        if !rest.is_empty() {
            let (known, rest) = postcard::take_from_bytes::<StoredShapes>(rest).ok()?;
            shapes = rest.is_empty().then_some(Some(known))?;
        }
    }
    further.schemes.resize_with(windows, Default::default);
    Some((further, shapes))
}

/// Gives the windows of a model their law of rupture; `None` where it does not fit them.
fn rupture(model: &mut ReducedModel, cavitation: Cavitation, fronts: Vec<Vec<Vec<usize>>>) -> Option<()> {
    if cavitation == Cavitation::Penalty {
        return fronts.is_empty().then_some(());
    }
    let ruptures = cavitation == Cavitation::Complementarity && model.domain.sliding.is_none();
    if !(ruptures && fronts.len() == model.windows.len()) {
        return None;
    }
    model.domain.lubricant.cavitation = cavitation;
    for (window, fronts) in model.windows.iter_mut().zip(fronts) {
        if fronts.len() != window.snapshots.len() {
            return None;
        }
        window.cavitation = cavitation;
        let (lines, columns) = (window.grid.lines(), window.grid.nodes().0);
        for (snapshot, fronts) in window.snapshots.iter_mut().zip(fronts) {
            if fronts.len() != lines || fronts.iter().any(|front| *front > columns) {
                return None;
            }
            snapshot.fronts = fronts;
        }
    }
    Some(())
}

/// The model of a payload.
///
/// # Errors
/// When its parts do not fit each other.
pub(super) fn decode(payload: &[u8]) -> Result<ReducedModel, ModelFileError> {
    let (stored, rest): (StoredModel, &[u8]) = postcard::take_from_bytes(payload)
        .map_err(|_| ModelFileError::Damaged { what: "its content cannot be decoded" })?;
    let StoredModel { mut title, domain, windows, scene, mut log } = stored;
    if !sound_domain(&domain) {
        return Err(ModelFileError::Damaged { what: "its domain" });
    }
    let damaged = |what| ModelFileError::Damaged { what };
    let (further, shapes) = further(rest, windows.len()).ok_or(damaged("rupture and schemes"))?;
    // Those of ellipses ascend for each shape.
    let ascending = shapes.is_some() || windows.is_sorted_by(|a, b| a.m.0 <= b.m.0);
    if !(ascending && windows.iter().all(|window| sound_interval(window.m, f64::MAX))) {
        return Err(ModelFileError::Damaged { what: "ranges of its windows" });
    }
    check_counts(&windows, payload.len())?;
    // They are shown on terminals.
    log.iter_mut().chain([&mut title]).for_each(|text| text.retain(|letter| !letter.is_control()));
    let grids = grids(&windows)?;
    let sliding = domain.sliding.is_some();
    let parts = windows.into_par_iter().zip(grids).zip(further.schemes);
    let windows: Vec<Window> =
        parts.map(|((w, grid), scheme)| w.into_window(grid, sliding, scheme)).collect::<Result<_, _>>()?;
    let Some(kind) = windows.first().map(|window| window.grid.kind()) else {
        return Err(ModelFileError::Damaged { what: "no windows" });
    };
    if windows.iter().any(|window| window.grid.kind() != kind) {
        return Err(ModelFileError::Damaged { what: "windows of different contacts" });
    }
    let mut model = ReducedModel { title, domain, windows, scene, log };
    rupture(&mut model, further.cavitation, further.fronts).ok_or(damaged("rupture"))?;
    if let Some(shapes) = shapes {
        shape(&mut model, shapes).ok_or(damaged("shapes"))?;
    }
    prove(&model)?;
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
