//! The solvers: full solutions compared with independent ones, embedded models with full solutions, and cancellation.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "tests wait by the clock")]

#[path = "../common/mod.rs"]
mod common;

mod cancel;
mod complementarity;
mod contacts;
mod elliptic;
mod embedded_ellipse_model;
mod embedded_model;
mod embedded_point_model;
mod embedded_point_shear_model;
mod embedded_shear_model;
mod embedded_sliding_models;
mod iterations;
mod line_reference;
mod mass_conserving;
mod point_reference;
mod random_solves;
mod reach;
mod rebuilt;
mod regimes;
mod response_reference;
mod rough;
mod shear_models;
mod shear_thinning;
mod stored_answers;
mod time_steps;
mod transient_reference;
