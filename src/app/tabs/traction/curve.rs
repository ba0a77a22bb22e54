//! Live curve: a sweep by the reduced model. One curve is computed at a time, and the latest request replaces
//! earlier ones.

use super::sweeps::CURVE;
use crate::app::refusal::Refusal;
use crate::app::tabs::traction::{Sample, Served, Sweep};
use crate::engine::Store;
use crate::engine::job::{Ending, Job, Standing};
use crate::scene::{Grid, StudyRow};
use egui::Context;
use std::time::Duration;

/// Run time after which a newer request ends a curve. Shorter curves are completed, because otherwise no curve
/// would appear while a slider moves.
const PATIENCE: Duration = Duration::from_secs(1);

/// Sweep by the reduced model.
pub struct Curve {
    pub sweep: Sweep,
    /// Model that computed it.
    pub served: Served,
    /// Contacts in their order.
    pub samples: Vec<Sample>,
    /// Number of contacts where the reduced model did not converge, or the reason why there is no curve.
    pub left_out: Result<usize, Refusal>,
    /// Contacts of the companion.
    companions: Vec<Sample>,
    /// Computing time \[s\].
    pub wall_s: f64,
}

/// Curve being computed: contacts received so far, its job, and the job of its companion.
struct Running {
    curve: Curve,
    contacts: usize,
    job: Job<StudyRow>,
    ending: Option<Ending>,
    companion: Option<Job<StudyRow>>,
}

/// Curve being computed, and the request that follows it.
#[derive(Default)]
pub struct LiveCurve {
    running: Option<Running>,
    next: Option<(Context, Store, Sweep, Served)>,
}

impl LiveCurve {
    /// Requests a curve. It replaces a request that has not started.
    pub fn ask(&mut self, ctx: &Context, store: &Store, sweep: Sweep, served: Served) {
        self.next = Some((ctx.clone(), store.clone(), sweep, served));
        match &self.running {
            Some(running) => {
                running.job.give_up_after(PATIENCE);
                running.companion.iter().for_each(|job| job.give_up_after(PATIENCE));
            }
            None => self.start_next(),
        }
    }

    fn start_next(&mut self) {
        let Some((ctx, store, sweep, served)) = self.next.take() else { return };
        let ask = |title: &str, sweep: &Sweep, count: usize| {
            served.by.ask(&ctx, &store, sweep.question(title, Grid::Graded, count, served.by.method()))
        };
        let job = ask("Traction curve", &sweep, CURVE);
        let companion = sweep.accompanied().map(|(companion, by)| ask(companion.title(), &by, sweep.companions(CURVE)));
        let (samples, companions, left_out) = (Vec::new(), Vec::new(), Ok(0));
        let curve = Curve { sweep, served, samples, companions, left_out, wall_s: 0.0 };
        self.running = Some(Running { curve, contacts: 0, job, ending: None, companion });
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.running.as_ref().map(|running| running.job.standing())
    }

    /// Returns a curve that has been completed since the last call.
    pub fn finished(&mut self) -> Option<Curve> {
        let Running { curve, contacts, job, ending, companion } = self.running.as_mut()?;
        if ending.is_none() {
            *ending = job.poll(|row| {
                *contacts += 1;
                curve.add(row);
            });
            curve.wall_s = job.since().elapsed().as_secs_f64();
        }
        // A missing companion does not prevent the curve.
        if let Some(job) = companion
            && job.poll(|row| curve.companions.extend(Sample::of_row(&row, &curve.sweep))).is_some()
        {
            *companion = None;
        }
        if companion.is_some() || ending.is_none() {
            return None;
        }
        let Running { mut curve, contacts, ending, .. } = self.running.take()?;
        self.start_next();
        curve.sweep.note_companions(&mut curve.samples, &curve.companions);
        match ending? {
            // The curve was ended for a newer request.
            Ok(()) if contacts < CURVE => None,
            Ok(()) => Some(curve),
            Err(why) => Some(Curve { samples: Vec::new(), left_out: Err(Refusal::new(why.to_string())), ..curve }),
        }
    }
}

impl Curve {
    fn add(&mut self, row: StudyRow) {
        let (StudyRow::Sweep(row), Ok(left_out)) = (row, &mut self.left_out) else { return };
        match Sample::of(&row, &self.sweep.base.lubricant) {
            Some(sample) => self.samples.push(sample),
            None => *left_out += 1,
        }
    }
}
