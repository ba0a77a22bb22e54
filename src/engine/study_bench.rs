//! The workbench as studies see it.

use super::workbench::Workbench;
use crate::scene::{Answer, Bench, Method, ModelSource, Request, RunError};
use crate::solver::discrete::grid::ContactGrid;
use crate::solver::full::Solution;
use crate::solver::physics::contact::ContactKind;
use crate::solver::physics::lubricant::Lubricant;
use crate::solver::reduced::ReducedModel;
use crate::solver::training::{TrainingObserver, TrainingSpec};
use std::path::{Path, PathBuf};
use std::sync::Arc;

impl Bench for Workbench {
    fn answer(
        &mut self,
        request: &Request,
        method: &Method,
        start: Option<&Solution>,
        observer: &dyn TrainingObserver,
    ) -> Result<Answer, RunError> {
        self.answer(request, method, start, observer)
    }

    fn model_for(
        &mut self,
        source: &ModelSource,
        contact: ContactKind,
        lubricant: &Lubricant,
        observer: &dyn TrainingObserver,
    ) -> Result<Arc<ReducedModel>, RunError> {
        Self::model_for(self, source, contact, lubricant, observer)
    }

    fn grid(&mut self, request: &Request, observer: &dyn TrainingObserver) -> Result<ContactGrid, RunError> {
        Self::grid(self, request, observer)
    }

    fn training(&self, scene: &Path) -> Result<TrainingSpec, RunError> {
        self.training(scene)
    }

    fn resolve(&self, path: &Path) -> PathBuf {
        self.resolve(path)
    }
}
