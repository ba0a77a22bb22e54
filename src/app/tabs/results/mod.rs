//! Results of the study of the open scene: charts, tables and verdicts.

mod chart;
mod columns;
mod contact;
mod run;
mod tab;
mod table;

pub use tab::Results;
