//! The march of temperatures along the film, station after station.
//!
//! Upwind quotients of what the film carries, of second order, and of first order for two stations behind where it
//! turns; what crosses the film is upwinded on the cells of Lobatto's points by the flow Ψ of the former state. One more
//! sweep back and forth over the stations at which the film flows back in the inlet.

use super::across::{ACROSS, POINTS, Profile, inner};
use super::film::WarmLaws;
use super::station::{Limit, Made, Neighbours, Place, Side, Station};
use super::surfaces::MovingSource;
use crate::solver::discrete::grid::stretched;
use crate::solver::discrete::reynolds::generalized::NodeState;
use serde::{Deserialize, Serialize};
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

/// What flows along Y at the stations of one line along X, at the temperatures before a march.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Aside {
    /// θ.
    theta: Vec<Profile>,
    /// Hρ̄v̄.
    flow: Vec<Profile>,
    /// The same between body 1 and the faces between the points, and the upper surface.
    total: Vec<Profile>,
}

/// The lines beside a line along X in a plane.
#[derive(Clone, Copy, Debug)]
pub struct Beside<'a> {
    /// All lines, from the edge to the axis of symmetry.
    pub lines: &'a [Aside],
    /// Their ordinates in units of a.
    pub y: &'a [f64],
    /// Which one it is.
    pub own: usize,
}

