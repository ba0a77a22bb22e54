//! Steady models in files.

use super::calibrations;
use super::container::{Contents, Heading, ModelKind, Writer};
use super::error::{ModelFileError, damaged};
use super::snapshots;
use super::sound::{domain, entries, sound_interval};
use super::window::{
    Rounding, WindowEntry, read_basis, read_deformation, read_window, shapes, write_basis, write_window,
};
use crate::solver::discrete::grid::{ContactGrid, GridSpec};
use crate::solver::observer::Observer;
use crate::solver::parameters::Metric;
use crate::solver::physics::contact::Moes;
use crate::solver::physics::lubricant::Cavitation;
use crate::solver::reduced::{
    Calibration, Domain, FeatureSet, PodBasis, ReducedModel, Scheme, SharedBasis, Snapshot, Window,
};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Array names of the modes and singular values of the basis that all local models share.
const SHARED: [&str; 2] = ["shared/pressure", "shared/singular_values"];

/// Section of a steady model: all data except the trained range and the arrays.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Steady {
    grids: Vec<GridSpec>,
    windows: Vec<WindowEntry>,
}

/// Encodes a model as the content of its file. Returns `None` if that fails.
pub(super) fn encode(model: &ReducedModel) -> Option<Vec<u8>> {
    let heat = model.domain.heats();
    let (rounding, windows) = (Rounding::Steady { heat }, model.windows.iter().collect::<Vec<_>>());
    let first = model.windows.first()?;
    let mut writer = Writer::default();
    let all = model.windows.iter().all(|window| window.pressure.combined().is_some());
    if let Some(shared) = first.pressure.combined().filter(|_| all) {
        let [accuracy, _] = rounding.accuracies(first);
        write_basis(&mut writer, SHARED, &shared.shared.basis, (first.grid.nodes().1, accuracy))?;
    }
    let (mut grids, mut entries) = (Vec::new(), Vec::new());
    for (k, window) in model.windows.iter().enumerate() {
        let spec = window.grid.spec();
        let grid = grids.iter().position(|grid| *grid == spec).unwrap_or(grids.len());
        if grid == grids.len() {
            grids.push(spec);
        }
        let other = Some(first).filter(|_| k > 0);
        entries.push(write_window(&mut writer, (k, window, grid), rounding, (all, other))?);
    }
    snapshots::write(&mut writer, &windows, true)?;
    calibrations::write(&mut writer, &windows)?;
    writer.seal(&Heading {
        kind: ModelKind::Steady,
        contact: model.contact(),
        title: &model.title,
        domain: &model.domain,
        model: &Steady { grids, windows: entries },
        scene: &model.scene,
        log: &model.log,
    })
}

/// Reads a model, or its outline if the contents are those of one. Does not solve training contacts.
///
/// # Errors
/// If its parts are inconsistent, or if the observer cancels.
pub(super) fn decode(contents: &Contents<'_>, observer: &dyn Observer) -> Result<ReducedModel, ModelFileError> {
    let domain = domain(contents)?;
    let Steady { grids, windows } = contents.model().ok_or(damaged("its windows"))?;
    check_windows(&domain, &windows)?;
    let counts: Vec<usize> = windows.iter().map(|window| window.snapshots).collect();
    let evidence: Vec<usize> = windows.iter().map(|window| window.evidence).collect();
    let snapshots = snapshots::read(contents, &counts).ok_or(damaged("snapshots"))?;
    let calibrations = match contents.is_outline() {
        true => vec![None; evidence.len()],
        false => calibrations::read(contents, &evidence).ok_or(damaged("calibration"))?,
    };
    check_sizes(contents, &domain, (&grids, &windows))?;
    let build = if contents.is_outline() { GridSpec::build_without_kernel } else { GridSpec::build };
    let grids: Vec<ContactGrid> = grids.iter().map(build).collect::<Result<_, _>>()?;
    let grids: Vec<&ContactGrid> =
        windows.iter().map(|window| grids.get(window.grid)).collect::<Option<_>>().ok_or(damaged("its grids"))?;
    if grids.iter().any(|grid| grid.kind() != contents.contact()) {
        return Err(damaged("windows of different contacts"));
    }
    wanted(observer)?;
    let shared = shared_basis(contents, &grids).ok_or(damaged("shared bases"))?;
    let deformations = deformations(contents, &grids).ok_or(damaged("bases"))?;
    let parts = windows.into_par_iter().zip(grids).zip(deformations).zip(snapshots).zip(calibrations).enumerate();
    let windows = parts.map(|(k, ((((entry, grid), deformation), snapshots), calibration))| {
        wanted(observer)?;
        let on = (grid.clone(), shared.as_ref());
        let window = read_window(contents, (k, &entry), on, deformation, snapshots)?;
        of_domain(&domain, &entry, Window { calibration, ..window })
    });
    let windows = windows.collect::<Result<_, _>>()?;
    let (title, scene, log) = contents.texts();
    Ok(ReducedModel { title, domain, windows, scene, log })
}

