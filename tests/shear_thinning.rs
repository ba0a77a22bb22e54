//! Shear-thinning line contacts: against independent solutions on the same grid, over the whole range of Table 3.6, and their symmetries.

use ehl_explorer::scene::named_lubricant::by_name;
use ehl_explorer::solver::contact::{ContactKind, OperatingPoint, reduced_modulus};
use ehl_explorer::solver::full::{FullSolver, Problem, Solution, Start};
use ehl_explorer::solver::grid::GridSpec;
use ehl_explorer::solver::lubricant::{Lubricant, Sliding};
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
    };
    let sliding = Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: Some(npr) };
    Problem::under_sliding(&point, lubricant("squalane-pip"), sliding).unwrap()
}

fn solve(solver: &mut FullSolver, problem: Problem) -> Solution {
    let solution = solver.solve_problem(problem, Start::Cold, &mut ());
    assert!(solution.converged(), "{:?}: {:?}", problem.sliding, solution.report);
    solution
}

#[test]
fn full_solutions_agree_with_independent_ones() {
    let reference: Value = serde_json::from_str(include_str!("data/line_shear_thinning.json")).unwrap();
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
        // Their L is a label by the slope at ambient pressure.
        assert!((solution.problem.moes.l / number("L") - 1.0).abs() < 5e-2);
        let traction = number("traction");
        let errors = [
            (s.h_c / number("H_c") - 1.0).abs(),
            (s.h_min / number("H_min") - 1.0).abs(),
            (solution.traction_coefficient() - traction).abs() / traction.max(0.005),
        ];
        for ((error, worst), bar) in errors.into_iter().zip(&mut worst).zip([3e-3, 1e-2, 1e-2]) {
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
