//! Thermal contacts with reduced operators. Each Newton step for the pressure coefficients p̃ and the rigid-body
//! separation H₀ follows a march of the temperatures at constant pressure and film thickness, until neither changes.
//! The march visits every few nodes of a line, or of a few lines of a plane. Temperatures need no basis.

mod stations;

pub(crate) use stations::{Stations, carried};

use super::case::{Case, Start, State};
use super::part::{Flow, Kind, Moved, Part, Setting, Step};
use super::readings::{Readings, RuleTraction};
use super::sampled_system::SampledSystem;
use super::traction::{Rule, RuleNode};
use crate::solver::discrete::grid::{ContactGrid, stretched};
use crate::solver::discrete::heat::{ACROSS, Lines, MovingSource, RULE, Spread, WarmFilm, apply};
use crate::solver::discrete::reynolds::generalized::NodeState;
use crate::solver::full::heat::{Mixing, Rises, mid_stress_pa, one_sided};
use crate::solver::reduced::temperature_field::TemperatureField;
use std::sync::Arc;

/// Stopping tolerances of the coupled iteration, relative to that of Newton's method alone: for the relative step of
/// pressure and film thickness, and for the change of the temperature rise θ. A kelvin is 3e-3.
const TOLERANCES: (f64, f64) = (10.0, 10.0);

/// Maximum number of coupled iterations, relative to the maximum number of isothermal Newton steps.
const TURNS_PER_STEP: usize = 4;

/// States are mixed below this step of pressure and film thickness and this change of θ.
const NEAR: f64 = 0.1;

/// Smallest share of a temperature change that is applied.
const LEAST_SHARE: f64 = 0.06;

/// Part of the operators of thermal contacts.
pub(super) const KIND: Kind = Kind {
    nodes: |window, flow, nodes| {
        if flow == Flow::Thermal {
            let stations = Stations::of(&window.grid);
            nodes.always.extend(stations.nodes().flatten().chain(stations.inlets().flatten()));
        }
    },
    make: |Setting { window, flow, deformation }, system| {
        (flow == Flow::Thermal).then(|| -> Box<dyn Part> {
            let rule = Rule::of(window, (system.modes, system.axes), deformation);
            Box::new(Heated::new(&window.grid, system, rule))
        })
    },
};

/// Sources of one line's states.
struct Looked {
    /// Places of its stations in the support, and of its first three nodes.
    stations: Vec<usize>,
    inlet: [usize; 3],
}

/// Interpolation of the temperatures at some nodes from the marched lines.
pub(super) struct Interpolation {
    /// (ξ, Y) of the nodes.
    places: Vec<(f64, f64)>,
    /// Scale of the last contact, and the interpolation for it.
    scale: f64,
    spread: Spread,
}

impl Interpolation {
    /// Creates the interpolation for nodes at these (ξ, Y).
    pub fn new(places: impl Iterator<Item = (f64, f64)>) -> Self {
        Self { places: places.collect(), scale: f64::NAN, spread: Spread::default() }
    }

    /// Updates the interpolation for a scale; only line contacts are stretched.
    fn follow(&mut self, lines: &Lines, ordinates: &[f64], scale: f64) {
        if self.scale != scale {
            let places = self.places.iter().map(|&(xi, y)| (stretched(xi, scale), y));
            (self.scale, self.spread) = (scale, Spread::new(lines.x(), ordinates, places));
        }
    }

    /// Returns θ at the nodes, at the points of the quadrature rule across the film.
    fn theta<'a>(&'a self, lines: &'a Lines) -> impl Iterator<Item = [f64; RULE]> + 'a {
        self.spread.profiles(lines).map(|profile| apply(&ACROSS.to_rule, &profile))
    }
}

/// Control of the temperature change per iteration.
struct Pace {
    /// Share of the change that is applied.
    share: f64,
    /// Largest change in this iteration and in the one before.
    changed: f64,
    before: f64,
}

impl Pace {
    /// State of the first iteration.
    const FIRST: Self = Self { share: 1.0, changed: 1e-3, before: f64::INFINITY };
}

