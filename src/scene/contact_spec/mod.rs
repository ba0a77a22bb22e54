//! Contact as users state it: by SI quantities or Moes numbers, two bodies, an oil by grade or name, laws, heat, a
//! grid.
//!
//! [`ContactSpec`] stores only what was stated. Flags of the command line, columns of load-case tables, keywords of
//! Python and variables of Functional Mock-up Units are spellings of its [`Field`]s. A scene can be converted into a
//! specification by its values. [`ContactSpec::request`] checks the specification and returns the request to solve. A
//! [`Refusal`] names its field, and each interface prints it in its own [`Words`].

mod facts;
mod fields;
mod given;
mod grids;
mod laws;
mod layers;
mod machines;
mod reading;
mod refusal;
mod request;
mod spelling;
mod surfaces;
#[cfg(test)]
mod tests;
mod words;

pub use facts::{Facts, Measure};
pub use fields::{ContactSpec, Field, NotVaried};
pub use given::{Domain, MethodName, OilGrade, ShearName, ValueError};
pub use refusal::Refusal;
pub use words::Words;
