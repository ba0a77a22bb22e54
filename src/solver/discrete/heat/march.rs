//! March of the temperatures along the film, station by station.
//!
//! Convection along X is second-order upwind, and first-order at two stations behind a place where the flow turns.
//! The flow across the film is upwinded on the cells of the Lobatto points; it follows from the stream function Ψ of
//! the previous state. Stations where the film flows back in the inlet are swept once more backward and forward.

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
    /// Stations.
    pub stations: Vec<Station>,
    /// Heat fluxes q̄ into both bodies.
    pub flux: [Vec<f64>; 2],
    /// Influence of the fluxes on the surface temperatures.
    pub source: Arc<MovingSource>,
    /// Heat flux into each body from the friction of touching asperities, besides those of the film; empty without
    /// asperities. In the unit of q̄.
    pub boundary: Vec<f64>,
    /// Contribution of these fluxes to the integrals of both surface temperatures.
    boundary_rise: Vec<f64>,
    /// Pressure-driven flow at the stations over that of a smooth film; empty if the film is smooth.
    pub flow_factor: Vec<f64>,
    /// Factor on that influence: the square root of the scale by which the abscissae were stretched.
    root: f64,
    /// Mobilities with which the pressure was computed.
    mobility: Vec<f64>,
    /// Ψ at the faces between the points, and at the upper surface.
    flow: Vec<Profile>,
    /// −Ψ_X at the faces between the points.
    across: Vec<[f64; POINTS - 1]>,
    former: Vec<Profile>,
}

/// Flow along Y at the stations of one line along X, at the temperatures before a march.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Aside {
    /// Temperature rise θ.
    theta: Vec<Profile>,
    /// Mass flow Hρ̄v̄ along Y (film thickness H, density ρ̄, velocity v̄).
    flow: Vec<Profile>,
    /// Integral of the mass flow from body 1 to the faces between the points, and to the upper surface.
    total: Vec<Profile>,
}

/// Neighbours of a line along X in a plane.
#[derive(Clone, Copy, Debug)]
pub struct Beside<'a> {
    /// All lines, from the edge to the axis of symmetry.
    pub lines: &'a [Aside],
    /// Ordinates of the lines in units of the half-width a.
    pub y: &'a [f64],
    /// Index of the line itself.
    pub own: usize,
}

impl Beside<'_> {
    /// Returns the upwind data of station i from the lines farther from the axis and nearer to it. `None` on the
    /// axis, which no flow crosses.
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

    /// Returns ∂/∂Y of a value at station i that is odd about the axis.
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

/// State that the temperatures are marched through.
#[derive(Clone, Copy, Debug)]
pub struct Course<'a> {
    /// Heat and shear laws of the contact.
    pub laws: WarmLaws<'a>,
    /// Limiting shear stress, if any.
    pub limit: Option<Limit>,
    /// Pressure P, its gradient and film thickness H at the stations.
    pub states: &'a [NodeState],
}

/// Heat balance: integrals over the film up to the cavitation boundary, all in one unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeatBalance {
    /// Heat generated by shear, and by the friction of touching asperities.
    pub sheared: f64,
    /// Heat generated by compression, minus the heat absorbed by expansion.
    pub compressed: f64,
    /// Heat into each body.
    pub into_bodies: [f64; 2],
    /// Heat carried off by the oil, behind the contact and by backflow out of the inlet.
    pub carried: f64,
}

impl HeatBalance {
    /// Returns this balance plus `times` another one.
    pub fn plus(self, times: f64, other: &Self) -> Self {
        Self {
            sheared: self.sheared + times * other.sheared,
            compressed: self.compressed + times * other.compressed,
            into_bodies: [0, 1].map(|side| self.into_bodies[side] + times * other.into_bodies[side]),
            carried: self.carried + times * other.carried,
        }
    }

    /// Returns generated minus removed heat, relative to the heat of shear and compression.
    pub fn residual(&self) -> f64 {
        let made = self.sheared + self.compressed;
        let left = self.into_bodies[0] + self.into_bodies[1] + self.carried;
        let size = self.sheared.abs() + self.compressed.abs();
        if size > 0.0 { (made - left) / size } else { 0.0 }
    }
}

impl March {
    /// Creates cold stations (θ = 0) at increasing abscissae.
    pub fn new(x: Vec<f64>) -> Self {
        let source = Arc::new(MovingSource::new(&x));
        Self::with(x, source)
    }

