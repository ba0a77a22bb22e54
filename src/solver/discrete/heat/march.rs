//! The march of temperatures along the film, station after station.
//!
//! Upwind quotients of what the film carries, of second order, and of first order for two stations behind where it
//! turns; what crosses the film is upwinded on the cells of Lobatto's points by the flow Ψ of the former state. One more
//! sweep back and forth over the stations at which the film flows back in the inlet.

use super::across::{ACROSS, POINTS, Profile, inner};
use super::film::WarmLaws;
use super::station::{Limit, Made, Neighbours, Place, Side, Station};
use super::surfaces::MovingSource;
use crate::solver::discrete::reynolds::generalized::NodeState;
use std::sync::Arc;

/// Temperatures along and across the film of a line contact.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct March {
    /// Abscissae of the stations.
    pub x: Vec<f64>,
    /// The stations.
    pub stations: Vec<Station>,
    /// Fluxes q̄ into both bodies.
    pub flux: [Vec<f64>; 2],
    /// How surfaces warm.
    pub source: Arc<MovingSource>,
    /// What that is multiplied with here: the root of the scale by which its abscissae were stretched.
    root: f64,
    /// The mobilities by which the pressure was found.
    mobility: Vec<f64>,
    /// Ψ at the faces between the points, and at the upper surface.
    flow: Vec<Profile>,
    /// −Ψ_X there.
    across: Vec<[f64; POINTS - 1]>,
    former: Vec<Profile>,
}

/// Largest change of θ in one march.
const LARGEST_CHANGE: f64 = 0.25;

/// What the film is marched through.
#[derive(Clone, Copy, Debug)]
pub struct Course<'a> {
    /// Heat and shear in the contact.
    pub laws: WarmLaws<'a>,
    /// What limits the stress.
    pub limit: Option<Limit>,
    /// P, P_X and H at the stations.
    pub states: &'a [NodeState],
}

/// Where heat comes from and where it goes, in one unit: integrals over the film up to where it ruptures.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeatBalance {
    /// Made by shear.
    pub sheared: f64,
    /// Made by compression, less what expansion took.
    pub compressed: f64,
    /// Into either body.
    pub into_bodies: [f64; 2],
    /// Carried off by the oil, behind the contact and by what flows back out of the inlet.
    pub carried: f64,
}

impl HeatBalance {
    /// What is made and goes nowhere, over what shear and compression make.
    pub fn residual(&self) -> f64 {
        let made = self.sheared + self.compressed;
        let left = self.into_bodies[0] + self.into_bodies[1] + self.carried;
        let size = self.sheared.abs() + self.compressed.abs();
        if size > 0.0 { (made - left) / size } else { 0.0 }
    }
}

impl March {
    /// Cold stations at increasing abscissae.
    pub fn new(x: Vec<f64>) -> Self {
        let source = Arc::new(MovingSource::new(&x));
        Self::with(x, source)
    }

    /// The same where it is known how surfaces warm at these abscissae.
    pub fn with(x: Vec<f64>, source: Arc<MovingSource>) -> Self {
        let n = x.len();
        Self {
            source,
            root: 1.0,
            stations: vec![Station::default(); n],
            flux: [vec![0.0; n], vec![0.0; n]],
            mobility: vec![0.0; n],
            flow: vec![[0.0; POINTS]; n],
            across: vec![[0.0; POINTS - 1]; n],
            former: vec![[0.0; POINTS]; n],
            x,
        }
    }

    /// Cold stations at −1 + (ξ + 1) s, of the reference abscissae ξ by which it was made.
    pub fn begin(&mut self, reference: &[f64], scale: f64) {
        for (x, xi) in self.x.iter_mut().zip(reference) {
            *x = -1.0 + (xi + 1.0) * scale;
        }
        self.root = scale.sqrt();
        self.stations.fill(Station::default());
        self.flux.iter_mut().for_each(|flux| flux.fill(0.0));
    }

    /// Marches once through a state of pressure and film, and takes a share of the change of θ that comes of it. Returns
    /// the largest change.
    pub fn run(&mut self, course: &Course<'_>, share: f64, tolerance: f64) -> f64 {
        for (former, station) in self.former.iter_mut().zip(&self.stations) {
            *former = station.theta;
        }
        self.prepare(course);
        let n = self.x.len();
        for i in 0..n {
            self.solve(course, i, tolerance);
        }
        let back = |station: &Station| station.flowing.velocity.iter().any(|u| *u < 0.0);
        if let Some(last) = self.stations.iter().zip(&self.x).rposition(|(s, x)| back(s) && *x < 0.0) {
            for i in (0..last).rev() {
                self.solve(course, i, tolerance);
            }
            for i in 1..(last + 3).min(n) {
                self.solve(course, i, tolerance);
            }
        }
        let mut largest = 0.0f64;
        for (former, station) in self.former.iter().zip(&mut self.stations) {
            for (theta, former) in station.theta.iter_mut().zip(former) {
                let change = *theta - former;
                largest = largest.max(change.abs());
                // Far from the solution a march overshoots in the pressure spike.
                *theta = former + (share * change).clamp(-LARGEST_CHANGE, LARGEST_CHANGE);
            }
        }
        largest
    }

