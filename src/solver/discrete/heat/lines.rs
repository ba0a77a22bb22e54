//! Lines along X on which the temperatures are marched: several parallel lines of a plane, or the single line of a
//! line contact.

use super::across::Profile;
use super::march::{Aside, Beside, Course, HeatBalance, March};
use super::surfaces::MovingSource;
use super::{POINTS, Station};
use crate::host::pool::on_all_cores;
use crate::solver::discrete::grid::cubic;
use crate::solver::discrete::reynolds::generalized::NodeState;
use rayon::prelude::*;
use std::sync::Arc;

/// Line along X.
#[derive(Clone, Debug)]
pub struct Line {
    /// Stations of the line with their temperatures.
    pub march: March,
    /// Pressure P, its gradient and film thickness H at the stations.
    pub states: Vec<NodeState>,
}

/// Parallel lines with equal abscissae.
#[derive(Clone, Debug)]
pub struct Lines {
    /// Lines from the edge of a plane to its axis; at least one.
    pub lines: Vec<Line>,
    /// Ordinates of the lines in units of the half-width a.
    pub y: Vec<f64>,
    /// Flow from line to line at the temperatures before the last march; empty for a single line.
    asides: Vec<Aside>,
}

impl Lines {
    /// Creates cold lines (temperature rise θ = 0) at increasing ordinates, the last of them on the axis, with the
    /// given abscissae of stations.
    pub fn new(y: Vec<f64>, stations: &[f64], source: &Arc<MovingSource>) -> Self {
        let line = |_: &f64| Line {
            march: March::with(stations.to_vec(), Arc::clone(source)),
            states: vec![NodeState::default(); stations.len()],
        };
        let lines: Vec<Line> = y.iter().map(line).collect();
        let asides = if lines.len() > 1 { vec![Aside::default(); lines.len()] } else { Vec::new() };
        Self { lines, y, asides }
    }

    /// Abscissae of the stations.
    pub fn x(&self) -> &[f64] {
        self.lines.last().map_or(&[], |axis| &axis.march.x)
    }

    /// Influence of the heat fluxes on the surface temperatures at the stations.
    pub fn source(&self) -> Arc<MovingSource> {
        self.lines.last().map(|axis| Arc::clone(&axis.march.source)).unwrap_or_default()
    }

    /// Iterates over all stations, line by line.
    pub fn stations(&self) -> impl Iterator<Item = &Station> {
        self.lines.iter().flat_map(|line| &line.march.stations)
    }

    /// Iterates over all stations, line by line, with mutable access.
    pub fn stations_mut(&mut self) -> impl Iterator<Item = &mut Station> {
        self.lines.iter_mut().flat_map(|line| &mut line.march.stations)
    }

    /// Sets θ of all stations from one array, station by station.
    pub fn put(&mut self, theta: &[f64]) {
        for (station, theta) in self.stations_mut().zip(theta.chunks_exact(POINTS)) {
            station.theta.copy_from_slice(theta);
        }
    }

    /// Marches once along every line through its states and applies a share of the change of θ. The states in `course`
    /// are ignored. If `parallel`, the films of all lines are evaluated on all threads. Returns the largest change.
    pub fn march(&mut self, course: &Course<'_>, (share, tolerance): (f64, f64), parallel: bool) -> f64 {
        let Self { lines, asides, y } = self;
        if let [line] = &mut lines[..] {
            return line.march.run(&course.through(&line.states), share, tolerance);
        }
        let prepare = |(line, aside): (&mut Line, &mut Aside)| {
            line.march.prepare(&course.through(&line.states), Some(aside));
        };
        match parallel {
            true => on_all_cores(|| lines.par_iter_mut().zip(&mut *asides).for_each(prepare)),
            false => lines.iter_mut().zip(&mut *asides).for_each(prepare),
        }
        // From the axis to the edge, the direction of the pressure-driven side flow. In front of the contact the film
        // turns and hardly moves along X; the oil there comes from the axis.
        let mut changed = 0.0f64;
        for (own, line) in lines.iter_mut().enumerate().rev() {
            let beside = Beside { lines: asides, y, own };
            changed = changed.max(line.march.go(&course.through(&line.states), Some(beside), share, tolerance));
            line.march.tell(&mut asides[own]);
        }
        changed
    }

    /// Returns the heat balance over the width of all lines, or per unit width for a line contact.
    pub fn balance(&self, course: &Course<'_>) -> HeatBalance {
        let beside = |own| (self.lines.len() > 1).then_some(Beside { lines: &self.asides, y: &self.y, own });
        let each = self.lines.iter().enumerate();
        each.fold(HeatBalance::default(), |sum, (own, line)| {
            sum.plus(width(&self.y, own), &line.march.balance(&course.through(&line.states), beside(own)))
        })
    }
}

/// Returns the width of the strip around a line by the trapezoidal rule; 1 for a single line.
fn width(y: &[f64], own: usize) -> f64 {
    let at = |line: usize| y.get(line).copied().unwrap_or_default();
    match y.len() {
        1 => 1.0,
        n => 0.5 * (at((own + 1).min(n - 1)) - at(own.saturating_sub(1))),
    }
}

