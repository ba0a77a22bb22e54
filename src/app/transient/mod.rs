//! Contacts in time from the window: what was asked, what has come of it so far, and the moment that is looked at.

pub mod export;
pub mod input;
pub mod method;
mod player;
mod worker;

pub use player::Player;

use super::document::{Document, HOME};
use super::state::State as Window;
use super::task::{Standing, Task};
use crate::scene::{At, Grid, Scene, Study, TransientStudy};
use crate::solver::contact::{ContactKind, OperatingPoint};
use crate::solver::full::transient::{Frame, Inputs, Keep, Quantity, Signal, State, TimeStep, Trajectory, Transient};
use crate::solver::grid::GridSpec;
use crate::solver::lubricant::{Lubricant, ShearLaw};
use egui::Context;
use method::Method;
use std::path::PathBuf;
use std::sync::Arc;
use worker::News;

/// What runs belong to.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// The reference contact.
    pub point: OperatingPoint,
    /// Its lubricant.
    pub lubricant: Lubricant,
    /// What varies, how long, and how it is followed.
    pub study: TransientStudy,
    /// The table that inputs are taken from when it is run.
    pub sampled: Option<PathBuf>,
    /// The grid of the full system.
    pub grid: GridSpec,
}

/// One method in one frame, as far as it has come.
pub struct Run {
    /// How its steps are solved.
    pub method: Method,
    /// What has come of it; how it ended counts once it has.
    pub trajectory: Trajectory,
    /// Seconds that each moment took.
    pub seconds: Vec<f64>,
    /// Whether it has ended.
    pub ended: bool,
    /// What a reduced model is made of.
    pub model: Option<ModelSize>,
    /// Greatest relative difference of H_c from [`TransientView::reference_of`] it, once it has ended.
    pub difference: Option<f64>,
}

/// What a reduced model is made of, and what it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModelSize {
    /// Pressure modes.
    pub modes: usize,
    /// Sampled rows.
    pub rows: usize,
    /// Seconds of its training, with the full trajectories of its own.
    pub training_s: f64,
}

/// What the window knows of contacts in time.
#[derive(Default)]
pub struct TransientView {
    /// What the runs belong to.
    pub setup: Option<Arc<Setup>>,
    /// The runs, in their order; the first is what the others are compared with.
    pub runs: Vec<Run>,
    /// Why there is nothing, or no more.
    pub message: Option<String>,
    /// A field of the form whose entry was refused, and why.
    pub refused: Option<(&'static str, String)>,
    /// The moment that is looked at.
    pub player: Player,
    /// Whether the form is put away.
    pub form_hidden: bool,
    /// Counts the starts: plots of new results forget how the former ones were zoomed.
    pub generation: u64,
    task: Option<Task<News>>,
}

impl Setup {
    /// The march in one of its frames.
    pub fn march(&self, frame: Frame) -> Transient {
        march_of(self.point, self.lubricant, &self.study, frame)
    }

    /// Seconds per unit of T: a/u_m of the reference contact.
    pub fn time_scale_s(&self) -> f64 {
        self.point.hertz().half_width_m / self.point.speed_m_per_s
    }
}

impl Run {
    /// Its name among others.
    pub fn name(&self) -> String {
        method::run_name(self.method, self.frame())
    }

    /// How its domain follows the contact.
    pub fn frame(&self) -> Frame {
        self.trajectory.transient.frame
    }

    /// The last T reached; 0 where not even the start was found.
    pub fn reached(&self) -> f64 {
        self.trajectory.moments.last().map_or(0.0, |moment| moment.time)
    }

    /// The fields last kept at or before T, else the first ones.
    pub fn state_at(&self, time: f64) -> Option<&State> {
        // Times of states are those of moments: rounding must not show the one before.
        let next = self.trajectory.states.partition_point(|state| state.time <= time * (1.0 + 1e-12));
        self.trajectory.states.get(next.saturating_sub(1))
    }

    /// X, P and H of its fields in the scales of the reference contact, without the node outside the inlet.
    pub fn profile<'a>(&'a self, state: &'a State) -> impl Iterator<Item = (f64, f64, f64)> + 'a {
        let scales = state.scales;
        let fields = self.trajectory.x.iter().zip(&state.pressure).zip(&state.film).skip(1);
        fields.map(move |((x, p), h)| (x * scales.half_width, p * scales.pressure, h * scales.film))
    }

    /// The median of the seconds per step, without the start; `None` before the first step.
    pub fn seconds_per_step(&self) -> Option<f64> {
        let mut seconds = self.seconds.get(1..)?.to_vec();
        let middle = seconds.len() / 2;
        (middle < seconds.len()).then(|| *seconds.select_nth_unstable_by(middle, f64::total_cmp).1)
    }
}

impl TransientView {
    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        let Some(task) = &mut self.task else { return };
        let runs = &mut self.runs;
        let ending = task.poll(|news| match (news, runs.last_mut()) {
            (News::Begun { method, trajectory, model }, _) => {
                let trajectory = *trajectory;
                runs.push(Run { method, trajectory, seconds: Vec::new(), ended: false, model, difference: None });
            }
            (News::Moment(moment, seconds), Some(run)) => {
                run.trajectory.moments.push(moment);
                run.seconds.push(seconds);
            }
            (News::State(state), Some(run)) => run.trajectory.states.push(state),
            (News::Ended(ended, rejected), Some(run)) => {
                run.ended = true;
                run.trajectory.ended = ended;
                run.trajectory.rejected_steps = rejected;
            }
            (News::Moment(..) | News::State(_) | News::Ended(..), None) => {}
        });
        for k in 0..self.runs.len() {
            if self.runs[k].ended && self.runs[k].difference.is_none() {
                self.runs[k].difference = self.difference(k);
            }
        }
        if let Some(ending) = ending {
            self.message = ending.err();
            self.task = None;
        }
        let reached = self.runs.iter().map(Run::reached).fold(0.0, f64::max);
        self.player.reached(reached);
    }

