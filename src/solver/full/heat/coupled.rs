//! Alternating iteration of pressure, film thickness and temperatures, for a line contact or for all lines along X of
//! a point contact. One turn is a Newton step and a march of the temperatures.

use super::mixing::Mixing;
use super::temperatures::{NodeArrays, Temperatures};
use crate::solver::discrete::heat::{Lines, MovingSource, Profile, Spread, WarmFilm};
use crate::solver::discrete::reynolds::generalized::{NodeState, PlaneGradient};
use crate::solver::discrete::space::Grid;
use crate::solver::full::newton_space::{NewtonSpace, Turn};
use crate::solver::full::problem::Problem;
use crate::solver::full::report::{Report, Termination};
use crate::solver::full::system::{SolveOptions, System};
use crate::solver::observer::Observer;
use crate::solver::physics::lubricant::{Cavitation, ScaledHeat};
use std::sync::Arc;

/// Settings of the alternating iteration.
#[derive(Clone, Copy)]
pub(super) struct Pace {
    /// Maximum number of turns.
    turns: usize,
    /// Smallest share of a temperature change that is applied.
    least_share: f64,
    /// Shortest share of a step of pressure and film thickness in backtracking.
    shortest_step: f64,
}

impl Pace {
    pub const QUICK: Self = Self { turns: 120, least_share: 0.25, shortest_step: 1.0 };
    /// Settings for contacts that do not converge with [`Self::QUICK`].
    pub const SLOW: Self = Self { turns: 120, least_share: 0.06, shortest_step: 1.0 / 16.0 };
}

/// Relative step of pressure and film thickness, and change of θ, below which the iteration ends. θ is the
/// dimensionless temperature rise.
const LAST: (f64, f64) = (1e-6, 3e-6);

/// Number of turns after which ten times these limits are accepted. With cavitation or backflow, a node may keep
/// changing sides.
const LATE: usize = 60;

/// Step of pressure and film thickness, and change of θ, below which states are mixed.
const NEAR: f64 = 0.1;

/// Smallest distance of stations in front of X = ½. Beyond X = −1 it grows with the distance.
const SPACING: f64 = 0.02;

/// Largest change of P in one step.
const LARGEST_STEP: f64 = 0.3;

/// Largest relative reduction of the film thickness in one step.
const FILM_LOSS: f64 = 0.7;

/// Alternating iteration of pressure, film thickness and temperatures.
pub(super) struct Coupled {
    /// Column of nodes of each station.
    columns: Vec<usize>,
    /// All lines of the grid along X.
    pub lines: Lines,
    gradient: PlaneGradient,
}

impl Coupled {
    /// Creates the lines at the nodes of a system, with the temperatures of a previous contact if given.
    pub fn new<S: NewtonSpace>(system: &System<S>, former: Option<&Temperatures>) -> Self {
        let grid = system.space.grid();
        let (x, ordinates) = (grid.abscissae().0, grid.across());
        let columns = station_columns(x, S::FIRST_COLUMN);
        let stations: Vec<f64> = columns.iter().map(|&column| x[column]).collect();
        let known = former.filter(|former| former.stations == stations).map(|former| Arc::clone(&former.source));
        let source = known.unwrap_or_else(|| Arc::new(MovingSource::new(&stations)));
        let mut lines = Lines::new(ordinates.to_vec(), &stations, &source);
        if let Some(former) = former {
            for (line, y) in lines.lines.iter_mut().zip(ordinates) {
                let profiles: Vec<Profile> = former.line_at(*y).collect();
                line.march.warm(&former.x, &profiles, 1.0 / former.inlet_k);
            }
        }
        Self { gradient: PlaneGradient::new(x, ordinates), lines, columns }
    }

    /// Copies P, its gradient and H of the system to the stations. Between rough surfaces these are the pressure of the
    /// film and the mean gap. The friction of the asperities heats both surfaces alike.
    pub fn look<S: NewtonSpace>(&mut self, system: &System<S>, problem: &Problem) {
        let (x, _) = system.space.grid().abscissae();
        let Self { columns, lines, gradient } = self;
        let rough = system.film_between_asperities(problem);
        let (pressure, film) = match &rough {
            Some(fields) => (&fields.pressure, &fields.gap),
            None => (&system.pressure, &system.film),
        };
        let ny = lines.lines.len();
        for (j, line) in lines.lines.iter_mut().enumerate() {
            for (i, (state, &column)) in line.states.iter_mut().zip(&*columns).enumerate() {
                let node = column * ny + j;
                let mut slopes = gradient.at(pressure, column, j);
                if i == 0 {
                    // The node outside the inlet carries no information on the pressure.
                    slopes[0] = one_sided(&x[column..], [0, 1, 2].map(|k| pressure[node + k * ny]));
                }
                *state = NodeState { pressure: pressure[node], gradient: slopes, film: film[node] };
            }
            if let Some((fields, per_pressure)) = rough.as_ref().zip(problem.boundary_flux()) {
                line.march.boundary.clear();
                let carried = columns.iter().map(|column| fields.asperities[column * ny + j]);
                line.march.boundary.extend(carried.map(|carried| per_pressure * carried));
                line.march.flow_factor.clear();
                line.march.flow_factor.extend(columns.iter().map(|column| fields.flow_factor[column * ny + j]));
            }
        }
    }

