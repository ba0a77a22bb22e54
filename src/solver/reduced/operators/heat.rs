//! Contacts with heat on reduced operators: Newton's steps for (p̃, H₀) with the temperatures held, and marches of the
//! temperatures along every few nodes with pressure and film held, in turns. Temperatures need no basis.

use super::Operators;
use super::newton::{Case, OnlineOutcome, RowObserver, Slopes, Stop};
use super::support::Place;
use crate::solver::discrete::grid::{ContactGrid, INLET, cubic};
use crate::solver::discrete::heat::{March, POINTS, Profile, WarmFilm};
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::full::Problem;
use crate::solver::full::heat::{Mixing, Rises, one_sided};

/// Stations along a line contact, at least. With 90 of them tractions of fast contacts that hardly slide are off by 1.5 %.
const STATIONS: usize = 120;

/// What ends turns over what ends Newton's steps alone: a relative step of pressure and film, and a change of θ. A kelvin
/// is 3e-3.
const TOLERANCES: (f64, f64) = (10.0, 10.0);

/// A step of pressure and film and a change of θ below which states are mixed.
const NEAR: f64 = 0.1;

/// Least share of a change of temperatures that is taken.
const LEAST_SHARE: f64 = 0.06;

/// The nodes of a grid at which temperatures are marched: every so many from the inlet to the outlet.
pub(crate) fn station_nodes(grid: &ContactGrid) -> Vec<usize> {
    let last = grid.len() - 1;
    let stride = ((last - INLET) / STATIONS).max(1);
    (INLET..last).step_by(stride).filter(|node| last - node >= stride).chain([last]).collect()
}

/// Nodes that the rows of a contact with heat depend on beside their own.
pub(super) fn further_nodes(grid: &ContactGrid) -> Vec<usize> {
    // At the inlet the slope is one-sided.
    station_nodes(grid).into_iter().chain([INLET + 1, INLET + 2]).collect()
}

/// Temperatures in reduced operators, and what marches them.
pub(super) struct Heated {
    /// Places of the stations in the support, and of the first three nodes.
    stations: Vec<usize>,
    inlet: [usize; 3],
    /// ξ of the stations.
    reference: Vec<f64>,
    march: March,
    states: Vec<NodeState>,
    /// X of the support, and the film's temperatures there.
    x: Vec<f64>,
    film: WarmFilm,
    mixing: Mixing,
    /// p̃, H₀ and θ before a turn and after it.
    from: Vec<f64>,
    image: Vec<f64>,
}

/// The temperatures of a reduced solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Warmth {
    /// θ = (T − T₀)/T₀ at the stations of the march, from body 1 to body 2.
    pub theta: Vec<Profile>,
    /// Rises above T₀ at X = 0.
    pub central: Rises,
}

impl Heated {
    pub fn new(grid: &ContactGrid, support: &[Place]) -> Self {
        let place = |node: usize| support.partition_point(|place| place.node < node);
        let nodes = station_nodes(grid);
        let reference: Vec<f64> = nodes.iter().map(|&node| grid.place(node).0).collect();
        Self {
            stations: nodes.iter().map(|&node| place(node)).collect(),
            inlet: [0, 1, 2].map(|k| place(INLET + k)),
            march: March::new(reference.clone()),
            states: vec![NodeState::default(); reference.len()],
            reference,
            x: vec![0.0; support.len()],
            film: WarmFilm::default(),
            mixing: Mixing::default(),
            from: Vec::new(),
            image: Vec::new(),
        }
    }

    /// The film with its temperatures, at the support.
    pub fn film(&mut self) -> &mut WarmFilm {
        &mut self.film
    }

    /// τ̄_m at the support.
    pub fn stress(&self) -> &[f64] {
        &self.film.stress
    }

    /// Begins a contact at a scale, at given temperatures where there are any.
    fn begin(&mut self, support: &[Place], scale: f64, theta: &[Profile]) {
        self.march.begin(&self.reference, scale);
        for (station, theta) in self.march.stations.iter_mut().zip(theta) {
            station.theta = *theta;
        }
        for (x, place) in self.x.iter_mut().zip(support) {
            *x = -1.0 + (place.xi + 1.0) * scale;
        }
        self.film.stress.fill(0.0);
        self.mixing.begin();
    }

    /// P, P_X and H at the stations, from P, K P and P_ξ on the support and the films there.
    fn look(&mut self, fields: &[f64], films: &[f64], scale: f64) {
        let count = films.len();
        for (state, &k) in self.states.iter_mut().zip(&self.stations) {
            *state = NodeState { pressure: fields[k], gradient: [fields[2 * count + k] / scale, 0.0], film: films[k] };
        }
        let [x, pressure] = [&self.x, fields].map(|values| self.inlet.map(|k| values[k]));
        if let Some(first) = self.states.first_mut() {
            // At the inlet the node outside knows nothing of the pressure.
            first.gradient[0] = one_sided(&x, pressure);
        }
    }

