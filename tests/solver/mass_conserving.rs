//! Mass-conserving cavitation: comparison with an independent program and with complementarity, its own conditions,
//! starvation of line and point contacts, and transient contacts.

use crate::contacts::{at, line_of, solved};
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::transient::{
    Frame, Inputs, Keep, Quantity, Signal, State, Trajectory, Transient, solve,
};
use ehl_explorer::solver::full::{ContactSolver, Problem, Solution, SolveError, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw, Sliding};

const PLANE: GridSpec = GridSpec::Plane(PointGridSpec::uniform(0.05, 0.1, (-4.0, 1.6, -2.5)));

fn laws(supply_film_m: Option<f64>) -> Lubricant {
    Lubricant { cavitation: Cavitation::MassConserving { supply_film_m }, ..Lubricant::default() }
}

fn complementary() -> Lubricant {
    Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() }
}

/// Returns the flow ρ̄θH at every node.
fn flow(s: &Solution) -> Vec<f64> {
    let of = |((p, h), fraction): ((&f64, &f64), &f64)| s.problem.fluid.at(*p).density * h * fraction;
    s.pressure.iter().zip(&s.film).zip(&s.fraction).map(of).collect()
}

#[test]
fn flooded_and_starved_lines_agree_with_independent_values() {
    let file: serde_json::Value = serde_json::from_str(include_str!("../data/mass_conserving.json")).unwrap();
    let contacts = file["contacts"].as_array().unwrap();
    assert_eq!(contacts.len(), 3);
    let mut solver = ContactSolver::on(&GridSpec::DISSERTATION.build().unwrap());
    for contact in contacts {
        let point = line_of(contact);
        let flooded = solved(&mut solver, &point, laws(None));
        let wanted = contact["flooded"]["H_c"].as_f64().unwrap();
        assert!((flooded.scalars.h_c / wanted - 1.0).abs() < 1e-12);
        for starved in contact["starved"].as_array().unwrap() {
            let of = |name: &str| starved[name].as_f64();
            let film_in = of("H_in").unwrap();
            let s = solved(&mut solver, &point, laws(Some(film_in * point.film_scale_m())));
            let name = format!("{} at r = {}", contact["name"], starved["r"]);
            for (quantity, got) in [("H_c", s.scalars.h_c), ("H_min", s.scalars.h_min), ("P_c", s.scalars.p_c)] {
                assert!((got / of(quantity).unwrap() - 1.0).abs() < 1e-11, "{name}: {quantity} {got}");
            }
            assert!((s.rupture().unwrap() - of("X_rupture").unwrap()).abs() < 1e-9, "{name}: {:?}", s.rupture());
            let meniscus = of("X_meniscus");
            assert_eq!(s.meniscus().is_some(), meniscus.is_some(), "{name}: {:?}", s.meniscus());
            if let (Some(got), Some(wanted)) = (s.meniscus(), meniscus) {
                assert!((got - wanted).abs() < 1e-9, "{name}: {got}");
                // Inflow and outflow are equal.
                let out = flow(&s)[s.x.len() - 2];
                assert!((out / film_in - 1.0).abs() < 1e-11, "{name}: {out}");
            }
            let last = s.fraction[s.x.len() - 2];
            assert!((last - of("theta_outlet").unwrap()).abs() < 1e-11, "{name}: θ {last} at the outlet");
        }
    }
}

#[test]
fn flooded_films_equal_complementarity() {
    for (kind, spec, m, l) in [
        (ContactKind::Line, GridSpec::DISSERTATION, 40.0, 10.0),
        (ContactKind::Line, GridSpec::EXPLORER, 200.0, 10.0),
        (ContactKind::Line, GridSpec::EXPLORER, 429.7, 16.0),
        (ContactKind::Point, PLANE, 50.0, 8.0),
    ] {
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        if let ContactSolver::Point(solver) = &mut solver {
            solver.options.tolerance = 1e-10;
            solver.options.control.forcing = 1e-4;
        }
        let point = at(kind, m, l);
        let held = solved(&mut solver, &point, complementary());
        let s = solved(&mut solver, &point, laws(None));
        assert!((s.scalars.h_c / held.scalars.h_c - 1.0).abs() < 1e-10, "M {m}");
        assert!(s.multiplier.is_empty() && s.fraction.len() == s.pressure.len());
        let all = s.pressure.iter().zip(&s.fraction);
        assert!(all.clone().all(|(p, f)| *p >= 0.0 && (0.0..=1.0).contains(f) && p * (1.0 - f) == 0.0));
        assert!(all.filter(|(_, f)| **f < 1.0).count() > 20);
    }
}

