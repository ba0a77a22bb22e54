//! Results of the study of the open scene: charts, tables and verdicts.

mod chart;
mod column;
mod columns;
mod contact;
mod measured;
mod run;
mod tab;
mod table;
mod verdicts;

pub use tab::Results;