/// Temperatures in reduced operators, and their march.
struct Heated {
    /// True for a thermal contact. For an isothermal one the temperatures are not marched.
    heats: bool,
    looked: Vec<Looked>,
    /// ξ of the stations, and Y of the lines in units of b.
    reference: Vec<f64>,
    ordinates: Vec<f64>,
    lines: Lines,
    /// X of the support.
    x: Vec<f64>,
    /// Places in the support whose film the rows use.
    films: Vec<usize>,
    /// Interpolation of the temperatures at these places, and the temperatures on the support.
    interpolation: Interpolation,
    film: WarmFilm,
    mixing: Mixing,
    /// p̃, H₀ and θ before and after an iteration.
    from: Vec<f64>,
    image: Vec<f64>,
    pace: Pace,
    /// Traction quadrature, and interpolation of the temperatures at its nodes; `None` for a local model without one.
    rule: Option<(Rule, Interpolation)>,
}

impl Heated {
    /// Creates the part for the rows of a system.
    fn new(grid: &ContactGrid, system: &SampledSystem, rule: Option<Rule>) -> Self {
        let support = &system.support.places;
        let mut films: Vec<usize> = system.stencils.iter().flatten().copied().collect();
        films.sort_unstable();
        films.dedup();
        let place = |node: usize| support.partition_point(|place| place.node < node);
        let stations = Stations::of(grid);
        let looked = stations
            .nodes()
            .zip(stations.inlets())
            .map(|(nodes, inlet)| Looked { stations: nodes.into_iter().map(place).collect(), inlet: inlet.map(place) });
        let (reference, y) = (stations.xi(grid), stations.y(grid));
        let interpolation = Interpolation::new(films.iter().map(|&k| grid.place(support[k].node)));
        let film = WarmFilm { theta: vec![[0.0; RULE]; support.len()], stress: vec![0.0; support.len()] };
        let at_places = |rule: Rule| {
            let places = Interpolation::new(rule.places().iter().map(|place| grid.place(place.node)));
            (rule, places)
        };
        Self {
            heats: false,
            looked: looked.collect(),
            lines: Lines::new(y.clone(), &reference, &Arc::new(MovingSource::new(&reference))),
            reference,
            ordinates: y,
            x: vec![0.0; support.len()],
            films,
            interpolation,
            film,
            mixing: Mixing::default(),
            from: Vec::new(),
            image: Vec::new(),
            pace: Pace::FIRST,
            rule: rule.map(at_places),
        }
    }

    /// Sets P, its gradient and H at the stations, from P, K P, P_ξ and P_Y on the support and the film thicknesses
    /// there.
    fn look(&mut self, fields: &[f64], films: &[f64], scale: f64) {
        let count = films.len();
        for (line, looked) in self.lines.lines.iter_mut().zip(&self.looked) {
            for (state, &k) in line.states.iter_mut().zip(&looked.stations) {
                let gradient = [fields[2 * count + k] / scale, fields.get(3 * count + k).copied().unwrap_or(0.0)];
                *state = NodeState { pressure: fields[k], gradient, film: films[k] };
            }
            let [x, pressure] = [&self.x, fields].map(|values| looked.inlet.map(|k| values[k]));
            if let Some(first) = line.states.first_mut() {
                // At the inlet the pressure of the outside node is not defined.
                first.gradient[0] = one_sided(&x, pressure);
            }
        }
    }

    /// Writes p̃, H₀ and θ to one array.
    fn state(lines: &Lines, (coefficients, h_0): (&[f64], f64), out: &mut Vec<f64>) {
        out.clear();
        out.extend_from_slice(coefficients);
        out.push(h_0);
        out.extend(lines.stations().flat_map(|station| station.theta));
    }

    /// Mixes the state after an iteration with previous ones.
    fn mix(&mut self, coefficients: &mut [f64], h_0: &mut f64) {
        Self::state(&self.lines, (coefficients, *h_0), &mut self.image);
        self.mixing.improve(&self.from, &mut self.image);
        let (mixed, rest) = self.image.split_at(coefficients.len());
        coefficients.copy_from_slice(mixed);
        *h_0 = rest[0];
        self.lines.put(&rest[1..]);
    }

    /// Returns the traction of a state by the quadrature with the current temperatures; `None` without a quadrature.
    fn traction(&mut self, case: &Case<'_>, state: State<'_>) -> Option<RuleTraction> {
        let Case { problem, scale, .. } = *case;
        let (laws, (rule, interpolation)) = (problem.warm_laws()?, self.rule.as_mut()?);
        interpolation.follow(&self.lines, &self.ordinates, scale);
        let theta = interpolation.theta(&self.lines);
        let stresses = rule.states(case, state).zip(theta).map(|(RuleNode { xi, weight, state }, theta)| {
            let carried = carried(problem.point.kind, stretched(xi, scale), state.pressure);
            weight * mid_stress_pa(problem, laws.heat, laws.mid_stress(state, &theta), carried)
        });
        let force = stresses.sum::<f64>();
        Some(RuleTraction { coefficient: scale * force * problem.point.area_per_load(), cut: None })
    }
}

