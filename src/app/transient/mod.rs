//! Contacts in time from the window: what was asked, what has come of it so far, and the moment that is looked at.

pub mod export;
pub mod input;
pub mod linearised;
pub mod method;
mod player;
mod run;

pub use player::Player;
pub use run::{ModelSize, Run};

use super::answers::jobs::wake;
use super::document::Document;
use super::document::Key;
use super::in_use::question;
use crate::engine::job::{Background, Job, Standing};
use crate::engine::{Store, Workbench};
use crate::scene::study::transient::{Kind, MarchedBy, Model, Row};
use crate::scene::{Grid, LinearisedTransient, Scene, Study, StudyRow, TransientStudy};
use crate::solver::full::transient::{Ended, Frame, Inputs, Moment, Quantity, Signal, TimeStep};
use crate::solver::physics::contact::{ContactKind, OperatingPoint};
use crate::solver::physics::lubricant::{Lubricant, ShearLaw};
use crate::solver::reduced::tpwl::Weighting;
use egui::Context;
use linearised::{Linearised, NumberStudy, OtherRule};
use std::path::{Path, PathBuf};
use std::sync::Arc;

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
    pub grid: Grid,
}

/// What can be asked of contacts in time.
#[derive(Clone, Debug, PartialEq)]
pub enum InTimeCommand {
    /// Run this one.
    Run(Box<Setup>),
    /// Stop the runs, and the study of their linearised model.
    Stop,
    /// Look at the moment T, and stay there.
    GoTo(f64),
    /// Play from the present moment on, or pause.
    TogglePlay,
    /// Play on for seconds of the clock.
    PlayOn(f64),
    /// Study how many operating points it takes.
    StudyNumber,
    /// Stop that study.
    StopNumber,
}

/// What the window knows of contacts in time.
#[derive(Default)]
pub struct TransientView {
    /// What the runs belong to.
    pub setup: Option<Arc<Setup>>,
    /// The runs, in their order; the first is what the others are compared with.
    pub runs: Vec<Run>,
    /// The linearised model of the runs, with what is shown of it.
    pub linearised: Option<Arc<Linearised>>,
    /// How many operating points it takes.
    pub number: NumberStudy,
    /// What runs, and why there is nothing or no more.
    pub work: Background<StudyRow>,
    /// Seconds and moments of the marches that the models of the last frame are trained by, where they are others.
    trained: Option<(f64, Vec<Vec<Moment>>)>,
    /// What the next march by a model is made of.
    model: Option<ModelSize>,
    looking: Background<Linearised>,
    /// Why a model could not be had of a run.
    pub notes: Vec<String>,
    /// The moment that is looked at.
    pub player: Player,
    ctx: Option<Context>,
    /// Counts the starts: plots of new results forget how the former ones were zoomed.
    pub generation: u64,
}

impl Setup {
    /// What a document would have run; where its file lies, the table lies that it takes inputs from.
    pub fn of(document: &Document, file: Option<&Path>) -> Self {
        let study = document.transient_study();
        let folder = file.and_then(Path::parent).unwrap_or(Path::new(""));
        Self {
            point: document.point,
            lubricant: document.lubricant,
            sampled: study.sampled.as_ref().map(|path| folder.join(path)),
            study,
            grid: document.transient_grid(),
        }
    }

    /// The question: the study itself, without what only headless runs compare.
    fn question(&self) -> Scene {
        let once = |linearised: &LinearisedTransient| LinearisedTransient { further: Vec::new(), ..linearised.clone() };
        let study = TransientStudy {
            sampled: self.sampled.clone(),
            further: Vec::new(),
            published: Vec::new(),
            mass_between: None,
            linearised: self.study.linearised.as_ref().map(once),
            ..self.study.clone()
        };
        let key = Key { point: self.point, lubricant: self.lubricant };
        question("Contact in time", &key, self.grid, Study::Transient(study))
    }

    /// Seconds per unit of T: a/u_m of the reference contact.
    pub fn time_scale_s(&self) -> f64 {
        self.point.hertz().half_width_m / self.point.speed_m_per_s
    }
}

