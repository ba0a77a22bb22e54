//! Complementarity: comparison with an independent program and with the penalty, and its own conditions.

use crate::contacts::{at, line_of, solved};
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::transient::{
    Frame, Inputs, Interpolation, Keep, Quantity, Signal, State, Trajectory, Transient, solve,
};
use ehl_explorer::solver::full::{ContactSolver, FullSolver, Problem, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw, Sliding};

const PLANE: GridSpec = GridSpec::Plane(PointGridSpec::uniform(0.04, 0.1, (-4.0, 2.0, -2.0)));

fn complementary(laws: Lubricant) -> Lubricant {
    Lubricant { cavitation: Cavitation::Complementarity, ..laws }
}

fn laws() -> Lubricant {
    complementary(Lubricant::default())
}

/// Returns the median of some counts.
fn median(mut counts: Vec<usize>) -> usize {
    counts.sort_unstable();
    counts[counts.len() / 2]
}

#[test]
fn full_solutions_agree_with_an_independent_program() {
    let file: serde_json::Value = serde_json::from_str(include_str!("../data/complementarity.json")).unwrap();
    let contacts = file["contacts"].as_array().unwrap();
    assert_eq!(contacts.len(), 6);
    let mut solver = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    for contact in contacts {
        let of = |name: &str| contact[name].as_f64().unwrap();
        let point = line_of(contact);
        let solution = solver.solve(&point, laws(), Start::Cold, &()).unwrap();
        assert!(solution.converged());
        let first = solution.rupture().unwrap();
        assert!((first - of("X_B")).abs() < 1e-9, "{}: front at {first}", contact["name"]);
        let front = solution.x.iter().position(|x| (x - first).abs() < 1e-9).unwrap();
        let largest = solution.multiplier.iter().copied().fold(0.0, f64::max);
        for (name, got, most) in [
            ("H_c", solution.scalars.h_c, 1e-12),
            ("P_c", solution.scalars.p_c, 1e-11),
            ("H0", solution.scalars.h_0, 1e-12),
            ("H_min", solution.scalars.h_min, 1e-12),
            ("lambda_max", largest, 1e-11),
            ("lambda_B", solution.multiplier[front], 1e-10),
        ] {
            let error = (got / of(name) - 1.0).abs();
            assert!(error < most, "{}: {name} {got}", contact["name"]);
        }
    }
}

/// P ≥ 0, λ ≥ 0, P λ = 0, and λ = ∂(ρ̄H)/∂X in the cavitated region. Its first node is excepted, since liquid flows in
/// from the neighbour under pressure.
#[test]
fn pressure_and_multiplier_are_complementary() {
    for (kind, spec, m, l) in [
        (ContactKind::Line, GridSpec::DISSERTATION, 40.0, 10.0),
        (ContactKind::Line, GridSpec::EXPLORER, 200.0, 10.0),
        (ContactKind::Point, PLANE, 50.0, 8.0),
    ] {
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let s = solved(&mut solver, &at(kind, m, l), laws());
        let pairs = s.pressure.iter().zip(&s.multiplier);
        assert!(pairs.clone().all(|(p, multiplier)| *p >= 0.0 && *multiplier >= 0.0 && p * multiplier == 0.0));
        assert!(pairs.filter(|(_, multiplier)| **multiplier > 0.0).count() > 20);
        if kind == ContactKind::Line {
            let held = |i: usize| s.multiplier[i] > 0.0;
            let behind = (3..s.x.len() - 1).filter(|&i| held(i) && held(i - 1));
            let mut count = 0;
            for i in behind {
                // Upwind quotient of the equations. At P = 0 the liquid has its ambient density.
                let [h_0, h_1] = [s.x[i - 1] - s.x[i - 2], s.x[i] - s.x[i - 1]];
                let r = h_1 / h_0;
                let weights = [r * r / (1.0 + r) / h_1, -(1.0 + r) / h_1, (1.0 + 2.0 * r) / (1.0 + r) / h_1];
                let flow = |i: usize| s.problem.fluid.at(s.pressure[i]).density * s.film[i];
                let growth: f64 = weights.iter().zip(i - 2..).map(|(weight, i)| weight * flow(i)).sum();
                assert!((s.multiplier[i] - growth).abs() < 1e-12 * growth.max(1.0) / h_1, "{i}: {growth}");
                count += 1;
            }
            assert!(count > 20);
        }
    }
}

