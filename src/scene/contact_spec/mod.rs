//! A contact as people state it: SI or Moes' numbers, two bodies, an oil by its grade or its name, laws, heat, a grid.
//!
//! [`ContactSpec`] holds what was stated and nothing else. Flags of the command line, columns of load-case tables,
//! keywords of Python and variables of Functional Mock-up Units are spellings of its [`Field`]s; a scene is one by its
//! values. [`ContactSpec::request`] checks it and says what is to be solved. A [`Refusal`] names its field, and each
//! interface prints it in its own [`Words`].

mod facts;
mod fields;
mod given;
mod grids;
mod laws;
mod layers;
mod reading;
mod refusal;
mod request;
mod spelling;
#[cfg(test)]
mod tests;
mod words;

pub use facts::{Facts, Measure};
pub use fields::{ContactSpec, Field, NotVaried};
pub use given::{Domain, MethodName, OilGrade, ShearName, ValueError};
pub use refusal::Refusal;
pub use words::Words;
