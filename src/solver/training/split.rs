//! Split of a local model over M that needs too many pressure modes. Both parts inherit its full solutions, since
//! they share one grid.
//!
//! The edge lies where both parts need the same number of modes. The cost of a reduced solve grows with the cube of
//! the number of modes, the size of the model with the number of local models. A basis with as many modes as
//! solutions is poor, so the number of initial solutions (`start`) should clearly exceed the number of modes.

use super::error::TrainingError;
use super::observer::TrainingObserver;
use super::one_thread::on_one_thread;
use super::spec::WindowSpec;
use super::state::{OVERLAP, Solved, TrainingState, WindowState};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::reduced::PodBasis;
use faer::Mat;
use fastrand::Rng;

/// Maximum number of local models.
const MOST_WINDOWS: usize = 16;
/// Narrowest interval of M, as the ratio of its ends.
const NARROWEST: f64 = 1.4;
/// Number of bisections for the edge.
const HALVINGS: usize = 8;

/// Returns true if local model `k` can be split.
pub(super) fn may_split(state: &TrainingState, k: usize) -> bool {
    let (low, high) = state.windows[k].window.m;
    state.windows.len() < MOST_WINDOWS && high > low * NARROWEST * NARROWEST
}

/// Replaces local model `k` by two, with the edge where the solutions of both need the same number of modes.
///
/// # Errors
/// [`TrainingError`] if the solutions cannot be decomposed, or if the observer cancels.
pub(super) fn split(state: &mut TrainingState, k: usize, observer: &dyn TrainingObserver) -> Result<(), TrainingError> {
    let own = &state.windows[k];
    let (from, to) = own.window.m;
    let (wanted, solved) = (own.window.grid, own.solved.clone());
    let edge = on_one_thread(observer, move || {
        let grid = wanted.build().map_err(crate::solver::full::SolveError::from)?;
        balanced_edge(&solved, (from, to), &grid).ok_or(TrainingError::Decomposition { from, to })
    })??;
    let mut rng = Rng::with_seed(own.seed);
    let [low, high] = [(from, edge), (edge, to)].map(|m| {
        let inherited = own.solved.iter().filter(|s| reached(m, (from, to), s)).cloned();
        WindowState::new(WindowSpec { m, ..own.window }, rng.u64(..), inherited)
    });
    let decision = format!(
        "M {from}…{to} needs more pressure modes than a window may have (seen at {} full solutions): split at {edge}",
        own.solved.len()
    );
    state.decisions.push(decision);
    state.windows.splice(k..=k, [low, high]);
    Ok(())
}

/// Returns true if a part is trained with a solution of the whole: within the part, or beyond its inner edge by the
/// overlap.
fn reached(part: (f64, f64), whole: (f64, f64), solved: &Solved) -> bool {
    let m = solved.point.moes().m;
    (part.0 == whole.0 || m >= part.0 / OVERLAP) && (part.1 == whole.1 || m <= part.1 * OVERLAP)
}

/// Returns the M, to two digits, at which both sides need the same number of modes for a loss of information; `None`
/// if the whole cannot be decomposed.
///
/// The loss is that of three quarters as many modes as solutions. A smaller loss would need nearly as many modes as
/// solutions on either side, and would compare their numbers only.
fn balanced_edge(solved: &[Solved], whole: (f64, f64), grid: &ContactGrid) -> Option<f64> {
    let basis = |part: (f64, f64), loss: f64| {
        let inside: Vec<&Solved> = solved.iter().filter(|s| reached(part, whole, s)).collect();
        let pressures = Mat::from_fn(grid.len(), inside.len(), |i, j| inside[j].pressure[i]);
        if inside.is_empty() { None } else { PodBasis::new(pressures.as_ref(), grid.weights(), loss) }
    };
    let loss = basis(whole, 0.0)?.loss(solved.len() * 3 / 4);
    // A side without solutions needs no mode.
    let modes = |part| basis(part, loss).map_or(0, |basis| basis.modes.ncols());
    let (mut low, mut high) = (whole.0 * NARROWEST, whole.1 / NARROWEST);
    for _ in 0..HALVINGS {
        let edge = (low * high).sqrt();
        if modes((whole.0, edge)) < modes((edge, whole.1)) {
            low = edge;
        } else {
            high = edge;
        }
    }
    format!("{:.1e}", (low * high).sqrt()).parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::discrete::grid::GridSpec;
    use crate::solver::physics::contact::ContactKind;
    use crate::solver::training::plan::Within;
    use crate::solver::training::small::moes;

    /// Solutions whose pressures have nothing in common: each needs its own mode.
    fn solutions(grid: &ContactGrid) -> Vec<Solved> {
        let range = moes((2.0, 500.0), (2.0, 8.0), 6e9);
        let points = Within::all(&range, ContactKind::Line, false).farthest_points(&[], 60, &mut Rng::with_seed(1));
        let solved = points.into_iter().enumerate().map(|(place, point)| {
            let pressure = (0..grid.len()).map(|i| if i > 1 && i % 64 == place { 1.0 } else { 0.0 }).collect();
            Solved { place, point, pressure, h_0: 0.0, h_c: 1.0, grid_cost: None, fronts: Vec::new() }
        });
        solved.collect()
    }

    #[test]
    fn the_edge_lies_where_both_sides_need_equally_many_modes() {
        let grid = GridSpec::explorer_from(-5.0, true).build().unwrap();
        let solved = solutions(&grid);
        let edge = balanced_edge(&solved, (2.0, 500.0), &grid).unwrap();
        let below = solved.iter().filter(|s| s.point.moes().m <= edge * OVERLAP).count();
        let above = solved.iter().filter(|s| s.point.moes().m >= edge / OVERLAP).count();
        assert!(below.abs_diff(above) <= 10, "{below} {above}");
    }

    #[test]
    fn halves_reach_beyond_their_common_edge_only() {
        let grid = GridSpec::explorer_from(-5.0, true).build().unwrap();
        let solved = solutions(&grid);
        let of = |part| -> Vec<f64> {
            solved.iter().filter(|s| reached(part, (2.0, 500.0), s)).map(|s| s.point.moes().m).collect()
        };
        let (low, high) = (of((2.0, 20.0)), of((20.0, 500.0)));
        assert!(low.iter().all(|m| *m <= 20.0 * OVERLAP) && high.iter().all(|m| *m >= 20.0 / OVERLAP));
        assert!(low.len() + high.len() > solved.len());
    }
}