impl TransientView {
    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        self.number.receive();
        let (mut rows, works) = (Vec::new(), self.work.job().is_some());
        self.work.receive(|row| rows.push(row));
        for row in rows {
            if let StudyRow::Transient(row) = row {
                self.take(row);
            }
        }
        let stopped = works && self.work.job().is_none() && self.work.message.is_none();
        if let Some(run) = self.runs.last_mut().filter(|run| stopped && !run.ended) {
            (run.ended, run.trajectory.ended) = (true, Ended::Cancelled { time: run.reached() });
        }
        let linearised = &mut self.linearised;
        self.looking.receive(|found| *linearised = Some(Arc::new(found)));
        for k in 0..self.runs.len() {
            if self.runs[k].ended && self.runs[k].difference.is_none() {
                self.runs[k].difference = self.difference(k);
            }
        }
        let reached = self.runs.iter().map(Run::reached).fold(0.0, f64::max);
        self.player.reached(reached);
    }

    fn take(&mut self, row: Row) {
        match (row, self.runs.last_mut()) {
            (Row::Begun { by, trajectory, .. }, _) => {
                let model = self.model.filter(|_| by != MarchedBy::Full);
                self.runs.push(Run::begun(by, *trajectory, model));
            }
            (Row::Moment { moment, seconds, .. }, Some(run)) => {
                run.trajectory.moments.push(moment);
                run.seconds.push(seconds);
            }
            (Row::State { state, .. }, Some(run)) => run.trajectory.states.push(Arc::unwrap_or_clone(state)),
            (Row::Marched(march), Some(run)) => {
                run.ended = true;
                run.trajectory.ended = march.trajectory.ended.clone();
                run.trajectory.rejected_steps = march.trajectory.rejected_steps;
                run.record.clone_from(&march.record);
                if run.by == MarchedBy::Full {
                    self.trained = None;
                }
            }
            (Row::Trained { wall_s, moments, cut_short, .. }, _) => {
                self.trained = Some((wall_s, moments));
                self.notes.extend(cut_short);
            }
            (Row::Model(model), _) => self.take_model(&model),
            (Row::Moment { .. } | Row::State { .. } | Row::Marched(_), None) => {}
        }
    }

    fn take_model(&mut self, made: &Model) {
        let trained_s = self.trained.as_ref().map_or(0.0, |trained| trained.0);
        let what = if matches!(made.kind, Kind::Reduced(_)) { "rows" } else { "operating points" };
        let (modes, chosen, training_s) = (made.modes(), made.chosen(), trained_s + made.wall_s);
        self.model = Some(ModelSize { modes, chosen, what, training_s });
        let (Kind::Linearised { model, .. }, Some(ctx)) = (&made.kind, &self.ctx) else { return };
        let own = self.runs.iter().rev().find(|run| run.by == MarchedBy::Full);
        let own = || own.map(|run| run.trajectory.moments.clone()).into_iter().collect();
        let (trainings, own) = match &self.trained {
            Some((_, trainings)) => (trainings.clone(), false),
            None => (own(), true),
        };
        let model = Arc::clone(model);
        // What the other rule would choose takes longer than a frame.
        self.looking.run(Job::start("Looking into the linearised model", wake(ctx), move |reporter| {
            let other = OtherRule::of(&model);
            reporter.send(Linearised { model, trainings, own, other });
            Ok(())
        }));
    }

    /// How far the runs are.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing().or_else(|| self.looking.standing())
    }

    /// What a run is compared with: a model with the full system in its frame, a full one with the first; `None` for the first itself.
    pub fn reference_of(&self, k: usize) -> Option<&Run> {
        let (run, earlier) = (self.runs.get(k)?, self.runs.get(..k)?);
        match run.by {
            MarchedBy::Full => earlier.first(),
            MarchedBy::Reduced | MarchedBy::Linearised(_) => {
                earlier.iter().find(|other| other.by == MarchedBy::Full && other.frame() == run.frame())
            }
        }
    }

    fn difference(&self, k: usize) -> Option<f64> {
        let (run, reference) = (self.runs.get(k)?, self.reference_of(k)?);
        let whole = (0.0, run.reached());
        Some(run.trajectory.difference(&reference.trajectory, Quantity::CentralFilm, whole)?.0)
    }

    /// The runs of the linearised model, by their weightings.
    pub fn linearised_runs(&self) -> impl Iterator<Item = (Weighting, &Run)> {
        self.runs.iter().filter_map(|run| match run.by {
            MarchedBy::Linearised(weighting) => Some((weighting, run)),
            MarchedBy::Full | MarchedBy::Reduced => None,
        })
    }

    /// The full run that the linearised ones are compared with.
    pub fn reference_of_linearised(&self) -> Option<&Run> {
        let first = self.runs.iter().position(|run| matches!(run.by, MarchedBy::Linearised(_)))?;
        self.reference_of(first)
    }

    /// Does what was asked for.
    pub fn execute(&mut self, ctx: &Context, store: &Store, command: InTimeCommand) {
        match command {
            InTimeCommand::Run(setup) => self.start(ctx, store, *setup),
            InTimeCommand::Stop => self.stop(),
            InTimeCommand::GoTo(time) => self.player.go_to(time),
            InTimeCommand::TogglePlay => self.player.toggle(),
            InTimeCommand::PlayOn(seconds) => {
                let duration = self.setup.as_ref().map_or(0.0, |setup| setup.study.duration);
                self.player.advance(seconds, duration);
            }
            InTimeCommand::StudyNumber => {
                if let (Some(linearised), Some(full)) = (&self.linearised, self.reference_of_linearised()) {
                    let (model, full) = (Arc::clone(&linearised.model), full.without_fields());
                    self.number.start(ctx, model, full);
                }
            }
            InTimeCommand::StopNumber => self.number.work.stop(),
        }
    }

    /// Stops the runs, and the study of their linearised model; what they have found stays.
    pub fn stop(&self) {
        self.work.stop();
        self.number.work.stop();
    }

    /// Runs a contact in time, unless it is refused.
    pub fn start(&mut self, ctx: &Context, store: &Store, setup: Setup) {
        if let Err(error) = setup.study.own_march(setup.point, setup.lubricant, Frame::Fixed).problem() {
            self.work.message = Some(error.to_string());
            return;
        }
        *self = Self { generation: self.generation + 1, ctx: Some(ctx.clone()), ..Self::default() };
        self.work.run(setup.question().ask(Workbench::on(store, ""), wake(ctx)));
        self.setup = Some(Arc::new(setup));
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
        study.own_march(self.point, self.lubricant, Frame::Fixed).problem().map_err(|e| e.to_string())?;
        let asked = question("Contact in time", &self.key(), self.transient_grid(), Study::Transient(study.clone()));
        asked.check().map_err(|e| e.to_string())?;
        self.transient = Some(study);
        Ok(())
    }

    /// Why there are no contacts in time of this kind; `None` where there are.
    pub fn no_transient(&self) -> Option<&'static str> {
        match (self.point.kind, self.lubricant.shear) {
            (ContactKind::Point, _) => Some("This version follows only line contacts in time; choose a line contact"),
            (ContactKind::Line, ShearLaw::Newtonian) => None,
            _ => Some("This version follows only Newtonian lubricants in time; choose one without shear constants"),
        }
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

/// What the tab begins with: a load that breathes by a tenth, as in Fig. 2.6 (right), twice as long and in coarser steps.
fn breathing() -> TransientStudy {
    TransientStudy {
        inputs: Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 4.0 }),
        sampled: None,
        duration: 8.0,
        further: Vec::new(),
        time_step: TimeStep::Fixed(0.05),
        frames: vec![Frame::Fixed],
        window: None,
        trainings: Vec::new(),
        training_loads: Vec::new(),
        reduced: None,
        linearised: None,
        mass_between: None,
        published: Vec::new(),
    }
}
