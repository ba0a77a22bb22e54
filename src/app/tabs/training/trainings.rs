//! Training of reduced models: running job, unfinished training, trained model.

use super::presets;
use super::worker::{self, Files, Found, Made, Running};
use crate::app::notice::Notice;
use crate::app::refusal::Refusal;

use super::chart::Chart;
use super::comparison::Comparison;
use super::worker::{Ended, Trained};
use crate::app::answers::Answers;
use crate::app::document::Document;
use crate::engine::job::{Background, Standing};
use crate::engine::registry::{alike, loads_in_common};
use crate::engine::{Store, catalogue, training_file};
use crate::host::browser;
use crate::solver::reduced::{Domain, ReducedModel};
use crate::solver::training::{Plan, TrainingSpec, TrainingState, WindowState};
use egui::Context;
use std::io::ErrorKind;
use std::path::Path;
use std::sync::Arc;

/// Names of the files in the session's folder.
const FILE: &str = "unfinished.training";
const MODEL_FILE: &str = "trained.rom";

/// Changes of a training or of its model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrainingCommand {
    /// Stop what runs.
    Stop,
    /// Resume the unfinished training.
    Resume,
    /// Delete the unfinished training, also on disk.
    Discard,
    /// Delete the trained model, also on disk.
    ThrowAway,
    /// Use the trained model.
    UseMade,
    /// Use the previous model.
    UseFormer,
    /// Remove a model of a file from the comparison, by its index.
    LeaveOut(usize),
}

/// Trainings of this session and their results.
#[derive(Default)]
pub struct Training {
    job: Option<Running>,
    looking: Background<Found>,
    /// Chart of the training.
    pub chart: Arc<Chart>,
    /// Training that the chart and the model belong to.
    pub spec: Option<Box<TrainingSpec>>,
    /// Training that was stopped, failed, or was left by a previous session.
    pub unfinished: Option<Box<TrainingState>>,
    /// True if a previous session left it. It is then not replaced without a confirmation.
    pub left_behind: bool,
    /// Last trained model.
    pub made: Option<Made>,
    /// Model that was in use before it.
    pub former: Option<Arc<ReducedModel>>,
    /// Models of files for the comparison, with the names of the files.
    pub beside: Vec<(String, Arc<ReducedModel>)>,
    /// Comparison of all models.
    pub comparison: Option<Comparison>,
    /// Messages about the last job.
    pub notices: Vec<Notice>,
    files: Option<Files>,
}

impl Training {
    /// Keeps trainings in a folder from now on. A web page has no folders.
    pub fn keep_in(&mut self, folder: &Path) {
        let files = || Files { training: folder.join(FILE), model: folder.join(MODEL_FILE) };
        self.files = (!browser::PAGE).then(files);
    }

    /// Searches for files of a previous session.
    pub fn look(&mut self, ctx: &Context) {
        if let Some(files) = &self.files {
            self.looking.run(worker::look(ctx, files.clone()));
        }
    }

    /// Returns what another training would replace, each as a sentence.
    pub fn replaced(&self) -> Vec<String> {
        let unfinished = self.unfinished.iter().map(|state| {
            format!(
                "The training “{}”, stopped at {} full solutions, is replaced by the new one.",
                state.spec.title,
                state.solutions()
            )
        });
        unfinished.chain(self.unsaved()).collect()
    }

    /// Returns what is lost when the window closes, each as a sentence.
    pub fn unkept(&self) -> Vec<String> {
        let folder = self.files.is_some();
        let runs = self
            .job
            .is_some()
            .then(|| "A training is running, and its full solutions are not stored on disk.".to_owned());
        let stopped = self.unfinished.as_ref().map(|state| {
            format!("The training “{}” was stopped, and its full solutions are not stored on disk.", state.spec.title)
        });
        let in_memory = runs.into_iter().chain(stopped).filter(|_| !folder);
        let model = self.unsaved().filter(|_| self.made.as_ref().is_some_and(|made| !made.kept));
        in_memory.chain(model).collect()
    }

