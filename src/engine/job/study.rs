//! Runs the study of a scene as a background job. Each message of the job is a row of the study. Where the program has
//! no threads, the job runs in a worker, another instance of the program.

use super::{Ending, Job, JobError, Reporter, Task, Wake};
use crate::engine::{EngineError, Store, Workbench, name_of};
use crate::host::pool::on_spare_cores;
use crate::host::worker;
use crate::scene::study::transient::Model;
use crate::scene::{Scene, Study, StudyObserver, StudyRow};
use crate::solver::reduced::ReducedModel;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

impl StudyObserver for Reporter<StudyRow> {
    fn row(&self, row: StudyRow) {
        self.send(row);
    }

    fn wants_states(&self) -> bool {
        true
    }
}

/// Scene to run in another instance of the program.
#[derive(Serialize, Deserialize)]
pub struct Asked {
    scene: Scene,
    /// Model used instead of an embedded one: for all contacts if the flag is true, else for contacts of its own kind.
    model: Option<(Given, bool)>,
}

/// Reduced model for another instance of the program.
#[derive(Serialize, Deserialize)]
pub enum Given {
    /// Name of an embedded model.
    Program(String),
    /// Any other model, sent as a whole.
    Own(Arc<ReducedModel>),
}

impl Given {
    /// Returns a model in the form in which it is sent.
    pub fn of(model: &Arc<ReducedModel>) -> Self {
        match name_of(model) {
            Some(name) => Self::Program(name),
            None => Self::Own(Arc::clone(model)),
        }
    }

    /// Returns the model.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn model(&self, store: &Store) -> Result<Arc<ReducedModel>, JobError> {
        match self {
            Self::Program(name) => store.embedded(name).map_err(JobError::failed),
            Self::Own(model) => Ok(Arc::clone(model)),
        }
    }
}

impl Task for Asked {
    const KIND: &'static str = "study";
    const LANE: usize = 1;
    type Message = StudyRow;

    fn run(self, store: &Store, reporter: &Reporter<StudyRow>) -> Ending {
        let mut bench = Workbench::on(store, "");
        if let Some((given, for_all)) = &self.model {
            let model = given.model(store)?;
            bench = if *for_all { bench.with_model(&model) } else { bench.using(&model) };
        }
        self.scene.run_job(reporter, |scene| scene.study.run(&scene.experiment(), &mut bench, reporter))
    }
}

/// Transient models to run with the inputs of a scene's transient study.
#[derive(Serialize, Deserialize)]
pub struct Replayed {
    scene: Scene,
    models: Vec<Model>,
}

impl Task for Replayed {
    const KIND: &'static str = "replay";
    const LANE: usize = 1;
    type Message = StudyRow;

    fn run(self, store: &Store, reporter: &Reporter<StudyRow>) -> Ending {
        let Self { scene, models } = self;
        scene.run_job(reporter, |scene| match &scene.study {
            Study::Transient(study) => {
                study.replay(&models, &scene.experiment(), &mut Workbench::on(store, ""), reporter)
            }
            _ => Ok(()),
        })
    }
}

impl Scene {
    /// Starts the study of the scene on a bench. [`Scene::outcome`] evaluates the rows. The rows received before a
    /// stop remain valid.
    pub fn ask(self, mut bench: Workbench, wake: Wake) -> Job<StudyRow> {
        let name = self.title.clone();
        if worker::THREADS {
            return Job::start(&name, wake, move |reporter| {
                self.run_job(reporter, |scene| scene.study.run(&scene.experiment(), &mut bench, reporter))
            });
        }
        let model = bench.in_use().map(|(model, for_all)| (Given::of(model), for_all));
        Job::of(&name, wake, bench.store(), Asked { scene: self, model })
    }

    /// Starts runs of existing transient models with the inputs of the scene's transient study, without the full
    /// solver. The job of any other study returns no rows.
    pub fn replay(self, models: Vec<Model>, store: &Store, wake: Wake) -> Job<StudyRow> {
        let name = self.title.clone();
        Job::of(&name, wake, store, Replayed { scene: self, models })
    }

