//! Behaviour of full point solves: derivatives, limits, initial guesses, grids, cancellation, error estimates.

use super::{Accuracy, resolution_warning};
use crate::solver::discrete::grid::PointGridSpec;
use crate::solver::discrete::reynolds::{Node, PENALTY, RowGeometry, row};
use crate::solver::discrete::space::PlaneSpace;
use crate::solver::full::tests::assert_derivatives;
use crate::solver::full::{PointSolver, Problem, Solution, SolveError, Start, System, Termination};
use crate::solver::physics::contact::{ContactKind, MoesRequest, OperatingPoint, si_from_moes};
use crate::solver::physics::lubricant::{
    DensityLaw, Fluidity, Lubricant, ScaledFluid, ShearLaw, Sliding, ViscosityLaw,
};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

const COARSE: PointGridSpec = PointGridSpec::uniform(0.04, 0.1, (-4.0, 2.0, -2.0));

fn at(m: f64, l: f64) -> OperatingPoint {
    si_from_moes(&MoesRequest::new(ContactKind::Point, m, l)).unwrap()
}

fn solve(spec: PointGridSpec, point: &OperatingPoint) -> Solution {
    PointSolver::new(spec).unwrap().solve(point, Lubricant::default(), Start::Cold, &()).unwrap()
}

/// Returns a state with some negative pressures, so that the penalty acts, and a direction: ΔP, and ΔH with
/// ΔH₀ = 0.3.
fn state(problem: &Problem) -> (System<PlaneSpace>, Vec<f64>, Vec<f64>) {
    let grid = PointGridSpec::uniform(0.1, 0.2, (-2.5, 1.5, -1.6)).build().unwrap();
    let mut system = System::new(PlaneSpace::new(Arc::clone(&grid)));
    let (nx, ny) = (grid.nx(), grid.ny());
    let field = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        (0..nx * ny).map(|n| if grid.weights[n] > 0.0 { f(grid.x[n / ny], grid.y[n % ny]) } else { 0.0 }).collect()
    };
    let start = field(&|x, y| 0.9 * (1.0 - x * x - y * y).max(0.0).sqrt() + 0.02 * (2.0 * x).cos() * (y - 0.3).cos());
    system.set_pressure(problem, &start);
    system.set_central_film(0.1);
    let direction = field(&|x, y| (3.0 * x).sin() * (1.0 + y).cos() * (1.0 - (x / 2.6).powi(2)));
    let mut film = vec![0.0; grid.len()];
    grid.deform(&direction, &mut film, &mut Default::default());
    film.iter_mut().for_each(|h| *h += 0.3);
    (system, direction, film)
}

const CARREAU: ShearLaw = ShearLaw::Carreau { critical_stress: 1e6, beta: 2.198, n: 0.6, npr: 0.1 };

fn thinning(slide_to_roll_ratio: f64) -> Problem {
    let lubricant = Lubricant { shear: CARREAU, ..Lubricant::default() };
    let sliding = Sliding { slide_to_roll_ratio, newtonian_plateau_ratio: None };
    Problem::under_sliding(&at(60.0, 8.0), lubricant, sliding).unwrap()
}

#[test]
fn jacobian_products_are_the_derivative_of_the_residual() {
    let newtonian = Problem::new(&at(60.0, 8.0), Lubricant::default()).unwrap();
    for problem in [newtonian, thinning(0.0), thinning(0.02), thinning(-1.0)] {
        let (system, direction, film) = state(&problem);
        assert_derivatives(system, &problem, &direction, &film);
    }
}

#[test]
fn generalized_rows_without_thinning_are_newtonian() {
    let newtonian = Problem::new(&at(60.0, 8.0), Lubricant::default()).unwrap();
    let (mut system, ..) = state(&newtonian);
    system.evaluate(&newtonian, PENALTY);
    let wanted = system.rows.clone();
    let scale = wanted.iter().fold(0.0f64, |largest, row| largest.max(row.value.abs()));
    for srr in [0.0, 0.5, -2.0] {
        let mut problem = thinning(srr);
        // NPR = 1 is solved as a Newtonian problem. Here the generalised equations are tested.
        if let (Some(law), Some((fluidity, _))) = (&mut problem.shear, Fluidity::of(CARREAU, 1.0)) {
            law.fluidity = fluidity;
        }
        system.evaluate(&problem, PENALTY);
        assert!(system.nodes.thins());
        for (got, wanted) in system.rows.iter().zip(&wanted) {
            let (got, wanted) = (got.value, wanted.value);
            assert!((got - wanted).abs() < 1e-12 * scale, "SRR {srr}: {got} against {wanted}");
        }
    }
}

