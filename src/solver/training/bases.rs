//! Bases from full solutions, and the number of modes they need.

use super::state::Solved;
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::reduced::{
    Combined, Keeping, PodBasis, PressureModes, SharedBasis, Snapshot, deformation_weights, keep_snapshots,
};
use faer::Mat;
use std::sync::Arc;

/// Maximum number of solutions by which a cell is judged.
const MOST_JUDGED: usize = 300;
/// Film thickness above which the error of the pressure itself counts, instead of that relative to the film thickness.
pub(super) const THIN: f64 = 0.1;

/// Bases common to all local models around anchors.
#[derive(Clone)]
pub(super) struct InCommon {
    /// Common deformation basis; deformations are smooth, so that one basis is sufficient.
    pub deformation: Arc<PodBasis>,
    /// Basis of which their pressure modes are combinations, if they share one.
    pub pressure: Option<Arc<SharedBasis>>,
}

/// Returns the root mean square error of the solutions' pressures with no mode, one, two, …, relative to the film
/// thickness where that is small. `None` if the decomposition fails.
pub(super) fn missed_by_modes(solutions: &[&Solved], grid: &ContactGrid) -> Option<Vec<f64>> {
    let every = solutions.len().div_ceil(MOST_JUDGED).max(1);
    let judged: Vec<&&Solved> = solutions.iter().step_by(every).collect();
    let count = judged.len();
    let pressures = Mat::from_fn(grid.len(), count, |i, j| judged[j].pressure[i] / judged[j].least_film().min(THIN));
    let basis = PodBasis::new(pressures.as_ref(), grid.weights(), 0.5)?;
    let mut rest = 0.0;
    let missed = basis.singular_values.iter().rev().map(|sigma| {
        rest += sigma * sigma;
        (rest / count as f64).sqrt()
    });
    let mut missed: Vec<f64> = missed.collect();
    missed.reverse();
    Some(missed)
}

/// Returns the number of modes for which this error is at most `missing`; `None` if the decomposition fails.
pub(super) fn modes_missing(solutions: &[Solved], grid: &ContactGrid, missing: f64) -> Option<usize> {
    let missed = missed_by_modes(&solutions.iter().collect::<Vec<_>>(), grid)?;
    Some(missed.iter().position(|missed| *missed <= missing).unwrap_or(missed.len()))
}

/// Returns the number of modes for which the error of each solution is at most `missing`; `None` if the decomposition
/// fails.
pub(super) fn modes_missing_of_any(solutions: &[Solved], grid: &ContactGrid, missing: f64) -> Option<usize> {
    let (nodes, weights) = (grid.len(), grid.weights());
    let pressures = Mat::from_fn(nodes, solutions.len(), |i, j| solutions[j].pressure[i]);
    let basis = PodBasis::new(pressures.as_ref(), weights, 0.0)?;
    let most = solutions.iter().map(|solved| {
        let shares = basis.coefficients(weights, |i| solved.pressure[i]);
        let (mut rest, limit) = (0.0, (missing * solved.least_film().min(THIN)).powi(2));
        let spare = shares.iter().rev().take_while(|share| {
            rest += *share * *share;
            rest <= limit
        });
        shares.len() - spare.count()
    });
    most.max()
}

/// Computes the POD of pressures (of max(P, 0) if `positive`) and of deformations, each up to a loss of information
/// and a number of modes, rounded to the stored precision. Bases in `in_common` are used instead, if given. Also
/// returns the snapshots in the pressure basis, for the solutions with the model's `own` lubricant.
pub(super) fn bases(
    ([pressure_loss, deformation_loss], most, keeping): ([f64; 2], usize, Keeping),
    positive: bool,
    grid: &ContactGrid,
    (solutions, own): (&[Solved], &[bool]),
    in_common: Option<InCommon>,
) -> Option<(PressureModes, Arc<PodBasis>, Vec<Snapshot>)> {
    let (nodes, weights) = (grid.len(), grid.weights());
    let pressures = Mat::from_fn(nodes, solutions.len(), |i, j| {
        let pressure = solutions[j].pressure[i];
        if positive { pressure.max(0.0) } else { pressure }
    });
    let (shared, deformation) = in_common.map_or((None, None), |own| (own.pressure, Some(own.deformation)));
    let pressure = match shared {
        Some(shared) => Combined::of(&shared, &pressures, weights, (pressure_loss, most))?,
        None => {
            let basis = PodBasis::new(pressures.as_ref(), weights, pressure_loss)?.cut(most);
            PressureModes::own(basis.kept(keeping.accuracy()), grid)
        }
    };
    let deformation = match deformation {
        Some(deformation) => deformation,
        None => Arc::new(PodBasis::new(grid.flex(&pressures).as_ref(), &deformation_weights(grid), deformation_loss)?),
    };
    let coefficients = pressure.coefficients(weights, &pressures);
    let mut snapshots: Vec<Snapshot> = solutions
        .iter()
        .zip(coefficients.col_iter())
        .zip(own)
        .filter(|(_, own)| **own)
        .map(|((s, coefficients), _)| Snapshot {
            point: s.point,
            coefficients: coefficients.iter().copied().collect(),
            h_0: s.h_0,
            h_c: s.h_c,
            fronts: Vec::new(),
            grid_cost: s.grid_cost,
        })
        .collect();
    keep_snapshots(&mut snapshots, pressure.count(), keeping);
    Some((pressure, deformation, snapshots))
}
