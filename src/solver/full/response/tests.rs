use super::*;
use crate::solver::discrete::grid::{GridSpec, PointGridSpec};
use crate::solver::discrete::space::{LineSpace, PlaneSpace};
use crate::solver::full::transient::{Conditions, Frame, FullMarch, Input, Inputs, Marching, Transient};
use crate::solver::full::{FullSolver, PointSolver, Problem, Solution, Start};
use crate::solver::physics::contact::{ContactKind, Moes, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::{Cavitation, Lubricant, ShearLaw};
use std::f64::consts::TAU;

const GRID: GridSpec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
const STEEL_LINE: OperatingPoint = OperatingPoint {
    radius_m: 3e-3,
    speed_m_per_s: 1.695,
    load: 242_400.0,
    modulus_pa: 231e9,
    viscosity_pa_s: 0.01,
    alpha_per_pa: 1.309e-8,
    ..OperatingPoint::TABLE_2_1
};

fn solved(point: &OperatingPoint, cavitation: Cavitation) -> Solution {
    let lubricant = Lubricant { cavitation, ..Lubricant::default() };
    FullSolver::new(GRID).unwrap().solve(point, lubricant, Start::Cold, &()).unwrap()
}

fn line() -> LinearResponse<LineSpace> {
    LinearResponse::new(&GRID.line().unwrap(), &solved(&STEEL_LINE, Cavitation::Penalty)).unwrap()
}

#[test]
fn differences_in_time_approach_the_exact_derivative() {
    let upwind = [50.0, -200.0, 150.0];
    let omega = 3.0;
    let exact = TimeDerivative::Exact.added_weights(upwind, omega)[2];
    let miss = |step: f64| (TimeDerivative::Bdf2 { step }.added_weights(upwind, omega)[2] - exact).norm();
    let order = (miss(0.01) / miss(0.005)).log2();
    assert!((1.95..2.05).contains(&order), "order {order}");
}

#[test]
fn waves_moving_with_the_fluid_are_exact_on_characteristics() {
    let (spacing, omega) = (0.01, 40.0);
    let upwind = [0.5, -2.0, 1.5].map(|weight| weight / spacing);
    let added = TimeDerivative::Characteristic { step: spacing }.added_weights(upwind, omega);
    let change = |k: usize| {
        let phase = omega * spacing * (2.0 - k as f64);
        (added[k] + upwind[k]) * realfft::num_complex::Complex64::cis(phase)
    };
    assert!((change(0) + change(1) + change(2)).norm() < 1e-9);
}

#[test]
fn the_stiffness_at_rest_is_the_slope_of_steady_loads() {
    for cavitation in [Cavitation::Penalty, Cavitation::Complementarity] {
        let at = |load: f64| solved(&OperatingPoint { load, ..STEEL_LINE }, cavitation);
        let steady = at(STEEL_LINE.load);
        let mut response = ContactResponse::of(&steady).unwrap();
        let computed = response.dynamics(0.0).unwrap().stiffness;
        // The constant of the logarithmic kernel belongs to the half-width of each load: the separation is that of
        // surfaces at the distance a. It is converted to the distance of the middle load.
        let separation = |load: f64| {
            let solution = at(load);
            let point = &solution.problem.point;
            let (a, reference) = (point.hertz().half_width_m, steady.problem.point.hertz().half_width_m);
            (solution.scalars.h_0 + 0.5 * (a / reference).ln()) * point.film_scale_m()
        };
        let step = 1e-4 * STEEL_LINE.load;
        let slope = -2.0 * step / (separation(STEEL_LINE.load + step) - separation(STEEL_LINE.load - step));
        // The grids of both loads are scaled with their half-widths, so that discretisation errors differ too.
        assert!((computed / slope - 1.0).abs() < 2e-3, "{cavitation:?}: {computed} against {slope}");
    }
}

#[test]
fn long_waves_are_flattened_and_short_ones_pass() {
    // Venner, Couhier, Lubrecht and Greenwood 1997, M = 100, L = 11, A_i/H_c = 0.1.
    let published = [(4.0, 0.030), (2.0, 0.073), (1.0, 0.183), (0.5, 0.394), (0.25, 0.660)];
    let point = si_from_moes(&MoesRequest::new(ContactKind::Line, 100.0, 11.0)).unwrap();
    let fine = GridSpec::Uniform { dx: 0.005, domain: (-4.0, 2.0) };
    let steady = FullSolver::new(fine).unwrap().solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
    let mut response = LinearResponse::<LineSpace>::new(&fine.line().unwrap(), &steady).unwrap();
    let mut former = 0.0;
    for (wavelength, wanted) in published {
        let ratio = response.wave(wavelength, 1.0, TimeDerivative::Exact).unwrap().ratio();
        assert!((ratio - wanted).abs() < 0.03 && ratio > former, "λ = {wavelength}: {ratio} against {wanted}");
        former = ratio;
    }
}

#[test]
fn waves_that_the_grid_does_not_resolve_are_refused() {
    let mut response = line();
    let short = response.wave(0.039, 1.0, TimeDerivative::Exact).unwrap_err();
    assert!(short.to_string().contains("from 0.04"), "{short}");
    assert!(response.wave(0.04, 1.0, TimeDerivative::Exact).is_ok());
    let other = response.wave(0.5, 1.0, TimeDerivative::Characteristic { step: 0.02 }).unwrap_err();
    assert!(matches!(other, ResponseError::NoCharacteristics { .. }));
}

#[test]
fn unsupported_contacts_are_refused_with_the_reason() {
    let eyring = Lubricant { shear: ShearLaw::Eyring { critical_stress: 5e6, npr: 0.0 }, ..Lubricant::default() };
    assert!(check_lubricant(&eyring).unwrap_err().to_string().contains("Newtonian"));
    let conserving = Cavitation::MassConserving { supply_film_m: None };
    let conserving = Lubricant { cavitation: conserving, ..Lubricant::default() };
    assert!(check_lubricant(&conserving).unwrap_err().to_string().contains("complementarity"));
    let mut unfinished = solved(&STEEL_LINE, Cavitation::Penalty);
    unfinished.report.termination = crate::solver::full::Termination::IterationLimit;
    assert_eq!(ContactResponse::of(&unfinished).err(), Some(ResponseError::NotConverged));
}

#[test]
fn the_ball_of_equal_radii_is_the_limit_of_ellipses() {
    let grid = PointGridSpec::QUICK;
    let circle = OperatingPoint {
        kind: ContactKind::Point,
        radius_m: 0.01,
        speed_m_per_s: 0.26,
        load: 4.8,
        viscosity_pa_s: 0.04,
        alpha_per_pa: 20e-9,
        ..STEEL_LINE
    };
    let stiffness = |radius_y_m: Option<f64>| {
        let point = OperatingPoint { radius_y_m, ..circle };
        let solution = PointSolver::new(grid).unwrap().solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        ContactResponse::of(&solution).unwrap().dynamics(100.0).unwrap()
    };
    let (own, near) = (stiffness(None), stiffness(Some(1.001 * circle.radius_m)));
    assert!((near.stiffness / own.stiffness - 1.0).abs() < 1e-3, "{own:?} {near:?}");
    assert!((near.damping / own.damping - 1.0).abs() < 5e-3, "{own:?} {near:?}");
}

#[test]
fn the_element_reproduces_its_own_values() {
    let element = Maxwell {
        static_stiffness: 1.5e7,
        series_stiffness: 9e5,
        relaxation_s: 3e-4,
        parallel_damping: 30.0,
        deviation: 0.0,
    };
    let frequencies = [0.0, 50.0, 200.0, 500.0, 1000.0, 3000.0];
    let found = Maxwell::fit(&frequencies.map(|hz| element.at(hz))).unwrap();
    for (got, wanted) in [
        (found.static_stiffness, element.static_stiffness),
        (found.series_stiffness, element.series_stiffness),
        (found.relaxation_s, element.relaxation_s),
        (found.parallel_damping, element.parallel_damping),
    ] {
        assert!((got / wanted - 1.0).abs() < 1e-3, "{found:?}");
    }
    // k* of the element is that of its parts.
    let omega_tau = TAU * 500.0 * element.relaxation_s;
    let pair = element.series_stiffness * omega_tau / (1.0 + omega_tau * omega_tau);
    let own = element.at(500.0);
    assert!((TAU * 500.0 * (own.damping - element.parallel_damping) / pair - 1.0).abs() < 1e-12);
    assert!(Maxwell::fit(&[0.0, 50.0, 50.0].map(|hz| element.at(hz))).is_none());
}

#[test]
fn the_parameters_of_the_published_curves_are_theirs() {
    let moes = Moes { m: 100.0, l: 11.0 };
    let line = reduction_parameter(ContactKind::Line, moes, 0.5);
    assert!((line - 0.5 * 31.622_776 / 3.316_624_8).abs() < 1e-6, "{line}");
    let point = reduction_parameter(ContactKind::Point, moes, 2.0);
    assert!((point - 2.0 * (100.0f64 / 11.0).sqrt()).abs() < 1e-12);
}

/// Returns a march at a steady circular contact, and the conditions with a load and a speed.
fn circle(input: Input) -> (FullMarch<PlaneSpace>, Conditions, Problem) {
    let point = si_from_moes(&MoesRequest::new(ContactKind::Point, 30.0, 6.0)).unwrap();
    let grid = PointGridSpec::uniform(0.1, 0.1, (-3.0, 1.8, -1.6)).build().unwrap();
    let lubricant = Lubricant { cavitation: Cavitation::Complementarity, ..Lubricant::default() };
    let transient = Transient { lubricant, ..Transient::new(point, Inputs::default(), 1.0, 0.01) };
    let (mut march, problem) = (FullMarch::on(grid, &transient).unwrap(), transient.problem().unwrap());
    let at = Frame::Fixed.conditions(&problem, 0.0, input).unwrap();
    march.rest(&at, &()).unwrap();
    (march, at, problem)
}

#[test]
fn slow_responses_to_load_and_speed_are_differences_of_steady_contacts() {
    let own = Input { load: 1.1, speed: 0.9, ..Input::REFERENCE };
    let (march, at, problem) = circle(own);
    let [to_load, to_speed] = march.response(&at).to_load_and_speed(1e-6, at.speed).unwrap();
    let step = 1e-4;
    let heavier = [own.load - step, own.load + step].map(|load| Input { load, ..own });
    let faster = [own.speed - step, own.speed + step].map(|speed| Input { speed, ..own });
    for (response, inputs, reference) in [(to_load, heavier, problem.load), (to_speed, faster, 1.0)] {
        let [(low, _, _), (high, _, _)] = inputs.map(circle);
        let slope = |a: f64, b: f64| (b - a) / (2.0 * step);
        let h_0 = slope(low.pressure().1, high.pressure().1);
        assert!((reference * response.h_0.re / h_0 - 1.0).abs() < 1e-3, "{} against {h_0}", response.h_0);
        // The front moves by whole nodes, so that single pressures differ.
        let (mut off, mut size) = (0.0, 0.0);
        for ((low, high), own) in low.pressure().0.iter().zip(high.pressure().0).zip(&response.pressure) {
            off += (slope(*low, *high) - reference * own.re).powi(2);
            size += slope(*low, *high).powi(2);
        }
        assert!(off < 1e-4 * size, "{off} of {size}");
    }
}

#[test]
fn the_adjoint_gives_the_products_of_responses() {
    // With (A + B K)ᵀ z + w ζ = v and (B 1)ᵀ z = l: v·p + l h₀ = ζ for the response (p, h₀) to a load of 1. The response
    // keeps P = 0 in the cavitated region, where the adjoint has a stiff penalty.
    let (march, at, _) = circle(Input::REFERENCE);
    let [to_load, _] = march.response(&at).to_load_and_speed(1e-7, at.speed).unwrap();
    let mut adjoint = march.adjoint(&at, 1e9).unwrap();
    let grid = PointGridSpec::uniform(0.1, 0.1, (-3.0, 1.8, -1.6)).build().unwrap();
    let v: Vec<f64> =
        (0..grid.unknowns()).map(|k| (k * 7919 % 1013) as f64 / 1013.0 * grid.weights[grid.node(k)]).collect();
    for l in [0.0, 0.7] {
        let (_, zeta) = adjoint.solve(&v, l).unwrap();
        let product: f64 = v.iter().enumerate().map(|(k, v)| v * to_load.pressure[grid.node(k)].re).sum();
        let wanted = product + l * to_load.h_0.re;
        assert!((zeta / wanted - 1.0).abs() < 1e-5, "{zeta} against {wanted}");
    }
}
