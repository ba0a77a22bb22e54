//! What the file of a model in time holds: frame, grid, bases, sampled rows, the beginnings of its trainings with their
//! inputs, what it was trained for, and the training scene, in postcard's encoding.
//!
//! What local bases a model has follows behind. Modes are kept to twelve digits of the pressures that they make, the rest to
//! the last, so that a march by what was read is that by what was written to some seven. K V_p is recomputed.

use super::domain::{FormerDomain, FormerSnapshot, Further};
use super::stored_matrix::{StoredBasis, StoredMatrix};
use super::stored_model::{StoredRows, entries, sound_domain};
use crate::engine::rom::ModelFileError;
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::full::Problem;
use crate::solver::full::transient::{Frame, Inputs};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Cavitation, Sliding};
use crate::solver::reduced::transient::{
    CoupledMarch, LocalBasis, Reach, TrajectoryDomain, TrajectoryModel, TrajectoryStart, only_course,
};
use crate::solver::reduced::{
    Combined, Domain, PodBasis, PressureModes, SampledRows, Sampling, SharedBasis, Snapshot, Window,
};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Relative accuracy of pressures at every node to which modes are kept, and that of deformations, which only say how much
/// of them so many modes would miss.
const PRESSURES: f64 = 1e-12;
const DEFORMATIONS: f64 = 1e-6;
/// Entries of a basis at most: real ones have some 10⁵.
const MOST_ENTRIES: usize = 5_000_000;
/// How far, over their own size, the coefficients of a stationary contact may lie from those of the training.
const PROVEN: f64 = 0.1;

#[derive(Serialize, Deserialize)]
struct StoredTrajectories {
    title: String,
    frame: Frame,
    domain: StoredDomain,
    grid: GridSpec,
    penalty: f64,
    pressure: StoredBasis,
    deformation: StoredBasis,
    sampling: Sampling,
    rows: StoredRows,
    /// A state for each place that the rupture boundary had, and its first ruptured columns.
    boundaries: Vec<(FormerSnapshot, Vec<usize>)>,
    starts: Vec<StoredStart>,
    scene: String,
    log: Vec<String>,
}

/// What follows a model with local bases, one after the other; others end without it.
#[derive(Serialize, Deserialize)]
struct StoredLocal {
    /// The modes, in those of the whole basis.
    factors: StoredMatrix,
    singular_values: Vec<f64>,
    sampling: Sampling,
    rows: StoredRows,
    boundaries: Vec<(FormerSnapshot, Vec<usize>)>,
    centre: Vec<f64>,
}

#[derive(Serialize, Deserialize)]
struct StoredDomain {
    reference: FormerDomain,
    cavitation: Cavitation,
    radius: Reach,
    speed: Reach,
    load: Reach,
    step: f64,
}

#[derive(Serialize, Deserialize)]
struct StoredStart {
    /// Radius, speed, load, modulus, viscosity and coefficient of a line contact.
    point: [f64; 6],
    sliding: Sliding,
    inputs: Inputs,
    duration: f64,
    coefficients: Vec<f64>,
    h_0: f64,
    fronts: Vec<usize>,
}

/// The model of a payload. That its parts belong together is still to be proved.
///
/// # Errors
/// When its parts do not fit each other.
pub(super) fn decode(payload: &[u8]) -> Result<Arc<TrajectoryModel>, ModelFileError> {
    let damaged = |what| ModelFileError::Damaged { what };
    let (stored, rest): (StoredTrajectories, &[u8]) =
        postcard::take_from_bytes(payload).map_err(|_| damaged("its content cannot be decoded"))?;
    let locals: Vec<StoredLocal> = if rest.is_empty() {
        Vec::new()
    } else {
        let (locals, rest) =
            postcard::take_from_bytes(rest).map_err(|_| damaged("its local bases cannot be decoded"))?;
        if !rest.is_empty() {
            return Err(damaged("something follows its content"));
        }
        locals
    };
    let StoredTrajectories { mut title, frame, grid, penalty, sampling, scene, mut log, .. } = stored;
    // They are shown on terminals.
    log.iter_mut().chain([&mut title]).for_each(|text| text.retain(|letter| !letter.is_control()));
    let only = only_course(stored.starts.iter().map(|start| &start.inputs));
    let domain = domain_of(stored.domain, only).ok_or(damaged("its domain"))?;
    let cavitation = domain.reference.lubricant.cavitation;

    // Nothing is built that is larger than what the file can hold.
    let nodes = match grid {
        GridSpec::Graded { registered: true, .. } | GridSpec::Plane(_) => return Err(damaged("grid")),
        GridSpec::Uniform { .. } | GridSpec::Graded { .. } => entries(&grid)?,
    };
    let fits = |basis: &StoredBasis| {
        let entries = nodes.checked_mul(basis.columns());
        basis.rows() == nodes && basis.columns() > 0 && entries.is_some_and(|entries| entries <= MOST_ENTRIES)
    };
    if nodes > payload.len() {
        return Err(damaged("grid"));
    }
    if !(fits(&stored.pressure) && fits(&stored.deformation)) {
        return Err(damaged("bases"));
    }
    let grid = ContactGrid::Line(grid.line()?);
    let (Some(pressure), Some(deformation)) =
        (stored.pressure.into_basis(grid.len()), stored.deformation.into_basis(grid.len()))
    else {
        return Err(damaged("bases"));
    };
    let modes = pressure.modes.ncols();
    let rows = stored.rows.into_rows(modes, &grid)?;
    if !(penalty.is_finite() && penalty > 0.0) {
        return Err(damaged("penalty"));
    }
    let boundaries = boundaries_of(stored.boundaries, cavitation, modes, &grid).ok_or(damaged("rupture"))?;
    let starts: Option<Vec<TrajectoryStart>> =
        stored.starts.into_iter().map(|start| start_of(start, cavitation, modes, &grid)).collect();
    let starts = starts.filter(|starts| !starts.is_empty()).ok_or(damaged("beginnings of its trainings"))?;
    let pressure = PressureModes::own(pressure, &grid);
    let mut window = Window::new((0.0, f64::INFINITY), grid, pressure, deformation, boundaries, sampling, rows);
    (window.penalty, window.cavitation) = (penalty, cavitation);
    let locals = locals_on(&window, locals)?;
    Ok(Arc::new(TrajectoryModel { title, frame, window, locals, starts, domain, scene, log }))
}

