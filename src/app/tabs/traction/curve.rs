//! Live curve: a sweep by the reduced model, or by fast full solutions. One curve is computed at a time, and the latest
//! request replaces earlier ones. Where a model covers only a part of the curve, full solutions complete it afterwards.

use super::sweeps::{CURVE, REDUCED_STRIBECK, STRIBECK};
use crate::app::document::Key;
use crate::app::in_use::InUse;
use crate::app::refusal::Refusal;
use crate::app::tabs::traction::{Sample, Served, Sweep, Varied};
use crate::app::wake::wake;
use crate::engine::job::{Ending, Job, Standing};
use crate::engine::{Store, Workbench};
use crate::scene::{Grid, Method, StudyRow};
use egui::Context;
use std::time::Duration;

/// Run time after which a newer request ends a curve. Shorter curves are completed, because otherwise no curve
/// would appear while a slider moves.
const PATIENCE: Duration = Duration::from_secs(1);

/// Sweep by the reduced model or by fast full solutions.
#[derive(Clone)]
pub struct Curve {
    pub sweep: Sweep,
    /// Method that computed it.
    pub served: Served,
    /// Contacts in their order.
    pub samples: Vec<Sample>,
    /// Number of contacts without convergence, or the reason why there is no curve.
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
    /// Number of contacts of the curve.
    wanted: usize,
    job: Job<StudyRow>,
    ending: Option<Ending>,
    companion: Option<Job<StudyRow>>,
    /// Full solutions that complete the curve, with their contacts so far. They start after the curve of the model.
    rest: Option<(Option<Job<StudyRow>>, Vec<Sample>)>,
    ctx: Context,
    store: Store,
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
        // The model's part of the curve is there already.
        self.running.take_if(|running| matches!(running.rest, Some((Some(_), _))));
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
            let method = served.by.as_ref().map_or(Method::Full, InUse::method);
            let question = sweep.question(title, Grid::Graded, count, method);
            match &served.by {
                Some(by) => by.ask(&ctx, &store, question),
                None => question.ask(Workbench::on(&store, ""), wake(&ctx)),
            }
        };
        let rough = sweep.base.lubricant.is_rough();
        let wanted = match (sweep.varied, &served.by) {
            (Varied::Speed, None) => STRIBECK,
            (Varied::Speed, Some(_)) if rough => REDUCED_STRIBECK,
            _ => CURVE,
        };
        let job = ask("Traction curve", &served.part_of(&sweep), wanted);
        let companion =
            sweep.accompanied().map(|(companion, by)| ask(companion.title(), &by, sweep.companions(wanted)));
        let (samples, companions, left_out) = (Vec::new(), Vec::new(), Ok(0));
        let rest = served.part.map(|_| (None, Vec::new()));
        let curve = Curve { sweep, served, samples, companions, left_out, wall_s: 0.0 };
        self.running = Some(Running { curve, contacts: 0, wanted, job, ending: None, companion, rest, ctx, store });
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.running.as_ref().map(|running| match &running.rest {
            Some((Some(rest), _)) => rest.standing(),
            _ => running.job.standing(),
        })
    }

    /// Returns a curve that has been completed since the last call, or the model's part of it.
    pub fn finished(&mut self) -> Option<Curve> {
        if let Some(running) = self.running.as_mut().filter(|running| matches!(running.rest, Some((Some(_), _)))) {
            if !running.completes() {
                return None;
            }
            let Running { curve, .. } = self.running.take()?;
            self.start_next();
            return Some(curve);
        }
        let Running { curve, contacts, job, ending, companion, .. } = self.running.as_mut()?;
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
        if self.next.is_none()
            && let Some(running) = &mut self.running
            && running.contacts >= running.wanted
            && running.complete()
        {
            return Some(running.curve.clone());
        }
        let Running { mut curve, contacts, wanted, ending, .. } = self.running.take()?;
        self.start_next();
        curve.sweep.note_companions(&mut curve.samples, &curve.companions);
        match ending? {
            // The curve was ended for a newer request.
            Ok(()) if contacts < wanted => None,
            Ok(()) => Some(curve),
            Err(why) => Some(Curve { samples: Vec::new(), left_out: Err(Refusal::new(why.to_string())), ..curve }),
        }
    }
}

impl Running {
    /// Starts the full solutions that complete the curve; returns false if the model covers all of it.
    fn complete(&mut self) -> bool {
        let Self { curve: Curve { sweep, served, .. }, rest, ctx, store, .. } = self;
        let (Some((job, _)), Some(by)) = (rest, &served.by) else { return false };
        let question = sweep.question("Full solutions outside the trained range", Grid::Model, STRIBECK, Method::Full);
        *job = Some(by.ask(ctx, store, question));
        true
    }

    /// Receives the full solutions. Returns true once the curve is complete.
    fn completes(&mut self) -> bool {
        let Self { curve, rest, .. } = self;
        let Some((Some(job), beyond)) = rest else { return true };
        let Some((low, high)) = curve.served.part else { return true };
        let ended = job.poll(|row| beyond.extend(Sample::of_row(&row, &curve.sweep)));
        if ended.is_none() {
            return false;
        }
        let varied = curve.sweep.varied;
        let value = |sample: &Sample| varied.of(&Key { point: sample.point, lubricant: curve.sweep.base.lubricant });
        beyond.retain(|sample| !(low..=high).contains(&value(sample)));
        curve.samples.append(beyond);
        curve.samples.sort_by(|a, b| value(a).total_cmp(&value(b)));
        true
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
