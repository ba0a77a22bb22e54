//! The live curve: a thread that solves a sweep by the reduced model, each contact from its neighbour. The latest request counts.

use super::{CURVE, Sample, Served, Sweep};
use crate::app::answers::jobs::wake;
use crate::app::in_use::Solvers;
use crate::engine::Store;
use crate::engine::job::{Job, Queue, Reporter, guarded};
use crate::solver::reduced::{Calibration, ReducedSolution};
use egui::Context;
use std::time::{Duration, Instant};

/// A curve that takes longer than this is given up for a newer one; a shorter one is finished, or it would never be seen while a slider moves.
const PATIENCE: Duration = Duration::from_secs(1);

/// How many times the largest residual that was measured when a model was trained an answer may have where it was not trained. Answers with
/// more are none: they are left out.
const RESIDUAL: f64 = 2.0;

/// Contacts that a curve lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct LeftOut {
    /// The reduced model did not converge there.
    pub failed: usize,
    /// It was not trained for them, and its residual is far beyond those it was measured with.
    pub doubtful: usize,
}

/// A sweep by the reduced model.
pub struct Curve {
    /// The sweep.
    pub sweep: Sweep,
    /// What drew it.
    pub served: Served,
    /// Its contacts, in their order.
    pub samples: Vec<Sample>,
    /// What it lacks, or a sentence why there is no curve.
    pub left_out: Result<LeftOut, String>,
    /// Seconds it took.
    pub wall_s: f64,
}

/// The thread.
pub struct Worker {
    queue: Queue<(Sweep, Served), Curve>,
    running: Vec<Job<Curve>>,
}

impl Worker {
    /// Solves with what is in a store.
    pub fn new(store: &Store) -> Self {
        let store = store.clone();
        let work = move |(sweep, served): (Sweep, Served), reporter: &Reporter<Curve>| {
            let begun = Instant::now();
            let mut solvers = Solvers::new(&store, &served.by);
            let solved = guarded(|| solve(&mut solvers, &sweep, &served, || reporter.cancelled()));
            let (samples, left_out) = match solved {
                Ok(Some((samples, left_out))) => (samples, Ok(left_out)),
                Ok(None) => return Ok(()),
                Err(message) => (Vec::new(), Err(message)),
            };
            reporter.send(Curve { sweep, served, samples, left_out, wall_s: begun.elapsed().as_secs_f64() });
            Ok(())
        };
        Self { queue: Queue::new("traction curve", 1, work), running: Vec::new() }
    }

    /// Wants a curve; it replaces a request that has not begun.
    pub fn ask(&mut self, ctx: &Context, sweep: Sweep, served: Served) {
        let job = self.queue.submit(0, "Traction curve", wake(ctx), (sweep, served));
        self.running.retain(Job::begun);
        self.running.iter().for_each(|running| running.give_up_after(PATIENCE));
        self.running.push(job);
    }

    /// The newest curve that came since the last call.
    pub fn latest(&mut self) -> Option<Curve> {
        let mut newest = None;
        self.running.retain_mut(|running| running.poll(|curve| newest = Some(curve)).is_none());
        newest
    }
}

/// The contacts of a sweep and what it lacks; `None` where it was given up.
fn solve(
    solvers: &mut Solvers,
    sweep: &Sweep,
    served: &Served,
    given_up: impl Fn() -> bool,
) -> Option<(Vec<Sample>, LeftOut)> {
    let mut samples = Vec::with_capacity(CURVE);
    let mut left_out = LeftOut::default();
    for value in sweep.values(CURVE) {
        if given_up() {
            return None;
        }
        let point = sweep.point(value);
        match solvers.along(&point, sweep.base.lubricant) {
            Ok((solved, _)) if served.untrained.is_some() && doubtful(served, &solved) => left_out.doubtful += 1,
            Ok((solved, fields)) => samples.push(Sample::of(point, &fields, solved.traction)),
            Err(_) => left_out.failed += 1,
        }
    }
    Some((samples, left_out))
}

/// Whether a solution that the model was not trained for has a residual far beyond those of its training range.
fn doubtful(served: &Served, solved: &ReducedSolution) -> bool {
    let window = served.by.model.windows.get(solved.window);
    let measured = window.and_then(|window| window.calibration.as_ref()).map(Calibration::largest_residual);
    measured.is_some_and(|largest| solved.residual_estimate > RESIDUAL * largest)
}
