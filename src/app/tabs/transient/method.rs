//! Names of the methods and frames of transient runs.

use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::{Frame, Interpolation};
use crate::solver::reduced::tpwl::{Selection, Weighting};

/// Returns the word for a method in tables.
pub fn word(by: MarchedBy) -> &'static str {
    match by {
        MarchedBy::Full => "full",
        MarchedBy::Reduced => "rnsa",
        MarchedBy::Linearised(Weighting::DualTaylor) => "tpwl_dual_taylor",
        MarchedBy::Linearised(Weighting::Dissertation) => "tpwl_dissertation",
    }
}

/// Returns the name of a frame on the screen.
pub fn frame_name(frame: Frame) -> &'static str {
    match frame {
        Frame::Fixed => "Fixed frame",
        Frame::ArbitraryLagrangianEulerian => "Moving nodes (ALE)",
        Frame::Remeshed(Interpolation::CubicSpline) => "Remeshed, spline",
        Frame::Remeshed(Interpolation::Linear) => "Remeshed, linear",
    }
}

/// Returns the description of a frame.
pub fn frame_meaning(frame: Frame) -> &'static str {
    match frame {
        Frame::Fixed => "The grid stays where it is (2.23)",
        Frame::ArbitraryLagrangianEulerian => "The nodes move with the present dry contact (4.9)",
        Frame::Remeshed(Interpolation::CubicSpline) => {
            "A new grid for every step; previous steps are interpolated with a cubic spline (4.10)"
        }
        Frame::Remeshed(Interpolation::Linear) => {
            "The same with linear interpolation, which smears the solution (the dissertation’s Fig. 4.4)"
        }
    }
}

/// Returns the name of a run. The fixed frame is the usual one and is not named.
pub fn run_name(by: MarchedBy, frame: Frame) -> String {
    match (by, frame) {
        (MarchedBy::Full, Frame::Fixed) => "Full system".to_owned(),
        (MarchedBy::Full, frame) => frame_name(frame).to_owned(),
        (MarchedBy::Reduced, Frame::Fixed) => "Reduced model".to_owned(),
        (MarchedBy::Reduced, frame) => format!("{}, reduced", frame_name(frame)),
        // Linearised models exist only in the fixed frame.
        (MarchedBy::Linearised(Weighting::DualTaylor), _) => "Linearised, dual Taylor".to_owned(),
        (MarchedBy::Linearised(Weighting::Dissertation), _) => "Linearised, exponential weights".to_owned(),
    }
}

/// Both weightings, the one with the smaller error first.
pub const WEIGHTINGS: [Weighting; 2] = [Weighting::DualTaylor, Weighting::Dissertation];

/// Returns the name of a weighting and its description.
pub fn weighting_name(weighting: Weighting) -> (&'static str, &'static str) {
    match weighting {
        Weighting::DualTaylor => (
            "Dual Taylor",
            "The barycentre of near points that is nearest to the state, expansions half about the points and half about it",
        ),
        Weighting::Dissertation => {
            ("Exponential weights", "The dissertation’s (4.29): sharp weights of all points, none below 0.001")
        }
    }
}

/// Both rules for operating points, with default tolerances.
pub const RULES: [Selection; 2] = [Selection::Distance { tolerance: 0.02 }, Selection::Step { tolerance: 1e-3 }];

/// Returns the name of a rule and its description.
pub fn rule_name(rule: Selection) -> (&'static str, &'static str) {
    match rule {
        Selection::Distance { .. } => (
            "Distance",
            "A state becomes a point when it is far from all points, relative to the nearest one’s norm (2.85)",
        ),
        Selection::Step { .. } => (
            "Missed step",
            "A state becomes a point when the nearest point’s linearised system misses the step to it, relative to its \
             norm (4.30)",
        ),
    }
}