    /// Films at the former temperatures: the mobilities by which the pressure was found, and what crosses the film.
    fn prepare(&mut self, course: &Course<'_>) {
        let n = self.x.len();
        for i in 0..n {
            let station = &mut self.stations[i];
            course.place(i, 0.0).evaluate(station);
            self.mobility[i] = station.flowing.mobility;
            let mut flow = 0.0;
            for j in 0..POINTS {
                flow += ACROSS.weights[j] * station.flowing.flow[j];
                self.flow[i][j] = flow;
            }
        }
        for i in 0..n {
            let ruptured = self.x[i] > 0.0 && course.states[i].pressure <= 0.0;
            let [from, to] = [i.saturating_sub(1), (i + 1).min(n - 1)];
            self.across[i] = if ruptured || from + 1 >= to {
                [0.0; POINTS - 1]
            } else {
                let (west, east) = (self.x[i] - self.x[from], self.x[to] - self.x[i]);
                let sum = west + east;
                let weights = [-east / (west * sum), (east - west) / (west * east), west / (east * sum)];
                let slope = |j: usize| {
                    weights[0] * self.flow[from][j] + weights[1] * self.flow[i][j] + weights[2] * self.flow[to][j]
                };
                // No flow is lost: what the discrete one lacks is lacking everywhere across alike.
                let lost = slope(POINTS - 1);
                let mut share = 0.0;
                std::array::from_fn(|j| {
                    share += ACROSS.weights[j];
                    share * lost - slope(j)
                })
            };
        }
    }

    /// Solves one station beside its neighbours.
    fn solve(&mut self, course: &Course<'_>, i: usize, tolerance: f64) {
        let n = self.x.len();
        if i == 0 {
            // What enters has the inlet's temperature, what leaves its own.
            let next = self.stations[1.min(n - 1)].theta;
            let own = &mut self.stations[0];
            own.theta = [0.0; POINTS];
            for (j, theta) in own.theta.iter_mut().enumerate().skip(1).take(POINTS - 2) {
                if own.flowing.velocity[j] < 0.0 {
                    *theta = next[j];
                }
            }
            course.place(0, self.mobility[0]).evaluate(own);
            return;
        }
        let neighbours = Neighbours {
            sides: [
                self.side(i, [i - 1, i.saturating_sub(2)], |u| u < 0.0),
                self.side(i, [(i + 1).min(n - 1), (i + 2).min(n - 1)], |u| u >= 0.0),
            ],
            across: self.across[i],
            surfaces: [0, 1].map(|side| {
                let (before, own) = self.source.before(i, &self.flux[side]);
                (self.root * before, self.root * own)
            }),
        };
        let place = course.place(i, self.mobility[i]);
        let station = &mut self.stations[i];
        if station.theta == [0.0; POINTS] {
            station.theta = neighbours.sides[0].theta[0];
            place.evaluate(station);
        }
        place.solve(station, &neighbours, tolerance);
        for (all, own) in self.flux.iter_mut().zip(station.flux) {
            all[i] = own;
        }
    }

    /// What a station has from the two next to one side, for points that flow here from there; the film `leaves` for
    /// there where its velocity says so, and then the quotient is of first order.
    fn side(&self, i: usize, from: [usize; 2], leaves: impl Fn(f64) -> bool) -> Side {
        let mut out = Side { theta: from.map(|k| self.stations[k].theta), ..Side::default() };
        let [near, far] = from.map(|k| self.x[i] - self.x[k]);
        if near == 0.0 {
            return out;
        }
        let r = near / (far - near);
        let second = [(1.0 + r) / near, -r * r / (1.0 + r) / near];
        let beside = from.map(|k| &self.stations[k]);
        for j in 0..POINTS {
            let turns = far == near || beside.iter().any(|station| leaves(station.flowing.velocity[j]));
            let weights = if turns { [1.0 / near, 0.0] } else { second };
            for k in 0..2 {
                out.weights[k][j] = weights[k];
                out.flow[k][j] = beside[k].flowing.flow[j];
            }
        }
        out
    }

    /// Takes over temperatures at other abscissae, at least two, between which they are linear, times a factor.
    pub fn warm(&mut self, at: &[f64], profiles: &[Profile], factor: f64) {
        for (x, station) in self.x.iter().zip(&mut self.stations) {
            let right = at.partition_point(|at| at < x).clamp(1, at.len() - 1);
            let t = ((x - at[right - 1]) / (at[right] - at[right - 1])).clamp(0.0, 1.0);
            let [a, b] = [&profiles[right - 1], &profiles[right]];
            station.theta = std::array::from_fn(|j| factor * ((1.0 - t) * a[j] + t * b[j]));
        }
    }

    /// Where the heat comes from and goes to.
    pub fn balance(&self, course: &Course<'_>) -> HeatBalance {
        let last = course.states.iter().rposition(|state| state.pressure > 0.0).unwrap_or(0);
        let mut out = HeatBalance::default();
        let conduction = course.laws.heat.conduction;
        let made: Vec<(f64, f64)> = (0..=last)
            .map(|i| {
                let Made { sheared, compressed } = course.place(i, self.mobility[i]).made(&self.stations[i]);
                (inner(&ACROSS.weights, &sheared), inner(&ACROSS.weights, &compressed))
            })
            .collect();
        // The first cell has no balance: what flows back leaves it as it comes.
        for i in 2..=last {
            let half = 0.5 * (self.x[i] - self.x[i - 1]);
            for k in [i - 1, i] {
                out.sheared += half * made[k].0;
                out.compressed += half * made[k].1;
                for (sum, flux) in out.into_bodies.iter_mut().zip(&self.flux) {
                    *sum += half * conduction * flux[k];
                }
            }
        }
        let carried = |i: usize| {
            let Station { theta, flowing, .. } = &self.stations[i];
            let product: Profile = std::array::from_fn(|j| flowing.flow[j] * theta[j]);
            inner(&ACROSS.weights, &product)
        };
        out.carried = carried(last) - carried(1.min(last));
        out
    }
}

impl<'a> Course<'a> {
    fn place(&self, i: usize, mobility: f64) -> Place<'a> {
        Place { laws: self.laws, limit: self.limit, state: self.states[i], mobility }
    }
}