/// Interpolation between lines at increasing ordinates, the last of them on the axis, for values that are even about
/// the axis.
struct Across {
    /// Ordinates, followed by those of the mirrored lines next to the axis.
    y: Vec<f64>,
    /// Index of the line on the axis.
    axis: usize,
}

impl Across {
    fn new(y: &[f64]) -> Self {
        let mirrored = y.iter().rev().skip(1).take(2).map(|y| -y);
        Self { y: y.iter().copied().chain(mirrored).collect(), axis: y.len() - 1 }
    }

    /// Returns lines and weights of the cubic interpolation at an ordinate Y ≤ 0. Beyond the outermost line its value
    /// is used.
    fn at(&self, at: f64) -> [(usize, f64); 4] {
        let (axis, outermost) = (self.axis, self.y[0]);
        let at = at.max(outermost);
        if self.y.len() < 4 {
            // One line, or two.
            let share = if axis == 0 { 1.0 } else { (at - outermost) / (self.y[axis] - outermost) };
            return [(axis, share), (0, 1.0 - share), (0, 0.0), (0, 0.0)];
        }
        let (first, weights) = cubic(&self.y, at);
        std::array::from_fn(|k| {
            let line = first + k;
            (if line > axis { 2 * axis - line } else { line }, weights[k])
        })
    }
}

/// Interpolation of a value between stations and lines.
#[derive(Clone, Copy, Debug)]
struct Between {
    /// First of four stations, and their weights.
    along: (usize, [f64; 4]),
    /// Lines and their weights.
    across: [(usize, f64); 4],
}

/// Interpolation from the stations of lines to other places, cubic along X and across.
#[derive(Clone, Debug, Default)]
pub struct Spread {
    places: Vec<Between>,
}

impl Spread {
    /// Prepares the interpolation to places (ξ, Y), with the abscissa ξ, from stations at increasing ξ. Places before
    /// the first station take its value.
    pub fn new(stations: &[f64], y: &[f64], places: impl Iterator<Item = (f64, f64)>) -> Self {
        let lines = Across::new(y);
        let of = |(xi, at): (f64, f64)| Between { along: cubic(stations, xi.max(stations[0])), across: lines.at(at) };
        Self { places: places.map(of).collect() }
    }

    /// Returns the interpolated profiles at the places.
    pub fn profiles<'a>(&'a self, lines: &'a Lines) -> impl Iterator<Item = Profile> + 'a {
        self.places.iter().map(move |Between { along: (first, along), across }| {
            let mut here = [0.0; POINTS];
            for &(line, share) in across.iter().filter(|(_, share)| *share != 0.0) {
                for (station, weight) in lines.lines[line].march.stations[*first..].iter().zip(along) {
                    let weight = share * weight;
                    here.iter_mut().zip(&station.theta).for_each(|(sum, own)| *sum += weight * own);
                }
            }
            here
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const Y: [f64; 5] = [-1.2, -0.8, -0.5, -0.3, 0.0];

    #[test]
    fn what_is_even_and_of_third_degree_is_found_between_lines() {
        let (across, value) = (Across::new(&Y), |y: f64| 2.0 - 3.0 * y * y);
        for at in [-1.2, -1.0, -0.61, -0.2, -0.07, 0.0] {
            let found: f64 = across.at(at).iter().map(|(line, weight)| weight * value(Y[*line])).sum();
            assert!((found - value(at)).abs() < 1e-12, "{at}: {found}");
        }
        assert_eq!(across.at(-0.5).iter().filter(|(_, weight)| *weight != 0.0).count(), 1, "a line itself");
        let beyond: f64 = across.at(-1.7).iter().map(|(line, weight)| weight * value(Y[*line])).sum();
        assert_eq!(beyond, value(-1.2));
        assert_eq!(Across::new(&[0.0]).at(-0.4)[0], (0, 1.0));
    }

    #[test]
    fn profiles_are_cubic_along_the_lines_and_even_across() {
        let stations: Vec<f64> = (0..9).map(|k| -2.0 + 0.4 * f64::from(k)).collect();
        let mut lines = Lines::new(Y.to_vec(), &stations, &Arc::new(MovingSource::new(&stations)));
        let value = |x: f64, y: f64| x * x * x - y * y * (1.0 + x);
        for (line, y) in lines.lines.iter_mut().zip(Y) {
            for (station, x) in line.march.stations.iter_mut().zip(&stations) {
                station.theta = [value(*x, y); POINTS];
            }
        }
        let places = [(-1.33, -0.9), (0.17, -0.11), (1.2, 0.0)];
        let spread = Spread::new(&stations, &Y, places.into_iter());
        for ((x, y), profile) in places.into_iter().zip(spread.profiles(&lines)) {
            assert!(profile.iter().all(|found| (found - value(x, y)).abs() < 1e-12), "{x} {y}: {profile:?}");
        }
    }
}
