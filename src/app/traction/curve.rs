//! The live curve: a sweep by the reduced model, one at a time. The latest request counts.

use super::{CURVE, Sample, Served, Sweep};
use crate::engine::Store;
use crate::engine::job::Job;
use crate::scene::{Grid, StudyRow};
use egui::Context;
use std::time::Duration;

/// A curve that takes longer than this is given up for a newer one; a shorter one is finished, or it would never be
/// seen while a slider moves.
const PATIENCE: Duration = Duration::from_secs(1);

/// A sweep by the reduced model.
pub struct Curve {
    /// The sweep.
    pub sweep: Sweep,
    /// What drew it.
    pub served: Served,
    /// Its contacts, in their order.
    pub samples: Vec<Sample>,
    /// How many of its contacts the reduced model did not converge at, or a sentence why there is no curve.
    pub left_out: Result<usize, String>,
    /// Seconds it took.
    pub wall_s: f64,
}

/// The curve under way, and the one that is wanted when it has ended.
#[derive(Default)]
pub struct LiveCurve {
    running: Option<(Curve, usize, Job<StudyRow>)>,
    next: Option<(Context, Store, Sweep, Served)>,
}

impl LiveCurve {
    /// Wants a curve; it replaces a request that has not begun.
    pub fn ask(&mut self, ctx: &Context, store: &Store, sweep: Sweep, served: Served) {
        self.next = Some((ctx.clone(), store.clone(), sweep, served));
        match &self.running {
            Some((_, _, job)) => job.give_up_after(PATIENCE),
            None => self.start_next(),
        }
    }

    fn start_next(&mut self) {
        let Some((ctx, store, sweep, served)) = self.next.take() else { return };
        let question = sweep.question("Traction curve", Grid::Graded, CURVE, served.by.method());
        let job = served.by.ask(&ctx, &store, question);
        let curve = Curve { sweep, served, samples: Vec::new(), left_out: Ok(0), wall_s: 0.0 };
        self.running = Some((curve, 0, job));
    }

    /// A curve that has been finished since the last call.
    pub fn finished(&mut self) -> Option<Curve> {
        let (curve, contacts, job) = self.running.as_mut()?;
        let ending = job.poll(|row| {
            *contacts += 1;
            curve.add(row);
        })?;
        let (mut curve, contacts, job) = self.running.take()?;
        self.start_next();
        curve.wall_s = job.since().elapsed().as_secs_f64();
        match ending {
            // It was given up.
            Ok(()) if contacts < CURVE => None,
            Ok(()) => Some(curve),
            Err(why) => Some(Curve { samples: Vec::new(), left_out: Err(why), ..curve }),
        }
    }
}

impl Curve {
    fn add(&mut self, row: StudyRow) {
        let (StudyRow::Sweep(row), Ok(left_out)) = (row, &mut self.left_out) else { return };
        match Sample::of(&row) {
            Some(sample) => self.samples.push(sample),
            None => *left_out += 1,
        }
    }
}
