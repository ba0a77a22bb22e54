//! Random tests (3.17) of the reduced model over what it was trained for: the study of a scene that asks for them.

use crate::app::in_use::InUse;
use crate::engine::Store;
use crate::engine::job::Background;
use crate::scene::study::random_test::{RandomTest, Tested, add, errors};
use crate::scene::{Study, StudyRow};
use crate::solver::physics::contact::ContactKind;
use egui::Context;

/// Fewest and most tests that can be asked for.
pub const TESTS: std::ops::RangeInclusive<usize> = 200..=10_000;
/// Most comparisons with full solutions.
pub const MOST_COMPARED: usize = 2_000;

/// Tests that look worst and are solved in full first, at most.
const MOST_WORST: usize = 20;

/// How many tests are wanted, and which.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wanted {
    /// Reduced solves.
    pub tests: usize,
    /// Full solves to compare with, at the first of the points.
    pub compared: usize,
    /// Seed of the points.
    pub seed: u64,
}

impl Default for Wanted {
    fn default() -> Self {
        Self { tests: 1000, compared: 200, seed: 1 }
    }
}

impl Wanted {
    /// What is tested unasked: as many as are there within a moment.
    fn small(in_use: &InUse) -> Self {
        let compared = match in_use.model.contact() {
            ContactKind::Line => 20,
            ContactKind::Point => 3,
        };
        Self { tests: *TESTS.start(), compared, seed: 1 }
    }
}

/// The calibrated bound on the error of H_c of a test.
pub fn bound_of(tested: &Tested) -> Option<f64> {
    tested.0.bounds()[0]
}

/// The true error of H_c of a test, where it is known.
pub fn error_of(tested: &Tested) -> Option<f64> {
    errors(tested)[0]
}

/// Tests that were made, and of what.
pub struct Results {
    /// The model that was tested.
    pub in_use: InUse,
    /// How it was tested.
    pub wanted: Wanted,
    /// Whether nobody asked for them.
    unasked: bool,
    /// The tests so far.
    pub tests: Vec<Tested>,
    /// Rises with everything that comes in.
    pub revision: usize,
}

impl Results {
    /// Tests in which the reduced model did not converge.
    pub fn failures(&self) -> usize {
        self.tests.iter().filter(|(test, _)| test.film.is_none()).count()
    }

    /// Bound and true error of H_c, where both are known of tests that were compared as they came.
    pub fn pairs(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.tests.iter().take(self.wanted.compared).filter_map(|tested| Some((bound_of(tested)?, error_of(tested)?)))
    }
}

/// The tests of the tab: those that run and those that ended.
#[derive(Default)]
pub struct RandomTests {
    /// What the next run tests.
    pub wanted: Wanted,
    /// The present or last run.
    pub results: Option<Results>,
    /// What runs, and why the last run ended early.
    pub work: Background<StudyRow>,
}

impl RandomTests {
    /// Starts anew.
    pub fn start(&mut self, ctx: &Context, store: &Store, in_use: &InUse) {
        self.begin(ctx, store, in_use, (self.wanted, false));
    }

    /// Makes a few tests of a model unasked, unless somebody has asked for others.
    pub fn show(&mut self, ctx: &Context, store: &Store, in_use: &InUse) {
        if self.results.as_ref().is_none_or(|results| results.unasked && results.in_use != *in_use) {
            self.begin(ctx, store, in_use, (Wanted::small(in_use), true));
        }
    }

    /// Stops tests that nobody asked for, and forgets them: they begin anew when they are looked at again.
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
        let question = in_use.question("Random tests", study).map_err(|why| why.to_string());
        self.work.start(question.map(|question| in_use.ask(ctx, store, question)));
    }

    /// Takes in what came.
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