    /// Checks the scene and runs `work` on all cores but one, which stays free for the window. A cancelled job is not
    /// an error.
    fn run_job(
        &self,
        reporter: &Reporter<StudyRow>,
        work: impl FnOnce(&Self) -> Result<(), EngineError> + Send,
    ) -> Ending {
        let checked = || self.check().map_err(EngineError::from).and_then(|()| work(self));
        match on_spare_cores(checked) {
            Err(error) if !error.cancelled() && !reporter.cancelled() => Err(JobError::failed(error)),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Store;
    use crate::engine::job::{Event, Performer, perform};
    use crate::host::clock::Stopwatch;
    use crate::host::worker::pause;
    use crate::scene::{SceneOutcome, run_scene};
    use std::sync::mpsc::channel;
    use std::time::Duration;

    /// One study of each kind that the explorer also shows on a separate tab.
    const SCENES: [&str; 4] = [
        "study: RandomTest(range: TABLE, tests: 12, seed: 7, method: Reduced(), compare: 3)",
        "study: Sweep(over: [(vary: M, values: Log(from: 10.0, to: 30.0, n: 4))], methods: [Full, Reduced()])",
        "study: ErrorSplit(contacts: Here, method: Reduced())",
        "grid: Uniform(dx: 0.01, domain: (-4.0, 2.0)), study: Transient(inputs: (load: Harmonic(amplitude: 0.1, period: 0.5)), \
         duration: 0.2, time_step: Fixed(0.02), frames: [Fixed], reduced: (loss: 1e-5), linearised: (modes: 12, \
         selection: Distance(tolerance: 0.1), weightings: [DualTaylor]))",
    ];

    /// Returns the rows of a scene after the path through a worker: the task and the rows are serialised.
    fn elsewhere(scene: Scene, store: &Store) -> Vec<StudyRow> {
        let task = rmp_serde::to_vec_named(&Asked { scene, model: None }).unwrap();
        let (sender, events) = channel();
        let send = Box::new(move |event| sender.send(event).unwrap());
        perform::<Asked>(&task, store, Performer { send, stops: Box::new(|| 0) });
        let (mut rows, mut ended) = (Vec::new(), false);
        for event in events {
            match rmp_serde::from_slice(&event).unwrap() {
                Event::Message(row) => rows.push(row),
                Event::Stage(_) => {}
                Event::Ended(ending) => ended = ending.is_ok(),
            }
        }
        assert!(ended);
        rows
    }

    /// Returns all values except measured times.
    fn values(outcome: SceneOutcome) -> Vec<(String, u64)> {
        let timed = |name: &str| {
            let last = name.rsplit('.').next().unwrap_or(name);
            last.ends_with("_s") || last.contains("_s_") || last == "speed_up"
        };
        let values = outcome.found.values.into_iter().filter(|value| !timed(&value.name));
        values.map(|value| (value.name, value.value.to_bits())).collect()
    }

    #[test]
    fn jobs_give_the_same_bits_as_headless_runs() {
        let table = "(axes: {Radius: (2e-3, 4e-3, Linear), Speed: (1.0, 10.0, Linear), Load: (1e5, 5e5, Linear), \
                     Alpha: (5e-9, 20e-9, Linear)}, fixed: {Modulus: 231e9, Viscosity: 0.01})";
        let store = Store::default();
        for study in SCENES {
            let study = study.replace("TABLE", table);
            let text = format!("Scene(version: 1, title: \"t\", at: Moes(m: 20.0, l: 6.0), {study})");
            let scene = Scene::from_ron(&text).unwrap_or_else(|refused| panic!("{text}: {refused}"));
            let headless = values(run_scene(&scene, &mut Workbench::new(""), &()).unwrap());
            assert!(headless.len() > 5, "{study}: {headless:?}");
            // Run twice, so that the second run uses what the first has left in the store.
            for _ in 0..2 {
                let mut job = scene.clone().ask(Workbench::on(&store, ""), Wake::default());
                let (begun, mut rows) = (Stopwatch::start(), Vec::new());
                let ending = loop {
                    if let Some(ending) = job.poll(|row| rows.push(row)) {
                        break ending;
                    }
                    assert!(begun.elapsed() < Duration::from_secs(300), "{study}");
                    pause(Duration::from_millis(5));
                };
                assert!(ending.is_ok(), "{study}: {ending:?}");
                assert_eq!(values(scene.outcome(&rows, 0.0)), headless, "{study}");
            }
            let rows = elsewhere(scene.clone(), &store);
            assert_eq!(values(scene.outcome(&rows, 0.0)), headless, "{study}, by another instance");
        }
    }
}
