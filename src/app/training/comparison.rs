//! Two models over the range of a training: the random test of each with the same seed, one after the other, so that
//! neither disturbs the other's times.

use crate::app::document::Key;
use crate::app::in_use::{InUse, question};
use crate::engine::Store;
use crate::engine::job::{Background, Standing};
use crate::scene::study::random_test::RandomTest;
use crate::scene::{Findings, Grid, Method, Scene, Study, StudyRow, View};
use crate::solver::reduced::{ReducedModel, Window};
use crate::solver::training::{TrainingSpec, random_points};
use egui::Context;
use std::sync::Arc;

/// Random points at which two models are compared.
pub const POINTS: usize = 200;
/// Seed of those points: the same ones for every pair.
const SEED: u64 = 31;

/// What a model is worth.
pub struct ModelScore {
    /// The model.
    pub model: Arc<ReducedModel>,
    found: Findings,
}

impl ModelScore {
    /// A value that its random test has found.
    pub fn value(&self, name: &str) -> f64 {
        self.found.value(name, None).unwrap_or(f64::NAN)
    }

    /// A size of its largest window.
    pub fn largest(&self, size: fn(&Window) -> usize) -> usize {
        self.model.windows.iter().map(size).max().unwrap_or(0)
    }
}

/// A comparison under way, or done.
pub struct Comparison {
    /// What each model is worth that has been tested, in their order.
    pub scores: Vec<ModelScore>,
    question: Scene,
    models: [Arc<ReducedModel>; 2],
    rows: Vec<StudyRow>,
    work: Background<StudyRow>,
    ctx: Context,
    store: Store,
}

impl Comparison {
    /// Begins to compare two models over the range of a training.
    ///
    /// # Errors
    /// A sentence when the range holds no contact.
    pub fn start(
        ctx: &Context,
        store: &Store,
        models: [Arc<ReducedModel>; 2],
        spec: &TrainingSpec,
    ) -> Result<Self, String> {
        let points = random_points(&spec.range, spec.contact(), 1, SEED);
        let point = *points.first().ok_or("the range holds no points to compare at")?;
        let range = spec.range;
        let test = RandomTest { range, tests: POINTS, seed: SEED, method: Method::EMBEDDED, compare: POINTS };
        let key = Key { point, lubricant: spec.lubricant };
        let mut comparison = Self {
            scores: Vec::new(),
            question: question("Comparing two models", &key, Grid::Model, Study::RandomTest(test)),
            models,
            rows: Vec::new(),
            work: Background::default(),
            ctx: ctx.clone(),
            store: store.clone(),
        };
        comparison.test_next();
        Ok(comparison)
    }

    /// Whether both have been tested.
    pub fn done(&self) -> bool {
        self.scores.len() == self.models.len()
    }

    /// How far it is.
    pub fn standing(&self) -> Option<Standing> {
        self.work.standing()
    }

    /// Stops it.
    pub fn stop(&self) {
        self.work.stop();
    }

    fn test_next(&mut self) {
        if let Some(model) = self.models.get(self.scores.len()) {
            let in_use = InUse::new(model, &View::default());
            self.work.run(in_use.ask(&self.ctx, &self.store, self.question.clone()));
        }
    }

    /// Takes in what came; a sentence where it ended early for a reason.
    pub fn receive(&mut self) -> Option<String> {
        self.work.job()?;
        let rows = &mut self.rows;
        self.work.receive(|row| rows.push(row));
        // Two rows for each point: one that was stopped has fewer.
        let all = self.rows.len() == 2 * POINTS;
        if self.work.job().is_none() && self.work.message.is_none() && all {
            let found = self.question.study.findings(&self.question.experiment(), &std::mem::take(&mut self.rows));
            let model = Arc::clone(&self.models[self.scores.len()]);
            self.scores.push(ModelScore { model, found });
            self.test_next();
        }
        self.work.message.take()
    }
}