#[test]
fn the_penalty_tends_to_complementarity_as_its_factor_grows() {
    let mut solver = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    for (m, l) in [(40.0, 10.0), (10.0, 5.0), (200.0, 10.0)] {
        let point = at(ContactKind::Line, m, l);
        let truth = solver.solve(&point, laws(), Start::Cold, &()).unwrap();
        let mut off = |penalty: f64| {
            solver.options.penalty = penalty;
            let solution = solver.solve(&point, Lubricant::default(), Start::From(&truth), &()).unwrap();
            assert!(solution.converged());
            (solution.scalars.h_c / truth.scalars.h_c - 1.0).abs()
        };
        let [soft, usual, hard] = [1e5, 1e6, 1e7].map(&mut off);
        println!("M {m}, L {l}: {soft:.1e} {usual:.1e} {hard:.1e}");
        assert!(usual < 1e-6);
        assert!((5.0..20.0).contains(&(soft / usual)) && (5.0..20.0).contains(&(usual / hard)));
    }
}

/// Cold solves over a range take at most three quarters of the penalty's steps, and as many on half the spacing.
#[test]
fn cold_solves_take_few_steps_whatever_the_spacing() {
    let loads = [2.0, 10.0, 50.0, 200.0, 500.0];
    let steps = |spec: GridSpec, kind: ContactKind, cavitation: Cavitation| {
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let all = loads.iter().flat_map(|&m| [1.0, 5.0, 10.0].map(|l| (m, l)));
        let lubricant = Lubricant { cavitation, ..Lubricant::default() };
        all.filter(|(m, _)| kind == ContactKind::Line || (*m > 10.0 && *m < 300.0))
            .map(|(m, l)| solved(&mut solver, &at(kind, m, l), lubricant).report.newton_iterations)
            .collect::<Vec<_>>()
    };
    let uniform = |dx| GridSpec::Uniform { dx, domain: (-4.0, 2.0) };
    let line = |dx, cavitation| steps(uniform(dx), ContactKind::Line, cavitation);
    let (own, half) = (line(0.005, Cavitation::Complementarity), line(0.0025, Cavitation::Complementarity));
    println!("line: {own:?}; on half the spacing: {half:?}");
    assert!(median(own.clone()) <= 11 && median(own.clone()).abs_diff(median(half)) <= 3);
    let penalty: usize = line(0.005, Cavitation::Penalty).iter().sum();
    assert!(4 * own.iter().sum::<usize>() < 3 * penalty);
    let point = steps(PLANE, ContactKind::Point, Cavitation::Complementarity);
    println!("point: {point:?}");
    assert!(median(point) <= 11);
}

#[test]
fn shear_thinning_complementarity_takes_fewer_steps() {
    let eyring = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..Lubricant::default() };
    let contacts = [(10.0, 5.0, 0.3), (100.0, 10.0, 0.5), (30.0, 12.0, 0.1), (60.0, 8.0, 0.3)];
    for (kind, spec) in [(ContactKind::Line, GridSpec::DISSERTATION), (ContactKind::Point, PLANE)] {
        let mut solver = ContactSolver::on(&spec.build().unwrap());
        let mut steps = [0; 2];
        for (m, l, slide_to_roll_ratio) in contacts {
            let sliding = Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: None };
            let point = OperatingPoint { sliding, ..at(kind, m, l) };
            let [held, penalised] = [complementary(eyring), eyring].map(|laws| {
                let problem = Problem::new(&point, laws).unwrap();
                let solution = solver.solve_problem(problem, Start::Cold, &()).unwrap();
                assert!(solution.converged());
                solution
            });
            assert!((held.scalars.h_c / penalised.scalars.h_c - 1.0).abs() < 1e-5);
            assert!(held.pressure.iter().all(|&p| p >= 0.0));
            steps[0] += held.report.newton_iterations;
            steps[1] += penalised.report.newton_iterations;
        }
        println!("{}: {steps:?}", kind.name());
        assert!(4 * steps[0] < 3 * steps[1]);
    }
}