    /// Returns a sentence about a trained model that is not saved.
    pub fn unsaved(&self) -> Option<String> {
        let made = self.made.as_ref().filter(|made| !made.saved)?;
        Some(format!("The model “{}” was trained and is not saved.", made.model.title))
    }

    /// Records that a model was written to a file.
    pub fn saved(&mut self, bytes: &Arc<Vec<u8>>) {
        if let Some(made) = self.made.as_mut().filter(|made| Arc::ptr_eq(&made.bytes, bytes)) {
            made.saved = true;
            self.forget_file();
        }
    }

    /// Removes the file of the model from the session's folder.
    fn forget_file(&mut self) {
        let Some(made) = self.made.as_mut().filter(|made| made.kept) else { return };
        made.kept = false;
        if let Some(files) = &self.files
            && let Err(error) = std::fs::remove_file(&files.model)
            && error.kind() != ErrorKind::NotFound
        {
            self.notices.push(Notice::Wrong(format!("{} cannot be removed: {error}", files.model.display())));
        }
    }

    /// Returns the running training.
    pub fn job(&self) -> Option<&Running> {
        self.job.as_ref()
    }

    /// Returns the progress of a training, of the search for an unfinished one, or of a comparison.
    pub fn standing(&self) -> Option<Standing> {
        let trains = self.job.as_ref().map(|running| running.job.standing());
        trains.or_else(|| self.looking.standing()).or_else(|| self.comparison.as_ref()?.standing())
    }

    /// Starts the training of the document, unless its specification is refused.
    pub fn start(&mut self, ctx: &Context, document: &Document) {
        let Some(spec) = document.training_spec().cloned() else { return };
        // The training uses the cavitation model of the contact, and its heat for a thermal model.
        let heat = document.lubricant.heat.filter(|_| spec.heats());
        let spec = spec.under(document.lubricant.cavitation).heated(heat).on_surfaces(document.lubricant.roughness);
        match spec.check() {
            Ok(()) => self.run(ctx, TrainingState::new(spec)),
            Err(error) => self.notices = vec![Notice::wrong(error)],
        }
    }

    /// Executes a command.
    pub fn execute(&mut self, ctx: &Context, answers: &mut Answers, command: TrainingCommand) {
        match command {
            TrainingCommand::Stop => self.stop(),
            TrainingCommand::Resume => {
                if let Some(state) = self.unfinished.take() {
                    self.run(ctx, *state);
                }
            }
            TrainingCommand::Discard => self.discard(),
            TrainingCommand::ThrowAway => {
                self.forget_file();
                self.made = None;
            }
            TrainingCommand::UseMade => {
                if let Some(made) = &self.made {
                    self.former = answers.use_model(Arc::clone(&made.model));
                }
            }
            TrainingCommand::UseFormer => match (&self.made, self.former.take()) {
                (Some(_), Some(former)) => _ = answers.use_model(former),
                (Some(made), None) => answers.drop_model(&made.model),
                (None, former) => self.former = former,
            },
            TrainingCommand::LeaveOut(place) => {
                if place < self.beside.len() {
                    self.beside.remove(place);
                }
            }
        }
    }

    /// Returns true if the trained model is in use.
    pub fn uses_made(&self, answers: &Answers) -> bool {
        self.made.as_ref().is_some_and(|made| answers.models().contains(&made.model))
    }

    /// Adds the model of a file to the comparison. It is not used for the picture.
    ///
    /// # Errors
    /// A sentence if the file cannot be read.
    pub fn add_beside(&mut self, store: &Store, path: &Path) -> Result<(), Refusal> {
        let model = store.model_of_file(path)?;
        let name = path.file_stem().map_or_else(|| model.title.clone(), |stem| stem.to_string_lossy().into_owned());
        self.beside.retain(|(_, known)| !Arc::ptr_eq(known, &model));
        self.beside.push((name, model));
        Ok(())
    }