/// A steady line contact passes the inlet film: H_c follows the supply up to its flooded value.
#[test]
fn lines_carry_at_most_their_supply() {
    for spec in [GridSpec::DISSERTATION, GridSpec::EXPLORER] {
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        for (m, l) in [(20.0, 3.0), (50.0, 10.0), (200.0, 14.0), (400.0, 6.0)] {
            let point = at(ContactKind::Line, m, l);
            let flooded = solved(&mut solver, &point, complementary());
            let drawn = flooded.scalars.h_c * flooded.problem.fluid.at(flooded.scalars.p_c).density;
            for r in [0.1, 0.3, 0.6, 0.85, 1.2, 1.9] {
                let s = solved(&mut solver, &point, laws(Some(r * drawn * point.film_scale_m())));
                let ratio = s.scalars.h_c / flooded.scalars.h_c;
                assert!((ratio / f64::min(r, 1.0) - 1.0).abs() < 4e-3, "M {m}, L {l}, r {r}: {ratio}");
                assert!(s.pressure.iter().all(|p| *p >= 0.0));
                assert_eq!(s.meniscus().is_some(), r < 1.0, "M {m}, L {l}, r {r}: {:?}", s.meniscus());
            }
        }
    }
}

/// h_c/h_cff = r/(1 + r^γ)^(1/γ) with one γ per contact, between the published 3 and 15. Across each strip of a
/// starved point contact inflow and outflow are equal.
#[test]
fn starved_points_follow_the_published_law_and_keep_their_oil() {
    let mut solver = ContactSolver::on(&PLANE.build().unwrap());
    for (m, l) in [(50.0, 10.0), (200.0, 10.0), (20.0, 5.0)] {
        let point = at(ContactKind::Point, m, l);
        let flooded = solved(&mut solver, &point, complementary());
        let drawn = flooded.scalars.h_c * flooded.problem.fluid.at(flooded.scalars.p_c).density;
        let law = |r: f64, exponent: f64| r / (1.0 + r.powf(exponent)).powf(1.0 / exponent);
        let ratios = [0.3, 0.5, 0.7, 1.0, 1.5, 2.5].map(|r| {
            let s = solved(&mut solver, &point, laws(Some(r * drawn * point.film_scale_m())));
            let defect = defect(&s);
            assert!(defect < 1e-8, "M {m}, r {r}: {defect:.1e}");
            (r, s.scalars.h_c / flooded.scalars.h_c)
        });
        let miss = |exponent: f64| ratios.iter().map(|(r, got)| (law(*r, exponent) - got).abs()).fold(0.0, f64::max);
        let exponents = (150..1500).map(|k| 0.01 * f64::from(k));
        let best = exponents.min_by(|a, b| miss(*a).total_cmp(&miss(*b))).unwrap();
        println!("M {m}, L {l}: gamma {best:.2}, off by {:.4} at most; {ratios:.3?}", miss(best));
        assert!(miss(best) < 0.03 && (2.0..15.0).contains(&best));
    }
}

/// Returns inflow over inlet and side less outflow over the outlet, relative to the inflow.
fn defect(s: &Solution) -> f64 {
    let (ny, nx) = (s.y.len(), s.x.len());
    let (dx, dy) = (s.x[1] - s.x[0], s.y[1] - s.y[0]);
    let q = flow(s);
    let mobility = |k: usize| {
        let liquid = s.problem.fluid.at(s.pressure[k]);
        liquid.density * s.film[k].powi(3) / liquid.viscosity * s.problem.inverse_lambda
    };
    let face = |a: usize, b: usize| 0.5 * (mobility(a) + mobility(b)) * (s.pressure[b] - s.pressure[a]);
    let (mut brought, mut balance) = (0.0, 0.0);
    for j in 1..ny {
        // The strip on the axis is half as wide.
        let width = if j + 1 == ny { 0.5 * dy } else { dy };
        let node = |i: usize| i * ny + j;
        let supply = s.problem.supply.map_or(q[node(0)], |supply| supply.min(q[node(0)]));
        brought += width * supply;
        balance += width * (supply - face(node(0), node(1)) / dx);
        // The equations of the first column are of first order, so that the flux changes its form behind it.
        let upwind = |i: usize| if i == 1 { q[node(1)] } else { 1.5 * q[node(i)] - 0.5 * q[node(i - 1)] };
        balance += width * (1.5 * q[node(1)] - 0.5 * supply - q[node(1)]);
        balance -= width * (upwind(nx - 2) - face(node(nx - 2), node(nx - 1)) / dx);
    }
    for i in 1..nx - 1 {
        balance -= dx * face(i * ny, i * ny + 1) / dy;
    }
    (balance / brought).abs()
}

