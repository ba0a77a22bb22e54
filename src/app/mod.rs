//! Explorer: a window in which the user changes a contact and sees its solution at once.
//!
//! [`Explorer`] is the whole window as a function of an [`egui::Ui`]; `run` opens it as a native window.

mod animations;
mod answers;
mod badge;
mod caption;
mod command;
mod context;
mod controls;
mod desk;
mod display;
mod document;
mod drawn;
mod examples;
mod execute;
mod explorer;
mod export;
mod figure;
mod form;
mod formulas;
mod in_use;
mod layouts;
mod lessons;
mod links;
mod load_cases;
mod machines;
mod manual;
mod measured;
mod model_source;
mod notice;
mod numbers;
mod palette;
mod panels;
mod plot;
mod presentation;
mod purpose;
mod refusal;
mod reports;
mod seen;
#[cfg(test)]
mod sequences;
mod session;
mod tab;
mod tabs;
mod tasks;
mod theme;
mod units;
mod wake;
#[cfg(feature = "desktop")]
mod window;

pub use explorer::Explorer;
pub use refusal::Refusal;
pub use tasks::perform;
#[cfg(feature = "desktop")]
pub use window::run;