    /// Returns the contacts for the comparison of models, and the title they belong to. These are the contacts of
    /// the trained model. Without one, they are those of the model added last for the kind of contact in the form,
    /// otherwise of the model in use, otherwise of the form.
    fn compared(&self, answers: &Answers, document: &Document) -> Option<(String, Domain)> {
        let of = |model: &Arc<ReducedModel>| (model.title.clone(), model.domain.clone());
        if let Some(made) = &self.made {
            return Some(of(&made.model));
        }
        let spec = document.training_spec()?;
        let added = self.beside.iter().rev().map(|(_, model)| model).find(|model| spec.is_of(model));
        let own = spec.domain();
        let model = added.or_else(|| answers.models().counterpart(&own));
        Some(model.map_or_else(|| (spec.title.clone(), own), of))
    }

    /// Returns the models that can be compared, with their names: the built-in model, the one in use, the previous
    /// one, those of files, and the trained one.
    pub fn comparable(&self, answers: &Answers, document: &Document) -> Vec<(String, Arc<ReducedModel>)> {
        self.compared(answers, document).map_or_else(Vec::new, |(_, domain)| self.of_domain(answers, &domain))
    }

    /// Returns the models that can be compared at the contacts of a domain.
    fn of_domain(&self, answers: &Answers, domain: &Domain) -> Vec<(String, Arc<ReducedModel>)> {
        // The model of elliptical contacts is large. It is listed only once it is in use.
        let round = catalogue().iter().filter(|entry| !domain.space.of_ellipses() && alike(&entry.domain, domain));
        let nearest = round.max_by(|a, b| {
            let [a, b] = [a, b].map(|entry| loads_in_common(&entry.domain, domain));
            a.total_cmp(&b)
        });
        let embedded = nearest.and_then(|entry| answers.store().shown(entry.name).ok());
        let in_use = answers.models().counterpart(domain).cloned();
        let known = [("in the program", embedded), ("in use", in_use), ("before", self.former.clone())];
        let known = known.into_iter().filter_map(|(name, model)| Some((name.to_owned(), model?)));
        let made = self.made.iter().map(|made| ("new".to_owned(), Arc::clone(&made.model)));
        let kind = |domain: &Domain| (domain.contact, domain.space.of_ellipses(), domain.heats(), domain.is_rough());
        let mut models: Vec<(String, Arc<ReducedModel>)> = Vec::new();
        // The trained model keeps its name even if it is in use.
        let is_made = |model: &Arc<ReducedModel>| self.made.iter().any(|made| Arc::ptr_eq(&made.model, model));
        for (name, model) in known.chain(self.beside.iter().cloned()).filter(|(_, model)| !is_made(model)).chain(made) {
            if kind(domain) == kind(&model.domain) && !models.iter().any(|(_, known)| Arc::ptr_eq(known, &model)) {
                models.push((name, model));
            }
        }
        models
    }

    /// Starts the comparison of all comparable models.
    pub fn compare(&mut self, ctx: &Context, answers: &Answers, document: &Document) {
        let Some((title, domain)) = self.compared(answers, document) else { return };
        let models = self.of_domain(answers, &domain);
        if models.len() < 2 {
            return;
        }
        match Comparison::start(ctx, answers.store(), models, (title, &domain)) {
            Ok(comparison) => self.comparison = Some(comparison),
            Err(why) => self.notices.push(Notice::wrong(why)),
        }
    }

    /// Runs a training from a state.
    fn run(&mut self, ctx: &Context, state: TrainingState) {
        self.chart = Arc::new(Chart::of(&state));
        self.spec = Some(Box::new(state.spec.clone()));
        self.unfinished = None;
        self.left_behind = false;
        self.notices.clear();
        self.forget_file();
        self.made = None;
        self.comparison = None;
        self.job = Some(Running::start(ctx, state, self.files.clone()));
    }

    fn discard(&mut self) {
        self.unfinished = None;
        self.left_behind = false;
        self.notices.clear();
        if let Some(files) = &self.files
            && let Err(error) = training_file::remove(&files.training)
        {
            self.notices.push(Notice::wrong(error));
        }
    }

    /// Stops what runs.
    pub fn stop(&self) {
        if let Some(running) = &self.job {
            running.job.stop();
        }
        self.comparison.iter().for_each(Comparison::stop);
    }

