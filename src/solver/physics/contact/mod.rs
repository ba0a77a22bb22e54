//! Operating point in SI units, its Hertzian scales, its Moes numbers, and all conversions between them.
//!
//! This is the only place where SI quantities and dimensionless ones are converted. The rest of the solver is
//! dimensionless.

mod ellipse;
mod error;
mod film_asymptotes;
mod film_formulas;
mod kind;
pub mod limits;
mod moes;
mod operating_point;
mod rolling;
mod sliding;

pub use ellipse::Ellipse;
pub use error::ContactError;
pub use film_asymptotes::{FilmAsymptotes, FilmShape, expected_film};
pub use film_formulas::{FilmFormula, FilmPrediction};
pub use kind::ContactKind;
pub use moes::{DEFAULT_MODULUS_PA, DEFAULT_VISCOSITY_PA_S, MoesRequest, si_from_moes};
pub use operating_point::{Hertz, Moes, OperatingPoint, PLAUSIBLE_HERTZ_PRESSURE_PA, reduced_modulus};
pub use sliding::Sliding;