    /// Returns the temperatures of a state.
    pub fn temperatures<S: NewtonSpace>(
        &self,
        system: &System<S>,
        problem: &Problem,
        heat: &ScaledHeat,
    ) -> Temperatures {
        let (grid, lines) = (system.space.grid(), &self.lines);
        let rough = system.film_between_asperities(problem);
        let fields = NodeArrays {
            x: grid.abscissae().0,
            y: grid.across(),
            first: S::FIRST_COLUMN,
            pressure: rough.as_ref().map_or(&system.pressure, |fields| &fields.pressure),
            film: rough.as_ref().map_or(&system.film, |fields| &fields.gap),
            stress: system.warm.as_ref().map_or(&[][..], |warm| &warm.stress),
        };
        let places = fields.x[fields.first..].iter().flat_map(|x| fields.y.iter().map(|y| (*x, *y)));
        let theta: Vec<Profile> = Spread::new(lines.x(), &lines.y, places).profiles(lines).collect();
        Temperatures::marched(lines, &theta, &fields, (problem, heat))
    }

    /// Alternates until neither pressure, film thickness nor temperatures change.
    pub fn turn<S: NewtonSpace>(
        &mut self,
        system: &mut System<S>,
        problem: &Problem,
        (options, pace): (&SolveOptions<S::Control>, Pace),
        observer: &dyn Observer,
        report: &mut Report,
    ) {
        let turn = Turn {
            largest_step: LARGEST_STEP,
            film_loss: FILM_LOSS,
            shortest_step: pace.shortest_step,
            // Without backtracking the residual is not needed, because the temperatures change before the next step.
            looks_back: pace.shortest_step < 1.0 || problem.lubricant.cavitation != Cavitation::Penalty,
            last: false,
        };
        let control = S::beside_heat(options.control, turn);
        let options = SolveOptions { max_newton: 1, control, tolerance: LAST.0, ..*options };
        let mut changed: f64 = 1e-3;
        let mut mixing = Mixing::default();
        let (mut share, mut before) = (1.0f64, f64::INFINITY);
        let (mut from, mut image) = (Vec::new(), Vec::new());
        system.begin(problem, &options);
        let mut memory = S::Memory::default();
        for number in 0..pace.turns {
            self.look(system, problem);
            self.state(system, &mut from);
            if let Some(course) = problem.course(&[]) {
                changed = self.lines.march(&course, (share, (1e-3 * changed).clamp(1e-10, 1e-4)), true);
            }
            let warm = system.warm.get_or_insert_with(WarmFilm::default);
            let (x, _) = system.space.grid().abscissae();
            let lines = &self.lines.lines;
            let theta = |line: usize, i: usize| lines[line].march.stations[i].theta;
            warm.spread_lines(x, self.lines.x(), lines.len(), theta);
            system.go_on(problem, &options, &mut memory, observer, report);
            let size = report.steps.last().copied().unwrap_or(f64::NAN);
            if matches!(report.termination, Termination::Cancelled | Termination::Diverged) {
                return;
            }
            report.termination = Termination::IterationLimit;
            let patience = if number > LATE { 10.0 } else { 1.0 };
            if size < patience * LAST.0 && changed < patience * LAST.1 {
                // One final step.
                let control = S::beside_heat(control, Turn { looks_back: true, last: true, ..turn });
                let options = SolveOptions { control, ..options };
                system.go_on(problem, &options, &mut memory, observer, report);
                if !matches!(report.termination, Termination::Cancelled | Termination::Diverged) {
                    let at_rest = system.is_at_rest(report.residual_norm);
                    report.termination = if at_rest { Termination::Converged } else { Termination::Diverged };
                }
                return;
            }
            let now = size.max(changed);
            if now < NEAR {
                self.state(system, &mut image);
                mixing.improve(&from, &mut image);
                self.put(system, problem, &mut image);
            } else {
                // Temperatures that oscillate with the pressure converge if only a part of their change is applied.
                share = if now > 0.8 * before { (0.75 * share).max(pace.least_share) } else { (1.1 * share).min(1.0) };
                mixing.forget();
            }
            before = now;
        }
    }

    /// Writes P, H₀ and θ to one array.
    fn state<S: NewtonSpace>(&self, system: &System<S>, out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(&system.pressure);
        out.push(system.h_0);
        out.extend(self.lines.stations().flat_map(|station| station.theta));
    }

    /// Sets such a state. The pressure is zero in the cavitated region.
    fn put<S: NewtonSpace>(&mut self, system: &mut System<S>, problem: &Problem, state: &mut [f64]) {
        let (pressure, rest) = state.split_at_mut(system.pressure.len());
        system.keep_ruptured(pressure);
        system.set_pressure(problem, pressure);
        system.set_h_0(rest[0]);
        self.lines.put(&rest[1..]);
    }
}

/// Returns the columns of nodes that are stations. From X = ½ on every column is one. In front of it, stations have a
/// minimum distance: the nodes are dense because the viscosity rises steeply, and no pressure spike heats the film.
fn station_columns(x: &[f64], first: usize) -> Vec<usize> {
    let mut out = vec![first];
    let mut last = x[first];
    for (column, &x) in x.iter().enumerate().skip(first + 1) {
        let apart = if x < 0.5 { SPACING * (-x).max(1.0) } else { 0.0 };
        if x - last >= apart {
            out.push(column);
            last = x;
        }
    }
    out
}

/// Returns the second-order slope at the first of three nodes.
pub(in crate::solver) fn one_sided(x: &[f64], values: [f64; 3]) -> f64 {
    let (near, far) = (x[1] - x[0], x[2] - x[0]);
    let [to_near, to_far] = [(values[1] - values[0]) / near, (values[2] - values[0]) / far];
    (far * to_near - near * to_far) / (far - near)
}
