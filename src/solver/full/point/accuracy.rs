//! Discretisation error of a point contact's solution: an estimate from two grids, and a warning from one.

use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::solution::Solution;
use crate::solver::warning::Warning;

/// Curvature of the film across the side lobes above which they count as unresolved. The minimum film thickness H_min
/// is 2 % too small at a curvature of 0.1, 8 % at 0.45, 20 to 25 % at 1.2, and too small by a factor of 3 at 6. These
/// values hold for Moes numbers M = 13…1000.
const UNRESOLVED_CURVATURE: f64 = 0.5;
/// Relative error of H_min at a curvature of one, from the same contacts.
const ERROR_OF_CURVATURE: f64 = 0.2;

/// Value of a quantity in the limit of fine grids, by Richardson extrapolation with the second order of the scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Extrapolated value.
    pub limit: f64,
    /// Relative error of the finer solution.
    pub error: f64,
}

/// Discretisation errors of the film thickness, estimated from two grids.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Accuracy {
    /// Estimate of the central film thickness H_c.
    pub h_c: Estimate,
    /// Estimate of H_min; valid only if both grids resolve the side lobes, see [`resolution_warning`].
    pub h_min: Estimate,
}

/// Limit of the effort of a finer second grid: nodes along X times the square of the nodes across. The time of a
/// solve is proportional to this number.
const AFFORDABLE: usize = 9_000_000;

/// Returns the second grid for an error estimate: half the spacings if a solve then takes seconds at most, otherwise
/// twice the spacings.
///
/// Half the spacings give a better estimate, because the coarser grid of a pair may not resolve the side lobes.
pub fn second_grid(spec: PointGridSpec) -> PointGridSpec {
    let scaled = |factor: f64| PointGridSpec { dx: factor * spec.dx, dy: factor * spec.dy, ..spec };
    match scaled(0.5).check() {
        Ok((nx, ny)) if nx * ny * ny <= AFFORDABLE => scaled(0.5),
        _ => scaled(2.0),
    }
}

impl Accuracy {
    /// Compares two solutions of one problem in either order.
    pub fn of_either(one: &Solution, other: &Solution) -> Option<Self> {
        Self::of(one, other).or_else(|| Self::of(other, one))
    }

    /// Returns the relative errors of H_c and H_min of one of the two solutions.
    pub fn errors_of(&self, solution: &Solution) -> (f64, f64) {
        let off = |value: f64, estimate: Estimate| (value / estimate.limit - 1.0).abs();
        (off(solution.scalars.h_c, self.h_c), off(solution.scalars.h_min, self.h_min))
    }

    /// Compares solutions of one problem on two grids over one domain. The estimate covers the directions in which
    /// the spacing differs; if both do, the factor must be the same. `None` if the two cannot be compared.
    pub fn of(coarse: &Solution, fine: &Solution) -> Option<Self> {
        let (wide, narrow) = coarse.mesh.plane().zip(fine.mesh.plane())?;
        if coarse.problem != fine.problem || wide.domain != narrow.domain || wide.refinement != narrow.refinement {
            return None;
        }
        let (along, across) = (wide.dx / narrow.dx, wide.dy / narrow.dy);
        let ratio = along.max(across);
        let follows = |r: f64| (r - 1.0).abs() < 1e-6 || (r / ratio - 1.0).abs() < 1e-6;
        if ratio < 1.2 || !follows(along) || !follows(across) {
            return None;
        }
        let estimate = |coarse: f64, fine: f64| {
            let limit = fine + (fine - coarse) / (ratio * ratio - 1.0);
            Estimate { limit, error: (fine / limit - 1.0).abs() }
        };
        Some(Self {
            h_c: estimate(coarse.scalars.h_c, fine.scalars.h_c),
            h_min: estimate(coarse.scalars.h_min, fine.scalars.h_min),
        })
    }
}

/// Returns the second difference of the film across the side lobe relative to its minimum: (H_s + H_n − 2
/// H_min)/H_min, with the film thicknesses H_s and H_n at the neighbouring nodes across. Zero for a line contact. For rough
/// surfaces it is relative to half of σ at least.
pub fn side_lobe_curvature(solution: &Solution) -> f64 {
    let ny = solution.y.len();
    let (x, y) = (solution.scalars.x_h_min, solution.scalars.y_h_min);
    let place = |nodes: &[f64], at: f64| nodes.iter().position(|&node| node == at);
    let (Some(i), Some(j)) = (place(&solution.x, x), place(&solution.y, y)) else { return 0.0 };
    let film = |j: usize| solution.film.get(i * ny + j).copied();
    let south = j.checked_sub(1).and_then(film);
    // On the axis, the mirror image is the northern neighbour.
    let north = if j + 1 < ny { film(j + 1) } else { south };
    let least = solution.problem.rough.map_or(0.0, |rough| 0.5 * rough.sigma);
    match (south, film(j), north) {
        (Some(south), Some(lowest), Some(north)) if ny > 1 && lowest.max(least) > 0.0 => {
            (south + north - 2.0 * lowest) / lowest.max(least)
        }
        _ => 0.0,
    }
}

/// Estimates, from one solution, the relative error of H_min due to side lobes narrower than the spacing. Zero for a
/// line contact.
pub fn side_lobe_error(solution: &Solution) -> f64 {
    ERROR_OF_CURVATURE * side_lobe_curvature(solution).max(0.0)
}

/// Returns a warning if the spacing across does not resolve the side lobes in which H_min lies.
pub fn resolution_warning(solution: &Solution) -> Option<Warning> {
    let spacing = |w: &[f64]| (w[1] >= solution.scalars.y_h_min).then(|| w[1] - w[0]);
    let spacing = solution.y.windows(2).find_map(spacing)?;
    let curvature = side_lobe_curvature(solution);
    (curvature > UNRESOLVED_CURVATURE).then(|| {
        // The curvature falls with the square of the spacing.
        let wanted = spacing * (0.5 * UNRESOLVED_CURVATURE / curvature).sqrt();
        Warning::SideLobesUnresolved { spacing, wanted }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_grid_is_finer_where_affordable() {
        for (spec, nodes) in [
            (PointGridSpec::QUICK, (301, 81)),
            (PointGridSpec::DISSERTATION, (601, 81)),
            (PointGridSpec::EXPLORER, (601, 116)),
            (PointGridSpec::FINE, (301, 41)),
            (PointGridSpec::FINEST, (301, 59)),
        ] {
            let second = second_grid(spec);
            assert_eq!(second.nodes(), Ok(nodes), "{spec:?}");
            assert_eq!((second.domain, second.refinement), (spec.domain, spec.refinement));
        }
    }
}
