//! Full solutions along a sweep, each from its neighbour.

use super::{MARKERS, Sample, Sweep};
use crate::app::answers::jobs::{GridChoice, wake};
use crate::engine::Store;
use crate::engine::job::{Ending, Job, Reporter};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::full::{Solution, Start, Termination};
use crate::solver::reduced::ReducedModel;
use egui::Context;
use std::sync::Arc;

const NAME: &str = "Full solutions along the curve";

/// Starts them on the grid of a model where there is one, else on the chosen one.
pub fn start(
    ctx: &Context,
    store: &Store,
    sweep: Sweep,
    model: Option<Arc<ReducedModel>>,
    plane: Option<PointGridSpec>,
) -> Job<Sample> {
    let store = store.clone();
    Job::start(NAME, wake(ctx), move |reporter| work(&store, &sweep, model.as_deref(), plane, reporter))
}

fn work(
    store: &Store,
    sweep: &Sweep,
    model: Option<&ReducedModel>,
    plane: Option<PointGridSpec>,
    reporter: &Reporter<Sample>,
) -> Ending {
    let mut former: Option<Solution> = None;
    let mut failed = 0;
    for (k, value) in sweep.values(MARKERS).enumerate() {
        reporter.stage(NAME, k, MARKERS);
        let point = sweep.point(value);
        let grid = GridChoice::of(model, plane, point.moes()).with(store).map_err(|refused| refused.to_string())?;
        let start = former.as_ref().map_or(Start::Cold, Start::From);
        let solution = store
            .with_full_solver(&grid, |solver| solver.solve(&point, sweep.base.lubricant, start, reporter))
            .map_err(|refused| refused.to_string())?;
        if reporter.cancelled() {
            return Ok(());
        }
        match solution.report.termination {
            Termination::Converged => {
                reporter.send(Sample::of(point, &solution, None));
                former = Some(solution);
            }
            _ => failed += 1,
        }
    }
    if failed > 0 {
        Err(format!("{failed} of {MARKERS} full solutions did not converge and are left out"))
    } else {
        Ok(())
    }
}
