//! Selection of the grid for automatic local models, by trial solutions.
//!
//! All local models share one grid. So the discretisation does not change at their edges, and the full solutions of a
//! split local model can be used by both parts. All trials use the explorer's spacing and outlet.
//!
//! **Inlet**: the shortest of a list for which the central film thicknesses at the first 12 farthest points (3.16)
//! agree with those of a very long inlet to 4e-3. The lightest load with the largest L determines it.
//!
//! **Registration**: with and without, the first half of 48 trial solutions forms a basis, and the second half is
//! projected onto it. The choice with the smaller largest error is used. The trial solutions on the selected grid are
//! the first ones of the training. Registration is useful for wide intervals of M and few modes; for narrow intervals
//! and small losses of information it hardly matters.

use super::build::WindowTraining;
use super::error::TrainingError;
use super::observer::TrainingObserver;
use super::one_thread::on_one_thread;
use super::plan::Within;
use super::spec::{Plan, WindowSpec};
use super::state::{FEWEST, Part, Solved, TrainingState, WindowState};
use crate::solver::discrete::grid::{GridSpec, ReferenceGrid};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::reduced::PodBasis;
use faer::Mat;
use fastrand::Rng;

/// Inlets that are tried, shortest first.
const INLETS: [f64; 7] = [-5.0, -7.0, -10.0, -14.0, -20.0, -28.0, -40.0];
/// Inlet of the comparison: the central film thickness H_c converges with the third power of its length.
const LONG_INLET: f64 = -60.0;
/// Number of points at which inlets are compared. Farthest points start with the smallest M, for which the inlet
/// matters most.
const INLET_POINTS: usize = 12;
/// Largest accepted change of H_c by the inlet: about the discretisation error of the explorer's spacing at M 165 to
/// 500.
const INLET_TOLERANCE: f64 = 4e-3;
/// Number of solutions for the choice of registration.
const TRIAL_POINTS: usize = 48;

/// Selects the grid and creates one local model over the whole range.
///
/// # Errors
/// [`TrainingError`] if the range holds too few points, a full solve fails, or the observer cancels.
pub(super) fn choose(state: &mut TrainingState, observer: &dyn TrainingObserver) -> Result<(), TrainingError> {
    let (spec, whole) = (state.spec.clone(), outward(state.spec.domain().m()));
    let points = Within::all(&spec.range, ContactKind::Line, spec.heats()).farthest_points(
        &[],
        TRIAL_POINTS,
        &mut Rng::with_seed(spec.seed),
    );
    if points.len() < FEWEST {
        return Err(TrainingError::Specification(format!(
            "the range holds {} points that differ; a model needs at least {FEWEST}",
            points.len()
        )));
    }
    let mut tried = |inlet: f64, registered: bool, points: &[OperatingPoint]| {
        let grid = GridSpec::explorer_from(inlet, registered);
        try_grid(state, WindowSpec::new(whole, grid), points, observer)
    };
    let few = &points[..INLET_POINTS.min(points.len())];
    let long = tried(LONG_INLET, true, few)?;
    let (mut inlet, mut change) = (LONG_INLET, 0.0);
    for candidate in INLETS {
        let films = match tried(candidate, true, few) {
            Ok(films) => films,
            // An inlet on which the solver fails is too short.
            Err(TrainingError::NotConverged { .. }) => continue,
            Err(error) => return Err(error),
        };
        let change_here = films.iter().zip(&long).map(|(a, b)| (a.h_c / b.h_c - 1.0).abs()).fold(0.0, f64::max);
        if change_here <= INLET_TOLERANCE {
            (inlet, change) = (candidate, change_here);
            break;
        }
    }
    let mut unexplained = |registered| match tried(inlet, registered, &points) {
        Ok(solved) => {
            held_out(GridSpec::explorer_from(inlet, registered), &solved, observer).map(|error| (error, solved))
        }
        Err(TrainingError::NotConverged { .. }) if !registered => Ok((f64::INFINITY, Vec::new())),
        Err(error) => Err(error),
    };
    let (with, without) = (unexplained(true)?, unexplained(false)?);
    let registered = with.0 <= without.0;
    state.decisions.push(format!(
        "Grid: inlet at {inlet}, which changes H_c by {change:.1e} at most against one at {LONG_INLET}; {}, as held-out trial pressures lie \
         {:.1e} at most off their basis registered and {:.1e} unregistered",
        if registered { "registered by the spike" } else { "not registered" },
        with.0,
        without.0
    ));
    let inherited = match spec.plan {
        // A tensor grid consists of its own points only.
        Plan::Grid { .. } => Vec::new(),
        _ if registered => with.1,
        _ => without.1,
    };
    let window = WindowSpec::new(whole, GridSpec::explorer_from(inlet, registered));
    state.trials.clear();
    state.windows = vec![WindowState::new(window, spec.seed, inherited)];
    Ok(())
}