/// The equations of a uniform grid conserve mass: outflow of the last cell, less inflow of the first one and storage
/// between them, equals what the multiplier removes.
#[test]
fn in_time_the_balance_closes_with_what_the_multiplier_takes() {
    let spec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
    let inputs = Inputs::load(Signal::Harmonic { amplitude: 0.5, period: 0.5 });
    let transient = Transient {
        lubricant: laws(),
        keep: Keep::Every(1),
        ..Transient::new(OperatingPoint::TABLE_4_2, inputs, 0.4, 2e-3)
    };
    let trajectory = solve(spec, &transient, &()).unwrap();
    assert!(trajectory.finished());
    let (x, fluid) = (&trajectory.x, &trajectory.problem.fluid);
    let dx = x[5] - x[4];
    let flow = |state: &State, i: usize| fluid.at(state.pressure[i]).density * state.film[i];
    let mobility = |state: &State, i: usize| {
        let liquid = fluid.at(state.pressure[i]);
        liquid.density * state.film[i].powi(3) / liquid.viscosity * trajectory.problem.inverse_lambda
    };
    // Through the face behind node i.
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
        let taken: f64 = now.multiplier.iter().sum::<f64>() * dx;
        assert!(now.pressure.iter().zip(&now.multiplier).all(|(p, l)| *p >= 0.0 && *l >= 0.0 && p * l == 0.0));
        worst = worst.max((all + flux(now, last) - flux(now, first - 1) - taken).abs() / flow(now, first));
    }
    println!("balance to {worst:.1e}");
    assert!(worst < 1e-9);
}

/// Means and amplitudes under small and large fast load changes agree with the penalty in all three frames.
#[test]
fn in_time_complementarity_goes_with_the_penalty_in_few_steps() {
    let spec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
    let remeshed = Frame::Remeshed(Interpolation::CubicSpline);
    for (amplitude, period) in [(0.1, 1.0 / 3.0), (0.5, 0.5)] {
        for frame in [Frame::Fixed, Frame::ArbitraryLagrangianEulerian, remeshed] {
            let inputs = Inputs::load(Signal::Harmonic { amplitude, period });
            let usual = Transient { frame, ..Transient::new(OperatingPoint::TABLE_4_2, inputs, 0.5, 2e-3) };
            let [held, penalised] = [laws(), Lubricant::default()].map(|lubricant| {
                let trajectory = solve(spec, &Transient { lubricant, ..usual.clone() }, &()).unwrap();
                assert!(trajectory.finished());
                trajectory
            });
            let all = (0.0, 0.5);
            for quantity in [Quantity::CentralFilm, Quantity::CentralPressure] {
                let of = |t: &Trajectory| (t.mean(quantity, all).unwrap(), t.amplitude(quantity, all).unwrap());
                let ((mean, swing), (mean_of, swing_of)) = (of(&held), of(&penalised));
                let off = ((mean / mean_of - 1.0).abs(), (swing / swing_of - 1.0).abs());
                assert!(off.0 < 1e-5 && off.1 < 1e-4, "{frame:?} {quantity:?}: {off:?}");
            }
            let steps: usize = held.moments[1..].iter().map(|moment| moment.effort.newton_iterations).sum();
            let per_step = steps as f64 / (held.moments.len() - 1) as f64;
            println!("{amplitude} {frame:?}: {per_step:.2} iterations per step");
            assert!(per_step <= 4.5, "{frame:?}: {per_step}");
        }
    }
}