    /// What a run is compared with: a reduced one with the full system in its frame, a full one with the first; `None` for the first itself.
    pub fn reference_of(&self, k: usize) -> Option<&Run> {
        let (run, earlier) = (self.runs.get(k)?, self.runs.get(..k)?);
        match run.method {
            Method::Full => earlier.first(),
            Method::Reduced => {
                earlier.iter().find(|other| other.method == Method::Full && other.frame() == run.frame())
            }
        }
    }

    fn difference(&self, k: usize) -> Option<f64> {
        let (run, reference) = (self.runs.get(k)?, self.reference_of(k)?);
        let whole = (0.0, run.reached());
        Some(run.trajectory.difference(&reference.trajectory, Quantity::CentralFilm, whole)?.0)
    }

    /// How far the runs are.
    pub fn standing(&self) -> Option<Standing> {
        self.task.as_ref().map(Task::standing)
    }

    /// Stops the runs; what they have found stays.
    pub fn stop(&self) {
        if let Some(task) = &self.task {
            task.stop();
        }
    }

    fn start(&mut self, ctx: &Context, setup: Setup) {
        let setup = Arc::new(setup);
        self.message = None;
        self.runs.clear();
        self.generation += 1;
        self.player = Player::default();
        self.task = Some(worker::start(ctx, Arc::clone(&setup)));
        self.setup = Some(setup);
    }
}

impl Document {
    /// The contact in time that the tab shows: the document's, or one to begin with.
    pub fn transient_study(&self) -> TransientStudy {
        self.transient.clone().unwrap_or_else(breathing)
    }

    /// Changes the contact in time it describes.
    ///
    /// # Errors
    /// A sentence when it makes no sense; the document is unchanged then.
    pub fn set_transient(&mut self, study: TransientStudy) -> Result<(), String> {
        march_of(self.point, self.lubricant, &study, Frame::Fixed).problem().map_err(|e| e.to_string())?;
        let scene = Scene {
            at: At::from(self.point),
            lubricant: self.lubricant,
            grid: self.transient_grid(),
            study: Study::Transient(study.clone()),
            ..Scene::at_moes(HOME.m, HOME.l)
        };
        scene.check().map_err(|e| e.to_string())?;
        self.transient = Some(study);
        Ok(())
    }

    /// Whether its file holds the contact in time: a scene that asks another question keeps that; a point contact and a lubricant that thins
    /// under shear have none.
    pub fn saves_transient(&self) -> bool {
        let asked = self.scene.as_ref().is_none_or(|scene| matches!(scene.study, Study::Transient(_)));
        asked && self.point.kind == ContactKind::Line && self.lubricant.shear == ShearLaw::Newtonian
    }

    /// The grid of contacts in time: that of a scene of one, else the dissertation's.
    pub fn transient_grid(&self) -> Grid {
        let scene = self.scene.as_ref().filter(|scene| matches!(scene.study, Study::Transient(_)));
        scene.map_or(Grid::DISSERTATION, |scene| scene.grid)
    }
}

fn march_of(point: OperatingPoint, lubricant: Lubricant, study: &TransientStudy, frame: Frame) -> Transient {
    let TransientStudy { inputs, duration, time_step, .. } = study;
    let (inputs, duration, time_step) = (inputs.clone(), *duration, *time_step);
    Transient { point, lubricant, inputs, frame, duration, time_step, keep: Keep::Scalars }
}

/// What the tab begins with: a load that breathes by a tenth, as in Fig. 2.6 (right), twice as long and in coarser steps.
fn breathing() -> TransientStudy {
    TransientStudy {
        inputs: Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 }),
        sampled: None,
        duration: 8.0,
        time_step: TimeStep::Fixed(0.05),
        frames: vec![Frame::Fixed],
        window: None,
        reduced: None,
        mass_between: None,
    }
}

/// The contact in time that a scene describes.
pub fn of_scene(scene: &Scene) -> Option<TransientStudy> {
    match &scene.study {
        Study::Transient(study) => Some(study.clone()),
        _ => None,
    }
}

impl Window {
    /// What would be run.
    pub fn transient_setup(&self) -> Setup {
        let document = &self.document;
        Setup {
            point: document.point,
            lubricant: document.lubricant,
            study: document.transient_study(),
            sampled: self.sampled_path(),
            grid: document.transient_grid().spec().unwrap_or(GridSpec::EXPLORER),
        }
    }

    /// Runs the contact in time that the tab shows, unless it is refused.
    pub fn start_transient(&mut self, ctx: &Context) {
        let setup = self.transient_setup();
        match setup.march(Frame::Fixed).problem() {
            Ok(_) => self.transient.start(ctx, setup),
            Err(error) => self.transient.message = Some(error.to_string()),
        }
    }

    /// Why there are no contacts in time of this kind; `None` where there are.
    pub fn no_transient(&self) -> Option<&'static str> {
        match (self.document.point.kind, self.document.lubricant.shear) {
            (ContactKind::Point, _) => Some("This version follows only line contacts in time; choose a line contact"),
            (ContactKind::Line, ShearLaw::Newtonian) => None,
            _ => Some("This version follows only Newtonian lubricants in time; choose one without shear constants"),
        }
    }
}
