//! The live curve: a sweep by the reduced model, one at a time. The latest request counts.

use super::sweeps::CURVE;
use crate::app::refusal::Refusal;
use crate::app::tabs::traction::{Sample, Served, Sweep};
use crate::engine::Store;
use crate::engine::job::{Ending, Job, Standing};
use crate::scene::{Grid, StudyRow};
use egui::Context;
use std::time::Duration;

/// A curve that takes longer than this is given up for a newer one; a shorter one is finished, or it would never be
/// seen while a slider moves.
const PATIENCE: Duration = Duration::from_secs(1);

/// A sweep by the reduced model.
pub struct Curve {
    pub sweep: Sweep,
    /// What drew it.
    pub served: Served,
    /// Its contacts, in their order.
    pub samples: Vec<Sample>,
    /// How many of its contacts the reduced model did not converge at, or a sentence why there is no curve.
    pub left_out: Result<usize, Refusal>,
    /// Some contacts of its companion.
    companions: Vec<Sample>,
    /// Seconds it took.
    pub wall_s: f64,
}

/// A curve under way: contacts that have come, the work, and that of its companion.
struct Running {
    curve: Curve,
    contacts: usize,
    job: Job<StudyRow>,
    ending: Option<Ending>,
    companion: Option<Job<StudyRow>>,
}

/// The curve under way, and the one that is wanted when it has ended.
#[derive(Default)]
pub struct LiveCurve {
    running: Option<Running>,
    next: Option<(Context, Store, Sweep, Served)>,
}

impl LiveCurve {
    /// Wants a curve; it replaces a request that has not begun.
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

    /// How far it is.
    pub fn standing(&self) -> Option<Standing> {
        self.running.as_ref().map(|running| running.job.standing())
    }

    /// A curve that has been finished since the last call.
    pub fn finished(&mut self) -> Option<Curve> {
        let Running { curve, contacts, job, ending, companion } = self.running.as_mut()?;
        if ending.is_none() {
            *ending = job.poll(|row| {
                *contacts += 1;
                curve.add(row);
            });
            curve.wall_s = job.since().elapsed().as_secs_f64();
        }
        // Without its companion a curve is still one.
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
            // It was given up.
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