/// Returns the solutions at some points on a grid; the first ones may exist already.
fn try_grid(
    state: &mut TrainingState,
    window: WindowSpec,
    points: &[OperatingPoint],
    observer: &dyn TrainingObserver,
) -> Result<Vec<Solved>, TrainingError> {
    let k = match state.trials.iter().position(|trial| trial.window == window) {
        Some(k) => k,
        None => {
            state.trials.push(WindowState::new(window, state.spec.seed, []));
            state.trials.len() - 1
        }
    };
    let trial = &mut state.trials[k];
    let decided = trial.solved.len() + trial.pending.len();
    trial.decide(points.iter().skip(decided).copied());
    if !trial.pending.is_empty() {
        let spec = state.spec.clone();
        WindowTraining::new(&spec, window, window.m, None, observer)?.solve_pending(state, Part::Trial(k))?;
    }
    Ok(state.trials[k].solved.clone())
}

/// Returns the largest relative error of the second half's pressures in a basis of the first half.
fn held_out(grid: GridSpec, solved: &[Solved], observer: &dyn TrainingObserver) -> Result<f64, TrainingError> {
    let solved = solved.to_vec();
    on_one_thread(observer, move || {
        let grid = grid.line().map_err(crate::solver::full::SolveError::from)?;
        let (first, second) = solved.split_at(solved.len().div_ceil(2));
        let pressures = Mat::from_fn(grid.xi.len(), first.len(), |i, j| first[j].pressure[i]);
        let basis = PodBasis::new(pressures.as_ref(), &grid.weights, 0.0)
            .ok_or(TrainingError::Decomposition { from: 0.0, to: f64::INFINITY })?;
        Ok(second.iter().map(|s| projection_error(&basis, &grid, &s.pressure)).fold(0.0, f64::max))
    })?
}

/// Returns ‖P − V Vᵀ W P‖/‖P‖ in the norm of the grid's weights.
fn projection_error(basis: &PodBasis, grid: &ReferenceGrid, pressure: &[f64]) -> f64 {
    let size = |v: &[f64]| v.iter().zip(&grid.weights).map(|(v, w)| w * v * v).sum::<f64>().sqrt();
    let mut rest = pressure.to_vec();
    for (mode, share) in basis.modes.col_iter().zip(basis.coefficients(&grid.weights, |i| pressure[i])) {
        rest.iter_mut().zip(mode.iter()).for_each(|(r, v)| *r -= share * v);
    }
    size(&rest) / size(pressure)
}

/// Widens an interval to four significant digits, for display.
pub(super) fn outward((low, high): (f64, f64)) -> (f64, f64) {
    let digits = |v: f64| format!("{v:.3e}").parse().unwrap_or(v);
    // Half of the last digit is subtracted or added before rounding; an end with few digits is unchanged.
    let round = |v: f64, half: f64| {
        let shifted = v + half * 10f64.powf(v.log10().floor());
        if (digits(v) / v - 1.0).abs() < 1e-12 { v } else { digits(shifted) }
    };
    (round(low, -5e-4), round(high, 5e-4))
}

#[cfg(test)]
mod tests {
    use super::super::small::moes;
    use super::*;

    #[test]
    fn intervals_are_widened_to_few_digits_and_never_narrowed() {
        assert_eq!(outward((2.0, 500.0)), (2.0, 500.0));
        assert_eq!(outward((7.356_123, 164.61)), (7.356, 164.7));
        for v in [1.000_1, 1.999_9, 3.3333, 9.999_9, 12.345_678] {
            let (low, high) = outward((v, v));
            assert!(low <= v && high >= v && high - low <= 0.02, "{low} {v} {high}");
        }
    }

    #[test]
    fn what_the_first_half_spans_is_explained() {
        let spec = GridSpec::explorer_from(-5.0, true);
        let grid = spec.line().unwrap();
        let range = moes((5.0, 50.0), (5.0, 8.0), 4e9);
        let point = Within::all(&range, ContactKind::Line, false).farthest_points(&[], 1, &mut Rng::with_seed(1))[0];
        let solved = |a: f64, b: f64| {
            let pressure = grid.xi.iter().map(|x| a * (x * 0.3).cos() + b * (x * 0.7).sin()).collect();
            Solved { place: 0, point, pressure, h_0: 0.0, h_c: 1.0, grid_cost: None, fronts: Vec::new() }
        };
        let spanned = [solved(1.0, 0.0), solved(0.0, 1.0), solved(2.0, 3.0), solved(-1.0, 0.5)];
        assert!(held_out(spec, &spanned, &()).unwrap() < 1e-12);
        let fresh = [solved(1.0, 0.0), solved(2.0, 0.0), solved(1.0, 0.1), solved(0.0, 1.0)];
        assert!(held_out(spec, &fresh, &()).unwrap() > 0.5);
    }
}