    /// Does the same with a given influence of the fluxes for these abscissae.
    pub fn with(x: Vec<f64>, source: Arc<MovingSource>) -> Self {
        let n = x.len();
        Self {
            source,
            root: 1.0,
            stations: vec![Station::default(); n],
            flux: [vec![0.0; n], vec![0.0; n]],
            boundary: Vec::new(),
            boundary_rise: Vec::new(),
            flow_factor: Vec::new(),
            mobility: vec![0.0; n],
            flow: vec![[0.0; POINTS]; n],
            across: vec![[0.0; POINTS - 1]; n],
            former: vec![[0.0; POINTS]; n],
            x,
        }
    }

    /// Resets the stations to θ = 0 at X = −1 + (ξ + 1) s, with the reference abscissae ξ for which the influence was
    /// computed and the scale s.
    pub fn begin(&mut self, reference: &[f64], scale: f64) {
        for (x, xi) in self.x.iter_mut().zip(reference) {
            *x = stretched(*xi, scale);
        }
        self.root = scale.sqrt();
        self.stations.fill(Station::default());
        self.flux.iter_mut().for_each(|flux| flux.fill(0.0));
    }

    /// Marches once through a state of pressure and film thickness and applies a share of the change of θ. Returns
    /// the largest change.
    pub fn run(&mut self, course: &Course<'_>, share: f64, tolerance: f64) -> f64 {
        self.prepare(course, None);
        self.go(course, None, share, tolerance)
    }

    /// Marches through a state for which [`Self::prepare`] was called, with neighbouring lines in a plane, and
    /// applies a share of the change of θ. Returns the largest change.
    pub fn go(&mut self, course: &Course<'_>, beside: Option<Beside<'_>>, share: f64, tolerance: f64) -> f64 {
        for (former, station) in self.former.iter_mut().zip(&self.stations) {
            *former = station.theta;
        }
        self.cross(course, beside);
        self.boundary_rise.clear();
        for (i, own) in self.boundary.iter().enumerate() {
            let (before, weight) = self.source.before(i, &self.boundary);
            self.boundary_rise.push(self.root * (before + weight * own));
        }
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
            // A station that has not converged may have returned to its starting value.
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

    /// Evaluates the films at the previous temperatures: the mobilities with which the pressure was computed, and the
    /// flow. Writes the flow along Y to `aside` for the neighbouring lines.
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
        for i in 0..self.stations.len() {
            let place = course.place(i, 0.0, self.factor(i));
            let station = &mut self.stations[i];
            place.evaluate(station);
            self.mobility[i] = station.flowing.mobility;
            self.flow[i] = up_to(&station.flowing.flow);
            if let Some(aside) = &mut aside {
                aside.theta.push(station.theta);
                aside.flow.push(station.flowing.aside);
                aside.total.push(up_to(&station.flowing.aside));
            }
        }
    }

    /// Passes the new temperatures to the neighbouring lines.
    pub fn tell(&self, out: &mut Aside) {
        out.theta.iter_mut().zip(&self.stations).for_each(|(theta, station)| *theta = station.theta);
    }

    /// Returns the factor of the pressure-driven flow at a station; 1 for a smooth film.
    fn factor(&self, i: usize) -> f64 {
        self.flow_factor.get(i).copied().unwrap_or(1.0)
    }

