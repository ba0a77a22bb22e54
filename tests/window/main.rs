//! The explorer's window, driven without a display.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "tests wait by the clock")]

#[path = "../common/mod.rs"]
mod common;
mod driver;

mod accessible;
mod accuracy_tab;
mod basis_tab;
mod campaign;
mod contact_map;
mod cut_off;
mod desktop;
mod ellipse;
mod engineering;
mod examples;
mod explorer;
mod figures;
mod heat;
mod interfaces;
mod lessons;
mod machines;
mod measured;
mod presets;
mod results_tab;
mod rupture;
mod steady;
mod surfaces;
mod tpwl_tab;
mod traction_tab;
mod training_tab;
mod transient_features;
mod transient_tab;
mod units;
mod walk;
