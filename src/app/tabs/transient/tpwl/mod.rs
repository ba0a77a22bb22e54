//! Linearised model (TPWL) of a transient contact.

mod dials;
mod export;
mod number;
mod pictures;
mod plane;
mod shown;
mod tab;
mod table;
mod trajectory;
mod weights;

pub use tab::Tpwl;
