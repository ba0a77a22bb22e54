//! The methods by which the steps of a contact in time can be solved, and the frames they are solved in, as people call
//! them.

use crate::scene::study::transient::MarchedBy;
use crate::solver::full::transient::{Frame, Interpolation};
use crate::solver::reduced::tpwl::{Selection, Weighting};

/// The word that stands for a method in tables.
pub fn word(by: MarchedBy) -> &'static str {
    match by {
        MarchedBy::Full => "full",
        MarchedBy::Reduced => "rnsa",
        MarchedBy::Linearised(Weighting::DualTaylor) => "tpwl_dual_taylor",
        MarchedBy::Linearised(Weighting::Dissertation) => "tpwl_dissertation",
    }
}

/// A frame for people.
pub fn frame_name(frame: Frame) -> &'static str {
    match frame {
        Frame::Fixed => "Fixed frame",
        Frame::ArbitraryLagrangianEulerian => "Moving nodes (ALE)",
        Frame::Remeshed(Interpolation::CubicSpline) => "Remeshed, spline",
        Frame::Remeshed(Interpolation::Linear) => "Remeshed, linear",
    }
}

/// What a frame does with the grid.
pub fn frame_meaning(frame: Frame) -> &'static str {
    match frame {
        Frame::Fixed => "The grid stays where it is (2.23)",
        Frame::ArbitraryLagrangianEulerian => "The nodes move with the dry contact of the moment (4.9)",
        Frame::Remeshed(Interpolation::CubicSpline) => {
            "A grid of its own for every step; former steps are carried over by a cubic spline (4.10)"
        }
        Frame::Remeshed(Interpolation::Linear) => {
            "The same with straight lines, which smear: the dissertation’s Fig. 4.4 shows how much"
        }
    }
}

/// The name of a run among others; the fixed frame, in which most are, is not named.
pub fn run_name(by: MarchedBy, frame: Frame) -> String {
    match (by, frame) {
        (MarchedBy::Full, Frame::Fixed) => "Full system".to_owned(),
        (MarchedBy::Full, frame) => frame_name(frame).to_owned(),
        (MarchedBy::Reduced, Frame::Fixed) => "Reduced model".to_owned(),
        (MarchedBy::Reduced, frame) => format!("{}, reduced", frame_name(frame)),
        // It lives in the fixed frame alone.
        (MarchedBy::Linearised(Weighting::DualTaylor), _) => "Linearised, dual Taylor".to_owned(),
        (MarchedBy::Linearised(Weighting::Dissertation), _) => "Linearised, exponential weights".to_owned(),
    }
}

/// Both weightings, the one that errs less first.
pub const WEIGHTINGS: [Weighting; 2] = [Weighting::DualTaylor, Weighting::Dissertation];

/// A weighting for people, and what it does.
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

/// Both rules for operating points, with tolerances to begin with.
pub const RULES: [Selection; 2] = [Selection::Distance { tolerance: 0.02 }, Selection::Step { tolerance: 1e-3 }];

/// A rule for people, and what it does.
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
