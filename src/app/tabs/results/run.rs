//! Running study of a scene, a campaign computed elsewhere, or the runs of the Transient tab. The rows are stored and
//! evaluated from time to time.

use crate::app::tabs::transient::Recorded;
use crate::engine::Workbench;
use crate::engine::campaign::Status;
use crate::engine::campaign::watch::{News, watch};
use crate::engine::job::{Background, Job, Standing, Wake};
use crate::host::clock::Stopwatch;
use crate::scene::study::transient;
use crate::scene::{Chart, Scene, SceneOutcome, StudyRow, Table};
use std::path::PathBuf;
use std::time::Duration;

/// Minimum time between two evaluations of a running study.
const LOOK_EVERY: Duration = Duration::from_millis(250);
/// Maximum share of the evaluations in the run time is the inverse of this number.
const LOOK_SHARE: u32 = 20;
/// Maximum number of drawn points of a series. A longer series is thinned by a whole stride.
const DRAWN: usize = 4000;

/// Evaluation of a study, running or complete.
pub struct Look {
    /// Charts of its rows, thinned if there are very many points.
    pub charts: Vec<Chart>,
    /// Values, verdicts and tables.
    pub outcome: SceneOutcome,
    /// Number of rows.
    pub rows: usize,
    /// True if there will be no further rows.
    pub complete: bool,
    /// Time of the evaluation.
    took: Duration,
}

impl Look {
    fn at(scene: &Scene, rows: &[StudyRow], wall_s: f64, complete: bool) -> Self {
        let begun = Stopwatch::start();
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

    /// Creates an evaluation without rows and charts.
    #[cfg(test)]
    pub(super) fn of(outcome: SceneOutcome, complete: bool) -> Self {
        Self { charts: Vec::new(), outcome, rows: 0, complete, took: Duration::ZERO }
    }

    /// Returns a table by its name.
    pub fn table(&self, name: &str) -> Option<&Table> {
        self.outcome.tables.iter().find(|table| table.name == name)
    }
}

/// Rows with their places. The place is 0 for a study that runs here, and the shard for a campaign.
#[derive(Default)]
struct Rows {
    places: Vec<usize>,
    rows: Vec<StudyRow>,
}

impl Rows {
    fn push(&mut self, place: usize, row: StudyRow) {
        self.places.push(place);
        self.rows.push(row);
    }

    fn append(&mut self, mut later: Self) {
        self.places.append(&mut later.places);
        self.rows.append(&mut later.rows);
    }

    /// Sorts the rows by their places, because shards arrive in any order.
    fn sort(&mut self) {
        if !self.places.is_sorted() {
            let rows = std::mem::take(&mut self.rows).into_iter();
            let mut placed: Vec<_> = std::mem::take(&mut self.places).into_iter().zip(rows).collect();
            placed.sort_by_key(|(place, _)| *place);
            (self.places, self.rows) = placed.into_iter().unzip();
        }
    }
}

/// Campaign that is being watched.
pub struct Campaign {
    pub folder: PathBuf,
    /// Progress. `None` until it has been read.
    pub status: Option<Status>,
    watching: Background<News>,
}

/// Study of the Transient tab whose rows are taken over.
struct Followed {
    /// Number of the study.
    number: u64,
    /// Number of rows that have been taken over.
    taken: usize,
    /// True if there will be no further rows.
    ended: bool,
}

/// Study of a scene, with its rows and their last evaluation.
pub struct Run {
    /// Scene at the start of the study.
    pub scene: Scene,
    /// Last evaluation of its rows.
    pub look: Option<Look>,
    /// Campaign that the rows come from. `None` if they are computed here.
    pub campaign: Option<Campaign>,
    /// Study of the Transient tab that the rows come from.
    followed: Option<Followed>,
    /// Running study.
    work: Background<StudyRow>,
    /// All rows. They are moved into an evaluation while it runs, and new rows are collected here meanwhile.
    rows: Rows,
    looking: Background<(Rows, Look)>,
    wake: Wake,
    begun: Stopwatch,
    /// Earliest time of the next evaluation after `begun`.
    next_look: Duration,
    /// True if there are rows that have not been evaluated.
    unseen: bool,
    stopped: bool,
    /// Seconds of the whole study, once it has ended.
    wall_s: Option<f64>,
}

impl Run {
    /// Starts the study of a scene.
    pub fn start(scene: Scene, bench: Workbench, wake: Wake) -> Self {
        let mut run = Self::waiting(scene, wake);
        run.work.run(run.scene.clone().ask(bench, run.wake.clone()));
        run
    }

    /// Watches a campaign of the scene.
    pub fn watch(scene: Scene, folder: PathBuf, wake: Wake) -> Self {
        let mut run = Self::waiting(scene, wake);
        let mut watching = Background::default();
        watching.run(watch(folder.clone(), run.wake.clone()));
        run.campaign = Some(Campaign { folder, status: None, watching });
        run
    }

