//! A scene's study at work beside the window: its rows are kept there, and what they look like so far comes here.

use crate::engine::Store;
use crate::engine::Workbench;
use crate::engine::job::{Background, Job, Reporter, Wake, on_spare_cores};
use crate::scene::{Chart, Scene, SceneOutcome, StudyObserver, StudyRow, Table};
use crate::solver::observer::{Observer, Progress};
use crate::solver::training::TrainingObserver;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Shortest time between two looks at a study that runs.
const LOOK_EVERY: Duration = Duration::from_millis(250);
/// A look takes at most this share of the study's time.
const LOOK_SHARE: u32 = 20;
/// Points of a series that are drawn; of more only every second, third… one is.
const DRAWN: usize = 4000;

/// What a study looks like: while it runs, or when it has ended.
pub struct Look {
    /// How its rows are best looked at, thinned where there are very many points.
    pub charts: Vec<Chart>,
    /// Values, verdicts and tables.
    pub outcome: SceneOutcome,
    /// Rows so far.
    pub rows: usize,
    /// Whether this is all there will be.
    pub complete: bool,
}

impl Look {
    fn at(scene: &Scene, rows: &[StudyRow], begun: Instant, complete: bool) -> Self {
        let mut charts = scene.study.charts(rows);
        for series in charts.iter_mut().flat_map(|chart| &mut chart.series) {
            let stride = series.points.len().div_ceil(DRAWN).max(1);
            if stride > 1 {
                series.points = series.points.iter().copied().step_by(stride).collect();
                series.name = format!("{}, one in {stride}", series.name);
            }
        }
        let outcome = scene.outcome(rows, begun.elapsed().as_secs_f64());
        Self { charts, outcome, rows: rows.len(), complete }
    }

    /// A table by its name.
    pub fn table(&self, name: &str) -> Option<&Table> {
        self.outcome.tables.iter().find(|table| table.name == name)
    }
}

/// The study of a scene: the last look at it, and its work.
pub struct Run {
    /// The scene as it was when it was run.
    pub scene: Scene,
    /// The last look at its rows.
    pub look: Option<Look>,
    /// What runs, and why it ended early.
    pub work: Background<Look>,
}

impl Run {
    /// Starts the study of a scene, whose relative paths refer to `base`.
    pub fn start(scene: Scene, base: PathBuf, store: Store, wake: Wake) -> Self {
        let mut work = Background::default();
        let own = scene.clone();
        work.run(Job::start("Results", wake, move |reporter: &Reporter<Look>| {
            let mut bench = Workbench::on(&store, base);
            let watch = Watch::new(&own, reporter);
            own.check().map_err(|refused| format!("the scene is refused: {refused}"))?;
            let ended = on_spare_cores(|| own.study.run(&own.experiment(), &mut bench, &watch));
            let stopped = reporter.cancelled();
            watch.look(ended.is_ok() && !stopped);
            match ended {
                Err(_) if stopped => Ok(()),
                ended => ended.map_err(|error| error.to_string()),
            }
        }));
        Self { scene, look: None, work }
    }

    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        let look = &mut self.look;
        self.work.receive(|newer| *look = Some(newer));
    }
}

/// Keeps the rows, and looks at them now and then.
struct Watch<'a> {
    scene: &'a Scene,
    reporter: &'a Reporter<Look>,
    begun: Instant,
    kept: Mutex<Kept>,
}

struct Kept {
    rows: Vec<StudyRow>,
    next_look: Instant,
}

impl<'a> Watch<'a> {
    fn new(scene: &'a Scene, reporter: &'a Reporter<Look>) -> Self {
        let begun = Instant::now();
        Self { scene, reporter, begun, kept: Mutex::new(Kept { rows: Vec::new(), next_look: begun }) }
    }

    fn look(&self, complete: bool) {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        self.reporter.send(Look::at(self.scene, &kept.rows, self.begun, complete));
    }
}

impl Observer for Watch<'_> {
    fn progress(&self, progress: Progress) {
        self.reporter.progress(progress);
    }

    fn cancelled(&self) -> bool {
        self.reporter.cancelled()
    }
}

impl TrainingObserver for Watch<'_> {}

impl StudyObserver for Watch<'_> {
    fn row(&self, row: StudyRow) {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.rows.push(row);
        let now = Instant::now();
        if now >= kept.next_look {
            self.reporter.send(Look::at(self.scene, &kept.rows, self.begun, false));
            kept.next_look = Instant::now() + LOOK_EVERY.max(now.elapsed() * LOOK_SHARE);
        }
    }
}
