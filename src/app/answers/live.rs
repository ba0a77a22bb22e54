//! Reduced solves for the picture. They run on a separate thread, and the frame waits for them for up to 100 ms. On a
//! web page they run in a worker, without waiting, except those by models of the user, which the page itself holds.
//!
//! Most solves take a millisecond, so that the picture changes within the frame. A solve that needs many
//! continuation steps can take a second. The previous picture then stays on the screen in grey, the window remains
//! responsive, and the result appears in a later frame. A panic in the solver does not end the program.

use super::ask::Ask;
use crate::engine::job::{Ending, Given, Job, JobError, Queue, Reporter, Standing, Task, Wake};
use crate::engine::{Answer, Solver, Store, Warning, answer, name_of};
use crate::host::worker;
use crate::scene::{Grid, Method};
use crate::solver::reduced::{Online, ReducedModel};
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Delay that a user perceives as immediate.
pub(super) const AT_ONCE: Duration = Duration::from_millis(100);
/// Run time after which a newer request ends a solve. If every slider movement ended it, the picture would never
/// change.
const LIVE_PATIENCE: Duration = Duration::from_millis(400);

/// Name of a solve on the screen.
const NAME: &str = "Reduced solve";

/// Reason why a request has no result.
#[derive(Debug)]
pub enum Unanswered {
    /// It was stopped on request.
    Stopped,
    /// There is no solution. With the reason as a sentence.
    Failed(String),
}

/// Result of a request.
type Answered = Result<Box<Answer>, Unanswered>;

struct Running {
    ask: Ask,
    solved: Option<Box<Answer>>,
    ending: Option<Ending>,
    job: Job<Box<Answer>>,
    /// What another attempt needs if the instance that solves ends. `None` in the second attempt.
    again: Option<(egui::Context, Arc<ReducedModel>)>,
}

impl Running {
    fn receive_within(&mut self, patience: Duration) {
        let Self { solved, ending, job, .. } = self;
        if ending.is_none() {
            *ending = job.poll_within(patience, |answer| *solved = Some(answer));
        }
    }

    /// Returns what another attempt needs if the instance that solved has ended, and no stop was requested.
    fn lost(&mut self) -> Option<(egui::Context, Arc<ReducedModel>)> {
        let lost = matches!(self.ending, Some(Err(JobError::Lost))) && !self.job.stopping();
        if lost { self.again.take() } else { None }
    }

    /// Returns the result once the solve has ended.
    fn answer(&mut self) -> Option<Answered> {
        Some(match (self.ending.take()?, self.solved.take()) {
            (Ok(()), Some(solved)) => Ok(solved),
            _ if self.job.stopping() => Err(Unanswered::Stopped),
            (Ok(()), None) => Err(Unanswered::Failed("the reduced solve ended without a result".to_owned())),
            (Err(why), _) => Err(Unanswered::Failed(why.to_string())),
        })
    }
}

/// Reduced solve by another instance of the program.
#[derive(Serialize, Deserialize)]
pub struct LiveSolve {
    ask: Ask,
    model: Given,
}

impl Task for LiveSolve {
    const KIND: &'static str = "reduced solve";
    const LANE: usize = 2;
    type Message = Box<Answer>;

    fn run(self, store: &Store, reporter: &Reporter<Box<Answer>>) -> Ending {
        let model = self.model.model(store)?;
        let mut online = store.online(&model, self.ask.options);
        let ending = solve(&mut online, &self.ask, reporter);
        store.give_back(online);
        ending
    }
}

/// Reduced solves that wait or run.
pub struct Live {
    queue: Queue<(Ask, Arc<ReducedModel>), Box<Answer>>,
    /// Solves by other instances of the program, on systems without threads.
    away: Option<Queue<LiveSolve, Box<Answer>>>,
    /// Time between the last result and its request \[s\].
    waited_s: f64,
    running: Vec<Running>,
    patience: Duration,
}

impl Live {
    /// Creates an empty queue that uses the operators of a store.
    pub fn new(store: &Store) -> Self {
        let away = (!worker::THREADS).then(|| Queue::of_tasks("live picture", 1, store));
        let (store, last) = (store.clone(), RefCell::new(None));
        let queue = Queue::new("live picture", 1, move |(ask, model), reporter| {
            // After a panic the solver is lost and is not used again.
            let mut online = prepared(&store, last.take(), &ask, model);
            let ending = solve(&mut online, &ask, reporter);
            last.replace(Some(online));
            ending
        });
        Self { queue, away, waited_s: 0.0, running: Vec::new(), patience: AT_ONCE }
    }

    /// Sets how long a frame waits for a result.
    pub fn be_patient(&mut self, patience: Duration) {
        self.patience = patience;
    }

