//! Data of a reduced model of trajectories.

use super::domain::TrajectoryDomain;
use crate::solver::full::transient::{Frame, Inputs};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::Window;

/// Reduced model of a transient line contact in one frame.
#[derive(Clone, Debug)]
pub struct TrajectoryModel {
    /// Title for display; empty for a model that was never saved.
    pub title: String,
    /// Frame of the training.
    pub frame: Frame,
    /// Bases, sampled equations and grid. With complementarity its snapshots hold the positions of the cavitation
    /// boundary in the training; otherwise there are none. Its range of M is not used. If there are local bases, it
    /// has all rows: it computes steady contacts, and steps that a local basis fails to solve.
    pub window: Window,
    /// Bases of the states around some centres; a step uses the nearest one. Empty if one basis serves all states.
    pub locals: Vec<LocalBasis>,
    /// Starts and inputs of the training trajectories.
    pub starts: Vec<TrajectoryStart>,
    /// Trained range.
    pub domain: TrajectoryDomain,
    /// Training scene as text; empty for a model that was never saved.
    pub scene: String,
    /// Log of the training, one sentence per line.
    pub log: Vec<String>,
}

/// Basis of the states around a centre.
#[derive(Clone, Debug)]
pub struct LocalBasis {
    /// Modes, which are combinations of the model's whole basis, and sampled equations.
    pub window: Window,
    /// Pressure coefficients p̃ of its centre in the whole basis.
    pub centre: Vec<f64>,
}

/// Start of a training trajectory, used as initial guess of others, and its inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryStart {
    /// Reference contact.
    pub point: OperatingPoint,
    /// Inputs.
    pub inputs: Inputs,
    /// Duration \[T\].
    pub duration: f64,
    /// Pressure coefficients p̃ of the steady state.
    pub coefficients: Vec<f64>,
    /// Rigid-body separation H₀.
    pub h_0: f64,
    /// With complementarity, the first cavitated column in node arrays; empty with a penalty.
    pub fronts: Vec<usize>,
}

impl TrajectoryModel {
    /// Iterates over the bases used for steps: the local ones, or the whole one.
    pub fn serving(&self) -> impl Iterator<Item = &Window> {
        let whole = self.locals.is_empty().then_some(&self.window);
        self.locals.iter().map(|local| &local.window).chain(whole)
    }

    /// Largest number of pressure modes of a step.
    pub fn modes(&self) -> usize {
        self.serving().map(|window| window.pressure.count()).max().unwrap_or(0)
    }

    /// Largest number of sampled equations of a step.
    pub fn rows(&self) -> usize {
        self.serving().map(|window| window.sampled_rows.len()).max().unwrap_or(0)
    }

    /// Returns the whole basis for number 0, or local basis k for number k + 1.
    pub(super) fn numbered(&self, number: usize) -> &Window {
        let local = number.checked_sub(1).and_then(|local| self.locals.get(local));
        local.map_or(&self.window, |local| &local.window)
    }

    /// Returns the trained reference contact for a load \[N/m\] at the start of a march. It is the nearest trained
    /// contact, with the load itself if that lies between trained loads. `None` if there are no starts.
    pub fn reference_for(&self, load: f64) -> Option<OperatingPoint> {
        let far = |point: &OperatingPoint| (point.load / load).ln().abs();
        let points = || self.starts.iter().map(|start| start.point);
        let nearest = points().min_by(|a, b| far(a).total_cmp(&far(b)))?;
        let (low, high) = points()
            .filter(|point| OperatingPoint { load: nearest.load, ..*point } == nearest)
            .fold((nearest.load, nearest.load), |(low, high), point| (low.min(point.load), high.max(point.load)));
        Some(OperatingPoint { load: load.max(low).min(high), ..nearest })
    }
}
