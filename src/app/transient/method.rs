//! The methods by which the steps of a contact in time can be solved, and the frames they are solved in, as people call them.

use crate::solver::full::transient::{Frame, Interpolation};

/// How the steps of a contact in time are solved. A further method slots in here and where the worker builds its model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// The full system.
    #[default]
    Full,
    /// A reduced model that is trained beforehand (RNSA).
    Reduced,
}

impl Method {
    /// The word that stands for it in tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Reduced => "rnsa",
        }
    }
}

/// All frames, the one the others are compared with first.
pub const FRAMES: [Frame; 4] = [
    Frame::Fixed,
    Frame::ArbitraryLagrangianEulerian,
    Frame::Remeshed(Interpolation::CubicSpline),
    Frame::Remeshed(Interpolation::Linear),
];

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

/// The name of a run among others.
pub fn run_name(method: Method, frame: Frame) -> String {
    let frame = frame_name(frame);
    match method {
        Method::Full => frame.to_owned(),
        Method::Reduced => format!("{frame}, reduced"),
    }
}
