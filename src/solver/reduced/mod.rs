//! Reduced models: POD bases, sampled equations, reduced operators and the online Newton iteration without
//! large-scale work.
//!
//! The state is (p̃, H₀): pressure coefficients and rigid-body separation. Deformation and load are linear and
//! condensed. All data live in the reference coordinate ξ. The registration scale s enters the online phase as a
//! number: X = −1 + (ξ + 1)s, H = H₀ − ½ ln s + (X² + Y²)/2 + s (K V_p p̃). Line and point contacts share all code;
//! they differ in their grids ([`crate::solver::discrete::grid::ContactGrid`]) and in the penalty of a local model.

mod calibration;
mod combined;
mod contact_rows;
mod cubature;
pub(crate) mod dense;
mod domain;
mod error_estimate;
mod error_measures;
mod error_split;
mod kept;
mod kriging;
pub(crate) mod matrix_values;
mod minimisation;
mod model;
mod multiples;
mod oils;
mod online;
mod operators;
mod pod;
mod reduced_solution;
mod rough_domain;
mod row_sizes;
mod sampling;
mod shapes;
mod start;
mod sums;
mod temperature_field;
pub mod tpwl;
mod traction;
mod traction_curve;
pub mod transient;

pub use calibration::{
    Calibration, CalibrationParts, Evidence, FeatureSet, Features, FurtherError, LEAST_EVIDENCE, LEAST_OF_WINDOW,
    Measured,
};
pub use combined::{Combined, PressureModes, SharedBasis};
pub use cubature::{GoalEquations, cubature};
pub use domain::{Domain, Trust};
pub use error_estimate::{ErrorEstimate, Estimated};
pub use error_measures::{ErrorMeasures, Norm, Residuals};
pub use error_split::{ErrorSplit, ErrorSplitter, Parts, PressureParts, SplitError};
pub use kept::{FILM_DIGITS, Keeping, keep_snapshots, kept_starts};
pub use minimisation::Scheme;
pub(crate) use minimisation::minimised_rows;
pub use model::{ModelSize, ReducedModel, Snapshot, Window, deformation_weights};
pub use multiples::{ALL_DIGITS, Multiples, RULE_ACCURACY, factor_accuracy, factor_scales, kept_digits, kept_rule};
pub(crate) use oils::{BEYOND_CELLS, from_anchor};
pub use online::{Online, ReducedError, ReducedOptions, Starts};
pub(crate) use operators::{Iterate, fronts};
pub use pod::PodBasis;
pub use reduced_solution::ReducedSolution;
pub(crate) use row_sizes::mean_diagonals;
pub use sampling::{RowSnapshots, SampledRows, Sampling, TestSpace, all_rows, greedy, is_finite, q_deim};
pub use shapes::Shapes;
pub use temperature_field::TemperatureField;
pub use traction::TractionRule;
pub use traction_curve::{CurvePoint, traction_curve};
