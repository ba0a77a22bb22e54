//! What a reduced model of trajectories is made of.

use super::domain::TrajectoryDomain;
use crate::solver::full::transient::{Frame, Inputs};
use crate::solver::physics::contact::OperatingPoint;
use crate::solver::reduced::Window;

/// A reduced model of a line contact in time, in one frame.
#[derive(Clone, Debug)]
pub struct TrajectoryModel {
    /// Title for people; empty of a model that was never saved.
    pub title: String,
    /// The frame it was trained in.
    pub frame: Frame,
    /// Bases, sampled rows, grid. Under complementarity its snapshots tell where the rupture boundary was in training,
    /// elsewhere it has none; its range of M is of no use here. Beside local bases it has all rows: contacts at rest
    /// are found with it, and steps that a local basis cannot take.
    pub window: Window,
    /// Bases of the states around some centres, of which a step takes the nearest; none where one basis serves all.
    pub locals: Vec<LocalBasis>,
    /// Where its training trajectories began, and what drove them.
    pub starts: Vec<TrajectoryStart>,
    /// What it was trained for.
    pub domain: TrajectoryDomain,
    /// The scene it was trained by, as text; empty for a model that was never saved.
    pub scene: String,
    /// What the training did, one sentence per line.
    pub log: Vec<String>,
}

/// A basis of the states around a centre.
#[derive(Clone, Debug)]
pub struct LocalBasis {
    /// Its modes, which are made of the model's whole basis, and its sampled rows.
    pub window: Window,
    /// p̃ of its centre in the whole basis.
    pub centre: Vec<f64>,
}

/// The beginning of a training trajectory, from which others begin, and its inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryStart {
    /// The reference contact.
    pub point: OperatingPoint,
    /// What drove it.
    pub inputs: Inputs,
    /// How long \[T\].
    pub duration: f64,
    /// p̃ of its stationary state.
    pub coefficients: Vec<f64>,
    /// Its H₀.
    pub h_0: f64,
    /// Under complementarity its first ruptured column, in node arrays; empty under a penalty.
    pub fronts: Vec<usize>,
}

impl TrajectoryModel {
    /// What its steps are taken with: the local bases, or the one there is.
    pub fn serving(&self) -> impl Iterator<Item = &Window> {
        let whole = self.locals.is_empty().then_some(&self.window);
        self.locals.iter().map(|local| &local.window).chain(whole)
    }

    /// Pressure modes of a step, at most.
    pub fn modes(&self) -> usize {
        self.serving().map(|window| window.pressure.count()).max().unwrap_or(0)
    }

    /// Sampled rows of a step, at most.
    pub fn rows(&self) -> usize {
        self.serving().map(|window| window.sampled_rows.len()).max().unwrap_or(0)
    }

    /// The whole basis, number 0, or local basis k, number k + 1.
    pub(super) fn numbered(&self, number: usize) -> &Window {
        let local = number.checked_sub(1).and_then(|local| self.locals.get(local));
        local.map_or(&self.window, |local| &local.window)
    }

    /// The trained reference contact that serves a load \[N/m\] at the beginning of a march: of the trained ones the
    /// nearest, under the load itself where that lies between trained ones.
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