#[test]
fn thinning_contacts_starve_as_well() {
    let sliding = Sliding { slide_to_roll_ratio: 0.3, newtonian_plateau_ratio: None };
    let point = OperatingPoint { sliding, ..at(ContactKind::Line, 60.0, 8.0) };
    let mut solver = ContactSolver::on(&GridSpec::DISSERTATION.build().unwrap());
    let shear = ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 };
    let mut with = |cavitation: Cavitation| {
        let problem = Problem::new(&point, Lubricant { shear, cavitation, ..Lubricant::default() }).unwrap();
        let s = solver.solve_problem(problem, Start::Cold, &()).unwrap();
        assert!(s.converged(), "{:?}", s.report);
        s
    };
    let held = with(Cavitation::Complementarity);
    let flooded = with(Cavitation::MassConserving { supply_film_m: None });
    assert!((flooded.scalars.h_c / held.scalars.h_c - 1.0).abs() < 1e-9);
    let half = 0.5 * flow(&flooded)[flooded.x.len() - 2];
    let starved = with(Cavitation::MassConserving { supply_film_m: Some(half * point.film_scale_m()) });
    assert!((starved.scalars.h_c / held.scalars.h_c / 0.5 - 1.0).abs() < 2e-2, "{}", starved.scalars.h_c);
    assert!((flow(&starved)[starved.x.len() - 2] / half - 1.0).abs() < 1e-9);
}

/// A uniform grid conserves all liquid of transient contacts: nothing is removed behind the contact.
#[test]
fn in_time_what_is_stored_is_what_flows_in_less_what_flows_out() {
    let spec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
    let inputs = Inputs::load(Signal::Harmonic { amplitude: 0.5, period: 0.5 });
    let usual = Transient::new(OperatingPoint::TABLE_4_2, inputs, 0.4, 2e-3);
    for supply_film_m in [None, Some(60e-9)] {
        let transient = Transient { lubricant: laws(supply_film_m), keep: Keep::Every(1), ..usual.clone() };
        let trajectory = solve(spec, &transient, &()).unwrap();
        assert!(trajectory.finished(), "{:?}", trajectory.ended);
        let (x, problem) = (&trajectory.x, &trajectory.problem);
        let dx = x[5] - x[4];
        let density = |state: &State, i: usize| problem.fluid.at(state.pressure[i]).density;
        let flow = |state: &State, i: usize| {
            let own = density(state, i) * state.film[i] * state.fraction[i];
            if i < 2 { problem.supply.map_or(own, |supply| supply.min(own)) } else { own }
        };
        let mobility = |state: &State, i: usize| {
            let viscosity = problem.fluid.at(state.pressure[i]).viscosity;
            density(state, i) * state.film[i].powi(3) / viscosity * problem.inverse_lambda
        };
        let flux = |state: &State, i: usize| {
            let face = 0.5 * (mobility(state, i) + mobility(state, i + 1));
            1.5 * flow(state, i) - 0.5 * flow(state, i - 1) - face * (state.pressure[i + 1] - state.pressure[i]) / dx
        };
        let (first, last) = (2, x.len() - 2);
        let mut worst = 0.0f64;
        for k in 3..trajectory.states.len() {
            let [before, former, now] = [2, 1, 0].map(|back| &trajectory.states[k - back]);
            let step = now.time - former.time;
            let stored = |i: usize| (1.5 * flow(now, i) - 2.0 * flow(former, i) + 0.5 * flow(before, i)) / step;
            let all: f64 = (first..=last).map(|i| dx * stored(i)).sum();
            assert!(
                now.pressure.iter().zip(&now.fraction).all(|(p, f)| *p >= 0.0 && *f >= 0.0 && p * (1.0 - f) == 0.0)
            );
            let carried = flux(now, first - 1) - flux(now, last);
            worst = worst.max((all - carried).abs() / flow(now, first - 1));
        }
        let steps: usize = trajectory.moments[1..].iter().map(|moment| moment.effort.newton_iterations).sum();
        let per_step = steps as f64 / (trajectory.moments.len() - 1) as f64;
        println!("supply {supply_film_m:?}: balance to {worst:.1e}, {per_step:.2} iterations per step");
        assert!(worst < 1e-9 && per_step < 6.0);
    }
}

#[test]
fn flooded_films_in_time_equal_complementarity() {
    let spec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
    for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian, Frame::ALL[2]] {
        let inputs = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 1.0 / 3.0 });
        let usual = Transient { frame, ..Transient::new(OperatingPoint::TABLE_4_2, inputs, 0.5, 2e-3) };
        let [held, conserving] = [complementary(), laws(None)].map(|lubricant| {
            let trajectory = solve(spec, &Transient { lubricant, ..usual.clone() }, &()).unwrap();
            assert!(trajectory.finished(), "{frame:?}: {:?}", trajectory.ended);
            trajectory
        });
        let mean = |t: &Trajectory| t.mean(Quantity::CentralFilm, (0.0, 0.5)).unwrap();
        let off = (mean(&conserving) / mean(&held) - 1.0).abs();
        println!("{frame:?}: {off:.1e}");
        assert!(off < 1e-4, "{frame:?}: {off}");
    }
}

#[test]
fn a_supply_that_is_none_is_refused() {
    let mut solver = ContactSolver::on(&GridSpec::DISSERTATION.build().unwrap());
    for film in [0.0, -1e-9, f64::NAN, f64::INFINITY] {
        let refused = solver.solve(&OperatingPoint::TABLE_2_1, laws(Some(film)), Start::Cold, &()).unwrap_err();
        assert!(matches!(refused, SolveError::Lubricant(_)) && refused.to_string().contains("supply"), "{refused}");
    }
}
