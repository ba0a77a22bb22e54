//! Writes, reads and checks transient reduced models in files.
//!
//! Modes are rounded to a relative accuracy of 1e-12 of the pressures; everything else is stored exactly. A run in
//! time with a model that was read agrees with that of the original model to about seven digits.

use super::container::{Contents, Heading, ModelKind, Writer};
use super::error::{ModelFileError, damaged};
use super::snapshots;
use super::sound::{domain, entries};
use super::window::{Rounding, WindowEntry, read_deformation, read_window, shapes, write_window};
use crate::solver::discrete::grid::GridSpec;
use crate::solver::full::Problem;
use crate::solver::full::transient::{Frame, Inputs};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::physics::lubricant::{Cavitation, Sliding};
use crate::solver::reduced::transient::{
    CoupledMarch, LocalBasis, Reach, TrajectoryDomain, TrajectoryModel, TrajectoryStart, only_course,
};
use crate::solver::reduced::{SharedBasis, Window};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Largest number of entries of a basis. Real ones have about 10⁵.
const MOST_ENTRIES: usize = 5_000_000;
/// Accepted relative deviation of the coefficients of a steady contact from those of the training.
const PROVEN: f64 = 0.1;
/// Array names.
const STARTS: &str = "starts/coefficients";
const CENTRES: &str = "local/centres";

/// Section of a transient model: all data except the range of its reference contacts and the arrays. The first local
/// model covers all states; the others have local bases that combine its modes.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TransientModel {
    frame: Frame,
    /// Trained ranges of the inputs relative to their references.
    radius: Reach,
    speed: Reach,
    load: Reach,
    /// Time step.
    step: f64,
    grid: GridSpec,
    windows: Vec<WindowEntry>,
    starts: Vec<Start>,
}

/// Steady start of a training trajectory, and its inputs. The coefficients are in an array.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Start {
    /// Radius, speed, load, modulus, viscosity and pressure–viscosity coefficient.
    point: [f64; 6],
    sliding: Sliding,
    inputs: Inputs,
    duration: f64,
    h_0: f64,
    fronts: Vec<usize>,
}

/// Encodes a model as the content of its file. Returns `None` if that fails.
pub(super) fn encode(model: &TrajectoryModel) -> Option<Vec<u8>> {
    let TrajectoryModel { title, frame, window, locals, starts, domain, scene, log } = model;
    let windows: Vec<&Window> = std::iter::once(window).chain(locals.iter().map(|local| &local.window)).collect();
    let mut writer = Writer::default();
    let write = |(k, own): (usize, &&Window)| {
        let other = Some(window).filter(|_| k > 0);
        write_window(&mut writer, (k, own, 0), Rounding::Transient, (true, other))
    };
    let entries = windows.iter().enumerate().map(write).collect::<Option<_>>()?;
    snapshots::write(&mut writer, &windows, false)?;
    let modes = window.pressure.count().max(1);
    let coefficients: Vec<f64> = starts.iter().flat_map(|start| &start.coefficients).copied().collect();
    let centres: Vec<f64> = locals.iter().flat_map(|local| &local.centre).copied().collect();
    writer.table(STARTS, &[coefficients.len() / modes, modes], &coefficients)?;
    writer.table(CENTRES, &[centres.len() / modes, modes], &centres)?;
    let start = |start: &TrajectoryStart| Start {
        point: start.point.quantities(),
        sliding: start.point.sliding,
        inputs: start.inputs.clone(),
        duration: start.duration,
        h_0: start.h_0,
        fronts: start.fronts.clone(),
    };
    let TrajectoryDomain { reference, radius, speed, load, step, .. } = domain;
    writer.seal(&Heading {
        kind: ModelKind::Transient,
        contact: window.grid.kind(),
        title,
        domain: reference,
        model: &TransientModel {
            frame: *frame,
            radius: *radius,
            speed: *speed,
            load: *load,
            step: *step,
            grid: window.grid.spec(),
            windows: entries,
            starts: starts.iter().map(start).collect(),
        },
        scene,
        log,
    })
}

/// Solves the steady contacts at the start of the first and the last training.
///
/// # Errors
/// If the model does not reproduce these contacts.
pub(super) fn prove(model: &Arc<TrajectoryModel>) -> Result<(), ModelFileError> {
    let proven = |start: &TrajectoryStart| {
        let problem = Problem::new(&start.point, model.domain.reference.lubricant).ok()?;
        let found = CoupledMarch::begin(model, problem, start.inputs.at(0.0)).ok()?;
        let square = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>();
        let off = square(&mut found.coefficients().iter().zip(&start.coefficients).map(|(own, other)| own - other));
        Some(off <= PROVEN * PROVEN * square(&mut start.coefficients.iter().copied()))
    };
    let all =
        [model.starts.first(), model.starts.last()].into_iter().flatten().all(|start| proven(start) == Some(true));
    if all { Ok(()) } else { Err(ModelFileError::UnprovenInTime) }
}

