//! Shear-thinning line contacts: against independent solutions on the same grid, over the whole range of Table 3.6, and their symmetries.

use ehl_explorer::scene::named_lubricant::by_name;
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::discrete::reynolds::film_integrals::{FilmRule, PRODUCTION_RULE};
use ehl_explorer::solver::full::{FullSolver, Problem, Solution, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, reduced_modulus};
use ehl_explorer::solver::physics::lubricant::{LimitingStress, Lubricant, Sliding};
use serde_json::Value;

const GRID: GridSpec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };

fn lubricant(name: &str) -> Lubricant {
    by_name(name).unwrap().laws
}

/// Table 3.5's bodies and lubricant as a line contact.
fn problem(speed_m_per_s: f64, srr: f64, npr: f64) -> Problem {
    let point = OperatingPoint {
        kind: ContactKind::Line,
        radius_m: 0.0127,
        speed_m_per_s,
        load: 144_000.0,
        modulus_pa: reduced_modulus(81e9, 0.208, 210e9, 0.3).unwrap(),
        viscosity_pa_s: 0.0705,
        alpha_per_pa: 1e-8,
        sliding: Sliding::NONE,
    };
    let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: Some(npr) };
    Problem::under_sliding(&point, lubricant("squalane-pip"), sliding).unwrap()
}

fn solve(solver: &mut FullSolver, problem: Problem) -> Solution {
    let solution = solver.solve_problem(problem, Start::Cold, &()).unwrap();
    assert!(solution.converged(), "{:?}: {:?}", problem.point.sliding, solution.report);
    solution
}

#[test]
fn full_solutions_agree_with_independent_ones() {
    let reference: Value = serde_json::from_str(include_str!("../data/line_shear_thinning.json")).unwrap();
    let mut solver = FullSolver::new(GRID).unwrap();
    let mut worst = [0.0f64; 3];
    let points = reference["points"].as_array().unwrap();
    assert_eq!(points.len(), 15);
    for wanted in points {
        let number = |name: &str| wanted[name].as_f64().unwrap();
        let (srr, npr) = (number("slide_to_roll_ratio"), number("newtonian_plateau_ratio"));
        let solution = solve(&mut solver, problem(number("speed_m_per_s"), srr, npr));
        let s = &solution.scalars;
        assert!((solution.problem.moes.m / number("M") - 1.0).abs() < 1e-9);
        let traction = number("traction");
        let errors = [
            (s.h_c / number("H_c") - 1.0).abs(),
            (s.h_min / number("H_min") - 1.0).abs(),
            (solution.traction_coefficient() - traction).abs() / traction.max(0.005),
        ];
        for ((error, worst), bar) in errors.into_iter().zip(&mut worst).zip([1e-4; 3]) {
            assert!(error < bar, "SRR {srr}, NPR {npr}: {errors:?}");
            *worst = worst.max(error);
        }
    }
    println!("greatest differences of H_c, H_min and traction: {:.1e} {:.1e} {:.1e}", worst[0], worst[1], worst[2]);
}

#[test]
fn every_point_of_table_3_6_converges_cold() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let (mut newton, mut times) = (0, Vec::new());
    for i in 0..10 {
        for j in 0..5 {
            for k in 0..3 {
                let speed = 0.1 * 50f64.powf(f64::from(i) / 9.0);
                let (srr, npr) = (0.5 * f64::from(k), 0.2 + 0.2 * f64::from(j));
                let clock = std::time::Instant::now();
                let solution = solve(&mut solver, problem(speed, srr, npr));
                times.push(clock.elapsed().as_secs_f64());
                newton += solution.report.newton_iterations;
                assert!(solution.report.attempts == 1, "{speed} {srr} {npr}: {} starts", solution.report.attempts);
            }
        }
    }
    times.sort_by(f64::total_cmp);
    println!("150 points: {:.1} Newton steps, median {:.1} ms", newton as f64 / 150.0, 1e3 * times[75]);
}