    /// Marches once and takes a share of the change; returns the largest one.
    fn march(&mut self, problem: &Problem, share: f64, tolerance: f64) -> f64 {
        let Some(course) = problem.course(&self.states) else { return f64::NAN };
        let changed = self.march.run(&course, share, tolerance);
        self.film.spread(&self.x, &self.march.x, |i| self.march.stations[i].theta);
        changed
    }

    fn state(march: &March, (coefficients, h_0): (&[f64], f64), out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(coefficients);
        out.push(h_0);
        out.extend(march.stations.iter().flat_map(|station| station.theta));
    }

    /// Mixes the state that a turn led to with those before it.
    fn mix(&mut self, coefficients: &mut [f64], h_0: &mut f64) {
        Self::state(&self.march, (coefficients, *h_0), &mut self.image);
        self.mixing.improve(&self.from, &mut self.image);
        let (mixed, rest) = self.image.split_at(coefficients.len());
        coefficients.copy_from_slice(mixed);
        *h_0 = rest[0];
        for (station, theta) in self.march.stations.iter_mut().zip(rest[1..].chunks_exact(POINTS)) {
            station.theta.copy_from_slice(theta);
        }
    }

    fn warmth(&self, inlet_k: f64) -> Warmth {
        let (first, weights) = cubic(&self.march.x, 0.0);
        let near = &self.march.stations[first..];
        let at_zero = |j: usize| inlet_k * weights.iter().zip(near).map(|(w, own)| w * own.theta[j]).sum::<f64>();
        Warmth {
            theta: self.march.stations.iter().map(|station| station.theta).collect(),
            central: Rises::of(&std::array::from_fn(at_zero)),
        }
    }
}

impl Operators {
    /// The temperatures of the last turns; none of a model that knows no heat.
    pub fn warmth(&self, problem: &Problem) -> Option<Warmth> {
        Some(self.heated.as_ref()?.warmth(problem.heat.as_ref()?.heat.inlet_temperature))
    }

    /// Takes turns of one march and one Newton step on (p̃, H₀) each until neither changes anything, from temperatures at
    /// the stations, or cold.
    pub fn turns(
        &mut self,
        case: &Case<'_>,
        (coefficients, h_0): (&mut [f64], &mut f64),
        theta: &[Profile],
        stop: Stop,
        mut observer: Option<RowObserver<'_>>,
    ) -> OnlineOutcome {
        let mut outcome = OnlineOutcome { converged: false, iterations: 0, step: f64::NAN, residual: f64::NAN };
        let Some(heated) = self.heated.as_mut() else { return outcome };
        heated.begin(&self.support.places, case.scale, theta);
        self.state.spread(&self.support, None, coefficients, &mut self.scratch.fields);
        self.scratch.nodes.forget();
        let (mut changed, mut share, mut before) = (1e-3f64, 1.0f64, f64::INFINITY);
        for turn in 1..=stop.max_newton {
            outcome.iterations = turn;
            self.lay_films(case, *h_0);
            let Some(heated) = self.heated.as_mut() else { return outcome };
            heated.look(&self.scratch.fields, &self.scratch.films, case.scale);
            Heated::state(&heated.march, (coefficients, *h_0), &mut heated.from);
            changed = heated.march(case.problem, share, (1e-2 * changed).clamp(stop.tolerance, 1e-3));
            outcome.residual = self.evaluate(case, coefficients, *h_0, Some(Slopes::Usual));
            if !self.linear_step(case.problem, case.scale, coefficients, observer.is_some()) {
                return outcome;
            }
            if let Some(observer) = observer.as_mut() {
                self.show(case, (coefficients, *h_0), observer);
            }
            let omega = self.damping(case.scale);
            outcome.step = self.take_step(omega, coefficients, h_0);
            if !(outcome.step.is_finite() && changed.is_finite()) {
                return outcome;
            }
            if omega == 1.0 && outcome.step < TOLERANCES.0 * stop.tolerance && changed < TOLERANCES.1 * stop.tolerance {
                outcome.converged = true;
                break;
            }
            let Some(heated) = self.heated.as_mut() else { return outcome };
            let now = outcome.step.max(changed);
            if now < NEAR && omega == 1.0 && changed > outcome.step {
                // Newton's steps need no help; where these are small it is the temperatures that take their time.
                heated.mix(coefficients, h_0);
                self.state.spread(&self.support, None, coefficients, &mut self.scratch.fields);
            } else {
                // Temperatures that swing with the pressure come to rest when they follow it by less.
                share = if now > 0.8 * before { (0.75 * share).max(LEAST_SHARE) } else { (1.1 * share).min(1.0) };
                heated.mixing.forget();
            }
            before = now;
        }
        // A converged iteration with an absurd residual has found garbage.
        outcome.converged &= outcome.residual.is_finite() && outcome.residual < 1e3;
        outcome
    }
}
