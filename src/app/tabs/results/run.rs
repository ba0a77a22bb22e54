//! A scene's study at work beside the window: its rows are kept, and looked at now and then.

use crate::engine::Workbench;
use crate::engine::job::{Background, Job, Standing, Wake};
use crate::scene::study::transient;
use crate::scene::{Chart, Scene, SceneOutcome, StudyRow, Table};
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
    /// What taking it took.
    took: Duration,
}

impl Look {
    fn at(scene: &Scene, rows: &[StudyRow], wall_s: f64, complete: bool) -> Self {
        let begun = Instant::now();
        let mut charts = scene.study.charts(rows);
        for series in charts.iter_mut().flat_map(|chart| &mut chart.series) {
            let stride = series.points.len().div_ceil(DRAWN).max(1);
            if stride > 1 {
                series.points = series.points.iter().copied().step_by(stride).collect();
                series.name = format!("{}, one in {stride}", series.name);
            }
        }
        let outcome = scene.outcome(rows, wall_s);
        Self { charts, outcome, rows: rows.len(), complete, took: begun.elapsed() }
    }

    /// A table by its name.
    pub fn table(&self, name: &str) -> Option<&Table> {
        self.outcome.tables.iter().find(|table| table.name == name)
    }
}

/// The study of a scene: its rows, and the last look at them.
pub struct Run {
    /// The scene as it was when it was run.
    pub scene: Scene,
    /// The last look at its rows.
    pub look: Option<Look>,
    /// What runs, and why it ended early.
    pub work: Background<StudyRow>,
    /// All rows; they are lent to a look while it is taken, and new ones wait here.
    rows: Vec<StudyRow>,
    looking: Background<(Vec<StudyRow>, Look)>,
    wake: Wake,
    begun: Instant,
    next_look: Instant,
    /// Rows that no look has seen.
    unseen: bool,
    stopped: bool,
    /// Seconds of the whole study, once it has ended.
    wall_s: Option<f64>,
}

impl Run {
    /// Starts the study of a scene.
    pub fn start(scene: Scene, bench: Workbench, wake: Wake) -> Self {
        let mut work = Background::default();
        work.run(scene.clone().ask(bench, wake.clone()));
        let begun = Instant::now();
        Self {
            scene,
            look: None,
            work,
            rows: Vec::new(),
            looking: Background::default(),
            wake,
            begun,
            next_look: begun,
            unseen: false,
            stopped: false,
            wall_s: None,
        }
    }

    /// How far it is, the last look included.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing().or_else(|| self.looking.standing())
    }

    /// Takes in what came since the last frame.
    pub fn receive(&mut self) {
        let Self { work, looking, rows, look, unseen, .. } = self;
        self.stopped |= work.job().is_some_and(Job::stopping);
        work.receive(|row| {
            *unseen = true;
            // Fields are in no chart and no table.
            if !matches!(row, StudyRow::Transient(transient::Row::State { .. })) {
                rows.push(row);
            }
        });
        looking.receive(|(mut seen, newer)| {
            seen.append(rows);
            (*rows, *look) = (seen, Some(newer));
        });
        if work.job().is_none() && self.wall_s.is_none() {
            self.wall_s = Some(self.begun.elapsed().as_secs_f64());
            *unseen = true;
        }
        let due = self.wall_s.is_some() || Instant::now() >= self.next_look;
        if self.unseen && due && self.looking.job().is_none() {
            self.take_a_look();
        }
    }

    fn take_a_look(&mut self) {
        self.unseen = false;
        let (scene, rows, now) = (self.scene.clone(), std::mem::take(&mut self.rows), Instant::now());
        let complete = self.wall_s.is_some() && !self.stopped && self.work.message.is_none();
        let wall_s = self.wall_s.unwrap_or_else(|| self.begun.elapsed().as_secs_f64());
        let taken = self.look.as_ref().map_or(Duration::ZERO, |look| look.took);
        self.next_look = now + LOOK_EVERY.max(taken * LOOK_SHARE);
        self.looking.run(Job::start("Looking at the rows", self.wake.clone(), move |reporter| {
            let look = Look::at(&scene, &rows, wall_s, complete);
            reporter.send((rows, look));
            Ok(())
        }));
    }
}