    /// Submits a request in place of one that has not started, and waits briefly for its result.
    pub fn submit(&mut self, ctx: &egui::Context, ask: Ask, model: Arc<ReducedModel>) {
        let again = Some((ctx.clone(), Arc::clone(&model)));
        self.attempt(ctx, (ask, model), again);
    }

    fn attempt(
        &mut self,
        ctx: &egui::Context,
        (ask, model): (Ask, Arc<ReducedModel>),
        again: Option<(egui::Context, Arc<ReducedModel>)>,
    ) {
        let late = Arc::new(AtomicBool::new(false));
        let wake = wake_where(ctx, Arc::clone(&late));
        self.running.iter().for_each(|running| running.job.give_up_after(LIVE_PATIENCE));
        let away = self.away.as_ref();
        let job = match away.and_then(|away| Some((away, name_of(&model)?))) {
            Some((away, name)) => away.submit(0, NAME, wake, LiveSolve { ask, model: Given::Program(name) }),
            None => self.queue.submit(0, NAME, wake, (ask, model)),
        };
        self.running.retain(|running| running.job.begun());
        let mut running = Running { ask, solved: None, ending: None, job, again };
        running.receive_within(self.patience);
        if running.ending.is_none() {
            // From here on the job requests a repaint when it ends. A job that ended just before did not, so poll
            // once more.
            late.store(true, Ordering::SeqCst);
            running.receive_within(Duration::ZERO);
            if running.ending.is_some() {
                ctx.request_repaint();
            }
        }
        self.running.push(running);
    }

    /// Returns the results that have arrived since the last call, with their requests. Solves that were ended for a
    /// newer request return nothing.
    pub fn poll(&mut self) -> Vec<(Ask, Answered)> {
        let mut answers = Vec::new();
        let (mut newer, mut lost) = (self.running.len(), None);
        self.running.retain_mut(|running| {
            newer -= 1;
            // Only once: what ends between two calls would be taken for a failure.
            running.receive_within(Duration::ZERO);
            if let Some((ctx, model)) = running.lost() {
                lost = Some((ctx, running.ask, model)).filter(|_| newer == 0);
                return false;
            }
            let Some(answer) = running.answer() else { return true };
            self.waited_s = running.job.since().seconds();
            if answer.is_ok() || newer == 0 {
                answers.push((running.ask, answer));
            }
            false
        });
        if let Some((ctx, ask, model)) = lost {
            self.attempt(&ctx, (ask, model), None);
        }
        answers
    }

    /// Returns the time between the last result and its request \[s\].
    pub fn waited_s(&self) -> f64 {
        self.waited_s
    }

    /// Returns true while a result is outstanding.
    pub fn busy(&self) -> bool {
        !self.running.is_empty()
    }

    /// Returns the progress of the newest solve.
    pub fn standing(&self) -> Option<Standing> {
        self.running.last().map(|running| running.job.standing())
    }

    /// Stops the running solves. They notice it before their next attempt.
    pub fn stop(&self) {
        self.running.iter().for_each(|running| running.job.stop());
    }

    /// Drops all solves, because other models are in use from now on.
    pub fn forget(&mut self) {
        self.running.clear();
    }
}

/// Returns a signal that requests a repaint for a result, once no frame waits for it any more.
fn wake_where(ctx: &egui::Context, late: Arc<AtomicBool>) -> Wake {
    let ctx = ctx.clone();
    Wake::new(move || {
        if late.load(Ordering::SeqCst) {
            ctx.request_repaint();
        }
    })
}

/// Returns a solver for a request: the previous one with its stored solutions if model and options match, else a
/// new one.
fn prepared(store: &Store, last: Option<Online>, ask: &Ask, model: Arc<ReducedModel>) -> Online {
    let serves = |online: &Online| *online.options() == ask.options && Arc::ptr_eq(&online.model, &model);
    match last {
        Some(online) if serves(&online) => online,
        other => {
            if let Some(former) = other {
                store.give_back(former);
            }
            store.online(&model, ask.options)
        }
    }
}

fn solve(online: &mut Online, ask: &Ask, reporter: &Reporter<Box<Answer>>) -> Ending {
    // The picture must depend on the present request alone, not on previous ones.
    online.forget();
    let request = ask.key.request(Grid::Model, Method::EMBEDDED);
    let answer = answer(&request, Solver::Reduced(online), reporter).map_err(|error| error.to_string())?;
    let none = answer.result.warnings.iter().find(|warning| matches!(warning, Warning::NoReducedSolution { .. }));
    if let Some(why) = none {
        return Err(why.to_string().into());
    }
    reporter.send(Box::new(answer));
    Ok(())
}

