//! Line contacts with heat: Newton steps for pressure and film with the temperatures held, and marches of the
//! temperatures with pressure and film held, in turns.

mod mixing;
mod temperatures;
#[cfg(test)]
mod tests;

pub(in crate::solver) use mixing::Mixing;
pub(in crate::solver) use temperatures::{NodeArrays, mid_stress_pa};
pub use temperatures::{Rises, Temperatures};

use super::line::Backtracking;
use super::solution::{Problem, Report, Solution, SolveError, Termination};
use super::solver::{Solver, Start, warm_state};
use super::system::{SolveOptions, System};
use crate::solver::discrete::grid::INLET;
use crate::solver::discrete::heat::{March, POINTS, WarmFilm};
use crate::solver::discrete::reynolds::generalized::{NodalGradient, NodeState};
use crate::solver::discrete::space::LineSpace;
use crate::solver::observer::Observer;
use crate::solver::physics::lubricant::{Cavitation, ScaledHeat};
use std::sync::Arc;

/// Accuracy of the isothermal solution that everything begins with.
const ISOTHERMAL: f64 = 1e-3;

/// How turns go on.
#[derive(Clone, Copy)]
struct Pace {
    /// Turns at most.
    turns: usize,
    /// Least share of a change of temperatures that is taken.
    least_share: f64,
    /// Backtracking of the steps of pressure and film ends at this share of them.
    shortest_step: f64,
}

impl Pace {
    const QUICK: Self = Self { turns: 120, least_share: 0.25, shortest_step: 1.0 };
    /// Where that does not settle.
    const SLOW: Self = Self { turns: 120, least_share: 0.06, shortest_step: 1.0 / 16.0 };
}

/// A step of pressure and film, relative, and a change of θ that end the turns.
const LAST: (f64, f64) = (1e-6, 3e-6);

/// Turns after which ten times of that will do: where the film ruptures or flows back a node may come and go.
const LATE: usize = 60;

/// A step of pressure and film and a change of θ below which states are mixed.
const NEAR: f64 = 0.1;

/// Largest change of P in one step.
const LARGEST_STEP: f64 = 0.3;

/// Least distance of stations in front of X = ½; farther than X = −1 it grows with the distance.
const SPACING: f64 = 0.02;

/// Accuracy of the linear solves.
const FORCING: f64 = 1e-3;

/// The same of the last step.
const LAST_FORCING: f64 = 1e-9;

/// Solves a contact with heat: from a former solution with heat, if that leads to none from the contact without heat.
pub(super) fn solve(
    solver: &mut Solver<LineSpace>,
    problem: Problem,
    start: Start<'_>,
    observer: &dyn Observer,
) -> Result<Solution, SolveError> {
    let Some(heat) = problem.heat else { return solver.solve_problem(problem, start, observer) };
    let mut spent = Report::empty();
    if let Start::From(former) = start
        && former.heat.is_some()
        && former.problem.point.kind == problem.point.kind
    {
        let solution = from(solver, problem, &heat, (former, Pace::QUICK), spent, observer)?;
        if solution.report.ended() {
            return Ok(solution);
        }
        spent = solution.report;
    }
    // The front of rupture comes to its place much faster by complementarity, whose pressures those of a penalty are
    // told by.
    let fast = by_complementarity(&problem);
    let options = solver.options;
    solver.options.tolerance = ISOTHERMAL;
    let cold = solver.solve_problem(fast.isothermal(), start, observer);
    solver.options = options;
    let cold = cold?;
    spent.add(&cold.report);
    if !cold.converged() {
        return Ok(Solution { problem, report: spent, ..cold });
    }
    let solution = from(solver, problem, &heat, (&cold, Pace::QUICK), spent, observer)?;
    if solution.report.ended() {
        return Ok(solution);
    }
    from(solver, problem, &heat, (&cold, Pace::SLOW), solution.report, observer)
}

/// The same problem with a film that ruptures by complementarity, where a penalty would.
fn by_complementarity(problem: &Problem) -> Problem {
    let mut fast = *problem;
    if fast.lubricant.cavitation == Cavitation::Penalty {
        fast.lubricant.cavitation = Cavitation::Complementarity;
    }
    fast
}

/// Solves a contact from a solution with heat or without; `report` goes on.
fn from(
    solver: &mut Solver<LineSpace>,
    problem: Problem,
    heat: &ScaledHeat,
    (former, pace): (&Solution, Pace),
    mut report: Report,
    observer: &dyn Observer,
) -> Result<Solution, SolveError> {
    let mut system = solver.system_for(&problem)?;
    warm_state(&mut system, &problem, former);
    if problem.lubricant.cavitation == Cavitation::Penalty && former.multiplier.len() == system.pressure.len() {
        // The pressure at which a penalty is the multiplier.
        for (p, multiplier) in system.pressure.iter_mut().zip(&former.multiplier) {
            *p -= multiplier / solver.options.penalty;
        }
        let h_0 = system.h_0;
        system.deform();
        system.set_h_0(h_0);
    }
    report.attempts += 1;
    let mut coupled = Coupled::new(&system, former.heat.as_deref());
    coupled.turn(&mut system, &problem, (&solver.options, pace), observer, &mut report);
    coupled.look(&system);
    let temperatures = Temperatures::of(&coupled, &system, &problem, heat);
    system.warm = None;
    solver.system = Some(system);
    Ok(Solution { heat: Some(Arc::new(temperatures)), ..solver.solution(problem, report)? })
}

/// Pressure, film and temperatures in turns.
struct Coupled {
    march: March,
    /// The node of each station.
    nodes: Vec<usize>,
    states: Vec<NodeState>,
    gradient: NodalGradient,
}

