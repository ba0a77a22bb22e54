//! Local models around anchors: one pool of full solutions over the whole range, divided into cells in (ln M, ln L),
//! with the Moes parameters M and L.
//!
//! All local models share one grid and the pool, which is half of all solutions of the plan, so that a full solution
//! serves every local model near it. A local model with too few solutions computes further ones. A contact for which
//! the full solver does not converge is omitted and named in the log.

use super::bases::{InCommon, THIN, missed_by_modes};
use super::build::WindowTraining;
use super::cell::{Cell, anchor};
use super::error::TrainingError;
use super::layout::outward;
use super::observer::TrainingObserver;
use super::one_thread::on_one_thread;
use super::spec::{TrainingSpec, WindowSpec, Windows};
use super::state::{FEWEST, Part, Solved, TrainingState, WindowState};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::SolveError;
use crate::solver::physics::contact::Moes;
use crate::solver::reduced::{BEYOND_CELLS, Keeping, PodBasis, SharedBasis, deformation_weights, from_anchor};
use faer::Mat;
use fastrand::Rng;
use std::sync::Arc;

/// Number of rounds in which anchors move to the middle of their cells.
const ROUNDS: usize = 30;
/// Computes the pool and creates the local models that divide it.
///
/// # Errors
/// [`TrainingError`] if the range holds too few points, or if the observer cancels.
pub(super) fn choose(state: &mut TrainingState, observer: &dyn TrainingObserver) -> Result<(), TrainingError> {
    let spec = state.spec.clone();
    let (Windows::Anchored { count, modes, grid, divided_by, .. }, Some(each)) =
        (&spec.windows, spec.plan.first_solutions())
    else {
        return Ok(());
    };
    let (count, grid) = (*count, *grid);
    let modes = if *divided_by == 0 { *modes } else { *divided_by };
    let whole = WindowSpec::new(spec.domain().m(), grid);
    if state.trials.is_empty() {
        state.trials.push(WindowState::new(whole, spec.seed, []));
    }
    let mut work = WindowTraining::new(&spec, whole, (0.0, f64::INFINITY), None, observer)?;
    if !state.trials[0].planned {
        let (within, mut random) = (work.within(), Rng::with_seed(spec.seed));
        let points = on_one_thread(observer, move || within.farthest_points(&[], each * count / 2, &mut random))?;
        state.trials[0].decide(points);
        state.trials[0].planned = true;
    }
    work.named = true;
    work.solve_pending(state, Part::Trial(0))?;
    // The state keeps its copy until the local models are created, so that a stopped training can be continued.
    let pool = Arc::new(state.trials[0].solved.clone());
    if pool.len() < FEWEST * count {
        return Err(work.too_few(pool.len()));
    }
    let places: Vec<Moes> = pool.iter().map(|solved| solved.point.moes()).collect();
    let (grid, shared) = (work.grid.clone(), Arc::clone(&pool));
    let anchors = on_one_thread(observer, move || choose_anchors(&shared, &grid, (count, modes)))?;
    let mut seeds = Rng::with_seed(spec.seed);
    for (own, anchor) in anchors.iter().enumerate() {
        let Some(cell) = Cell::of(anchors.iter().map(|anchor| Some(*anchor)), own) else { continue };
        let inside: Vec<f64> = places.iter().filter(|moes| cell.holds(**moes, 0.0)).map(|moes| moes.m).collect();
        let ends = inside.iter().fold((f64::INFINITY, 0.0f64), |(low, high), m| (low.min(*m), high.max(*m)));
        let m = outward((ends.0.max(whole.m.0), ends.1.min(whole.m.1)));
        // The cell includes the region of blending, so that blending does not extrapolate.
        let near = pool.iter().zip(&places).filter(|(_, moes)| cell.holds(**moes, 2.0 * BEYOND_CELLS));
        let own: Vec<Solved> = near.map(|(solved, _)| solved.clone()).collect();
        let window = WindowSpec { m, anchor: Some((anchor.m, anchor.l)), ..whole };
        state.windows.push(WindowState::new(window, seeds.u64(..), own));
    }
    state.trials.clear();
    Ok(())
}

