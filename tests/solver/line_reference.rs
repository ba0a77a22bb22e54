//! The full solver compared with independent solutions on the same grid, and with published analytic results.

use crate::common::scene_files;
use ehl_explorer::solver::discrete::grid::GridSpec;
use ehl_explorer::solver::full::{FullSolver, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, Sliding};
use ehl_explorer::solver::physics::lubricant::Lubricant;

/// Contact and its reference solution.
struct Reference {
    name: String,
    point: OperatingPoint,
    h_c: f64,
    h_min: f64,
    h_0: f64,
    p_c: f64,
}

fn references() -> Vec<Reference> {
    let lines = include_str!("../data/line_stationary.csv").lines().skip(2);
    lines
        .map(|line| {
            let (name, numbers) = line.split_once(',').unwrap();
            let n: Vec<f64> = numbers.split(',').map(|v| v.parse().unwrap()).collect();
            let point = OperatingPoint {
                kind: ContactKind::Line,
                radius_m: n[0],
                speed_m_per_s: n[1],
                load: n[2],
                modulus_pa: n[3],
                viscosity_pa_s: n[4],
                alpha_per_pa: n[5],
                sliding: Sliding::NONE,
                radius_y_m: None,
            };
            Reference { name: name.to_owned(), point, h_c: n[6], h_min: n[7], h_0: n[8], p_c: n[9] }
        })
        .collect()
}

#[test]
fn full_solutions_agree_with_independent_ones_to_1e_10() {
    let mut solver = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    let references = references();
    assert_eq!(references.len(), 14);
    let (mut worst, mut worst_load) = (0.0f64, 0.0f64);
    for reference in references {
        let solution = solver.solve(&reference.point, Lubricant::default(), Start::Cold, &()).unwrap();
        assert!(solution.converged(), "{}", reference.name);
        let s = &solution.scalars;
        let pairs = [
            ("H_c", s.h_c, reference.h_c),
            ("H_min", s.h_min, reference.h_min),
            ("H_0", s.h_0, reference.h_0),
            ("P_c", s.p_c, reference.p_c),
        ];
        for (quantity, got, wanted) in pairs {
            assert!((got / wanted - 1.0).abs() < 1e-10, "{}: {quantity} {got} against {wanted}", reference.name);
            worst = worst.max((got / wanted - 1.0).abs());
        }
        assert!(s.load_residual < 1e-14, "{}: load {}", reference.name, s.load_residual);
        worst_load = worst_load.max(s.load_residual);
    }
    println!("greatest relative difference {worst:.1e}, load integral {worst_load:.1e}");
}

#[test]
fn warm_starts_give_the_same_solution() {
    let references = references();
    let mut uniform = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    let mut graded = FullSolver::new(GridSpec::EXPLORER).unwrap();
    let start = graded.solve(&references[1].point, Lubricant::default(), Start::Cold, &()).unwrap();
    let solution = uniform.solve(&references[0].point, Lubricant::default(), Start::From(&start), &()).unwrap();
    assert!(solution.converged());
    assert!((solution.scalars.h_c / references[0].h_c - 1.0).abs() < 1e-10);
}

#[test]
fn a_heavy_load_tends_to_hertz() {
    let deviation = |m: f64| {
        let point = ehl_explorer::scene::At::moes(m, 2.0).point(ContactKind::Line).unwrap();
        let mut solver = FullSolver::new(GridSpec::EXPLORER).unwrap();
        let solution = solver.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        assert!(solution.converged());
        let inside = solution.profile().filter(|(x, ..)| x.abs() < 0.8);
        inside.map(|(x, p, _)| (p - (1.0 - x * x).sqrt()).abs()).fold(0.0, f64::max)
    };
    let (light, heavy) = (deviation(40.0), deviation(400.0));
    assert!(heavy < 0.2 * light && heavy < 2e-3, "{light} {heavy}");
}

#[test]
fn scenes_of_the_tables_hold_the_same_numbers() {
    let references = references();
    for (scene, name) in [
        ("table_2_1", "T2.1"),
        ("table_4_2", "T4.2"),
        ("table_4_3", "T4.3"),
        ("table_4_5_case_1", "T4.5c1"),
        ("table_4_5_case_2", "T4.5c2"),
        ("table_4_8_set_1", "T4.8s1"),
        ("table_4_8_set_2", "T4.8s2"),
        ("table_4_8_set_3", "T4.8s3"),
    ] {
        let scene = scene_files::read(scene);
        let reference = references.iter().find(|reference| reference.name == name).unwrap();
        assert_eq!(scene.point().unwrap(), reference.point, "{name}");
        let expected = scene.expect.iter().find(|e| e.name == "H_c").unwrap();
        assert_eq!(expected.value, Some(reference.h_c), "{name}");
    }
}

#[test]
fn a_step_that_damping_made_small_is_no_convergence() {
    // Films that these grids do not resolve must not be reported as converged with a residual above 1.
    let mut uniform = FullSolver::new(GridSpec::DISSERTATION).unwrap();
    for (m, l) in [(5132.0, 2.5), (5751.0, 0.0222), (61.27, 0.4045), (11436.8, 0.0146), (42000.0, 0.6)] {
        let point = ehl_explorer::scene::At::moes(m, l).point(ContactKind::Line).unwrap();
        let solution = uniform.solve(&point, Lubricant::default(), Start::Cold, &()).unwrap();
        let sound = solution.scalars.h_min > 0.0 && solution.report.residual_norm < 1e-6;
        assert!(!solution.converged() || sound, "M {m}, L {l}: residual {}", solution.report.residual_norm);
    }
}