impl Beside<'_> {
    /// What station i has from the lines farther from the axis and nearer to it; none on the axis, across which nothing
    /// flows.
    fn sides(&self, i: usize) -> Option<[Side; 2]> {
        let axis = self.lines.len().checked_sub(1)?;
        if self.own == axis {
            return None;
        }
        let side = |near: Option<usize>, far: Option<usize>, leaves: &dyn Fn(f64) -> bool| {
            let Some(near) = near else { return Side::default() };
            let from = [near, far.unwrap_or(near)];
            let theta = from.map(|line| self.lines[line].theta[i]);
            let flow = from.map(|line| self.lines[line].flow[i]);
            Side::of(from.map(|line| self.y[self.own] - self.y[line]), theta, flow, |k, j| leaves(flow[k][j]))
        };
        Some([
            side(self.own.checked_sub(1), self.own.checked_sub(2), &|v| v < 0.0),
            side(Some(self.own + 1), Some(self.own + 2).filter(|line| *line <= axis), &|v| v >= 0.0),
        ])
    }

    /// ∂/∂Y of a value at station i that is odd about the axis.
    fn slope(&self, value: impl Fn(&Aside) -> f64) -> f64 {
        let axis = self.lines.len() - 1;
        let at = |line: usize| value(&self.lines[line]);
        match self.own {
            own if own == axis => {
                if own == 0 {
                    0.0
                } else {
                    -at(own - 1) / (self.y[own] - self.y[own - 1])
                }
            }
            0 => (at(1) - at(0)) / (self.y[1] - self.y[0]),
            own => {
                let [a, b, c] = central(self.y[own] - self.y[own - 1], self.y[own + 1] - self.y[own]);
                a * at(own - 1) + b * at(own) + c * at(own + 1)
            }
        }
    }
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
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
    /// With so many times another one.
    pub fn plus(self, times: f64, other: &Self) -> Self {
        Self {
            sheared: self.sheared + times * other.sheared,
            compressed: self.compressed + times * other.compressed,
            into_bodies: [0, 1].map(|side| self.into_bodies[side] + times * other.into_bodies[side]),
            carried: self.carried + times * other.carried,
        }
    }

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

    /// Cold stations at X = −1 + (ξ + 1) s, of the reference abscissae ξ by which it was made.
    pub fn begin(&mut self, reference: &[f64], scale: f64) {
        for (x, xi) in self.x.iter_mut().zip(reference) {
            *x = stretched(*xi, scale);
        }
        self.root = scale.sqrt();
        self.stations.fill(Station::default());
        self.flux.iter_mut().for_each(|flux| flux.fill(0.0));
    }

    /// Marches once through a state of pressure and film, and takes a share of the change of θ that comes of it. Returns
    /// the largest change.
    pub fn run(&mut self, course: &Course<'_>, share: f64, tolerance: f64) -> f64 {
        self.prepare(course, None);
        self.go(course, None, share, tolerance)
    }

    /// Marches through a state that it was [prepared](Self::prepare) for, in a plane beside other lines, and takes a share
    /// of the change of θ. Returns the largest change.
    pub fn go(&mut self, course: &Course<'_>, beside: Option<Beside<'_>>, share: f64, tolerance: f64) -> f64 {
        for (former, station) in self.former.iter_mut().zip(&self.stations) {
            *former = station.theta;
        }
        self.cross(course, beside);
        let n = self.x.len();
        let course = (course, beside);
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
            // What has not come to rest may be back where it began.
            largest = largest.max(station.open);
            for (theta, former) in station.theta.iter_mut().zip(former) {
                let change = *theta - former;
                largest = largest.max(change.abs());
                // Far from the solution a march overshoots in the pressure spike.
                *theta = former + (share * change).clamp(-LARGEST_CHANGE, LARGEST_CHANGE);
            }
        }
        largest
    }

    /// Films at the former temperatures: the mobilities by which the pressure was found, and what flows; along Y for the
    /// lines beside it.
    pub fn prepare(&mut self, course: &Course<'_>, mut aside: Option<&mut Aside>) {
        let up_to = |profile: &Profile| {
            let mut sum = 0.0;
            std::array::from_fn(|j| {
                sum += ACROSS.weights[j] * profile[j];
                sum
            })
        };
        if let Some(Aside { theta, flow, total }) = &mut aside {
            [theta, flow, total].into_iter().for_each(|list| list.clear());
        }
        for (i, station) in self.stations.iter_mut().enumerate() {
            course.place(i, 0.0).evaluate(station);
            self.mobility[i] = station.flowing.mobility;
            self.flow[i] = up_to(&station.flowing.flow);
            if let Some(aside) = &mut aside {
                aside.theta.push(station.theta);
                aside.flow.push(station.flowing.aside);
                aside.total.push(up_to(&station.flowing.aside));
            }
        }
    }

    /// Tells the lines beside it its new temperatures.
    pub fn tell(&self, out: &mut Aside) {
        out.theta.iter_mut().zip(&self.stations).for_each(|(theta, station)| *theta = station.theta);
    }

    /// What crosses the film from one of its points to the next.
    fn cross(&mut self, course: &Course<'_>, beside: Option<Beside<'_>>) {
        let n = self.x.len();
        for i in 0..n {
            let ruptured = self.x[i] > 0.0 && course.states[i].pressure <= 0.0;
            let [from, to] = [i.saturating_sub(1), (i + 1).min(n - 1)];
            self.across[i] = if ruptured || from + 1 >= to {
                [0.0; POINTS - 1]
            } else {
                let [a, b, c] = central(self.x[i] - self.x[from], self.x[to] - self.x[i]);
                let slope = |j: usize| {
                    let along = a * self.flow[from][j] + b * self.flow[i][j] + c * self.flow[to][j];
                    beside.map_or(along, |beside| along + beside.slope(|line| line.total[i][j]))
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
    fn solve(&mut self, (course, beside): (&Course<'_>, Option<Beside<'_>>), i: usize, tolerance: f64) {
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
            beside: beside.and_then(|beside| beside.sides(i)),
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
        let there = from.map(|k| &self.stations[k]);
        let (theta, flow) = (there.map(|station| station.theta), there.map(|station| station.flowing.flow));
        let away = from.map(|k| self.x[i] - self.x[k]);
        Side::of(away, theta, flow, |k, j| leaves(there[k].flowing.velocity[j]))
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

    /// Where the heat comes from and goes to, in a plane beside other lines.
    pub fn balance(&self, course: &Course<'_>, beside: Option<Beside<'_>>) -> HeatBalance {
        let last = course.states.iter().rposition(|state| state.pressure > 0.0).unwrap_or(0);
        let mut out = HeatBalance::default();
        let conduction = course.laws.heat.conduction;
        let made: Vec<(f64, f64)> = (0..=last)
            .map(|i| {
                let Made { sheared, compressed } = course.place(i, self.mobility[i]).made(&self.stations[i]);
                (inner(&ACROSS.weights, &sheared), inner(&ACROSS.weights, &compressed))
            })
            .collect();
        let carried = |flow: &Profile, theta: &Profile| {
            let product: Profile = std::array::from_fn(|j| flow[j] * theta[j]);
            inner(&ACROSS.weights, &product)
        };
        // The first cell has no balance: what flows back leaves it as it comes.
        for i in 2..=last {
            let half = 0.5 * (self.x[i] - self.x[i - 1]);
            for k in [i - 1, i] {
                if let Some(beside) = beside {
                    out.carried += half * beside.slope(|line| carried(&line.flow[k], &line.theta[k]));
                }
                out.sheared += half * made[k].0;
                out.compressed += half * made[k].1;
                for (sum, flux) in out.into_bodies.iter_mut().zip(&self.flux) {
                    *sum += half * conduction * flux[k];
                }
            }
        }
        let [enters, leaves] = [1.min(last), last].map(|i| {
            let Station { theta, flowing, .. } = &self.stations[i];
            carried(&flowing.flow, theta)
        });
        out.carried += leaves - enters;
        out
    }
}

/// What the values before, at and behind a point count in the slope there, of second order.
fn central(before: f64, behind: f64) -> [f64; 3] {
    let sum = before + behind;
    [-behind / (before * sum), (behind - before) / (before * behind), before / (behind * sum)]
}

impl<'a> Course<'a> {
    /// The same through other states.
    pub fn through<'b>(&self, states: &'b [NodeState]) -> Course<'b>
    where
        'a: 'b,
    {
        Course { states, ..*self }
    }

    fn place(&self, i: usize, mobility: f64) -> Place<'a> {
        Place { laws: self.laws, limit: self.limit, state: self.states[i], mobility }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three lines up to an axis, with one station whose temperatures and flows are given.
    fn lines(theta: [f64; 3], flow: [f64; 3]) -> Vec<Aside> {
        let line = |k: usize| Aside {
            theta: vec![[theta[k]; POINTS]],
            flow: vec![[flow[k]; POINTS]],
            total: vec![[flow[k]; POINTS]],
        };
        (0..3).map(line).collect()
    }

    const Y: [f64; 3] = [-0.5, -0.2, 0.0];

    #[test]
    fn what_flows_aside_is_differentiated_exactly_where_it_is_a_parabola_or_odd() {
        // 3y + 2y³ has no exact quotient, y and y² have.
        let all = lines([0.0; 3], Y.map(|y| 3.0 * y));
        for own in 0..3 {
            let slope = Beside { lines: &all, y: &Y, own }.slope(|line| line.total[0][0]);
            assert!((slope - 3.0).abs() < 1e-12, "{own}: {slope}");
        }
        let all = lines([0.0; 3], Y.map(|y| y * y));
        let slope = Beside { lines: &all, y: &Y, own: 1 }.slope(|line| line.total[0][0]);
        assert!((slope + 0.4).abs() < 1e-12, "{slope}");
    }

    #[test]
    fn a_line_has_its_temperatures_from_where_the_oil_comes() {
        // Away from the axis: ρ̄v̄θ_Y of a linear θ, of second order from the two lines nearer to it.
        let theta = Y.map(|y| 1.0 + 2.0 * y);
        let outwards = lines(theta, [-0.7; 3]);
        let [farther, nearer] = Beside { lines: &outwards, y: &Y, own: 0 }.sides(0).unwrap();
        assert_eq!(farther, Side::default(), "nothing lies beyond the edge");
        let (carried, _) = nearer.carried(4, -0.7, theta[0]);
        assert!((carried + 0.7 * 2.0).abs() < 1e-12, "{carried}");
        // Towards the axis: the line at the edge is all that lies there.
        let inwards = lines(theta, [0.7; 3]);
        let [farther, _] = Beside { lines: &inwards, y: &Y, own: 1 }.sides(0).unwrap();
        let (carried, slope) = farther.carried(4, 0.7, theta[1]);
        assert!((carried - 0.7 * 2.0).abs() < 1e-12 && slope > 0.0, "{carried}");
        assert!(Beside { lines: &inwards, y: &Y, own: 2 }.sides(0).is_none(), "nothing crosses the axis");
    }
}