/// Computes the common bases of all local models around anchors, from the initial solutions in each one's own cell.
/// `None` without anchors.
///
/// # Errors
/// [`TrainingError`] if a decomposition fails, or if the observer cancels.
pub(super) fn in_common(
    spec: &TrainingSpec,
    windows: &[WindowState],
    observer: &dyn TrainingObserver,
) -> Result<Option<InCommon>, TrainingError> {
    let (Windows::Anchored { grid, shared, .. }, Some(first)) = (spec.windows.clone(), windows.first()) else {
        return Ok(None);
    };
    let mut pool = Vec::new();
    for (k, window) in windows.iter().enumerate() {
        let Some(cell) = Cell::of(windows.iter().map(|window| anchor(&window.window)), k) else { return Ok(None) };
        let own = window.solved.iter().take(window.inherited);
        pool.extend(own.filter(|solved| cell.holds(solved.point.moes(), 0.0)).cloned());
    }
    let heat = spec.heats();
    let (wanted, loss, (from, to), positive) = (grid, spec.deformation_loss, first.window.m, spec.positive_modes);
    let bases = on_one_thread(observer, move || {
        let grid = wanted.build().map_err(SolveError::from)?;
        let value = |p: f64| if positive { p.max(0.0) } else { p };
        let failed = || TrainingError::Decomposition { from, to };
        let pressures = Mat::from_fn(grid.len(), pool.len(), |i, j| pool[j].pressure[i]);
        let deformation = PodBasis::new(grid.flex(&pressures).as_ref(), &deformation_weights(&grid), loss);
        let deformation = Arc::new(deformation.ok_or_else(failed)?);
        if shared == 0 {
            return Ok(InCommon { deformation, pressure: None });
        }
        let counted =
            Mat::from_fn(grid.len(), pool.len(), |i, j| value(pressures[(i, j)]) / pool[j].least_film().min(THIN));
        let basis = PodBasis::new(counted.as_ref(), grid.weights(), 0.0).ok_or_else(failed)?.cut(shared);
        let keeping = Keeping { kind: grid.kind(), anchored: true, heat, shapes: false };
        let basis = basis.kept(keeping.accuracy());
        Ok(InCommon { deformation, pressure: Some(Arc::new(SharedBasis::new(basis, &grid))) })
    })?;
    bases.map(Some)
}

/// Returns at most `count` anchors by ascending M. Repeatedly divides the cell whose pressures have the largest error
/// with this number of modes, relative to the film thickness.
fn choose_anchors(pool: &[Solved], grid: &ContactGrid, (count, modes): (usize, usize)) -> Vec<Moes> {
    let places: Vec<Moes> = pool.iter().map(|solved| solved.point.moes()).collect();
    let mut anchors = middles(&places, 1);
    let mut missed: Vec<Option<f64>> = vec![None];
    while anchors.len() < count {
        let cells = cells(&places, &anchors);
        for (missed, cell) in missed.iter_mut().zip(&cells).filter(|(missed, _)| missed.is_none()) {
            *missed = Some(missing(pool, cell, grid, modes));
        }
        let worst = (0..anchors.len()).max_by(|&a, &b| missed[a].unwrap_or(0.0).total_cmp(&missed[b].unwrap_or(0.0)));
        let Some(worst) = worst.filter(|&worst| cells[worst].len() >= 2 * FEWEST) else { break };
        let inside: Vec<Moes> = cells[worst].iter().map(|k| places[*k]).collect();
        let halves = middles(&inside, 2);
        anchors.splice(worst..=worst, halves);
        missed.splice(worst..=worst, [None, None]);
        // Borders of other cells may have moved; their contents show this.
        let after = self::cells(&places, &anchors);
        let mut before: Vec<&[usize]> = cells.iter().map(Vec::as_slice).collect();
        before.splice(worst..=worst, [[].as_slice(), [].as_slice()]);
        for (missed, (before, after)) in missed.iter_mut().zip(before.iter().zip(&after)) {
            if *before != after.as_slice() {
                *missed = None;
            }
        }
    }
    anchors.sort_by(|a, b| a.m.total_cmp(&b.m));
    anchors
}

/// Returns, for each anchor, the places nearest to it.
fn cells(places: &[Moes], anchors: &[Moes]) -> Vec<Vec<usize>> {
    let mut cells = vec![Vec::new(); anchors.len()];
    for (k, moes) in places.iter().enumerate() {
        cells[nearest(anchors, *moes)].push(k);
    }
    cells
}

