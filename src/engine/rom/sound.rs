//! Checks of a file's content before a model is built from it.

use super::container::Contents;
use super::error::{ModelFileError, damaged};
use crate::solver::discrete::grid::{ContactGrid, GridError, GridSpec};
use crate::solver::physics::lubricant::{LARGEST_HEATED_SRR, ShearLaw};
use crate::solver::reduced::{Domain, EyringDomain, HeatDomain, SlidingDomain};

/// Reads the trained range: the one place where the type of the range meets the file.
///
/// # Errors
/// When it makes no sense.
pub(super) fn domain(contents: &Contents<'_>) -> Result<Domain, ModelFileError> {
    contents.domain().filter(sound_domain).ok_or(damaged("its domain"))
}

/// Whether a grid has these rows, at least one, in ascending order.
pub(super) fn are_rows(rows: &[usize], grid: &ContactGrid) -> bool {
    rows.is_sorted_by(|a, b| a < b) && rows.last().is_some_and(|&row| row < grid.unknowns())
}

/// Whether two numbers are the ends of an interval within 0…`most`.
pub(super) fn sound_interval((low, high): (f64, f64), most: f64) -> bool {
    0.0 <= low && low <= high && high <= most
}

/// Whether a range makes sense. A range with sliding needs a shear-thinning lubricant and the other way round, except in
/// thermal models.
fn sound_domain(domain: &Domain) -> bool {
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
        let thermal = heat.thermal.is_none_or(|thermal| thermal.check().is_ok());
        kind && lowest && thermal && heat.fastest_sliding_m_per_s > 0.0 && intervals.into_iter().all(sound)
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