    /// Computes the flow across the film from each point to the next.
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
                // Mass is conserved: the discretisation error of the total flow is distributed evenly across the film.
                let lost = slope(POINTS - 1);
                let mut share = 0.0;
                std::array::from_fn(|j| {
                    share += ACROSS.weights[j];
                    share * lost - slope(j)
                })
            };
        }
    }

    /// Solves one station with the values of its neighbours.
    fn solve(&mut self, (course, beside): (&Course<'_>, Option<Beside<'_>>), i: usize, tolerance: f64) {
        let n = self.x.len();
        if i == 0 {
            // Fluid that enters has the inlet temperature (θ = 0); fluid that leaves keeps its own.
            let next = self.stations[1.min(n - 1)].theta;
            let place = course.place(0, self.mobility[0], self.factor(0));
            let own = &mut self.stations[0];
            own.theta = [0.0; POINTS];
            for (j, theta) in own.theta.iter_mut().enumerate().skip(1).take(POINTS - 2) {
                if own.flowing.velocity[j] < 0.0 {
                    *theta = next[j];
                }
            }
            place.evaluate(own);
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
                let boundary = self.boundary_rise.get(i).copied().unwrap_or_default();
                (self.root * before + boundary, self.root * own)
            }),
        };
        let place = course.place(i, self.mobility[i], self.factor(i));
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

    /// Returns the upwind data of a station from the two stations `from` on one side. If the flow there `leaves`
    /// to that side, the difference quotient is of first order.
    fn side(&self, i: usize, from: [usize; 2], leaves: impl Fn(f64) -> bool) -> Side {
        let there = from.map(|k| &self.stations[k]);
        let (theta, flow) = (there.map(|station| station.theta), there.map(|station| station.flowing.flow));
        let away = from.map(|k| self.x[i] - self.x[k]);
        Side::of(away, theta, flow, |k, j| leaves(there[k].flowing.velocity[j]))
    }

    /// Interpolates temperatures linearly from at least two other abscissae and multiplies them by a factor.
    pub fn warm(&mut self, at: &[f64], profiles: &[Profile], factor: f64) {
        for (x, station) in self.x.iter().zip(&mut self.stations) {
            let right = at.partition_point(|at| at < x).clamp(1, at.len() - 1);
            let t = ((x - at[right - 1]) / (at[right] - at[right - 1])).clamp(0.0, 1.0);
            let [a, b] = [&profiles[right - 1], &profiles[right]];
            station.theta = std::array::from_fn(|j| factor * ((1.0 - t) * a[j] + t * b[j]));
        }
    }

    /// Returns the heat balance, with neighbouring lines in a plane.
    pub fn balance(&self, course: &Course<'_>, beside: Option<Beside<'_>>) -> HeatBalance {
        let last = course.states.iter().rposition(|state| state.pressure > 0.0).unwrap_or(0);
        let mut out = HeatBalance::default();
        let conduction = course.laws.heat.conduction;
        let made: Vec<(f64, f64)> = (0..=last)
            .map(|i| {
                let Made { sheared, compressed } =
                    course.place(i, self.mobility[i], self.factor(i)).made(&self.stations[i]);
                (inner(&ACROSS.weights, &sheared), inner(&ACROSS.weights, &compressed))
            })
            .collect();
        let carried = |flow: &Profile, theta: &Profile| {
            let product: Profile = std::array::from_fn(|j| flow[j] * theta[j]);
            inner(&ACROSS.weights, &product)
        };
        // The first cell is not balanced: backflow leaves it with its own temperature.
        for i in 2..=last {
            let half = 0.5 * (self.x[i] - self.x[i - 1]);
            for k in [i - 1, i] {
                if let Some(beside) = beside {
                    out.carried += half * beside.slope(|line| carried(&line.flow[k], &line.theta[k]));
                }
                let boundary = conduction * self.boundary.get(k).copied().unwrap_or_default();
                out.sheared += half * (made[k].0 + 2.0 * boundary);
                out.compressed += half * made[k].1;
                for (sum, flux) in out.into_bodies.iter_mut().zip(&self.flux) {
                    *sum += half * (conduction * flux[k] + boundary);
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

/// Returns the weights of the values before, at and behind a point in the second-order slope there.
fn central(before: f64, behind: f64) -> [f64; 3] {
    let sum = before + behind;
    [-behind / (before * sum), (behind - before) / (before * behind), before / (behind * sum)]
}

impl<'a> Course<'a> {
    /// Returns the same laws with other states.
    pub fn through<'b>(&self, states: &'b [NodeState]) -> Course<'b>
    where
        'a: 'b,
    {
        Course { states, ..*self }
    }

    fn place(&self, i: usize, mobility: f64, flow_factor: f64) -> Place<'a> {
        Place { laws: self.laws, limit: self.limit, state: self.states[i], mobility, flow_factor }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three lines up to an axis, with one station of given temperatures and flows.
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
    fn side_flow_is_exact_for_parabolas_and_odd_profiles() {
        // The quotient is exact for y and y², not for 3y + 2y³.
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
        // Away from the axis: ρ̄v̄θ_Y of a linear θ, of second order from the two lines nearer to the axis.
        let theta = Y.map(|y| 1.0 + 2.0 * y);
        let outwards = lines(theta, [-0.7; 3]);
        let [farther, nearer] = Beside { lines: &outwards, y: &Y, own: 0 }.sides(0).unwrap();
        assert_eq!(farther, Side::default(), "nothing lies beyond the edge");
        let (carried, _) = nearer.carried(4, -0.7, theta[0]);
        assert!((carried + 0.7 * 2.0).abs() < 1e-12, "{carried}");
        // Towards the axis: only the line at the edge is available.
        let inwards = lines(theta, [0.7; 3]);
        let [farther, _] = Beside { lines: &inwards, y: &Y, own: 1 }.sides(0).unwrap();
        let (carried, slope) = farther.carried(4, 0.7, theta[1]);
        assert!((carried - 0.7 * 2.0).abs() < 1e-12 && slope > 0.0, "{carried}");
        assert!(Beside { lines: &inwards, y: &Y, own: 2 }.sides(0).is_none(), "nothing crosses the axis");
    }
}