    /// Receives the results since the last frame.
    pub fn receive(&mut self) {
        let (mut found, mut left) = (None, None);
        self.looking.receive(|what| match what {
            Found::Training(state) => found = Some(state),
            Found::Model(made) => left = Some(made),
        });
        if let Some(made) = left {
            let title = &made.model.title;
            let text = format!("The model “{title}” of a previous session is not saved: save or discard it");
            self.notices.push(Notice::Short(text));
            self.made = Some(made);
        }
        if let Some(state) = found {
            self.chart = Arc::new(Chart::of(&state));
            self.spec = Some(Box::new(state.spec.clone()));
            self.unfinished = Some(state);
            self.left_behind = true;
        }
        if let Some(why) = self.looking.message.take() {
            // The file may belong to another program and must not be overwritten.
            self.files = None;
            self.notices.push(Notice::Wrong(format!("{why}. Until then trainings are not kept on disk")));
        }
        let wrong = self.comparison.as_mut().and_then(Comparison::receive);
        self.notices.extend(wrong.map(Notice::Wrong));
        let Some(running) = &mut self.job else { return };
        let ended = running.receive();
        self.chart = Arc::clone(&running.chart);
        self.notices.extend(running.unkept.take().map(Notice::Wrong));
        let Some((ending, trained)) = ended else { return };
        let seconds = running.job.since().elapsed().as_secs_f64();
        self.job = None;
        self.notices.extend(ending.err().map(|why| Notice::Wrong(why.to_string())));
        if let Some(trained) = trained {
            self.take(trained, seconds);
        }
    }

    fn take(&mut self, trained: Trained, seconds: f64) {
        let Trained { state, ended, made, unkept } = trained;
        self.chart = Arc::new(Chart::of(&state));
        let solutions = state.solutions();
        self.notices.push(match &ended {
            Ended::Complete => Notice::Done(format!(
                "Done with {solutions} full solutions in {}",
                crate::app::numbers::duration(seconds)
            )),
            Ended::Stopped => Notice::Short(format!("Stopped at {solutions} full solutions, which are kept")),
            Ended::Failed(why) => Notice::Wrong(format!("{why}. The {solutions} full solutions until then are kept")),
        });
        if ended == Ended::Complete {
            self.notices.extend(missed_tolerances(&state).into_iter().map(Notice::Short));
        }
        match made {
            Ok(made) => self.made = Some(made),
            Err(why) => self.notices.push(Notice::wrong(why)),
        }
        self.notices.extend(unkept.map(Notice::Wrong));
        self.unfinished = (ended != Ended::Complete && solutions > 0).then(|| Box::new(state));
    }
}

/// Returns tolerances that a finished search could not meet within its limit.
fn missed_tolerances(state: &TrainingState) -> Vec<String> {
    let (tolerances, limit) = match &state.spec.plan {
        Plan::Adaptive { tolerances, limit, .. } => (tolerances.as_slice(), *limit),
        Plan::WorstOfPool { tolerance, limit, .. } => (std::slice::from_ref(tolerance), *limit),
        Plan::FarthestPoint { .. } | Plan::Grid { .. } => (&[][..], 0),
    };
    let missed = |window: &WindowState| {
        let missed = tolerances.get(window.search.rungs.len())?;
        let round = |m: f64| (m * 1e3).round() / 1e3;
        Some(format!(
            "The tolerance {missed:e} could not be met for M {}…{} within the limit of {limit} full solutions; the \
             model is made of the present solutions",
            round(window.window.m.0),
            round(window.window.m.1)
        ))
    };
    state.windows.iter().filter_map(missed).collect()
}

impl Document {
    /// Returns the training that the Training tab shows: the document's, or a default.
    pub fn training_spec(&self) -> Option<&TrainingSpec> {
        let kind = self.point.kind;
        let own = self.training.as_ref().filter(|spec| spec.contact() == kind);
        own.or_else(|| presets::of_kind(kind).first().map(|preset| preset.1))
    }
}
