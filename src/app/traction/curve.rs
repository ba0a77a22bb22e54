//! The live curve: a thread that solves a sweep by the reduced model, each contact from its neighbour. The latest request counts.

use super::{CURVE, Sample, Served, Sweep};
use crate::app::in_use::Chain;
use crate::app::jobs::guarded;
use crate::solver::reduced::{Calibration, ReducedSolution};
use egui::Context;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
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

struct Request {
    sweep: Sweep,
    served: Served,
    ctx: Context,
}

#[derive(Default)]
struct Mail {
    wanted: Option<Request>,
    closed: bool,
}

#[derive(Default)]
struct Shared {
    mail: Mutex<Mail>,
    wake: Condvar,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Mail> {
        // Every change to it is one assignment: it is whole even where a thread panicked.
        self.mail.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The thread.
pub struct Worker {
    shared: Arc<Shared>,
    curves: Receiver<Curve>,
}

impl Default for Worker {
    fn default() -> Self {
        let shared = Arc::new(Shared::default());
        let (sender, curves) = channel();
        let theirs = Arc::clone(&shared);
        // Where no thread can be had there is no curve, and the tab says that it waits.
        let _handle = std::thread::Builder::new().name("traction curve".into()).spawn(move || work(&theirs, &sender));
        Self { shared, curves }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.shared.lock().closed = true;
        self.shared.wake.notify_all();
    }
}

impl Worker {
    /// Wants a curve; it replaces a request that has not begun.
    pub fn ask(&self, ctx: &Context, sweep: Sweep, served: Served) {
        self.shared.lock().wanted = Some(Request { sweep, served, ctx: ctx.clone() });
        self.shared.wake.notify_one();
    }

    /// The newest curve that came since the last call.
    pub fn latest(&self) -> Option<Curve> {
        self.curves.try_iter().last()
    }
}

fn work(shared: &Shared, curves: &Sender<Curve>) {
    let mut chain: Option<Chain> = None;
    loop {
        let request = {
            let mut mail = shared.lock();
            loop {
                if mail.closed {
                    return;
                }
                if let Some(request) = mail.wanted.take() {
                    break request;
                }
                mail = shared.wake.wait(mail).unwrap_or_else(PoisonError::into_inner);
            }
        };
        let Request { sweep, served, ctx } = request;
        let begun = Instant::now();
        let given_up = || {
            let mail = shared.lock();
            mail.closed || mail.wanted.is_some() && begun.elapsed() > PATIENCE
        };
        let mut solver =
            chain.take().filter(|chain| chain.in_use == served.by).unwrap_or_else(|| Chain::new(&served.by));
        let solved = guarded(|| {
            let solved = solve(&mut solver, &sweep, served.untrained.is_some(), given_up);
            (solver, solved)
        });
        let (samples, left_out) = match solved {
            Ok((solver, Some((samples, left_out)))) => {
                chain = Some(solver);
                (samples, Ok(left_out))
            }
            Ok((solver, None)) => {
                chain = Some(solver);
                continue;
            }
            Err(message) => (Vec::new(), Err(message)),
        };
        let curve = Curve { sweep, served, samples, left_out, wall_s: begun.elapsed().as_secs_f64() };
        if curves.send(curve).is_err() {
            return;
        }
        ctx.request_repaint();
    }
}

/// The contacts of a sweep and what it lacks; `None` where it was given up.
fn solve(
    chain: &mut Chain,
    sweep: &Sweep,
    untrained: bool,
    given_up: impl Fn() -> bool,
) -> Option<(Vec<Sample>, LeftOut)> {
    let mut samples = Vec::with_capacity(CURVE);
    let mut left_out = LeftOut::default();
    for value in sweep.values(CURVE) {
        if given_up() {
            return None;
        }
        let point = sweep.point(value);
        match chain.solve(&point, sweep.base.lubricant) {
            Ok((solved, _)) if untrained && doubtful(chain, &solved) => left_out.doubtful += 1,
            Ok((solved, fields)) => samples.push(Sample::of(point, &fields, solved.traction)),
            Err(_) => left_out.failed += 1,
        }
    }
    Some((samples, left_out))
}

/// Whether a solution that the model was not trained for has a residual far beyond those of its training range.
fn doubtful(chain: &Chain, solved: &ReducedSolution) -> bool {
    let window = chain.in_use.model.windows.get(solved.window);
    let measured = window.and_then(|window| window.calibration.as_ref()).map(Calibration::largest_residual);
    measured.is_some_and(|largest| solved.residual_estimate > RESIDUAL * largest)
}
