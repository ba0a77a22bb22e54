//! Comparison of models over the range of one of them. The random validation runs with the same seed for each
//! model, one after the other, so that the measured times are undisturbed.

use crate::app::document::Key;
use crate::app::export;
use crate::app::in_use::{InUse, question};
use crate::app::refusal::Refusal;
use crate::engine::Store;
use crate::engine::job::{Background, Standing};
use crate::scene::names;
use crate::scene::study::random_test::{RandomTest, Tested, errors, tests};
use crate::scene::{Findings, Grid, Method, Scene, Study, StudyRow, View};
use crate::solver::reduced::{Domain, ReducedModel, Window};
use crate::solver::training::random_points;
use egui::Context;
use std::sync::Arc;

/// Number of random contacts of a comparison.
pub const POINTS: usize = 200;
/// Seed of the random contacts. It is the same for every comparison.
const SEED: u64 = 31;

/// Result of a model.
pub struct ModelScore {
    /// Name in the comparison.
    pub name: String,
    pub model: Arc<ReducedModel>,
    found: Findings,
    tests: Vec<Tested>,
}

impl ModelScore {
    /// Returns a value that the random validation has found.
    pub fn value(&self, name: &str) -> f64 {
        self.found.value(name, None).unwrap_or(f64::NAN)
    }

    /// Returns the errors of H_c in ascending order.
    pub fn errors(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.tests.iter().filter_map(|tested| errors(tested)[0]).collect();
        all.sort_by(f64::total_cmp);
        all
    }

    /// Returns the largest value of a size over its local models.
    pub fn largest(&self, size: fn(&Window) -> usize) -> usize {
        self.model.windows.iter().map(size).max().unwrap_or(0)
    }
}

/// Comparison, running or complete.
pub struct Comparison {
    /// Results of the models tested so far, in their order.
    pub scores: Vec<ModelScore>,
    /// Title of the model or training whose range contains the contacts.
    pub range_of: String,
    question: Scene,
    models: Vec<(String, Arc<ReducedModel>)>,
    rows: Vec<StudyRow>,
    work: Background<StudyRow>,
    ctx: Context,
    store: Store,
}

impl Comparison {
    /// Starts a comparison of named models at random contacts of a domain, which belongs to `range_of`.
    ///
    /// # Errors
    /// A sentence if the range contains no contact.
    pub fn start(
        ctx: &Context,
        store: &Store,
        models: Vec<(String, Arc<ReducedModel>)>,
        (range_of, domain): (String, &Domain),
    ) -> Result<Self, Refusal> {
        let points = random_points(&domain.space, domain.contact, 1, SEED);
        let point = *points.first().ok_or_else(|| Refusal::new("the range holds no points to compare at"))?;
        let range = domain.space.clone();
        let test = RandomTest { range, tests: POINTS, seed: SEED, method: Method::EMBEDDED, compare: POINTS, worst: 0 };
        let key = Key { point, lubricant: domain.lubricant };
        let mut comparison = Self {
            scores: Vec::new(),
            range_of,
            question: question("Comparing models", &key, Grid::Model, Study::RandomTest(test)),
            models,
            rows: Vec::new(),
            work: Background::default(),
            ctx: ctx.clone(),
            store: store.clone(),
        };
        comparison.test_next();
        Ok(comparison)
    }

    /// Returns a table of every contact with the errors of H_c and H_min of each model.
    pub fn csv(&self) -> String {
        let mut header = vec![names::M.to_owned(), names::L.to_owned()];
        for score in &self.scores {
            header.extend(["H_c_error", "H_min_error"].map(|what| format!("{}.{what}", score.name)));
        }
        let titles: Vec<&str> = header.iter().map(String::as_str).collect();
        let comment = |score: &ModelScore| format!("{}: {}", score.name, score.model.title);
        let range = format!("random points of the range of {}", self.range_of);
        let comments: Vec<String> = std::iter::once(range).chain(self.scores.iter().map(comment)).collect();
        let count = self.scores.iter().map(|score| score.tests.len()).min().unwrap_or(0);
        let row = |k: usize| {
            let moes = self.scores.first().and_then(|score| score.tests.get(k)).map(|tested| tested.0.point.moes());
            let mut row = vec![moes.map(|moes| moes.m), moes.map(|moes| moes.l)];
            for score in &self.scores {
                let [h_c, h_min, ..] = score.tests.get(k).map(errors).unwrap_or_default();
                row.extend([h_c, h_min]);
            }
            row
        };
        export::csv(&comments, &titles, (0..count).map(row))
    }

    /// Returns true if all models have been tested.
    pub fn done(&self) -> bool {
        self.scores.len() == self.models.len()
    }

    /// Returns the progress.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    pub fn stop(&self) {
        self.work.stop();
    }

    fn test_next(&mut self) {
        if let Some((_, model)) = self.models.get(self.scores.len()) {
            let in_use = InUse::new(model, &View::default());
            self.work.run(in_use.ask(&self.ctx, &self.store, self.question.clone()));
        }
    }

    /// Receives results. Returns a sentence if the comparison ended early for a reason.
    pub fn receive(&mut self) -> Option<String> {
        self.work.job()?;
        let rows = &mut self.rows;
        self.work.receive(|row| rows.push(row));
        // Each contact has two rows. A stopped validation has fewer.
        let all = self.rows.len() == 2 * POINTS;
        if self.work.job().is_none() && self.work.message.is_none() && all {
            let rows = std::mem::take(&mut self.rows);
            let found = self.question.study.findings(&self.question.experiment(), &rows);
            let own = rows.iter().filter_map(|row| if let StudyRow::RandomTest(row) = row { Some(row) } else { None });
            let (name, model) = self.models[self.scores.len()].clone();
            self.scores.push(ModelScore { name, model, found, tests: tests(own) });
            self.test_next();
        }
        self.work.message.take()
    }
}
