//! Shear-thinning contacts of both kinds: comparison with independent solutions on the same grids, over the whole range
//! of Table 3.6, and their symmetries.

use ehl_explorer::scene::named_lubricant::by_name;
use ehl_explorer::solver::discrete::grid::{GridSpec, PointGridSpec};
use ehl_explorer::solver::discrete::reynolds::film_integrals::{FilmRule, PRODUCTION_RULE};
use ehl_explorer::solver::full::{ContactSolver, FullSolver, Problem, Solution, Start};
use ehl_explorer::solver::physics::contact::{ContactKind, OperatingPoint, reduced_modulus};
use ehl_explorer::solver::physics::lubricant::{LimitingStress, Lubricant, Sliding};
use serde_json::Value;

const GRID: GridSpec = GridSpec::Uniform { dx: 0.01, domain: (-4.0, 2.0) };
const LINE: GridSpec = GRID;
const POINT: GridSpec = GridSpec::Plane(PointGridSpec::uniform(0.04, 0.1, (-4.0, 2.0, -2.0)));

/// Bodies of Tables 3.5 and 3.8 with one of their lubricants.
fn contact(kind: ContactKind, fluid: &str, load: f64, speed_m_per_s: f64, srr: f64, npr: f64) -> Problem {
    let lubricant = by_name(fluid).unwrap();
    let point = OperatingPoint {
        kind,
        radius_m: 0.0127,
        speed_m_per_s,
        load,
        modulus_pa: reduced_modulus(81e9, 0.208, 210e9, 0.3).unwrap(),
        viscosity_pa_s: lubricant.viscosity_pa_s.unwrap(),
        alpha_per_pa: 1e-8,
        sliding: Sliding { slide_to_roll_ratio: srr, newtonian_plateau_ratio: Some(npr) },
        radius_y_m: None,
    };
    Problem::new(&point, lubricant.laws).unwrap()
}

/// Table 3.5's contact, or its bodies and lubricant as a line contact.
fn squalane(kind: ContactKind, speed: f64, srr: f64, npr: f64) -> Problem {
    let load = if kind == ContactKind::Line { 144_000.0 } else { 23.0 };
    contact(kind, "squalane-pip", load, speed, srr, npr)
}

fn problem(speed: f64, srr: f64, npr: f64) -> Problem {
    squalane(ContactKind::Line, speed, srr, npr)
}

/// Solvers of both kinds.
struct Solvers(Vec<(ContactKind, ContactSolver)>);

impl Solvers {
    fn new() -> Self {
        Self([LINE, POINT].map(|spec| (spec.kind(), ContactSolver::on(&spec.build().unwrap()))).into())
    }
}

fn solve(solver: &mut ContactSolver, problem: Problem) -> Solution {
    solve_from(solver, problem, Start::Cold)
}

fn solve_from(solver: &mut ContactSolver, problem: Problem, start: Start<'_>) -> Solution {
    let solution = solver.solve(&problem.point, problem.lubricant, start, &()).unwrap();
    assert!(solution.converged(), "{:?}: {:?}", problem.point.sliding, solution.report);
    solution
}

/// Asserts that H_c, H_min and traction (relative to the larger of it and 0.005) agree with a reference, and prints the
/// differences.
fn differences(solver: &mut ContactSolver, wanted: &Value, fluid: &str, load: f64, bounds: [f64; 3]) -> [f64; 3] {
    let number = |name: &str| wanted[name].as_f64().unwrap();
    let [speed, srr, npr] = ["speed_m_per_s", "slide_to_roll_ratio", "newtonian_plateau_ratio"].map(number);
    let solution = solve(solver, contact(solver.grid_spec().kind(), fluid, load, speed, srr, npr));
    assert!((solution.problem.moes.m / number("M") - 1.0).abs() < 1e-9);
    let (s, traction) = (&solution.scalars, number("traction"));
    let errors = [
        (s.h_c / number("H_c") - 1.0).abs(),
        (s.h_min / number("H_min") - 1.0).abs(),
        (solution.traction_coefficient() - traction).abs() / traction.max(0.005),
    ];
    assert!(
        errors.iter().zip(bounds).all(|(error, bound)| *error < bound),
        "{fluid}, {speed}, {srr}, {npr}: {errors:?}"
    );
    errors
}

fn greatest(differences: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|k| differences.iter().map(|all| all[k]).fold(0.0, f64::max))
}

#[test]
fn full_solutions_of_line_contacts_agree_with_independent_ones() {
    let reference: Value = serde_json::from_str(include_str!("../data/line_shear_thinning.json")).unwrap();
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let points = reference["points"].as_array().unwrap();
    assert_eq!(points.len(), 15);
    let all: Vec<_> =
        points.iter().map(|wanted| differences(&mut solver, wanted, "squalane-pip", 144_000.0, [1e-4; 3])).collect();
    println!("greatest differences of H_c, H_min and traction: {:?}", greatest(&all));
}

