//! Shear-thinning point contacts: against independent solutions on the same grid, and their symmetries.

use ehl_explorer::scene::named_lubricant::by_name;
use ehl_explorer::solver::discrete::grid::PointGridSpec;
use ehl_explorer::solver::full::{PointSolver, Problem, Solution, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, reduced_modulus};
use ehl_explorer::solver::physics::lubricant::{LimitingStress, Lubricant, Sliding};
use serde_json::Value;

const COARSE: PointGridSpec = PointGridSpec::uniform(0.04, 0.1, (-4.0, 2.0, -2.0));

/// The bodies of Tables 3.5 and 3.8 with one of their lubricants.
fn problem(name: &str, load: f64, speed_m_per_s: f64, srr: f64, npr: f64) -> Problem {
    let lubricant = by_name(name).unwrap();
    let point = OperatingPoint {
        kind: ContactKind::Point,
        radius_m: 0.0127,
        speed_m_per_s,
        load,
        modulus_pa: reduced_modulus(81e9, 0.208, 210e9, 0.3).unwrap(),
        viscosity_pa_s: lubricant.viscosity_pa_s.unwrap(),
        alpha_per_pa: 1e-8,
        sliding: Sliding::NONE,
    };
    let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: Some(npr) };
    Problem::under_sliding(&point, lubricant.laws, sliding).unwrap()
}

fn squalane(speed_m_per_s: f64, srr: f64, npr: f64) -> Problem {
    problem("squalane-pip", 23.0, speed_m_per_s, srr, npr)
}

fn solve(solver: &mut PointSolver, problem: Problem) -> Solution {
    let solution = solver.solve_problem(problem, Start::Cold, &()).unwrap();
    assert!(solution.converged(), "{:?}: {:?}", problem.point.sliding, solution.report);
    solution
}

#[test]
fn full_solutions_agree_with_independent_ones() {
    let reference: Value = serde_json::from_str(include_str!("../data/point_shear_thinning.json")).unwrap();
    let mut solver = PointSolver::new(PointGridSpec::DISSERTATION).unwrap();
    let (mut worst, mut times) = ([0.0f64; 3], Vec::new());
    for sweep in ["speed_sweep", "srr_sweep", "npr_sweep", "pao650"] {
        for wanted in reference[sweep].as_array().unwrap() {
            let number = |name: &str| wanted[name].as_f64().unwrap();
            let [speed, srr, npr] = ["speed_m_per_s", "slide_to_roll_ratio", "newtonian_plateau_ratio"].map(number);
            let (name, load) = if sweep == "pao650" { ("pao-650", 32.0) } else { ("squalane-pip", 23.0) };
            let clock = std::time::Instant::now();
            let solution = solve(&mut solver, problem(name, load, speed, srr, npr));
            times.push(clock.elapsed().as_secs_f64());
            let s = &solution.scalars;
            assert!((solution.problem.moes.m / number("M") - 1.0).abs() < 1e-9);
            let traction = number("traction");
            let errors = [
                (s.h_c / number("H_c") - 1.0).abs(),
                (s.h_min / number("H_min") - 1.0).abs(),
                (solution.traction_coefficient() - traction).abs() / traction.max(0.005),
            ];
            for ((error, worst), bar) in errors.into_iter().zip(&mut worst).zip([2e-4, 3e-4, 3e-4]) {
                assert!(error < bar, "{sweep}: speed {speed}, SRR {srr}, NPR {npr}: {errors:?}");
                *worst = worst.max(error);
            }
        }
    }
    assert_eq!(times.len(), 13);
    times.sort_by(f64::total_cmp);
    println!("greatest differences of H_c, H_min and traction: {:.1e} {:.1e} {:.1e}", worst[0], worst[1], worst[2]);
    println!("median time {:.0} ms", 1e3 * times[6]);
}

#[test]
fn a_plateau_of_one_does_not_feel_sliding() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let rolling = solve(&mut solver, squalane(0.74, 0.0, 1.0));
    assert_eq!(rolling.traction_coefficient(), 0.0);
    for srr in [0.5, -2.0] {
        let sliding = solve(&mut solver, squalane(0.74, srr, 1.0));
        assert!((sliding.scalars.h_c / rolling.scalars.h_c - 1.0).abs() < 1e-10);
        assert!((sliding.traction_coefficient() / (sliding.traction().per_srr * srr) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn film_is_even_and_traction_odd_in_the_slide_to_roll_ratio() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let [one, other] = [0.6, -0.6].map(|srr| solve(&mut solver, squalane(0.74, srr, 0.2)));
    assert!((one.scalars.h_c / other.scalars.h_c - 1.0).abs() < 1e-8);
    assert!((one.traction_coefficient() / other.traction_coefficient() + 1.0).abs() < 1e-7);
    assert!(one.traction_coefficient() > 0.0);
}

#[test]
fn sliding_and_plateaus_beyond_table_3_6_converge_and_a_neighbour_is_a_good_start() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    for speed in [0.1, 1.0, 5.0] {
        for srr in [-2.0, 0.01, 2.0] {
            for npr in [0.0, 0.99] {
                solve(&mut solver, squalane(speed, srr, npr));
            }
        }
    }
    let near = solve(&mut solver, squalane(0.74, 0.5, 0.2227));
    let warm = solver.solve_problem(squalane(0.74, 0.55, 0.25), Start::From(&near), &()).unwrap();
    assert!(warm.converged() && warm.report.newton_iterations < near.report.newton_iterations, "{:?}", warm.report);
}

#[test]
fn frozen_film_integrals_lead_to_the_same_solution() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let exact = solve(&mut solver, squalane(0.74, 0.5, 0.2227));
    solver.options.film.frozen = true;
    let frozen = solve(&mut solver, squalane(0.74, 0.5, 0.2227));
    println!("exact {} steps, frozen {}", exact.report.newton_iterations, frozen.report.newton_iterations);
    assert!((frozen.scalars.h_c / exact.scalars.h_c - 1.0).abs() < 1e-6);
}

#[test]
fn a_limiting_stress_bounds_the_traction() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let free = squalane(0.74, 1.0, 0.2227);
    let slope = 0.03;
    let laws = Lubricant { limiting_stress: Some(LimitingStress { ambient: 1e5, slope }), ..free.lubricant };
    let limited = Problem::under_sliding(&free.point, laws, free.point.sliding).unwrap();
    let [free, limited] = [free, limited].map(|problem| solve(&mut solver, problem));
    assert_eq!(free.scalars.h_c, limited.scalars.h_c);
    let traction = limited.traction_coefficient();
    assert!(traction < free.traction_coefficient() && traction < 1.2 * slope, "{traction}");
}