/// Returns the value of an equation at (x, y) for smooth fields, on a grid with the given spacings.
fn manufactured(fluid: &ScaledFluid, geometry: &RowGeometry, x: f64, y: f64, hx: f64, hy: f64) -> f64 {
    let node = |dx: f64, dy: f64| {
        let (x, y) = (x + dx * hx, y + dy * hy);
        Node::new(fluid, 1.0, x.sin() * (0.7 * y).cos() + 2.0, 1.0 + 0.3 * x * x + 0.2 * y * y)
    };
    let nodes = [node(-2.0, 0.0), node(-1.0, 0.0), node(0.0, 0.0), node(1.0, 0.0), node(0.0, -1.0), node(0.0, 1.0)];
    row(geometry, PENALTY, std::array::from_fn(|k| &nodes[k])).value
}

#[test]
fn manufactured_rows_converge_with_the_orders_of_the_scheme() {
    let point = OperatingPoint { alpha_per_pa: 1e-10, ..at(60.0, 8.0) };
    let fluid =
        Lubricant { density: DensityLaw::Incompressible, viscosity: ViscosityLaw::Barus, ..Lubricant::default() }
            .scaled(&point)
            .unwrap();
    let a = point.alpha_hertz();
    let exact = |x: f64, y: f64| {
        let (c, s) = ((0.7 * y).cos(), (0.7 * y).sin());
        let (p, px, py) = (x.sin() * c + 2.0, x.cos() * c, -0.7 * x.sin() * s);
        let (pxx, pyy) = (-x.sin() * c, -0.49 * x.sin() * c);
        let (h, hx, hy) = (1.0 + 0.3 * x * x + 0.2 * y * y, 0.6 * x, 0.4 * y);
        let xi = h.powi(3) * (-a * p).exp();
        let (xi_x, xi_y) = (xi * (3.0 * hx / h - a * px), xi * (3.0 * hy / h - a * py));
        xi_x * px + xi * pxx + xi_y * py + xi * pyy - hx
    };
    let (x, h) = (0.4, 0.02);
    let steps = |h: f64| [x - 2.0 * h, x - h, x, x + h];
    // Inside, on the axis (where the fields are even in Y), and in the first column.
    type Geometry = fn([f64; 4], f64) -> RowGeometry;
    let cases: [(&str, f64, Geometry, f64); 3] = [
        ("inside", -0.5, |x, h| RowGeometry::new(x).across(h, Some(h)), 2.0),
        ("on the axis", 0.0, |x, h| RowGeometry::new(x).across(h, None), 2.0),
        ("first column", -0.5, |x, h| RowGeometry::first_column([x[1], x[2], x[3]]).across(h, Some(h)), 1.0),
    ];
    for (name, y, geometry, wanted) in cases {
        let error = |h: f64| {
            let hy = 1.5 * h;
            (manufactured(&fluid, &geometry(steps(h), hy), x, y, h, hy) - exact(x, y)).abs()
        };
        let order = (error(h) / error(0.5 * h)).log2();
        assert!((order - wanted).abs() < 0.2, "{name}: order {order}");
    }
}

#[test]
fn heavy_load_tends_to_hertz() {
    let deviation = |m: f64| {
        let s = solve(COARSE, &at(m, 3.0));
        let inside = s.nodes().filter(|(x, y, ..)| x.hypot(*y) < 0.8);
        inside.map(|(x, y, p, _)| (p - (1.0 - x * x - y * y).sqrt()).abs()).fold(0.0, f64::max)
    };
    let (light, middle, heavy) = (deviation(20.0), deviation(100.0), deviation(600.0));
    assert!(heavy < 0.3 * middle && middle < 0.5 * light && heavy < 0.02, "{light} {middle} {heavy}");
}

#[test]
fn warm_starts_are_cheaper_than_cold_ones() {
    let fine = PointGridSpec { dy: 0.05, ..COARSE };
    let mut solver = PointSolver::new(fine).unwrap();
    let point = at(150.0, 8.0);
    let mut run = |point: &OperatingPoint, start: Start<'_>| {
        let s = solver.solve(point, Lubricant::default(), start, &()).unwrap();
        assert!(s.converged() && s.report.attempts == 1);
        s
    };
    let cold = run(&point, Start::Cold);
    let near = run(&at(160.0, 8.3), Start::From(&cold));
    let again = run(&point, Start::From(&cold));
    let coarse = solve(COARSE, &point);
    let other = run(&point, Start::From(&coarse));
    let steps = [&cold, &near, &again, &other].map(|s| s.report.newton_iterations);
    assert!(steps[1] < steps[0] && steps[2] <= 2 && steps[3] < steps[0], "{steps:?}");
    assert!((other.scalars.h_c / cold.scalars.h_c - 1.0).abs() < 1e-6);
}

