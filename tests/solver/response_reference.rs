//! Linear responses and moving features compared with independent solutions on the same grids, and with marches.

use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::full::response::{ContactResponse, TimeDerivative};
use ehl_explorer::solver::full::transient::{self, Inputs, MovingSurface, Scheme, Shape, Signal, Transient};
use ehl_explorer::solver::full::{FullSolver, PointSolver, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint};
use ehl_explorer::solver::physics::lubricant::{Cavitation, Lubricant};
use std::f64::consts::TAU;

const ROLLER: OperatingPoint = OperatingPoint {
    radius_m: 3e-3,
    speed_m_per_s: 1.695,
    load: 242_400.0,
    modulus_pa: 231e9,
    viscosity_pa_s: 0.01,
    alpha_per_pa: 1.309e-8,
    ..OperatingPoint::TABLE_2_1
};
const BALL: OperatingPoint = OperatingPoint {
    kind: ContactKind::Point,
    radius_m: 0.01,
    speed_m_per_s: 0.26,
    load: 4.8,
    viscosity_pa_s: 0.04,
    alpha_per_pa: 20e-9,
    ..ROLLER
};

const fn uniform(dx: f64) -> GridSpec {
    GridSpec::Uniform { dx, domain: (-4.0, 2.0) }
}

#[test]
fn amplitudes_of_waves_agree_with_an_independent_solution() {
    let table = include_str!("../data/amplitude.csv");
    let rows: Vec<Vec<f64>> =
        table.lines().skip(2).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    let mut compared = 0;
    for of_grid in rows.chunk_by(|a, b| a[0] == b[0]) {
        let step = of_grid[0][0];
        let mut solver = FullSolver::new(uniform(step)).unwrap();
        let steady = solver.solve(&ROLLER, Lubricant::default(), Start::Cold, &()).unwrap();
        let mut response = ContactResponse::of(&steady).unwrap();
        for row in of_grid {
            let schemes =
                [TimeDerivative::Exact, TimeDerivative::Bdf2 { step }, TimeDerivative::Characteristic { step }];
            for (scheme, wanted) in schemes.into_iter().zip(&row[3..]) {
                let ratio = response.wave(row[1], row[2], scheme).unwrap().ratio();
                assert!((ratio / wanted - 1.0).abs() < 2e-6, "{row:?}, {scheme:?}: {ratio}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 3 * 39);
}

#[test]
fn ball_stiffness_and_damping_agree_with_independent_values() {
    let lubricant = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let steady = PointSolver::new(PointGridSpec::QUICK).unwrap().solve(&BALL, lubricant, Start::Cold, &()).unwrap();
    let mut response = ContactResponse::of(&steady).unwrap();
    for (omega, stiffness, damping) in [
        (0.0, 1.442960623, None),
        (0.1, 1.44387816, Some(0.11478329)),
        (0.5, 1.463748323, Some(0.1003224312)),
        (TAU, 1.533086141, Some(0.0175049667)),
        (20.0, 1.664654991, Some(0.01114547683)),
    ] {
        let found = response.stiffness(omega).unwrap();
        assert!((found.stiffness / stiffness - 1.0).abs() < 1e-5, "{found:?}");
        assert!(damping.is_none_or(|damping| (found.damping / damping - 1.0).abs() < 1e-4), "{found:?}");
    }
}

/// Returns stiffness and damping at Ω by a march with a small oscillation of the separation.
fn marched(spec: GridSpec, point: OperatingPoint, omega: f64) -> (f64, f64) {
    const AMPLITUDE: f64 = 1e-3;
    // The damping is a small difference in phase, which a coarse time step would hide.
    const STEPS: f64 = 500.0;
    const LEAVES: f64 = 6.0;
    let period = TAU / omega;
    // The disturbance at the start leaves the contact before the last period.
    let periods = (LEAVES / period).ceil() + 1.0;
    let (duration, step) = (periods * period, period / STEPS);
    let lubricant = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let transient = Transient {
        lubricant,
        separation: Some(Signal::Harmonic { amplitude: AMPLITUDE, period }),
        scheme: Scheme::Bdf2,
        ..Transient::new(point, Inputs::default(), duration, step)
    };
    let trajectory = transient::solve(spec, &transient, &()).unwrap();
    assert!(trajectory.finished(), "{}", trajectory.ended.describe());
    // First harmonic of the load over the last period: H₀ = H₀₀ + ε sin ΩT gives −ε (K sin ΩT + ΩC cos ΩT).
    let last: Vec<_> = trajectory.moments.iter().rev().take(STEPS as usize).collect();
    let part = |wave: fn(f64) -> f64| {
        last.iter().map(|moment| moment.input.load * wave(omega * moment.time)).sum::<f64>() * 2.0 / STEPS / AMPLITUDE
    };
    (-part(f64::sin), -part(f64::cos) / omega)
}

#[test]
fn roller_stiffness_and_damping_equal_small_oscillations() {
    let spec = uniform(0.02);
    let lubricant = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let steady = FullSolver::new(spec).unwrap().solve(&ROLLER, lubricant, Start::Cold, &()).unwrap();
    let mut response = ContactResponse::of(&steady).unwrap();
    for omega in [0.5, 2.0, TAU] {
        let found = response.stiffness(omega).unwrap();
        let (stiffness, damping) = marched(spec, ROLLER, omega);
        println!("Ω = {omega}: {found:?}, marched {stiffness} {damping}");
        assert!((stiffness / found.stiffness - 1.0).abs() < 2e-3, "{found:?} {stiffness}");
        assert!((damping / found.damping - 1.0).abs() < 2e-2, "{found:?} {damping}");
    }
}

#[test]
fn passing_features_agree_with_an_independent_solution() {
    let packet = |height: f64, width: f64| Shape::Venner { height, width };
    let wave = Shape::Wave { height: 0.005, wavelength: 0.5, front: 0.5 };
    // Extremes of H_c and P_c over time.
    for (shape, speed, duration, scheme, h_c, p_c) in [
        (
            wave,
            1.0,
            4.5,
            Scheme::Bdf2,
            [0.022061130577631018, 0.027669536875340572],
            [0.9581337254766928, 1.0373458490488705],
        ),
        (
            packet(-0.05, 1.0),
            1.0,
            4.2,
            Scheme::Characteristic,
            [0.01671746090855906, 0.04523145713432885],
            [0.7726809548494306, 1.0805463776032607],
        ),
        (
            packet(0.02, 0.8),
            0.75,
            5.6,
            Scheme::Bdf2,
            [0.018885129403048366, 0.029089216709651103],
            [0.8766772253515994, 1.2033877464113627],
        ),
    ] {
        let surfaces = vec![MovingSurface { speed, at: -2.5, shape }];
        let transient = Transient { surfaces, scheme, ..Transient::new(ROLLER, Inputs::default(), duration, 0.01) };
        let trajectory = transient::solve(uniform(0.01), &transient, &()).unwrap();
        assert!(trajectory.finished() && trajectory.rejected_steps == 0);
        let extremes = |get: fn(&transient::Moment) -> f64| {
            trajectory.moments.iter().map(get).fold([f64::INFINITY, 0.0], |[a, b], v| [v.min(a), v.max(b)])
        };
        for (found, wanted) in [(extremes(|m| m.h_c), h_c), (extremes(|m| m.p_c), p_c)] {
            for (found, wanted) in found.into_iter().zip(wanted) {
                assert!((found / wanted - 1.0).abs() < 1e-5, "{transient:?}: {found} against {wanted}");
            }
        }
    }
}

#[test]
fn small_waves_in_time_have_the_linear_amplitude() {
    let (step, wavelength) = (0.02, 0.6);
    let steady =
        FullSolver::new(uniform(step)).unwrap().solve(&ROLLER, Lubricant::default(), Start::Cold, &()).unwrap();
    let mut response = ContactResponse::of(&steady).unwrap();
    let height = 0.01 * steady.scalars.h_c;
    for (scheme, derivative) in [
        (Scheme::Bdf2, TimeDerivative::Bdf2 { step }),
        (Scheme::Characteristic, TimeDerivative::Characteristic { step }),
    ] {
        let wanted = response.wave(wavelength, 1.0, derivative).unwrap().ratio();
        let shape = Shape::Wave { height, wavelength, front: 1.2 };
        let surfaces = vec![MovingSurface { speed: 1.0, at: -2.5, shape }];
        let transient = Transient { surfaces, scheme, ..Transient::new(ROLLER, Inputs::default(), 6.6, step) };
        let trajectory = transient::solve(uniform(step), &transient, &()).unwrap();
        let found = trajectory.amplitude(transient::Quantity::CentralFilm, (6.0, 6.6)).unwrap() / height;
        assert!((found / wanted - 1.0).abs() < 1e-2, "{scheme:?}: {found} against {wanted}");
    }
}

#[test]
fn a_ball_under_harmonic_load_agrees_with_independent_values() {
    let lubricant = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let load = Inputs::load(Signal::Harmonic { amplitude: 0.1, period: 1.0 });
    let transient = Transient { lubricant, ..Transient::new(BALL, load, 1.5, 0.01) };
    let spec = GridSpec::Plane(PointGridSpec::QUICK);
    let trajectory = transient::solve(spec, &transient, &()).unwrap();
    assert!(trajectory.finished() && trajectory.rejected_steps == 0);
    for (step, h_c, p_c, h_min) in [
        (100, 0.2378596101, 1.051214432, 0.1429407737),
        (110, 0.2383524467, 1.086805069, 0.1393468259),
        (125, 0.2303482948, 1.06606955, 0.134853727),
    ] {
        let moment = &trajectory.moments[step];
        for (found, wanted) in [(moment.h_c, h_c), (moment.p_c, p_c), (moment.h_min, h_min)] {
            assert!((found / wanted - 1.0).abs() < 1e-5, "T = {}: {found} against {wanted}", moment.time);
        }
    }
}

#[test]
fn a_round_bump_beside_the_axis_of_a_ball_keeps_its_distance() {
    let bump = MovingSurface { speed: 1.0, at: -2.0, shape: Shape::Gauss { height: 0.1, width: 0.5 } };
    assert!((bump.height(-1.0, 0.3, 1.0) - 0.1 * (-0.36f64).exp()).abs() < 1e-15);
    let ridge = MovingSurface { shape: Shape::Venner { height: 0.1, width: 0.5 }, ..bump };
    assert_eq!(ridge.height(-1.0, 0.3, 1.0), 0.1);
}