fn nearest(anchors: &[Moes], moes: Moes) -> usize {
    let far = |k: &usize| from_anchor(moes, anchors[*k]);
    (0..anchors.len()).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0)
}

/// Returns the root mean square error of a cell's pressures with this number of modes, relative to the film thickness
/// where that is small: an error of P deforms a film by the same amount, whatever its thickness. The error is zero if
/// there are no more solutions than modes. Only solutions of the basis itself are used; the error of others would
/// concentrate the division at the corners of the range.
fn missing(pool: &[Solved], cell: &[usize], grid: &ContactGrid, modes: usize) -> f64 {
    let solutions: Vec<&Solved> = cell.iter().map(|k| &pool[*k]).collect();
    missed_by_modes(&solutions, grid).map_or(f64::INFINITY, |missed| missed.get(modes).copied().unwrap_or(0.0))
}

/// Returns the centres of `count` cells of (ln M, ln L).
fn middles(places: &[Moes], count: usize) -> Vec<Moes> {
    let mut anchors: Vec<Moes> = places.first().copied().into_iter().collect();
    while anchors.len() < count.min(places.len()) {
        let far = |moes: &&Moes| from_anchor(**moes, anchors[nearest(&anchors, **moes)]);
        let farthest = places.iter().max_by(|a, b| far(a).total_cmp(&far(b)));
        anchors.extend(farthest.copied());
    }
    for _ in 0..ROUNDS {
        let mut sums = vec![(0.0, 0.0, 0.0); anchors.len()];
        for moes in places {
            let sum = &mut sums[nearest(&anchors, *moes)];
            *sum = (sum.0 + 1.0, sum.1 + moes.m.ln(), sum.2 + moes.l.ln());
        }
        for (anchor, (count, m, l)) in anchors.iter_mut().zip(sums) {
            if count > 0.0 {
                *anchor = Moes { m: f64::exp(m / count), l: f64::exp(l / count) };
            }
        }
    }
    anchors
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::physics::contact::{ContactKind, MoesRequest, si_from_moes};
    use crate::solver::training::small::line_grid;

    #[test]
    fn where_pressures_differ_most_the_range_is_divided_most() {
        let grid = line_grid(80).build().unwrap();
        let mut rng = Rng::with_seed(3);
        let contact = |m| si_from_moes(&MoesRequest::new(ContactKind::Line, m, 8.0)).unwrap();
        let solved = |place: usize| {
            let m = 4.0 * 1.1f64.powi(place as i32 % 40);
            let low = m < 12.0;
            let shift = if low { rng.f64() } else { 0.0 };
            let bump = |x: f64| (1.0 - (x - 0.3 * shift).powi(2)).max(0.0).sqrt();
            let pressure = (0..grid.len()).map(|i| bump(grid.place(i).0)).collect();
            Solved { place, point: contact(m), pressure, h_0: 0.0, h_c: 0.2, grid_cost: None, fronts: Vec::new() }
        };
        let pool: Vec<Solved> = (0..120).map(solved).collect();
        let low =
            |modes: usize| choose_anchors(&pool, &grid, (6, modes)).iter().filter(|anchor| anchor.m < 12.0).count();
        assert!(low(4) >= 4, "{}", low(4));
        // As many modes as solutions leave no error anywhere.
        assert!(low(120) < low(4), "{}", low(120));
    }

    #[test]
    fn every_place_lies_in_one_cell_and_beside_it_in_the_next() {
        let places: Vec<Moes> =
            (0..400).map(|k| Moes { m: 2.0 * 1.3f64.powi(k % 20), l: 0.5 * 1.2f64.powi(k / 20) }).collect();
        let anchors = middles(&places, 9);
        assert_eq!(anchors.len(), 9);
        let cells: Vec<Cell> = (0..9).map(|own| Cell::of(anchors.iter().map(|a| Some(*a)), own).unwrap()).collect();
        for moes in &places {
            let held = |beyond| cells.iter().filter(|cell| cell.holds(*moes, beyond)).count();
            assert!(held(0.0) == 1 && held(10.0) == 9);
        }
        for cell in &cells {
            let own = places.iter().filter(|moes| cell.holds(**moes, 0.0)).count();
            assert!((20..90).contains(&own), "{own}");
        }
    }
}
