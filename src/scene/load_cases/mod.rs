//! Tables of load cases: one contact per line, quantities in columns, units in the titles or in the cells. An invalid
//! line is refused and does not affect the others.
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
