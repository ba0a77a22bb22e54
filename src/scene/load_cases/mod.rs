//! A table of load cases as engineers keep them: one contact a line, quantities in columns, units in the titles or in
//! the cells. A line that makes no sense is refused by itself; the others stand.
//!
//! ```text
//! name;       R [mm]; u;       w;        oil;       temperature; SRR
//! shaft, new; 12;     3 m/s;   300 N/mm; ISO VG 68; 60 °C;       5 %
//! ```

mod columns;
mod error;
mod line;
mod table;

pub use error::{CasesError, LineError};
pub use table::{CaseTable, LoadCase};
