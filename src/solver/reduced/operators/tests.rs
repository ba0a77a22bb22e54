//! Test of an additional part: pressure that depends on the film thickness at each node, as between asperities.

use super::part::{Moved, Part, Step};
use super::readings::Readings;
use super::sampled_system::SampledSystem;
use super::*;
use crate::solver::discrete::nodes::Order;
use crate::solver::discrete::reynolds::generalized::FilmTreatment;
use crate::solver::full::Problem;
use crate::solver::reduced::Sampling;
use crate::solver::training::small::{line, trained};
use std::sync::{Arc, Mutex};

/// P_a = A exp(−H/h) at the support, its derivative, and the phases of solves in which it took part, in the order of
/// their first call.
struct Springs {
    amplitude: f64,
    height: f64,
    fluid: Vec<f64>,
    slopes: Vec<f64>,
    phases: Arc<Mutex<Vec<&'static str>>>,
}

impl Springs {
    fn note(&self, phase: &'static str) {
        let mut phases = self.phases.lock().unwrap();
        if !phases.contains(&phase) {
            phases.push(phase);
        }
    }

    fn pressure(&self, film: f64) -> f64 {
        self.amplitude * (-film / self.height).exp()
    }
}

impl Part for Springs {
    fn begin(&mut self, system: &mut SampledSystem, _: &Case<'_>, _: &Start<'_>) {
        self.note("begin");
        let places = system.support.len();
        (self.fluid, self.slopes) = (vec![0.0; places], vec![0.0; places]);
    }

    fn nodes(&mut self, system: &mut SampledSystem, case: &Case<'_>, _: super::case::State<'_>) -> bool {
        self.note("nodes");
        for (k, film) in system.films.iter().enumerate() {
            let own = self.pressure(*film);
            (self.fluid[k], self.slopes[k]) = (system.fields[k] - own, -own / self.height);
        }
        let (state, treatment) = ((self.fluid.as_slice(), system.films.as_slice()), FilmTreatment::default());
        system.nodes.evaluate(case.problem.laws(), state, |_| [0.0; 2], treatment, Order::BesideTheFormer);
        true
    }

    fn slopes(&mut self, system: &mut SampledSystem) {
        self.note("slopes");
        let rows = system.by_film.iter_mut().zip(&system.by_pressure).zip(&system.stencils);
        for ((by_film, by_pressure), stencil) in rows {
            for ((film, pressure), place) in by_film.iter_mut().zip(by_pressure).zip(stencil) {
                *film -= pressure * self.slopes[*place];
            }
        }
    }

    fn settle(&mut self, _: &mut SampledSystem, _: &Case<'_>, step: Step, _: (&mut [f64], &mut f64)) -> Moved {
        self.note("settle");
        assert!(step.omega > 0.0 && step.size >= 0.0);
        Moved::Still
    }

    fn read(&mut self, system: &SampledSystem, _: &Case<'_>, _: super::case::State<'_>, readings: &mut Readings) {
        self.note("read");
        readings.cut.extend(system.films.iter().enumerate().map(|(place, film)| (place, self.pressure(*film))));
    }
}

#[test]
fn a_part_changes_node_laws_and_row_derivatives() {
    let model = trained(&line(Sampling::QDeim, 50));
    let window = &model.windows[0];
    let known = &window.snapshots[0];
    let problem = Problem::new(&known.point, model.domain.lubricant).unwrap();
    let scale = window.grid.scale(problem.moes);
    let stop = Stop::new(1e-8, 40);
    let case = Case { problem: &problem, scale, curvature: 1.0, penalty: window.penalty, prescribed: false, stop };
    let phases = Arc::new(Mutex::new(Vec::new()));
    let solved = |amplitude: f64| {
        let mut operators = Operators::new(window, usize::MAX, None, Flow::Newtonian);
        let (height, phases) = (0.5 * known.h_c, Arc::clone(&phases));
        let (fluid, slopes) = (Vec::new(), Vec::new());
        operators.parts.push(Box::new(Springs { amplitude, height, fluid, slopes, phases }));
        let (mut coefficients, mut h_0) = (known.coefficients.clone(), known.h_0);
        let modes = coefficients.len();
        operators.begin(&case, &Start { window, modes, fronts: Some(&[]), held: false, theta: &[] });
        operators.aim(window, scale);
        let outcome = operators.newton(&case, (&mut coefficients, &mut h_0), None);
        let h_c = h_0 - 0.5 * scale.ln() + operators.lifted(&coefficients);
        let largest = operators.read(&case, &coefficients, h_0).cut.iter().map(|(_, p)| *p).fold(0.0, f64::max);
        (outcome, h_c, largest)
    };
    let (smooth, rough) = (solved(0.0), solved(0.02));
    assert!(smooth.0.converged && rough.0.converged, "{:?} {:?}", smooth.0, rough.0);
    assert!((smooth.1 / known.h_c - 1.0).abs() < 1e-3 && smooth.2 == 0.0, "{} {}", smooth.1, known.h_c);
    assert!(rough.1 != smooth.1 && rough.2 > 1e-4, "{rough:?}");
    assert!(rough.0.iterations <= 12, "{rough:?}");
    assert_eq!(*phases.lock().unwrap(), ["begin", "nodes", "slopes", "settle", "read"]);
}