    /// Follows the runs of the Transient tab. The scene is the document that they belong to.
    pub fn follow(scene: Scene, recorded: &Recorded, wake: Wake) -> Self {
        let mut run = Self::waiting(scene, wake);
        run.followed = Some(Followed { number: recorded.number, taken: 0, ended: false });
        run.take_over(recorded);
        run
    }

    /// Returns the number of the followed study of the Transient tab.
    pub fn follows(&self) -> Option<u64> {
        self.followed.as_ref().map(|followed| followed.number)
    }

    /// Takes over new rows of the followed study. Returns true if there are any, or if it has ended since.
    pub fn take_over(&mut self, recorded: &Recorded) -> bool {
        let Some(followed) = self.followed.as_mut().filter(|followed| followed.number == recorded.number) else {
            return false;
        };
        let new = recorded.rows.get(followed.taken..).unwrap_or_default();
        new.iter().for_each(|row| self.rows.push(0, row.clone()));
        followed.taken = recorded.rows.len();
        self.unseen |= !new.is_empty();
        if let Some(end) = recorded.end.filter(|_| !followed.ended) {
            followed.ended = true;
            (self.stopped, self.wall_s, self.unseen) = (!end.complete, Some(end.wall_s), true);
        }
        self.unseen
    }

    fn waiting(scene: Scene, wake: Wake) -> Self {
        Self {
            scene,
            look: None,
            campaign: None,
            followed: None,
            work: Background::default(),
            rows: Rows::default(),
            looking: Background::default(),
            wake,
            begun: Stopwatch::start(),
            next_look: Duration::ZERO,
            unseen: false,
            stopped: false,
            wall_s: None,
        }
    }

    /// Returns the progress, including that of the last evaluation. `None` for runs of the Transient tab, which cannot be
    /// stopped here.
    pub fn standing(&self) -> Option<Standing> {
        if self.followed.is_some() {
            return None;
        }
        let watching = self.campaign.as_ref().and_then(|campaign| campaign.watching.standing());
        self.work.standing().or(watching).or_else(|| self.looking.standing())
    }

    /// Returns the reason why it ended early.
    pub fn message(&self) -> Option<&String> {
        let watching = self.campaign.as_ref().and_then(|campaign| campaign.watching.message.as_ref());
        self.work.message.as_ref().or(watching)
    }

    /// Returns true if it computes rows that are stored nowhere else.
    pub fn would_lose(&self) -> bool {
        self.campaign.is_none() && self.standing().is_some()
    }

    /// Stops it and keeps its rows.
    pub fn stop(&self) {
        self.work.stop();
        if let Some(campaign) = &self.campaign {
            campaign.watching.stop();
        }
    }

    /// Returns true if further rows may arrive.
    fn goes_on(&self) -> bool {
        let watches = self.campaign.as_ref().is_some_and(|campaign| campaign.watching.job().is_some());
        self.work.job().is_some() || watches || self.followed.as_ref().is_some_and(|followed| !followed.ended)
    }

    /// Receives rows since the last frame.
    pub fn receive(&mut self) {
        let Self { campaign, work, looking, rows, look, unseen, .. } = self;
        self.stopped |= work.job().is_some_and(Job::stopping);
        work.receive(|row| {
            *unseen = true;
            // Fields occur in no chart and no table.
            if !matches!(row, StudyRow::Transient(transient::Row::State { .. })) {
                rows.push(0, row);
            }
        });
        if let Some(Campaign { status, watching, .. }) = campaign {
            self.stopped |= watching.job().is_some_and(Job::stopping);
            watching.receive(|news| match news {
                News::Rows(shard, found) => {
                    *unseen = true;
                    found.into_iter().for_each(|row| rows.push(shard, row));
                }
                News::Status(newer) => *status = Some(*newer),
            });
        }
        looking.receive(|(mut seen, newer)| {
            seen.append(std::mem::take(rows));
            (*rows, *look) = (seen, Some(newer));
        });
        if !self.goes_on() && self.wall_s.is_none() {
            self.wall_s = Some(self.begun.seconds());
            self.unseen = true;
        }
        let due = self.wall_s.is_some() || self.begun.elapsed() >= self.next_look;
        if self.unseen && due && self.looking.job().is_none() {
            self.take_a_look();
        }
    }

    fn take_a_look(&mut self) {
        self.unseen = false;
        let (scene, mut rows, now) = (self.scene.clone(), std::mem::take(&mut self.rows), self.begun.elapsed());
        let complete = self.wall_s.is_some() && !self.stopped && self.message().is_none();
        let wall_s = self.wall_s.unwrap_or_else(|| self.begun.seconds());
        let taken = self.look.as_ref().map_or(Duration::ZERO, |look| look.took);
        self.next_look = now + LOOK_EVERY.max(taken * LOOK_SHARE);
        self.looking.run(Job::start("Evaluating the rows", self.wake.clone(), move |reporter| {
            rows.sort();
            let look = Look::at(&scene, &rows.rows, wall_s, complete);
            reporter.send((rows, look));
            Ok(())
        }));
    }
}