impl Part for Heated {
    /// A cold start begins at θ = 0 with the pressures of thermal contacts, without an isothermal solution in between.
    fn begin(&mut self, system: &mut SampledSystem, case: &Case<'_>, start: &Start<'_>) {
        if let Some((rule, _)) = &mut self.rule {
            rule.begin(system, case, start);
        }
        self.heats = case.problem.heat.is_some();
        if !self.heats {
            return;
        }
        system.stop.tolerance *= TOLERANCES.0;
        system.stop.max_newton *= TURNS_PER_STEP;
        system.stop.at_step = true;
        // Distances between lines are those of the ellipse.
        let kappa = case.problem.point.ellipse().kappa;
        self.lines.y.iter_mut().zip(&self.ordinates).for_each(|(y, own)| *y = kappa * own);
        for line in &mut self.lines.lines {
            line.march.begin(&self.reference, case.scale);
        }
        for (station, theta) in self.lines.stations_mut().zip(start.theta) {
            station.theta = *theta;
        }
        for (x, place) in self.x.iter_mut().zip(&system.support.places) {
            *x = stretched(place.xi, case.scale);
        }
        self.interpolation.follow(&self.lines, &self.ordinates, case.scale);
        self.film.stress.fill(0.0);
        self.mixing.begin();
        self.pace = Pace::FIRST;
    }

    /// Marches once and applies a share of the change, then evaluates the nodes at these temperatures.
    fn nodes(&mut self, system: &mut SampledSystem, case: &Case<'_>, state: State<'_>) -> bool {
        let Some((laws, course)) = case.problem.warm_laws().zip(case.problem.course(&[])) else { return false };
        let (scale, tolerance) = (case.scale, case.stop.tolerance);
        self.look(&system.fields, &system.films, scale);
        Self::state(&self.lines, (state.coefficients, state.h_0), &mut self.from);
        let tolerance = (1e-2 * self.pace.changed).clamp(tolerance, 1e-3);
        self.pace.changed = self.lines.march(&course, (self.pace.share, tolerance), false);
        for (&k, theta) in self.films.iter().zip(self.interpolation.theta(&self.lines)) {
            self.film.theta[k] = theta;
        }
        let count = system.films.len();
        let (pressure, rest) = system.fields.split_at(count);
        let gradients = &rest[count..];
        let gradient = |k: usize| [gradients[k] / scale, gradients.get(count + k).copied().unwrap_or(0.0)];
        system.nodes.evaluate_warm_at(&self.films, &laws, (pressure, &system.films), gradient, &mut self.film);
        true
    }

    fn settle(
        &mut self,
        _: &mut SampledSystem,
        case: &Case<'_>,
        step: Step,
        (coefficients, h_0): (&mut [f64], &mut f64),
    ) -> Moved {
        let (Step { omega, size }, wanted) = (step, case.stop.tolerance);
        let Pace { share, changed, before } = &mut self.pace;
        if !self.heats {
            return Moved::Still;
        }
        if !changed.is_finite() {
            return Moved::Lost;
        }
        if omega == 1.0 && size < TOLERANCES.0 * wanted && *changed < TOLERANCES.1 * wanted {
            return Moved::Still;
        }
        let mixes = size.max(*changed) < NEAR && omega == 1.0 && *changed > size;
        if !mixes {
            // Temperatures that oscillate with the pressure converge if a smaller share of their change is applied.
            let swings = *changed > 0.8 * *before;
            *share = if swings { (0.75 * *share).max(LEAST_SHARE) } else { (1.5 * *share).min(1.0) };
        }
        *before = *changed;
        if !mixes {
            self.mixing.forget();
            return Moved::PastRows;
        }
        // Mixing helps only where the temperatures converge more slowly than Newton's method.
        self.mix(coefficients, h_0);
        Moved::State
    }

    fn read(&mut self, system: &SampledSystem, case: &Case<'_>, state: State<'_>, readings: &mut Readings) {
        match case.problem.heat {
            Some(laws) => {
                readings.traction = self.traction(case, state);
                let theta = self.lines.stations().map(|station| station.theta).collect();
                let central = Rises::central(&self.lines, laws.heat.inlet_temperature);
                readings.temperatures = Some(TemperatureField { theta, central });
            }
            None => self.rule.iter_mut().for_each(|(rule, _)| rule.read(system, case, state, readings)),
        }
    }
}