#[test]
fn full_solutions_of_point_contacts_agree_with_independent_ones() {
    let reference: Value = serde_json::from_str(include_str!("../data/point_shear_thinning.json")).unwrap();
    let grid = GridSpec::Plane(PointGridSpec::DISSERTATION).build().unwrap();
    let mut solver = ContactSolver::on(&grid);
    let mut all = Vec::new();
    for sweep in ["speed_sweep", "srr_sweep", "npr_sweep", "pao650"] {
        let (fluid, load) = if sweep == "pao650" { ("pao-650", 32.0) } else { ("squalane-pip", 23.0) };
        for wanted in reference[sweep].as_array().unwrap() {
            all.push(differences(&mut solver, wanted, fluid, load, [2e-4, 3e-4, 3e-4]));
        }
    }
    assert_eq!(all.len(), 13);
    println!("greatest differences of H_c, H_min and traction: {:?}", greatest(&all));
}

#[test]
fn every_point_of_table_3_6_converges_cold() {
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let mut newton = 0;
    for k in 0..150 {
        let [i, j, k] = [k / 15, k / 3 % 5, k % 3].map(f64::from);
        let (speed, srr, npr) = (0.1 * 50f64.powf(i / 9.0), 0.5 * k, 0.2 + 0.2 * j);
        let solution = solve(&mut solver, problem(speed, srr, npr));
        newton += solution.report.newton_iterations;
        assert!(solution.report.attempts == 1, "{speed} {srr} {npr}: {} starts", solution.report.attempts);
    }
    // 13 steps in the mean.
    assert!(newton < 150 * 15, "{newton} Newton steps for 150 points");
}