impl Coupled {
    /// At the nodes of a system, as warm as a former contact was.
    fn new(system: &System<LineSpace>, former: Option<&Temperatures>) -> Self {
        let x = &system.space.grid.x;
        let nodes = station_nodes(x);
        let stations: Vec<f64> = nodes.iter().map(|&node| x[node]).collect();
        let march = match former {
            Some(former) if former.stations == stations => March::with(stations, Arc::clone(&former.source)),
            _ => March::new(stations),
        };
        let mut out =
            Self { states: vec![NodeState::default(); nodes.len()], march, nodes, gradient: NodalGradient::new(x) };
        if let Some(former) = former {
            out.march.warm(&former.x, &former.rise_k, 1.0 / former.inlet_k);
        }
        out
    }

    /// P, P_X and H at the stations.
    fn look(&mut self, system: &System<LineSpace>) {
        let x = &system.space.grid.x;
        for (i, (state, &node)) in self.states.iter_mut().zip(&self.nodes).enumerate() {
            let pressure = &system.pressure;
            // At the inlet the node outside knows nothing of the pressure.
            let gradient =
                if i == 0 { one_sided(&x[node..], &pressure[node..]) } else { self.gradient.at(pressure, node) };
            *state = NodeState { pressure: pressure[node], gradient: [gradient, 0.0], film: system.film[node] };
        }
    }

    /// Takes turns until they change nothing any more.
    fn turn(
        &mut self,
        system: &mut System<LineSpace>,
        problem: &Problem,
        (options, pace): (&SolveOptions<Backtracking>, Pace),
        observer: &dyn Observer,
        report: &mut Report,
    ) {
        let control = Backtracking {
            shortest_step: pace.shortest_step,
            largest_step: LARGEST_STEP,
            film_loss: 0.7,
            // The temperatures move on before the next step in any case.
            looks_back: pace.shortest_step < 1.0 || problem.lubricant.cavitation != Cavitation::Penalty,
            forcing: (FORCING, FORCING),
            ..options.control
        };
        let options = SolveOptions { max_newton: 1, control, tolerance: LAST.0, ..*options };
        let mut changed: f64 = 1e-3;
        let mut mixing = Mixing::default();
        let (mut share, mut before) = (1.0f64, f64::INFINITY);
        let (mut from, mut image) = (Vec::new(), Vec::new());
        for turn in 0..pace.turns {
            self.look(system);
            self.state(system, &mut from);
            let mut march = std::mem::take(&mut self.march);
            if let Some(course) = problem.course(&self.states) {
                changed = march.run(&course, share, (1e-3 * changed).clamp(1e-10, 1e-4));
            }
            self.march = march;
            let warm = system.warm.get_or_insert_with(WarmFilm::default);
            warm.spread(&system.space.grid.x, &self.march.x, |i| self.march.stations[i].theta);
            system.newton(problem, &options, observer, report);
            let size = report.steps.last().copied().unwrap_or(f64::NAN);
            if matches!(report.termination, Termination::Cancelled | Termination::Diverged) {
                return;
            }
            report.termination = Termination::IterationLimit;
            let patience = if turn > LATE { 10.0 } else { 1.0 };
            if size < patience * LAST.0 && changed < patience * LAST.1 {
                // One more step, solved for to rounding.
                let control = Backtracking { forcing: (LAST_FORCING, LAST_FORCING), looks_back: true, ..control };
                let options = SolveOptions { control, ..options };
                system.newton(problem, &options, observer, report);
                if !matches!(report.termination, Termination::Cancelled | Termination::Diverged) {
                    report.termination = Termination::Converged;
                }
                return;
            }
            let now = size.max(changed);
            if now < NEAR {
                self.state(system, &mut image);
                mixing.improve(&from, &mut image);
                self.put(system, problem, &image);
            } else {
                // Temperatures that swing with the pressure come to rest when they follow it by halves.
                share = if now > 0.8 * before { (0.75 * share).max(pace.least_share) } else { (1.1 * share).min(1.0) };
                mixing.forget();
            }
            before = now;
        }
    }

    /// P, H₀ and θ in one.
    fn state(&self, system: &System<LineSpace>, out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(&system.pressure);
        out.push(system.h_0);
        out.extend(self.march.stations.iter().flat_map(|station| station.theta));
    }

    /// Takes over such a state.
    fn put(&mut self, system: &mut System<LineSpace>, problem: &Problem, state: &[f64]) {
        let (pressure, rest) = state.split_at(system.pressure.len());
        system.set_pressure(problem, pressure);
        system.set_h_0(rest[0]);
        for (station, theta) in self.march.stations.iter_mut().zip(rest[1..].chunks_exact(POINTS)) {
            station.theta.copy_from_slice(theta);
        }
    }
}

/// The nodes that are stations: in front of X = ½, where nodes crowd because the viscosity rises steeply, and where no
/// spike of pressure heats the film, those that are some distance apart.
fn station_nodes(x: &[f64]) -> Vec<usize> {
    let mut out = vec![INLET];
    let mut last = x[INLET];
    for (node, &x) in x.iter().enumerate().skip(INLET + 1) {
        let apart = if x < 0.5 { SPACING * (-x).max(1.0) } else { 0.0 };
        if x - last >= apart {
            out.push(node);
            last = x;
        }
    }
    out
}

/// The slope at the first of three nodes, of second order.
pub(in crate::solver) fn one_sided(x: &[f64], values: &[f64]) -> f64 {
    let (near, far) = (x[1] - x[0], x[2] - x[0]);
    let [to_near, to_far] = [(values[1] - values[0]) / near, (values[2] - values[0]) / far];
    (far * to_near - near * to_far) / (far - near)
}