#[test]
fn a_plateau_of_one_does_not_feel_sliding() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let rolling = solve(&mut solver, problem(0.74, 0.0, 1.0));
    assert_eq!(rolling.traction_coefficient(), 0.0);
    for srr in [0.5, -2.0] {
        let sliding = solve(&mut solver, problem(0.74, srr, 1.0));
        assert!((sliding.scalars.h_c / rolling.scalars.h_c - 1.0).abs() < 1e-10);
        assert!((sliding.traction_coefficient() / (sliding.traction().per_srr * srr) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn film_is_even_and_traction_odd_in_the_slide_to_roll_ratio() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let (one, other) = (solve(&mut solver, problem(0.74, 0.6, 0.2)), solve(&mut solver, problem(0.74, -0.6, 0.2)));
    assert!((one.scalars.h_c / other.scalars.h_c - 1.0).abs() < 1e-9);
    assert!((one.traction_coefficient() / other.traction_coefficient() + 1.0).abs() < 1e-8);
    assert!(one.traction_coefficient() > 0.0);
}

#[test]
fn sliding_and_plateaus_beyond_table_3_6_converge_and_a_neighbour_is_a_good_start() {
    let mut solver = FullSolver::new(GRID).unwrap();
    for speed in [0.1, 1.0, 5.0] {
        for srr in [-2.0, 0.01, 2.0] {
            for npr in [0.0, 0.05, 0.99] {
                solve(&mut solver, problem(speed, srr, npr));
            }
        }
    }
    let near = solve(&mut solver, problem(0.74, 0.5, 0.2227));
    let warm = solver.solve_problem(problem(0.74, 0.55, 0.25), Start::From(&near), &()).unwrap();
    assert!(warm.converged() && warm.report.attempts == 1 && warm.report.newton_iterations <= 10);
}

/// `panels` equal ones, a multiple of two, with six Gauss points each: two production rules on half the film, and so on.
fn finer_rule(panels: usize) -> &'static FilmRule {
    let width = 2.0 / panels as f64;
    let part = |k: usize| PRODUCTION_RULE.map(|(at, weight)| (-0.5 + (k as f64 + at + 0.5) * width, weight * width));
    Vec::leak((0..panels / 2).flat_map(part).collect())
}

#[test]
fn the_rule_across_the_film_costs_less_than_its_bar() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let fine = finer_rule(32);
    let mut worst: f64 = 0.0;
    for speed in [0.1, 0.74, 5.0] {
        for (srr, npr) in [(0.0, 0.2227), (0.01, 0.2), (0.1, 0.0), (0.5, 0.2227), (1.0, 0.2)] {
            solver.options.film.rule = &PRODUCTION_RULE;
            let film = solve(&mut solver, problem(speed, srr, npr)).scalars.h_c;
            solver.options.film.rule = fine;
            worst = worst.max((film / solve(&mut solver, problem(speed, srr, npr)).scalars.h_c - 1.0).abs());
        }
    }
    println!("greatest error of H_c by the rule across the film: {worst:.1e}");
    assert!(worst < 2e-5, "{worst:e}");
}

#[test]
fn frozen_film_integrals_lead_to_the_same_solution() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let exact = solve(&mut solver, problem(0.74, 0.5, 0.2227));
    solver.options.film.frozen = true;
    let frozen = solve(&mut solver, problem(0.74, 0.5, 0.2227));
    println!("exact {} steps, frozen {}", exact.report.newton_iterations, frozen.report.newton_iterations);
    assert!((frozen.scalars.h_c / exact.scalars.h_c - 1.0).abs() < 1e-7);
}

#[test]
fn shear_rates_add_up_to_the_sliding_speed() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let solution = solve(&mut solver, problem(0.74, 0.5, 0.2227));
    let film_scale = solution.problem.point.film_scale_m();
    let heights: Vec<Vec<_>> = (0..=40).map(|k| solution.shear_along_axis(f64::from(k) / 40.0)).collect();
    for (i, (x, _, film)) in solution.profile().enumerate() {
        // The trapezoidal rule across the film.
        let weight = |k: usize| if k == 0 || k == 40 { 0.0125 } else { 0.025 };
        let slid: f64 = heights.iter().enumerate().map(|(k, shear)| weight(k) * shear[i].rate_per_s).sum();
        let slid = slid * film * film_scale;
        // Half of the entrainment speed.
        assert!((slid / 0.37 - 1.0).abs() < 2e-3, "X {x}: {slid}");
    }
}

#[test]
fn a_limiting_stress_bounds_the_traction_and_ends_the_warning() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let mut heavy = problem(0.74, 1.0, 0.2227);
    let free = solve(&mut solver, heavy);
    assert!(free.traction_warning().is_none(), "α* p_H is below 12 in Table 3.5");
    heavy.point.load *= 4.0;
    let limited = |limit| {
        let laws = Lubricant { limiting_stress: limit, ..heavy.lubricant };
        Problem::under_sliding(&heavy.point, laws, heavy.point.sliding).unwrap()
    };
    let unlimited = solve(&mut solver, limited(None));
    assert!(unlimited.traction_warning().is_some_and(|sentence| sentence.contains("unphysical")));
    let slope = 0.04;
    let bounded = solve(&mut solver, limited(Some(LimitingStress { ambient: 1e6, slope })));
    assert!(bounded.traction_warning().is_none() && bounded.scalars.h_c == unlimited.scalars.h_c);
    let traction = bounded.traction_coefficient();
    assert!(traction < unlimited.traction_coefficient() && traction < 1.3 * slope, "{traction}");
}

#[test]
fn what_leaves_the_laws_is_refused_with_a_sentence() {
    let base = problem(0.74, 0.0, 0.2227);
    let sentence = |load: f64, npr: f64| {
        let point = OperatingPoint { load, ..base.point };
        let sliding = Sliding { slide_to_roll_ratio: 0.0, newtonian_plateau_ratio: Some(npr) };
        Problem::under_sliding(&point, base.lubricant, sliding).unwrap_err().to_string()
    };
    assert!(sentence(144_000.0 * 200.0, 0.2).contains("occupied volume"));
    for npr in [-0.1, 1.1, f64::NAN] {
        assert!(sentence(144_000.0, npr).contains("plateau ratio"));
    }
}