/// Solves each local model at two of its own snapshots.
///
/// # Errors
/// If a local model does not reproduce H_c of a snapshot, or if the observer cancels.
pub(super) fn prove(model: &ReducedModel, observer: &dyn Observer) -> Result<(), ModelFileError> {
    let windows = model.windows.par_iter().enumerate();
    let proved = windows.map(|(k, window)| {
        wanted(observer)?;
        if model.reproduces_snapshots(k) { Ok(()) } else { Err(ModelFileError::Unproven { m: window.m }) }
    });
    proved.collect::<Vec<_>>().into_iter().collect()
}

/// Returns an error if the observer has cancelled.
///
/// # Errors
/// If the observer has cancelled.
fn wanted(observer: &dyn Observer) -> Result<(), ModelFileError> {
    if observer.cancelled() { Err(ModelFileError::Cancelled) } else { Ok(()) }
}

/// Refuses local models that are inconsistent with the trained range.
fn check_windows(domain: &Domain, windows: &[WindowEntry]) -> Result<(), ModelFileError> {
    let ellipses = domain.space.of_ellipses();
    // The local models of rough surfaces lie around anchors or not.
    let around = !domain.is_rough() || windows.iter().any(|window| window.anchor.is_some());
    let anchored = domain.space.varies_lubricant() && around;
    // Thermal elliptical models are lubricant-parameterised, and none is shear-thinning.
    if ellipses && (domain.is_shear_thinning() || (domain.heats() && !anchored)) {
        return Err(damaged("its parts"));
    }
    // Elliptical models are in ascending order of M only for each shape, and anchored ones are not ordered.
    let from = |window: &WindowEntry| window.m.map_or(f64::NAN, |m| m.0);
    let ascending = ellipses || anchored || windows.is_sorted_by(|a, b| from(a) <= from(b));
    let sound = |window: &WindowEntry| window.m.is_some_and(|m| sound_interval(m, f64::MAX));
    if windows.is_empty() || !ascending || !windows.iter().all(sound) {
        return Err(damaged("ranges of its windows"));
    }
    if anchored {
        let placed = |window: &WindowEntry| window.anchor.is_some_and(|(m, l)| Moes { m, l }.check().is_ok());
        let one_grid = windows.windows(2).all(|pair| matches!(pair, [a, b] if a.grid == b.grid));
        if !(one_grid && windows.iter().all(placed)) {
            return Err(damaged("oils"));
        }
    } else if windows.iter().any(|window| window.anchor.is_some()) {
        return Err(damaged("oils"));
    }
    if !windows.iter().all(|window| window.has_sound_shapes(ellipses)) {
        return Err(damaged("shapes"));
    }
    let cavitation = domain.lubricant.cavitation;
    let (penalty, heat) = (cavitation == Cavitation::Penalty, domain.heats());
    if !penalty && (cavitation != Cavitation::Complementarity || heat || ellipses) {
        return Err(damaged("cavitation"));
    }
    if heat && windows.iter().any(|window| window.scheme != Scheme::Galerkin) {
        return Err(damaged("heat"));
    }
    if !domain.slides() && windows.iter().any(|window| window.traction) {
        return Err(damaged("traction"));
    }
    if windows.iter().any(|window| window.snapshots == 0) {
        return Err(damaged("snapshots"));
    }
    Ok(())
}

