//! Random validation (3.17) of the reduced model over its trained range, as the study of a scene.

use crate::app::in_use::InUse;
use crate::engine::Store;
use crate::engine::job::Background;
use crate::scene::study::random_test::{RandomTest, Tested, add, errors};
use crate::scene::{Study, StudyRow};
use crate::solver::physics::contact::ContactKind;
use egui::Context;

/// Permitted numbers of tests.
pub const TESTS: std::ops::RangeInclusive<usize> = 200..=10_000;
/// Maximum number of comparisons with full solutions.
pub const MOST_COMPARED: usize = 2_000;

/// Maximum number of tests with the largest expected errors that are solved in full first.
const MOST_WORST: usize = 20;

/// Requested number and seed of the tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Number of reduced solves.
    pub tests: usize,
    /// Number of full solves for comparison, at the first contacts.
    pub compared: usize,
    /// Seed of the contacts.
    pub seed: u64,
}

impl Default for Wanted {
    fn default() -> Self {
        Self { tests: 1000, compared: 200, seed: 1 }
    }
}

impl Wanted {
    /// Returns a small number of tests that can run automatically within a moment.
    fn small(in_use: &InUse) -> Self {
        let compared = match in_use.model.contact() {
            ContactKind::Line => 20,
            ContactKind::Point => 3,
        };
        Self { tests: *TESTS.start(), compared, seed: 1 }
    }
}

/// Returns the calibrated bound on the error of H_c of a test.
pub fn bound_of(tested: &Tested) -> Option<f64> {
    tested.0.bounds()[0]
}

/// Returns the true error of H_c of a test. `None` if it was not computed.
pub fn error_of(tested: &Tested) -> Option<f64> {
    errors(tested)[0]
}

/// Tests of a run.
pub struct Results {
    /// Tested model.
    pub in_use: InUse,
    /// Settings of the run.
    pub wanted: Wanted,
    /// True if it was started automatically.
    unasked: bool,
    /// Tests so far.
    pub tests: Vec<Tested>,
    /// Counter that increases with every new row.
    pub revision: usize,
}

impl Results {
    /// Returns the number of tests in which the reduced model did not converge.
    pub fn failures(&self) -> usize {
        self.tests.iter().filter(|(test, _)| test.film.is_none()).count()
    }

    /// Returns bound and true error of H_c of the compared tests that have both. The tests selected for their large
    /// expected errors are excluded.
    pub fn pairs(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.tests.iter().take(self.wanted.compared).filter_map(|tested| Some((bound_of(tested)?, error_of(tested)?)))
    }
}

/// State of the random validation in the tab.
#[derive(Default)]
pub struct RandomTests {
    /// Settings of the next run.
    pub wanted: Wanted,
    /// Present or last run.
    pub results: Option<Results>,
    /// Running study, and the reason why the last one ended early.
    pub work: Background<StudyRow>,
}

impl RandomTests {
    /// Starts a new run.
    pub fn start(&mut self, ctx: &Context, store: &Store, in_use: &InUse) {
        self.begin(ctx, store, in_use, (self.wanted, false));
    }

    /// Starts a few tests of a model automatically, unless the user has requested others.
    pub fn show(&mut self, ctx: &Context, store: &Store, in_use: &InUse) {
        if self.results.as_ref().is_none_or(|results| results.unasked && results.in_use != *in_use) {
            self.begin(ctx, store, in_use, (Wanted::small(in_use), true));
        }
    }

    /// Stops and discards tests that were started automatically. They start again when the view is shown again.
    pub fn hide(&mut self) {
        if self.work.job().is_some() && self.results.as_ref().is_some_and(|results| results.unasked) {
            (self.results, self.work) = (None, Background::default());
        }
    }

    fn begin(&mut self, ctx: &Context, store: &Store, in_use: &InUse, (wanted, unasked): (Wanted, bool)) {
        let Wanted { tests, compared, seed } = wanted;
        self.results = Some(Results { in_use: in_use.clone(), wanted, unasked, tests: Vec::new(), revision: 0 });
        let (range, compare) = (in_use.trained_range(), compared.min(tests));
        let worst = compare.min(MOST_WORST);
        let study = Study::RandomTest(RandomTest { range, tests, seed, method: in_use.method(), compare, worst });
        let question = in_use.question("Random validation", study).map_err(|why| why.to_string());
        self.work.start(question.map(|question| in_use.ask(ctx, store, question)));
    }

    /// Receives results.
    pub fn receive(&mut self) {
        let Some(results) = &mut self.results else { return };
        self.work.receive(|row| {
            if let StudyRow::RandomTest(row) = row {
                results.revision += 1;
                add(&mut results.tests, &row);
            }
        });
    }
}
