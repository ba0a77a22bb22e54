//! Checks of a file's content before a model is built from it.

use super::container::Contents;
use super::error::{ModelFileError, damaged};
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec, MAX_GRADED_NODES};
use crate::solver::parameters::Quantity;
use crate::solver::physics::lubricant::LARGEST_HEATED_SRR;
use crate::solver::reduced::Domain;

/// Reads the trained range. Only this function depends on both the type of the range and the file.
///
/// # Errors
/// If it is invalid.
pub(super) fn domain(contents: &Contents<'_>) -> Result<Domain, ModelFileError> {
    contents.domain().filter(sound_domain).ok_or(damaged("its domain"))
}

/// Returns true if these are equations of a grid: at least one, in ascending order.
pub(super) fn are_rows(rows: &[usize], grid: &ContactGrid) -> bool {
    rows.is_sorted_by(|a, b| a < b) && rows.last().is_some_and(|&row| row < grid.unknowns())
}

/// Returns true if two numbers are the ends of an interval within 0…`most`.
pub(super) fn sound_interval((low, high): (f64, f64), most: f64) -> bool {
    0.0 <= low && low <= high && high <= most
}

/// Returns true if a range is valid. Only the range of a shear-thinning or thermal lubricant may vary SRR, and it must
/// give SRR. The surfaces are rough if it varies the film ratio.
fn sound_domain(domain: &Domain) -> bool {
    let (space, slides) = (&domain.space, domain.slides());
    let most = if domain.heats() { LARGEST_HEATED_SRR } else { f64::MAX };
    space.check().is_ok()
        && domain.lubricant.check().is_ok()
        && space.is_rough() == domain.lubricant.is_rough()
        && (slides || !space.slides())
        && (!slides || space.gives(Quantity::SlideToRollRatio))
        && domain.srr().is_none_or(|ends| sound_interval(ends, most))
}

/// Returns the length of node arrays on a grid, without building it.
pub(super) fn entries(grid: &GridSpec) -> Result<usize, GridError> {
    Ok(match grid {
        GridSpec::Graded { nodes, .. } => nodes.saturating_add(1),
        GridSpec::Uniform { dx, domain: (from, to) } => (((to - from) / dx).round() as usize).saturating_add(2),
        GridSpec::Following { .. } => grid.check().map(|()| MAX_GRADED_NODES)?,
        GridSpec::Plane(spec) => spec.check().map(|(nx, ny)| nx * ny)?,
    })
}
