//! What a model file holds: bases, rows, operators, snapshots and the training scene, in postcard's encoding.
//!
//! K V_p is not stored: it is recomputed when a model is read. Bases are stored to an accuracy of the fields they make
//! ([`super::stored_matrix`]).

use super::model_file::ModelFileError;
use super::stored_heat::StoredHeat;
use super::stored_matrix::{StoredBasis, StoredMatrix};
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec};
use crate::solver::full::GridCost;
use crate::solver::observer::Observer;
use crate::solver::physics::contact::{ContactKind, Ellipse, Moes};
use crate::solver::physics::lubricant::{Cavitation, LARGEST_HEATED_SRR, ShearLaw, Sliding};
use crate::solver::reduced::{
    Beside, CIRCLES, Calibration, Combined, Domain, EyringDomain, HeatDomain, OilDomain, PodBasis, PressureModes,
    ReducedModel, SampledRows, Sampling, Scheme, Shapes, SharedBasis, SlidingDomain, Snapshot, TractionRule, Window,
};
use faer::Mat;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Relative accuracy of pressures at every node to which the basis of a window is kept.
fn accuracy(window: &Window, heat: bool) -> f64 {
    match (window.grid.kind(), &window.shapes) {
        // Temperatures are not known to more.
        (ContactKind::Line, _) if window.anchor.is_some() && heat => 1e-10,
        // These have dozens of windows, and thin films under heavy loads: at 1e-8 Newtonian ones lost more than their modes
        // miss, at 1e-10 sliding ones up to a tenth of the film, at 1e-11 nothing of it.
        (ContactKind::Line, _) if window.anchor.is_some() => 1e-11,
        (ContactKind::Line, _) => 1e-13,
        // Their modes miss a thousand times more; at 1e-7 the thinnest films were off by 4e-3.
        (ContactKind::Point, None) if window.anchor.is_some() => 1e-8,
        (ContactKind::Point, None) => 2e-9,
        // These have many windows, and K V is interpolated over the shapes.
        (ContactKind::Point, Some(_)) => 1e-7,
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

/// What follows that, with a word for no ellipses, in a model of many oils; others end without it.
#[derive(Serialize, Deserialize)]
struct StoredOils {
    oils: OilDomain,
    windows: Vec<StoredAnchor>,
}

/// What follows that, with words for no ellipses and no oils, in a model of contacts with heat, or what oils have in
/// common in one of many oils with heat; others end without it.
#[derive(Serialize, Deserialize)]
struct StoredHeated {
    heat: StoredHeat,
    srr: (f64, f64),
    /// The smallest R and E′.
    radius_m: f64,
    modulus_pa: f64,
}

/// What follows that in a model of many oils.
#[derive(Serialize, Deserialize)]
struct StoredHeatedOils {
    largest_radius_m: f64,
    largest_modulus_pa: f64,
    speed_m_per_s: (f64, f64),
    fastest_sliding_m_per_s: f64,
}

/// What follows what oils have in common in a model of oils that thin under shear by Eyring's law; others end without it.
#[derive(Serialize, Deserialize)]
struct StoredEyring {
    /// T₀ \[K\] of a model with heat, which would begin with it: none.
    no_inlet_temperature: f64,
    srr: (f64, f64),
    modulus_pa: (f64, f64),
    limit_slope: (f64, f64),
    gradient_stress_pa: f64,
}

/// What follows the oils of a model whose pressure modes are made of one basis, or that leaves thin films out, or has heat
/// or Eyring's law; others end without it.
#[derive(Default, Serialize, Deserialize)]
struct StoredInCommon {
    thinnest_film: f64,
    /// The basis, and of every window what its modes are in it.
    pressure: Option<(StoredBasis, Vec<StoredMatrix>)>,
    /// Of every window what the grid costs H_c of each of its snapshots: by its ends, and by its spacing.
    grid_costs: Vec<Vec<(f32, f32)>>,
}

/// A window around an anchor.
#[derive(Serialize, Deserialize)]
struct StoredAnchor {
    /// M and L of the anchor.
    moes: (f64, f64),
    /// The coefficients of its snapshots, snapshots × modes; no more than starts are made of them.
    coefficients: StoredMatrix,
}

/// Accuracy of the deformations of a plane, relative as that of pressures: their bases end at modes that are common, and no
/// mobility multiplies what they lose. Those of a line go on to rare ones, and are kept as its pressures.
const BENT_ACCURACY: f64 = 1e-6;

/// Accuracy of what an interpolation makes of the values of its rows, relative to what it makes of all for a mode.
const ROWS_ACCURACY: f64 = 1e-6;

/// Accuracy of the coefficients of snapshots from which a model of many oils starts, relative to each one's own size.
const START_ACCURACY: f64 = 1e-4;

/// Accuracy of the share of each mode of a shared basis in the pressures of a window.
const FACTOR_ACCURACY: f64 = 1e-7;

#[derive(Serialize, Deserialize)]
struct StoredWindow {
    m: (f64, f64),
    grid: GridSpec,
    penalty: f64,
    pressure: StoredBasis,
    /// Of windows around anchors the first one has it for all.
    deformation: StoredBasis,
    sampling: Sampling,
    sampled_rows: Vec<usize>,
    reconstruction: StoredMatrix,
    snapshots: Vec<Snapshot>,
    traction: Option<TractionRule>,
    calibration: Option<Calibration>,
}

/// Sampled rows on their way to or from a file, with the scheme that they serve.
#[derive(Serialize, Deserialize)]
pub(super) struct StoredRows {
    pub rows: Vec<usize>,
    pub reconstruction: StoredMatrix,
    pub scheme: Scheme,
    /// What GNAT makes of the residual.
    pub residual: Option<StoredMatrix>,
}

impl StoredRows {
    /// The rows of a model with so many modes on a grid.
    ///
    /// # Errors
    /// When they do not fit it or each other.
    pub fn into_rows(self, modes: usize, grid: &ContactGrid) -> Result<SampledRows, ModelFileError> {
        let damaged = |what| Err(ModelFileError::Damaged { what });
        let Self { rows, reconstruction, scheme, residual } = self;
        let (gnat, stored) = (matches!(scheme, Scheme::Gnat { .. }), reconstruction.rows());
        let equations = match scheme {
            Scheme::Galerkin => modes,
            Scheme::LeastSquares { .. } => 1,
            Scheme::Gnat { .. } => stored.max(modes).min(grid.unknowns()),
        };
        let Some(reconstruction) = reconstruction.into_mat(equations) else { return damaged("sampled rows") };
        let residual = residual.map(|residual| residual.into_mat(equations));
        let fits = |own: &Option<Mat<f64>>| own.as_ref().is_some_and(|own| own.ncols() == reconstruction.ncols());
        let enough = scheme == Scheme::Galerkin || reconstruction.ncols() > modes;
        if !enough || gnat != residual.is_some() || !residual.iter().all(fits) {
            return damaged("scheme");
        }
        if !are_rows(&rows, grid) || reconstruction.ncols() != rows.len() {
            return damaged("sampled rows");
        }
        Ok(SampledRows { rows, reconstruction, scheme, residual: residual.flatten() })
    }
}

/// Whether a grid has these rows, at least one, in ascending order.
fn are_rows(rows: &[usize], grid: &ContactGrid) -> bool {
    rows.is_sorted_by(|a, b| a < b) && rows.last().is_some_and(|&row| row < grid.unknowns())
}

/// Whether two numbers are the ends of an interval within 0…`most`.
fn sound_interval((low, high): (f64, f64), most: f64) -> bool {
    0.0 <= low && low <= high && high <= most
}

/// Whether a domain can be that of a model: one that knows sliding is of a lubricant that thins under shear, and only
/// such a one, unless it knows heat.
pub(super) fn sound_domain(domain: &Domain) -> bool {
    let Domain { m, l, alpha_per_pa, max_hertz_pressure_pa, viscosity_pa_s, lubricant, sliding, heat, .. } = domain;
    let positive = |value: f64| value > 0.0 && value.is_finite();
    let thins = lubricant.shear != ShearLaw::Newtonian;
    let eyring_is_sound = |EyringDomain { srr, modulus_pa, limit_slope, gradient_stress_pa }: &EyringDomain| {
        let intervals = [(*srr, f64::MAX), (*modulus_pa, f64::MAX), (*limit_slope, 1.0)];
        let law = matches!(lubricant.shear, ShearLaw::Eyring { .. }) && sliding.is_none() && heat.is_none();
        let sizes = positive(modulus_pa.0) && positive(*gradient_stress_pa);
        law && sizes && intervals.into_iter().all(|(interval, most)| sound_interval(interval, most))
    };
    let sliding_is_sound = |sliding: &SlidingDomain| {
        sound_interval(sliding.srr, f64::MAX) && sound_interval(sliding.npr, 1.0) && positive(sliding.modulus_pa)
    };
    let heat_is_sound = |heat: &HeatDomain| {
        let kind = sliding.is_none() && lubricant.heat.is_some();
        let (radius, modulus) = ((heat.radius_m, f64::MAX), (heat.modulus_pa, f64::MAX));
        let intervals = [(heat.srr, LARGEST_HEATED_SRR), radius, modulus, (heat.speed_m_per_s, f64::INFINITY)];
        let lowest = [heat.radius_m.0, heat.modulus_pa.0].into_iter().all(positive);
        let sound = |(interval, most)| sound_interval(interval, most);
        kind && lowest && heat.fastest_sliding_m_per_s > 0.0 && intervals.into_iter().all(sound)
    };
    (heat.is_some() || thins == domain.thins())
        && domain.eyring.as_ref().is_none_or(eyring_is_sound)
        && heat.as_ref().is_none_or(heat_is_sound)
        && lubricant.check().is_ok()
        && [m, l, alpha_per_pa].into_iter().all(|interval| sound_interval(*interval, f64::MAX))
        && [*max_hertz_pressure_pa, *viscosity_pa_s].into_iter().all(positive)
        && sliding.as_ref().is_none_or(sliding_is_sound)
}

/// Entries of node arrays on a grid, without building it.
pub(super) fn entries(grid: &GridSpec) -> Result<usize, GridError> {
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
    let all = windows.iter().map(|window| window.snapshots.len()).sum();
    for window in windows {
        let rows = entries(&window.grid)?;
        nodes = nodes.saturating_add(rows);
        let fits = |basis: &StoredBasis, most: usize| basis.rows() == rows && basis.columns() <= most;
        if !(fits(&window.pressure, window.snapshots.len()) && fits(&window.deformation, all)) {
            return Err(ModelFileError::Damaged { what: "bases" });
        }
    }
    if nodes > bytes { Err(ModelFileError::Damaged { what: "grids" }) } else { Ok(()) }
}

/// Solves each window at two of its own snapshots, the first and the last.
///
/// # Errors
/// When a window does not give the H_c that it was trained from, or when the observer cancels.
pub(super) fn prove(model: &ReducedModel, observer: &dyn Observer) -> Result<(), ModelFileError> {
    let windows = model.windows.par_iter().enumerate();
    let proved = windows.map(|(k, window)| {
        wanted(observer)?;
        if model.reproduces_snapshots(k) { Ok(()) } else { Err(ModelFileError::Unproven { m: window.m }) }
    });
    proved.collect::<Vec<_>>().into_iter().collect()
}

/// # Errors
/// When the observer cancels.
fn wanted(observer: &dyn Observer) -> Result<(), ModelFileError> {
    if observer.cancelled() { Err(ModelFileError::Cancelled) } else { Ok(()) }
}

impl StoredWindow {
    fn into_window(
        self,
        grid: ContactGrid,
        domain: &Domain,
        deformation: Arc<PodBasis>,
        ((scheme, residual), combined): ((Scheme, Option<StoredMatrix>), Option<Combined>),
    ) -> Result<Window, ModelFileError> {
        let nodes = grid.len();
        let damaged = |what| Err(ModelFileError::Damaged { what });
        let pressure = match combined {
            Some(combined) => self.pressure.into_singular_values().map(|values| combined.into_modes(values)),
            None => self.pressure.into_basis(nodes).map(|basis| PressureModes::own(basis, &grid)),
        };
        let Some(pressure) = pressure else { return damaged("bases") };
        let modes = pressure.count();
        if modes == 0 {
            return damaged("bases");
        }
        // What they make may have to be told by the modes there.
        if !are_rows(&self.sampled_rows, &grid) {
            return damaged("sampled rows");
        }
        let of_rows = || modes_at(&grid, &pressure, &self.sampled_rows);
        let Some(reconstruction) = self.reconstruction.of_modes(of_rows) else { return damaged("sampled rows") };
        let stored = StoredRows { rows: self.sampled_rows, reconstruction, scheme, residual };
        let rows = stored.into_rows(modes, &grid)?;
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
        let (thins, heat) = (domain.thins(), domain.heat.is_some());
        let slides = thins || heat;
        // Older ones of contacts that do not slide know less of them.
        let of_kind = |known: &Calibration| {
            if slides { known.is_of(Beside::of(domain)) } else { !known.is_of(Beside::Sliding) }
        };
        if heat && scheme != Scheme::Galerkin {
            return damaged("heat");
        }
        if !self.traction.as_ref().is_none_or(|rule| slides && rule.sound(&grid)) {
            return damaged("traction");
        }
        if !self.calibration.as_ref().is_none_or(|known| known.sound() && of_kind(known)) {
            return damaged("calibration");
        }
        let mut window = Window::new(self.m, grid, pressure, deformation, self.snapshots, self.sampling, rows);
        (window.penalty, window.traction, window.calibration) = (self.penalty, self.traction, self.calibration);
        Ok(window)
    }
}

/// The payload of a model file; none where the model cannot be encoded.
pub(super) fn encode(model: &ReducedModel) -> Option<Vec<u8>> {
    let heat = model.domain.heat.is_some();
    let basis =
        |basis: &PodBasis, window: &Window| StoredBasis::new(basis, window.grid.nodes().1, accuracy(window, heat));
    let first = model.windows.first();
    let deformation = |k: usize, window: &Window| match first {
        Some(first) if k > 0 && shares_deformation(window, first) => StoredBasis::elsewhere(window.grid.len()),
        _ if window.grid.kind() == ContactKind::Line => basis(&window.deformation, window),
        _ => StoredBasis::new(&window.deformation, window.grid.nodes().1, BENT_ACCURACY),
    };
    let shared = model.windows.iter().all(|window| window.pressure.combined().is_some());
    let stored = StoredModel {
        title: model.title.clone(),
        domain: model.domain.clone(),
        windows: model
            .windows
            .iter()
            .enumerate()
            .map(|(k, w)| StoredWindow {
                m: w.m,
                grid: w.grid.spec(),
                penalty: w.penalty,
                pressure: match w.pressure.combined() {
                    Some(_) if shared => StoredBasis::without_modes(w.pressure.singular_values(), w.grid.len()),
                    _ => basis(w.pressure.basis(), w),
                },
                deformation: deformation(k, w),
                sampling: w.sampling,
                sampled_rows: w.sampled_rows.clone(),
                reconstruction: stored_reconstruction(w, heat),
                snapshots: w.snapshots.iter().map(|snapshot| without_coefficients(snapshot, w)).collect(),
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
    let (shapes, oils, heated) = (stored_shapes(model), stored_oils(model), stored_heat(model));
    let eyring = stored_eyring(model);
    if usual && shapes.is_none() && oils.is_none() && heated.is_none() {
        return Some(payload);
    }
    let of_window = |window: &Window| window.snapshots.iter().map(|snapshot| snapshot.fronts.clone()).collect();
    let fronts = if cavitation == Cavitation::Penalty { Vec::new() } else { windows.iter().map(of_window).collect() };
    let scheme = |window: &Window| (window.scheme, window.residual_reconstruction.as_ref().map(StoredMatrix::exact));
    let schemes = windows.iter().map(scheme).collect();
    let payload = postcard::to_extend(&StoredFurther { cavitation, fronts, schemes }, payload).ok()?;
    let circles = || StoredShapes { radius_ratio: CIRCLES, windows: Vec::new() };
    match (shapes, oils, heated) {
        (Some(shapes), ..) => postcard::to_extend(&shapes, payload).ok(),
        (None, Some(oils), heated) => {
            let payload = postcard::to_extend(&oils, postcard::to_extend(&circles(), payload).ok()?).ok()?;
            let in_common = stored_in_common(model);
            if in_common.is_none() && heated.is_none() && eyring.is_none() {
                return Some(payload);
            }
            let payload = postcard::to_extend(&in_common.unwrap_or_default(), payload).ok()?;
            match (heated, eyring) {
                (Some(heated), _) => postcard::to_extend(&heated, payload).ok(),
                (None, Some(eyring)) => postcard::to_extend(&eyring, payload).ok(),
                (None, None) => Some(payload),
            }
        }
        (None, None, Some((heated, _))) => {
            let payload = postcard::to_extend(&circles(), payload).ok()?;
            postcard::to_extend(&heated, postcard::to_extend(&StoredOils::none(), payload).ok()?).ok()
        }
        (None, None, None) => Some(payload),
    }
}

/// What a window makes of its rows' values. Windows that come by the dozen, and those with heat, keep what a cubature makes
/// as its weights, and what others make to six digits.
fn stored_reconstruction(window: &Window, heat: bool) -> StoredMatrix {
    let exact = &window.reconstruction;
    if window.anchor.is_none() && window.shapes.is_none() && !heat {
        return StoredMatrix::exact(exact);
    }
    let rule = || StoredMatrix::weights(exact, &modes_at(&window.grid, &window.pressure, &window.sampled_rows));
    let rule = if window.sampling == Sampling::Cubature { rule() } else { None };
    rule.unwrap_or_else(|| StoredMatrix::stepped(exact, 1, &vec![1.0; exact.ncols()], ROWS_ACCURACY))
}

/// What all modes are at the nodes of sampled rows.
fn modes_at(grid: &ContactGrid, pressure: &PressureModes, rows: &[usize]) -> Mat<f64> {
    let nodes: Vec<usize> = rows.iter().map(|&row| grid.node(row)).collect();
    pressure.at(&nodes, pressure.count())
}

/// Whether a window around an anchor has the very deformation basis of another one.
fn shares_deformation(window: &Window, other: &Window) -> bool {
    let equal = || window.deformation.modes == other.deformation.modes;
    let same = || Arc::ptr_eq(&window.deformation, &other.deformation) || equal();
    window.anchor.is_some() && window.grid.spec() == other.grid.spec() && same()
}

impl StoredHeatedOils {
    /// Of bodies of one radius, at any speed.
    fn of_one_radius(known: &StoredHeated) -> Self {
        Self {
            largest_radius_m: known.radius_m,
            largest_modulus_pa: known.modulus_pa,
            speed_m_per_s: (0.0, f64::INFINITY),
            fastest_sliding_m_per_s: f64::INFINITY,
        }
    }
}

impl StoredOils {
    /// The word for no oils.
    fn none() -> Self {
        let none = (0.0, 0.0);
        Self {
            oils: OilDomain { viscosity_pa_s: none, exponent: none, lowest_hertz_pressure_pa: 0.0, thinnest_film: 0.0 },
            windows: Vec::new(),
        }
    }
}

/// What only a model of contacts with heat has.
fn stored_heat(model: &ReducedModel) -> Option<(StoredHeated, StoredHeatedOils)> {
    let HeatDomain { srr, radius_m, modulus_pa, speed_m_per_s, fastest_sliding_m_per_s } = model.domain.heat?;
    let ((radius_m, largest_radius_m), (modulus_pa, largest_modulus_pa)) = (radius_m, modulus_pa);
    let heat = model.domain.lubricant.heat?.into();
    let further = StoredHeatedOils { largest_radius_m, largest_modulus_pa, speed_m_per_s, fastest_sliding_m_per_s };
    Some((StoredHeated { heat, srr, radius_m, modulus_pa }, further))
}

/// What only a model of oils that thin by Eyring's law has.
fn stored_eyring(model: &ReducedModel) -> Option<StoredEyring> {
    let EyringDomain { srr, modulus_pa, limit_slope, gradient_stress_pa } = model.domain.eyring?;
    Some(StoredEyring { no_inlet_temperature: 0.0, srr, modulus_pa, limit_slope, gradient_stress_pa })
}

/// A snapshot as its window keeps it: coefficients of windows around anchors have a place of their own.
fn without_coefficients(snapshot: &Snapshot, window: &Window) -> Snapshot {
    if window.anchor.is_none() {
        return snapshot.clone();
    }
    Snapshot { coefficients: Vec::new(), fronts: Vec::new(), ..*snapshot }
}

/// What only a model of many oils has.
fn stored_oils(model: &ReducedModel) -> Option<StoredOils> {
    let stored = |window: &Window| {
        let Moes { m, l } = window.anchor?;
        let (snapshots, modes) = (&window.snapshots, window.pressure.count());
        let of = |i: usize, k: usize| snapshots.get(i)?.coefficients.get(k).copied();
        let coefficients = Mat::from_fn(snapshots.len(), modes, |i, k| of(i, k).unwrap_or_default());
        let size = |k: usize| (coefficients.col(k).squared_norm_l2() / snapshots.len() as f64).sqrt();
        let scales: Vec<f64> = (0..modes).map(|k| 1.0 / size(k).max(f64::MIN_POSITIVE)).collect();
        let coefficients = StoredMatrix::stepped(&coefficients, 1, &scales, START_ACCURACY);
        Some(StoredAnchor { moes: (m, l), coefficients })
    };
    Some(StoredOils { oils: model.domain.oils?, windows: model.windows.iter().map(stored).collect::<Option<_>>()? })
}

/// What the windows of a model of many oils share beside the deformation basis, and which films it leaves out; none where
/// that is nothing.
fn stored_in_common(model: &ReducedModel) -> Option<StoredInCommon> {
    let thinnest_film = model.domain.oils?.thinnest_film;
    let combined: Option<Vec<&Combined>> = model.windows.iter().map(|window| window.pressure.combined()).collect();
    let pressure = combined.filter(|all| !all.is_empty()).and_then(|all| {
        let (window, shared) = (model.windows.first()?, &all.first()?.shared);
        let basis =
            StoredBasis::new(&shared.basis, window.grid.nodes().1, accuracy(window, model.domain.heat.is_some()));
        Some((basis, model.windows.iter().zip(all).map(|(window, own)| stored_factors(window, own)).collect()))
    });
    let cost = |snapshot: &Snapshot| snapshot.grid_cost.map(|cost| (cost.truncation as f32, cost.resolution as f32));
    let costs: Option<Vec<Vec<_>>> =
        model.windows.iter().map(|window| window.snapshots.iter().map(cost).collect()).collect();
    let any = thinnest_film > 0.0 || pressure.is_some() || costs.is_some();
    any.then(|| StoredInCommon { thinnest_film, pressure, grid_costs: costs.unwrap_or_default() })
}

/// What a window's modes are in the shared basis: of each mode of that as exactly as it appears in the window.
fn stored_factors(window: &Window, combined: &Combined) -> StoredMatrix {
    let (factors, count) = (&combined.factors, window.pressure.singular_values().len() as f64);
    let sizes = window.pressure.singular_values().iter().take(factors.ncols());
    let scales: Vec<f64> = sizes.map(|sigma| (sigma / count.sqrt()).max(f64::MIN_POSITIVE)).collect();
    StoredMatrix::stepped(factors, 1, &scales, FACTOR_ACCURACY)
}

/// Gives the snapshots of a model's windows what their grid costs them; `None` where that does not fit them.
fn give_grid_costs(windows: &mut [StoredWindow], costs: &[Vec<(f32, f32)>]) -> Option<()> {
    if costs.is_empty() {
        return Some(());
    }
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
fn combined(
    windows: &[StoredWindow],
    grids: &[ContactGrid],
    in_common: Option<StoredInCommon>,
) -> Option<Vec<Option<Combined>>> {
    let Some((basis, factors)) = in_common.and_then(|in_common| in_common.pressure) else {
        return Some(vec![None; windows.len()]);
    };
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
fn deformations(windows: &mut [StoredWindow], grids: &[ContactGrid], anchored: bool) -> Option<Vec<Arc<PodBasis>>> {
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
fn give_coefficients(windows: &mut [StoredWindow], oils: &mut StoredOils) -> Option<()> {
    if windows.len() != oils.windows.len() {
        return None;
    }
    for (window, stored) in windows.iter_mut().zip(&mut oils.windows) {
        let coefficients = std::mem::take(&mut stored.coefficients).into_mat(window.snapshots.len())?;
        for (i, snapshot) in window.snapshots.iter_mut().enumerate() {
            snapshot.coefficients = coefficients.row(i).iter().copied().collect();
        }
    }
    Some(())
}

/// Gives a model its oils and the anchors of its windows; `None` where these do not fit it.
fn anchor(model: &mut ReducedModel, StoredOils { oils, windows }: StoredOils) -> Option<()> {
    let anchors: Vec<(f64, f64)> = windows.iter().map(|window| window.moes).collect();
    let OilDomain { viscosity_pa_s, exponent, lowest_hertz_pressure_pa: lowest, .. } = oils;
    let sound = [viscosity_pa_s, exponent, (lowest, model.domain.max_hertz_pressure_pa)]
        .into_iter()
        .all(|interval| sound_interval(interval, f64::MAX))
        && sound_interval((0.0, oils.thinnest_film), f64::MAX);
    let placed = |&(m, l): &(f64, f64)| Moes { m, l }.check().is_ok();
    let grid = model.windows.first()?.grid.spec();
    let shared = model.windows.iter().all(|window| window.grid.spec() == grid);
    let fits = anchors.len() == model.windows.len() && anchors.iter().all(placed) && shared;
    if !(sound && fits) || model.domain.sliding.is_some() {
        return None;
    }
    for (window, (m, l)) in model.windows.iter_mut().zip(anchors) {
        (window.anchor, window.thins) = (Some(Moes { m, l }), model.domain.eyring.is_some());
    }
    Some(())
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
    let windows: Vec<_> = model.windows.iter_mut().zip(windows).collect();
    windows.into_par_iter().try_for_each(|(window, (ratios, radii))| {
        let ContactGrid::Point(grid) = &window.grid else { return None };
        if !sound(ratios) || radii.len() != window.snapshots.len() || window.cavitation != Cavitation::Penalty {
            return None;
        }
        window.shapes = Some(Shapes::new(grid, &window.pressure.basis().modes, ratios).ok()?);
        for (snapshot, radius_y) in window.snapshots.iter_mut().zip(radii) {
            snapshot.point.radius_y_m = Some(radius_y);
            snapshot.point.check().ok()?;
        }
        Some(())
    })
}

/// What follows a model in a payload.
#[derive(Default)]
struct Further {
    further: StoredFurther,
    shapes: Option<StoredShapes>,
    oils: Option<StoredOils>,
    in_common: Option<StoredInCommon>,
    heated: Option<(StoredHeated, StoredHeatedOils)>,
    eyring: Option<StoredEyring>,
}

/// What follows the model in a payload; `None` where it cannot be understood.
fn further(rest: &[u8], windows: usize) -> Option<Further> {
    let Further { mut further, mut shapes, mut oils, mut in_common, mut heated, mut eyring } = Further::default();
    if !rest.is_empty() {
        let (known, rest) = postcard::take_from_bytes::<StoredFurther>(rest).ok()?;
        if known.schemes.len() != windows {
            return None;
        }
        further = known;
        if !rest.is_empty() {
            let (known, rest) = postcard::take_from_bytes::<StoredShapes>(rest).ok()?;
            if rest.is_empty() {
                shapes = Some(known);
            } else {
                let (known_oils, rest) = postcard::take_from_bytes::<StoredOils>(rest).ok()?;
                let of_circles = known.windows.is_empty() && known.radius_ratio == CIRCLES;
                if rest.is_empty() {
                    oils = of_circles.then_some(Some(known_oils))?;
                } else if !known_oils.windows.is_empty() {
                    let (known, rest) = postcard::take_from_bytes::<StoredInCommon>(rest).ok()?;
                    in_common = of_circles.then_some(Some(known))?;
                    oils = Some(known_oils);
                    let without_heat = |known: &StoredEyring| known.no_inlet_temperature == 0.0;
                    let thins = postcard::take_from_bytes(rest).ok().filter(|(known, _)| without_heat(known));
                    if let Some((known, rest)) = thins {
                        eyring = rest.is_empty().then_some(Some(known))?;
                    } else if !rest.is_empty() {
                        let (known, rest) = postcard::take_from_bytes::<(StoredHeated, StoredHeatedOils)>(rest).ok()?;
                        heated = rest.is_empty().then_some(Some(known))?;
                    }
                } else {
                    let (known, rest) = postcard::take_from_bytes::<StoredHeated>(rest).ok()?;
                    let alone = rest.is_empty() && of_circles;
                    let of_one = StoredHeatedOils::of_one_radius(&known);
                    heated = alone.then_some(Some((known, of_one)))?;
                }
            }
        }
    }
    further.schemes.resize_with(windows, Default::default);
    Some(Further { further, shapes, oils, in_common, heated, eyring })
}

/// Gives the windows of a model their law of rupture; `None` where it does not fit them.
fn rupture(model: &mut ReducedModel, cavitation: Cavitation, fronts: Vec<Vec<Vec<usize>>>) -> Option<()> {
    if cavitation == Cavitation::Penalty {
        return fronts.is_empty().then_some(());
    }
    let ruptures = cavitation == Cavitation::Complementarity && !model.slides();
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
/// When its parts do not fit each other, or when the observer cancels.
pub(super) fn decode(payload: &[u8], observer: &dyn Observer) -> Result<ReducedModel, ModelFileError> {
    let (stored, rest): (StoredModel, &[u8]) = postcard::take_from_bytes(payload)
        .map_err(|_| ModelFileError::Damaged { what: "its content cannot be decoded" })?;
    let StoredModel { mut title, mut domain, mut windows, scene, mut log } = stored;
    let damaged = |what| ModelFileError::Damaged { what };
    let Further { further, shapes, mut oils, in_common, heated, eyring } =
        further(rest, windows.len()).ok_or(damaged("rupture and schemes"))?;
    if let Some((StoredHeated { heat, srr, radius_m, modulus_pa }, further)) = heated {
        let StoredHeatedOils { largest_radius_m, largest_modulus_pa, speed_m_per_s, fastest_sliding_m_per_s } = further;
        let (radius_m, modulus_pa) = ((radius_m, largest_radius_m), (modulus_pa, largest_modulus_pa));
        let of_heat = HeatDomain { srr, radius_m, modulus_pa, speed_m_per_s, fastest_sliding_m_per_s };
        (domain.lubricant.heat, domain.heat) = (Some(heat.into()), Some(of_heat));
    }
    domain.eyring = eyring.map(|StoredEyring { srr, modulus_pa, limit_slope, gradient_stress_pa, .. }| EyringDomain {
        srr,
        modulus_pa,
        limit_slope,
        gradient_stress_pa,
    });
    if !sound_domain(&domain) {
        return Err(ModelFileError::Damaged { what: "its domain" });
    }
    // Those of ellipses ascend for each shape, those around anchors with these.
    let ascending = shapes.is_some() || oils.is_some() || windows.is_sorted_by(|a, b| a.m.0 <= b.m.0);
    if !(ascending && windows.iter().all(|window| sound_interval(window.m, f64::MAX))) {
        return Err(ModelFileError::Damaged { what: "ranges of its windows" });
    }
    check_counts(&windows, payload.len())?;
    if let Some(oils) = &mut oils {
        oils.oils.thinnest_film = in_common.as_ref().map_or(0.0, |in_common| in_common.thinnest_film);
        let costs = in_common.as_ref().map_or(&[][..], |in_common| &in_common.grid_costs);
        give_grid_costs(&mut windows, costs).ok_or(damaged("costs of its grid"))?;
        give_coefficients(&mut windows, oils).ok_or(damaged("oils"))?;
    }
    // They are shown on terminals.
    log.iter_mut().chain([&mut title]).for_each(|text| text.retain(|letter| !letter.is_control()));
    let grids = grids(&windows)?;
    domain.oils = oils.as_ref().map(|known| known.oils);
    wanted(observer)?;
    let combined = combined(&windows, &grids, in_common).ok_or(damaged("shared bases"))?;
    let deformations = deformations(&mut windows, &grids, oils.is_some()).ok_or(damaged("bases"))?;
    let parts = windows.into_par_iter().zip(grids).zip(deformations).zip(further.schemes.into_par_iter().zip(combined));
    let windows: Vec<Window> = parts
        .map(|(((w, grid), deformation), further)| {
            wanted(observer)?;
            w.into_window(grid, &domain, deformation, further)
        })
        .collect::<Result<_, _>>()?;
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
    if let Some(oils) = oils {
        anchor(&mut model, oils).ok_or(damaged("oils"))?;
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