#[test]
fn a_plateau_of_one_does_not_feel_sliding() {
    for (kind, mut solver) in Solvers::new().0 {
        let rolling = solve(&mut solver, squalane(kind, 0.74, 0.0, 1.0));
        assert_eq!(rolling.traction_coefficient(), 0.0);
        for srr in [0.5, -2.0] {
            let sliding = solve(&mut solver, squalane(kind, 0.74, srr, 1.0));
            assert!((sliding.scalars.h_c / rolling.scalars.h_c - 1.0).abs() < 1e-10);
            assert!((sliding.traction_coefficient() / (sliding.traction().per_srr * srr) - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn film_is_even_and_traction_odd_in_the_slide_to_roll_ratio() {
    for ((kind, mut solver), [even, odd]) in Solvers::new().0.into_iter().zip([[1e-9, 1e-8], [1e-8, 1e-7]]) {
        let [one, other] = [0.6, -0.6].map(|srr| solve(&mut solver, squalane(kind, 0.74, srr, 0.2)));
        assert!((one.scalars.h_c / other.scalars.h_c - 1.0).abs() < even);
        assert!((one.traction_coefficient() / other.traction_coefficient() + 1.0).abs() < odd);
        assert!(one.traction_coefficient() > 0.0);
    }
}

#[test]
fn contacts_beyond_table_3_6_converge() {
    for (kind, mut solver) in Solvers::new().0 {
        for speed in [0.1, 1.0, 5.0] {
            for srr in [-2.0, 0.01, 2.0] {
                for npr in [0.0, 0.05, 0.99] {
                    solve(&mut solver, squalane(kind, speed, srr, npr));
                }
            }
        }
        let near = solve(&mut solver, squalane(kind, 0.74, 0.5, 0.2227));
        let warm = solve_from(&mut solver, squalane(kind, 0.74, 0.55, 0.25), Start::From(&near)).report;
        assert!(warm.attempts == 1 && warm.newton_iterations < near.report.newton_iterations, "{warm:?}");
        assert!(kind == ContactKind::Point || warm.newton_iterations <= 10, "{warm:?}");
    }
}

/// Rule with `panels` equal panels, an even number, with six Gauss points each: 2 panels are two production rules on
/// half the film each.
fn finer_rule(panels: usize) -> &'static FilmRule {
    let width = 2.0 / panels as f64;
    let part = |k: usize| PRODUCTION_RULE.map(|(at, weight)| (-0.5 + (k as f64 + at + 0.5) * width, weight * width));
    Vec::leak((0..panels / 2).flat_map(part).collect())
}

#[test]
fn the_rule_across_the_film_costs_less_than_its_bar() {
    let mut solver = FullSolver::new(GRID).unwrap();
    let film = |solver: &mut FullSolver, problem: Problem| {
        let solution = solver.solve(&problem.point, problem.lubricant, Start::Cold, &()).unwrap();
        assert!(solution.converged(), "{:?}: {:?}", problem.point.sliding, solution.report);
        solution.scalars.h_c
    };
    let fine = finer_rule(32);
    let mut worst: f64 = 0.0;
    for speed in [0.1, 0.74, 5.0] {
        for (srr, npr) in [(0.0, 0.2227), (0.01, 0.2), (0.1, 0.0), (0.5, 0.2227), (1.0, 0.2)] {
            solver.options.film.rule = &PRODUCTION_RULE;
            let ours = film(&mut solver, problem(speed, srr, npr));
            solver.options.film.rule = fine;
            worst = worst.max((ours / film(&mut solver, problem(speed, srr, npr)) - 1.0).abs());
        }
    }
    println!("greatest error of H_c by the rule across the film: {worst:.1e}");
    assert!(worst < 2e-5, "{worst:e}");
}

#[test]
fn frozen_film_integrals_lead_to_the_same_solution() {
    for ((kind, mut solver), bound) in Solvers::new().0.into_iter().zip([1e-7, 1e-6]) {
        let exact = solve(&mut solver, squalane(kind, 0.74, 0.5, 0.2227));
        match &mut solver {
            ContactSolver::Line(solver) => solver.options.film.frozen = true,
            ContactSolver::Point(solver) => solver.options.film.frozen = true,
        }
        let frozen = solve(&mut solver, squalane(kind, 0.74, 0.5, 0.2227));
        println!("exact {} steps, frozen {}", exact.report.newton_iterations, frozen.report.newton_iterations);
        assert!((frozen.scalars.h_c / exact.scalars.h_c - 1.0).abs() < bound);
    }
}

#[test]
fn a_limiting_stress_bounds_the_traction_and_leaves_the_film() {
    for ((kind, mut solver), (slope, ambient)) in Solvers::new().0.into_iter().zip([(0.04, 1e6), (0.03, 1e5)]) {
        let free = squalane(kind, 0.74, 1.0, 0.2227);
        let laws =
            Lubricant { limiting_stress: Some(LimitingStress { ambient, slope, eyring: None }), ..free.lubricant };
        let limited = Problem::new(&free.point, laws).unwrap();
        let [free, limited] = [free, limited].map(|problem| solve(&mut solver, problem));
        assert_eq!(free.scalars.h_c, limited.scalars.h_c);
        assert!(free.traction_warning().is_none(), "α* p_H is below 12 in Table 3.5");
        let traction = limited.traction_coefficient();
        assert!(traction < free.traction_coefficient() && traction < 1.2 * slope, "{traction}");
    }
}

#[test]
fn eyring_stress_limits_the_traction_node_by_node() {
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let sliding = Sliding { slide_to_roll_ratio: 0.05, newtonian_plateau_ratio: None };
    let point = OperatingPoint { sliding, ..OperatingPoint::TABLE_2_1 };
    let mut with = |limiting_stress| {
        let laws = Lubricant { limiting_stress, ..Lubricant::default() };
        solve(&mut solver, Problem::new(&point, laws).unwrap())
    };
    let (eyring, slope) = (5e6, 0.04);
    let free = with(None);
    let limit = LimitingStress { ambient: 0.0, slope, eyring: Some(eyring) };
    let bent = with(Some(limit));
    assert_eq!(free.scalars, bent.scalars, "the film does not know of it");
    let p_h = point.hertz().pressure_pa;
    for ((newtonian, bent), p) in free.mid_film_stress().iter().zip(bent.mid_film_stress()).zip(&free.pressure) {
        let expected = (eyring * (newtonian / eyring).asinh()).min(slope * p_h * p.max(0.0));
        assert!((bent - expected).abs() <= 1e-12 * expected.abs(), "{bent} {expected}");
    }
    let (bent, free) = (bent.traction_coefficient(), free.traction_coefficient());
    assert!(free > 0.5 && bent > 0.01 && bent < slope, "{free} {bent}");
    let twice = Lubricant { limiting_stress: Some(limit), ..problem(0.74, 0.0, 0.2227).lubricant };
    assert!(twice.check().unwrap_err().to_string().contains("determines the traction too"));
}

#[test]
fn shear_rates_add_up_to_the_sliding_speed() {
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let solution = solve(&mut solver, problem(0.74, 0.5, 0.2227));
    let film_scale = solution.problem.point.film_scale_m();
    let heights: Vec<Vec<_>> = (0..=40).map(|k| solution.shear_field(&[f64::from(k) / 40.0])).collect();
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
fn a_limiting_stress_ends_the_warning_of_a_heavy_contact() {
    let mut solver = ContactSolver::on(&LINE.build().unwrap());
    let mut heavy = problem(0.74, 1.0, 0.2227);
    heavy.point.load *= 4.0;
    let limited = |limit| {
        let laws = Lubricant { limiting_stress: limit, ..heavy.lubricant };
        Problem::new(&heavy.point, laws).unwrap()
    };
    let unlimited = solve(&mut solver, limited(None));
    assert!(unlimited.traction_warning().is_some_and(|sentence| sentence.contains("unphysical")));
    let slope = 0.04;
    let bounded = solve(&mut solver, limited(Some(LimitingStress { ambient: 1e6, slope, eyring: None })));
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