/// The local bases that are made of a whole one.
fn locals_on(whole: &Window, stored: Vec<StoredLocal>) -> Result<Vec<LocalBasis>, ModelFileError> {
    let damaged = || ModelFileError::Damaged { what: "local bases" };
    if stored.is_empty() {
        return Ok(Vec::new());
    }
    let (basis, grid): (&PodBasis, _) = (whole.pressure.basis(), &whole.grid);
    let shared = Arc::new(SharedBasis::new(basis.clone(), grid));
    let local = |stored: StoredLocal| {
        let factors = stored.factors.into_mat(basis.modes.ncols()).filter(|factors| factors.ncols() > 0);
        let factors = factors.ok_or_else(damaged)?;
        let modes = factors.ncols();
        let finite = stored.singular_values.iter().chain(&stored.centre).all(|value| value.is_finite());
        let fits = modes <= basis.modes.ncols() && stored.centre.len() == basis.modes.ncols();
        if !(finite && fits) {
            return Err(damaged());
        }
        let rows: SampledRows = stored.rows.into_rows(modes, grid)?;
        let boundaries = boundaries_of(stored.boundaries, whole.cavitation, modes, grid).ok_or_else(damaged)?;
        let pressure = Combined { shared: Arc::clone(&shared), factors }.into_modes(stored.singular_values);
        let deformation = Arc::clone(&whole.deformation);
        let mut window = Window::new(whole.m, grid.clone(), pressure, deformation, boundaries, stored.sampling, rows);
        (window.penalty, window.cavitation) = (whole.penalty, whole.cavitation);
        Ok(LocalBasis { window, centre: stored.centre })
    };
    stored.into_iter().map(local).collect()
}

/// What a model was trained for; `None` where that makes no sense.
fn domain_of(stored: StoredDomain, only: Option<Inputs>) -> Option<TrajectoryDomain> {
    let StoredDomain { reference: former, cavitation, radius, speed, load, step } = stored;
    let space = former.space(Further::default());
    let mut reference = Domain { contact: ContactKind::Line, space, lubricant: former.lubricant };
    reference.lubricant.cavitation = cavitation;
    let domain = TrajectoryDomain { reference, radius, speed, load, only, step };
    (sound_domain(&domain.reference) && domain.is_sound()).then_some(domain)
}

/// Whether these can be first ruptured columns on a grid.
fn sound_fronts(fronts: &[usize], cavitation: Cavitation, grid: &ContactGrid) -> bool {
    let lines = if cavitation == Cavitation::Penalty { 0 } else { grid.lines() };
    fronts.len() == lines && fronts.iter().all(|front| *front <= grid.nodes().0)
}

fn boundaries_of(
    stored: Vec<(FormerSnapshot, Vec<usize>)>,
    cavitation: Cavitation,
    modes: usize,
    grid: &ContactGrid,
) -> Option<Vec<Snapshot>> {
    if stored.is_empty() != (cavitation == Cavitation::Penalty) {
        return None;
    }
    let sound = |(snapshot, fronts): (FormerSnapshot, Vec<usize>)| {
        let snapshot = Snapshot::from(snapshot);
        let finite = snapshot.coefficients.iter().chain([&snapshot.h_0, &snapshot.h_c]).all(|value| value.is_finite());
        let fits = snapshot.coefficients.len() == modes && sound_fronts(&fronts, cavitation, grid);
        (finite && fits && snapshot.point.check().is_ok()).then_some(Snapshot { fronts, ..snapshot })
    };
    stored.into_iter().map(sound).collect()
}

fn start_of(stored: StoredStart, cavitation: Cavitation, modes: usize, grid: &ContactGrid) -> Option<TrajectoryStart> {
    let StoredStart { point, sliding, inputs, duration, coefficients, h_0, fronts } = stored;
    let point = OperatingPoint::from_quantities(ContactKind::Line, point, sliding);
    let finite = coefficients.iter().chain([&h_0, &sliding.slide_to_roll_ratio]).all(|value| value.is_finite());
    let fits = coefficients.len() == modes && sound_fronts(&fronts, cavitation, grid);
    let driven = duration.is_finite() && duration >= 0.0 && inputs.check(duration).is_ok();
    let sound = finite && fits && driven && point.check().is_ok();
    sound.then_some(TrajectoryStart { point, inputs, duration, coefficients, h_0, fronts })
}
