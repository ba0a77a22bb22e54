//! Training of reduced models: form, running training, comparison of models.

pub mod chart;
mod charts;
pub mod comparison;
mod comparison_view;
mod form;
pub mod presets;
mod tab;
mod trainings;
mod worker;

pub use tab::TrainingTab;
pub use trainings::TrainingCommand;
pub use worker::{Made, Running, TrainingTask};