/// Refuses a model that would need more memory than a file of its size justifies, before grids and bases are built. A
/// local model has no more modes than snapshots or, with ranges of thermal constants, than singular values. Each node
/// takes at least one byte.
fn check_sizes(
    contents: &Contents<'_>,
    domain: &Domain,
    (grids, windows): (&[GridSpec], &[WindowEntry]),
) -> Result<(), ModelFileError> {
    let others = domain.heats() && !domain.space.constants.is_empty();
    let solutions = |k: usize, window: &WindowEntry| match contents.shape(&format!("windows/{k}/singular_values")) {
        Some([known]) if others => *known,
        _ => window.snapshots,
    };
    let all: usize = windows.iter().enumerate().map(|(k, window)| solutions(k, window)).sum();
    let each = grids.iter().map(entries).collect::<Result<Vec<_>, _>>()?;
    let mut nodes = each.into_iter().fold(0, usize::saturating_add);
    for (k, window) in windows.iter().enumerate() {
        let rows = entries(grids.get(window.grid).ok_or(damaged("its grids"))?)?;
        nodes = nodes.saturating_add(rows);
        let fits = |shape: Option<&[usize]>, most: usize| {
            shape.is_none_or(|shape| matches!(shape, [own, columns] if *own == rows && *columns <= most))
        };
        let [pressure, deformation] = shapes(contents, k);
        if !(fits(pressure, solutions(k, window)) && fits(deformation, all)) {
            return Err(damaged("bases"));
        }
    }
    if nodes > contents.bytes { Err(damaged("grids")) } else { Ok(()) }
}

/// Reads the basis that all local models share, if there is one. Returns `None` if it is damaged.
fn shared_basis(contents: &Contents<'_>, grids: &[&ContactGrid]) -> Option<Option<Arc<SharedBasis>>> {
    if contents.shape(SHARED[0]).is_none() || contents.is_outline() {
        return Some(None);
    }
    let grid = grids.first()?;
    let alike = grids.iter().all(|other| other.spec() == grid.spec());
    let basis = read_basis(contents, SHARED, grid.len()).filter(|_| alike)?;
    Some(Some(Arc::new(SharedBasis::new(basis, grid))))
}

/// Reads the deformation basis of each local model. One without its own basis shares that of the first. Returns `None`
/// if a basis is damaged.
fn deformations(contents: &Contents<'_>, grids: &[&ContactGrid]) -> Option<Vec<Arc<PodBasis>>> {
    let own = grids.par_iter().enumerate().map(|(k, grid)| read_deformation(contents, k, grid.len()));
    let own: Vec<Option<PodBasis>> = own.collect::<Option<_>>()?;
    let mut own = own.into_iter().map(|basis| basis.map(Arc::new));
    let first = own.next()??;
    let len = grids.first()?.len();
    let others = own.zip(grids.iter().skip(1));
    let others = others.map(|(own, grid)| own.or_else(|| (grid.len() == len).then(|| Arc::clone(&first))));
    std::iter::once(Some(Arc::clone(&first))).chain(others).collect()
}

/// Completes a local model with data that follow from the trained range.
///
/// # Errors
/// If it is inconsistent with the range.
fn of_domain(domain: &Domain, entry: &WindowEntry, mut window: Window) -> Result<Window, ModelFileError> {
    window.anchor = entry.anchor.map(|(m, l)| Moes { m, l });
    if window.anchor.is_some() || domain.is_rough() {
        window.metric = Metric::of_solutions(&domain.space);
    }
    window.cavitation = domain.lubricant.cavitation;
    let (lines, columns) = match window.cavitation {
        Cavitation::Penalty => (0, 0),
        _ => (window.grid.lines(), window.grid.nodes().0),
    };
    let ruptures = |s: &Snapshot| s.fronts.len() == lines && s.fronts.iter().all(|front| *front <= columns);
    if !window.snapshots.iter().all(ruptures) {
        return Err(damaged("cavitation"));
    }
    window.shapes = entry.shapes_of(&window)?;
    let known = |known: &Calibration| known.sound() && known.is_of(&FeatureSet::of(domain));
    if !window.calibration.as_ref().is_none_or(known) {
        return Err(damaged("calibration"));
    }
    Ok(window)
}