/// Reads a model. Does not solve training contacts.
///
/// # Errors
/// If its parts are inconsistent.
pub(super) fn decode(contents: &Contents<'_>) -> Result<TrajectoryModel, ModelFileError> {
    let reference = domain(contents)?;
    let stored: TransientModel = contents.model().ok_or(damaged("its windows"))?;
    let TransientModel { frame, radius, speed, load, step, grid, windows, starts } = stored;
    let only = only_course(starts.iter().map(|start| &start.inputs));
    let domain = TrajectoryDomain { reference, radius, speed, load, only, step };
    let cavitation = domain.reference.lubricant.cavitation;
    let ruptures = !matches!(cavitation, Cavitation::MassConserving { .. });
    if !ruptures || domain.reference.slides() || !domain.is_sound() {
        return Err(damaged("its domain"));
    }

    // Sizes are checked against the file size before anything is built.
    let nodes = match grid {
        GridSpec::Graded { registered: true, .. } => return Err(damaged("grid")),
        GridSpec::Uniform { .. } | GridSpec::Graded { .. } | GridSpec::Following { .. } | GridSpec::Plane(_) => {
            entries(&grid)?
        }
    };
    if nodes > contents.bytes {
        return Err(damaged("grid"));
    }
    let fits = |shape: Option<&[usize]>| matches!(shape, Some([rows, modes]) if *rows == nodes && nodes.saturating_mul(*modes) <= MOST_ENTRIES);
    if !shapes(contents, 0).into_iter().all(fits) {
        return Err(damaged("bases"));
    }
    let grid = grid.build()?;
    let kind = grid.kind();
    if domain.reference.contact != kind || kind.is_point() && frame != Frame::Fixed {
        return Err(damaged("its domain"));
    }
    // Reduced models of point contacts approximate either kind of cavitation by a penalty.
    let cavitation = if kind.is_point() { Cavitation::Penalty } else { cavitation };
    let counts: Vec<usize> = windows.iter().map(|window| window.snapshots).collect();
    let mut snapshots = snapshots::read(contents, &counts).ok_or(damaged("cavitation"))?.into_iter();
    let sound_fronts = |fronts: &[usize]| {
        let lines = if cavitation == Cavitation::Penalty { 0 } else { grid.lines() };
        fronts.len() == lines && fronts.iter().all(|front| *front <= grid.nodes().0)
    };
    let deformation = read_deformation(contents, 0, grid.len()).flatten().ok_or(damaged("bases"))?;
    let deformation = Arc::new(deformation);
    let mut read = |k: usize, entry: &WindowEntry, shared: Option<&Arc<SharedBasis>>| {
        let own = snapshots.next().unwrap_or_default();
        let boundaries = own.is_empty() == (cavitation == Cavitation::Penalty);
        if !boundaries || !own.iter().all(|snapshot| sound_fronts(&snapshot.fronts)) {
            return Err(damaged("cavitation"));
        }
        let window = read_window(contents, (k, entry), (grid.clone(), shared), Arc::clone(&deformation), own)?;
        Ok(Window { cavitation, ..window })
    };
    let mut entries = windows.iter().enumerate();
    let window = entries.next().map(|(k, entry)| read(k, entry, None)).ok_or(damaged("its windows"))??;
    let modes = window.pressure.count();
    let locals = if windows.len() > 1 {
        let shared = Arc::new(SharedBasis::new(window.pressure.basis().clone(), &grid));
        let centres = contents.matrix(CENTRES, windows.len() - 1).filter(|centres| centres.ncols() == modes);
        let centres = centres.ok_or(damaged("local bases"))?;
        let local = |(centre, (k, entry)): (_, (usize, &WindowEntry))| {
            let window = read(k, entry, Some(&shared))?;
            let made_of_it = window.pressure.combined().is_some();
            let centre: faer::RowRef<'_, f64> = centre;
            let local = LocalBasis { window, centre: centre.iter().copied().collect() };
            if made_of_it { Ok(local) } else { Err(damaged("local bases")) }
        };
        centres.row_iter().zip(entries).map(local).collect::<Result<_, _>>()?
    } else {
        Vec::new()
    };
    let of_starts = contents.matrix(STARTS, starts.len()).filter(|own| own.ncols() == modes);
    let of_starts = of_starts.ok_or(damaged("beginnings of its trainings"))?;
    let start = |(start, own): (Start, faer::RowRef<'_, f64>)| {
        let Start { point, sliding, inputs, duration, h_0, fronts } = start;
        let point = OperatingPoint::from_quantities(kind, point, sliding);
        let finite = h_0.is_finite() && sliding.slide_to_roll_ratio.is_finite() && sound_fronts(&fronts);
        let driven = duration.is_finite() && duration >= 0.0 && inputs.check(duration).is_ok();
        let coefficients = own.iter().copied().collect();
        let sound = finite && driven && point.check().is_ok();
        sound.then_some(TrajectoryStart { point, inputs, duration, coefficients, h_0, fronts })
    };
    let starts: Option<Vec<TrajectoryStart>> = starts.into_iter().zip(of_starts.row_iter()).map(start).collect();
    let starts = starts.ok_or(damaged("beginnings of its trainings"))?;
    let (title, scene, log) = contents.texts();
    Ok(TrajectoryModel { title, frame, window, locals, starts, domain, scene, log })
}
