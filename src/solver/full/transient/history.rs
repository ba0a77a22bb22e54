//! The two previous states of a march, and their contribution to the time derivative of its rows.

use super::difference::extrapolated;
use super::frame::Frame;
use super::march::Step;
use super::spline::{Interpolated, Interpolation};
use serde::{Deserialize, Serialize};

/// Previous states, the nearer one first, and their mass flow ρ̄H interpolated to the current nodes of the rows.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct History {
    former: [Past; 2],
    #[serde(skip)]
    carried: [Vec<f64>; 2],
}

/// Previous state.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Past {
    /// Pressures P, or the coefficients of a reduced model.
    state: Vec<f64>,
    h_0: f64,
    /// ρ̄H at the nodes of the rows at that time.
    flow: Vec<f64>,
    /// Interpolation of ρ̄H between the nodes, in the remeshed frame.
    between: Interpolated,
}

impl Past {
    fn copy_from(&mut self, other: &Self) {
        self.state.clone_from(&other.state);
        self.flow.clone_from(&other.flow);
        self.h_0 = other.h_0;
        self.between.copy_from(&other.between);
    }
}

impl History {
    /// Creates an empty history with capacity for the given numbers of entries and rows.
    pub fn with_room(entries: usize, rows: usize) -> Self {
        let past = || Past { state: Vec::with_capacity(entries), flow: Vec::with_capacity(rows), ..Past::default() };
        Self { former: [past(), past()], carried: [Vec::with_capacity(rows), Vec::with_capacity(rows)] }
    }

    /// Stores a state with its H₀ (rigid-body separation) and its ρ̄H at the rows' nodes as the nearer previous one.
    /// The previously nearer state becomes the farther one.
    pub fn remember(&mut self, state: &[f64], h_0: f64, flow: impl Iterator<Item = f64>) {
        self.former.swap(0, 1);
        let past = &mut self.former[0];
        past.h_0 = h_0;
        for values in [&mut past.state, &mut past.flow] {
            values.clear();
        }
        past.state.extend_from_slice(state);
        past.flow.extend(flow);
    }

    /// Copies the states of another history without allocating, if the capacity suffices.
    pub fn copy_from(&mut self, other: &Self) {
        self.former.iter_mut().zip(&other.former).for_each(|(own, other)| own.copy_from(other));
    }

    /// Returns true if both states have the given numbers of entries, rows and interpolation nodes, all finite.
    pub fn is_of(&self, entries: usize, rows: usize, nodes: usize) -> bool {
        let finite = |values: &[f64], length: usize| values.len() == length && values.iter().all(|v| v.is_finite());
        let fits = |past: &Past| {
            let own = finite(&past.state, entries) && finite(&past.flow, rows) && past.h_0.is_finite();
            own && past.between.is_of(nodes)
        };
        self.former.iter().all(fits)
    }

    /// Stores ρ̄H of the nearer state at all nodes `x`, from which a remeshed frame interpolates it.
    pub fn remember_between(&mut self, interpolation: Interpolation, x: &[f64], flow: impl Iterator<Item = f64>) {
        self.former[0].between.set(interpolation, x, flow);
    }

    /// Sets both previous states to the nearer one: the contact was steady.
    pub fn rest(&mut self) {
        let [nearer, farther] = &mut self.former;
        farther.copy_from(nearer);
    }

    /// Extrapolates the straight line through both states to `start` and returns the extrapolated H₀; `ratio` = step
    /// / previous step.
    pub fn extrapolate(&self, ratio: f64, start: &mut [f64]) -> f64 {
        let [near, far] = &self.former;
        for (start, (near, far)) in start.iter_mut().zip(near.state.iter().zip(&far.state)) {
            *start = extrapolated(ratio, *near, *far);
        }
        extrapolated(ratio, near.h_0, far.h_0)
    }

    /// Returns the nearer state and its H₀.
    pub fn nearer(&self) -> (&[f64], f64) {
        (&self.former[0].state, self.former[0].h_0)
    }

    /// Returns a previous state and its H₀; 0 is the nearer one.
    pub fn former(&self, which: usize) -> (&[f64], f64) {
        (&self.former[which].state, self.former[which].h_0)
    }

    /// Returns ρ̄H of a previous state at a row's node; 0 is the nearer state.
    #[inline]
    pub fn flow(&self, which: usize, row: usize) -> f64 {
        self.former[which].flow[row]
    }

    /// Replaces the entries of a previous state.
    pub fn give_state(&mut self, which: usize, state: &[f64]) {
        let own = &mut self.former[which].state;
        own.clear();
        own.extend_from_slice(state);
    }

    /// Replaces ρ̄H of a previous state, at the nodes of other rows.
    pub fn give_flow(&mut self, which: usize, flow: impl Iterator<Item = f64>) {
        let own = &mut self.former[which].flow;
        own.clear();
        own.extend(flow);
    }

    /// Interpolates the previous ρ̄H to the positions of the rows' nodes at the end of a step. `rows` are the
    /// abscissae of these nodes, `nodes` those of the grid.
    pub fn carry(&mut self, frame: Frame, step: &Step, nodes: &[f64], rows: &[f64]) {
        for ((carried, past), scales) in self.carried.iter_mut().zip(&self.former).zip(step.former) {
            carried.resize(past.flow.len(), 0.0);
            match frame {
                Frame::Remeshed(_) => {
                    let stretch = step.now.scales.half_width / scales.half_width;
                    past.between.stretched(nodes, stretch, rows.iter().copied(), |r, flow| carried[r] = flow);
                }
                Frame::Fixed | Frame::ArbitraryLagrangianEulerian => carried.copy_from_slice(&past.flow),
            }
        }
    }

    /// Returns the contribution of the previous states to the time derivative of row `row`, given
    /// [`Step::history_weights`].
    #[inline]
    pub fn at(&self, [near, far]: [f64; 2], row: usize) -> f64 {
        near * self.carried[0][row] + far * self.carried[1][row]
    }
}
