//! The two former states of a march, and what the time derivative of its rows draws from them.

use super::difference::extrapolated;
use super::frame::Frame;
use super::march::Step;
use super::spline::{Interpolated, Interpolation};
use serde::{Deserialize, Serialize};

/// The former states, the nearer one first, and their ρ̄H where the rows' nodes are now.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct History {
    former: [Past; 2],
    #[serde(skip)]
    carried: [Vec<f64>; 2],
}

/// A former state.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Past {
    /// Pressures or coefficients.
    state: Vec<f64>,
    h_0: f64,
    /// ρ̄H where the rows' nodes were.
    flow: Vec<f64>,
    /// The same between the nodes, where the frame is remeshed.
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
    /// Without states, with room for so many entries and rows.
    pub fn with_room(entries: usize, rows: usize) -> Self {
        let past = || Past { state: Vec::with_capacity(entries), flow: Vec::with_capacity(rows), ..Past::default() };
        Self { former: [past(), past()], carried: [Vec::with_capacity(rows), Vec::with_capacity(rows)] }
    }

    /// Makes a state with its H₀ and its ρ̄H at the rows' nodes the nearer of the former ones.
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

    /// Takes over the states of another one, in the room there is.
    pub fn copy_from(&mut self, other: &Self) {
        self.former.iter_mut().zip(&other.former).for_each(|(own, other)| own.copy_from(other));
    }

    /// Whether both states have so many entries, so many rows, and so many nodes between which they are carried; all of
    /// them finite.
    pub fn is_of(&self, entries: usize, rows: usize, nodes: usize) -> bool {
        let finite = |values: &[f64], length: usize| values.len() == length && values.iter().all(|v| v.is_finite());
        let fits = |past: &Past| {
            let own = finite(&past.state, entries) && finite(&past.flow, rows) && past.h_0.is_finite();
            own && past.between.is_of(nodes)
        };
        self.former.iter().all(fits)
    }

    /// Adds the ρ̄H of the nearer state at all nodes `x`, from which a remeshed frame carries it on.
    pub fn remember_between(&mut self, interpolation: Interpolation, x: &[f64], flow: impl Iterator<Item = f64>) {
        self.former[0].between.set(interpolation, x, flow);
    }

    /// Makes the nearer state both of the former ones: the contact has rested.
    pub fn rest(&mut self) {
        let [nearer, farther] = &mut self.former;
        farther.copy_from(nearer);
    }

    /// Continues the straight line through both states over `ratio` = step / former step; returns H₀.
    pub fn extrapolate(&self, ratio: f64, start: &mut [f64]) -> f64 {
        let [near, far] = &self.former;
        for (start, (near, far)) in start.iter_mut().zip(near.state.iter().zip(&far.state)) {
            *start = extrapolated(ratio, *near, *far);
        }
        extrapolated(ratio, near.h_0, far.h_0)
    }

    /// The nearer state and its H₀.
    pub fn nearer(&self) -> (&[f64], f64) {
        (&self.former[0].state, self.former[0].h_0)
    }

    /// A former state and its H₀, the nearer one for 0.
    pub fn former(&self, which: usize) -> (&[f64], f64) {
        (&self.former[which].state, self.former[which].h_0)
    }

    /// Gives a former state by other entries.
    pub fn give_state(&mut self, which: usize, state: &[f64]) {
        let own = &mut self.former[which].state;
        own.clear();
        own.extend_from_slice(state);
    }

    /// Gives ρ̄H of a former state at the nodes of other rows.
    pub fn give_flow(&mut self, which: usize, flow: impl Iterator<Item = f64>) {
        let own = &mut self.former[which].flow;
        own.clear();
        own.extend(flow);
    }

    /// Carries the former ρ̄H to where the rows' nodes, at `rows` among the grid's `nodes`, are at the end of a step.
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

    /// What the time derivative of row `row` draws from the former states, given [`Step::history_weights`].
    #[inline]
    pub fn at(&self, [near, far]: [f64; 2], row: usize) -> f64 {
        near * self.carried[0][row] + far * self.carried[1][row]
    }
}