#[test]
fn two_grids_estimate_the_error_and_a_coarse_one_warns() {
    let point = at(200.0, 10.0);
    let spec = |dx: f64| PointGridSpec { dx, dy: 0.1, ..COARSE };
    let [coarse, middle, fine] = [0.08, 0.04, 0.02].map(|dx| solve(spec(dx), &point));
    let (first, second) = (Accuracy::of(&coarse, &middle).unwrap(), Accuracy::of(&middle, &fine).unwrap());
    // The limit must hardly change, and the error must fall with the square of the spacing.
    assert!((first.h_c.limit / second.h_c.limit - 1.0).abs() < 0.3 * first.h_c.error, "{first:?} {second:?}");
    assert!((3.0..5.5).contains(&(first.h_c.error / second.h_c.error)), "{first:?} {second:?}");
    assert!(Accuracy::of(&fine, &coarse).is_none());
    assert!(Accuracy::of(&coarse, &solve(spec(0.04), &at(210.0, 10.0))).is_none());
    assert!(resolution_warning(&coarse).is_some_and(|warning| warning.to_string().contains("H_min")));
    let light = solve(PointGridSpec { dx: 0.08, dy: 0.05, ..COARSE }, &at(20.0, 5.0));
    assert_eq!(resolution_warning(&light), None);
}

#[test]
fn a_graded_grid_finds_the_films_of_a_much_finer_uniform_one() {
    let spec = |dy: f64, refinement: f64| PointGridSpec { dx: 0.04, dy, refinement, domain: (-3.0, 1.8, -1.4) };
    let point = at(858.0, 2.0);
    let [uniform, graded, fine] = [spec(0.05, 1.0), spec(0.05, 4.0), spec(0.0125, 1.0)].map(|s| solve(s, &point));
    assert!(graded.y.len() < 52 && uniform.converged() && graded.converged() && fine.converged());
    let off = |s: &Solution| (s.scalars.h_min / fine.scalars.h_min - 1.0).abs();
    assert!(off(&uniform) > 0.5 && off(&graded) < 0.04, "{} {}", off(&uniform), off(&graded));
    assert!((graded.scalars.h_c / fine.scalars.h_c - 1.0).abs() < 2e-3);
    assert!(resolution_warning(&uniform).is_some() && resolution_warning(&graded).is_none());
}

#[test]
fn traction_integrates_the_shear_stress_over_both_halves() {
    let s = solve(COARSE, &at(50.0, 4.0));
    let point = s.problem.point;
    let (a, scale) = (point.hertz().half_width_m, point.film_scale_m());
    let (ny, hx, hy) = (s.y.len(), 0.04, 0.1);
    let mut force = 0.0;
    for i in 0..s.x.len() {
        for j in 0..ny {
            let k = i * ny + j;
            let eta = point.viscosity_pa_s * s.problem.fluid.at(s.pressure[k].max(0.0)).viscosity;
            let ends = if i == 0 || i + 1 == s.x.len() { 0.5 } else { 1.0 };
            let sides = if j == 0 || j + 1 == ny { 1.0 } else { 2.0 };
            force += ends * sides * hx * hy * a * a * eta * point.speed_m_per_s / (s.film[k] * scale);
        }
    }
    assert!((s.traction().per_srr / (force / point.load) - 1.0).abs() < 1e-9);
}

#[test]
fn what_is_not_asked_for_is_refused_or_says_so() {
    let mut solver = PointSolver::new(COARSE).unwrap();
    let line = solver.solve(&OperatingPoint::TABLE_2_1, Lubricant::default(), Start::Cold, &());
    assert!(matches!(line, Err(SolveError::OtherContact { .. })));
    let flag = AtomicBool::new(true);
    let s = solver.solve(&at(40.0, 10.0), Lubricant::default(), Start::Cold, &flag).unwrap();
    assert_eq!((s.report.termination, s.report.newton_iterations), (Termination::Cancelled, 0));
    solver.options.max_newton = 2;
    let s = solver.solve(&at(40.0, 10.0), Lubricant::default(), Start::Cold, &()).unwrap();
    assert!(!s.converged());
}
