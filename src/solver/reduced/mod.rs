//! Reduced models: POD bases, row sampling, reduced operators and the online Newton iteration without large-scale work.
//!
//! State (p̃, H₀); deformation and load are linear and condensed. Everything lives in the reference coordinate ξ; the
//! registration scale s enters the online phase as a number: X = −1 + (ξ + 1)s, H = H₀ − ½ ln s + (X² + Y²)/2 + s (K
//! V_p p̃). Line and point contacts share all of it: what differs is in their grids
//! ([`crate::solver::discrete::grid::ContactGrid`]) and in the penalty of a window.

mod calibration;
mod combined;
mod contact_rows;
mod cubature;
pub(crate) mod dense;
mod domain;
mod error_measures;
mod error_split;
#[cfg(test)]
mod error_split_tests;
mod kept;
mod kriging;
mod minimisation;
mod model;
mod oils;
mod online;
mod operators;
mod pod;
mod row_sizes;
mod sampling;
mod shapes;
mod start;
mod sums;
pub mod tpwl;
mod traction;
mod traction_curve;
pub mod transient;

pub use calibration::{
    Beside, Calibration, CalibrationParts, ErrorEstimate, Estimated, Evidence, Features, LEAST_EVIDENCE,
    LEAST_OF_WINDOW, Measured,
};
pub use combined::{Combined, PressureModes, SharedBasis};
pub use cubature::{GoalEquations, cubature};
pub(crate) use domain::circles;
pub use domain::{
    CIRCLES, Domain, EyringDomain, HeatDomain, OilDomain, SlidingDomain, ThermalDomain, Trust, gradient_stress,
};
pub use error_measures::{ErrorMeasures, Norm, Residuals};
pub use error_split::{ErrorSplit, ErrorSplitter, Parts, PressureParts, SplitError};
pub use kept::{
    ALL_DIGITS, FILM_DIGITS, Keeping, Multiples, RULE_ACCURACY, factor_accuracy, factor_scales, keep_snapshots,
    kept_digits, kept_rule, kept_starts,
};
pub use minimisation::Scheme;
pub(crate) use minimisation::minimised_rows;
pub use model::{ModelSize, ReducedModel, SHAPE_WEIGHT, Snapshot, Window, deformation_weights, distance, separation};
pub use oils::expected_film;
pub(crate) use oils::{BEYOND_CELLS, OilPlace, apart, from_anchor, oil_place};
pub use online::{Online, ReducedError, ReducedOptions, ReducedSolution, STANDS_IN, Starts};
pub use operators::Warmth;
pub(crate) use operators::{Iterate, fronts};
pub use pod::PodBasis;
pub(crate) use row_sizes::mean_diagonals;
pub use sampling::{RowSnapshots, SampledRows, Sampling, TestSpace, all_rows, greedy, is_finite, q_deim};
pub use shapes::Shapes;
pub use traction::TractionRule;
pub use traction_curve::{CurvePoint, traction_curve};
