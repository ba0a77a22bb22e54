//! What must hold of a file's content before anything is built of it.

use super::window::StoredWindow;
use crate::engine::former::stored_matrix::StoredBasis;
use crate::engine::rom::ModelFileError;
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec};
use crate::solver::parameters::Quantity;
use crate::solver::physics::lubricant::LARGEST_HEATED_SRR;
use crate::solver::reduced::Domain;

/// Whether a grid has these rows, at least one, in ascending order.
pub(super) fn are_rows(rows: &[usize], grid: &ContactGrid) -> bool {
    rows.is_sorted_by(|a, b| a < b) && rows.last().is_some_and(|&row| row < grid.unknowns())
}

/// Whether two numbers are the ends of an interval within 0…`most`.
pub(super) fn sound_interval((low, high): (f64, f64), most: f64) -> bool {
    0.0 <= low && low <= high && high <= most
}

/// Whether a domain can be that of a model: one that varies SRR is of a lubricant that thins or warms under shear, and one of
/// such a lubricant gives SRR.
pub(in crate::engine) fn sound_domain(domain: &Domain) -> bool {
    let (space, slides) = (&domain.space, domain.slides());
    let most = if domain.heats() { LARGEST_HEATED_SRR } else { f64::MAX };
    space.check().is_ok()
        && domain.lubricant.check().is_ok()
        && (slides || !space.slides())
        && (!slides || space.gives(Quantity::SlideToRollRatio))
        && domain.srr().is_none_or(|ends| sound_interval(ends, most))
}

/// Entries of node arrays on a grid, without building it.
pub(in crate::engine) fn entries(grid: &GridSpec) -> Result<usize, GridError> {
    Ok(match grid {
        GridSpec::Graded { nodes, .. } => nodes.saturating_add(1),
        GridSpec::Uniform { dx, domain: (from, to) } => (((to - from) / dx).round() as usize).saturating_add(2),
        GridSpec::Plane(spec) => spec.check().map(|(nx, ny)| nx * ny)?,
    })
}

/// Refuses what would take more memory than a model of so many bytes does, before anything of it is built: modes come from
/// snapshots, or, where a model knows thermal constants, from other solutions besides, each with a singular value; and every
/// node of a grid has a byte at least.
pub(super) fn check_counts(windows: &[StoredWindow], domain: &Domain, bytes: usize) -> Result<(), ModelFileError> {
    let mut nodes = 0usize;
    let others = domain.heats() && !domain.space.constants.is_empty();
    let solutions = |window: &StoredWindow| if others { window.pressure.known() } else { window.snapshots.len() };
    let all = windows.iter().map(solutions).sum();
    for window in windows {
        let rows = entries(&window.grid)?;
        nodes = nodes.saturating_add(rows);
        let fits = |basis: &StoredBasis, most: usize| basis.rows() == rows && basis.columns() <= most;
        if !(fits(&window.pressure, solutions(window)) && fits(&window.deformation, all)) {
            return Err(ModelFileError::Damaged { what: "bases" });
        }
    }
    if nodes > bytes { Err(ModelFileError::Damaged { what: "grids" }) } else { Ok(()) }
}
