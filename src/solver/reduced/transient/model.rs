//! What a reduced model of trajectories is made of.

use crate::solver::full::transient::Frame;
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::Window;

/// A reduced model of a line contact in time, in one frame.
#[derive(Clone, Debug)]
pub struct TrajectoryModel {
    /// The frame it was trained in.
    pub frame: Frame,
    /// Bases, sampled rows, grid. Under complementarity its snapshots tell where the rupture boundary was in training,
    /// elsewhere it has none; its range of M is of no use here.
    pub window: Window,
    /// Where its training trajectories began.
    pub starts: Vec<TrajectoryStart>,
}

/// The beginning of a training trajectory, from which others begin.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryStart {
    /// The reference contact.
    pub point: OperatingPoint,
    /// p̃ of its stationary state.
    pub coefficients: Vec<f64>,
    /// Its H₀.
    pub h_0: f64,
    /// Under complementarity its first ruptured column, in node arrays; empty under a penalty.
    pub fronts: Vec<usize>,
}