#[cfg(test)]
impl Live {
    /// Starts a solve that ends only when it is stopped.
    pub fn endless(&mut self, ask: Ask) {
        let job = Job::start("Reduced solve", Wake::default(), |reporter| {
            while !reporter.cancelled() {
                std::thread::sleep(Duration::from_millis(1));
            }
            Err("cancelled".to_owned().into())
        });
        self.running.push(Running { ask, solved: None, ending: None, job, again: None });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::document::Key;
    use crate::engine::embedded;
    use crate::host::clock::Stopwatch;
    use crate::solver::physics::contact::OperatingPoint;
    use crate::solver::physics::lubricant::Lubricant;
    use crate::solver::reduced::ReducedOptions;

    fn ask_at(share_of_speed: f64) -> Ask {
        let speed_m_per_s = share_of_speed * OperatingPoint::TABLE_2_1.speed_m_per_s;
        let point = OperatingPoint { speed_m_per_s, ..OperatingPoint::TABLE_2_1 };
        let key = Key { point, lubricant: Lubricant::default() };
        Ask { key, plane: None, options: ReducedOptions::default() }
    }

    fn patient() -> Live {
        let mut live = Live::new(&Store::default());
        live.be_patient(Duration::from_secs(60));
        live
    }

    #[test]
    fn who_waits_has_the_answer_at_once_and_who_does_not_is_called() {
        let (ctx, model) = (egui::Context::default(), embedded("line").unwrap());
        let mut live = patient();
        live.submit(&ctx, ask_at(1.0), Arc::clone(&model));
        let (ask, answer) = live.poll().pop().unwrap();
        let at_once = answer.unwrap();
        assert!(ask == ask_at(1.0) && !live.busy() && at_once.result.wall_s > 0.0);
        assert!(!at_once.result.untrained() && at_once.result.warnings.is_empty());

        let called = Arc::new(AtomicBool::new(false));
        let note = Arc::clone(&called);
        ctx.set_repaint_observer(move |_| note.store(true, Ordering::SeqCst));
        live.be_patient(Duration::ZERO);
        // On a busy machine the result may arrive before the first poll. Then there is no repaint request; try
        // again.
        loop {
            live.forget();
            live.submit(&ctx, ask_at(1.0), Arc::clone(&model));
            let at_once = live.running.iter().any(|running| running.ending.is_some());
            if !at_once || called.load(Ordering::SeqCst) {
                break;
            }
        }
        let begin = Stopwatch::start();
        let later = loop {
            if let Some((_, answer)) = live.poll().pop() {
                break answer.unwrap();
            }
            assert!(live.busy() && begin.elapsed() < Duration::from_secs(60));
            std::thread::sleep(Duration::from_millis(1));
        };
        let film = |answer: &Answer| answer.result.scalars.unwrap().h_c;
        assert!((film(&later) / film(&at_once) - 1.0).abs() < 1e-3);
        while !called.load(Ordering::SeqCst) {
            assert!(begin.elapsed() < Duration::from_secs(60), "no repaint is requested");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn only_the_newest_request_is_answered() {
        let (ctx, model) = (egui::Context::default(), embedded("line").unwrap());
        let mut live = patient();
        live.be_patient(Duration::ZERO);
        for k in 0..50 {
            live.submit(&ctx, ask_at(1.0 + 0.01 * f64::from(k)), Arc::clone(&model));
        }
        let (begin, mut answered) = (Stopwatch::start(), Vec::new());
        while live.busy() {
            answered.extend(live.poll().into_iter().map(|(ask, answer)| (ask, answer.is_ok())));
            assert!(begin.elapsed() < Duration::from_secs(60));
            std::thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(answered.pop(), Some((ask_at(1.49), true)));
        live.submit(&ctx, ask_at(1.0), model);
        live.forget();
        assert!(!live.busy() && live.poll().is_empty());
    }

    #[test]
    fn a_solve_whose_worker_has_ended_is_repeated_once() {
        let (ctx, model) = (egui::Context::default(), embedded("line").unwrap());
        let lost = |again| Running {
            ask: ask_at(1.0),
            solved: None,
            ending: None,
            job: Job::start("Reduced solve", Wake::default(), |_| Err(JobError::Lost)),
            again,
        };
        for (again, repeats) in [(Some((ctx, model)), true), (None, false)] {
            let (mut live, begin) = (patient(), Stopwatch::start());
            live.running.push(lost(again));
            let answer = loop {
                if let Some((_, answer)) = live.poll().pop() {
                    break answer;
                }
                assert!(live.busy() && begin.elapsed() < Duration::from_secs(60));
            };
            assert_eq!(answer.is_ok(), repeats);
        }
    }

    #[test]
    fn a_contact_that_is_refused_comes_back_as_a_sentence() {
        let (ctx, model) = (egui::Context::default(), embedded("line").unwrap());
        let mut live = patient();
        live.submit(&ctx, ask_at(f64::NAN), model);
        let (_, answer) = live.poll().pop().unwrap();
        assert!(matches!(answer, Err(Unanswered::Failed(why)) if why.len() > 10));
    }
}
