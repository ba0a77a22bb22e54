//! Opening, saving and exporting.

mod losses;
mod open;
mod path_window;
mod state;

pub use state::{Files, Pending};
